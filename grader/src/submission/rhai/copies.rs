//! Counts copies of values that the engine makes without counting them.
//!
//! The engine copies a list of a thousand vectors in one operation, although this takes a thousand times as long. The copy of each
//! vector is our code, so it is counted here and charged a little later.

use std::cell::Cell;

thread_local! {
    static COPIES: Cell<usize> = const { Cell::new(0) };
}

/// Counts one copy on this thread.
pub(super) fn count_one() {
    count(1);
}

/// Counts what takes as long as so many copies.
pub(super) fn count(copies: usize) {
    COPIES.set(COPIES.get() + copies);
}

/// The copies since the last time.
pub(super) fn take() -> usize {
    COPIES.take()
}
