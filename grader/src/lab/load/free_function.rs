//! A task of a function that the lab names itself: what it is called, what its cases give, what they expect.

use kinemark_sim::text::Dimension;
use kinemark_sim::text::nearest;
use toml::Spanned;

use super::Reader;
use super::functions::FunctionProblem;
use super::grants::GrantProblem;
use crate::lab::file::{CaseTable, ExpectedTable, FunctionTable};
use crate::submission::rhai::refused_name;
use crate::task::model::{Case, Function, Given};
use crate::task::problem::LabError;

impl Reader<'_> {
    /// The function called `name`.
    pub(super) fn free_function(&self, name: &Spanned<String>) -> Result<Function, LabError> {
        let typed = name.get_ref();
        match refused_name(typed) {
            None => Ok(Function::Free(typed.clone())),
            Some(why) => {
                let problem = FunctionProblem::BadName {
                    name: typed.clone(),
                    why: why.to_owned(),
                };
                self.report.refuse_at(name, problem)
            }
        }
    }

    /// The cases of a free function: all of them give and expect entries of the same names.
    pub(super) fn free_cases(&self, table: &FunctionTable) -> Result<Vec<Case>, LabError> {
        if let Some(grant) = table.grants.first() {
            let function = table.call.get_ref().clone();
            return self
                .report
                .refuse_at(grant, GrantProblem::NoRobot { function });
        }
        let mut cases: Vec<Case> = Vec::new();
        for spanned in &table.cases {
            let case = self.free_case(&table.call, spanned)?;
            if let Some(first) = cases.first()
                && shape(first) != shape(&case)
            {
                let problem = FunctionProblem::OtherNames {
                    gives: in_words(&case),
                    case: case.name,
                    first: first.name.clone(),
                    first_gives: in_words(first),
                };
                return self.report.refuse_at(spanned, problem);
            }
            cases.push(case);
        }
        Ok(cases)
    }

    fn free_case(
        &self,
        function: &Spanned<String>,
        spanned: &Spanned<CaseTable>,
    ) -> Result<Case, LabError> {
        let table = spanned.get_ref();
        let name = table.name.get_ref().clone();
        let foreign = table.q_rad.is_some()
            || table.position_m.is_some()
            || table.branches.is_some()
            || !table.dimensions.is_empty();
        let (Some(given), Some(expected), false) = (&table.given, &table.expected, foreign) else {
            let known = ["forward_kinematics", "inverse_kinematics", "jacobian"];
            if let (true, Some(near)) = (foreign, nearest(function.get_ref(), known.into_iter())) {
                let problem = FunctionProblem::NearName {
                    name: function.get_ref().clone(),
                    case: name,
                    near: near.to_owned(),
                };
                return self.report.refuse_at(function, problem);
            }
            let (case, function) = (name, function.get_ref().clone());
            let problem = FunctionProblem::FreeInput { case, function };
            return self.report.refuse_at(spanned, problem);
        };
        let expected = match expected {
            ExpectedTable::One(number) => vec![(String::new(), Dimension::Number(*number))],
            ExpectedTable::Entries(entries) => entries
                .iter()
                .map(|(k, v)| (k.clone(), v.clone()))
                .collect(),
        };
        if expected.is_empty() {
            let problem = FunctionProblem::NothingExpected { case: name };
            return self.report.refuse_at(spanned, problem);
        }
        Ok(Case {
            name,
            hidden_class: None,
            dimensions: Vec::new(),
            given: Given::Values {
                given: given.iter().map(|(k, v)| (k.clone(), v.clone())).collect(),
                expected,
            },
        })
    }
}

/// The names of what a case gives and expects.
fn shape(case: &Case) -> [Vec<&str>; 2] {
    match &case.given {
        Given::Values { given, expected } => {
            [given, expected].map(|entries| entries.iter().map(|(name, _)| name.as_str()).collect())
        }
        _ => [Vec::new(), Vec::new()],
    }
}

/// What a case gives and expects, in words.
fn in_words(case: &Case) -> String {
    let [given, expected] = shape(case);
    let expected = match expected.as_slice() {
        [""] => "one number".to_owned(),
        names => names.join(", "),
    };
    format!("{} and expects {expected}", given.join(", "))
}
