//! A comparison of two graded submissions as data: what each check earned, and where the motions first part.

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::seconds;
use kinemark_sim::watch::event::EventKind;
use serde::Serialize;

use crate::record::grade::{Outcome, Stopped, TaskGrade};
use crate::record::graded::{GradedRun, TaskRun};
use crate::record::quantity::difference_of_points;
use crate::record::verdict::Verdict;

/// The format and its version.
pub const FORMAT: &str = "kinemark-comparison/1";

/// Revolute joints nearer to each other than this are not reported: half of it is what a tracking servo lags behind \[rad\].
pub const JOINT_TOLERANCE_RAD: f64 = 0.02;
/// The same of the TCP and of prismatic joints \[m\].
pub const POSITION_TOLERANCE_M: f64 = 0.01;

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
    pub(crate) fn new(a: f64, b: f64, max: f64) -> Self {
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
    pub(crate) fn of(stopped: &Stopped) -> Self {
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

/// The runs of a task of both.
pub fn runs<'a>(
    task: &str,
    a: &'a GradedRun,
    b: &'a GradedRun,
) -> Option<(&'a TaskRun, &'a TaskRun)> {
    let find = |graded: &'a GradedRun| graded.runs.iter().find(|run| run.task == task);
    Some((find(a)?, find(b)?))
}

/// Whether two runs can be compared tick by tick.
///
/// # Errors
/// Why not, in words.
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
