//! Scenes: what stands, lies and moves around a robot, and the air and the ground there.
//!
//! A scene file ([`SceneFile`]) becomes a [`Scene`], which says where everything starts. Nothing here steps it.
//!
//! | file | what it holds |
//! |---|---|
//! | `model` | [`Scene`], its bodies and its surroundings |
//! | `motion` | [`Motion`]: a body moved by a given law |
//! | `gust` | [`Gust`]: wind that comes and goes, from a seed |
//! | `file` | the TOML types |
//! | `resolve` | from the tables to the scene |
//! | `problem` | everything that can be wrong with a scene file |

mod file;
mod gust;
mod model;
mod motion;
mod problem;
mod resolve;

pub use crate::air::Drag;
pub use file::SceneFile;
pub use gust::{Gust, GustSequence};
pub use model::{BodyKind, Environment, Scene, SceneBody, Wind};
pub use motion::{Motion, Waypoint};
pub use problem::{SceneError, SceneProblem};
