//! `kinemark compare`: two reports, or records of a book, beside each other, their runs made again from the copies kept with them.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use kinemark_course::book::Book;
use kinemark_course::grading::reopen;
use kinemark_course::student::StudentId;
use kinemark_course::submission_source::SubmissionSource;
use kinemark_grader::compare::{self, Side};
use kinemark_grader::lab::Lab;
use kinemark_grader::record::comparison::{self, Comparison};
use kinemark_grader::record::grade::{Grade, TaskKind};
use kinemark_grader::record::graded::GradedRun;
use kinemark_grader::submission::host::InProcess;
use kinemark_report::compare_text::text;
use kinemark_report::text::Detail;
use kinemark_report::visible::visible;

use crate::commands::grade::DetailArgs;
use crate::course_folder::{book_failure, grading_failure};
use crate::disk::{self, plain};
use crate::error_record::ErrorCode;
use crate::failure::Failure;
use crate::fresh_folder::{self, Entry, FreshFolder};
use crate::sandbox::RunArgs;
use crate::worker::WorkerHost;
use crate::{interrupt, output, report_folder};

/// Compare two reports of the same lab
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  kinemark compare before after\n\n\
    Shows the points of both per check and where the motions first differ, and writes compare.html with both arms in one replay. \
    The runs are repeated from the copies in the folders. A record of a course's book, such as book/records/3f/3f...json, can stand \
    for a folder: `kinemark course regrade` names those before and after a lab was changed.\n\
    See docs/watch-and-compare.md.\n\
    Exit codes: 0 compared, 2 usage or two labs, 3 a folder is not a report, 4 the grader or this machine failed.")]
pub(crate) struct Args {
    /// An output folder of `kinemark grade`, or a record of a course's book
    pub(crate) a: PathBuf,
    /// Another, of the same lab
    pub(crate) b: PathBuf,
    /// Folder to write to; an earlier comparison there is replaced
    #[arg(long, short, value_name = "DIR", default_value = "kinemark-compare")]
    pub(crate) out: PathBuf,
    /// Print the comparison as JSON
    #[arg(long, conflicts_with_all = ["verbose", "quiet"])]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) detail: DetailArgs,
    /// Whose comparison it is: a name or an id for the page's head and title
    #[arg(long, value_name = "TEXT")]
    pub(crate) label: Option<String>,
    #[command(flatten)]
    pub(crate) run: RunArgs,
}

/// The page.
const PAGE: &str = "compare.html";
/// The comparison as JSON; a folder that has it is a comparison of ours.
const RECORD: &str = "compare.json";

/// A grade, with what it was made from.
struct Graded {
    grade: Grade,
    lab: Lab,
    submission: SubmissionSource,
}

/// A grade with its runs.
struct Again {
    grade: Grade,
    lab: Lab,
    graded: GradedRun,
}

/// Compares, writes the folder, prints.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    interrupt::listen();
    args.run.sandbox.demand()?;
    refuse_foreign(&args.out)?;
    let (a, b) = (read(&args.a)?, read(&args.b)?);
    // before anything runs
    refuse_other_lab(args, &a, &b)?;
    let (a, b) = (again(args, a, &args.a)?, again(args, b, &args.b)?);
    let names = [&args.a, &args.b].map(|path| shown_name(path));
    let mut notes = changed(&a, "A");
    notes.extend(changed(&b, "B"));
    let sides = [(&a, &names[0]), (&b, &names[1])].map(|(again, name)| Side {
        name: name.as_str(),
        recorded: &again.grade,
        lab: &again.lab,
        again: &again.graded,
    });
    let mut comparison = compare::compare(&sides[0], &sides[1]).map_err(|error| {
        Failure::usage(
            visible(&error.to_string()).into_owned(),
            "name two reports of the same lab; `kinemark grade` grades a submission in another",
        )
    })?;
    comparison.notes.extend(notes);
    // neither loses the other: a full disk what is printed, an output that cannot be written the page
    let printed = match args.json {
        true => output::print_json(&comparison),
        false => output::print_lines(&text(&comparison, args.detail.detail())),
    };
    if let Err(unwritten) = write(args, &comparison, &a.graded, &b.graded) {
        if let Err(unprinted) = printed {
            unprinted.report_for_people();
        }
        return Err(unwritten);
    }
    printed?;
    if !args.json && args.detail.detail() != Detail::Total {
        let page = args.out.join(PAGE);
        output::print(&format!("comparison: {}\n", output::path(&page)))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// What was graded: of a report's folder, or of a record in a book, with the lab of that day.
fn read(path: &Path) -> Result<Graded, Failure> {
    if path.is_file() {
        return of_book(path);
    }
    let report = report_folder::read(path)?;
    Ok(Graded {
        lab: report_folder::lab_of(&report)?,
        submission: report.submission,
        grade: report.grade,
    })
}

/// What a side is called: its folder, or its record by as much of the key as anybody compares by eye.
fn shown_name(path: &Path) -> String {
    let key = path.file_stem().filter(|_| path.is_file());
    match key.and_then(|key| key.to_str()) {
        Some(key) => format!("record {}", key.chars().take(12).collect::<String>()),
        None => path.display().to_string(),
    }
}

/// The record in the file `path`, which is `records/KK/KEY.json` of a book.
fn of_book(path: &Path) -> Result<Graded, Failure> {
    let shown = output::path(path);
    let unknown = || {
        Failure::usage(
            format!("`{shown}` is no record of a course's book"),
            "name the folder of a report, or a file in book/records",
        )
    };
    let path = disk::real(path);
    let key = path.file_stem().and_then(|key| key.to_str());
    let (Some(root), Some(key)) = (path.ancestors().nth(3), key) else {
        return Err(unknown());
    };
    let book = Book::new(root);
    let record = book
        .record(key)
        .map_err(book_failure)?
        .ok_or_else(unknown)?;
    let reopened = reopen(&book, &record).map_err(grading_failure)?;
    let student = record.inputs.variant_of.as_deref().map(StudentId::new);
    let lab = match student {
        Some(Ok(student)) => reopened.lab.for_student(&student)?.lab().clone(),
        _ => reopened.lab.lab,
    };
    Ok(Graded {
        grade: record.grade,
        lab,
        submission: reopened.submission,
    })
}

fn refuse_other_lab(args: &Args, a: &Graded, b: &Graded) -> Result<(), Failure> {
    let (of_a, of_b) = (&a.grade.lab.name, &b.grade.lab.name);
    if of_a == of_b {
        return Ok(());
    }
    let [of_a, of_b] = [of_a, of_b].map(|name| visible(name));
    Err(Failure::usage(
        format!(
            "`{}` is of lab `{of_a}` and `{}` is of lab `{of_b}`: only reports of the same lab can be compared",
            args.a.display(),
            args.b.display()
        ),
        "name two reports of the same lab",
    ).coded(ErrorCode::OtherLab))
}

/// Runs a report's submission again. Hidden cases do not take part: points are those of the record, and what is compared are the
/// motions that everyone may see.
fn again(args: &Args, of: Graded, folder: &Path) -> Result<Again, Failure> {
    let Graded {
        grade,
        lab,
        submission,
    } = of;
    let graded = match args.run.in_process {
        true => submission.grade(&lab, None, &mut InProcess),
        false => submission.grade(&lab, None, &mut WorkerHost::new(None)),
    };
    let graded = graded.map_err(|_| Failure::interrupted())?;
    // what this machine did not do says nothing about either
    let mut undecided = graded
        .grade
        .tasks
        .iter()
        .filter(|t| !t.verdict.is_decided());
    if let Some(task) = undecided.next() {
        let why = task.stopped.as_ref();
        let why = why.map_or(task.verdict.name(), |stopped| &stopped.message);
        return Err(Failure::fault(
            format!(
                "task `{}` of `{}` could not be run again: {}",
                visible(&task.name),
                folder.display(),
                visible(why)
            ),
            "compare again when this machine is less busy; nothing was written",
        )
        .coded(ErrorCode::Undecided));
    }
    Ok(Again { grade, lab, graded })
}

/// What is not as the record says.
fn changed(again: &Again, name: &str) -> Vec<String> {
    let (recorded, now) = (&again.grade, &again.graded.grade);
    let mut notes = Vec::new();
    if recorded.submission.digest != now.submission.digest {
        notes.push(format!(
            "the submission in {name} has changed since it was graded: its points are from the record, its motions from the file"
        ));
    }
    for task in recorded
        .tasks
        .iter()
        .filter(|task| task.kind == TaskKind::Motion)
    {
        let made = now.tasks.iter().find(|made| made.name == task.name);
        let seconds = made.map(|made| &made.digests.seconds);
        if seconds == Some(&task.digests.seconds) {
            continue;
        }
        let same = seconds.map_or(0, |seconds| {
            let pairs = seconds.iter().zip(&task.digests.seconds);
            pairs.take_while(|(now, recorded)| now == recorded).count()
        });
        notes.push(format!(
            "the repeated motion of task `{}` of {name} differs from the recorded one from second {same} on; \
             `kinemark verify` shows more",
            task.name
        ));
    }
    notes
}

/// Checks, before anything runs, that `out` is free, empty, or an earlier comparison.
fn refuse_foreign(out: &Path) -> Result<(), Failure> {
    let record = disk::bytes_of(&out.join(RECORD), 64 << 20).ok();
    let record: Option<serde_json::Value> =
        record.and_then(|text| serde_json::from_slice(&text).ok());
    let is_ours = record.is_some_and(|record| record["format"] == comparison::FORMAT);
    let ours = |name: &str| match name {
        PAGE | RECORD if is_ours => Entry::Ours,
        _ => Entry::Foreign,
    };
    fresh_folder::refuse_foreign(out, "an earlier comparison", ours)?;
    Ok(())
}

fn write(
    args: &Args,
    comparison: &Comparison,
    a: &GradedRun,
    b: &GradedRun,
) -> Result<(), Failure> {
    let out = &args.out;
    let record = output::json(comparison)?;
    let page = kinemark_report::html::comparison(comparison, a, b, args.label.as_deref());
    let written = FreshFolder::beside(out).and_then(|fresh| {
        fresh.write(PAGE, page.as_bytes())?;
        fresh.write(RECORD, record.as_bytes())?;
        fresh.put_in_place(&[])
    });
    written.map_err(|error| {
        Failure::fault(
            format!(
                "the comparison cannot be written to `{}`: {}",
                out.display(),
                plain(&error)
            ),
            "free some space or choose another folder with --out; the comparison above stands, and nothing half-written is left",
        ).coded(ErrorCode::Unwritten)
    })
}
