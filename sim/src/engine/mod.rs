//! Contact: robot and scene as bodies that press on each other. The only place that names rapier; no type of it leaves.
//!
//! `world` holds all bodies and steps them, `arm` puts the robot among them as a reduced-coordinate multibody, `shape` makes
//! colliders, `contact` reads who pressed on whom, `clearance` says when nobody can, `wind` blows, `settings` are the numbers.

mod arm;
mod clearance;
pub mod contact;
mod convert;
mod error;
mod settings;
mod shape;
mod wind;
mod world;

pub(crate) use clearance::Clearance;
pub use contact::{ContactFact, Party};
pub use error::EngineError;
pub use world::BodyState;
pub(crate) use world::World;
