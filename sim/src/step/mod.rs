//! One step of a robot: what its drives deliver; smooth motion by Runge-Kutta, between its joint limits, and together with contact in a
//! scene.

pub mod drives;
pub(crate) mod free;
pub mod hybrid;
mod implicit_damping;
mod joint_drive;
mod joint_limits;
pub(crate) mod local_error;
pub mod smooth;

pub(crate) use implicit_damping::stiffest_joint;
