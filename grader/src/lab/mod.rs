//! Labs: the TOML types ([`mod@file`]), what they become ([`model`]), the way from one to the other ([`load`], [`robot`], [`scene`]), and the
//! cases that hidden draws add ([`draw`]). A student's numbers ([`variant`]) make a lab like any other: nothing downstream knows.

pub mod brief;
pub mod copies;
pub mod draw;
pub mod file;
pub mod load;
pub mod model;
mod parameters;
pub mod staff;
pub mod variant;

pub use crate::check::Check;
pub use crate::task::{files, jacobian, joint_units, mesh_file, problem, robot, scene, watched};
pub use files::Files;
pub use mesh_file::MeshFile;
pub use model::{Band, Case, FunctionTask, Lab, MotionTask, Task, TaskWork};
pub use problem::{LabError, LabProblem, LoadError};
pub use robot::LabRobot;
pub use scene::LabScene;
pub use staff::Staff;
pub use variant::Variant;
