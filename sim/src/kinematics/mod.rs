//! Where frames are ([`forward`], [`chain`] for one of them in a hurry), how they move ([`jacobian`], [`derivative`],
//! [`analytic`]) and how well ([`manipulability`]), which positions bring them somewhere ([`inverse`]) or close a robot's loops
//! ([`closure`]); where the mass is ([`centre_of_mass`]) and what is in reach ([`workspace`]).

pub mod analytic;
pub(crate) mod body_motion;
pub mod centre_of_mass;
pub mod chain;
pub mod closure;
pub mod derivative;
pub mod forward;
pub mod inverse;
pub mod jacobian;
pub mod joint_samples;
pub mod manipulability;
pub mod position_range;
mod singular_values;
pub mod workspace;

pub use chain::Chain;
pub use forward::{FramePoses, forward_kinematics};
pub use inverse::{IkAnswer, IkError, IkSettings, IkSolver, Method, Target, inverse_kinematics};
pub use jacobian::{frame_twist, geometric_jacobian};
