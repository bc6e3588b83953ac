//! Two graded submissions of one lab beside each other: what each check earned, and where the motions first part.

use kinemark_sim::event::EventKind;
use kinemark_sim::robot::Robot;
use serde::Serialize;

use crate::judge::divergence;
use crate::lab::Lab;
use crate::lab::model::TaskWork;
use crate::record::grade::{Grade, GradeMode, Outcome, Stopped, TaskGrade, TaskKind};
use crate::record::graded::{GradedRun, TaskRun};
use crate::record::quantity::{difference_of_points, list, metres, seconds, trimmed};
use crate::record::verdict::Verdict;

/// The format and its version.
pub const FORMAT: &str = "kinemark-comparison/1";

/// One of the two.
#[derive(Debug, Clone, Copy)]
pub struct Side<'a> {
    /// What it is called besides its letter, such as its folder.
    pub name: &'a str,
    /// Its record, as it was written.
    pub recorded: &'a Grade,
    /// Its lab.
    pub lab: &'a Lab,
    /// Its runs, made again.
    pub again: &'a GradedRun,
}

/// Two submissions of one lab that have nothing to be held against each other.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the two cannot be compared: {}", .0.join("; "))]
pub struct NotComparable(pub Vec<String>);

/// Two submissions, compared.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// Always `kinemark-comparison/1`.
    pub format: &'static str,
    /// The lab's name.
    pub lab: String,
    /// The first.
    pub a: SideRecord,
    /// The second.
    pub b: SideRecord,
    /// What else is not the same, and what could not be compared.
    pub notes: Vec<String>,
    /// Tasks that both have, in the lab's order.
    pub tasks: Vec<TaskComparison>,
}

/// One of two submissions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SideRecord {
    /// What it is called, such as its folder.
    pub name: String,
    /// The submission's file name.
    pub submission: String,
    /// The submission's digest.
    pub digest: String,
    /// Its outcome.
    pub verdict: Verdict,
    /// Points earned.
    pub points: f64,
    /// Points there are.
    pub max_points: f64,
}

/// A task of both.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TaskComparison {
    /// Its name in the lab file.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Outcome of the first.
    pub verdict_a: Verdict,
    /// Outcome of the second.
    pub verdict_b: Verdict,
    /// What both earned.
    pub points: Pair,
    /// What ended the first early, if something did.
    pub ended_a: Option<Ended>,
    /// What ended the second early.
    pub ended_b: Option<Ended>,
    /// Its checks, in the lab's order.
    pub checks: Vec<CheckComparison>,
    /// How the motions compare; absent in a function task.
    pub motion: Option<MotionComparison>,
}

/// Points of both.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Pair {
    /// Of the first.
    pub a: f64,
    /// Of the second.
    pub b: f64,
    /// Of the second above those of the first.
    pub difference: f64,
    /// Points there are.
    pub max: f64,
}

impl Pair {
    fn new(a: f64, b: f64, max: f64) -> Self {
        Self {
            a,
            b,
            difference: difference_of_points(a, b),
            max,
        }
    }
}

/// A check of both.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckComparison {
    /// Its name in the lab file.
    pub name: String,
    /// Its title.
    pub title: String,
    /// How much the first earned; what is not judged has no points, which is not the same as zero.
    pub outcome_a: Outcome,
    /// How much the second earned.
    pub outcome_b: Outcome,
    /// What both earned.
    pub points: Pair,
}

/// What ended a task early: the submission was stopped, or the simulation diverged.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ended {
    /// The tick of a motion task at which it did.
    pub tick: Option<u64>,
    /// The time of that tick \[s\].
    pub time_s: Option<f64>,
    /// Line in the submission, from one.
    pub line: Option<usize>,
    /// The case of a function task in which it did.
    pub case: Option<String>,
    /// Why.
    pub message: String,
}

impl Ended {
    /// When, where and why, after the letter of the one that ended: `B stopped at 3.01 s, line 12: ...`.
    pub fn words(&self, letter: &str) -> String {
        let at = self
            .time_s
            .map_or(String::new(), |time_s| format!(" at {}", seconds(time_s)));
        let line = match self.line {
            Some(line) => format!(", line {line}"),
            None => String::new(),
        };
        let case = match &self.case {
            Some(case) => format!(" in case `{case}`"),
            None => String::new(),
        };
        format!("{letter} stopped{at}{case}{line}: {}", self.message)
    }
}

/// What ended a run before its time, if something did.
pub fn ended(run: &TaskRun, task: Option<&TaskGrade>) -> Option<Ended> {
    let stopped = task.and_then(|task| task.stopped.as_ref());
    // a stop without a tick is of a run that is not this one
    let told = stopped.filter(|stopped| stopped.tick.is_some() || run.trace.is_empty());
    if let Some(stopped) = told {
        return Some(Ended::of(stopped));
    }
    let ends = |kind: &EventKind| matches!(kind, EventKind::Diverged | EventKind::Stopped);
    let last = run.trace.events.iter().rfind(|event| ends(&event.kind))?;
    Some(Ended {
        tick: Some(last.tick),
        time_s: Some(last.tick as f64 * run.trace.step_s),
        line: None,
        case: None,
        message: run.names().event(&last.kind),
    })
}

impl Ended {
    fn of(stopped: &Stopped) -> Self {
        Self {
            tick: stopped.tick,
            time_s: stopped.time_s,
            line: stopped.line,
            case: stopped.case.clone(),
            message: stopped.message.clone(),
        }
    }
}

/// How two motions compare.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MotionComparison {
    /// Whether every number of every tick is the same.
    pub same_bits: bool,
    /// The first control tick at which they are apart; absent where they never are.
    pub first: Option<FirstDifference>,
}

/// The first control tick at which two motions are apart.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FirstDifference {
    /// The tick.
    pub tick: u64,
    /// Its time \[s\].
    pub time_s: f64,
    /// The signal: `tcp`, or a joint's position such as `q[1]`.
    pub signal: String,
    /// The signal there in the first: x, y, z in the lab's frame, or one number.
    pub a: Vec<f64>,
    /// In the second.
    pub b: Vec<f64>,
    /// How far the two are from each other.
    pub distance: f64,
    /// How far they may be without being told.
    pub tolerance: f64,
    /// Unit of all four.
    pub unit: String,
    /// In words.
    pub message: String,
}

/// Compares two submissions of one lab.
///
/// Points are those of the records. Motions are compared as they were made again, by joints and TCP, with the tolerances of
/// [`divergence`], as far as both go.
///
/// # Errors
/// [`NotComparable`] for two labs, or where no task has the same checks in both.
pub fn compare(a: &Side<'_>, b: &Side<'_>) -> Result<Comparison, NotComparable> {
    if a.recorded.lab.name != b.recorded.lab.name {
        let labs =
            [a, b].map(|side| format!("`{}` is of lab `{}`", side.name, side.recorded.lab.name));
        return Err(NotComparable(labs.to_vec()));
    }
    let mut notes = differing_grounds(a.recorded, b.recorded);
    let mut tasks = Vec::new();
    let mut apart = Vec::new();
    for task_a in &a.recorded.tasks {
        let task_b = b
            .recorded
            .tasks
            .iter()
            .find(|task| task.name == task_a.name);
        match task_b
            .ok_or("A alone has it".to_owned())
            .and_then(|task_b| {
                agree(task_a, task_b)?;
                Ok(task_b)
            }) {
            Ok(task_b) => tasks.push(task(task_a, task_b, a, b, &mut notes)),
            Err(why) => apart.push(format!("task `{}`: {why}", task_a.name)),
        }
    }
    let only_b = b
        .recorded
        .tasks
        .iter()
        .filter(|task| !a.recorded.tasks.iter().any(|other| other.name == task.name));
    apart.extend(only_b.map(|task| format!("task `{}`: B alone has it", task.name)));
    if tasks.is_empty() {
        apart.extend(notes);
        return Err(NotComparable(apart));
    }
    notes.extend(apart.into_iter().map(|why| format!("not compared: {why}")));
    Ok(Comparison {
        format: FORMAT,
        lab: a.recorded.lab.name.clone(),
        a: record(a),
        b: record(b),
        notes,
        tasks,
    })
}

fn record(side: &Side<'_>) -> SideRecord {
    let grade = side.recorded;
    SideRecord {
        name: side.name.to_owned(),
        submission: grade.submission.name.clone(),
        digest: grade.submission.digest.clone(),
        verdict: grade.verdict,
        points: grade.points,
        max_points: grade.max_points,
    }
}

/// What two records rest on that is not the same.
fn differing_grounds(a: &Grade, b: &Grade) -> Vec<String> {
    let mut notes = Vec::new();
    let variant = |grade: &Grade| {
        let words = grade.variant.as_ref().map(|variant| variant.words());
        words.unwrap_or_else(|| "everybody's numbers".to_owned())
    };
    if a.variant != b.variant {
        notes.push(format!(
            "other numbers: A has {}, B has {}",
            variant(a),
            variant(b)
        ));
    } else if a.lab.digest != b.lab.digest {
        notes.push("the lab was changed between the two".to_owned());
    }
    if a.robot.name == b.robot.name {
        // other numbers are told already
        if a.robot.digest != b.robot.digest && a.variant == b.variant {
            notes.push(format!(
                "robot `{}` was changed between the two",
                a.robot.name
            ));
        }
    } else {
        notes.push(format!(
            "other robots: A has `{}`, B has `{}`",
            a.robot.name, b.robot.name
        ));
    }
    if a.scenes != b.scenes {
        notes.push("other scenes".to_owned());
    }
    if a.mode != b.mode {
        let mode = |grade: &Grade| match grade.mode {
            GradeMode::Graded => "with hidden cases",
            GradeMode::Practice => "on visible cases only",
        };
        notes.push(format!("A was graded {}, B {}", mode(a), mode(b)));
    }
    if a.engine != b.engine {
        notes.push(format!("A was graded by {}, B by {}", a.engine, b.engine));
    }
    if a.submission.digest == b.submission.digest {
        notes.push("A and B are the same submission".to_owned());
    }
    notes
}

/// Whether a task asks the same of both.
fn agree(a: &TaskGrade, b: &TaskGrade) -> Result<(), String> {
    if a.kind != b.kind {
        return Err("it is a motion in one and a function in the other".to_owned());
    }
    let checks = |task: &TaskGrade| -> Vec<String> {
        let checks = task.checks.iter();
        checks
            .map(|check| format!("`{}` for {}", check.name, trimmed(check.max_points, 6)))
            .collect()
    };
    let (of_a, of_b) = (checks(a), checks(b));
    let other = |of: &[String], than: &[String]| -> Option<String> {
        of.iter().find(|check| !than.contains(check)).cloned()
    };
    match (other(&of_a, &of_b), other(&of_b, &of_a)) {
        (Some(check), _) => Err(format!("A alone has check {check}")),
        (None, Some(check)) => Err(format!("B alone has check {check}")),
        (None, None) => Ok(()),
    }
}

fn task(
    task_a: &TaskGrade,
    task_b: &TaskGrade,
    a: &Side<'_>,
    b: &Side<'_>,
    notes: &mut Vec<String>,
) -> TaskComparison {
    let checks = task_a.checks.iter().filter_map(|check| {
        let other = task_b
            .checks
            .iter()
            .find(|other| other.name == check.name)?;
        Some(CheckComparison {
            name: check.name.clone(),
            title: check.title.clone(),
            outcome_a: check.outcome,
            outcome_b: other.outcome,
            points: Pair::new(check.points, other.points, check.max_points),
        })
    });
    let motion = match (task_a.kind, runs(&task_a.name, a.again, b.again)) {
        (TaskKind::Motion, Some((run_a, run_b))) => match comparable(run_a, run_b) {
            Ok(()) => Some(motion(&task_a.name, run_a, run_b, a, b)),
            Err(why) => {
                notes.push(format!(
                    "not compared: the motions of task `{}`: {why}",
                    task_a.name
                ));
                None
            }
        },
        _ => None,
    };
    // as it was recorded with the points; what no record tells, as it ran again
    let ended = |task: &TaskGrade, again: &GradedRun| {
        let run = again.runs.iter().find(|run| run.task == task.name);
        let recorded = task.stopped.as_ref().map(Ended::of);
        recorded.or_else(|| ended(run?, None))
    };
    TaskComparison {
        ended_a: ended(task_a, a.again),
        ended_b: ended(task_b, b.again),
        name: task_a.name.clone(),
        title: task_a.title.clone(),
        verdict_a: task_a.verdict,
        verdict_b: task_b.verdict,
        points: Pair::new(task_a.points, task_b.points, task_a.max_points),
        checks: checks.collect(),
        motion,
    }
}

/// The runs of a task of both.
pub fn runs<'a>(
    task: &str,
    a: &'a GradedRun,
    b: &'a GradedRun,
) -> Option<(&'a TaskRun, &'a TaskRun)> {
    let find = |graded: &'a GradedRun| graded.runs.iter().find(|run| run.task == task);
    Some((find(a)?, find(b)?))
}

/// Whether two runs can be held against each other tick by tick.
pub fn comparable(a: &TaskRun, b: &TaskRun) -> Result<(), String> {
    if a.trace.is_empty() || b.trace.is_empty() {
        let which = match (a.trace.is_empty(), b.trace.is_empty()) {
            (true, true) => "both have",
            (true, false) => "A has",
            _ => "B has",
        };
        return Err(format!("{which} none, for the submission stopped before"));
    }
    if a.trace.step_s.to_bits() != b.trace.step_s.to_bits() {
        return Err(format!(
            "a tick is {} s in A and {} s in B",
            a.trace.step_s, b.trace.step_s
        ));
    }
    if !same_joints(&a.robot, &b.robot) {
        return Err("the robots have other joints".to_owned());
    }
    Ok(())
}

/// Whether two robots have the same joints in the same order; their dimensions may differ.
fn same_joints(a: &Robot, b: &Robot) -> bool {
    let joints = |robot: &Robot| -> Vec<(String, bool)> {
        let joints = robot.moving_joints();
        joints
            .map(|joint| (joint.name.clone(), joint.kind.turns()))
            .collect()
    };
    joints(a) == joints(b)
}

fn motion(
    name: &str,
    run_a: &TaskRun,
    run_b: &TaskRun,
    a: &Side<'_>,
    b: &Side<'_>,
) -> MotionComparison {
    let seconds = |graded: &GradedRun| {
        let task = graded.grade.tasks.iter().find(|task| task.name == name);
        task.map(|task| task.digests.seconds.clone())
    };
    let same_bits = run_a.trace.len() == run_b.trace.len() && seconds(a.again) == seconds(b.again);
    let work = a.lab.tasks.iter().find(|task| task.name == name);
    let periods = work.and_then(|task| match &task.work {
        TaskWork::Motion(motion) => Some(&motion.periods),
        TaskWork::Function(_) => None,
    });
    let first = periods.and_then(|periods| {
        divergence::from_run(&run_a.trace, &run_b.trace, &run_a.robot, periods)
    });
    MotionComparison {
        same_bits,
        first: first.map(|found| FirstDifference {
            message: words(
                &found.signal,
                &found.yours,
                &found.reference,
                found.distance,
                &found.unit,
                &run_a.robot,
            ),
            tick: found.tick,
            time_s: found.time_s,
            signal: found.signal,
            a: found.yours,
            b: found.reference,
            distance: found.distance,
            tolerance: found.tolerance,
            unit: found.unit,
        }),
    }
}

fn words(signal: &str, a: &[f64], b: &[f64], distance: f64, unit: &str, robot: &Robot) -> String {
    let index = signal
        .strip_prefix("q[")
        .and_then(|rest| rest.strip_suffix(']'));
    let joint = index
        .and_then(|index| index.parse().ok())
        .and_then(|index| robot.moving_joints().nth(index));
    match (joint, a, b) {
        (Some(joint), [a], [b]) => format!(
            "`{}` is at {} {unit} in A, at {} {unit} in B",
            joint.name,
            trimmed(*a, 4),
            trimmed(*b, 4)
        ),
        _ => format!(
            "the TCP is at {} m in A, {} from where it is in B, {} m",
            list(a),
            metres(distance),
            list(b)
        ),
    }
}
