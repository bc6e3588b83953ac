//! Everything that can be wrong with a robot's description.

use crate::source::{Located, Problem};

/// A problem in a robot description, with its place.
pub type RobotError = Located<RobotProblem>;

/// What is wrong with a robot description.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message says what its variant is")]
pub enum RobotProblem {
    #[error("{message}")]
    Toml {
        message: String,
        help: Option<String>,
    },
    #[error("robot format {found} is not known")]
    UnknownFormat { found: i64 },
    #[error("{message}")]
    Expression {
        message: String,
        help: Option<String>,
    },
    #[error("a robot needs at least one link")]
    NoLinks,
    #[error("{what} `{name}` is there twice")]
    Duplicate { what: &'static str, name: String },
    #[error("{what} name {name:?} cannot be used")]
    BadName { what: &'static str, name: String },
    #[error("no link is called `{name}`")]
    UnknownLink { name: String, help: String },
    #[error("no joint is called `{name}`")]
    UnknownJoint { name: String, help: String },
    #[error("{found} links are more than a robot may have ({most})")]
    TooLarge { found: usize, most: usize },
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
    Axis { message: String },
    #[error("{what} must be {expected}, got {found}")]
    OutOfRange {
        what: String,
        expected: &'static str,
        found: String,
    },
    #[error("{message}")]
    Inertia { message: String, help: String },
    #[error("{message}")]
    Origin { message: String, help: String },
    #[error("{message}")]
    Mesh {
        message: String,
        help: Option<String>,
    },
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
    #[error("no dimension `{name}` in this robot")]
    UnknownDimension { name: String, help: String },
    #[error("dimension `{name}` is {expected} and cannot become {found}")]
    DimensionShape {
        name: String,
        expected: String,
        found: String,
    },
}

impl Problem for RobotProblem {
    fn code(&self) -> &'static str {
        match self {
            Self::Toml { .. } => "robot::toml",
            Self::UnknownFormat { .. } => "robot::unknown_format",
            Self::Expression { .. } => "robot::expression",
            Self::NoLinks => "robot::no_links",
            Self::Duplicate { .. } => "robot::duplicate",
            Self::BadName { .. } => "robot::bad_name",
            Self::UnknownLink { .. } => "robot::unknown_link",
            Self::UnknownJoint { .. } => "robot::unknown_joint",
            Self::TooLarge { .. } => "robot::too_large",
            Self::Mesh { .. } => "robot::mesh",
            Self::Mimic { .. } => "robot::mimic",
            Self::Loop { .. } => "robot::loop",
            Self::Dh { .. } => "robot::dh",
            Self::Urdf { .. } => "robot::urdf",
            Self::ConfigString { .. } => "robot::config_string",
            Self::TwoParents { .. } => "robot::two_parents",
            Self::RootIsChild { .. } => "robot::root_is_child",
            Self::Detached { .. } => "robot::detached",
            Self::Cycle { .. } => "robot::cycle",
            Self::Axis { .. } => "robot::axis",
            Self::OutOfRange { .. } => "robot::out_of_range",
            Self::Inertia { .. } => "robot::inertia",
            Self::Origin { .. } => "robot::origin",
            Self::Limit { .. } => "robot::limit",
            Self::UnknownDimension { .. } => "robot::unknown_dimension",
            Self::DimensionShape { .. } => "robot::dimension_shape",
        }
    }

    fn label(&self) -> String {
        match self {
            Self::Toml { .. } => "here".to_owned(),
            Self::UnknownFormat { .. } => "this version reads format 1".to_owned(),
            Self::Expression { .. } => "in this expression".to_owned(),
            Self::NoLinks => "no [[links]]".to_owned(),
            Self::Duplicate { .. } => "the second one".to_owned(),
            Self::BadName { .. } => "this name".to_owned(),
            Self::UnknownLink { .. } => "not a link of this robot".to_owned(),
            Self::UnknownJoint { .. } => "not a joint of this robot".to_owned(),
            Self::TooLarge { .. } => "this robot".to_owned(),
            Self::Mesh { .. } => "this mesh".to_owned(),
            Self::Mimic { .. } => "this mimic".to_owned(),
            Self::Loop { .. } => "this loop".to_owned(),
            Self::Dh { .. } => "this table".to_owned(),
            Self::Urdf { label, .. } => label.clone(),
            Self::ConfigString { .. } => "here".to_owned(),
            Self::TwoParents { .. } => "the second joint that moves it".to_owned(),
            Self::RootIsChild { .. } => "the root".to_owned(),
            Self::Detached { .. } => "hangs in the air".to_owned(),
            Self::Cycle { .. } => "this joint".to_owned(),
            Self::Axis { .. } => "this axis".to_owned(),
            Self::OutOfRange { .. } => "out of range".to_owned(),
            Self::Inertia { .. } => "this inertia".to_owned(),
            Self::Origin { .. } => "this origin".to_owned(),
            Self::Limit { .. } => "this limit".to_owned(),
            Self::UnknownDimension { .. } | Self::DimensionShape { .. } => {
                "the dimensions of this robot".to_owned()
            }
        }
    }

    fn help(&self) -> Option<String> {
        match self {
            Self::Toml { help, .. }
            | Self::Expression { help, .. }
            | Self::Mesh { help, .. }
            | Self::Urdf { help, .. } => help.clone(),
            Self::UnknownFormat { .. } => Some("write `format = 1`".to_owned()),
            Self::NoLinks => Some("add a [[links]] table: the first link is the root".to_owned()),
            Self::Duplicate { .. } => Some("give each its own name".to_owned()),
            Self::BadName { .. } => {
                Some("a name is not empty, and `world` is taken by the world itself".to_owned())
            }
            Self::UnknownLink { help, .. }
            | Self::UnknownJoint { help, .. }
            | Self::Mimic { help, .. }
            | Self::Loop { help, .. }
            | Self::Dh { help, .. }
            | Self::ConfigString { help, .. }
            | Self::Inertia { help, .. }
            | Self::Origin { help, .. }
            | Self::Limit { help, .. }
            | Self::UnknownDimension { help, .. } => Some(help.clone()),
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
            Self::Axis { .. } => {
                Some("an axis has three numbers, in the child's frame, not all zero".to_owned())
            }
            Self::TooLarge { .. } => Some("leave out links that nothing needs".to_owned()),
            Self::OutOfRange { .. } | Self::DimensionShape { .. } => None,
        }
    }
}
