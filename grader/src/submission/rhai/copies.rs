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
    COPIES.set(COPIES.get() + 1);
}

/// The copies since the last time.
pub(super) fn take() -> usize {
    COPIES.take()
}
