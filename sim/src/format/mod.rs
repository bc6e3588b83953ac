//! From text to values: the formats of robots, each in a folder of its own, scenes, and strings of joints.
//!
//! A description of a robot, in whatever format, becomes parts with their places in the text; `assembly` makes the robot of them.

mod assembly;
pub mod joint_string;
mod mesh_location;
mod robot_description;
mod robot_format;
mod robot_problem;
mod scene_toml;
mod xml;

macro_rules! robot_formats {
    ($($format:ident)*) => {
        $(mod $format;)*

        /// The formats of robots; of those that a file looks like as much, the first is taken.
        pub const ROBOT_FORMATS: &[RobotFormat] = &[$($format::FORMAT),*];
    };
}

robot_formats! {
    urdf
    robot_toml
}

pub use mesh_location::MeshLocation;
pub use robot_description::{FixedDescription, RobotDescription};
pub use robot_format::{Likeness, NameMesh, ReadFile, ReadOptions, RobotFormat, detect};
pub use robot_problem::{RobotError, RobotProblem};
pub use robot_toml::RobotFile;
pub use scene_toml::{SceneError, SceneFile, SceneProblem};
