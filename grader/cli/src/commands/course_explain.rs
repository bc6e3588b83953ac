//! `kinemark course explain`: everything behind a grade as it was given, hidden cases with their numbers, and a paragraph to send.

use std::path::PathBuf;
use std::process::ExitCode;

use jiff::Timestamp;
use kinemark_course::book::Record;
use kinemark_course::course_file::CourseLab;
use kinemark_course::grading::{GradingError, Reopened, reopen};
use kinemark_course::history::{Attempt, History};
use kinemark_course::staffed_lab::engine_id;
use kinemark_course::student::StudentId;
use kinemark_grader::record::explanation::{ExplainedDraw, Explanation};
use kinemark_grader::record::hints::CheckHints;
use kinemark_report::html::{ViewerCode, explanation};
use kinemark_report::{explain_text, student_reply};
use owo_colors::OwoColorize as _;
use serde::Serialize;

use crate::course_folder::{Course, CourseArgs, book_failure};
use crate::failure::Failure;
use crate::worker::WorkerHost;
use crate::{interrupt, listed_folder, output};

/// Explain a grade to course staff: hidden cases and runs with their numbers, the history, and a paragraph for the student
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark course explain s1001036 01-kinematics\n  \
    kinemark course explain s1001036 01-kinematics --out complaint\n  \
    kinemark course explain s1001036 01-kinematics --attempt 1\n\n\
    The grade is explained as it was given, with the lab of that day, which the book keeps. Without --attempt and --record it is the \
    grade that counts. Only the paragraph at the end is for the student; everything else has hidden numbers.\n\
    Exit codes: 0 done, 2 usage or nothing to explain, 3 a file of the course cannot be read, 4 the grader or this machine failed."
)]
pub(crate) struct Args {
    /// The student's id
    pub(crate) student: String,
    /// A lab of the course
    pub(crate) lab: String,
    /// The grade of this attempt, from 1
    #[arg(long, value_name = "N")]
    pub(crate) attempt: Option<usize>,
    /// An earlier grade, by the key of its record or the beginning of it, as the history shows it
    #[arg(long, value_name = "KEY", conflicts_with = "attempt")]
    pub(crate) record: Option<String>,
    #[command(flatten)]
    pub(crate) course: CourseArgs,
    /// Write a page of each hidden case and run, with replays, into this folder
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print everything as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// The fewest characters of a key that name a record.
const LEAST_KEY: usize = 6;

/// A grade that was given.
struct Given<'h> {
    attempt: &'h Attempt,
    /// The number of the attempt, from one.
    number: usize,
    key: &'h str,
}

/// Everything, for programs of the course staff.
#[derive(Serialize)]
struct Explained<'a> {
    student: &'a StudentId,
    lab: &'a str,
    record: &'a str,
    /// Whether it is the grade that counts.
    counts: bool,
    engine: &'a str,
    points: f64,
    max_points: f64,
    /// Whether this engine gives the grade of the record again; if not, the numbers below may differ from those of that day.
    is_same_grade: bool,
    history: Vec<PastAttempt<'a>>,
    /// Hidden cases and runs, with their numbers.
    hidden: Vec<&'a ExplainedDraw>,
    /// All hints of the checks that lost points.
    hints: Vec<&'a CheckHints>,
    /// What can be sent to the student.
    paragraph: String,
    pages: Vec<String>,
}

/// An attempt, and the grades that it had.
#[derive(Serialize)]
struct PastAttempt<'a> {
    /// From one.
    attempt: usize,
    read_at: Timestamp,
    matched_by: &'a str,
    /// The earliest first; the last one stands.
    grades: Vec<PastGrade<'a>>,
}

#[derive(Serialize)]
struct PastGrade<'a> {
    at: Timestamp,
    by: &'a str,
    why: Option<&'a str>,
    record: &'a str,
}

/// Grades again what is hidden, and prints.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let course = Course::open(&args.course)?;
    let rules = course.rules(&args.lab)?;
    let student = course.person(&args.student)?;
    let history = course.history()?;
    let attempts = history.attempts(&rules.name, &student);
    let open = course.open_files(rules)?;
    let counting = counting(&course, rules, &history, &student, &open.students)?;
    let has_open_file = open.students.contains(&student);
    let given =
        given(args, attempts, counting).ok_or_else(|| nothing(args, attempts, has_open_file))?;
    let record = record(&course, given.key)?;
    let explained = explained(&course, &record, given.attempt, &student)?;
    let counts = counting
        .is_some_and(|number| number == given.number && given.attempt.record() == Some(given.key));
    let pages = pages(args, &explained)?;
    let is_same_grade = explained.graded.grade == record.grade;
    if args.json {
        output::print_formatted(&Explained {
            student: &student,
            lab: &rules.name,
            record: &record.key,
            counts,
            engine: &record.inputs.engine,
            points: record.grade.points,
            max_points: record.grade.max_points,
            is_same_grade,
            history: past(attempts),
            hidden: explained.draws().collect(),
            hints: explained.hints.of_losses(&explained.graded.grade),
            paragraph: student_reply::paragraph(&explained),
            pages,
        })?;
        return Ok(ExitCode::SUCCESS);
    }
    output::print_lines(&explain_text::text(&explained))?;
    output::print_lines(&past_text(attempts, &record))?;
    let mut notes = Vec::new();
    if !counts {
        notes.push("this is not the grade that counts".to_owned());
    }
    if has_open_file {
        notes.push(format!(
            "a file of {student} waits for a person: `kinemark course status {}`",
            rules.name
        ));
    }
    if !is_same_grade {
        notes.push(other_grade(&record));
    }
    for note in notes {
        output::print(&format!("{} {note}\n", "note:".yellow()))?;
    }
    for page in pages {
        output::print(&format!("page: {page}\n"))?;
    }
    output::print(&format!(
        "\n{}\n{}\n",
        "To send to the student, without hidden numbers:".bold(),
        student_reply::paragraph(&explained)
    ))?;
    Ok(ExitCode::SUCCESS)
}

/// The number of the attempt that counts, from one.
fn counting(
    course: &Course,
    rules: &CourseLab,
    history: &History,
    student: &StudentId,
    open: &[StudentId],
) -> Result<Option<usize>, Failure> {
    let index = course.index(history)?;
    let standings = course.standings(rules, history, &index, open)?;
    let mut standings = standings.iter();
    let standing = standings.find(|standing| standing.student == *student);
    Ok(standing.and_then(|standing| standing.attempt))
}

/// The grade that was named, else the one that counts; none where there is no such grade, or several.
fn given<'h>(args: &Args, attempts: &'h [Attempt], counting: Option<usize>) -> Option<Given<'h>> {
    if let Some(key) = args.record.as_deref().map(str::trim) {
        let key = key.to_ascii_lowercase();
        let numbered = attempts.iter().zip(1..);
        let mut found: Vec<Given<'h>> = Vec::new();
        for (attempt, number) in numbered.filter(|_| key.len() >= LEAST_KEY) {
            for grade in &attempt.grades {
                let is_new = found.iter().all(|known| known.key != grade.record);
                if is_new && grade.record.starts_with(&key) {
                    let key = &grade.record;
                    found.push(Given {
                        attempt,
                        number,
                        key,
                    });
                }
            }
        }
        let one = found.pop()?;
        return found.is_empty().then_some(one);
    }
    let number = args.attempt.or(counting)?;
    let attempt = attempts.get(number.checked_sub(1)?)?;
    let key = attempt.record()?;
    Some(Given {
        attempt,
        number,
        key,
    })
}

/// Why there is nothing to explain.
fn nothing(args: &Args, attempts: &[Attempt], has_open_file: bool) -> Failure {
    let (student, lab) = (&args.student, &args.lab);
    let grades = attempts.iter().zip(1..).flat_map(|(attempt, number)| {
        let grades = attempt.grades.iter();
        grades.map(move |grade| format!("{} (attempt {number})", &grade.record[..12]))
    });
    let grades: Vec<String> = grades.collect();
    let known = match grades.len() {
        0 => "`kinemark course status` shows what was handed in".to_owned(),
        _ => format!("there are these records: {}", grades.join(", ")),
    };
    let message = match (&args.record, args.attempt) {
        (Some(key), _) => {
            format!("`{student}` has no grade, or more than one, whose record begins with `{key}`")
        }
        (None, Some(number)) => {
            format!("`{student}` has no grade of an attempt {number} at lab `{lab}`")
        }
        (None, None) if has_open_file => {
            format!("`{student}` has no grade in lab `{lab}`: a file of theirs waits for a person")
        }
        (None, None) => format!("`{student}` has no grade in lab `{lab}`"),
    };
    Failure::usage(message, &known)
}

fn record(course: &Course, key: &str) -> Result<Record, Failure> {
    let record = course.book.record(key).map_err(book_failure)?;
    record.ok_or_else(|| {
        Failure::broken(
            format!("the book has lost the record {key}"),
            "restore it from a copy of the book, or regrade",
        )
    })
}

/// The explanation of a record, with the lab and the staff part of its day.
fn explained(
    course: &Course,
    record: &Record,
    attempt: &Attempt,
    student: &StudentId,
) -> Result<Explanation, Failure> {
    let Reopened { lab, submission } = reopen(&course.book, record).map_err(failed)?;
    let whose = attempt.hand_in.variant_of.as_ref().unwrap_or(student);
    let own = lab.for_student(whose)?;
    let Some(staff) = own.staff() else {
        return Err(Failure::usage(
            "the grade was given without the course staff's part, so nothing is hidden in it"
                .to_owned(),
            "its page in the book has everything",
        ));
    };
    let mut host = WorkerHost::new(None);
    let explained = submission.explain(own.lab(), staff, &mut host);
    explained.map_err(|_| Failure::interrupted())
}

/// Writes the pages where they are wanted, and gives their paths.
fn pages(args: &Args, explained: &Explanation) -> Result<Vec<String>, Failure> {
    let Some(out) = &args.out else {
        return Ok(Vec::new());
    };
    let pages = explanation(explained, ViewerCode::Inside);
    let files = pages
        .iter()
        .map(|page| (page.file_name.as_str(), page.html.as_bytes()));
    let files: Vec<(&str, &[u8])> = files.collect();
    listed_folder::write(out, &files)?;
    let paths = files.iter().map(|(name, _)| output::path(&out.join(name)));
    Ok(paths.collect())
}

/// What is said where the grade cannot be made again.
fn other_grade(record: &Record) -> String {
    let engine = engine_id();
    if record.inputs.engine == engine {
        return "the record has another grade than the book's lab and submission give: was the book changed by hand?".to_owned();
    }
    format!(
        "this engine ({engine}) gives another grade than the record's ({}): the numbers above may differ from those of that day",
        record.inputs.engine
    )
}

fn failed(error: GradingError) -> Failure {
    match error {
        GradingError::Interrupted(_) => Failure::interrupted(),
        GradingError::Lab(error) => Failure::from(*error),
        GradingError::Book(error) => book_failure(error),
    }
}

fn past(attempts: &[Attempt]) -> Vec<PastAttempt<'_>> {
    let attempts = attempts.iter().zip(1..);
    attempts
        .map(|(attempt, number)| PastAttempt {
            attempt: number,
            read_at: attempt.read_at,
            matched_by: &attempt.hand_in.matched_by,
            grades: attempt
                .grades
                .iter()
                .map(|grade| PastGrade {
                    at: grade.at,
                    by: &grade.by,
                    why: grade.why.as_deref(),
                    record: &grade.record,
                })
                .collect(),
        })
        .collect()
}

/// All attempts with their grades, the earliest first, and the key of the record that is explained.
fn past_text(attempts: &[Attempt], record: &Record) -> String {
    let mut out = format!("\n{}\n", "History".bold());
    for of in past(attempts) {
        let (number, read_at, matched) = (of.attempt, of.read_at, of.matched_by);
        out += &format!("  attempt {number}: {read_at} read, matched by {matched}\n");
        for grade in of.grades {
            let why = grade.why.unwrap_or("graded");
            let mark = if grade.record == record.key {
                ", explained here"
            } else {
                ""
            };
            let key = &grade.record[..12];
            out += &format!(
                "    {} {}: {why} (record {key}{mark})\n",
                grade.at, grade.by
            );
        }
    }
    out += &format!("  the record for fixes.toml: record = \"{}\"\n", record.key);
    out
}
