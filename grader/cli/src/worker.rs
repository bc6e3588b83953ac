//! Submissions in a process of their own: the same binary, without environment, with limits on memory and CPU time.
//!
//! Messages are length-prefixed postcard over the worker's standard input and output. The parent keeps simulator, truth and
//! grade; a worker can lie only about its own answers. A watchdog ends a worker that outlasts the wall clock: `host-limit`.
//!
//! A worker serves one submission: starting a process costs as much as some hundred calls, so one that is still fresh is kept for the
//! next task or hidden run of the same file, where the code is opened anew. Never is it kept for another file, nor after a stop.

use std::io::{BufReader, BufWriter, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitCode, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use kinemark_grader::submission::controller::{
    Answer, Call, Controller, HostLimit, Opening, Said, Stop,
};
use kinemark_grader::submission::host::{Host, open_here};
use kinemark_grader::submission::rhai::STACK_BYTES;
use serde::{Deserialize, Serialize, de::DeserializeOwned};

use crate::interrupt;
use crate::one_processor::OneProcessor;

/// Wall clock of one task's submission: far above what the counted budgets allow, so that it speaks of the machine alone.
const WALL_CLOCK: Duration = Duration::from_secs(60);
/// How often the watchdog looks whether that is over.
const LOOK: Duration = Duration::from_millis(50);
/// A worker that was looked at less often has most of its time before it: 2 s.
const FRESH_LOOKS: u32 = 40;
/// A worker that uses less memory has most of its address space before it.
#[cfg(target_os = "linux")]
const SMALL_BYTES: usize = 24 << 20;
/// CPU seconds of one task's submission, for the same reason.
#[cfg(unix)]
const CPU_SECONDS: u64 = 50;
/// Address space of a worker.
#[cfg(unix)]
const ADDRESS_SPACE_BYTES: u64 = 256 << 20;
/// How a process ends that Windows stops for Ctrl-C in its console (`STATUS_CONTROL_C_EXIT`).
#[cfg(windows)]
const ENDED_BY_CONTROL_C: i32 = 0xC000_013A_u32.cast_signed();
/// A frame longer than this is no message of ours.
const MOST_FRAME_BYTES: u32 = 64 << 20;

/// What the parent asks for.
#[derive(Serialize)]
enum Request<'r> {
    /// Open a submission for a task, in place of what was open before.
    Open(&'r Opening),
    /// Answer a call.
    Call(&'r Call),
}

/// A [`Request`] as the worker has it: the same bytes.
#[derive(Deserialize)]
enum Received {
    Open(Box<Opening>),
    Call(Call),
}

fn send(out: &mut impl Write, message: &impl Serialize) -> std::io::Result<()> {
    let bytes = postcard::to_stdvec(message).map_err(std::io::Error::other)?;
    let length = u32::try_from(bytes.len()).map_err(std::io::Error::other)?;
    out.write_all(&length.to_le_bytes())?;
    out.write_all(&bytes)?;
    out.flush()
}

fn receive<T: DeserializeOwned>(input: &mut impl Read) -> std::io::Result<T> {
    let mut length = [0; 4];
    input.read_exact(&mut length)?;
    let length = u32::from_le_bytes(length);
    if length > MOST_FRAME_BYTES {
        return Err(std::io::Error::other("a frame that is too long"));
    }
    let mut bytes = vec![0; length as usize];
    input.read_exact(&mut bytes)?;
    postcard::from_bytes(&bytes).map_err(std::io::Error::other)
}

/// The worker's side: opens one submission, then answers calls until its input ends.
pub(crate) fn serve() -> ExitCode {
    #[cfg(unix)]
    limit_this_process();
    let thread = std::thread::Builder::new()
        .stack_size(STACK_BYTES)
        .spawn(|| {
            let mut input = BufReader::new(std::io::stdin());
            let mut output = BufWriter::new(std::io::stdout());
            // the parent going away is the normal end
            let _ = answer_calls(&mut input, &mut output);
        });
    match thread.map(JoinHandle::join) {
        Ok(Ok(())) => ExitCode::SUCCESS,
        _ => ExitCode::FAILURE,
    }
}

fn answer_calls(input: &mut impl Read, output: &mut impl Write) -> std::io::Result<()> {
    let mut controller: Option<Box<dyn Controller>> = None;
    loop {
        match receive(input)? {
            Received::Open(opening) => {
                // before the next one: both together are never in memory
                drop(controller.take());
                let opened = open_here(&opening);
                send(output, &opened.as_ref().err())?;
                controller = opened.ok();
            }
            Received::Call(call) => {
                let Some(controller) = &mut controller else {
                    return Err(std::io::Error::other("a call before an opening"));
                };
                let answer = controller
                    .call(&call)
                    .map_err(|stop| (stop, controller.unanswered()));
                send(output, &answer)?;
            }
        }
    }
}

/// Memory, CPU time, no core dump, no file written: set by the worker itself, before it reads anything of the submission.
#[cfg(unix)]
fn limit_this_process() {
    use rustix::process::{Resource, Rlimit, setrlimit};
    for (resource, most) in [
        (Resource::As, ADDRESS_SPACE_BYTES),
        (Resource::Cpu, CPU_SECONDS),
        (Resource::Core, 0),
        (Resource::Fsize, 0),
    ] {
        let limit = Rlimit {
            current: Some(most),
            maximum: Some(most),
        };
        // a system that refuses leaves the counted budgets, which are the real limits
        let _ = setrlimit(resource, limit);
    }
}

/// The parent's side: starts workers, and keeps one that may serve on.
pub(crate) struct WorkerHost {
    progress: Option<indicatif::ProgressBar>,
    processor: OneProcessor,
    kept: Kept,
}

/// Where a worker waits for the next task of its submission.
type Kept = Arc<Mutex<Option<Worker>>>;

impl WorkerHost {
    pub(crate) fn new(progress: Option<indicatif::ProgressBar>) -> Self {
        Self {
            progress,
            processor: OneProcessor::default(),
            kept: Kept::default(),
        }
    }

    /// One without progress, whose workers run on `processor`.
    pub(crate) fn on(processor: Option<usize>) -> Self {
        Self {
            progress: None,
            processor: OneProcessor::fixed(processor),
            kept: Kept::default(),
        }
    }

    /// Takes the progress bar off the terminal.
    pub(crate) fn finish(&self) {
        if let Some(progress) = &self.progress {
            progress.finish_and_clear();
        }
    }
}

impl Host for WorkerHost {
    fn open(&mut self, opening: &Opening) -> Result<Box<dyn Controller>, Stop> {
        if interrupt::asked() {
            return Err(Stop::Interrupted);
        }
        let kept = self
            .kept
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .take();
        let mut worker = match kept.filter(|kept| kept.may_serve(opening)) {
            Some(kept) => kept,
            None => {
                // before the worker is started: it inherits the choice
                self.processor.choose();
                Worker::start(opening).map_err(|error| {
                    Stop::GraderFault(format!("a worker process could not be started: {error}"))
                })?
            }
        };
        let refused: Option<Stop> = worker.exchange(&Request::Open(opening))?;
        match refused {
            None => Ok(Box::new(Lease {
                worker: Some(worker),
                is_sound: true,
                home: Arc::clone(&self.kept),
            })),
            Some(stop) => Err(stop),
        }
    }

    fn begins(&mut self, task: &str) {
        if let Some(progress) = &self.progress {
            progress.set_message(task.to_owned());
            progress.inc(1);
        }
    }
}

/// A worker at work for one task.
struct Lease {
    worker: Option<Worker>,
    /// Whether no call was stopped.
    is_sound: bool,
    home: Kept,
}

impl Controller for Lease {
    fn call(&mut self, call: &Call) -> Result<Answer, Stop> {
        let Some(worker) = &mut self.worker else {
            return Err(Stop::GraderFault("a worker that was given back".to_owned()));
        };
        let answer = worker.call(call);
        self.is_sound &= answer.is_ok();
        answer
    }

    fn unanswered(&mut self) -> Said {
        let worker = self.worker.as_mut();
        worker
            .map(|worker| std::mem::take(&mut worker.unanswered))
            .unwrap_or_default()
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

/// A worker process, ended when dropped.
struct Worker {
    /// Digest of the submission that it serves.
    submission: blake3::Hash,
    /// How often the watchdog has looked.
    looks: Arc<AtomicU32>,
    child: Arc<Mutex<Child>>,
    input: BufWriter<ChildStdin>,
    output: BufReader<ChildStdout>,
    /// What the worker's runtime says when it dies; a submission's own output never goes there.
    last_words: Option<JoinHandle<String>>,
    watchdog: Option<(Sender<()>, JoinHandle<bool>)>,
    unanswered: Said,
}

/// The digest of a submission, with the name of its file.
fn digest_of(opening: &Opening) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&(opening.file.len() as u64).to_le_bytes());
    hasher.update(opening.file.as_bytes());
    hasher.update(opening.program.bytes());
    hasher.finalize()
}

impl Worker {
    /// Whether it can serve `opening` as a new one would: it is of the same submission, young, and small. One that has used much of its
    /// time or its address space could run out of them earlier than a new one.
    fn may_serve(&self, opening: &Opening) -> bool {
        self.submission == digest_of(opening)
            && self.looks.load(Ordering::Relaxed) < FRESH_LOOKS
            && self.is_small()
    }

    /// Whether its memory is far below the limit, as the system says.
    #[cfg(target_os = "linux")]
    fn is_small(&self) -> bool {
        let id = self
            .child
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .id();
        let pages = std::fs::read_to_string(format!("/proc/{id}/statm"));
        let resident = pages.ok().and_then(|pages| {
            let mut columns = pages.split(' ');
            columns.nth(1)?.parse::<usize>().ok()
        });
        resident.is_some_and(|pages| pages.saturating_mul(rustix::param::page_size()) < SMALL_BYTES)
    }

    /// Nobody knows on this system.
    #[cfg(not(target_os = "linux"))]
    #[expect(
        clippy::unused_self,
        reason = "the system that says it does so by the process"
    )]
    fn is_small(&self) -> bool {
        false
    }

    fn start(opening: &Opening) -> std::io::Result<Self> {
        let mut command = Command::new(std::env::current_exe()?);
        command
            .arg("worker")
            .env_clear()
            // both allocators, ours and the one of C, would reserve more address space at once than a worker has
            .env("MIMALLOC_ARENA_RESERVE", "64M")
            .env("MALLOC_ARENA_MAX", "1")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        // a process without it cannot load some libraries of the system; it names the system's folder, and nothing of the user
        #[cfg(windows)]
        if let Some(root) = std::env::var_os("SystemRoot") {
            command.env("SystemRoot", root);
        }
        let mut child = command.spawn()?;
        let missing = || std::io::Error::other("no pipe to the worker");
        let input = BufWriter::new(child.stdin.take().ok_or_else(missing)?);
        let output = BufReader::new(child.stdout.take().ok_or_else(missing)?);
        let stderr = child.stderr.take().ok_or_else(missing)?;
        let last_words = std::thread::spawn(move || {
            let mut words = Vec::new();
            // no more than a message: a flood is cut, and the rest of it ends in a closed pipe
            let _ = stderr.take(4096).read_to_end(&mut words);
            String::from_utf8_lossy(&words).into_owned()
        });
        let child = Arc::new(Mutex::new(child));
        let watched = Arc::clone(&child);
        let looks = Arc::new(AtomicU32::new(0));
        let looked = Arc::clone(&looks);
        let (done, waiting) = channel();
        let watchdog = std::thread::spawn(move || {
            let mut waited = Duration::ZERO;
            loop {
                match waiting.recv_timeout(LOOK) {
                    Err(RecvTimeoutError::Timeout) => {
                        waited += LOOK;
                        looked.fetch_add(1, Ordering::Relaxed);
                    }
                    Ok(()) | Err(RecvTimeoutError::Disconnected) => return false,
                }
                if waited >= WALL_CLOCK || interrupt::asked() {
                    // gone already is as good
                    let _ = watched
                        .lock()
                        .unwrap_or_else(PoisonError::into_inner)
                        .kill();
                    return true;
                }
            }
        });
        Ok(Self {
            submission: digest_of(opening),
            looks,
            child,
            input,
            output,
            last_words: Some(last_words),
            watchdog: Some((done, watchdog)),
            unanswered: Said::default(),
        })
    }

    fn exchange<T: DeserializeOwned>(&mut self, message: &impl Serialize) -> Result<T, Stop> {
        let answer = send(&mut self.input, message).and_then(|()| receive(&mut self.output));
        answer.map_err(|_| self.cause_of_death())
    }

    /// Why the worker no longer answers.
    fn cause_of_death(&mut self) -> Stop {
        if interrupt::asked() {
            return Stop::Interrupted;
        }
        let timed_out = self.end_watchdog();
        if timed_out {
            return if interrupt::asked() {
                Stop::Interrupted
            } else {
                Stop::HostLimit(HostLimit::Time)
            };
        }
        let status = {
            let mut child = self.child.lock().unwrap_or_else(PoisonError::into_inner);
            // a worker that broke the protocol may still be alive
            let _ = child.kill();
            child.wait()
        };
        let words = self.last_words.take().and_then(|thread| thread.join().ok());
        let words = words.unwrap_or_default();
        if words.contains("memory allocation of") {
            return Stop::HostLimit(HostLimit::Memory);
        }
        #[cfg(unix)]
        if let Ok(status) = &status {
            use std::os::unix::process::ExitStatusExt as _;
            match status.signal() {
                // SIGXCPU, from the limit on CPU time
                Some(24) => return Stop::HostLimit(HostLimit::Time),
                // SIGINT from the terminal reaches the worker first
                Some(2) => return Stop::Interrupted,
                _ => {}
            }
        }
        // as on Unix: Ctrl-C reaches every process of the console, and often the worker first
        #[cfg(windows)]
        if let Ok(Some(ENDED_BY_CONTROL_C)) = status.as_ref().map(std::process::ExitStatus::code) {
            return Stop::Interrupted;
        }
        let ended = status.map_or_else(|error| error.to_string(), |status| status.to_string());
        let first = words.lines().next().unwrap_or_default().to_owned();
        Stop::GraderFault(format!("the worker process ended: {ended} {first}"))
    }

    fn end_watchdog(&mut self) -> bool {
        let Some((done, watchdog)) = self.watchdog.take() else {
            return false;
        };
        // it may have ended by itself, and then says so
        let _ = done.send(());
        watchdog.join().unwrap_or(false)
    }
}

impl Worker {
    fn call(&mut self, call: &Call) -> Result<Answer, Stop> {
        if interrupt::asked() {
            return Err(Stop::Interrupted);
        }
        let answer: Result<Answer, (Stop, Said)> = self.exchange(&Request::Call(call))?;
        answer.map_err(|(stop, said)| {
            self.unanswered = said;
            stop
        })
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.end_watchdog();
        let mut child = self.child.lock().unwrap_or_else(PoisonError::into_inner);
        // gone already is as good; waiting leaves no zombie
        let _ = child.kill();
        let _ = child.wait();
    }
}
