//! The record of a comparison of two graded submissions: the points of each check, and the first difference of the motions.

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

/// Smaller differences of revolute joints are not reported; the lag of a tracking servo is half as large \[rad\].
pub const JOINT_TOLERANCE_RAD: f64 = 0.02;
/// The same tolerance for the TCP and for prismatic joints \[m\].
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
    /// Notes on other differences, and on what could not be compared.
    pub notes: Vec<String>,
    /// Tasks that both have, in the lab's order.
    pub tasks: Vec<TaskComparison>,
}

/// One of two submissions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SideRecord {
    /// Its name, such as its folder.
    pub name: String,
    /// The submission's file name.
    pub submission: String,
    /// The submission's digest.
    pub digest: String,
    /// Its outcome.
    pub verdict: Verdict,
    /// Points earned.
    pub points: f64,
    /// Maximum points.
    pub max_points: f64,
}

/// A task that both submissions have.
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
    /// Points of both.
    pub points: Pair,
    /// The early end of the first, if it ended early.
    pub ended_a: Option<Ended>,
    /// The early end of the second, if it ended early.
    pub ended_b: Option<Ended>,
    /// Its checks, in the lab's order.
    pub checks: Vec<CheckComparison>,
    /// The comparison of the motions; absent in a function task.
    pub motion: Option<MotionComparison>,
}

/// Points of both.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Pair {
    /// Points of the first.
    pub a: f64,
    /// Points of the second.
    pub b: f64,
    /// Points of the second minus those of the first.
    pub difference: f64,
    /// Maximum points, of the first.
    pub max: f64,
    /// Maximum points of the second, where the lab has changed them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_b: Option<f64>,
}

impl Pair {
    pub(crate) fn new((a, max_a): (f64, f64), (b, max_b): (f64, f64)) -> Self {
        Self {
            a,
            b,
            difference: difference_of_points(a, b),
            max: max_a,
            max_b: (max_a.to_bits() != max_b.to_bits()).then_some(max_b),
        }
    }

    /// Maximum points of the second.
    pub fn of_b(&self) -> f64 {
        self.max_b.unwrap_or(self.max)
    }
}

/// A check that both submissions have.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckComparison {
    /// Its name in the lab file.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Outcome of the first; a check that was not judged has no points, which is not the same as zero points.
    pub outcome_a: Outcome,
    /// Outcome of the second.
    pub outcome_b: Outcome,
    /// Points of both.
    pub points: Pair,
}

/// The early end of a task: the submission was stopped, or the simulation diverged.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ended {
    /// The tick at which a motion task ended.
    pub tick: Option<u64>,
    /// The time of that tick \[s\].
    pub time_s: Option<f64>,
    /// Line in the submission, from one.
    pub line: Option<usize>,
    /// The case in which a function task ended.
    pub case: Option<String>,
    /// The reason.
    pub message: String,
}

impl Ended {
    /// A sentence with time, line and reason after the submission's letter: `B stopped at 3.01 s, line 12: ...`.
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

/// The early end of a run, if it ended early.
pub fn ended(run: &TaskRun, task: Option<&TaskGrade>) -> Option<Ended> {
    let stopped = task.and_then(|task| task.stopped.as_ref());
    // a stop without a tick belongs to another run than the visible one
    let of_this_run = stopped.filter(|stopped| stopped.tick.is_some() || run.trace.is_empty());
    if let Some(stopped) = of_this_run {
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

/// The comparison of two motions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MotionComparison {
    /// Whether all numbers of all ticks are equal.
    pub same_bits: bool,
    /// The first control tick at which they differ; absent if they never do.
    pub first: Option<FirstDifference>,
}

/// The first control tick at which two motions differ by more than the tolerance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FirstDifference {
    /// The tick.
    pub tick: u64,
    /// Its time \[s\].
    pub time_s: f64,
    /// The signal: `tcp`, or a joint's position such as `q[1]`.
    pub signal: String,
    /// Value of the signal in the first submission: x, y, z in the lab's frame, or one number.
    pub a: Vec<f64>,
    /// Value of the signal in the second submission.
    pub b: Vec<f64>,
    /// Distance between the two values.
    pub distance: f64,
    /// Smaller distances are not reported.
    pub tolerance: f64,
    /// Unit of all four.
    pub unit: String,
    /// In words.
    pub message: String,
}

/// The runs of one task in both submissions.
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
