//! A submission tried on one task: its answers to the cases of a function task, or its run of a motion task, and how it ended.
//!
//! A visible run, a hidden run, a level of a robustness sweep and the cases of a function task are all an [`Attempt`].

pub mod answers;
mod attempted;
pub mod branches;
pub mod diverged;
pub mod ended;
pub mod function;
pub mod measure;
pub mod motion;

pub use attempted::Attempt;
pub use ended::{Disclosure, EndReason, Ended, Stage};
