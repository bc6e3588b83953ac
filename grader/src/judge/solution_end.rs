//! Where the reference solution does not come to its end, so that nobody can be compared with it: for the course staff, who may read why.

use kinemark_sim::text::Dimension;

use super::motion_judge::MotionJudge;
use crate::attempt::Disclosure;
use crate::lab::staff::HiddenRun;
use crate::lab::{Lab, Staff, TaskWork};
use crate::record::grade::Stopped;
use crate::submission::handed_in::Submission;

/// A run of the reference solution that stops.
#[derive(Debug)]
pub(crate) struct SolutionEnd {
    /// Which run, in words.
    pub(crate) run: String,
    /// How it ends.
    pub(crate) stopped: Stopped,
}

/// The first run of the task called `task`, visible or hidden, in which the reference solution stops or the simulation diverges.
pub(crate) fn solution_end(lab: &Lab, staff: &Staff, task: &str) -> Option<SolutionEnd> {
    let visible = ("the visible run".to_owned(), lab);
    let hidden = staff.runs(task).into_iter();
    let hidden = hidden.map(|run| (in_words(run), &run.lab));
    std::iter::once(visible)
        .chain(hidden)
        .find_map(|(run, lab)| {
            let stopped = stopped_in(lab, staff, task)?;
            Some(SolutionEnd { run, stopped })
        })
}

fn stopped_in(lab: &Lab, staff: &Staff, task: &str) -> Option<Stopped> {
    let task = lab.tasks.iter().find(|known| known.name == task)?;
    let TaskWork::Motion(work, checks) = &task.work else {
        return None;
    };
    let lab = lab.of_task(task);
    let solution = Submission::from(&staff.solution);
    let judge = MotionJudge::new(lab, task, (work, checks), &solution, None);
    let ended = judge.attempt_of(&staff.solution).ended?;
    let disclosure = Disclosure::Run {
        names: judge.names(),
        task: work,
    };
    Some(ended.record(staff.solution.text(), disclosure))
}

fn in_words(run: &HiddenRun) -> String {
    let drawn = run.drawn.iter().map(|(name, value)| match value {
        Dimension::Number(number) => format!("{name} = {number}"),
        Dimension::List(numbers) => format!("{name} = {numbers:?}"),
        Dimension::Text(text) => format!("{name} = {text}"),
    });
    let drawn: Vec<String> = drawn.collect();
    format!(
        "hidden run {} of the class \"{}\" ({})",
        run.number,
        run.class,
        drawn.join(", ")
    )
}
