//! `kinemark robot eval`: one request per line in, one answer per line out, in order; a bad request is answered with an error and
//! the stream goes on.

mod ik;
mod operation;
mod request;
mod simulate;
mod state;
mod trajectory;

use std::io::{BufRead as _, BufReader, BufWriter, ErrorKind, Read as _, Write as _};
use std::path::PathBuf;
use std::process::ExitCode;

use kinemark_sim::robot::Robot;
use kinemark_sim::scene::Scene;
use serde_json::{Map, Value};

use crate::failure::{Failure, LOST};
use crate::robot_source::{self, RobotArgs};
use crate::{disk, scene_source};

/// Answer requests about a robot: one JSON object per line in, one per line out
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example:\n  echo '{\"id\": 1, \"op\": \"fk\", \"q\": [0.3, -1.2]}' | kinemark robot eval labs/robots/rrbot.toml\n\n\
    Operations: info, fk, jacobian, jacobian_derivative, manipulability, workspace, ik, com, rnea, bias, gravity, coriolis,\n\
    inverse_dynamics, crba, aba, energy, trajectory, simulate.\n\
    See docs/robot-eval.md.\n\
    Exit codes: 0 every request answered, 1 some answered with an error, 2 usage, 3 the robot is broken."
)]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) robot: RobotArgs,
    /// What is around the robot in `simulate`: a scene file, or a scene of the labs by its name
    #[arg(long, value_name = "SCENE")]
    pub(crate) scene: Option<PathBuf>,
}

/// A longer line is refused unread.
const MOST_LINE_BYTES: u64 = 16 << 20;

/// Why a request is not answered: a documented code, and words.
#[derive(Debug)]
pub(super) struct Refusal {
    pub(super) code: &'static str,
    pub(super) message: String,
}

impl Refusal {
    pub(super) fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self {
            code,
            message: message.into(),
        }
    }
}

/// What requests are about.
#[derive(Clone, Copy)]
pub(super) struct Subject<'a> {
    pub(super) robot: &'a Robot,
    /// What is around it, for `simulate`.
    pub(super) scene: Option<&'a Scene>,
}

/// Answers requests until the input ends.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let loaded = robot_source::load(&args.robot)?;
    let named = args.scene.as_deref();
    let scene = named.map(|named| scene_source::load(named, &args.robot.labs_folder));
    let scene = scene.transpose()?.map(|loaded| loaded.scene);
    let subject = Subject {
        robot: &loaded.robot,
        scene: scene.as_ref(),
    };
    let mut input = BufReader::new(std::io::stdin());
    let mut output = BufWriter::new(std::io::stdout());
    let mut refused = false;
    loop {
        let mut line = Vec::new();
        let read = (&mut input)
            .take(MOST_LINE_BYTES)
            .read_until(b'\n', &mut line)
            .map_err(|error| stream_failure(&error))?;
        if read == 0 {
            break;
        }
        let cut = line.last() != Some(&b'\n') && read as u64 == MOST_LINE_BYTES;
        if cut {
            skip_line(&mut input)?;
        }
        if line.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        let answer = if cut {
            let refusal = Refusal::new(
                "too-large",
                format!("a line has at most {MOST_LINE_BYTES} bytes"),
            );
            with_id(None, Err(refusal))
        } else {
            answer(subject, &line)
        };
        refused |= answer.contains_key("error");
        let written = serde_json::to_writer(&mut output, &Value::Object(answer))
            .map_err(std::io::Error::from)
            .and_then(|()| output.write_all(b"\n"))
            // a caller waits for each answer
            .and_then(|()| output.flush());
        match written {
            Ok(()) => {}
            Err(error) if error.kind() == ErrorKind::BrokenPipe => break,
            Err(error) => return Err(stream_failure(&error)),
        }
    }
    Ok(if refused {
        ExitCode::from(LOST)
    } else {
        ExitCode::SUCCESS
    })
}

fn stream_failure(error: &std::io::Error) -> Failure {
    Failure::fault(
        format!(
            "requests or answers could not be passed on: {}",
            disk::plain(error)
        ),
        "check the pipe",
    )
}

/// Reads on to the end of a line without keeping it.
fn skip_line(input: &mut impl std::io::BufRead) -> Result<(), Failure> {
    loop {
        let seen = input.fill_buf().map_err(|error| stream_failure(&error))?;
        let (used, ended) = match seen.iter().position(|byte| *byte == b'\n') {
            Some(end) => (end + 1, true),
            None => (seen.len(), seen.is_empty()),
        };
        input.consume(used);
        if ended {
            return Ok(());
        }
    }
}

fn answer(subject: Subject<'_>, line: &[u8]) -> Map<String, Value> {
    let request: Value = match serde_json::from_slice(line.trim_ascii_end()) {
        Ok(request) => request,
        Err(error) => return with_id(None, Err(Refusal::new("bad-json", error.to_string()))),
    };
    let Value::Object(mut request) = request else {
        let refusal = Refusal::new(
            "bad-request",
            "a request is an object, such as {\"op\": \"info\"}",
        );
        return with_id(None, Err(refusal));
    };
    let id = request.remove("id");
    with_id(id, operation::answer(subject, request))
}

fn with_id(id: Option<Value>, answer: Result<Map<String, Value>, Refusal>) -> Map<String, Value> {
    let mut whole = Map::new();
    whole.insert("id".to_owned(), id.unwrap_or(Value::Null));
    match answer {
        Ok(fields) => whole.extend(fields),
        Err(Refusal { code, message }) => {
            let error = serde_json::json!({ "code": code, "message": message });
            whole.insert("error".to_owned(), error);
        }
    }
    whole
}
