//! Adds the reference solution's motion to a graded run, for the course staff, who know the answer.

use crate::attempt::motion;
use crate::judge::opening;
use crate::lab::TaskWork;
use crate::lab::{Lab, Staff};
use crate::record::graded::GradedRun;
use crate::submission::handed_in::Submission;
use crate::submission::host::InProcess;

/// Adds the reference solution's motion to every run of `graded`, for its report and its logs; a solution that stops early is left out.
/// The grade does not change.
pub fn show_reference(lab: &Lab, staff: &Staff, graded: &mut GradedRun) {
    for run in &mut graded.runs {
        let Some(task) = lab.tasks.iter().find(|task| task.name == run.task) else {
            continue;
        };
        let TaskWork::Motion(work, _) = &task.work else {
            continue;
        };
        let opening = opening(lab, task, &Submission::from(&staff.solution));
        let reference = motion::run(lab.workcell(), work, &opening, &mut InProcess);
        run.reference_overlay = reference.ended.is_none().then_some(reference.recorded);
    }
}
