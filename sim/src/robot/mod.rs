//! The robot: its descriptions and the immutable [`model`] that each of them ends in.
//!
//! A robot file ([`mod@file`], with arithmetic over its dimensions in [`expression`]), a URDF ([`urdf`]) or a configuration
//! string ([`config_string`]) becomes parts with places; the parts become the robot, which can be written as a robot file again.
//! What robot files share with scene files is in [`part`].

mod assemble;
mod burdened;
pub mod config_string;
mod description;
pub mod expression;
pub mod extent;
pub mod file;
pub mod inertia;
pub mod mesh;
pub mod model;
pub mod part;
pub mod problem;
mod resolve;
pub mod urdf;
mod write;

pub use file::{Dimension, Dimensions, RobotFile};
pub use model::{Frame, Joint, JointKind, Limits, Link, Robot};
pub use problem::{RobotError, RobotProblem};
