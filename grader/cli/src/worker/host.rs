//! Starts workers for the tasks of a submission, and keeps one that may serve on.
//!
//! A worker serves one submission: starting a process costs as much as some hundred calls, so one that is still fresh is kept for the
//! next task or hidden run of the same file, where the code is opened anew. Never is it kept for another file, nor after a stop.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use kinemark_grader::submission::controller::{
    Answer, Budgets, Call, Controller, Failed, Opening, Said, Stop,
};
use kinemark_grader::submission::handed_in::Program;
use kinemark_grader::submission::host::Host;

use super::process::{Spent, WALL_CLOCK, Worker};
use super::wire::{Reply, Request};
use crate::interrupt;
use crate::one_processor::OneProcessor;

/// The parent's side: starts workers, and keeps one that may serve on.
pub(crate) struct WorkerHost {
    progress: Option<indicatif::ProgressBar>,
    processor: OneProcessor,
    kept: Kept,
    /// The submission at work, and the time that its workers have taken.
    spent: Option<(blake3::Hash, Spent)>,
    /// How long the workers of one submission may take together.
    pub(crate) longest: Duration,
}

/// Most hosts beside one: each has a worker with memory of its own, and no check has more than ten levels.
const MOST_BESIDE: usize = 9;

/// Where a worker waits for the next task of its submission.
type Kept = Arc<Mutex<Option<Worker>>>;

impl WorkerHost {
    pub(crate) fn new(progress: Option<indicatif::ProgressBar>) -> Self {
        Self {
            progress,
            processor: OneProcessor::default(),
            kept: Kept::default(),
            spent: None,
            longest: WALL_CLOCK,
        }
    }

    /// One without progress, whose workers run on `processor`.
    pub(crate) fn on(processor: Option<usize>) -> Self {
        Self {
            processor: OneProcessor::fixed(processor),
            ..Self::new(None)
        }
    }

    /// Takes the progress bar off the terminal.
    pub(crate) fn finish(&self) {
        if let Some(progress) = &self.progress {
            progress.finish_and_clear();
        }
    }

    /// The time that the workers of a submission have taken so far.
    fn spent(&mut self, submission: blake3::Hash) -> Spent {
        match &self.spent {
            Some((known, spent)) if *known == submission => spent.clone(),
            _ => {
                let spent = Spent::none_of(self.longest);
                self.spent = Some((submission, spent.clone()));
                spent
            }
        }
    }
}

impl Host for WorkerHost {
    fn open(&mut self, opening: &Opening) -> Result<Box<dyn Controller>, Box<Failed>> {
        if interrupt::asked() {
            return Err(Stop::Interrupted.into());
        }
        let submission = digest_of(opening);
        // the worker that is kept is there, this thread may be a new one
        self.processor.go_to_fixed();
        let kept = self
            .kept
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .take();
        let mut worker = match kept.filter(|kept| kept.may_serve(submission, &opening.program)) {
            Some(kept) => kept,
            None => {
                // before the worker is started: it inherits the choice
                self.processor.choose();
                let ahead = match opening.program {
                    Program::Python(_) => self.processor.others(),
                    Program::Script(_) | Program::Module(_) => Vec::new(),
                };
                let started = Worker::start(submission, self.spent(submission), &ahead);
                started.map_err(|error| {
                    Stop::GraderFault(format!("a worker process could not be started: {error}"))
                })?
            }
        };
        match worker.exchange(&Request::Open(opening))? {
            Reply::Opened => Ok(Box::new(Lease {
                held: Held::to(opening),
                worker: Some(worker),
                is_sound: true,
                unanswered: Said::default(),
                home: Arc::clone(&self.kept),
            })),
            Reply::Stopped(stop, said) => {
                let said = said.said();
                if Held::to(opening).take(0, &said) {
                    let stop = stop.stop();
                    Err(Box::new(Failed { stop, said }))
                } else {
                    Err(beyond().into())
                }
            }
            Reply::Ready(_) | Reply::Answered(_) | Reply::Tried(_) => {
                Err(broken("another reply than it was asked for").into())
            }
        }
    }

    fn begins(&mut self, task: &str) {
        if let Some(progress) = &self.progress {
            progress.set_message(task.to_owned());
            progress.inc(1);
        }
    }

    fn beside(&mut self, most: usize) -> Vec<Box<dyn Host + Send>> {
        let free = self.processor.others().into_iter();
        // their workers are not kept for the next task: a worker ends with the thread that started it
        let hosts = free.take(most.min(MOST_BESIDE)).map(|processor| {
            Box::new(Self {
                // what one submission may take is for all of its workers together
                spent: self.spent.clone(),
                longest: self.longest,
                ..Self::on(Some(processor))
            }) as Box<dyn Host + Send>
        });
        hosts.collect()
    }
}

/// The digest of a submission, with the name of its file.
fn digest_of(opening: &Opening) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&(opening.file.len() as u64).to_le_bytes());
    hasher.update(opening.file.as_bytes());
    hasher.update(opening.program.bytes());
    hasher.finalize()
}

/// The stop for a worker that does not keep to the rules of the exchange: nothing is decided, and staff look at it.
fn broken(what: &str) -> Stop {
    Stop::GraderFault(format!(
        "the worker process sent {what}: look at the submission before you grade it again"
    ))
}

fn beyond() -> Stop {
    broken("more than a submission can use, print or plot")
}

/// The budgets that a worker counts, held again: what it says it used or said is believed only within them.
struct Held {
    budgets: Budgets,
    operations_per_call: u64,
    operations: u64,
    lines: u64,
    samples: u64,
}

/// Bytes that a line can have more than a text of the language: it may be a note about one.
const NOTE_BYTES: u64 = 1_000;

impl Held {
    fn to(opening: &Opening) -> Self {
        let budgets = opening.budgets.clone();
        let (operations_per_call, operations) = match opening.program {
            Program::Script(_) => (budgets.operations_per_call, budgets.operations_per_task),
            Program::Module(_) => (budgets.instructions_per_call, budgets.instructions_per_task),
            Program::Python(_) => (
                budgets.python_instructions_per_call(),
                budgets.python_instructions_per_task(),
            ),
        };
        Self {
            operations_per_call,
            operations,
            // a note says once that there are more
            lines: budgets.log_lines + NOTES,
            samples: budgets.plot_samples,
            budgets,
        }
    }

    /// Takes what a call used and said from what is left; false if that is more.
    fn take(&mut self, operations: u64, said: &Said) -> bool {
        let longest = 4 * self.budgets.text_size + NOTE_BYTES;
        let texts = said
            .log
            .iter()
            .map(|printed| &printed.text)
            .chain(said.plots.iter().map(|(name, _)| name));
        let mut lengths = texts.map(|text| text.len() as u64);
        let left = |left: u64, taken: usize| left.checked_sub(taken as u64);
        let (Some(lines), Some(samples), Some(operations_left)) = (
            left(self.lines, said.log.len()),
            left(self.samples, said.plots.len()),
            self.operations.checked_sub(operations),
        ) else {
            return false;
        };
        self.lines = lines;
        self.samples = samples;
        self.operations = operations_left;
        operations <= self.operations_per_call && lengths.all(|length| length <= longest)
    }
}

/// Lines that the hosts of submissions add: two about budgets, and where a call that is not finite began to be so, which ends the calls.
const NOTES: u64 = 2_000;

/// A worker at work for one task.
struct Lease {
    worker: Option<Worker>,
    /// Whether no call was stopped.
    is_sound: bool,
    held: Held,
    unanswered: Said,
    home: Kept,
}

impl Lease {
    fn answer(&mut self, call: &Call) -> Result<Answer, Stop> {
        let Some(worker) = &mut self.worker else {
            return Err(Stop::GraderFault("a worker that was given back".to_owned()));
        };
        match worker.exchange(&Request::Call(call))? {
            Reply::Answered(answer) => {
                let answer = answer
                    .answer()
                    .ok_or_else(|| broken("an answer that is none"))?;
                if self.held.take(answer.operations, &answer.said) {
                    Ok(answer)
                } else {
                    Err(beyond())
                }
            }
            Reply::Stopped(stop, said) => {
                let said = said.said();
                if self.held.take(0, &said) {
                    self.unanswered = said;
                    Err(stop.stop())
                } else {
                    Err(beyond())
                }
            }
            Reply::Ready(_) | Reply::Opened | Reply::Tried(_) => {
                Err(broken("another reply than it was asked for"))
            }
        }
    }
}

impl Controller for Lease {
    fn call(&mut self, call: &Call) -> Result<Answer, Stop> {
        if interrupt::asked() {
            return Err(Stop::Interrupted);
        }
        let answer = self.answer(call);
        self.is_sound &= answer.is_ok();
        answer
    }

    fn unanswered(&mut self) -> Said {
        std::mem::take(&mut self.unanswered)
    }
}

impl Drop for Lease {
    fn drop(&mut self) {
        if let Some(worker) = self.worker.take().filter(|_| self.is_sound) {
            let before = self
                .home
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .replace(worker);
            drop(before);
        }
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    // no names of others: the tests of hostile workers take this file without its tests
    #[test]
    fn hosts_beside_one_have_the_processors_that_it_does_not_use_and_its_time() {
        use super::{Host as _, MOST_BESIDE, WorkerHost};
        // a thread of its own: the choice is the thread's
        let thread = std::thread::spawn(|| {
            let all = crate::one_processor::processors().len();
            let mut host = WorkerHost::new(None);
            assert!(host.beside(5).is_empty(), "no processor is chosen yet");
            host.processor.choose();
            assert_eq!(host.beside(5).len(), (all - 1).min(5));
            assert_eq!(host.beside(50).len(), (all - 1).min(MOST_BESIDE));
            assert!(host.beside(0).is_empty());
            let mut fixed = WorkerHost::on(Some(0));
            fixed.processor.choose();
            assert!(
                fixed.beside(5).is_empty(),
                "a class has work for the others"
            );
        });
        thread.join().expect("no panic");
    }
}
