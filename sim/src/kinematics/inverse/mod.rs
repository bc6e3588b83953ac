//! Inverse kinematics: joint positions that bring frames to their targets, for any chain, by iteration with fixed budgets.
//!
//! [`inverse_kinematics`] answers one query; [`IkSolver`] keeps its memory for many; [`groups`] solves for several tips in order. For an
//! unreachable target the result is a configuration with its residual, not an error: the best one found, or the last one of a textbook
//! method.
//!
//! [`Method::Auto`] uses damped least squares with damping by the error, inside the joint limits, from the given start and then from
//! starts spread over the joint ranges, until one converges. The other methods are those of the textbooks, with one start each. Nothing
//! is random and nothing reads a clock: the same query has the same answer, bit for bit.

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
