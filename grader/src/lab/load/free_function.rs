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
                let differs = differences(&case, first);
                let case = case.name;
                let problem = FunctionProblem::OtherNames { case, differs };
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
            if let (true, Some(near)) = (foreign, near_built_in(function.get_ref())) {
                let problem = FunctionProblem::NearName {
                    name: function.get_ref().clone(),
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
            ExpectedTable::Whole(list) => vec![(String::new(), Dimension::List(list.clone()))],
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
            robot: None,
            given: Given::Values {
                given: given.iter().map(|(k, v)| (k.clone(), v.clone())).collect(),
                expected,
            },
        })
    }
}

/// The built-in function that is meant by this name, if it is near to one or another word for it.
fn near_built_in(name: &str) -> Option<&'static str> {
    let known = ["forward_kinematics", "inverse_kinematics", "jacobian"];
    match name {
        "fk" | "fkine" | "forward" => Some(known[0]),
        "ik" | "ikine" | "inverse" => Some(known[1]),
        "jac" | "jacob" | "geometric_jacobian" => Some(known[2]),
        name => nearest(name, known.into_iter()),
    }
}

/// Stands for the name of an answer that is a list: no entry can be called so.
const LIST: &str = "[]";

fn named((name, value): &(String, Dimension)) -> &str {
    match value {
        Dimension::List(_) if name.is_empty() => LIST,
        _ => name,
    }
}

/// The names of what a case gives and expects; of an answer without names, what it is.
fn shape(case: &Case) -> [Vec<&str>; 2] {
    match &case.given {
        Given::Values { given, expected } => {
            [given, expected].map(|entries| entries.iter().map(named).collect())
        }
        _ => [Vec::new(), Vec::new()],
    }
}

/// How what `case` gives and expects differs from the first one, in words: the names that differ, and no others.
fn differences(case: &Case, first: &Case) -> String {
    let [given, expected] = shape(case);
    let [first_given, first_expected] = shape(first);
    let both = [
        difference("give", &given, &first_given),
        difference("expect", &expected, &first_expected),
    ];
    let both: Vec<String> = both.into_iter().flatten().collect();
    both.join("; it ")
}

fn difference(verb: &str, of_case: &[&str], of_first: &[&str]) -> Option<String> {
    let without = |these: &[&str], those: &[&str]| {
        let only = these.iter().filter(|name| !those.contains(name));
        let only: Vec<String> = only
            .map(|name| match *name {
                "" => "one number".to_owned(),
                LIST => "a list".to_owned(),
                name => format!("`{name}`"),
            })
            .collect();
        only.join(", ")
    };
    let (more, less) = (without(of_case, of_first), without(of_first, of_case));
    match (more.is_empty(), less.is_empty()) {
        (true, true) => None,
        (false, true) => Some(format!("{verb}s {more}, the first case does not")),
        (true, false) => Some(format!("does not {verb} {less}, the first case does")),
        (false, false) => Some(format!("{verb}s {more}, the first case {verb}s {less}")),
    }
}
