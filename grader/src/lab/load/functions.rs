//! Function tasks: the function that is called, its rows, and its visible cases.

use kinemark_sim::text::suggest;
use toml::Spanned;

use super::Reader;
use crate::lab::file::{CaseTable, FunctionTable};
use crate::task::model::{Case, Function, FunctionTask, Given, Rows};
use crate::task::problem::LabError;

impl Reader<'_> {
    pub(super) fn function(&self, table: &FunctionTable) -> Result<FunctionTask, LabError> {
        let function = match table.call.get_ref().as_str() {
            "forward_kinematics" => Function::ForwardKinematics,
            "inverse_kinematics" => Function::InverseKinematics,
            "jacobian" => Function::Jacobian(self.rows(table.rows.as_ref())?),
            _ => self.free_function(&table.call)?,
        };
        if let (Some(rows), false) = (&table.rows, matches!(function, Function::Jacobian(_))) {
            return self.report.err(
                rows.span(),
                "lab::rows",
                format!("`{}` has no `rows`", function.name()),
                "rows of what?",
                Some("`rows` are those of `jacobian`: remove them here".to_owned()),
            );
        }
        if table.cases.is_empty() {
            return self.report.err(
                table.call.span(),
                "lab::no_cases",
                format!("`{}` has no visible cases", function.name()),
                "this function",
                Some("add [[tasks.function.cases]]: students practise on them".to_owned()),
            );
        }
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

    /// The rows of a Jacobian: the linear ones where none are named.
    fn rows(&self, typed: Option<&Spanned<Vec<String>>>) -> Result<Rows, LabError> {
        let Some(typed) = typed else {
            return Ok(Rows::LINEAR);
        };
        match Rows::named(typed.get_ref().iter().map(String::as_str)) {
            Some(rows) => Ok(rows),
            None => self.report.err(
                typed.span(),
                "lab::rows",
                format!(
                    "`rows` names some of {}, each once and in this order",
                    Rows::NAMES.join(", ")
                ),
                "not such rows",
                Some("write `rows = [\"x\", \"y\"]` for motion in a plane".to_owned()),
            ),
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
        if let Err(error) = self.robot_file.build(&dimensions) {
            return self.report.err(
                table.span(),
                "lab::case_dimensions",
                format!("case `{name}`: {error}"),
                "this case",
                Some(suggest(
                    "",
                    "dimensions",
                    self.robot_file.dimensions().names(),
                )),
            );
        }
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
                return self.report.err(
                    table.span(),
                    "lab::case_input",
                    format!(
                        "case `{name}` of `{}` is given by {wanted}",
                        function.name()
                    ),
                    "this case",
                    Some(format!("give {wanted} and nothing else")),
                );
            }
        };
        Ok(Case {
            name,
            hidden_class: None,
            dimensions,
            given,
        })
    }
}
