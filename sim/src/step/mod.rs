//! One step of a robot: smooth motion by Runge-Kutta alone, or together with contact in a scene.

pub mod hybrid;
mod implicit_damping;
mod joint_limits;
pub(crate) mod local_error;
pub mod smooth;

pub(crate) use implicit_damping::stiffest_joint;
