//! Ranges of integers, `0..n` and `0..=n`.

use std::ops;

use rhai::{Dynamic, INT};

use super::copies;

/// The integers from a start up to, but without, an end.
#[derive(Debug)]
pub(super) struct Range {
    pub(super) from: INT,
    pub(super) to: INT,
}

impl Clone for Range {
    fn clone(&self) -> Self {
        copies::count_one();
        Self {
            from: self.from,
            to: self.to,
        }
    }
}

impl Range {
    /// A value as a range: one of ours, or one of the engine's, which it makes from literals in an index or argument.
    pub(super) fn of(value: &Dynamic) -> Option<Self> {
        if let Some(range) = value.read_lock::<Self>() {
            return Some(range.clone());
        }
        if let Some(range) = value.read_lock::<ops::Range<INT>>() {
            let (from, to) = (range.start, range.end);
            return Some(Self { from, to });
        }
        let range = value.read_lock::<ops::RangeInclusive<INT>>()?;
        let (from, to) = (*range.start(), range.end().saturating_add(1));
        Some(Self { from, to })
    }

    pub(super) fn contains(&self, whole: INT) -> bool {
        (self.from..self.to).contains(&whole)
    }
}

impl IntoIterator for Range {
    type Item = INT;
    type IntoIter = ops::Range<INT>;

    fn into_iter(self) -> Self::IntoIter {
        self.from..self.to
    }
}
