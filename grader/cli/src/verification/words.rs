//! What a comparison found, in words and as JSON.

use std::fmt::Write as _;
use std::path::Path;

use kinemark_grader::record::grade::{Grade, GradeMode};
use kinemark_grader::record::quantity::points;
use kinemark_grader::task::files::Files as _;
use kinemark_report::visible::visible;
use serde::Serialize;

use super::files::MISSING;
use super::findings::{Difference, Findings, NotCompared, Outcome, Subject};
use super::lab::REFERENCE;
use super::{Compared, Course, Verification};
use crate::output;

/// The comparison for programs.
#[derive(Serialize)]
pub(crate) struct Summary<'v> {
    result: Outcome,
    /// Whether all was compared and is the same.
    same: bool,
    mode: GradeMode,
    lab: String,
    submission: String,
    /// The student of the variant, if the report is of one and it names its student.
    student: Option<String>,
    /// Whether it is of the default variant of a lab that has others.
    default_variant: bool,
    /// Points and maximum as recorded.
    points: f64,
    max_points: f64,
    /// The same as graded now, in the report's mode; absent where that was not possible.
    points_again: Option<f64>,
    max_points_again: Option<f64>,
    compared_with: ComparedWith,
    compared: Compared,
    differences: &'v [Difference],
    not_compared: &'v [NotCompared],
}

/// Folders that a report was compared with.
#[derive(Serialize)]
struct ComparedWith {
    labs: String,
    reference: Option<String>,
}

impl Verification {
    /// The comparison for programs.
    pub(crate) fn summary(&self, recorded: &Grade, course: &Course) -> Summary<'_> {
        let shown = |text: &str| visible(text).into_owned();
        let outcome = self.outcome();
        let variant = recorded.variant.as_ref();
        Summary {
            result: outcome,
            same: outcome == Outcome::Same,
            mode: recorded.mode,
            lab: shown(&recorded.lab.name),
            submission: shown(&recorded.submission.name),
            student: variant.and_then(|variant| variant.student.as_deref().map(shown)),
            default_variant: self.is_default_variant,
            points: recorded.points,
            max_points: recorded.max_points,
            points_again: self.again.as_ref().map(|grade| grade.points),
            max_points_again: self.again.as_ref().map(|grade| grade.max_points),
            compared_with: ComparedWith {
                labs: shown(&course.labs.name()),
                reference: self.reference(recorded, course).as_deref().map(shown),
            },
            compared: self.compared,
            differences: &self.findings.differences,
            not_compared: &self.findings.not_compared,
        }
    }

    /// The comparison for people.
    pub(crate) fn text(&self, recorded: &Grade, course: &Course) -> String {
        let Findings {
            differences,
            not_compared,
        } = &self.findings;
        let mut text = why_not(differences).unwrap_or_default();
        text += &self.head(recorded);
        text += &self.compared_with(recorded, course);
        for difference in differences {
            text += &shown_difference(difference);
        }
        for NotCompared { what, why } in not_compared {
            let _ = writeln!(text, "not compared: {what}: {why}");
        }
        let Compared {
            tasks,
            tasks_in_part,
            files,
        } = self.compared;
        let all = recorded.tasks.len();
        let in_part = match tasks_in_part {
            0 => String::new(),
            some => format!(", {some} in part"),
        };
        let much = format!("{tasks} of {all} tasks{in_part}, {files} files");
        match self.outcome() {
            Outcome::Same => text += &format!("same bits: {much}\n"),
            Outcome::PartlyCompared => {
                text += &format!("the same as far as it could be compared: {much}\n");
            }
            Outcome::Differs => {}
        }
        text
    }

    /// What the report says it is, and its points.
    fn head(&self, recorded: &Grade) -> String {
        let mode = match recorded.mode {
            GradeMode::Practice => "practice report, visible cases only",
            GradeMode::Graded => "graded report",
        };
        let of = |grade: &Grade| {
            let [earned, all] = [grade.points, grade.max_points].map(points);
            format!("{earned} of {all} points")
        };
        let earned = match &self.again {
            Some(again) if of(again) == of(recorded) => of(recorded),
            Some(again) => format!("{} as recorded, {} graded again", of(recorded), of(again)),
            None => format!("{} as recorded", of(recorded)),
        };
        let whose = match &recorded.variant {
            Some(variant) => match &variant.student {
                Some(student) => format!(", variant of `{}`", visible(student)),
                None => ", variant without a student's name".to_owned(),
            },
            None if self.is_default_variant => ", default variant".to_owned(),
            None => String::new(),
        };
        let [lab, submission] = [&recorded.lab.name, &recorded.submission.name];
        let [lab, submission] = [lab, submission].map(|name| visible(name));
        format!("{mode}: {lab}, {submission}{whose}: {earned}\n")
    }

    /// The folders that the report was compared with.
    fn compared_with(&self, recorded: &Grade, course: &Course) -> String {
        let labs = course.labs_folder.as_ref().map(|_| course.labs.name());
        let labs = labs.map_or_else(
            || "the labs built in".to_owned(),
            |labs| format!("the labs in `{}`", output::path(plain(&labs))),
        );
        let staff = self.reference(recorded, course);
        let staff = staff.map_or_else(String::new, |folder| {
            format!(
                " and the course staff's part in `{}`",
                output::path(plain(&folder))
            )
        });
        format!("compared with {labs}{staff}\n")
    }

    /// The folder of the course staff's part, where hidden cases were compared with it.
    fn reference(&self, recorded: &Grade, course: &Course) -> Option<String> {
        let folder = course.reference.as_ref()?;
        let took_part = recorded.mode == GradeMode::Graded && !self.findings.leaves_out(REFERENCE);
        took_part.then(|| folder.name())
    }
}

/// A folder as a person would type it: of the course in whose folder one stands the names begin with `./`.
fn plain(folder: &str) -> &Path {
    let folder = Path::new(folder);
    folder.strip_prefix(".").unwrap_or(folder)
}

fn shown_difference(difference: &Difference) -> String {
    let mut place = difference.what.clone();
    if let Some(task) = &difference.task {
        place = format!("{place} of task `{task}`");
    }
    if let (Some(second), Some(signal)) = (difference.second, difference.signal) {
        place = format!("{place}, first in second {second}, signal `{signal}`");
    }
    let recorded = match (difference.kind, difference.recorded.as_str()) {
        (Subject::File, MISSING) => "in the folder: missing".to_owned(),
        (_, there) => format!("recorded {there}"),
    };
    let now = &difference.now;
    format!("differs: {place}\n  {recorded}\n  now      {now}\n")
}

/// What the differences come to, in a line: a change of what was graded explains all that follows from it.
fn why_not(differences: &[Difference]) -> Option<String> {
    let first = differences.first()?;
    let of = |kinds: &[Subject]| {
        let parts = differences.iter().filter(|it| kinds.contains(&it.kind));
        let mut parts: Vec<&str> = parts.map(|it| it.what.as_str()).collect();
        parts.dedup();
        (!parts.is_empty()).then(|| parts.join(", "))
    };
    let of_lab = [Subject::Lab, Subject::Robot, Subject::Scene];
    let why = if of(&[Subject::Engine]).is_some() {
        "it was made by another version of kinemark".to_owned()
    } else if of(&[Subject::Variant]).is_some() {
        "its variant is not the one that the course gives".to_owned()
    } else if let Some(parts) = of(&of_lab) {
        format!("the lab is not the course's ({parts})")
    } else if of(&[Subject::Submission]).is_some() {
        "the submission was changed after grading".to_owned()
    } else if of(&[Subject::Reference]).is_some() {
        "the course staff's part is not the one that it was graded with".to_owned()
    } else if of(&[Subject::Run]).is_some() {
        "a task does not go as recorded".to_owned()
    } else if of(&[Subject::Record]).is_some() {
        "its grade was changed after grading".to_owned()
    } else if first.kind == Subject::Mode {
        "it is a practice report, in which hidden cases have no part".to_owned()
    } else {
        "its files were changed after grading".to_owned()
    };
    Some(format!("this report does not match: {why}\n"))
}
