//! What is wrong with a scene before anything runs in it, as text for people and as JSON for programs.

mod checked_scene;
mod finding_message;
mod finding_record;
mod finding_text;

pub use checked_scene::{ArmInScene, CheckedScene, SceneToCheck};
pub use finding_record::scene_record;
pub use finding_text::scene_text;
