//! Function tasks: the function that is called, its rows, and its visible cases.

use std::collections::BTreeSet;
use std::sync::Arc;

use toml::Spanned;

use super::Reader;
use crate::lab::file::{CaseTable, FunctionTable};
use crate::task::model::{Case, Function, FunctionTask, Given, Rows};
use crate::task::problem::{LabError, near, problems};

problems! {
    /// What is wrong with a function task, or a visible case of one.
    pub(super) enum FunctionProblem {
        BadName { name: String, why: String }:
            "lab::call", "`{name}` cannot be the name of a function: {why}", "this name",
            "`forward_kinematics`, `inverse_kinematics`, `jacobian`, or a name of your own in lower-case letters, digits and `_`";
        NearName { name: String, near: String }:
            "lab::call", "no built-in task function is called `{name}`", "this name",
            format!("did you mean `{near}`? A function of your own needs `given` and `expected` in every case");
        SameCase { case: String }:
            "lab::duplicate", "case `{case}` is defined twice", "the second one", "give each its own name";
        RowsOfWhat { function: String }:
            "lab::rows", "`{function}` has no `rows`", "rows of what?", "`rows` are those of `jacobian`: remove them here";
        Rows { known: String }:
            "lab::rows", "`rows` names some of {known}, each once and in this order", "not such rows",
            "write `rows = [\"x\", \"y\"]` for motion in a plane";
        NoCases { function: String }:
            "lab::no_cases", "`{function}` has no visible cases", "this function",
            "add [[tasks.function.cases]]: students practise on them";
        Dimensions { case: String, error: String, known: Vec<String> }:
            "lab::case_dimensions", "case `{case}`: {error}", "this case", near("", "dimensions", known);
        Input { case: String, function: String, wanted: &'static str }:
            "lab::case_input", "case `{case}` of `{function}` is given by {wanted}", "this case",
            format!("give {wanted} and nothing else");
        FreeInput { case: String, function: String }:
            "lab::case_input", "case `{case}` of `{function}` is given by `given` and `expected`", "this case",
            "write `given = { kp = 100.0 }, expected = { damping_ratio = 2.2 }`, or one number for `expected`";
        NothingExpected { case: String }:
            "lab::case_input", "case `{case}` expects nothing", "this case",
            "name in `expected` what the function is to return";
        OtherNames { case: String, differs: String }:
            "lab::case_input", "case `{case}` {differs}", "unlike the first case", "all cases of a task have the same names";
    }
}

impl Reader<'_> {
    pub(super) fn function(&self, table: &FunctionTable) -> Result<FunctionTask, LabError> {
        let function = match table.call.get_ref().as_str() {
            "forward_kinematics" => Function::ForwardKinematics,
            "inverse_kinematics" => Function::InverseKinematics,
            "jacobian" => Function::Jacobian(self.rows(table.rows.as_ref())?),
            _ => self.free_function(&table.call)?,
        };
        if let (Some(rows), false) = (&table.rows, matches!(function, Function::Jacobian(_))) {
            let function = function.name().to_owned();
            let problem = FunctionProblem::RowsOfWhat { function };
            return self.report.refuse_at(rows, problem);
        }
        if table.cases.is_empty() {
            let function = function.name().to_owned();
            let problem = FunctionProblem::NoCases { function };
            return self.report.refuse_at(&table.call, problem);
        }
        self.distinct(&table.cases)?;
        let cases: Result<Vec<Case>, LabError> = match &function {
            Function::Free(_) => self.free_cases(table),
            function => {
                let cases = table.cases.iter();
                cases.map(|case| self.case(function, case)).collect()
            }
        };
        Ok(FunctionTask {
            grants: self.grants(&table.grants, Some(&function))?,
            function,
            cases: cases?,
        })
    }

    /// Refuses a name that two cases have.
    fn distinct(&self, cases: &[Spanned<CaseTable>]) -> Result<(), LabError> {
        let mut known = BTreeSet::new();
        for case in cases {
            let name = &case.get_ref().name;
            if !known.insert(name.get_ref()) {
                let case = name.get_ref().clone();
                let problem = FunctionProblem::SameCase { case };
                return self.report.refuse_at(name, problem);
            }
        }
        Ok(())
    }

    /// The rows of a Jacobian: the linear ones where none are named.
    fn rows(&self, typed: Option<&Spanned<Vec<String>>>) -> Result<Rows, LabError> {
        let Some(typed) = typed else {
            return Ok(Rows::LINEAR);
        };
        match Rows::named(typed.get_ref().iter().map(String::as_str)) {
            Some(rows) => Ok(rows),
            None => {
                let known = Rows::NAMES.join(", ");
                self.report
                    .refuse_at(typed, FunctionProblem::Rows { known })
            }
        }
    }

    fn case(&self, function: &Function, table: &Spanned<CaseTable>) -> Result<Case, LabError> {
        let case = table.get_ref();
        let name = case.name.get_ref().clone();
        let dimensions: Vec<_> = case
            .dimensions
            .iter()
            .map(|(name, value)| (name.clone(), value.clone()))
            .collect();
        let robot = match self.robot_file.build_changed(&dimensions) {
            Ok(robot) => robot.map(Arc::new),
            Err(error) => {
                let known = self.robot_file.dimensions().names().map(str::to_owned);
                let problem = FunctionProblem::Dimensions {
                    case: name,
                    error: error.to_string(),
                    known: known.collect(),
                };
                return self.report.refuse_at(table, problem);
            }
        };
        let own = case.given.is_none() && case.expected.is_none();
        let given = match (function, &case.q_rad, case.position_m) {
            (Function::ForwardKinematics | Function::Jacobian(_), Some(q), None) if own => {
                self.counted(q, "q_rad")?;
                Given::Q(q.get_ref().clone())
            }
            (Function::InverseKinematics, None, Some(position_m)) if own => Given::Position {
                position_m,
                branches: case.branches.as_ref().map_or(2, |branches| {
                    u32::try_from(*branches.get_ref()).unwrap_or(2)
                }),
            },
            _ => {
                let wanted = match function {
                    Function::ForwardKinematics | Function::Jacobian(_) => "`q_rad`",
                    Function::InverseKinematics => "`position_m`",
                    Function::Free(_) => "`given`",
                };
                let problem = FunctionProblem::Input {
                    case: name,
                    function: function.name().to_owned(),
                    wanted,
                };
                return self.report.refuse_at(table, problem);
            }
        };
        Ok(Case {
            name,
            hidden_class: None,
            dimensions,
            robot,
            given,
        })
    }
}
