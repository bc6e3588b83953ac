//! The grader: every task in order, and the record of all of them.

use std::cell::RefCell;
use std::sync::Arc;

use kinemark_sim::text::Dimension;
use kinemark_sim::text::Source;

use super::diagnose::Ruling;
use super::opening::opening;
use super::single_case::SingleCase;
use super::staff_attempts::StaffAttempts;
use super::staff_faults::staff_fault;
use crate::attempt::Ended;
use crate::lab::Staff;
use crate::lab::TaskWork;
use crate::lab::practice;
use crate::lab::staff::Mutant;
use crate::lab::{Lab, Task};
use crate::record::grade::{
    Diagnosis, FORMAT, Grade, GradeMode, ParameterValue, Part, TaskGrade, VariantRecord,
};
use crate::record::graded::{GradedRun, TaskRun};
use crate::record::quantity::sum_of_points;
use crate::record::shown_case::ShownCases;
use crate::record::staff_fault::{StaffFault, StaffSubmission};
use crate::record::verdict::Verdict;
use crate::submission::controller::Opening;
use crate::submission::handed_in::Submission;
use crate::submission::host::{Host, InProcess};
use crate::task::robot::LabRobot;

/// Lines of a submission's output that the record keeps.
pub(super) const MOST_LOG_LINES: usize = 200;

/// The user interrupted the grade.
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
    submission: &Submission,
    host: &mut dyn Host,
) -> Result<GradedRun, Interrupted> {
    let (graded, _) = Grader::new(lab, staff, submission).graded(host)?;
    Ok(graded)
}

/// A grade for the course staff.
pub(crate) struct Examined {
    /// The grade with its runs.
    pub(crate) graded: GradedRun,
    /// For each task what the comparison with each mutant came to; `None` where there was none.
    pub(crate) rulings: Vec<Option<Vec<Ruling>>>,
}

/// Grades `submission` as [`grade`] does, in this process; attempts of the course staff's submissions that are `known` are not made again.
pub(crate) fn examined(
    lab: &Lab,
    staff: &Staff,
    submission: &Submission,
    known: &StaffAttempts,
) -> Option<Examined> {
    // nobody can interrupt this host
    examined_by(lab, staff, submission, known, &mut InProcess)
}

/// The same with another host; `None` where that interrupts.
pub(super) fn examined_by(
    lab: &Lab,
    staff: &Staff,
    submission: &Submission,
    known: &StaffAttempts,
    host: &mut dyn Host,
) -> Option<Examined> {
    let mut grader = Grader::new(lab, Some(staff), submission);
    grader.known = Some(known);
    let (graded, scores) = grader.graded(host).ok()?;
    let rulings = scores.into_iter().map(|scores| scores.rulings).collect();
    Some(Examined { graded, rulings })
}

/// Makes the attempt of `mutant` at `task` that all other submissions are compared with: it is then among the `known`.
pub(crate) fn prepare_mutant(
    lab: &Lab,
    staff: &Staff,
    (task, mutant): (&Task, &Mutant),
    known: &StaffAttempts,
) {
    let submission = Submission::from(&mutant.source);
    let mut grader = Grader::new(lab.of_task(task), Some(staff), &submission);
    grader.known = Some(known);
    match &task.work {
        TaskWork::Function(work, checks) => grader.prepare_answers(task, work, checks, mutant),
        TaskWork::Motion(work, checks) => grader.prepare_run(task, work, checks, mutant),
    }
}

/// The grade of all tasks together, with the digests of lab, robot, submission and reference.
fn record(
    lab: &Lab,
    staff: Option<&Staff>,
    submission: &Submission,
    tasks: Vec<TaskGrade>,
) -> Grade {
    let verdicts = tasks.iter().map(|task| task.verdict);
    let parts = parts(lab, staff, submission);
    Grade {
        format: FORMAT.to_owned(),
        engine: engine(),
        mode: if staff.is_some() {
            GradeMode::Graded
        } else {
            GradeMode::Practice
        },
        lab: parts.lab,
        variant: variant_record(lab),
        robot: parts.robot,
        scenes: parts.scenes,
        submission: parts.submission,
        sources: submission.sources().map(<[Part]>::to_vec),
        reference: parts.reference,
        verdict: verdicts.min().unwrap_or(Verdict::Passed),
        points: sum_of_points(tasks.iter().map(|task| task.points)),
        max_points: tasks.iter().map(|task| task.max_points).sum(),
        points_at_hand_in: tasks.iter().map(|task| task.points_at_hand_in).sum(),
        tasks,
    }
}

/// What a grade follows from besides the engine, by name and content, as its record has it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parts {
    /// The lab in its variant.
    pub lab: Part,
    /// The robot file.
    pub robot: Part,
    /// The scenes, each once.
    pub scenes: Vec<Part>,
    /// The submission.
    pub submission: Part,
    /// The course staff's part with its salt; none in practice.
    pub reference: Option<Part>,
}

/// What the grade of `submission` would follow from; nothing is run.
pub fn parts(lab: &Lab, staff: Option<&Staff>, submission: &Submission) -> Parts {
    Parts {
        lab: part(&lab.name, digest_of_lab(lab)),
        robot: part(lab.robot.name(), digest_of_robots(lab)),
        scenes: scene_parts(lab),
        submission: part(submission.name(), submission.digest()),
        reference: staff.map(|staff| part(&lab.name, staff.digest)),
    }
}

/// The digest of the lab's robot, and of those that tasks have in its place.
fn digest_of_robots(lab: &Lab) -> blake3::Hash {
    let of = |lab: &Lab| LabRobot::digest(&lab.robot_file, &lab.robot_meshes);
    let mut own = lab
        .tasks
        .iter()
        .filter_map(|task| task.own.as_deref())
        .peekable();
    if own.peek().is_none() {
        return of(lab);
    }
    let mut hasher = blake3::Hasher::new();
    hasher.update(of(lab).as_bytes());
    for own in own {
        hasher.update(of(own).as_bytes());
    }
    hasher.finalize()
}

fn part(name: &str, digest: blake3::Hash) -> Part {
    Part {
        name: name.to_owned(),
        digest: digest.to_hex().to_string(),
    }
}

/// The digest of the lab's own files, and of the numbers of its variant. Of hints only the questions are in a grade.
fn digest_of_lab(lab: &Lab) -> blake3::Hash {
    let variant = lab.variant.as_ref();
    let numbers = variant.map_or(String::new(), |variant| format!("\n{}", variant.numbers()));
    let practice = practice::form(variant, lab.practice.clone());
    // a value that JSON has no number for was not read from JSON
    let practice = practice::file_text(&[practice]).unwrap_or_default();
    let texts = format!("{}\n{practice}{numbers}", lab.graded_text);
    blake3::hash(texts.as_bytes())
}

/// The scenes, each file once, whatever its dimensions.
fn scene_parts(lab: &Lab) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    for scene in &lab.scenes {
        let scene = part(&scene.name, scene.digest());
        if !parts.contains(&scene) {
            parts.push(scene);
        }
    }
    parts
}

fn variant_record(lab: &Lab) -> Option<VariantRecord> {
    let variant = lab.variant.as_ref()?;
    let parameters = lab.parameters.iter().map(|(name, value)| {
        let value = match value {
            Dimension::Number(number) => ParameterValue::Number(*number),
            Dimension::List(numbers) => ParameterValue::List(numbers.clone()),
            Dimension::Text(text) => ParameterValue::Text(text.clone()),
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

/// A digest of the sources that grades are made by, in 16 hexadecimal digits: equal where grades are equal. It is in no grade, because
/// a change of a comment changes it.
pub fn engine_digest() -> &'static str {
    env!("KINEMARK_ENGINE_DIGEST")
}

pub(super) struct Grader<'a> {
    pub(super) lab: &'a Lab,
    pub(super) staff: Option<&'a Staff>,
    pub(super) submission: &'a Submission,
    /// Function tasks so far that passed.
    pub(super) passed: Vec<String>,
    /// Function tasks so far that earned less than half of their points.
    pub(super) broken: Vec<String>,
    /// Whether the cases of function tasks are also judged one by one, which a record has no place for.
    pub(super) judges_each_case: bool,
    /// Attempts of the course staff's submissions that other grades need, too.
    pub(super) known: Option<&'a StaffAttempts>,
    /// Submissions of the course staff that failed.
    staff_faults: RefCell<Vec<Arc<StaffFault>>>,
}

/// A task, graded.
pub(super) struct GradedTask {
    /// Its record.
    pub(super) grade: TaskGrade,
    /// The run of a motion task.
    pub(super) run: Option<TaskRun>,
    /// The visible cases of a function task.
    pub(super) cases: Option<ShownCases>,
    /// What its record is made from and does not hold.
    pub(super) scores: TaskScores,
}

/// The scores from which a task's points are made, before they are rounded.
#[derive(Default)]
pub(super) struct TaskScores {
    /// The share of points of each check, in `[0, 1]`: of a motion task in the visible run alone.
    pub(super) checks: Vec<f64>,
    /// Each case of a function task by itself, if the grader judges each.
    pub(super) cases: Vec<SingleCase>,
    /// What the comparison with each mutant came to; `None` where there was none, because nothing was lost in what is visible.
    pub(super) rulings: Option<Vec<Ruling>>,
}

impl<'a> Grader<'a> {
    pub(super) fn new(lab: &'a Lab, staff: Option<&'a Staff>, submission: &'a Submission) -> Self {
        Self {
            lab,
            staff,
            submission,
            passed: Vec::new(),
            broken: Vec::new(),
            judges_each_case: false,
            known: None,
            staff_faults: RefCell::new(Vec::new()),
        }
    }

    /// Grades every task, in order; the scores are one entry per task.
    ///
    /// # Errors
    /// [`Interrupted`] if the host says so.
    pub(super) fn graded(
        mut self,
        host: &mut dyn Host,
    ) -> Result<(GradedRun, Vec<TaskScores>), Interrupted> {
        let lab = self.lab;
        let (mut tasks, mut scores) = (Vec::new(), Vec::new());
        let (mut runs, mut cases) = (Vec::new(), Vec::new());
        for task in &lab.tasks {
            host.begins(&task.title);
            self.lab = lab.of_task(task);
            let graded = match &task.work {
                TaskWork::Function(function, checks) => {
                    self.function(task, function, checks, host)?
                }
                TaskWork::Motion(motion, checks) => self.motion(task, motion, checks, host)?,
            };
            if graded.run.is_none() && graded.grade.verdict == Verdict::Passed {
                self.passed.push(task.name.clone());
            }
            if graded.run.is_none() && graded.grade.points < 0.5 * graded.grade.max_points {
                self.broken.push(task.name.clone());
            }
            tasks.push(graded.grade);
            runs.extend(graded.run);
            cases.extend(graded.cases);
            scores.push(graded.scores);
        }
        let graded = GradedRun {
            grade: record(lab, self.staff, self.submission, tasks),
            title: lab.title.clone(),
            staff_faults: self.staff_faults.into_inner(),
            runs,
            cases,
        };
        Ok((graded, scores))
    }

    pub(super) fn opening(&self, task: &Task, submission: &Submission) -> Opening {
        opening(self.lab, task, submission)
    }

    /// Records that a submission of the course staff stopped, once for each.
    pub(super) fn note_stop(
        &self,
        whose: StaffSubmission,
        task: &Task,
        source: &Source,
        ended: Option<&Ended>,
    ) {
        let stop = ended.and_then(Ended::stop);
        let Some(fault) = stop.and_then(|stop| staff_fault(whose, Some(task), source, stop)) else {
            return;
        };
        let mut faults = self.staff_faults.borrow_mut();
        let name = source.name();
        if !faults.iter().any(|known| known.source().name() == name) {
            faults.push(Arc::new(fault));
        }
    }

    /// Whether what is graded is the reference solution, and its runs are kept.
    pub(super) fn is_kept_solution(&self) -> bool {
        self.known
            .is_some_and(|known| known.is_solution(self.submission))
    }

    /// The mutants that a task may match: a motion task excludes those that a function task would have shown but did not.
    pub(super) fn mutants_of(&self, task: &Task) -> impl Iterator<Item = &Mutant> {
        let all = self.staff.map_or(&[][..], |staff| &staff.mutants);
        let name = task.name.clone();
        let is_run = matches!(task.work, TaskWork::Motion(..));
        all.iter().filter(move |mutant| {
            let is_refuted = is_run && mutant.tasks.iter().any(|task| self.passed.contains(task));
            mutant.tasks.contains(&name) && mutant.is_named && !is_refuted
        })
    }

    /// `diagnoses` in the words that their mutants have for `task`.
    pub(super) fn in_words_of(&self, task: &Task, diagnoses: Vec<Diagnosis>) -> Vec<Diagnosis> {
        let mutants = self.staff.map_or(&[][..], |staff| &staff.mutants);
        let worded = |diagnosis: Diagnosis| {
            let mutant = mutants
                .iter()
                .find(|mutant| mutant.name == diagnosis.mistake);
            match mutant {
                Some(mutant) => Diagnosis {
                    says: mutant.words(&task.name).to_owned(),
                    ..diagnosis
                },
                None => diagnosis,
            }
        };
        diagnoses.into_iter().map(worded).collect()
    }
}
