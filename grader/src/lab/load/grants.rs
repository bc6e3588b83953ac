//! What a task grants: functions of `robot`, each once, none that is what the task asks for.

use kinemark_sim::text::Spanned;

use super::Reader;
use crate::lab::file::FunctionTable;
use crate::task::grant::Grant;
use crate::task::model::{About, Function};
use crate::task::problem::{LabError, near, problems};
use crate::task::quantity::Quantity;

problems! {
    /// What a task cannot grant.
    pub(super) enum GrantProblem {
        Unknown { name: String }:
            "lab::grants", "there is no `robot.{name}` to grant", "not a function of `robot`",
            near(name, "functions", Grant::ALL.map(Grant::name));
        Twice { name: String }:
            "lab::grants", "`{name}` is granted twice", "the second one", "remove one of them";
        Asked { name: String }:
            "lab::grants", "`robot.{name}` is what this task asks for", "gives the answer away", "remove it";
        ClosedLoops { name: String, robot: String }:
            "lab::grants", "`robot.{name}` cannot be granted: robot `{robot}` has closed loops",
            "only `fk` can, for a robot with loops", "remove it";
        OtherRobot { function: String }:
            "lab::grants", "`robot` of this task is not that of the lab, so nothing of it can be granted to `{function}`",
            "a grant of another robot", "remove it, or `frame`, `ignore` and the cases' `robot`";
        NoRobot { function: String }:
            "lab::grants", "`{function}` is given no robot to ask", "a grant of nothing", "remove `grants` here";
    }
}

impl Reader<'_> {
    /// The functions granted to a function task.
    pub(super) fn function_grants(
        &self,
        table: &FunctionTable,
        function: &Function,
        about: &About,
    ) -> Result<Vec<Grant>, LabError> {
        if let Some(first) = table.grants.first() {
            let has_row = table
                .cases
                .iter()
                .any(|case| case.get_ref().robot.is_some());
            let name = function.name().to_owned();
            if matches!(function, Function::Free(_)) && !about.gives_robot {
                return self
                    .report
                    .refuse_at(first, GrantProblem::NoRobot { function: name });
            }
            if has_row || about.frame.is_some() || !about.ignored.is_empty() {
                return self
                    .report
                    .refuse_at(first, GrantProblem::OtherRobot { function: name });
            }
        }
        self.grants(&table.grants, Some(function))
    }

    /// The functions granted, in the order of [`Grant::ALL`]; `asked` is what a function task asks for.
    pub(super) fn grants(
        &self,
        typed: &[Spanned<String>],
        asked: Option<&Function>,
    ) -> Result<Vec<Grant>, LabError> {
        let mut grants = Vec::new();
        for at in typed {
            let name = at.get_ref().clone();
            let found = Grant::ALL.into_iter().find(|grant| grant.name() == name);
            let Some(grant) = found else {
                return self.report.refuse_at(at, GrantProblem::Unknown { name });
            };
            if grants.contains(&grant) {
                return self.report.refuse_at(at, GrantProblem::Twice { name });
            }
            let given_away = matches!(
                (grant, asked),
                (Grant::Fk, Some(Function::ForwardKinematics(_)))
                    | (Grant::Jacobian, Some(Function::Jacobian(_)))
                    | (
                        Grant::Jacobian,
                        Some(Function::Quantity(Quantity::Velocity(_)))
                    )
                    | (Grant::Gravity, Some(Function::Quantity(Quantity::Gravity)))
                    | (
                        Grant::MassMatrix,
                        Some(Function::Quantity(Quantity::MassMatrix))
                    )
            );
            if given_away {
                return self.report.refuse_at(at, GrantProblem::Asked { name });
            }
            // the model's equations do not know what a loop binds together
            if grant != Grant::Fk && !self.robot.dependent().is_empty() {
                let robot = self.robot.name().to_owned();
                let problem = GrantProblem::ClosedLoops { name, robot };
                return self.report.refuse_at(at, problem);
            }
            if matches!(grant, Grant::Gravity | Grant::MassMatrix) {
                self.has_inertias(at)?;
            }
            grants.push(grant);
        }
        grants.sort();
        Ok(grants)
    }
}
