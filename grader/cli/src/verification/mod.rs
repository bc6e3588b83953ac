//! A report compared with what its submission earns now: in the course's lab, with the course staff's part where it is at hand. What a
//! report says about itself proves nothing; what could not be compared is named.

mod course;
mod files;
mod findings;
mod lab;
mod record;
mod words;

use kinemark_grader::judge::reference_run;
use kinemark_grader::record::grade::{Grade, GradeMode};
use kinemark_grader::record::graded::GradedRun;
use kinemark_report::visible::visible;

pub(crate) use course::Course;
pub(crate) use findings::Outcome;
use findings::{Difference, Findings, Subject};
use lab::ComparedLab;

use crate::error_record::ErrorCode;
use crate::failure::Failure;
use crate::report_folder::Report;
use crate::worker::WorkerHost;

/// What whoever verifies wants to be so, besides.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wanted<'a> {
    /// Hidden cases took part.
    pub(crate) graded: bool,
    /// The variant is this student's.
    pub(crate) student: Option<&'a str>,
}

/// A report, compared.
pub(crate) struct Verification {
    findings: Findings,
    /// The record as graded now, in the mode of the report; none where nothing was graded again, or only in part.
    again: Option<Grade>,
    /// Whether the report is of the default variant of a lab that has others.
    is_default_variant: bool,
    compared: Compared,
}

/// How much was compared.
#[derive(Debug, Clone, Copy, Default, serde::Serialize)]
struct Compared {
    /// Tasks, wholly.
    tasks: usize,
    /// Tasks of which only what is visible was compared.
    tasks_in_part: usize,
    /// Files of the folder.
    files: usize,
}

impl Verification {
    /// Compares a report with the course's lab and staff part.
    ///
    /// # Errors
    /// A course that cannot be read, a report that is none, and what this machine fails at.
    pub(crate) fn of(
        report: &Report,
        course: &Course,
        wanted: Wanted<'_>,
    ) -> Result<Self, Failure> {
        let mut findings = Findings::default();
        if wanted.graded && report.grade.mode == GradeMode::Practice {
            findings.differ(Difference::of(
                Subject::Mode,
                "mode",
                "practice",
                "graded, as --graded wants it",
            ));
        }
        let mut verification = Self {
            findings,
            again: None,
            is_default_variant: false,
            compared: Compared::default(),
        };
        let lab = lab::compared(report, course, wanted.student, &mut verification.findings)?;
        match lab {
            Some(lab) => verification.grade_again(report, &lab)?,
            // with another lab every run is another, and the record can only be compared with itself
            None => record::with_itself(&report.grade, &mut verification.findings),
        }
        Ok(verification)
    }

    /// Grades the submission again, and compares the record and the files.
    fn grade_again(&mut self, report: &Report, of: &ComparedLab) -> Result<(), Failure> {
        let ComparedLab { lab, staff } = of;
        let before = self.findings.differences.len();
        self.is_default_variant = lab.variant.is_none() && !lab.variants.is_empty();
        let mut host = WorkerHost::new(None);
        let graded = report.submission.grade(lab, staff.as_ref(), &mut host);
        let mut graded = graded.map_err(|_| Failure::interrupted())?;
        refuse_undecided(&report.grade, &graded.grade)?;
        if let Some(staff) = staff
            .as_ref()
            .filter(|_| report.manifest.request.reference_overlay)
        {
            reference_run::show_reference(lab, staff, &mut graded);
        }
        let is_whole = report.grade.mode == graded.grade.mode;
        let tasks = record::compare(&report.grade, &graded.grade, &mut self.findings);
        (self.compared.tasks, self.compared.tasks_in_part) = tasks;
        if is_whole {
            self.again = Some(graded.grade.clone());
        }
        // of another record every page and log is another
        if self.findings.differences.len() == before {
            let shown = if is_whole {
                graded
            } else {
                as_recorded(graded, &report.grade)
            };
            let is_certain = is_whole || !files::show_the_reference(report, lab);
            let found = &mut self.findings;
            self.compared.files = files::compare(report, lab, &shown, is_certain, found)?;
        }
        Ok(())
    }

    /// How the comparison ended.
    pub(crate) fn outcome(&self) -> Outcome {
        self.findings.outcome()
    }
}

/// Runs of a practice grade with the record of the graded one: what pages and logs were made from, but for the reference solution.
fn as_recorded(graded: GradedRun, recorded: &Grade) -> GradedRun {
    let mut shown = GradedRun {
        grade: recorded.clone(),
        ..graded
    };
    for run in &mut shown.runs {
        let task = recorded.tasks.iter().find(|task| task.name == run.task);
        run.divergence = task.and_then(|task| task.divergence.clone());
    }
    shown
}

/// What this machine could not grade says nothing about the report.
fn refuse_undecided(recorded: &Grade, now: &Grade) -> Result<(), Failure> {
    let undecided = now.tasks.iter().find(|task| !task.verdict.is_decided());
    let Some(task) = undecided.filter(|_| recorded.verdict.is_decided()) else {
        return Ok(());
    };
    let why = task.stopped.as_ref();
    let why = why.map_or(task.verdict.name(), |stopped| &stopped.message);
    Err(Failure::fault(
        format!(
            "task `{}` could not be graded again: {}",
            visible(&task.name),
            visible(why)
        ),
        "verify again when this machine is less busy; nothing is known about the report",
    )
    .coded(ErrorCode::Undecided))
}
