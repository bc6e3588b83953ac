//! Rubric mutation testing: small changes of the reference solution, each graded as a submission. What no check notices is either right,
//! or a hole in the rubric.
//!
//! | file | what it holds |
//! |---|---|
//! | `operators` | the kinds of changes, and where they can be made |
//! | `mutation` | one change, and which of them are drawn |
//! | `influence` | the tasks that a change can reach |
//! | `trial` | a change graded: caught by which checks, equivalent, or survived |
//! | `report` | all of them together, beside what the course staff accept |

mod influence;
mod mutation;
mod operators;
mod report;
#[cfg(test)]
mod tests;
mod trial;

pub use self::mutation::{Mutation, drawn, mutations};
pub use self::operators::OperatorName;
pub use self::report::{
    CheckCatches, LEAST_CAUGHT, MutationProblem, MutationReport, TriedMutation,
};
pub(super) use self::report::{covers, no_mutation};
pub use self::trial::{Bench, Catch, Fate, LosingSolution};
