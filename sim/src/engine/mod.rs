//! Contact: robot and scene as bodies that press on each other. The only place that names rapier; no type of it leaves.
//!
//! `world` holds all bodies and steps them, `arm` puts the robot among them as a reduced-coordinate multibody, `collider` makes
//! colliders, `fresh` has contact points found anew, `bounce` lets things bounce, `contact_facts` reads who pressed on whom, `clearance` says when nobody can, `overlap`
//! who is in whom where they stand, `ray` looks along a line, `wind` blows, `engine_settings` are the numbers.

mod arm;
mod bounce;
mod clearance;
mod collider;
mod contact_facts;
mod convert;
mod engine_error;
mod engine_settings;
mod fresh;
pub mod overlap;
mod ray;
mod wind;
mod world;

#[doc(hidden)]
pub(crate) use clearance::Clearance;
pub use engine_error::EngineError;
pub use overlap::{Layout, Overlap};
pub(crate) use ray::{LinkShapes, Ray};
pub use world::BodyState;
pub(crate) use world::World;
