//! Keeps the grader's thread and the worker it talks to on one processor.
//!
//! The two take turns: one always waits for the other. On two processors each turn wakes a sleeping one, which costs 50 to 80 µs
//! of a call that itself takes 5; on one it is a switch of context. Where the system has no such choice, or refuses it, nothing
//! but time is lost.

#[cfg(target_os = "linux")]
use rustix::thread::{CpuSet, sched_getaffinity, sched_getcpu, sched_setaffinity};

/// The processors this thread may run on, given back when dropped.
#[derive(Debug, Default)]
pub(crate) struct OneProcessor {
    /// The only one to choose; where there is none, that on which the thread runs.
    #[cfg(target_os = "linux")]
    fixed: Option<usize>,
    #[cfg(target_os = "linux")]
    before: Option<CpuSet>,
}

/// The processors that this process may use; empty where the system does not say.
#[cfg(target_os = "linux")]
pub(crate) fn processors() -> Vec<usize> {
    match sched_getaffinity(None) {
        Ok(set) => (0..CpuSet::MAX_CPU)
            .filter(|cpu| set.is_set(*cpu))
            .collect(),
        Err(_) => Vec::new(),
    }
}

/// The processors that this process may use: this system does not say.
#[cfg(not(target_os = "linux"))]
pub(crate) fn processors() -> Vec<usize> {
    Vec::new()
}

impl OneProcessor {
    /// Always that one.
    #[cfg_attr(
        not(target_os = "linux"),
        expect(unused_variables, reason = "there is no choice on this system")
    )]
    pub(crate) fn fixed(processor: Option<usize>) -> Self {
        Self {
            #[cfg(target_os = "linux")]
            fixed: processor,
            #[cfg(target_os = "linux")]
            before: None,
        }
    }

    /// Stays where the thread runs now, and with it every process started from now on.
    ///
    /// Chosen anew for each worker, so that a choice that turns out busy does not last.
    #[cfg(target_os = "linux")]
    pub(crate) fn choose(&mut self) {
        self.give_back();
        let Ok(before) = sched_getaffinity(None) else {
            return;
        };
        let mut here = CpuSet::new();
        let processor = self.fixed.unwrap_or_else(sched_getcpu);
        if processor < CpuSet::MAX_CPU {
            here.set(processor);
            if sched_setaffinity(None, &here).is_ok() {
                self.before = Some(before);
            }
        }
    }

    /// Goes to the one that was fixed, if one was: a thread begins where the one that started it runs.
    #[cfg(target_os = "linux")]
    pub(crate) fn go_to_fixed(&mut self) {
        if self.fixed.is_some() {
            self.choose();
        }
    }

    /// The processors that stay free beside the chosen one; none where it was fixed, since others have their own work there.
    #[cfg(target_os = "linux")]
    pub(crate) fn others(&self) -> Vec<usize> {
        let (None, Some(before), Ok(here)) = (self.fixed, &self.before, sched_getaffinity(None))
        else {
            return Vec::new();
        };
        (0..CpuSet::MAX_CPU)
            .filter(|cpu| before.is_set(*cpu) && !here.is_set(*cpu))
            .collect()
    }

    #[cfg(target_os = "linux")]
    fn give_back(&mut self) {
        if let Some(before) = self.before.take() {
            // a thread left on one processor is slower, and nothing else
            let _ = sched_setaffinity(None, &before);
        }
    }

    /// No choice on this system.
    #[cfg(not(target_os = "linux"))]
    #[expect(clippy::unused_self, reason = "the same call on every system")]
    pub(crate) fn choose(&mut self) {}

    /// No choice on this system.
    #[cfg(not(target_os = "linux"))]
    #[expect(clippy::unused_self, reason = "the same call on every system")]
    pub(crate) fn go_to_fixed(&mut self) {}

    /// No choice on this system.
    #[cfg(not(target_os = "linux"))]
    #[expect(clippy::unused_self, reason = "the same call on every system")]
    pub(crate) fn others(&self) -> Vec<usize> {
        Vec::new()
    }
}

#[cfg(target_os = "linux")]
impl Drop for OneProcessor {
    fn drop(&mut self) {
        self.give_back();
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn one_while_it_lasts_and_all_afterwards() {
        // a thread of its own: the choice is the thread's
        let thread = std::thread::spawn(|| {
            let before = sched_getaffinity(None).expect("a mask");
            let mut one = OneProcessor::default();
            assert!(one.others().is_empty(), "none is chosen");
            one.choose();
            assert_eq!(sched_getaffinity(None).expect("a mask").count(), 1);
            one.choose();
            assert_eq!(sched_getaffinity(None).expect("a mask").count(), 1);
            assert_eq!(one.others().len() as u32 + 1, before.count());
            drop(one);
            assert_eq!(sched_getaffinity(None).expect("a mask"), before);
        });
        thread.join().expect("no panic");
    }
}
