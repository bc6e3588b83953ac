//! Values: what a robot, a scene and a sensor are, once their descriptions are read. Nothing here reads, moves or steps.

pub mod air;
pub mod contact;
pub mod drive;
pub mod extent;
pub mod gust;
pub mod inertia;
pub mod joint_friction;
pub mod mesh;
mod perturbed;
pub mod prescribed_motion;
pub mod push;
pub mod robot;
pub mod scene;
pub mod sensor;
pub mod unphysical;
