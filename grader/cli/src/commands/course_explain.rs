//! `kinemark course explain`: everything behind a grade as it was given, hidden cases with their numbers, and a paragraph to send.

use std::path::PathBuf;
use std::process::ExitCode;

use kinemark_course::book::Record;
use kinemark_course::grading::{GradingError, Reopened, reopen};
use kinemark_course::history::Attempt;
use kinemark_course::staffed_lab::engine_id;
use kinemark_grader::judge;
use kinemark_report::explain_text;
use kinemark_report::html::{ViewerCode, explanation};
use owo_colors::OwoColorize as _;

use crate::course_folder::{Course, CourseArgs, book_failure};
use crate::failure::Failure;
use crate::worker::WorkerHost;
use crate::{interrupt, output};

/// Explain a grade to course staff: hidden cases and runs with their numbers, the history, and a paragraph for the student
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark course explain s1001036 01-kinematics\n  \
    kinemark course explain s1001036 01-kinematics --out complaint\n\n\
    The grade is explained as it was given, with the lab of that day, which the book keeps. Only the paragraph at the end is for the \
    student; everything else has hidden numbers.\n\
    Exit codes: 0 done, 2 usage or nothing to explain, 3 a file of the course cannot be read, 4 the grader or this machine failed."
)]
pub(crate) struct Args {
    /// The student's id
    pub(crate) student: String,
    /// A lab of the course
    pub(crate) lab: String,
    #[command(flatten)]
    pub(crate) course: CourseArgs,
    /// Write a page of each hidden case and run, with replays, into this folder
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

/// Grades again what is hidden, and prints.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let course = Course::open(&args.course)?;
    let rules = course.rules(&args.lab)?;
    let student = course.person(&args.student)?;
    let history = course.history()?;
    let index = course.index(&history)?;
    let standings = course.standings(rules, &history, &index, &[])?;
    let standing = standings
        .iter()
        .find(|standing| standing.student == student);
    let attempts = history.attempts(&rules.name, &student);
    let attempt = standing
        .and_then(|standing| standing.attempt)
        .and_then(|number| attempts.get(number - 1));
    let graded = attempt.and_then(|attempt| Some((attempt, attempt.record()?)));
    let Some((attempt, key)) = graded else {
        return Err(Failure::usage(
            format!("`{student}` has no grade in lab `{}`", rules.name),
            "`kinemark course status` shows what was handed in",
        ));
    };
    let record = course
        .book
        .record(key)
        .map_err(book_failure)?
        .ok_or_else(|| {
            Failure::broken(
                format!("the book has lost the record {key}"),
                "restore it from a copy of the book, or regrade",
            )
        })?;
    let Reopened { lab, submission } =
        reopen(&course.book, &record, &attempt.hand_in).map_err(failed)?;
    let whose = attempt.hand_in.variant_of.as_ref().unwrap_or(&student);
    let own = lab.for_student(whose)?;
    let Some(staff) = own.staff() else {
        return Err(Failure::usage(
            "the grade was given without the course staff's part, so nothing is hidden in it"
                .to_owned(),
            "its page in the book has everything",
        ));
    };
    let mut host = WorkerHost::new(None);
    let explained = judge::explain(own.lab(), staff, &submission, &mut host)
        .map_err(|_| Failure::interrupted())?;
    output::print(&past(attempt, &record))?;
    if explained.graded.grade != record.grade {
        output::print(&format!(
            "{} this engine ({}) gives another grade than the record's ({}): numbers below may differ\n",
            "note:".yellow(),
            engine_id(),
            record.inputs.engine
        ))?;
    }
    // ends with the paragraph for the student
    output::print(&explain_text::text(&explained))?;
    if let Some(out) = &args.out {
        for page in explanation(&explained, ViewerCode::Inside) {
            let path = out.join(&page.file_name);
            std::fs::create_dir_all(out).map_err(|error| output::unwritten(out, &error, HELP))?;
            output::write_file(&path, page.html.as_bytes(), HELP)?;
            output::print(&format!("page: {}\n", output::path(&path)))?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// What helps where a page cannot be written.
const HELP: &str = "free some space, or choose another folder with --out";

fn failed(error: GradingError) -> Failure {
    match error {
        GradingError::Interrupted(_) => Failure::interrupted(),
        GradingError::Lab(error) => Failure::from(*error),
        GradingError::Book(error) => book_failure(error),
    }
}

/// The grades of an attempt, the earliest first.
fn past(attempt: &Attempt, record: &Record) -> String {
    let mut out = format!("{}\n", "history".bold());
    let matched = &attempt.hand_in.matched_by;
    out += &format!("  {} read, matched by {matched}\n", attempt.read_at);
    for grade in &attempt.grades {
        let why = grade.why.as_deref().unwrap_or("graded");
        out += &format!(
            "  {} {}: {why} (record {})\n",
            grade.at,
            grade.by,
            &grade.record[..12]
        );
    }
    out += &format!(
        "  the record for fixes.toml: record = \"{}\"\n\n",
        record.key
    );
    out
}
