//! Many submissions graded at once: a thread a slot, each with a processor of its own that it shares with its worker.

use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use kinemark_grader::submission::rhai::STACK_BYTES;

use crate::interrupt;
use crate::one_processor;
use crate::worker::WorkerHost;

/// How many are graded at once where nobody says: one a processor.
pub(crate) fn default_jobs() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}

/// A slot that works longer than this on one submission has a line of its own.
const STUCK_AFTER: Duration = Duration::from_secs(5);
/// How often the lines are looked at.
const LOOK: Duration = Duration::from_millis(200);

/// What a slot does at the moment.
#[derive(Default)]
struct Slot {
    working: Option<(String, Instant)>,
    line: Option<ProgressBar>,
}

/// Progress of a pool, on a terminal.
struct Progress {
    lines: MultiProgress,
    bar: ProgressBar,
    failures: usize,
}

impl Progress {
    fn new(count: usize) -> Self {
        let lines = MultiProgress::new();
        let bar = lines.add(ProgressBar::new(count as u64));
        let style = "{pos}/{len} {wide_bar} {per_sec}, {eta} left {msg}";
        if let Ok(style) = ProgressStyle::with_template(style) {
            bar.set_style(style);
        }
        Self {
            lines,
            bar,
            failures: 0,
        }
    }

    fn done(&mut self, has_failed: bool) {
        self.bar.inc(1);
        if has_failed {
            self.failures += 1;
            self.bar.set_message(format!("{} failed", self.failures));
        }
    }

    /// A line for each slot that is stuck, and none for the others.
    fn look(&self, slots: &[Mutex<Slot>]) {
        for slot in slots {
            let mut slot = slot.lock().unwrap_or_else(PoisonError::into_inner);
            let stuck = slot.working.as_ref().and_then(|(name, since)| {
                let elapsed = since.elapsed();
                (elapsed >= STUCK_AFTER).then(|| format!("  {name}: {} s", elapsed.as_secs()))
            });
            match (stuck, &slot.line) {
                (Some(text), Some(line)) => line.set_message(text),
                (Some(text), None) => {
                    let line = self.lines.add(ProgressBar::no_length());
                    if let Ok(style) = ProgressStyle::with_template("{msg}") {
                        line.set_style(style);
                    }
                    line.set_message(text);
                    slot.line = Some(line);
                }
                (None, Some(line)) => {
                    line.finish_and_clear();
                    slot.line = None;
                }
                (None, None) => {}
            }
        }
    }
}

/// Runs `work` on every item, `jobs` at once, and hands each result to `done` on this thread, in the order in which they end. `name`
/// is what an item is called in the progress; `done` says whether the result is a failure, and ends everything with an error.
///
/// # Errors
/// What `done` says.
pub(crate) fn run<I: Sync, R: Send, E>(
    items: &[I],
    jobs: usize,
    name: impl Fn(&I) -> String + Sync,
    work: impl Fn(&I, &mut WorkerHost) -> R + Sync,
    mut done: impl FnMut(&I, R) -> Result<bool, E>,
) -> Result<(), E> {
    let jobs = jobs.clamp(1, items.len().max(1));
    let processors = one_processor::processors();
    // with fewer slots than processors, others may work here as well, such as another part of the class: no processor is then fixed
    let processors = if jobs < processors.len() {
        Vec::new()
    } else {
        processors
    };
    let next = AtomicUsize::new(0);
    let slots: Vec<Mutex<Slot>> = (0..jobs).map(|_| Mutex::default()).collect();
    let mut progress = Progress::new(items.len());
    let (results, waiting) = channel();
    let work_of_slot = |number: usize, results: &Sender<(usize, R)>| {
        let mut host = WorkerHost::on(processors.get(number % processors.len().max(1)).copied());
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(at) else { break };
            if interrupt::asked() {
                break;
            }
            set(&slots[number], Some((name(item), now())));
            let result = work(item, &mut host);
            set(&slots[number], None);
            if results.send((at, result)).is_err() {
                break;
            }
        }
    };
    std::thread::scope(|scope| {
        for number in 0..jobs {
            let results = results.clone();
            let work_of_slot = &work_of_slot;
            let started = std::thread::Builder::new()
                // the mutants run in this process and may nest as deep as their budgets allow
                .stack_size(2 * STACK_BYTES)
                .spawn_scoped(scope, move || work_of_slot(number, &results));
            // a slot that cannot be had makes it slower; without any, nothing is done and whoever called sees so
            if started.is_err() {
                break;
            }
        }
        drop(results);
        let mut ended = Ok(());
        loop {
            match waiting.recv_timeout(LOOK) {
                Ok((at, result)) => match done(&items[at], result) {
                    Ok(has_failed) => progress.done(has_failed),
                    Err(error) => {
                        ended = Err(error);
                        // the slots end with what they have begun
                        next.store(items.len(), Ordering::Relaxed);
                    }
                },
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            progress.look(&slots);
        }
        progress.bar.finish_and_clear();
        ended
    })
}

#[expect(
    clippy::disallowed_methods,
    reason = "the progress of people's terminals; no grade knows it"
)]
fn now() -> Instant {
    Instant::now()
}

fn set(slot: &Mutex<Slot>, working: Option<(String, Instant)>) {
    slot.lock().unwrap_or_else(PoisonError::into_inner).working = working;
}
