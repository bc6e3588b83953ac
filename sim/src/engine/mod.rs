//! Contact: robot and scene as bodies of a physics engine. The only module that names rapier; none of its types leave it.
//!
//! | file | what it does |
//! |---|---|
//! | `world` | holds all bodies and steps them |
//! | `arm` | adds the robot as a reduced-coordinate multibody |
//! | `collider` | makes colliders from shapes |
//! | `fresh` | recomputes contact points |
//! | `bounce` | applies restitution |
//! | `contact_facts` | reads the contacts of a step |
//! | `clearance` | says when no link can touch anything |
//! | `overlap` | finds overlaps without a step |
//! | `ray` | casts rays |
//! | `wind` | computes the air of each step |
//! | `engine_settings` | parameters of contact |
//! | `work` | counts what all this costs |

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
pub(crate) mod work;
mod world;

#[doc(hidden)]
pub(crate) use clearance::Clearance;
pub use engine_error::EngineError;
pub use overlap::{Layout, Overlap};
pub(crate) use ray::{LinkShapes, Ray};
pub use work::WorkBudget;
pub use world::BodyState;
pub(crate) use world::{StepFault, World};
