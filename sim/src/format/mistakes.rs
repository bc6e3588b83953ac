//! The mistakes of one description, gathered so that they are reported together.

use super::robot_problem::RobotError;

/// So many mistakes are kept: more than a person mends at once, and each has a copy of the text.
const MOST_MISTAKES: usize = 10;

/// The mistakes so far.
#[derive(Debug, Default)]
pub(super) struct Mistakes(Vec<RobotError>);

impl Mistakes {
    /// The value, or `None` with its mistake kept.
    pub(super) fn keep<T>(&mut self, read: Result<T, RobotError>) -> Option<T> {
        match read {
            Ok(value) => Some(value),
            Err(error) => {
                if self.0.len() < MOST_MISTAKES {
                    self.0.push(error);
                }
                None
            }
        }
    }

    /// Whether there are any.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// All of them as one error, the first in the text in front.
    pub(super) fn finish(self) -> Result<(), RobotError> {
        RobotError::first_of(self.0).map_or(Ok(()), Err)
    }
}
