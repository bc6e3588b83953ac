//! `kinemark robot eval`: one request per line in, one answer per line out, in order; a bad request is answered with an error and
//! the stream goes on.

use std::io::{BufRead, BufReader, BufWriter, ErrorKind, Read as _, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use kinemark_toolbox::eval::{Code, Refusal, Subject, answer_line, operation_names, refused};
use serde_json::{Map, Value};

use crate::failure::{Failure, LOST};
use crate::output::JSON_FORMAT;
use crate::robot_source::{self, RobotArgs};
use crate::{disk, failure, scene_source};

/// Answer requests about a robot: one JSON object per line in, one per line out
#[derive(Debug, clap::Args)]
#[command(after_help = after_help())]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) robot: RobotArgs,
    /// The scene around the robot in `simulate`: a scene file, or the name of a scene of the labs
    #[arg(long, value_name = "SCENE")]
    pub(crate) scene: Option<PathBuf>,
    /// Answer in the form of every other `--json`: each line has a `format`, and errors a `help` and a `span`
    #[arg(long)]
    pub(crate) json: bool,
}

fn after_help() -> String {
    // as wide as the help is
    let operations = textwrap::fill(&format!("Operations: {}.", operation_names()), 100);
    format!(
        "Example:\n  echo '{{\"id\": 1, \"op\": \"fk\", \"q\": [0.3, -1.2]}}' | kinemark robot eval labs/robots/rrbot.toml\n\n\
        {operations}\n\
        See docs/robot-eval.md.\n\
        Exit codes: 0 every request answered, 1 some answered with an error, 2 usage, 3 the robot is broken."
    )
}

/// A longer line is refused unread.
const MOST_LINE_BYTES: u64 = 16 << 20;

/// Answers requests until the input ends.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let loaded = robot_source::load(&args.robot)?;
    if let Some(unphysical) = loaded.robot.unphysical() {
        failure::warn_alone(&unphysical.to_string());
    }
    let named = args.scene.as_deref();
    let scene = named.map(|named| scene_source::load(named, &args.robot.labs_folder));
    let scene = scene.transpose()?.map(|loaded| loaded.scene);
    let subject = Subject {
        robot: &loaded.robot,
        scene: scene.as_ref(),
    };
    let mut input = BufReader::new(std::io::stdin());
    let mut output = BufWriter::new(std::io::stdout());
    let mut some_refused = false;
    let mut requests = 0_u64;
    while let Some(line) = read_line(&mut input)? {
        if matches!(&line, Line::Whole(line) if line.iter().all(u8::is_ascii_whitespace)) {
            continue;
        }
        requests += 1;
        let answer = match line {
            Line::Whole(line) => placed(answer_line(subject, &line), requests),
            Line::TooLong => refused(Refusal {
                code: Code::TooLarge,
                message: format!("a line has at most {MOST_LINE_BYTES} bytes"),
            }),
        };
        some_refused |= answer.contains_key("error");
        let answer = match args.json {
            true => in_envelope(answer),
            false => answer,
        };
        match write_line(&mut output, answer) {
            Ok(()) => {}
            Err(error) if error.kind() == ErrorKind::BrokenPipe => break,
            Err(error) => return Err(stream_failure(&error)),
        }
    }
    Ok(ExitCode::from(if some_refused { LOST } else { 0 }))
}

/// The answer in the form of what `--json` prints elsewhere: the number of the format first, and an error with all its fields.
fn in_envelope(mut answer: Map<String, Value>) -> Map<String, Value> {
    if let Some(Value::Object(error)) = answer.get_mut("error") {
        if let Some(Value::String(code)) = error.get_mut("code") {
            *code = format!("eval::{}", code.replace('-', "_"));
        }
        for absent in ["help", "span"] {
            error.entry(absent).or_insert(Value::Null);
        }
    }
    answer.insert("format".to_owned(), JSON_FORMAT.into());
    answer
}

/// The answer to the request with this number: one that is no JSON has no `id` to be found by.
fn placed(mut answer: Map<String, Value>, number: u64) -> Map<String, Value> {
    let error = answer.get_mut("error").and_then(Value::as_object_mut);
    if let Some(error) = error.filter(|error| error.get("code") == Some(&"bad-json".into()))
        && let Some(Value::String(message)) = error.get_mut("message")
    {
        message.insert_str(0, &format!("request {number}: "));
    }
    answer
}

/// A line of the input.
enum Line {
    Whole(Vec<u8>),
    TooLong,
}

/// The next line; none at the end of the input.
fn read_line(input: &mut impl BufRead) -> Result<Option<Line>, Failure> {
    let mut line = Vec::new();
    let read = input
        .take(MOST_LINE_BYTES)
        .read_until(b'\n', &mut line)
        .map_err(|error| stream_failure(&error))?;
    if read == 0 {
        return Ok(None);
    }
    if line.last() != Some(&b'\n') && read as u64 == MOST_LINE_BYTES {
        skip_line(input)?;
        return Ok(Some(Line::TooLong));
    }
    Ok(Some(Line::Whole(line)))
}

/// Reads on to the end of a line without keeping it.
fn skip_line(input: &mut impl BufRead) -> Result<(), Failure> {
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

fn write_line(output: &mut impl Write, answer: Map<String, Value>) -> std::io::Result<()> {
    serde_json::to_writer(&mut *output, &Value::Object(answer))?;
    output.write_all(b"\n")?;
    // a caller waits for each answer
    output.flush()
}

fn stream_failure(error: &std::io::Error) -> Failure {
    Failure::fault(
        format!("standard input or output failed: {}", disk::plain(error)),
        "check the pipe",
    )
}
