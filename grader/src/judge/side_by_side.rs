//! Runs of one submission at the same time, on the hosts that there are for them: the results are in order, however many hosts made them.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::submission::host::Host;

/// What `run` makes of each item, in their order: with `host`, and with those beside it.
///
/// # Errors
/// The first error in the order of the items. Items behind it may not have been run.
pub(super) fn in_order<I: Sync, R: Send, E: Send>(
    items: &[I],
    host: &mut dyn Host,
    run: impl Fn(&I, &mut dyn Host) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E> {
    let others = match items.len() {
        0 | 1 => Vec::new(),
        several => host.beside(several - 1),
    };
    let next = AtomicUsize::new(0);
    let has_failed = AtomicBool::new(false);
    let done: Mutex<Vec<(usize, Result<R, E>)>> = Mutex::new(Vec::with_capacity(items.len()));
    let work = |host: &mut dyn Host| {
        while !has_failed.load(Ordering::Relaxed) {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(at) else { break };
            let result = run(item, host);
            has_failed.fetch_or(result.is_err(), Ordering::Relaxed);
            let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
            done.push((at, result));
        }
    };
    std::thread::scope(|scope| {
        let work = &work;
        for mut other in others {
            let thread = std::thread::Builder::new();
            // this thread does everything if no other can be had
            if thread
                .spawn_scoped(scope, move || work(&mut *other))
                .is_err()
            {
                break;
            }
        }
        work(host);
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    // each item before one that failed was taken before it
    done.sort_by_key(|(at, _)| *at);
    done.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::submission::controller::{Controller, Failed, Opening};
    use crate::submission::host::InProcess;

    /// A host with others beside it, which counts how often any of them is used.
    struct Several {
        others: usize,
        used: Arc<AtomicUsize>,
        is_other: bool,
    }

    impl Host for Several {
        fn open(&mut self, _: &Opening) -> Result<Box<dyn Controller>, Box<Failed>> {
            unreachable!("nothing is opened")
        }

        fn begins(&mut self, _: &str) {
            self.used
                .fetch_add(usize::from(self.is_other), Ordering::Relaxed);
        }

        fn beside(&mut self, most: usize) -> Vec<Box<dyn Host + Send>> {
            let one = || {
                Box::new(Self {
                    others: 0,
                    used: Arc::clone(&self.used),
                    is_other: true,
                }) as Box<dyn Host + Send>
            };
            (0..self.others.min(most)).map(|_| one()).collect()
        }
    }

    #[test]
    fn results_are_in_the_order_of_the_items_and_other_hosts_work() {
        let items: Vec<u64> = (0..50).collect();
        let used = Arc::new(AtomicUsize::new(0));
        let barrier = std::sync::Barrier::new(4);
        let mut host = Several {
            others: 3,
            used: Arc::clone(&used),
            is_other: false,
        };
        let run = |item: &u64, host: &mut dyn Host| {
            host.begins("");
            // the first of each host: none does all the work
            if *item < 4 {
                barrier.wait();
            }
            Ok::<u64, ()>(item * item)
        };
        let squares = in_order(&items, &mut host, run).expect("no error");
        assert_eq!(squares, (0..50).map(|i| i * i).collect::<Vec<u64>>());
        assert!(used.load(Ordering::Relaxed) >= 3, "three others");
        let alone = in_order(&items, &mut InProcess, |item, _| Ok::<u64, ()>(item * item));
        assert_eq!(alone.expect("no error"), squares);
    }

    #[test]
    fn the_first_error_in_the_order_of_the_items_is_the_error() {
        let items: Vec<usize> = (0..40).collect();
        let run = |item: &usize, _: &mut dyn Host| match item {
            7 | 8 | 30 => Err(*item),
            _ => Ok(*item),
        };
        for others in [0, 1, 5] {
            let mut host = Several {
                others,
                used: Arc::default(),
                is_other: false,
            };
            assert_eq!(in_order(&items, &mut host, run), Err(7), "{others}");
        }
    }

    #[test]
    fn one_item_needs_no_other_host_and_none_gives_nothing() {
        let used = Arc::new(AtomicUsize::new(0));
        let mut host = Several {
            others: 2,
            used: Arc::clone(&used),
            is_other: false,
        };
        let run = |item: &u8, host: &mut dyn Host| {
            host.begins("");
            Ok::<u8, ()>(*item)
        };
        assert_eq!(in_order(&[3], &mut host, run), Ok(vec![3]));
        assert_eq!(in_order(&[], &mut host, run), Ok(vec![]));
        assert_eq!(used.load(Ordering::Relaxed), 0);
    }
}
