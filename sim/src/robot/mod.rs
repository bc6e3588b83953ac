//! The robot: a TOML description ([`mod@file`]), arithmetic over its dimensions ([`expression`]), and the immutable model ([`model`])
//! that [`build`] makes of them.

pub mod build;
pub mod expression;
pub mod file;
pub mod inertia;
pub mod model;
pub mod problem;

pub use file::{Dimension, Dimensions, RobotFile};
pub use model::{Frame, Joint, JointKind, Limits, Link, Robot};
pub use problem::{RobotError, RobotProblem};
