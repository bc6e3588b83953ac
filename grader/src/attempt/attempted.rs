//! The result of an attempt.

use super::ended::Ended;

/// A submission tried on one task: `T` is the trace of a motion task, or the answers of a function task.
#[derive(Debug, Clone)]
pub struct Attempt<T> {
    /// What was recorded, up to the end.
    pub recorded: T,
    /// How it ended early, if it did: what stopped a run, or the first failure among the answers to cases, after which the other cases
    /// were still called. A run in which one call of `control` failed goes on, so its record may be whole all the same.
    pub ended: Option<Ended>,
    /// Operations used; in a function task those of visible cases.
    pub operations: u64,
}
