//! Kinematics: poses of frames ([`forward`]; [`chain`] for one frame at high speed), their motion ([`jacobian`], [`derivative`],
//! [`analytic`], [`manipulability`]), inverse kinematics ([`inverse`]), closed loops ([`closure`]), the [`centre_of_mass`], the
//! reachable [`workspace`], and the arm as a line ([`stick_figure`]).

pub mod analytic;
pub(crate) mod body_motion;
pub mod branches;
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
mod stick_figure;
pub mod workspace;

pub use chain::Chain;
pub use forward::{FramePoses, forward_kinematics};
pub use inverse::{IkAnswer, IkError, IkSettings, IkSolver, Method, Target, inverse_kinematics};
pub use jacobian::{frame_twist, geometric_jacobian};
pub use stick_figure::stick_figure;
