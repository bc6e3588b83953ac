//! A task of a function that the lab names itself: what it is called, what its cases give, what they expect.

use kinemark_sim::text::Dimension;
use kinemark_sim::text::nearest;
use toml::Spanned;

use super::Reader;
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
            Some(why) => self.report.err(
                name.span(),
                "lab::call",
                format!("`{typed}` cannot be the name of a function: {why}"),
                "this name",
                Some(
                    "`forward_kinematics`, `inverse_kinematics`, `jacobian`, or a name of your own in lower-case letters, digits and `_`"
                        .to_owned(),
                ),
            ),
        }
    }

    /// The cases of a free function: all of them give and expect entries of the same names.
    pub(super) fn free_cases(&self, table: &FunctionTable) -> Result<Vec<Case>, LabError> {
        if let Some(grant) = table.grants.first() {
            return self.report.err(
                grant.span(),
                "lab::grants",
                format!("`{}` is given no robot to ask", table.call.get_ref()),
                "a grant of nothing",
                Some("remove `grants` here".to_owned()),
            );
        }
        let mut cases: Vec<Case> = Vec::new();
        for spanned in &table.cases {
            let case = self.free_case(&table.call, spanned)?;
            if let Some(first) = cases.first()
                && shape(first) != shape(&case)
            {
                return self.report.err(
                    spanned.span(),
                    "lab::case_input",
                    format!(
                        "case `{}` gives {}, case `{}` gives {}",
                        case.name,
                        in_words(&case),
                        first.name,
                        in_words(first)
                    ),
                    "unlike the first case",
                    Some("give and expect the same names in every case".to_owned()),
                );
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
                return self.report.err(
                    function.span(),
                    "lab::call",
                    format!(
                        "`{}` is a function of the lab's own, and case `{name}` is one of `{near}`",
                        function.get_ref()
                    ),
                    "this name",
                    Some(format!("did you mean `{near}`?")),
                );
            }
            let function = function.get_ref();
            return self.report.err(
                spanned.span(),
                "lab::case_input",
                format!("case `{name}` of `{function}` is given by `given` and `expected`"),
                "this case",
                Some("write `given = { kp = 100.0 }, expected = { damping_ratio = 2.2 }`, or one number for `expected`".to_owned()),
            );
        };
        let expected = match expected {
            ExpectedTable::One(number) => vec![(String::new(), Dimension::Number(*number))],
            ExpectedTable::Entries(entries) => entries
                .iter()
                .map(|(k, v)| (k.clone(), v.clone()))
                .collect(),
        };
        if expected.is_empty() {
            return self.report.err(
                spanned.span(),
                "lab::case_input",
                format!("case `{name}` expects nothing"),
                "this case",
                Some("name in `expected` what the function is to return".to_owned()),
            );
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
