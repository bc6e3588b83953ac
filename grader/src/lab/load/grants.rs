//! What a task grants: functions of `robot`, each once, none that is what the task asks for.

use kinemark_sim::text::suggest;
use toml::Spanned;

use super::Reader;
use crate::task::grant::Grant;
use crate::task::model::Function;
use crate::task::problem::LabError;

impl Reader<'_> {
    /// The functions granted, in the order of [`Grant::ALL`]; `asked` is what a function task asks for.
    pub(super) fn grants(
        &self,
        typed: &[Spanned<String>],
        asked: Option<&Function>,
    ) -> Result<Vec<Grant>, LabError> {
        let mut grants = Vec::new();
        for at in typed {
            let name = at.get_ref().as_str();
            let refuse = |message: String, label: &str, help: String| {
                self.report
                    .err(at.span(), "lab::grants", message, label, Some(help))
            };
            let Some(grant) = Grant::ALL.into_iter().find(|grant| grant.name() == name) else {
                return refuse(
                    format!("there is no `robot.{name}` to grant"),
                    "not a function of `robot`",
                    suggest(name, "functions", Grant::ALL.into_iter().map(Grant::name)),
                );
            };
            if grants.contains(&grant) {
                return refuse(
                    format!("`{name}` is granted twice"),
                    "the second one",
                    "remove one of them".to_owned(),
                );
            }
            let given_away = matches!(
                (grant, asked),
                (Grant::Fk, Some(Function::ForwardKinematics))
                    | (Grant::Jacobian, Some(Function::Jacobian(_)))
            );
            if given_away {
                return refuse(
                    format!("`robot.{name}` is what this task asks for"),
                    "gives the answer away",
                    "remove it".to_owned(),
                );
            }
            // the model's equations do not know what a loop binds together
            if grant != Grant::Fk && !self.robot.dependent().is_empty() {
                return refuse(
                    format!(
                        "`robot.{name}` cannot be granted: robot `{}` has closed loops",
                        self.robot.name()
                    ),
                    "only `fk` can, for a robot with loops",
                    "remove it".to_owned(),
                );
            }
            grants.push(grant);
        }
        grants.sort();
        Ok(grants)
    }
}
