//! Checks: what is measured, the band it is held against, and the evidence where points are lost. One file per [`kind`].

mod alternation;
#[cfg(test)]
mod by_hand;
mod cases;
mod contract;
#[cfg(test)]
mod documentation;
mod facts;
mod finding;
mod joint_effort;
pub mod kind;
mod prediction;
pub(crate) mod reading;
pub(crate) mod registry;
pub mod road;
#[cfg(test)]
mod sliding;
pub mod stay;
mod step_keys;
mod step_response;

pub use contract::{
    AnyCheck, Check, CheckKind, FirstLoss, FunctionCheck, MotionCheck, answer_band, dwell_band,
    judge_function, judge_motion, path_band,
};
pub use facts::{Climb, MotionFacts};
pub use finding::Finding;
pub use kind::{function_cases, ik_branches, robustness};
pub use reading::ReadingProblem;
pub use registry::{CheckProblem, Kind};
