//! A test of many cases: they run on all processors, and every one that fails is named, not the first alone.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Runs `check` on every case, `(name, case)`, and fails with the names and messages of all that panicked.
#[track_caller]
pub(crate) fn every_case<C: Sync>(cases: &[(String, C)], check: impl Fn(&C) + Sync) {
    let failed = failures(cases, |case| check(case));
    let said: String = failed
        .iter()
        .map(|(name, message)| format!("\n== {name}\n{message}\n"))
        .collect();
    assert!(
        failed.is_empty(),
        "{} of {} cases fail:\n{said}",
        failed.len(),
        cases.len()
    );
}

/// The cases that panic, in their order, with what they said.
fn failures<C: Sync>(cases: &[(String, C)], check: impl Fn(&C) + Sync) -> Vec<(String, String)> {
    let next = AtomicUsize::new(0);
    let failed = Mutex::new(Vec::new());
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads.min(cases.len()) {
            scope.spawn(|| {
                while let Some((name, case)) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
                    // nothing of a case outlives its panic but the message
                    if let Err(panic) = catch_unwind(AssertUnwindSafe(|| check(case))) {
                        let message = panic.downcast_ref::<String>().map(String::as_str);
                        let message = message.or_else(|| panic.downcast_ref::<&str>().copied());
                        let failure = (name.clone(), message.unwrap_or("no message").to_owned());
                        failed.lock().expect("not poisoned").push(failure);
                    }
                }
            });
        }
    });
    let mut failed = failed.into_inner().expect("not poisoned");
    let place = |name: &String| cases.iter().position(|(known, _)| known == name);
    failed.sort_by_key(|(name, _)| place(name));
    failed
}

#[test]
fn all_cases_run_and_all_failures_are_named() {
    let cases: Vec<(String, u32)> = (0..20).map(|i| (format!("case {i}"), i)).collect();
    let seen = AtomicUsize::new(0);
    let failed = failures(&cases, |i| {
        seen.fetch_add(1, Ordering::Relaxed);
        assert!(i % 7 != 3, "{i} is three more than a multiple of seven");
    });
    assert_eq!(seen.into_inner(), 20);
    let expected = [3, 10, 17].map(|i| {
        let message = format!("{i} is three more than a multiple of seven");
        (format!("case {i}"), message)
    });
    assert_eq!(failed, expected);
}
