//! From a lab and a submission to a graded run: every task in order, and the record put together from them.

mod case_grades;
pub mod diagnose;
mod diverged;
pub mod divergence;
mod first_lost;
mod function_task;
mod hidden_runs;
mod motion_task;
mod openings;
mod points;
pub mod reference_run;
pub mod robustness_sweep;

use std::cell::RefCell;
use std::sync::Arc;

use kinemark_sim::robot::Dimension;
use kinemark_sim::source::Source;

use crate::lab::model::{Lab, Task, TaskWork};
use crate::lab::staff::Mutant;
use crate::lab::staff::sound::{self, Whose};
use crate::lab::{LabError, LabRobot, Staff};
use crate::record::grade::{FORMAT, Grade, GradeMode, ParameterValue, Part, VariantRecord};
use crate::record::graded::GradedRun;
use crate::record::quantity::sum_of_points;
use crate::record::verdict::Verdict;
use crate::submission::controller::{Controller, Opening, Stop};
use crate::submission::rhai::ScriptController;

pub(crate) use motion_task::pose_band;
pub(crate) use openings::opening;
pub use openings::{answers, granted};
pub(crate) use points::judged;

/// Lines of a submission's output that the record keeps.
const MOST_LOG_LINES: usize = 200;

/// Opens a submission for a task: in this process, or in a worker.
pub trait Host {
    /// Starts the submission of `opening`.
    ///
    /// # Errors
    /// [`Stop`] if it cannot start.
    fn open(&mut self, opening: &Opening) -> Result<Box<dyn Controller>, Stop>;

    /// A task begins; for whoever shows progress.
    fn begins(&mut self, _task: &str) {}
}

/// Runs submissions in this process.
#[derive(Debug, Default)]
pub struct InProcess;

impl Host for InProcess {
    fn open(&mut self, opening: &Opening) -> Result<Box<dyn Controller>, Stop> {
        Ok(Box::new(ScriptController::open(opening)?))
    }
}

/// The person at the terminal asked to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("interrupted")]
pub struct Interrupted;

/// Grades `submission` in `lab`; with `staff`, on hidden cases too, and with diagnoses.
///
/// # Errors
/// [`Interrupted`] if the host says so; nothing else stops a grade.
pub fn grade(
    lab: &Lab,
    staff: Option<&Staff>,
    submission: &Source,
    host: &mut dyn Host,
) -> Result<GradedRun, Interrupted> {
    let mut grader = Grader {
        lab,
        staff,
        submission,
        right: Vec::new(),
        staff_faults: RefCell::new(Vec::new()),
    };
    let mut tasks = Vec::new();
    let mut runs = Vec::new();
    for task in &lab.tasks {
        host.begins(&task.title);
        let (grade, run) = match &task.work {
            TaskWork::Function(function) => (grader.function(task, function, host)?, None),
            TaskWork::Motion(motion) => {
                let (grade, run) = grader.motion(task, motion, host)?;
                (grade, Some(run))
            }
        };
        if run.is_none() && grade.verdict == Verdict::Passed {
            grader.right.push(task.name.clone());
        }
        tasks.push(grade);
        runs.extend(run);
    }
    let digest = |text: &str| blake3::hash(text.as_bytes()).to_hex().to_string();
    let verdicts = tasks.iter().map(|task| task.verdict);
    let grade = Grade {
        format: FORMAT.to_owned(),
        engine: engine(),
        mode: if staff.is_some() {
            GradeMode::Graded
        } else {
            GradeMode::Practice
        },
        lab: Part {
            name: lab.name.clone(),
            digest: digest(&format!(
                "{}\n{}{}",
                lab.source.text(),
                lab.reference_paths.text,
                lab.variant
                    .as_ref()
                    .map_or(String::new(), |variant| format!("\n{}", variant.numbers()))
            )),
        },
        variant: variant_record(lab),
        robot: Part {
            name: lab.robot.name().to_owned(),
            digest: LabRobot::digest(&lab.robot_file, &lab.robot_meshes)
                .to_hex()
                .to_string(),
        },
        scenes: lab
            .scenes
            .iter()
            .map(|scene| Part {
                name: scene.name.clone(),
                digest: scene.digest().to_hex().to_string(),
            })
            // one file, whatever its dimensions
            .fold(Vec::new(), |mut scenes, scene| {
                if !scenes.contains(&scene) {
                    scenes.push(scene);
                }
                scenes
            }),
        submission: Part {
            name: submission.name().to_owned(),
            digest: digest(submission.text()),
        },
        reference: staff.map(|staff| Part {
            name: lab.name.clone(),
            digest: staff.digest.to_hex().to_string(),
        }),
        verdict: verdicts.min().unwrap_or(Verdict::Passed),
        points: sum_of_points(tasks.iter().map(|task| task.points)),
        max_points: tasks.iter().map(|task| task.max_points).sum(),
        tasks,
    };
    Ok(GradedRun {
        grade,
        title: lab.title.clone(),
        staff_faults: grader.staff_faults.into_inner(),
        runs,
    })
}

fn variant_record(lab: &Lab) -> Option<VariantRecord> {
    let variant = lab.variant.as_ref()?;
    let parameters = lab.parameters.iter().map(|(name, value)| {
        let value = match value {
            Dimension::Number(number) => ParameterValue::Number(*number),
            Dimension::List(numbers) => ParameterValue::List(numbers.clone()),
        };
        (name.to_owned(), value)
    });
    Some(VariantRecord {
        student: variant.student().map(str::to_owned),
        parameters: parameters.collect(),
    })
}

/// The engine and its version, as in grade records and logs.
pub fn engine() -> String {
    format!("kinemark {}", env!("CARGO_PKG_VERSION"))
}

struct Grader<'a> {
    lab: &'a Lab,
    staff: Option<&'a Staff>,
    submission: &'a Source,
    /// Function tasks so far whose every answer is right.
    right: Vec<String>,
    /// What of the staff's own stopped.
    staff_faults: RefCell<Vec<Arc<LabError>>>,
}

impl Grader<'_> {
    fn opening(&self, task: &Task, submission: &Source) -> Opening {
        opening(self.lab, task, submission)
    }

    /// Keeps that a submission of the staff stopped, once for each.
    fn note_fault(&self, whose: Whose<'_>, task: &Task, source: &Source, stop: &Stop) {
        let Some(fault) = sound::fault(whose, Some(task), source, stop) else {
            return;
        };
        let mut faults = self.staff_faults.borrow_mut();
        if !faults
            .iter()
            .any(|known| known.source().name() == source.name())
        {
            faults.push(Arc::new(fault));
        }
    }

    /// The known mistakes that a task may show: in a run none that a function would show, too, which is right. A function's own
    /// answers tell of themselves.
    fn mutants_of(&self, task: &Task) -> impl Iterator<Item = &Mutant> {
        let all = self.staff.map_or(&[][..], |staff| &staff.mutants);
        let name = task.name.clone();
        let is_run = matches!(task.work, TaskWork::Motion(_));
        all.iter().filter(move |mutant| {
            let is_refuted = is_run && mutant.tasks.iter().any(|task| self.right.contains(task));
            mutant.tasks.contains(&name) && !is_refuted
        })
    }
}
