//! What is hidden in a lab, exposed for the course staff: a lab of one task whose visible cases, or whose run, are the hidden ones. It
//! is graded and shown like any other.

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::{Dimension, Dimensions};

use super::case_grades::{case_grade, entries, given_in_words, of_task};
use super::expected::with_expected;
use super::opening::opening;
use crate::attempt::function;
use crate::check;
use crate::lab::staff::HiddenRun;
use crate::lab::{Lab, Staff, Task, TaskWork};
use crate::record::explanation::HiddenDraw;
use crate::record::grade::TaskKind;
use crate::submission::handed_in::Submission;
use crate::submission::host::InProcess;
use crate::task::entry::Entry;
use crate::task::model::{About, Case, FunctionTask, Given};
use crate::task::quantity::STATE;

/// A lab of one task that shows what is hidden in another lab.
#[derive(Debug, Clone)]
pub struct ExposedLab {
    /// The lab. The cases of a function task are all that are judged, in their order: first the visible ones, then one for each draw.
    /// A motion task is that of one hidden run.
    pub lab: Lab,
    /// The hidden cases, or the one hidden run.
    pub draws: Vec<HiddenDraw>,
}

impl ExposedLab {
    /// Its one task.
    pub fn task(&self) -> &Task {
        &self.lab.tasks[0]
    }

    /// The number of cases of a function task that are visible in the lab itself.
    pub(super) fn visible_cases(&self) -> usize {
        match &self.task().work {
            TaskWork::Function(work, _) => work.cases.len() - self.draws.len(),
            TaskWork::Motion(..) => 0,
        }
    }
}

/// The reference solution has no answer to the hidden cases of a task, so they cannot be judged.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("task `{task}`: {why}")]
pub struct NoAnswer {
    /// The task.
    pub task: String,
    /// Why it has none, in words.
    pub why: String,
}

/// The labs that show what is hidden in `task` of `lab`: one for all cases of a function task, one for each run of a motion task. There
/// is none where nothing is hidden.
///
/// # Errors
/// [`NoAnswer`] if the reference solution does not define the expected answers; [`crate::audit::staff_code`] finds that earlier.
pub fn expose(lab: &Lab, staff: &Staff, task: &Task) -> Result<Vec<ExposedLab>, NoAnswer> {
    match &task.work {
        TaskWork::Function(work, _) => {
            let exposed = cases(lab, staff, task, work).map_err(|why| NoAnswer {
                task: task.name.clone(),
                why,
            })?;
            Ok(exposed.into_iter().collect())
        }
        TaskWork::Motion(..) => {
            let runs = staff.runs(&task.name).into_iter();
            Ok(runs.filter_map(|hidden| run(hidden, &task.name)).collect())
        }
    }
}

/// The lab of a hidden run; `None` if the lab of the run does not have the task, which loading excludes.
fn run(hidden: &HiddenRun, task: &str) -> Option<ExposedLab> {
    let draw = HiddenDraw {
        task: task.to_owned(),
        kind: TaskKind::Motion,
        class: hidden.class.clone(),
        number: hidden.number,
        numbers: Dimensions::from_pairs(hidden.drawn.iter().cloned()),
        words: drawn_in_words(hidden),
        expected: None,
    };
    let task = hidden.lab.tasks.iter().find(|known| known.name == task)?;
    Some(ExposedLab {
        lab: of_one_task(&hidden.lab, task.clone()),
        draws: vec![draw],
    })
}

/// What was drawn for a run, in words with fewer digits.
pub(crate) fn drawn_in_words(run: &HiddenRun) -> String {
    let drawn = run.drawn.iter();
    entries(drawn.map(|(name, value)| (name.as_str(), Entry::from(value.clone()))))
}

/// `lab` with `task` alone. A hidden attempt is never compared with the path that students see.
fn of_one_task(lab: &Lab, task: Task) -> Lab {
    let mut own = Lab {
        tasks: vec![task],
        ..lab.clone()
    };
    own.practice = own.practice.without_paths();
    own
}

/// The lab of all cases of a function task; nothing where none are hidden.
fn cases(
    lab: &Lab,
    staff: &Staff,
    task: &Task,
    work: &FunctionTask,
) -> Result<Option<ExposedLab>, String> {
    let mut draws = Vec::new();
    let mut all = work.cases.clone();
    for hidden in staff.draws_of(&task.name) {
        let cases = with_expected(lab, task, &hidden.cases, &staff.solution)?;
        for (number, mut case) in (1..).zip(cases) {
            // with a class it would be hidden from the record
            let class = case.hidden_class.take().unwrap_or_default();
            draws.push(HiddenDraw {
                task: task.name.clone(),
                kind: TaskKind::Function,
                class,
                number,
                numbers: numbers_of(
                    &case,
                    case.robot.as_deref().unwrap_or(&lab.of_task(task).robot),
                    &work.about,
                ),
                words: given_in_words(
                    &case,
                    case.robot.as_deref().unwrap_or(&lab.of_task(task).robot),
                    &work.about,
                ),
                expected: None,
            });
            all.push(case);
        }
    }
    if draws.is_empty() {
        return Ok(None);
    }
    let mut task = task.clone();
    if let TaskWork::Function(work, _) = &mut task.work {
        work.cases = all;
    }
    let mut exposed = ExposedLab {
        lab: of_one_task(lab, task),
        draws,
    };
    let first = exposed.visible_cases();
    let expected = expected(&exposed, staff);
    for (draw, expected) in exposed.draws.iter_mut().zip(&expected[first..]) {
        draw.expected.clone_from(expected);
    }
    Ok(Some(exposed))
}

/// The right answer to each case of an exposed function task in words; `None` where neither the case nor the reference solution has one.
fn expected(exposed: &ExposedLab, staff: &Staff) -> Vec<Option<String>> {
    let task = exposed.task();
    let lab = exposed.lab.of_task(task);
    let TaskWork::Function(work, checks) = &task.work else {
        return Vec::new();
    };
    let opening = opening(lab, task, &Submission::from(&staff.solution));
    let cell = lab.workcell();
    let attempt = function::run(cell, work, &work.cases, &opening, &mut InProcess);
    let band = check::answer_band(checks);
    let facts = attempt.recorded.facts.iter();
    facts
        .map(|facts| {
            let case = case_grade(lab, work, facts, band);
            let of_solution = case.good.then_some(case.answer);
            case.expected.or(of_solution)
        })
        .collect()
}

/// What was drawn for a case, by name.
fn numbers_of(case: &Case, robot: &Robot, about: &About) -> Dimensions {
    let list = |name: &str, numbers: &[f64]| (name.to_owned(), Dimension::List(numbers.to_vec()));
    let given = match &case.given {
        Given::Q(q) => vec![list("q", &of_task(q, robot, about))],
        Given::Motion(state) => {
            let named = STATE.iter().zip(state);
            named
                .map(|((name, _), values)| list(name, values))
                .collect()
        }
        Given::Position {
            position_m, pose, ..
        } => match pose.as_slice() {
            position if position == position_m => vec![list("position_m", position_m)],
            pose => vec![list("pose", pose)],
        },
        Given::Values { given, .. } => given
            .iter()
            .map(|(name, entry)| match entry {
                Entry::Number(number) => (name.clone(), Dimension::Number(*number)),
                entry => list(name, &entry.numbers()),
            })
            .collect(),
    };
    Dimensions::from_pairs(given.into_iter().chain(case.dimensions.iter().cloned()))
}
