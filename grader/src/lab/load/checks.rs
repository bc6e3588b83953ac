//! The checks of a task, read by the kinds of [`crate::check::kind`] with what the lab knows.

use kinemark_sim::text::Spanned;

use super::Reader;
use crate::check::reading::InMotion;
use crate::check::registry::{self, CheckTable};
use crate::check::{Check, FunctionCheck, MotionCheck};
use crate::task::model::{FunctionTask, MotionTask};
use crate::task::problem::LabError;

impl Reader<'_> {
    pub(super) fn function_checks(
        &self,
        tables: &[Spanned<CheckTable>],
        function: &FunctionTask,
    ) -> Result<Vec<Check<dyn FunctionCheck>>, LabError> {
        registry::function_checks(tables, self.report, function)
    }

    pub(super) fn motion_checks(
        &self,
        tables: &[Spanned<CheckTable>],
        motion: &MotionTask,
    ) -> Result<Vec<Check<dyn MotionCheck>>, LabError> {
        let of = InMotion {
            robot: self.robot,
            motion,
            check: "",
            earlier: &[],
        };
        registry::motion_checks(tables, self.report, of)
    }
}
