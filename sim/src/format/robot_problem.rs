//! Everything that can be wrong with a robot's description.

use super::part::part_problem::{PartError, PartProblem};
use super::sensor_toml::sensor_problem::SensorProblem;
use crate::text::{Located, Problem};

/// A problem in a robot description, with its place.
pub type RobotError = Located<RobotProblem>;

impl From<PartError> for RobotError {
    fn from(error: PartError) -> Self {
        error.map(RobotProblem::Part)
    }
}

impl From<Located<SensorProblem>> for RobotError {
    fn from(error: Located<SensorProblem>) -> Self {
        error.map(|problem| match problem {
            SensorProblem::Part(part) => RobotProblem::Part(part),
            SensorProblem::UnknownJoint { name, help } => RobotProblem::UnknownJoint { name, help },
            SensorProblem::UnknownLink { name, help } => RobotProblem::UnknownLink { name, help },
            SensorProblem::UnknownFrame { name, help } => RobotProblem::UnknownFrame { name, help },
            SensorProblem::Unfit { message, help } => RobotProblem::Sensor { message, help },
        })
    }
}

/// What is wrong with a robot description.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message says what its variant is")]
pub enum RobotProblem {
    #[error(transparent)]
    Part(#[from] PartProblem),
    #[error("a robot needs at least one link")]
    NoLinks,
    #[error("no link is called `{name}`")]
    UnknownLink { name: String, help: String },
    #[error("no joint is called `{name}`")]
    UnknownJoint { name: String, help: String },
    #[error("no frame is called `{name}`")]
    UnknownFrame { name: String, help: String },
    #[error("link `{link}` is moved by two joints: `{first}` and `{second}`")]
    TwoParents {
        link: String,
        first: String,
        second: String,
    },
    #[error("link `{link}` is the first link, fixed to the world, and cannot be a joint's child")]
    RootIsChild { link: String },
    #[error("no joint holds link `{link}`")]
    Detached { link: String, root: String },
    #[error("joint `{joint}` closes a cycle: `{link}` would carry itself")]
    Cycle { joint: String, link: String },
    #[error("{message}")]
    Mimic { message: String, help: String },
    #[error("{message}")]
    Loop { message: String, help: String },
    #[error("{message}")]
    Dh { message: String, help: String },
    #[error("{message}")]
    Urdf {
        message: String,
        label: String,
        help: Option<String>,
    },
    #[error("{message}")]
    ConfigString { message: String, help: String },
    #[error("{message}")]
    Limit { message: String, help: String },
    #[error("{message}")]
    Sensor { message: String, help: String },
}

impl Problem for RobotProblem {
    fn code(&self) -> &'static str {
        match self {
            Self::Part(part) => part.codes().robot,
            Self::NoLinks => "robot::no_links",
            Self::UnknownLink { .. } => "robot::unknown_link",
            Self::UnknownJoint { .. } => "robot::unknown_joint",
            Self::UnknownFrame { .. } => "robot::unknown_frame",
            Self::Mimic { .. } => "robot::mimic",
            Self::Loop { .. } => "robot::loop",
            Self::Dh { .. } => "robot::dh",
            Self::Urdf { .. } => "robot::urdf",
            Self::ConfigString { .. } => "robot::config_string",
            Self::TwoParents { .. } => "robot::two_parents",
            Self::RootIsChild { .. } => "robot::root_is_child",
            Self::Detached { .. } => "robot::detached",
            Self::Cycle { .. } => "robot::cycle",
            Self::Limit { .. } => "robot::limit",
            Self::Sensor { .. } => "robot::sensor",
        }
    }

    fn label(&self) -> String {
        match self {
            Self::Part(part) => part.label(),
            Self::NoLinks => "no [[links]]".to_owned(),
            Self::UnknownLink { .. } => "not a link of this robot".to_owned(),
            Self::UnknownJoint { .. } => "not a joint of this robot".to_owned(),
            Self::UnknownFrame { .. } => "not a frame of this robot".to_owned(),
            Self::Mimic { .. } => "this mimic".to_owned(),
            Self::Loop { .. } => "this loop".to_owned(),
            Self::Dh { .. } => "this table".to_owned(),
            Self::Urdf { label, .. } => label.clone(),
            Self::ConfigString { .. } => "here".to_owned(),
            Self::TwoParents { .. } => "the second joint that moves it".to_owned(),
            Self::RootIsChild { .. } => "the root".to_owned(),
            Self::Detached { .. } => "hangs in the air".to_owned(),
            Self::Cycle { .. } => "this joint".to_owned(),
            Self::Limit { .. } => "this limit".to_owned(),
            Self::Sensor { .. } => "here".to_owned(),
        }
    }

    fn help(&self) -> Option<String> {
        match self {
            Self::Part(part) => part.help(),
            Self::Urdf { help, .. } => help.clone(),
            Self::NoLinks => Some("add a [[links]] table: the first link is the root".to_owned()),
            Self::UnknownLink { help, .. }
            | Self::UnknownJoint { help, .. }
            | Self::UnknownFrame { help, .. }
            | Self::Mimic { help, .. }
            | Self::Loop { help, .. }
            | Self::Dh { help, .. }
            | Self::ConfigString { help, .. }
            | Self::Limit { help, .. }
            | Self::Sensor { help, .. } => Some(help.clone()),
            Self::TwoParents { .. } => {
                Some("a link hangs on one joint; remove one of the two".to_owned())
            }
            Self::RootIsChild { .. } => {
                Some("put the link that stands still first, or turn the joint around".to_owned())
            }
            Self::Detached { root, .. } => Some(format!(
                "add a joint with this link as its child; only `{root}`, the first link, needs none"
            )),
            Self::Cycle { .. } => Some("follow parents to the first link".to_owned()),
        }
    }
}
