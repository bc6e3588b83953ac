//! `kinemark course regrade`: what a new lab, staff part or engine would change, as a table; and the change, once somebody says why.

use std::fmt::Write as _;
use std::process::ExitCode;

use kinemark_course::book::Record;
use kinemark_course::course_file::CourseLab;
use kinemark_course::grading::{self, GradingError, Outcome};
use kinemark_course::history::History;
use kinemark_course::journal::{Event, Graded, HandIn};
use kinemark_course::staffed_lab::{StaffedLab, engine_id};
use kinemark_course::standing::counting;
use kinemark_grader::record::quantity::points;
use owo_colors::OwoColorize as _;
use serde::Serialize;

use super::course_check;
use crate::course_folder::{Course, CourseArgs, book_failure, index_failure};
use crate::course_log::CourseLog;
use crate::failure::{FAULT, Failure, LOST};
use crate::sandbox::SandboxArgs;
use crate::worker::WorkerHost;
use crate::{interrupt, output, pool};

/// Show who would gain and who would fall if a lab were graded again as it is now, and do so with --apply
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  kinemark course regrade 01-kinematics\n  \
    kinemark course regrade 01-kinematics --apply --why \"the band of ik was too narrow\"\n\n\
    Without --apply nothing changes but the cache of records. Nobody's points fall without --allow-lower: who would fall keeps the \
    grade they have. Points by hand stay, and are marked as stale where their record changed.\n\
    Exit codes: 0 done, or nothing is out of date, 1 grades are out of date or would fall, 2 usage, 3 the course or the lab is \
    broken, 4 the grader or this machine failed.")]
pub(crate) struct Args {
    /// A lab of the course
    pub(crate) lab: String,
    #[command(flatten)]
    pub(crate) course: CourseArgs,
    /// Write the new grades
    #[arg(long, requires = "why")]
    pub(crate) apply: bool,
    /// Why, for the history
    #[arg(long, value_name = "TEXT")]
    pub(crate) why: Option<String>,
    /// Lower points, too
    #[arg(long, requires = "apply")]
    pub(crate) allow_lower: bool,
    /// Number of submissions graded at once [default: one a processor]
    #[arg(long, value_name = "N")]
    pub(crate) jobs: Option<usize>,
    #[command(flatten)]
    pub(crate) sandbox: SandboxArgs,
    /// Print the changes as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// What becomes of one hand-in.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Change {
    student: String,
    hand_in: String,
    /// Absent where the record is lost, and with it what it earned.
    points_before: Option<f64>,
    points_after: f64,
    /// The maximum of the lab that the grade is of, and that of today; absent where the record is lost.
    max_before: Option<f64>,
    max_after: Option<f64>,
    /// Checks whose points change.
    checks: Vec<CheckChange>,
    record_before: String,
    record_after: String,
    /// Whether the new grade was written.
    applied: bool,
}

/// Where points go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    Gain,
    Fall,
    Same,
    /// Nobody knows, because the record is lost.
    Lost,
}

impl Change {
    fn way(&self) -> Way {
        match self.points_before {
            None => Way::Lost,
            Some(before) if self.points_after > before => Way::Gain,
            Some(before) if self.points_after < before => Way::Fall,
            Some(_) => Way::Same,
        }
    }

    /// Whether points get fewer, or may do so because nobody knows how many there were.
    fn may_fall(&self) -> bool {
        matches!(self.way(), Way::Fall | Way::Lost)
    }
}

/// How the points of a check change; absent on a side where there is no such check.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct CheckChange {
    check: String,
    before: Option<f64>,
    after: Option<f64>,
}

/// Grades what is out of date, prints the table, and writes it if that is wanted.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    interrupt::listen();
    args.sandbox.demand()?;
    let course = Course::open(&args.course)?;
    let rules = course.rules(&args.lab)?;
    if args.why.as_ref().is_some_and(|why| why.trim().is_empty()) {
        return Err(Failure::usage(
            "--why is empty".to_owned(),
            "write the sentence that students may read",
        ));
    }
    let staffed = course_check::ready(&course, rules)?;
    let history = course.history()?;
    let old = out_of_date(&course, rules, &history, &staffed)?;
    let (mut changes, failed) = graded_again(&course, &staffed, &old, args.jobs)?;
    if interrupt::asked() {
        return Err(Failure::paused());
    }
    if args.apply {
        let why = args.why.as_deref().unwrap_or_default();
        apply(&course, &mut changes, why, args.allow_lower)?;
        let history = course.history()?;
        let mut index = course.index(&history)?;
        course.put_standings(&history, &mut index)?;
    }
    if args.json {
        output::print_list("changes", &changes)?;
    } else {
        output::print(&text(args, &course, &changes, &failed))?;
    }
    let is_open = |change: &Change| !change.applied;
    Ok(if !failed.is_empty() {
        ExitCode::from(FAULT)
    } else if changes.iter().any(is_open) {
        ExitCode::from(LOST)
    } else {
        ExitCode::SUCCESS
    })
}

/// A grade that was made with another lab, staff part or engine than today's.
struct Old {
    hand_in: HandIn,
    /// The key of its record.
    record: String,
    /// Its points, as the journal has them.
    points: Option<f64>,
}

/// Hand-ins that count, or may count, with a grade of another lab, staff part or engine than today's.
fn out_of_date(
    course: &Course,
    rules: &CourseLab,
    history: &History,
    lab: &StaffedLab,
) -> Result<Vec<Old>, Failure> {
    let index = course.index(history)?;
    let summaries = index.summaries(&rules.name).map_err(index_failure)?;
    let mut old = Vec::new();
    for (_, attempts) in history.of_lab(&rules.name) {
        for attempt in counting(rules.attempts, attempts) {
            let Some(key) = attempt.record() else {
                continue;
            };
            let is_of_today = summaries.get(key).is_some_and(|summary| {
                summary.engine == engine_id()
                    && summary.lab_version == lab.lab_version
                    && summary.staff_version == lab.staff_version
            });
            if !is_of_today {
                old.push(Old {
                    hand_in: attempt.hand_in.clone(),
                    record: key.to_owned(),
                    points: attempt.grades.last().and_then(|grade| grade.points),
                });
            }
        }
    }
    Ok(old)
}

/// The changes, by student, and the students whose work this machine failed at.
fn graded_again(
    course: &Course,
    lab: &StaffedLab,
    old: &[Old],
    jobs: Option<usize>,
) -> Result<(Vec<Change>, Vec<String>), Failure> {
    let book = &course.book;
    let mut changes = Vec::new();
    let mut failed = Vec::new();
    pool::run(
        old,
        jobs.unwrap_or_else(pool::default_jobs),
        |old| old.hand_in.student.to_string(),
        |old, host: &mut WorkerHost| grading::grade(lab, book, &old.hand_in, host, true),
        |old, result| -> Result<bool, Failure> {
            match result {
                Ok(Outcome::Recorded { record, .. }) => {
                    let read = |key: &str| book.record(key).map_err(book_failure);
                    changes.push(change(old, read(&old.record)?, &record, read(&record)?));
                    Ok(false)
                }
                Ok(Outcome::NotGraded { .. }) => {
                    failed.push(old.hand_in.student.to_string());
                    Ok(true)
                }
                Err(GradingError::Interrupted(_)) => Ok(false),
                Err(GradingError::Lab(error)) => Err(Failure::from(*error)),
                Err(GradingError::Book(error)) => Err(book_failure(error)),
            }
        },
    )?;
    changes.sort_by(|one: &Change, other| {
        (&one.student, &one.hand_in).cmp(&(&other.student, &other.hand_in))
    });
    failed.sort();
    Ok((changes, failed))
}

fn change(old: &Old, before: Option<Record>, key_after: &str, after: Option<Record>) -> Change {
    let hand_in = &old.hand_in;
    let earned = |record: &Option<Record>| record.as_ref().map(|record| record.grade.points);
    let most = |record: &Option<Record>| record.as_ref().map(|record| record.grade.max_points);
    let before_checks = check_points(before.as_ref());
    let after_checks = check_points(after.as_ref());
    let of = |checks: &[(String, f64)], name: &str| {
        let mut checks = checks.iter();
        checks
            .find(|(known, _)| known == name)
            .map(|(_, points)| *points)
    };
    let mut names: Vec<&String> = before_checks.iter().map(|(name, _)| name).collect();
    let new = after_checks.iter().map(|(name, _)| name);
    names.extend(new.filter(|name| of(&before_checks, name).is_none()));
    let checks = names.into_iter().filter_map(|name| {
        let (before, after) = (of(&before_checks, name), of(&after_checks, name));
        (before != after).then(|| CheckChange {
            check: name.clone(),
            before,
            after,
        })
    });
    Change {
        student: hand_in.student.to_string(),
        hand_in: hand_in.id.clone(),
        points_before: earned(&before).or(old.points),
        points_after: earned(&after).unwrap_or_default(),
        max_before: most(&before),
        max_after: most(&after),
        checks: checks.collect(),
        record_before: old.record.clone(),
        record_after: key_after.to_owned(),
        applied: false,
    }
}

/// Points of each check by `TASK/CHECK`, in order.
fn check_points(record: Option<&Record>) -> Vec<(String, f64)> {
    let tasks = record.into_iter().flat_map(|record| &record.grade.tasks);
    let checks = tasks.flat_map(|task| {
        let name = |check: &str| format!("{}/{check}", task.name);
        task.checks
            .iter()
            .map(move |check| (name(&check.name), check.points))
    });
    checks.collect()
}

/// Writes the changes into the history, but for those who would fall, unless that is allowed.
fn apply(
    course: &Course,
    changes: &mut [Change],
    why: &str,
    allow_lower: bool,
) -> Result<(), Failure> {
    let mut log = CourseLog::new(course);
    for change in changes {
        if change.may_fall() && !allow_lower {
            continue;
        }
        log.append(Event::Graded(Graded {
            hand_in: change.hand_in.clone(),
            record: change.record_after.clone(),
            points: Some(change.points_after),
            why: Some(why.to_owned()),
        }))?;
        change.applied = true;
    }
    log.finish()
}

fn text(args: &Args, course: &Course, changes: &[Change], failed: &[String]) -> String {
    let mut out = String::new();
    if changes.is_empty() && failed.is_empty() {
        return format!(
            "{}: every grade is of today's lab and engine\n",
            args.lab.bold()
        );
    }
    for (way, title) in [
        (Way::Gain, "gain"),
        (Way::Fall, "would fall"),
        (Way::Lost, "had points that are lost with their record"),
    ] {
        push_table(&mut out, title, changes, way);
    }
    let of = |way: Way| changes.iter().find(move |change| change.way() == way);
    // those who would fall are listed last, and looked at first
    if let Some(change) = of(Way::Fall).or(of(Way::Gain)) {
        let path = |key: &str| output::path(&course.book.record_path(key));
        let _ = writeln!(
            out,
            "{} kinemark compare {} {}",
            "side by side:".cyan(),
            path(&change.record_before),
            path(&change.record_after)
        );
    }
    let same = changes.iter().filter(|change| change.way() == Way::Same);
    let same = same.count();
    if same > 0 {
        let _ = writeln!(out, "{same} keep their points");
    }
    if !failed.is_empty() {
        let _ = writeln!(
            out,
            "not graded, because this machine or the grader failed: {}",
            failed.join(", ")
        );
    }
    let applied = changes.iter().filter(|change| change.applied).count();
    if args.apply {
        let _ = writeln!(
            out,
            "{applied} written, with why: {}",
            args.why.as_deref().unwrap_or_default()
        );
        let kept = changes.len() - applied;
        if kept > 0 {
            let _ = writeln!(
                out,
                "{kept} keep the grade they have: --allow-lower lowers them"
            );
        }
    } else {
        let _ = writeln!(
            out,
            "{} kinemark course regrade {} --apply --why \"...\"",
            "next:".cyan(),
            args.lab
        );
    }
    out
}

/// Those who go one way, a line each.
fn push_table(out: &mut String, title: &str, changes: &[Change], way: Way) {
    let chosen: Vec<&Change> = changes
        .iter()
        .filter(|change| change.way() == way)
        .collect();
    if chosen.is_empty() {
        return;
    }
    let _ = writeln!(out, "{} {title}:", chosen.len());
    for change in chosen {
        let [before, after] = totals(change);
        let _ = writeln!(
            out,
            "  {:<20} {before:>6} -> {after:<6} {}",
            change.student,
            by_check(change)
        );
    }
}

/// The points before and after; where the lab counts to another maximum by now, each with its own: `24/24`, `20.7/21`.
fn totals(change: &Change) -> [String; 2] {
    let total = |earned: f64, most: Option<f64>| match most {
        Some(most) if change.max_before != change.max_after => {
            format!("{}/{}", points(earned), points(most))
        }
        _ => points(earned),
    };
    [
        change
            .points_before
            .map_or_else(|| "?".to_owned(), |before| total(before, change.max_before)),
        total(change.points_after, change.max_after),
    ]
}

/// Which checks change, in a line: `ik/reach 0 -> 5`.
fn by_check(change: &Change) -> String {
    let shown = |earned: Option<f64>| earned.map_or_else(|| "none".to_owned(), points);
    let checks = change.checks.iter().map(|check| {
        format!(
            "{} {} -> {}",
            check.check,
            shown(check.before),
            shown(check.after)
        )
    });
    checks.collect::<Vec<_>>().join(", ")
}
