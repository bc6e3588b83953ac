//! Scene files: TOML, with the shapes, masses and surfaces of robot files.

mod scene_motion;
mod scene_problem;
mod scene_reader;
mod scene_tables;

pub use scene_problem::{SceneError, SceneProblem};
pub use scene_tables::SceneFile;
