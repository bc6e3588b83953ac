//! Submissions in a process of their own: the same binary, without environment, with limits on memory and CPU time.
//!
//! Messages are length-prefixed postcard over the worker's standard input and output. The parent keeps simulator, truth and
//! grade; a worker can lie only about its own answers. A watchdog ends a worker that outlasts the wall clock: `host-limit`.

use std::io::{BufReader, BufWriter, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitCode, Stdio};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use kinemark_grader::submission::controller::{
    Answer, Call, Controller, HostLimit, Opening, Said, Stop,
};
use kinemark_grader::submission::host::Host;
use kinemark_grader::submission::rhai::{STACK_BYTES, ScriptController};
use serde::{Serialize, de::DeserializeOwned};

use crate::interrupt;
use crate::one_processor::OneProcessor;

/// Wall clock of one task's submission: far above what the counted budgets allow, so that it speaks of the machine alone.
const WALL_CLOCK: Duration = Duration::from_secs(60);
/// CPU seconds of one task's submission, for the same reason.
#[cfg(unix)]
const CPU_SECONDS: u64 = 50;
/// Address space of a worker.
#[cfg(unix)]
const ADDRESS_SPACE_BYTES: u64 = 256 << 20;
/// A frame longer than this is no message of ours.
const MOST_FRAME_BYTES: u32 = 64 << 20;

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
    let opening: Opening = receive(input)?;
    let mut controller = match ScriptController::open(&opening) {
        Ok(controller) => {
            send(output, &None::<Stop>)?;
            controller
        }
        Err(stop) => return send(output, &Some(stop)),
    };
    loop {
        let call: Call = receive(input)?;
        let answer = controller
            .call(&call)
            .map_err(|stop| (stop, controller.unanswered()));
        send(output, &answer)?;
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

/// The parent's side: starts a worker per submission and task.
#[derive(Debug)]
pub(crate) struct WorkerHost {
    progress: Option<indicatif::ProgressBar>,
    processor: OneProcessor,
}

impl WorkerHost {
    pub(crate) fn new(progress: Option<indicatif::ProgressBar>) -> Self {
        Self {
            progress,
            processor: OneProcessor::default(),
        }
    }

    /// One without progress, whose workers run on `processor`.
    pub(crate) fn on(processor: Option<usize>) -> Self {
        Self {
            progress: None,
            processor: OneProcessor::fixed(processor),
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
        // before the worker is started: it inherits the choice
        self.processor.choose();
        let mut worker = Worker::start().map_err(|error| {
            Stop::GraderFault(format!("a worker process could not be started: {error}"))
        })?;
        let refused: Option<Stop> = worker.exchange(opening)?;
        match refused {
            None => Ok(Box::new(worker)),
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

/// A worker process, ended when dropped.
struct Worker {
    child: Arc<Mutex<Child>>,
    input: BufWriter<ChildStdin>,
    output: BufReader<ChildStdout>,
    /// What the worker's runtime says when it dies; a submission's own output never goes there.
    last_words: Option<JoinHandle<String>>,
    watchdog: Option<(Sender<()>, JoinHandle<bool>)>,
    unanswered: Said,
}

impl Worker {
    fn start() -> std::io::Result<Self> {
        let mut command = Command::new(std::env::current_exe()?);
        command
            .arg("worker")
            .env_clear()
            // one heap for all threads: a second one reserves more address space than a worker has, and without it every
            // allocation becomes a system call
            .env("MALLOC_ARENA_MAX", "1")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
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
        let (done, waiting) = channel();
        let watchdog = std::thread::spawn(move || {
            let mut waited = Duration::ZERO;
            let look = Duration::from_millis(50);
            loop {
                match waiting.recv_timeout(look) {
                    Err(RecvTimeoutError::Timeout) => waited += look,
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

impl Controller for Worker {
    fn call(&mut self, call: &Call) -> Result<Answer, Stop> {
        if interrupt::asked() {
            return Err(Stop::Interrupted);
        }
        let answer: Result<Answer, (Stop, Said)> = self.exchange(call)?;
        answer.map_err(|(stop, said)| {
            self.unanswered = said;
            stop
        })
    }

    fn unanswered(&mut self) -> Said {
        std::mem::take(&mut self.unanswered)
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
