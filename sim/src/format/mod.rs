//! From text to values: the formats of robots, scenes, sensors and meshes, each in a folder or a file of its own.
//!
//! A description of a robot, in whatever format, becomes parts with their places in the text; `assembly` makes the robot of them.

mod assembly;
mod detect;
pub mod joint_string;
mod mesh_file;
mod part;
mod robot_problem;
mod robot_toml;
mod scene_toml;
mod sensor_toml;
pub mod urdf;

pub use detect::{RobotFormat, detect};
pub use part::PartProblem;
pub use robot_problem::{RobotError, RobotProblem};
pub use robot_toml::RobotFile;
pub use scene_toml::{SceneError, SceneFile, SceneProblem};
pub use sensor_toml::{SensorProblem, SensorTable, resolve, resolve_all};
