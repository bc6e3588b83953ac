//! Which of a person's files is the submission: the one nearest to the top, and never a guess.
//!
//! Level by level, folders and archives alike: a hand-in file; else a file called `submission`; else the only script. What a report
//! or `out/` holds is not looked into. Two on one level are for a person to choose from, unless they are the same bytes.

#[cfg(test)]
mod examples;
mod outcome;
mod search;
mod what_is_there;

pub use outcome::{Found, MOST_HAND_IN_BYTES, MOST_SUBMISSION_BYTES, Unselected};
pub use search::select;
