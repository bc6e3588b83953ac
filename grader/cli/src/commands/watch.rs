//! `kinemark watch`: a submission graded on every save, with its report open beside it.

use std::io::Write as _;
use std::process::ExitCode;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use kinemark_grader::record::grade::Grade;
use kinemark_grader::record::quantity::points;
use kinemark_report::moment::{FirstLoss, look_first};
use kinemark_report::text::{Detail, detailed};
use kinemark_report::visible::{visible, visible_json};
use kinemark_sim::text::number::seconds;
use tokio::sync::watch;

use super::grade::{self, Build, Request, Work};
use crate::error_record::ErrorEnvelope;
use crate::failure::{self, Failure};
use crate::project::Project;
use crate::saves::{Saves, WatchEvent};
use crate::serve::{self, ServeArgs, Server};
use crate::{interrupt, named_submission, output};

/// Grade on every save, and keep the report open
#[derive(Debug, clap::Args)]
#[group(id = "watch")] // its own name is that of the arguments of `grade`
#[command(
    after_help = "Examples:\n  kinemark watch\n  kinemark watch 01-kinematics submission.rhai\n\n\
    Grades at once, and again whenever the submission is saved, or the lab if it is in a folder. In practice a project in Rust or C is \
    built first, whenever a source of it is saved; what the compiler reports is in the terminal and in the page. The report opens in the browser \
    and reloads at the same moment and position. With --json each grade is one line; with --verbose every grade is printed in full.\n\
    See docs/watch-and-compare.md.\n\
    Exit codes: 0 ended by Ctrl-C, 2 usage, 3 the lab is broken at the start, 4 the grader or this machine failed."
)]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) grade: grade::Args,
    #[command(flatten)]
    pub(crate) serve: ServeArgs,
}

/// How long nothing must happen after a save: editors write, rename and write again.
const QUIET: Duration = Duration::from_millis(100);
/// Happenings that are waited out at most: something that never ends must not keep a grade away.
const MOST_HAPPENINGS: usize = 1_000;

/// Grades at once and on every save, until Ctrl-C.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let (sender, events) = channel();
    let (stop, stopped) = watch::channel(false);
    let on_stop = sender.clone();
    interrupt::listen_and(move || {
        // nobody listening any more is the end, too
        let _ = stop.send(true);
        let _ = on_stop.send(WatchEvent::Stop);
    });
    let mut request = args.grade.filled()?;
    if named_submission::is_input(&request.submission) {
        return Err(Failure::usage(
            "nothing is saved to standard input, so there is nothing to watch".to_owned(),
            "name the file of the submission, or grade it once: `kinemark grade LAB -`",
        ));
    }
    if request.build == Build::No {
        request.build = Build::InPractice;
    }
    // listened to before the first grade: what is saved while it runs counts
    let _saves = Saves::listen(&request, sender)?;
    let first = match grade::work(&request) {
        Ok(work) => work,
        Err(_) if interrupt::asked() => return Ok(ExitCode::SUCCESS),
        Err(failure) => return Err(failure),
    };
    let (count, changes) = watch::channel(0_u64);
    if let Some(labs) = &first.labs {
        failure::note_in_words(labs);
    }
    publish(&request, &first, &count)?;
    let server = Server::bind(&request.out, args.serve.port, Some(changes))?;
    let address = server.address();
    say(
        args,
        &format!(
            "{} is open at {address}\ngraded again on every save; end with Ctrl-C\n",
            output::path(&request.out)
        ),
    )?;
    if !args.serve.no_open {
        serve::open(&address);
    }
    std::thread::scope(|threads| {
        let serving = threads.spawn(|| server.run(stopped));
        follow(&request, &events, &count)?;
        // it ended by the same Ctrl-C
        serving.join().unwrap_or_else(|_| {
            Err(Failure::fault(
                "the server of the report ended by a fault of its own".to_owned(),
                "please report this; the reports that were written stand",
            ))
        })
    })?;
    Ok(ExitCode::SUCCESS)
}

/// Grades whenever something was saved.
fn follow(
    request: &Request<'_>,
    events: &Receiver<WatchEvent>,
    count: &watch::Sender<u64>,
) -> Result<(), Failure> {
    let mut is_gone = false;
    loop {
        // it ends when nothing sends events any more
        let Ok(mut what) = events.recv() else {
            return Ok(());
        };
        for _ in 0..MOST_HAPPENINGS {
            if what == WatchEvent::Stop {
                return Ok(());
            }
            match events.recv_timeout(QUIET) {
                Ok(next) => what = next,
                Err(_) => break,
            }
        }
        let project = Project::of(&request.submission);
        if !request.submission.exists() && !project.is_some_and(|project| project.is_there()) {
            if !is_gone {
                let name = output::path(&request.submission);
                print_beside(&format!(
                    "{name} is gone; it is graded again when it is back\n"
                ));
            }
            is_gone = true;
            continue;
        }
        is_gone = false;
        let graded = grade::work(request);
        match graded.and_then(|work| publish(request, &work, count)) {
            Ok(()) => {}
            Err(_) if interrupt::asked() => return Ok(()),
            // a lab that is broken for the moment, a variant that is half typed, a full disk
            Err(failure) => {
                print_record(request, &failure);
                failure.report_for_people();
            }
        }
    }
}

/// Prints a grade in one line, writes the folder, and notifies open pages.
fn publish(request: &Request<'_>, work: &Work, count: &watch::Sender<u64>) -> Result<(), Failure> {
    let grade = &work.graded.grade;
    let line = match request.args.json {
        true => serde_json::to_string(grade).map(|text| visible_json(text) + "\n"),
        false => Ok(line(grade, work.note.as_deref()) + in_full(request, grade).as_str()),
    };
    let line = line.map_err(|error| {
        Failure::fault(
            format!("a value could not be written as JSON: {error}"),
            "please report this",
        )
    })?;
    // an output that cannot be written must not lose the report
    let printed = match request.args.json {
        true => output::print(&line),
        false => output::print_lines(&line),
    };
    grade::write(request, work)?;
    count.send_modify(|count| *count += 1);
    printed
}

/// Prints in a line what programs read of a failure, if this is for programs.
fn print_record(request: &Request<'_>, failure: &Failure) {
    let envelope = ErrorEnvelope::of(failure.record());
    if let (true, Ok(text)) = (request.args.json, serde_json::to_string(&envelope)) {
        // an output that cannot be written must not end the watch
        let _ = output::print(&(visible_json(text) + "\n"));
    }
}

/// The whole grade, where that is asked for.
fn in_full(request: &Request<'_>, grade: &Grade) -> String {
    match request.args.detail.detail() {
        Detail::Everything => detailed(grade, Detail::Everything),
        Detail::Folded | Detail::Total => String::new(),
    }
}

/// What is for people alone stands beside the JSON.
fn say(args: &Args, text: &str) -> Result<(), Failure> {
    if args.grade.json {
        print_beside(text);
        return Ok(());
    }
    output::print(text)
}

/// Prints to standard error, which is not part of the JSON.
fn print_beside(text: &str) {
    // a reader that has gone away is no failure
    let _ = anstream::stderr().write_all(text.as_bytes());
}

/// A grade in a line: points, verdict, and where to look first.
fn line(grade: &Grade, note: Option<&str>) -> String {
    let mut line = format!(
        "{} of {} points, {}",
        points(grade.points),
        points(grade.max_points),
        grade.verdict.name()
    );
    if let Some(loss) = look_first(grade) {
        line += &format!("; {}", lost(&loss));
    }
    if let Some(note) = note {
        line += &format!(" ({note})");
    }
    line + "\n"
}

/// Where a task lost its first points, in words.
fn lost(loss: &FirstLoss<'_>) -> String {
    let task = &loss.task.name;
    let Some(check) = loss.check else {
        let stopped = loss.task.stopped.as_ref();
        let line = stopped.and_then(|stopped| stopped.line);
        let line = line.map_or(String::new(), |line| format!(", line {line}"));
        let message = stopped.map_or("", |stopped| &stopped.message);
        return format!("{task}{line}: {}", visible(message));
    };
    let at = loss
        .at
        .map_or(String::new(), |at| format!(" at {}", seconds(at.time_s)));
    let why = match check.evidence.first() {
        Some(evidence) => visible(&evidence.message),
        None => visible(&check.title),
    };
    format!(
        "{task}{at}, {}: {}/{}, {why}",
        check.name,
        points(check.points),
        points(check.max_points)
    )
}
