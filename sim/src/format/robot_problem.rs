//! Everything that can be wrong with a robot's description.

use crate::part::part_problem::{PartError, PartProblem};
use crate::text::{Located, Problem};

/// What messages call the description of a robot, whatever its format.
pub(crate) const KIND: &str = "robot";

/// A problem in a robot description, with its place.
pub type RobotError = Located<RobotProblem>;

impl From<PartError> for RobotError {
    fn from(error: PartError) -> Self {
        error.map(RobotProblem::Part)
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
    Limit { message: String, help: String },
    /// A problem that only one format or one kind of table has, which says all there is to say of it.
    #[error("{message}")]
    Own {
        code: &'static str,
        message: String,
        label: String,
        help: Option<String>,
    },
}

impl Problem for RobotProblem {
    fn code(&self) -> &'static str {
        match self {
            Self::Part(part) => part.codes().robot,
            Self::NoLinks => "robot::no_links",
            Self::Mimic { .. } => "robot::mimic",
            Self::Loop { .. } => "robot::loop",
            Self::TwoParents { .. } => "robot::two_parents",
            Self::RootIsChild { .. } => "robot::root_is_child",
            Self::Detached { .. } => "robot::detached",
            Self::Cycle { .. } => "robot::cycle",
            Self::Limit { .. } => "robot::limit",
            Self::Own { code, .. } => code,
        }
    }

    fn label(&self) -> String {
        match self {
            Self::Part(part) => part.label(),
            Self::NoLinks => "no [[links]]".to_owned(),
            Self::Mimic { .. } => "this mimic".to_owned(),
            Self::Loop { .. } => "this loop".to_owned(),
            Self::TwoParents { .. } => "the second joint that moves it".to_owned(),
            Self::RootIsChild { .. } => "the root".to_owned(),
            Self::Detached { .. } => "not connected to the root link".to_owned(),
            Self::Cycle { .. } => "this joint".to_owned(),
            Self::Limit { .. } => "this limit".to_owned(),
            Self::Own { label, .. } => label.clone(),
        }
    }

    fn help(&self) -> Option<String> {
        match self {
            Self::Part(part) => part.help(),
            Self::Own { help, .. } => help.clone(),
            Self::NoLinks => Some("add a [[links]] table: the first link is the root".to_owned()),
            Self::Mimic { help, .. } | Self::Loop { help, .. } | Self::Limit { help, .. } => {
                Some(help.clone())
            }
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
