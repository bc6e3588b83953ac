//! A worker process as its parent sees it: how it starts, how long it may take, and why it ended.

use std::io::{BufReader, BufWriter, Read as _};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use kinemark_grader::submission::controller::{HostLimit, Stop};
use kinemark_grader::submission::handed_in::Program;
use serde::Serialize;

use super::seal::Sealed;
use super::wire::{Attempt, Reply, Request, receive_reply, send};
use crate::interrupt;

/// How long the workers of one submission may take together while they are waited for: far above what the counted budgets allow, so
/// that it speaks of the machine alone.
pub(super) const WALL_CLOCK: Duration = Duration::from_secs(60);
/// How often the watchdog looks whether that is over.
const LOOK: Duration = Duration::from_millis(50);
/// A worker that was waited for at fewer looks has most of its time before it: 2 s.
const FRESH_LOOKS: u32 = 40;
/// A worker that uses less memory has most of its address space before it.
const SMALL_BYTES: usize = 24 << 20;
/// The same for one that runs Python: with the interpreter, and with two instances of 11 MB as every submission begins.
const SMALL_BYTES_WITH_PYTHON: usize = 128 << 20;
/// Says that a worker has come to the end of its address space; the language's runtime writes it.
const OUT_OF_MEMORY: &str = "memory allocation of";

/// The time of all workers of one submission.
#[derive(Debug, Clone)]
pub(super) struct Spent {
    /// At how many looks one of them was waited for.
    looks: Arc<AtomicU32>,
    /// The most time.
    most: Duration,
}

impl Spent {
    /// None of `most`.
    pub(super) fn none_of(most: Duration) -> Self {
        Self {
            looks: Arc::default(),
            most,
        }
    }

    fn is_all(&self) -> bool {
        LOOK * self.looks.load(Ordering::Relaxed) >= self.most
    }
}

/// A worker process, ended when dropped.
pub(super) struct Worker {
    /// Digest of the submission that it serves.
    submission: blake3::Hash,
    /// At how many looks it was waited for.
    looks: Arc<AtomicU32>,
    /// Whether it is waited for.
    is_awaited: Arc<AtomicBool>,
    child: Arc<Mutex<Child>>,
    input: BufWriter<ChildStdin>,
    output: BufReader<ChildStdout>,
    /// What the worker's runtime says when it dies; a submission's own output never goes there.
    last_words: Option<JoinHandle<String>>,
    watchdog: Option<(Sender<()>, JoinHandle<bool>)>,
    /// Which layers it says are on, once it has said so.
    sealed: Option<Sealed>,
}

impl Worker {
    /// Starts one for a submission; `spent` is the time that its other workers have taken. On the processors of `ahead`, if there are any, it
    /// makes Python ready.
    pub(super) fn start(
        submission: blake3::Hash,
        spent: Spent,
        ahead: &[usize],
    ) -> std::io::Result<Self> {
        let mut child = command(ahead)?.spawn()?;
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
        let looks = Arc::new(AtomicU32::new(0));
        let is_awaited = Arc::new(AtomicBool::new(false));
        let (done, waiting) = channel();
        let watched = (
            Arc::clone(&child),
            Arc::clone(&is_awaited),
            Arc::clone(&looks),
        );
        let watchdog = std::thread::spawn(move || {
            let (child, is_awaited, looks) = watched;
            loop {
                match waiting.recv_timeout(LOOK) {
                    Err(RecvTimeoutError::Timeout) => {}
                    Ok(()) | Err(RecvTimeoutError::Disconnected) => return false,
                }
                if is_awaited.load(Ordering::Relaxed) {
                    looks.fetch_add(1, Ordering::Relaxed);
                    spent.looks.fetch_add(1, Ordering::Relaxed);
                }
                if spent.is_all() || interrupt::asked() {
                    // gone already is as good
                    let _ = child.lock().unwrap_or_else(PoisonError::into_inner).kill();
                    return true;
                }
            }
        });
        Ok(Self {
            submission,
            looks,
            is_awaited,
            child,
            input,
            output,
            last_words: Some(last_words),
            watchdog: Some((done, watchdog)),
            sealed: None,
        })
    }

    /// Whether it can serve `submission`, whose code is `program`, as a new one would: it is of the same one, young, and small. One that
    /// has used much of its time or its address space could run out of them earlier than a new one.
    pub(super) fn may_serve(&self, submission: blake3::Hash, program: &Program) -> bool {
        let small = match program {
            Program::Python(_) => SMALL_BYTES_WITH_PYTHON,
            Program::Script(_) | Program::Module(_) => SMALL_BYTES,
        };
        self.submission == submission
            && self.looks.load(Ordering::Relaxed) < FRESH_LOOKS
            && self.uses_less_than(small)
    }

    /// Whether it uses less memory than that, as the system says.
    #[cfg(target_os = "linux")]
    fn uses_less_than(&self, bytes: usize) -> bool {
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
        resident.is_some_and(|pages| pages.saturating_mul(rustix::param::page_size()) < bytes)
    }

    /// Nobody knows on this system.
    #[cfg(not(target_os = "linux"))]
    #[expect(
        clippy::unused_self,
        reason = "the system that says it does so by the process"
    )]
    fn uses_less_than(&self, _bytes: usize) -> bool {
        false
    }

    /// Which layers it says are on.
    pub(super) fn sealed(&mut self) -> Result<Sealed, Stop> {
        if let Some(sealed) = self.sealed {
            return Ok(sealed);
        }
        let reply = self.awaited(|worker| receive_reply(&mut worker.output));
        match reply {
            Ok(Reply::Ready(bits)) => {
                let sealed = Sealed::from_bits(bits);
                self.sealed = Some(sealed);
                Ok(sealed)
            }
            Ok(_) => Err(Stop::GraderFault(
                "the worker process did not begin with what it gave up".to_owned(),
            )),
            Err(error) => Err(self.cause_of_death(&error)),
        }
    }

    /// Sends a request and waits for the reply.
    pub(super) fn exchange(&mut self, request: &impl Serialize) -> Result<Reply, Stop> {
        // the request goes first: the worker starts while it is written
        let sent = send(&mut self.input, request);
        self.sealed()?;
        let reply = sent.and_then(|()| self.awaited(|worker| receive_reply(&mut worker.output)));
        reply.map_err(|error| self.cause_of_death(&error))
    }

    fn awaited<T>(&mut self, wait: impl FnOnce(&mut Self) -> T) -> T {
        self.is_awaited.store(true, Ordering::Relaxed);
        let result = wait(self);
        self.is_awaited.store(false, Ordering::Relaxed);
        result
    }

    /// Why the worker no longer answers, or what it sent that is no answer.
    fn cause_of_death(&mut self, error: &std::io::Error) -> Stop {
        if interrupt::asked() {
            return Stop::Interrupted;
        }
        if self.end_watchdog() {
            return if interrupt::asked() {
                Stop::Interrupted
            } else {
                Stop::HostLimit(HostLimit::Time)
            };
        }
        let broke_the_rules = error.kind() == std::io::ErrorKind::InvalidData;
        let (status, is_out_of_time) = {
            let mut child = self.child.lock().unwrap_or_else(PoisonError::into_inner);
            // nobody can say so once it has been waited for
            let is_out_of_time = is_out_of_cpu_time(child.id());
            let status = if broke_the_rules {
                None
            } else {
                ended_soon(&mut child)
            };
            // a worker that broke the rules, or closed its output, may still be alive
            let _ = child.kill();
            let _ = child.wait();
            (status, is_out_of_time)
        };
        let words = self.last_words.take().and_then(|thread| thread.join().ok());
        let words = words.unwrap_or_default();
        let Some(status) = status else {
            return Stop::GraderFault(format!(
                "the worker process sent {error}: look at the submission before you grade it again"
            ));
        };
        if let Some(limit) = limit_of(status, is_out_of_time, &words) {
            return Stop::HostLimit(limit);
        }
        let first = words.lines().find(|line| !line.is_empty());
        let first = first.unwrap_or_default();
        Stop::GraderFault(format!("the worker process ended: {status} {first}"))
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

impl Drop for Worker {
    fn drop(&mut self) {
        self.end_watchdog();
        let mut child = self.child.lock().unwrap_or_else(PoisonError::into_inner);
        // gone already is as good; waiting leaves no zombie
        let _ = child.kill();
        let _ = child.wait();
    }
}

/// The command of a worker.
fn command(ahead: &[usize]) -> std::io::Result<Command> {
    let mut command = Command::new(std::env::current_exe()?);
    command
        .arg("worker")
        .env_clear()
        // both allocators, ours and the one of C, would reserve more address space at once than a worker has
        .env("MIMALLOC_ARENA_RESERVE", "64M")
        // committed at once, they are in pages of 2 MB, of which a worker would use 20 MB more than it fills
        .env("MIMALLOC_ARENA_EAGER_COMMIT", "0")
        .env("MALLOC_ARENA_MAX", "1")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    #[cfg(unix)]
    command.arg(format!("--parent={}", std::process::id()));
    if !ahead.is_empty() {
        let processors: Vec<String> = ahead.iter().map(usize::to_string).collect();
        command.arg(format!("--ahead={}", processors.join(",")));
    }
    #[cfg(windows)]
    {
        use std::os::windows::process::CommandExt as _;
        /// A group of its own: Ctrl-C in the console is for the grader alone.
        const CREATE_NEW_PROCESS_GROUP: u32 = 0x0000_0200;
        command.creation_flags(CREATE_NEW_PROCESS_GROUP);
        // a process without it cannot load some libraries of the system; it names the system's folder, and nothing of the user
        if let Some(root) = std::env::var_os("SystemRoot") {
            command.env("SystemRoot", root);
        }
    }
    Ok(command)
}

/// How a worker ended whose output is at its end; `None` if it goes on all the same.
fn ended_soon(child: &mut Child) -> Option<ExitStatus> {
    // closing its pipes is the last thing before a process ends: a look or two, and not a wait for one that stays
    for _ in 0..200 {
        match child.try_wait() {
            Ok(Some(status)) => return Some(status),
            Ok(None) => std::thread::sleep(Duration::from_millis(1)),
            Err(_) => return None,
        }
    }
    None
}

/// Whether a process that was not waited for has used the CPU time that it may have, as the system says: at least three quarters of it. The
/// limit counts the ticks of the clock that find the process running, and the system says how long it ran: beside others on a busy machine,
/// that was 10 % less and more.
#[cfg(target_os = "linux")]
fn is_out_of_cpu_time(id: u32) -> bool {
    let read = |name: &str| std::fs::read_to_string(format!("/proc/{id}/{name}")).ok();
    let ticks = || {
        let stat = read("stat")?;
        // the name of the program is in brackets, and may hold any character
        let (_, after) = stat.rsplit_once(')')?;
        let mut columns = after.split_whitespace().skip(11);
        let mut ticks = || columns.next()?.parse::<u64>().ok();
        ticks()?.checked_add(ticks()?)
    };
    let seconds = || {
        let limits = read("limits")?;
        let limit = limits
            .lines()
            .find_map(|line| line.strip_prefix("Max cpu time"))?;
        limit.split_whitespace().next()?.parse::<u64>().ok()
    };
    let (Some(used), Some(most)) = (ticks(), seconds()) else {
        return false;
    };
    let most = most.saturating_mul(rustix::param::clock_ticks_per_second());
    used >= most - most / 4
}

/// Nobody knows on this system.
#[cfg(not(target_os = "linux"))]
fn is_out_of_cpu_time(_id: u32) -> bool {
    false
}

/// The limit of this machine that ended a worker.
#[cfg(unix)]
fn limit_of(status: ExitStatus, is_out_of_time: bool, words: &str) -> Option<HostLimit> {
    use rustix::process::Signal;
    use std::os::unix::process::ExitStatusExt as _;
    let signal = status.signal()?;
    let is = |of: Signal| signal == of.as_raw();
    // the limit on CPU time: first a signal that can be refused, then one that cannot
    if is(Signal::XCPU) {
        return Some(HostLimit::Time);
    }
    // the second comes alone where both are the same, as `ulimit -t` sets them
    if is(Signal::KILL) && is_out_of_time {
        return Some(HostLimit::Time);
    }
    // not by this process: the system had no memory left for it, or somebody ended it
    if is(Signal::KILL) {
        return Some(HostLimit::Memory);
    }
    // how a program ends that has no memory, in one C library and in the other
    let gave_up = is(Signal::ABORT) || is(Signal::SEGV) || is(Signal::ILL);
    (gave_up && words.contains(OUT_OF_MEMORY)).then_some(HostLimit::Memory)
}

/// The same without signals.
#[cfg(not(unix))]
fn limit_of(status: ExitStatus, _is_out_of_time: bool, words: &str) -> Option<HostLimit> {
    (!status.success() && words.contains(OUT_OF_MEMORY)).then_some(HostLimit::Memory)
}

/// What a worker of this machine has given up, as it says, and as it tries.
pub(crate) struct Probe {
    /// The layers that are on.
    pub(crate) sealed: Sealed,
    /// What it tried, and whether that was refused.
    pub(crate) tried: Vec<(Attempt, bool)>,
}

/// Starts a worker to see what it cannot do here.
///
/// # Errors
/// Why no worker starts.
pub(crate) fn probe() -> Result<Probe, String> {
    let words = |stop| match stop {
        Stop::GraderFault(words) => words,
        other => format!("{other:?}"),
    };
    let mut worker = Worker::start(blake3::hash(b""), Spent::none_of(WALL_CLOCK), &[])
        .map_err(|error| format!("a worker process could not be started: {error}"))?;
    let reply = worker.exchange(&Request::Try).map_err(words)?;
    let Reply::Tried(tried) = reply else {
        return Err("the worker process sent another reply than it was asked for".to_owned());
    };
    let sealed = worker.sealed().map_err(words)?;
    Ok(Probe { sealed, tried })
}
