//! What is wrong with the table of a sensor outside of a robot file.

use crate::part::part_problem::{PartError, PartProblem};
use crate::text::{Located, Problem};

/// What is wrong with the table of a sensor.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(transparent)]
pub struct SensorProblem(PartProblem);

impl From<PartError> for Located<SensorProblem> {
    fn from(error: PartError) -> Self {
        error.map(SensorProblem)
    }
}

impl Problem for SensorProblem {
    fn code(&self) -> &'static str {
        self.0.codes().sensor
    }

    fn label(&self) -> String {
        self.0.label()
    }

    fn help(&self) -> Option<String> {
        self.0.help()
    }
}
