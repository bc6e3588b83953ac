//! `kinemark course grade`: what the LMS exported, read, matched to students and graded; again, it goes on where it stopped.

use std::path::PathBuf;
use std::process::ExitCode;

use kinemark_course::course_file::CourseLab;
use kinemark_course::grading::{self, GradingError, Outcome};
use kinemark_course::history::History;
use kinemark_course::journal::{Event, Graded, HandIn, MadeWith};
use kinemark_course::question::Question;
use kinemark_course::staffed_lab::{StaffedLab, engine_id};
use kinemark_course::standing::{Standing, Status, counting};
use kinemark_course::student::StudentId;
use kinemark_grader::record::verdict::Verdict;
use owo_colors::OwoColorize as _;

use super::course_check;
use crate::course_folder::{Course, CourseArgs, book_failure, grading_failure};
use crate::course_intake::take_in;
use crate::course_log::CourseLog;
use crate::failure::{FAULT, Failure, LOST};
use crate::lab_counts::lab_counts;
use crate::sandbox::SandboxArgs;
use crate::shard::Shard;
use crate::slurm_run::{SlurmArgs, SlurmRun};
use crate::slurm_script::Work;
use crate::worker::WorkerHost;
use crate::{interrupt, output, pool, slurm_queue};

/// Grade what was handed in: an archive or a folder of the LMS, or whatever of a lab is not graded yet
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark course grade ~/Downloads/lab1.zip 01-kinematics\n  kinemark course grade 01-kinematics\n  \
    kinemark course grade lab1.zip 01-kinematics --shard 2/4\n  \
    kinemark course grade lab1.zip 01-kinematics --slurm 8 --sbatch=--partition=short\n\n\
    SOURCE is what Moodle, Canvas or Gradescope exported, a folder of repositories, or files named by id. The same command again \
    goes on where it stopped; without SOURCE it grades what is in the book and reads fixes.toml again. docs/scale-out.md describes \
    several machines and Slurm.\n\
    Exit codes: 0 everybody who handed in has a grade, 1 something needs a person, 2 usage, 3 the course or the lab is broken, \
    4 the grader or this machine failed, 130 Ctrl-C."
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
    #[command(flatten)]
    pub(crate) sandbox: SandboxArgs,
    /// Write no page of each submission: faster, and smaller
    #[arg(long)]
    pub(crate) no_reports: bool,
    /// Grade only a part of the class, such as 2/4: parts are graded on several machines and joined by copying their books
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,
    #[command(flatten)]
    pub(crate) slurm: SlurmArgs,
    /// Print how everybody stands as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// So many students are named in a line.
const MOST_NAMED: usize = 10;

/// Reads, grades, prints.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    interrupt::listen();
    args.sandbox.demand()?;
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
    if args.slurm.slurm.is_some() {
        slurm_queue::require()?;
    }
    let course = Course::open(&args.course)?;
    let rules = course.rules(&lab.to_string_lossy())?;
    let staffed = course_check::ready(&course, rules)?;

    let mut log = CourseLog::new(&course);
    let taken_in = take_in(
        &course,
        rules,
        &staffed,
        source.map(PathBuf::as_path),
        &mut log,
    )?;
    if let Some(count) = args.slurm.slurm {
        log.finish()?;
        say(args, &taken_in.text())?;
        return on_slurm(args, &course, rules, &staffed, count);
    }
    let history = course.history()?;
    let (waiting, lost) = waiting(&course, rules, &staffed, &history, args.shard)?;
    let result = grade(
        &course,
        &staffed,
        &waiting,
        (args.jobs, !args.no_reports),
        &mut log,
    );
    log.finish()?;
    let failed = result?;
    if interrupt::asked() {
        return Err(Failure::paused());
    }
    match args.shard {
        Some(shard) => part_summary(shard, waiting.len(), failed),
        None => {
            say(args, &taken_in.text())?;
            say(args, &lost_records(rules, &lost))?;
            summary(&course, rules, &staffed, args.json)
        }
    }
}

/// How a part ended: the index is made where parts are joined.
fn part_summary(shard: Shard, all: usize, failed: usize) -> Result<ExitCode, Failure> {
    let graded = all - failed;
    if failed == 0 {
        output::print(&format!("part {shard}: {graded} graded\n"))?;
        return Ok(ExitCode::SUCCESS);
    }
    output::print(&format!(
        "part {shard}: {graded} graded, {failed} that this machine or the grader failed at\n"
    ))?;
    Ok(ExitCode::from(FAULT))
}

/// The hand-ins that count, or may count, and have no grade yet; and the students whose record is lost and cannot be made again,
/// because the lab or the engine is another now.
fn waiting(
    course: &Course,
    rules: &CourseLab,
    lab: &StaffedLab,
    history: &History,
    shard: Option<Shard>,
) -> Result<(Vec<HandIn>, Vec<StudentId>), Failure> {
    let (mut waiting, mut lost) = (Vec::new(), Vec::new());
    for (student, attempts) in history.of_lab(&rules.name) {
        if shard.is_some_and(|shard| !shard.has(student.as_str())) {
            continue;
        }
        for attempt in counting(rules.attempts, attempts) {
            let hand_in = &attempt.hand_in;
            match attempt.record() {
                None => waiting.push(hand_in.clone()),
                Some(key) if course.book.has_record(key) => {}
                Some(key) => {
                    let own = grading::key(lab, &course.book, hand_in);
                    // the same record again, and never another one in its place
                    if own.map_err(grading_failure)? == key {
                        waiting.push(hand_in.clone());
                    } else {
                        lost.push(student.clone());
                    }
                }
            }
        }
    }
    Ok((waiting, lost))
}

/// Records that a failing disk has lost, in a line.
fn lost_records(rules: &CourseLab, lost: &[StudentId]) -> String {
    if lost.is_empty() {
        return String::new();
    }
    let students: Vec<&str> = lost.iter().map(StudentId::as_str).collect();
    format!(
        "the record is lost of {}: restore book/records from a copy, or make new grades with `kinemark course regrade {}`\n",
        students.join(", "),
        rules.name
    )
}

/// Has the open parts graded on a cluster, or waits for what is in its queue already.
fn on_slurm(
    args: &Args,
    course: &Course,
    rules: &CourseLab,
    lab: &StaffedLab,
    count: u32,
) -> Result<ExitCode, Failure> {
    let open = |history: &History| -> Result<Vec<HandIn>, Failure> {
        Ok(waiting(course, rules, lab, history, None)?.0)
    };
    let now = open(&course.history()?)?;
    let all = now.len();
    let has_open = |part: &Shard| now.iter().any(|hand_in| part.has(hand_in.student.as_str()));
    let parts: Vec<Shard> = Shard::all(count).filter(has_open).collect();
    let run = match SlurmRun::in_queue(&course.book, &rules.name)? {
        Some(run) => {
            say(args, &format!("in the queue already: {}\n", run.shown()))?;
            run
        }
        // nothing to do
        None if parts.is_empty() => return summary(course, rules, lab, args.json),
        None => {
            let work = Work {
                course: course.root(),
                lab: &rules.name,
                parts: &parts,
                jobs: args.jobs,
                require_sandbox: args.sandbox.require_sandbox,
                reports: !args.no_reports,
                options: &args.slurm.sbatch,
            };
            let (run, [array, join]) = SlurmRun::submit(&course.book, &work)?;
            say(
                args,
                &format!(
                    "{all} to grade: job {array} ({} of {count} parts), then job {join} joins them\nlogs: {}\n",
                    parts.len(),
                    run.shown()
                ),
            )?;
            run
        }
    };
    if args.slurm.detach {
        say(
            args,
            &format!(
                "{} the same command again waits for the jobs, or goes on\n",
                "next:".cyan()
            ),
        )?;
        return Ok(ExitCode::SUCCESS);
    }
    let states = run.wait(|| Ok(open(&course.history()?)?.len()))?;
    let code = summary(course, rules, lab, args.json)?;
    let history = course.history()?;
    // what was tried and failed is in the summary
    let mut left = open(&history)?;
    left.retain(|hand_in| !history.has_failed(&hand_in.id));
    let untried = |part: Shard| {
        let of_part = left.iter();
        of_part
            .filter(|hand_in| part.has(hand_in.student.as_str()))
            .count()
    };
    run.verdict(&states, untried)?;
    Ok(code)
}

/// A line for people; JSON stays JSON.
fn say(args: &Args, line: &str) -> Result<(), Failure> {
    if args.json {
        return Ok(());
    }
    output::print(line)
}

/// Grades hand-ins, each twice at most: what this machine failed at is tried once more, alone. Gives the number of those that failed
/// again.
fn grade(
    course: &Course,
    lab: &StaffedLab,
    waiting: &[HandIn],
    (jobs, pages): (Option<usize>, bool),
    log: &mut CourseLog<'_>,
) -> Result<usize, Failure> {
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
    let mut failed_again = 0;
    pool::run(
        &failed,
        1,
        name,
        work,
        |hand_in, result| -> Result<bool, Failure> {
            let failure = record(log, hand_in, result)?;
            let has_failed = failure.is_some();
            if let Some((verdict, what)) = failure {
                failed_again += 1;
                log.append(Event::NotGraded {
                    hand_in: hand_in.id.clone(),
                    verdict,
                    what,
                })?;
            }
            Ok(has_failed)
        },
    )?;
    Ok(failed_again)
}

/// Writes the grade of a hand-in into the journal; gives the failure of this machine or the grader, if that is all there is.
fn record(
    log: &mut CourseLog<'_>,
    hand_in: &HandIn,
    result: Result<Outcome, GradingError>,
) -> Result<Option<(Verdict, String)>, Failure> {
    match result {
        Ok(Outcome::Recorded { record, points, .. }) => {
            log.append(Event::Graded(Graded {
                hand_in: hand_in.id.clone(),
                record,
                points: Some(points),
                why: None,
            }))?;
            Ok(None)
        }
        Ok(Outcome::NotGraded { verdict, what }) => Ok(Some((verdict, what))),
        // said once everything else has ended
        Err(GradingError::Interrupted(_)) => Ok(None),
        Err(error) => Err(grading_failure(error)),
    }
}

/// Brings the index up to date, and prints how the lab stands.
fn summary(
    course: &Course,
    rules: &CourseLab,
    lab: &StaffedLab,
    json: bool,
) -> Result<ExitCode, Failure> {
    let history = course.history()?;
    let mut index = course.index(&history)?;
    let questions = course.book.questions().map_err(book_failure)?;
    let of_lab: Vec<Standing> = course
        .put_standings(&history, &mut index)?
        .into_iter()
        .filter(|standing| standing.lab == rules.name)
        .collect();
    let open: Vec<Question> = questions
        .into_iter()
        .filter(|question| question.lab == rules.name)
        .collect();
    if json {
        output::print_list("standings", &of_lab)?;
    } else {
        output::print(&text(rules, &of_lab, &open))?;
        output::print(&made_otherwise(lab, &of_lab))?;
        output::print(&without_sources(&of_lab))?;
        output::print(&under_resolved(&of_lab))?;
    }
    let has_failed =
        |standing: &Standing| matches!(standing.status, Status::HostLimit | Status::GraderFault);
    Ok(if of_lab.iter().any(has_failed) {
        ExitCode::from(FAULT)
    } else if !open.is_empty() {
        ExitCode::from(LOST)
    } else {
        ExitCode::SUCCESS
    })
}

/// How far the lab is, and what to do next.
fn text(rules: &CourseLab, standings: &[Standing], questions: &[Question]) -> String {
    let parts = lab_counts(standings, questions);
    let mut out = format!("{}: {}\n", rules.name.bold(), parts.join(", "));
    if !questions.is_empty() {
        out += &format!("{} kinemark course status {}\n", "next:".cyan(), rules.name);
    }
    out
}

/// Whose grade comes from a simulation that is not accurate to the end, in a line; the report says from where on, and why.
fn under_resolved(standings: &[Standing]) -> String {
    let students = standings
        .iter()
        .filter(|standing| standing.is_under_resolved);
    let students: Vec<&str> = students.map(|standing| standing.student.as_str()).collect();
    match students.len() {
        0 => String::new(),
        count => format!(
            "{count} with a run whose simulation is not accurate to the end: {}\n",
            named(&students)
        ),
    }
}

/// Who handed in a module that nobody can read, in a line; it is graded as all others.
fn without_sources(standings: &[Standing]) -> String {
    let students = standings
        .iter()
        .filter(|standing| standing.is_without_sources);
    let students: Vec<&str> = students.map(|standing| standing.student.as_str()).collect();
    match students.len() {
        0 => String::new(),
        count => format!(
            "{count} handed in a module without its sources: {}\n",
            named(&students)
        ),
    }
}

/// Ids in a line.
fn named(students: &[&str]) -> String {
    let more = match students.len().saturating_sub(MOST_NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let named: Vec<&str> = students.iter().take(MOST_NAMED).copied().collect();
    format!("{}{more}", named.join(", "))
}

/// Who practised with another lab or engine than the course's, in lines; such work is graded as all others.
fn made_otherwise(lab: &StaffedLab, standings: &[Standing]) -> String {
    let own = engine_id();
    let with = |is_other: &dyn Fn(&MadeWith) -> bool| -> Vec<&str> {
        let students = standings.iter().filter(|standing| {
            let made_with = standing.made_with.as_ref();
            made_with.is_some_and(is_other)
        });
        students.map(|standing| standing.student.as_str()).collect()
    };
    let numbers = standings
        .iter()
        .filter(|standing| standing.has_other_numbers)
        .map(|standing| standing.student.as_str());
    let mut out = String::new();
    for (what, students) in [
        (
            "another lab",
            with(&|made_with| made_with.lab != lab.lab_version),
        ),
        ("another engine", with(&|made_with| made_with.engine != own)),
        ("other numbers", numbers.collect()),
    ] {
        if students.is_empty() {
            continue;
        }
        out += &format!(
            "{} practised with {what} than the course's: {}\n",
            students.len(),
            named(&students)
        );
    }
    out
}
