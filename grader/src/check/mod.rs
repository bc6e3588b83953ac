//! Checks: what is measured, the band in which it is judged, and the evidence where points are lost. One file per [`kind`].

mod alternation;
#[cfg(test)]
mod by_hand;
mod cases;
pub(crate) mod cause;
pub(crate) mod check_schema;
mod contract;
mod disturbance;
#[cfg(test)]
mod documentation;
mod dwell;
mod facts;
mod finding;
mod hints;
mod in_band;
pub mod kind;
mod occurrence;
mod path_following;
mod prediction;
mod prelude;
pub(crate) mod reading;
pub(crate) mod registry;
mod rest_error;
mod segments;
mod shape;
mod signal;
#[cfg(test)]
mod sliding;
mod step_keys;
mod step_response;
mod touching;

pub use contract::{
    Check, Criterion, FromReference, FunctionCheck, MotionCheck, answer_band, dwell_band,
    judge_motion, path_band,
};
pub use disturbance::Level;
pub use dwell::{Dwell, best_dwells};
pub use facts::{MotionFacts, Reached, SweepRuns};
pub use finding::Finding;
pub use kind::{function_cases, robustness};
pub use registry::Kind;
pub use signal::Statistic;
