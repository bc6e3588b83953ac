//! The sources of the real worker and its host, and in place of the real worker's beginning one that is hostile if it is asked to be.

#[expect(dead_code, reason = "its beginning is replaced here")]
#[path = "../../../grader/cli/src/worker/child.rs"]
mod child;
#[expect(dead_code, reason = "part of the program, which uses all of it")]
#[path = "../../../grader/cli/src/worker/host.rs"]
mod host;
#[expect(dead_code, reason = "part of the program, which uses all of it")]
#[path = "../../../grader/cli/src/worker/process.rs"]
mod process;
#[path = "../../../grader/cli/src/worker/seal.rs"]
pub(crate) mod seal;
#[expect(dead_code, reason = "its unit tests run with the program's")]
#[path = "../../../grader/cli/src/worker/wire.rs"]
mod wire;

use std::io::{BufReader, BufWriter, Read, Write};
use std::process::ExitCode;
use std::time::Duration;

use kinemark_grader::submission::controller::{Mistake, Opening, Stop};
use kinemark_grader::submission::handed_in::Program;
use kinemark_grader::submission::rhai::STACK_BYTES;

pub(crate) use host::WorkerHost;
pub(crate) use process::probe;
use seal::{Beside, Layer, Sealed, in_sealed_thread};
use wire::{Received, Reply, WireSaid, WireStop, receive_request, send};

use crate::case::{At, Lie};
use crate::errand::Errand;
use crate::host_limits::come_to;
use crate::system_call;

/// The file name of a submission whose text is an [`Errand`].
pub(crate) const ERRAND: &str = "errand.txt";
/// The file name of a submission whose text names a limit of the machine.
pub(crate) const LIMIT: &str = "limit.txt";
/// The file name of a submission whose text is a case with a [`Lie`].
pub(crate) const LIE: &str = "case.toml";

/// A host whose workers have `longest` for a submission.
pub(crate) fn host(longest: Duration) -> WorkerHost {
    let mut host = WorkerHost::new(None);
    host.longest = longest;
    host
}

/// Begins as a real worker, and is what the first submission says.
pub(crate) fn serve_hostile(parent: &str, ahead: &[&str]) -> ExitCode {
    let parent = parent
        .strip_prefix("--parent=")
        .and_then(|id| id.parse().ok());
    let processors = ahead
        .iter()
        .filter_map(|words| words.strip_prefix("--ahead="))
        .flat_map(|list| list.split(','))
        .filter_map(|number| number.parse().ok());
    let beside = Beside {
        processors: &processors.collect::<Vec<usize>>(),
        work: child::make_python_ready,
    };
    let served = in_sealed_thread(parent, STACK_BYTES, beside, move |sealed| {
        answer(sealed, parent)
    });
    match served {
        Ok(None | Some(Ok(()))) => ExitCode::SUCCESS,
        _ => ExitCode::FAILURE,
    }
}

fn answer(sealed: Sealed, parent: Option<i32>) -> std::io::Result<()> {
    let mut input = BufReader::new(std::io::stdin());
    let mut output = BufWriter::new(std::io::stdout());
    let first = frame(&mut input)?;
    match receive_request(&mut first.as_slice())? {
        Received::Open(opening) if opening.file == ERRAND => {
            send(&mut output, &Reply::Ready(sealed.bits()))?;
            let message = Errand::read(opening.program.text()).outcome();
            send(&mut output, &words(message)?)?;
            // the end of the input is the end
            frame(&mut input).map(|_| ())
        }
        Received::Open(opening) if opening.file == LIMIT => {
            send(&mut output, &Reply::Ready(sealed.bits()))?;
            come_to(opening.program.text())
        }
        Received::Open(opening) if opening.file == LIE => {
            let lie = lie_of(&opening.program)?;
            if lie.at != At::Ready {
                send(&mut output, &Reply::Ready(sealed.bits()))?;
            }
            if lie.at == At::Call {
                send(&mut output, &Reply::Opened)?;
                frame(&mut input)?;
            }
            tell(&lie, &mut input, &mut output)
        }
        // an honest one
        _ => child::answer_calls(
            (sealed, parent),
            &mut first.as_slice().chain(input),
            &mut output,
        ),
    }
}

/// The bytes of the next message, with its length.
fn frame(input: &mut impl Read) -> std::io::Result<Vec<u8>> {
    let mut bytes = vec![0; 4];
    input.read_exact(&mut bytes)?;
    let length = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    input.take(length.into()).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// A reply that carries words to whoever opened the submission.
fn words(message: String) -> std::io::Result<Reply> {
    let stop = Stop::DidNotBuild(Mistake {
        message,
        place: None,
        help: None,
        further: Vec::new(),
    });
    let stop = WireStop::of(stop).map_err(std::io::Error::other)?;
    Ok(Reply::Stopped(stop, WireSaid::default()))
}

fn lie_of(program: &Program) -> std::io::Result<Lie> {
    /// The part of a case that the worker reads.
    #[derive(serde::Deserialize)]
    struct Case {
        lie: Lie,
    }
    let case: Case = toml::from_str(program.text()).map_err(std::io::Error::other)?;
    Ok(case.lie)
}

/// Sends what a case says instead of every answer, and ends as it says.
fn tell(lie: &Lie, input: &mut impl Read, output: &mut impl Write) -> std::io::Result<()> {
    loop {
        let bytes = lie.bytes();
        output.write_all(&bytes)?;
        output.flush()?;
        if lie.forever {
            continue;
        }
        if lie.silent {
            std::io::copy(input, &mut std::io::sink())?;
        }
        if let Some(words) = &lie.says {
            std::io::stderr().write_all(words.as_bytes())?;
        }
        if let Some(name) = &lie.signal {
            system_call::die_of(name);
        }
        if let Some(code) = lie.exit {
            system_call::exit(code);
        }
        // a worker may be kept for the next task: its opening is no call
        while let Received::Open(_) = receive_request(&mut frame(input)?.as_slice())?
            && lie.at == At::Call
        {
            send(output, &Reply::Opened)?;
        }
    }
}

/// Puts on one layer alone: whether this system has it.
pub(crate) fn put_on(layer: Layer) -> bool {
    match layer {
        Layer::Limits => seal::limits() && seal::linux::no_more_processes(),
        Layer::Descriptors => seal::close_inherited(),
        Layer::Session => seal::linux::leave_session(None) == Some(true),
        Layer::Files => seal::linux::landlock().0,
        Layer::Network => seal::linux::landlock().1,
        Layer::SystemCalls => seal::linux::filter_system_calls(),
    }
}

/// The answer to an opening, as words: what a worker says of its errand, or why it does not.
pub(crate) fn words_of(stop: Stop) -> String {
    match stop {
        Stop::DidNotBuild(mistake) => mistake.message,
        Stop::GraderFault(words) => words,
        other => format!("{other:?}"),
    }
}

/// An opening with this file and text alone.
pub(crate) fn opening(file: &str, text: String) -> Opening {
    use kinemark_grader::submission::controller::{Budgets, RobotFacts};
    use kinemark_grader::task::value::Value;
    Opening {
        file: file.to_owned(),
        program: Program::Script(text),
        task: String::new(),
        robot: RobotFacts {
            name: String::new(),
            joint_names: Vec::new(),
            dimensions: Vec::new(),
            lower: Vec::new(),
            upper: Vec::new(),
            effort: Vec::new(),
        },
        target: Value::Nothing,
        sensors: Vec::new(),
        budgets: Budgets::default(),
        granted: None,
        function: None,
    }
}
