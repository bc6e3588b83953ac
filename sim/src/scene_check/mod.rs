//! What is wrong with a scene before anything runs in it: bodies that overlap, bodies that do not stay where they start, via points
//! that a robot cannot reach.
//!
//! | file | what it looks at |
//! |---|---|
//! | `finding` | [`Finding`]: what a check can find |
//! | `settle` | ten seconds of the scene alone |
//! | `via` | via points, and the straight lines between them |
//! | `progress` | how far a check is, and how much work it may be |
//!
//! Nothing here is random: the same scene has the same findings, in the same order.

mod checks;
mod finding;
mod progress;
mod settle;
mod via;

pub use checks::{SceneCheckError, TOUCH_M, Work, check, check_watched};
pub use finding::{Finding, Kind, LineStop, LineStopCause, Severity, Unchecked};
pub use progress::{Progress, Stage};
