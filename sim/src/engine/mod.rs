//! Contact: the robot's links and the scene's bodies in one world. The only module that names parry; none of its types leave it.
//!
//! | file | what it does |
//! |---|---|
//! | `world` | holds everything and steps it |
//! | `arm` | says how the robot's joints see and answer to impulses |
//! | `free_body`, `rotation` | a dynamic body, its flight and its free rotation |
//! | `collider` | makes shapes |
//! | `pairs` | finds what is near, and the contact points |
//! | `contacts` | makes the constraints of a step and moves everything |
//! | `rows`, `settle` | constraint rows, and the impulses along them |
//! | `press`, `disk` | normal impulses of a patch, friction of a point |
//! | `contact_facts` | reads the contacts of a step |
//! | `rest` | lets what rests sleep |
//! | `clearance` | says when no link can touch anything |
//! | `overlap` | finds overlaps without a step |
//! | `ray` | casts rays |
//! | `wind` | computes the air of each step |
//! | `engine_settings` | parameters of contact |
//! | `work` | counts what all this costs |

mod anderson;
mod arm;
mod clearance;
mod collider;
mod contact_facts;
mod contacts;
mod convert;
mod disk;
mod engine_error;
mod engine_settings;
mod free_body;
pub mod overlap;
mod pairs;
mod press;
mod ray;
mod rest;
mod rotation;
mod rows;
mod settle;
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
pub(crate) use world::{ArmStep, StepFault, World};
