//! Where frames are ([`forward`]), how they move ([`jacobian`]), and which positions close a robot's loops ([`closure`]).

pub mod closure;
pub mod forward;
pub mod jacobian;
mod motion;

pub use forward::{FramePoses, forward_kinematics};
pub use jacobian::{frame_twist, geometric_jacobian};
