//! The worker's side: seals itself, opens one submission after the other, and answers calls until its input ends.

use std::io::{BufReader, BufWriter, ErrorKind, Read, Write};
use std::process::ExitCode;

use kinemark_grader::submission::controller::{Controller, Said, Stop};
use kinemark_grader::submission::host::open_here;
use kinemark_grader::submission::rhai::STACK_BYTES;

use super::seal::{Beside, Sealed, in_sealed_thread};
use super::wire::{
    Attempt, Received, Reply, WireAnswer, WireSaid, WireStop, receive_request, send,
};

/// How a worker is started.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The process that started it, which it must not outlive
    #[arg(long)]
    parent: Option<i32>,
    /// Processors on which it makes Python ready while the submission comes
    #[arg(long, value_delimiter = ',')]
    ahead: Vec<usize>,
}

/// Serves until the input ends.
pub(crate) fn serve(args: &Args) -> ExitCode {
    let parent = args.parent;
    let beside = Beside {
        processors: &args.ahead,
        work: make_python_ready,
    };
    let served = in_sealed_thread(parent, STACK_BYTES, beside, move |sealed| {
        let mut input = BufReader::new(std::io::stdin());
        let mut output = BufWriter::new(std::io::stdout());
        answer_calls((sealed, parent), &mut input, &mut output)
    });
    match served {
        Ok(None) => ExitCode::SUCCESS,
        // the parent going away is the normal end
        Ok(Some(Err(error))) if error.kind() == ErrorKind::UnexpectedEof => ExitCode::SUCCESS,
        _ => ExitCode::FAILURE,
    }
}

/// Translates what every submission in Python calls. Nothing depends on it but time.
pub(super) fn make_python_ready() {
    let _ = kinemark_grader::submission::python::translate_ahead();
}

/// Answers requests until there are no more.
pub(super) fn answer_calls(
    (sealed, parent): (Sealed, Option<i32>),
    input: &mut impl Read,
    output: &mut impl Write,
) -> std::io::Result<()> {
    send(output, &Reply::Ready(sealed.bits()))?;
    let mut controller: Option<Box<dyn Controller>> = None;
    loop {
        let reply = match receive_request(input)? {
            Received::Open(opening) => {
                // before the next one: both together are never in memory
                drop(controller.take());
                match open_here(&opening) {
                    Ok(opened) => {
                        controller = Some(opened);
                        Reply::Opened
                    }
                    Err(failed) => stopped(failed.stop, failed.said)?,
                }
            }
            Received::Try => Reply::Tried(tried(parent)),
            Received::Call(call) => {
                let Some(controller) = &mut controller else {
                    return Err(std::io::Error::other("a call before an opening"));
                };
                match controller.call(&call) {
                    Ok(answer) => Reply::Answered(WireAnswer::of(answer)),
                    Err(stop) => stopped(stop, controller.unanswered())?,
                }
            }
        };
        send(output, &reply)?;
    }
}

/// What a worker gave up, tried: each with whether it was refused.
fn tried(parent: Option<i32>) -> Vec<(Attempt, bool)> {
    use std::net::{Ipv4Addr, TcpListener, UdpSocket};
    let program = if cfg!(windows) { "cmd" } else { "true" };
    let folder = std::env::temp_dir();
    let file = folder.join("kinemark-doctor");
    let written = std::fs::write(&file, "");
    if written.is_ok() {
        // it was not refused, so it can be taken away again
        let _ = std::fs::remove_file(&file);
    }
    // it looks without asking for what is not there: the program itself
    let read = std::env::current_exe().and_then(std::fs::File::open);
    let listening = TcpListener::bind((Ipv4Addr::LOCALHOST, 0));
    let spoken = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0));
    let started = std::process::Command::new(program)
        .stdin(std::process::Stdio::null())
        .stdout(std::process::Stdio::null())
        .spawn()
        .and_then(|mut child| child.wait());
    let mut memory: Vec<u8> = Vec::new();
    let taken = memory.try_reserve_exact(1 << 30);
    vec![
        (Attempt::ReadFile, read.is_err()),
        (Attempt::ListFolder, std::fs::read_dir(folder).is_err()),
        (Attempt::WriteFile, written.is_err()),
        (Attempt::Connect, listening.is_err() && spoken.is_err()),
        (Attempt::StartProcess, started.is_err()),
        (Attempt::SignalGrader, !can_signal(parent)),
        (Attempt::TakeMemory, taken.is_err()),
    ]
}

/// Whether a signal to the grader would be sent; none is.
#[cfg(unix)]
fn can_signal(parent: Option<i32>) -> bool {
    let parent = parent.and_then(rustix::process::Pid::from_raw);
    parent.is_some_and(|parent| rustix::process::test_kill_process(parent).is_ok())
}

/// This system has processes that can end others.
#[cfg(not(unix))]
fn can_signal(_: Option<i32>) -> bool {
    true
}

/// The reply for a stop. A fault of the grader ends the worker, with its words on standard error: no message says so.
#[expect(
    clippy::print_stderr,
    reason = "the parent reads it, and shows it as the end of a worker"
)]
fn stopped(stop: Stop, said: Said) -> std::io::Result<Reply> {
    match WireStop::of(stop) {
        Ok(stop) => Ok(Reply::Stopped(stop, WireSaid::of(said))),
        Err(words) => {
            eprintln!("{words}");
            Err(std::io::Error::other(words))
        }
    }
}
