//! Contact: robot and scene as bodies that press on each other. The only place that names rapier; no type of it leaves.
//!
//! `world` holds all bodies and steps them, `arm` puts the robot among them as a reduced-coordinate multibody, `shape` makes
//! colliders, `fresh` has contact points found anew, `bounce` lets things bounce, `contact` reads who pressed on whom, `clearance` says when nobody can, `overlap`
//! who is in whom where they stand, `ray` looks along a line, `wind` blows, `settings` are the numbers.

mod arm;
mod bounce;
mod clearance;
pub mod contact;
mod convert;
mod error;
mod fresh;
pub mod overlap;
mod ray;
mod settings;
mod shape;
mod wind;
mod world;

pub(crate) use clearance::Clearance;
pub use contact::{ContactFact, Party};
pub use error::EngineError;
pub use overlap::{Layout, Overlap};
pub(crate) use ray::{LinkShapes, Ray};
pub use world::BodyState;
pub(crate) use world::World;
