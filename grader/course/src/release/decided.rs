//! The grade of a student that may be written as a number: one that is decided, with the points that people gave.

use kinemark_grader::record::grade::{CheckGrade, Grade, TaskGrade};
use kinemark_grader::record::hints::Hints;

use super::Row;
use crate::standing::{ByHand, Status};

/// A decided grade.
#[derive(Clone, Copy)]
pub(super) struct Decided<'a> {
    /// Points with those by hand.
    pub(super) points: f64,
    /// The maximum, where it is known: not where points were given without a file.
    pub(super) max_points: Option<f64>,
    /// The grade of the record.
    pub(super) grade: Option<&'a Grade>,
    /// Points by hand.
    pub(super) by_hand: &'a [ByHand],
    /// The hints of the lab.
    pub(super) hints: &'a Hints,
}

/// A check with the points that people gave for it.
pub(super) struct CheckPoints<'a> {
    pub(super) task: &'a TaskGrade,
    pub(super) check: &'a CheckGrade,
    /// Number of task and check, from one.
    pub(super) number: (usize, usize),
    /// Points with those by hand.
    pub(super) points: f64,
    /// Points by hand of this check.
    pub(super) by_hand: Vec<&'a ByHand>,
    /// The hints behind its next step, where it lost points.
    pub(super) hints: &'a [String],
}

impl CheckPoints<'_> {
    /// `TASK/CHECK`.
    pub(super) fn name(&self) -> String {
        name(self.task, self.check)
    }
}

/// `TASK/CHECK`, as in `fixes.toml`.
pub(super) fn name(task: &TaskGrade, check: &CheckGrade) -> String {
    format!("{}/{}", task.name, check.name)
}

/// The grade of a row; none where nothing was handed in, or where nothing is decided. A grade that this machine or the grader failed
/// to make is not a number.
pub(super) fn decided<'a>(row: &Row<'a>) -> Option<Decided<'a>> {
    let standing = row.standing;
    let grade = row.record.map(|record| &record.grade);
    let is_decided = standing.status == Status::Graded
        && standing.verdict.is_none_or(|verdict| verdict.is_decided())
        && grade.is_none_or(|grade| grade.verdict.is_decided());
    let points = standing.points.filter(|points| points.is_finite())?;
    is_decided.then_some(Decided {
        points,
        max_points: standing.max_points.or(grade.map(|grade| grade.max_points)),
        grade,
        by_hand: &standing.by_hand,
        hints: row.hints,
    })
}

impl<'a> Decided<'a> {
    /// Every check, in the lab's order.
    pub(super) fn checks(&self) -> Vec<CheckPoints<'a>> {
        let mut all = Vec::new();
        let tasks = self.grade.into_iter().flat_map(|grade| &grade.tasks);
        for (i, task) in tasks.enumerate() {
            for (j, check) in task.checks.iter().enumerate() {
                let name = name(task, check);
                let of_check = |by_hand: &&ByHand| by_hand.check.as_deref() == Some(name.as_str());
                let by_hand: Vec<&ByHand> = self.by_hand.iter().filter(of_check).collect();
                let change: f64 = by_hand.iter().map(|by_hand| by_hand.change).sum();
                all.push(CheckPoints {
                    task,
                    check,
                    number: (i + 1, j + 1),
                    points: hundredths((check.points + change).max(0.0)),
                    by_hand,
                    hints: self.hints.behind_next_step(&task.name, check),
                });
            }
        }
        all
    }

    /// The title of the check called `TASK/CHECK`.
    pub(super) fn title(&self, check: &str) -> Option<&'a str> {
        let mut tasks = self.grade.into_iter().flat_map(|grade| &grade.tasks);
        tasks.find_map(|task| {
            let mut checks = task.checks.iter();
            let found = checks.find(|known| name(task, known) == check)?;
            Some(found.title.as_str())
        })
    }
}

/// Without the rounding error of a sum of hundredths.
pub(super) fn hundredths(points: f64) -> f64 {
    (points * 100.0).round() / 100.0
}
