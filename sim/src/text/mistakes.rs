//! The mistakes of one text, gathered so that they are reported together.

use super::Located;

/// So many mistakes are kept: more than a person mends at once, and each is quoted.
const MOST_MISTAKES: usize = 10;

/// The mistakes so far.
#[derive(Debug)]
pub struct Mistakes<P>(Vec<Located<P>>);

impl<P> Default for Mistakes<P> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<P> Mistakes<P> {
    /// The value, or `None` with its mistake kept.
    pub fn keep<T>(&mut self, read: Result<T, Located<P>>) -> Option<T> {
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
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// All of them as one error, the first in the text in front.
    ///
    /// # Errors
    /// Them, if there are any.
    pub fn finish(self) -> Result<(), Located<P>> {
        Located::first_of(self.0).map_or(Ok(()), Err)
    }
}
