//! What is wrong with a scene before anything runs in it: bodies in each other, bodies that do not stay where they are put, places
//! a robot cannot get to.
//!
//! | file | what it looks at |
//! |---|---|
//! | `finding` | [`Finding`]: what there is to tell |
//! | `settle` | ten seconds of the scene alone |
//! | `branch` | the ways in which a robot reaches a place |
//! | `via` | via points, and the straight lines between them |
//!
//! Nothing here is random: the same scene has the same findings, in the same order.

mod branch;
mod checks;
mod finding;
mod settle;
mod via;

pub use checks::{SceneCheckError, TOUCH_M, Work, check};
pub use finding::{Finding, Kind, LineStop, LineStopCause, Severity};
