//! Counts copies of values the engine makes without saying so.
//!
//! A list of a thousand vectors is copied in one of the engine's operations, a thousand times as long as that should take. The
//! copy of each vector is ours to make, so it is counted here and charged a little later.

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
