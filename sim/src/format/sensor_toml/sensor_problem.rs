//! Everything that can be wrong with the table of a sensor.

use crate::format::part::part_problem::{PartError, PartProblem};
use crate::text::{Located, Problem};

/// A problem in the table of a sensor, with its place.
pub(crate) type SensorTableError = Located<SensorProblem>;

impl From<PartError> for SensorTableError {
    fn from(error: PartError) -> Self {
        error.map(SensorProblem::Part)
    }
}

/// What is wrong with the table of a sensor.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message says what its variant is")]
pub enum SensorProblem {
    #[error(transparent)]
    Part(#[from] PartProblem),
    #[error("no joint is called `{name}`")]
    UnknownJoint { name: String, help: String },
    #[error("no link is called `{name}`")]
    UnknownLink { name: String, help: String },
    #[error("no frame is called `{name}`")]
    UnknownFrame { name: String, help: String },
    #[error("{message}")]
    Unfit { message: String, help: String },
}

impl Problem for SensorProblem {
    fn code(&self) -> &'static str {
        match self {
            Self::Part(part) => part.codes().sensor,
            Self::UnknownJoint { .. } => "sensor::unknown_joint",
            Self::UnknownLink { .. } => "sensor::unknown_link",
            Self::UnknownFrame { .. } => "sensor::unknown_frame",
            Self::Unfit { .. } => "sensor::unfit",
        }
    }

    fn label(&self) -> String {
        match self {
            Self::Part(part) => return part.label(),
            Self::UnknownJoint { .. } => "not a joint of this robot",
            Self::UnknownLink { .. } => "not a link of this robot",
            Self::UnknownFrame { .. } => "not a frame of this robot",
            Self::Unfit { .. } => "here",
        }
        .to_owned()
    }

    fn help(&self) -> Option<String> {
        match self {
            Self::Part(part) => part.help(),
            Self::UnknownJoint { help, .. }
            | Self::UnknownLink { help, .. }
            | Self::UnknownFrame { help, .. }
            | Self::Unfit { help, .. } => Some(help.clone()),
        }
    }
}
