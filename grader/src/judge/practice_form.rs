//! What students get of the reference solution in one variant: what it reaches in checks that compare with it, and the path of its TCP
//! where the lab itself says where the TCP should go.

use kinemark_sim::trace::Trace;

use super::motion_judge::MotionJudge;
use crate::check::{Check, FromReference, MotionCheck};
use crate::lab::practice::PracticeTask;
use crate::lab::{Lab, Practice, Staff, Task, TaskWork};
use crate::record::graded::TcpPath;
use crate::submission::handed_in::Submission;
use crate::submission::host::InProcess;
use crate::task::model::MotionTask;

/// Time between the points of a path \[s\].
const DEFAULT_PERIOD_S: f64 = 0.02;
/// The same in a variant: those of 20 variants are in one file.
const VARIANT_PERIOD_S: f64 = 0.1;
/// Coordinates are rounded to a part of a metre in so many: far below any band, and a short file.
const PARTS_PER_M: f64 = 1e7;
/// The same in a variant, whose path is drawn and nothing else.
const VARIANT_PARTS_PER_M: f64 = 1e4;

/// Why there is nothing to give to students.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("task `{task}`: {why}")]
pub struct NoPractice {
    /// The task.
    pub task: String,
    /// The reason, in words.
    pub why: String,
}

/// What students get of the reference solution of `staff` in `lab`, a lab in one variant.
///
/// # Errors
/// [`NoPractice`] where the solution does not reach its end, or reaches no value in a check that compares with it.
pub fn practice(lab: &Lab, staff: &Staff) -> Result<Practice, NoPractice> {
    let mut tasks = Vec::new();
    for task in &lab.tasks {
        tasks.push((task.name.clone(), of_task(lab, staff, task)?));
    }
    Ok(Practice::of_tasks(tasks))
}

fn of_task(lab: &Lab, staff: &Staff, task: &Task) -> Result<PracticeTask, NoPractice> {
    let TaskWork::Motion(work, checks) = &task.work else {
        return Ok(PracticeTask::default());
    };
    let has_values =
        |check: &Check<dyn MotionCheck>| check.kind.reference_use() == FromReference::Value;
    if !checks.iter().any(has_values) && !has_path(work) {
        return Ok(PracticeTask::default());
    }
    let no_practice = |why: String| NoPractice {
        task: task.name.clone(),
        why,
    };
    let solution = Submission::from(&staff.solution);
    let judge = MotionJudge::new(lab, task, (work, checks), &solution, None);
    let attempt = judge.attempt(&mut InProcess);
    if attempt.ended.is_some() {
        return Err(no_practice(
            "the reference solution does not reach the end".to_owned(),
        ));
    }
    let run = &attempt.recorded;
    let reached = judge.reached(run).map_err(no_practice)?;
    let values = reached
        .into_iter()
        .filter_map(|reached| Some((reached.check, reached.value?)));
    Ok(PracticeTask {
        values: values.collect(),
        path: has_path(work).then(|| path(run, lab.variant.is_some())),
    })
}

/// Whether the lab says where the TCP should go: by goals, or by paths to follow. Elsewhere the way is what a student has to find.
fn has_path(work: &MotionTask) -> bool {
    !work.goals.is_empty() || !work.paths.is_empty()
}

fn path(run: &Trace, is_variant: bool) -> TcpPath {
    let (period_s, parts_per_m) = if is_variant {
        (VARIANT_PERIOD_S, VARIANT_PARTS_PER_M)
    } else {
        (DEFAULT_PERIOD_S, PARTS_PER_M)
    };
    let stride = ((period_s / run.step_s).round() as usize).max(1);
    let rounded = |x: f64| (x * parts_per_m).round() / parts_per_m;
    let points = (0..run.len()).step_by(stride);
    TcpPath {
        period_s,
        points_m: points
            .map(|tick| run.tcp_position(tick).map(rounded).into())
            .collect(),
    }
}
