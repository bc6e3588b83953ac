//! What is left of an attempt once it is over.

use super::ended::Ended;

/// A submission tried on one task: `T` is the trace of a motion task, or the answers of a function task.
#[derive(Debug)]
pub struct Attempt<T> {
    /// What was recorded, up to the end.
    pub recorded: T,
    /// How it ended, where that was not at its end: of a run, what stopped it; of answers to cases, the first thing that went
    /// wrong, after which the other cases were still called.
    pub ended: Option<Ended>,
    /// Operations used; of a function task those of visible cases.
    pub operations: u64,
}
