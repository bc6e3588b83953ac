//! Work on many things at once, in this process: the results are in the order of the things, however many threads do it.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use indicatif::ProgressBar;
use kinemark_grader::submission::rhai::STACK_BYTES;

use crate::failure::Failure;
use crate::interrupt;

/// Does `work` on every item, `jobs` at once, and counts in `progress` those for which `counts`.
///
/// # Errors
/// A [`Failure`] where a person interrupts it.
pub(crate) fn in_order<I: Sync, R: Send>(
    items: &[I],
    jobs: usize,
    (progress, counts): (&ProgressBar, impl Fn(&I) -> bool + Sync),
    work: impl Fn(&I) -> R + Sync,
) -> Result<Vec<R>, Failure> {
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, R)>> = Mutex::new(Vec::with_capacity(items.len()));
    let of_thread = || {
        while !interrupt::asked() {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(at) else { break };
            let result = work(item);
            let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
            done.push((at, result));
            if counts(item) {
                progress.inc(1);
            }
        }
    };
    std::thread::scope(|scope| {
        // this thread works as well, and does everything if no other can be had; its stack is as large
        for _ in 1..jobs.min(items.len()) {
            let started = std::thread::Builder::new()
                .stack_size(STACK_BYTES)
                .spawn_scoped(scope, of_thread);
            if started.is_err() {
                break;
            }
        }
        of_thread();
    });
    if interrupt::asked() {
        return Err(Failure::interrupted());
    }
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_by_key(|(at, _)| *at);
    Ok(done.into_iter().map(|(_, result)| result).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_the_order_of_the_items_whatever_the_number_of_jobs() {
        let items: Vec<u64> = (0..50).collect();
        let slow =
            |item: &u64| (0..1000 * (50 - item)).fold(*item, |sum, i| sum.wrapping_mul(31) ^ i);
        let of = |jobs| {
            let progress = (&ProgressBar::hidden(), |item: &u64| *item > 10);
            in_order(&items, jobs, progress, slow).expect("not interrupted")
        };
        assert_eq!(of(1), of(2));
        assert_eq!(of(1), of(100));
    }
}
