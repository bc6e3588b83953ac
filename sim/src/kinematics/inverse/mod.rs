//! Inverse kinematics: joint positions that bring frames to their targets, for any chain, by iteration with fixed budgets.
//!
//! [`inverse_kinematics`] answers one question; [`IkSolver`] keeps its room for many; [`groups`] solves for several tips in order.
//! A target out of reach is answered with the best position found and what is left there, not with an error.
//!
//! [`Method::Auto`] goes by damped least squares that adapts to the error, inside the joint limits, from the start given and then
//! from positions spread over the joint ranges, until one arrives. The other methods are those of the textbooks, one start each.
//! Nothing is random and nothing looks at a clock: the same question has the same answer, bit for bit.

mod adaptive;
pub mod groups;
mod ik_settings;
mod ik_step;
mod mechanism;
mod null_space;
mod query;
mod solver;
mod system;
mod target;
mod textbook;

pub use ik_settings::{ErrorClamp, IkSettings, MOST_ITERATIONS, Method, Posture};
pub use query::{Goal, IkAnswer, IkError, inverse_kinematics};
pub use solver::IkSolver;
pub use target::Target;
