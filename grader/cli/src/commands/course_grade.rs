//! `kinemark course grade`: what the LMS exported, read, matched to students and graded; again, it goes on where it stopped.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::process::ExitCode;

use kinemark_course::course_file::CourseLab;
use kinemark_course::grading::{self, GradingError, Outcome};
use kinemark_course::history::History;
use kinemark_course::intake::{self, Decision};
use kinemark_course::journal::{Event, Graded, HandIn};
use kinemark_course::staffed_lab::StaffedLab;
use kinemark_course::standing::{Standing, Status, counting};
use kinemark_grader::record::verdict::Verdict;
use owo_colors::OwoColorize as _;

use super::course_check;
use crate::course_folder::{Course, CourseArgs, book_failure, index_failure, intake_failure};
use crate::course_log::CourseLog;
use crate::failure::{FAULT, Failure, LOST};
use crate::shard::Shard;
use crate::worker::WorkerHost;
use crate::{interrupt, output, pool};

/// Grade what was handed in: an archive or a folder of the LMS, or whatever of a lab is not graded yet
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark course grade ~/Downloads/lab1.zip 01-kinematics\n  kinemark course grade 01-kinematics\n  \
    kinemark course grade lab1.zip 01-kinematics --shard 2/4\n\n\
    SOURCE is what Moodle, Canvas or Gradescope exported, a folder of repositories, or files named by id. The same command again \
    goes on where it stopped; without SOURCE it grades what is in the book and reads fixes.toml again.\n\
    Exit codes: 0 everybody who handed in has a grade, 1 something needs a person, 2 usage, 3 the course or the lab is broken, \
    4 the grader or this machine failed."
)]
pub(crate) struct Args {
    /// What the LMS exported, if anything is new, and the lab
    #[arg(value_names = ["SOURCE", "LAB"], num_args = 1..=2, required = true)]
    pub(crate) what: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) course: CourseArgs,
    /// Number of submissions graded at once [default: one a processor]
    #[arg(long, value_name = "N")]
    pub(crate) jobs: Option<usize>,
    /// Write no page of each submission: faster, and smaller
    #[arg(long)]
    pub(crate) no_reports: bool,
    /// Grade only a part of the class, such as 2/4: parts are graded on several machines and joined by copying their books
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,
    /// Print how everybody stands as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Reads, grades, prints.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let (source, lab) = match args.what.as_slice() {
        [source, lab] => (Some(source), lab),
        [lab] => (None, lab),
        // clap lets no more through
        _ => {
            return Err(Failure::usage(
                "name what the LMS exported and the lab".to_owned(),
                "such as `kinemark course grade lab1.zip 01-kinematics`",
            ));
        }
    };
    let course = Course::open(&args.course)?;
    let rules = course.rules(&lab.to_string_lossy())?;
    let staffed = course_check::ready(&course, rules)?;

    let mut log = CourseLog::new(&course);
    take_in(&course, rules, source, &mut log)?;
    let history = course.history()?;
    let waiting = waiting(&course, rules, &history, args.shard);
    let result = grade(
        &course,
        &staffed,
        &waiting,
        (args.jobs, !args.no_reports),
        &mut log,
    );
    log.finish()?;
    result?;
    if interrupt::asked() {
        return Err(Failure::paused());
    }
    if let Some(shard) = args.shard {
        // the index is made where the books are joined
        output::print(&format!("part {shard}: {} graded\n", waiting.len()))?;
        return Ok(ExitCode::SUCCESS);
    }
    summary(&course, rules, args.json)
}

/// Reads the source, and what people decided since.
fn take_in(
    course: &Course,
    rules: &CourseLab,
    source: Option<&PathBuf>,
    log: &mut CourseLog<'_>,
) -> Result<(), Failure> {
    let history = course.history()?;
    let mut seen = BTreeSet::new();
    let mut is_new =
        |hand_in: &HandIn| !history.knows(&hand_in.id) && seen.insert(hand_in.id.clone());
    if let Some(source) = source {
        let found = intake::read(
            source,
            &rules.name,
            &course.roster,
            &course.fixes,
            &course.book,
        )
        .map_err(intake_failure)?;
        for hand_in in found.hand_ins {
            if is_new(&hand_in) {
                log.append(Event::HandIn(Box::new(hand_in)))?;
            }
        }
        for question in found.questions {
            course.book.put_question(&question).map_err(book_failure)?;
        }
    }
    for question in course.book.questions().map_err(book_failure)? {
        if question.lab != rules.name {
            continue;
        }
        match intake::decision(&question, &course.fixes) {
            None => continue,
            Some(Decision::Ignored) => {}
            Some(Decision::HandIn(hand_in)) => {
                if is_new(&hand_in) {
                    log.append(Event::HandIn(hand_in))?;
                }
            }
        }
        course
            .book
            .remove_question(&question)
            .map_err(book_failure)?;
    }
    Ok(())
}

/// The hand-ins that count, or may count, and have no grade yet.
fn waiting(
    course: &Course,
    rules: &CourseLab,
    history: &History,
    shard: Option<Shard>,
) -> Vec<HandIn> {
    let mut waiting = Vec::new();
    for (student, attempts) in history.of_lab(&rules.name) {
        if shard.is_some_and(|shard| !shard.has(student.as_str())) {
            continue;
        }
        let ungraded = counting(rules.attempts, attempts)
            .iter()
            // a record that a failing disk has lost is made again
            .filter(|attempt| {
                attempt
                    .record()
                    .is_none_or(|key| !course.book.has_record(key))
            });
        waiting.extend(ungraded.map(|attempt| attempt.hand_in.clone()));
    }
    waiting
}

/// Grades hand-ins, each twice at most: what this machine failed at is tried once more, alone.
fn grade(
    course: &Course,
    lab: &StaffedLab,
    waiting: &[HandIn],
    (jobs, pages): (Option<usize>, bool),
    log: &mut CourseLog<'_>,
) -> Result<(), Failure> {
    let name = |hand_in: &HandIn| hand_in.student.to_string();
    let book = &course.book;
    let work =
        |hand_in: &HandIn, host: &mut WorkerHost| grading::grade(lab, book, hand_in, host, pages);
    let mut failed: Vec<HandIn> = Vec::new();
    pool::run(
        waiting,
        jobs.unwrap_or_else(pool::default_jobs),
        name,
        work,
        |hand_in, result| -> Result<bool, Failure> {
            let failure = record(log, hand_in, result)?;
            if failure.is_some() {
                failed.push(hand_in.clone());
            }
            Ok(failure.is_some())
        },
    )?;
    pool::run(
        &failed,
        1,
        name,
        work,
        |hand_in, result| -> Result<bool, Failure> {
            let failure = record(log, hand_in, result)?;
            let has_failed = failure.is_some();
            if let Some((verdict, what)) = failure {
                log.append(Event::NotGraded {
                    hand_in: hand_in.id.clone(),
                    verdict,
                    what,
                })?;
            }
            Ok(has_failed)
        },
    )
}

/// Writes the grade of a hand-in into the journal; gives the failure of this machine or the grader, if that is all there is.
fn record(
    log: &mut CourseLog<'_>,
    hand_in: &HandIn,
    result: Result<Outcome, GradingError>,
) -> Result<Option<(Verdict, String)>, Failure> {
    match result {
        Ok(Outcome::Recorded { record, .. }) => {
            log.append(Event::Graded(Graded {
                hand_in: hand_in.id.clone(),
                record,
                why: None,
            }))?;
            Ok(None)
        }
        Ok(Outcome::NotGraded { verdict, what }) => Ok(Some((verdict, what))),
        // said once everything else has ended
        Err(GradingError::Interrupted(_)) => Ok(None),
        Err(GradingError::Lab(error)) => Err(Failure::from(*error)),
        Err(GradingError::Book(error)) => Err(book_failure(error)),
    }
}

/// Brings the index up to date, and prints how the lab stands.
fn summary(course: &Course, rules: &CourseLab, json: bool) -> Result<ExitCode, Failure> {
    let history = course.history()?;
    let mut index = course.index(&history)?;
    let questions = course.book.questions().map_err(book_failure)?;
    let mut all: Vec<Standing> = Vec::new();
    let mut of_lab: Vec<Standing> = Vec::new();
    for other in &course.file.labs {
        let open: Vec<_> = questions
            .iter()
            .filter(|question| question.lab == other.name)
            .filter_map(|question| question.student.clone())
            .collect();
        let standings = course.standings(other, &history, &index, &open)?;
        if other.name == rules.name {
            of_lab.clone_from(&standings);
        }
        all.extend(standings);
    }
    index.put_standings(&all).map_err(index_failure)?;
    let open = questions
        .iter()
        .filter(|question| question.lab == rules.name)
        .count();
    if json {
        output::print_json(&of_lab)?;
    } else {
        output::print(&text(rules, &of_lab, open))?;
    }
    let has_failed =
        |standing: &Standing| matches!(standing.status, Status::HostLimit | Status::GraderFault);
    Ok(if of_lab.iter().any(has_failed) {
        ExitCode::from(FAULT)
    } else if open > 0 {
        ExitCode::from(LOST)
    } else {
        ExitCode::SUCCESS
    })
}

/// `287 graded, 9 missing, 4 need you`, and what to do next.
fn text(rules: &CourseLab, standings: &[Standing], open: usize) -> String {
    let mut counts: BTreeMap<Status, usize> = BTreeMap::new();
    for standing in standings {
        // counted as the files that need one
        if standing.status != Status::NeedsPerson {
            *counts.entry(standing.status).or_default() += 1;
        }
    }
    let mut parts: Vec<String> = counts
        .iter()
        .map(|(status, count)| format!("{count} {}", status.words()))
        .collect();
    match open {
        0 => {}
        1 => parts.push("1 needs you".to_owned()),
        count => parts.push(format!("{count} need you")),
    }
    let mut out = format!("{}: {}\n", rules.name.bold(), parts.join(", "));
    if open > 0 {
        out += &format!("{} kinemark course status {}\n", "next:".cyan(), rules.name);
    }
    out
}
