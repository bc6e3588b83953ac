//! One step of a robot: smooth motion by Runge-Kutta alone, or together with contact in a scene.

pub mod hybrid;
mod joint_limits;
pub mod smooth;
