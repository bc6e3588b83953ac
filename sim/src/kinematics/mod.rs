//! Where frames are ([`forward`]) and how they move ([`jacobian`]).

pub mod forward;
pub mod jacobian;

pub use forward::{FramePoses, forward_kinematics};
pub use jacobian::{frame_twist, geometric_jacobian};
