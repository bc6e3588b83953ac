//! One step of a robot: smooth motion by Runge-Kutta, between its joint limits, and together with contact in a scene.

pub(crate) mod free;
pub mod hybrid;
mod implicit_damping;
mod joint_limits;
pub(crate) mod local_error;
pub mod smooth;

pub(crate) use implicit_damping::stiffest_joint;
