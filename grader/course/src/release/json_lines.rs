//! JSON Lines: an object a student, for programs. It has ids and no names.

use jiff::Timestamp;
use kinemark_grader::record::grade::{Evidence, Grade, HiddenClass, Measure, Outcome, Stopped};
use kinemark_grader::record::verdict::Verdict;
use serde::Serialize;

use super::decided::{Decided, decided, hundredths};
use super::{ExportUse, Form, Made, Material, OutFile, ReleaseError, Row};
use crate::standing::{ByHand, Status};
use crate::student::StudentId;

pub(super) const FORM: Form = Form {
    name: "jsonl",
    title: "JSON Lines: an object a student",
    export: ExportUse::Unused,
    columns: &[],
    make,
};

/// The format of a line.
const FORMAT: &str = "kinemark-release/1";

#[derive(Serialize)]
struct Line<'a> {
    format: &'static str,
    student: &'a StudentId,
    lab: &'a str,
    status: Status,
    /// With those by hand; absent where nothing is decided.
    points: Option<f64>,
    max_points: Option<f64>,
    verdict: Option<Verdict>,
    attempt: Option<usize>,
    attempts: usize,
    submitted_at: Option<Timestamp>,
    late_s: Option<i64>,
    marked_late: bool,
    by_hand: &'a [ByHand],
    excuse: Option<&'a str>,
    record: Option<&'a str>,
    engine: Option<&'a str>,
    tasks: Vec<Task<'a>>,
}

#[derive(Serialize)]
struct Task<'a> {
    name: &'a str,
    title: &'a str,
    verdict: Verdict,
    points: f64,
    max_points: f64,
    stopped: Option<&'a Stopped>,
    hidden: &'a [HiddenClass],
    checks: Vec<Check<'a>>,
}

#[derive(Serialize)]
struct Check<'a> {
    name: &'a str,
    title: &'a str,
    outcome: Outcome,
    /// With those by hand.
    points: f64,
    max_points: f64,
    measure: Option<&'a Measure>,
    evidence: &'a [Evidence],
    next_step: Option<&'a str>,
    /// The hints behind the next step, where points were lost.
    hints: &'a [String],
}

fn make(material: &Material<'_>) -> Result<Made, ReleaseError> {
    let mut bytes = Vec::new();
    for row in material.rows {
        // numbers and text alone cannot fail to be written
        bytes.extend(serde_json::to_vec(&line(material, row)).unwrap_or_default());
        bytes.push(b'\n');
    }
    Ok(Made {
        files: vec![OutFile {
            path: "grades.jsonl".to_owned(),
            bytes,
        }],
        notes: Vec::new(),
    })
}

fn line<'a>(material: &Material<'a>, row: &Row<'a>) -> Line<'a> {
    let standing = row.standing;
    let decided = decided(row);
    let grade = decided.and_then(|decided| decided.grade);
    Line {
        format: FORMAT,
        student: &row.person.id,
        lab: material.lab,
        status: standing.status,
        points: decided.map(|decided| hundredths(decided.points)),
        max_points: decided.and_then(|decided| decided.max_points),
        verdict: standing.verdict,
        attempt: standing.attempt,
        attempts: standing.attempts,
        submitted_at: standing.submitted_at,
        late_s: standing.late_s,
        marked_late: standing.marked_late,
        by_hand: &standing.by_hand,
        excuse: standing.excuse.as_deref(),
        record: standing.record.as_deref(),
        engine: grade.map(|grade| grade.engine.as_str()),
        tasks: match (grade, decided) {
            (Some(grade), Some(decided)) => tasks(grade, &decided),
            _ => Vec::new(),
        },
    }
}

fn tasks<'a>(grade: &'a Grade, decided: &Decided<'a>) -> Vec<Task<'a>> {
    let all = decided.checks();
    let tasks = grade.tasks.iter().enumerate();
    tasks
        .map(|(i, task)| {
            let of_task = all.iter().filter(|check| check.number.0 == i + 1);
            let checks: Vec<Check<'a>> = of_task
                .map(|of| Check {
                    name: &of.check.name,
                    title: &of.check.title,
                    outcome: of.check.outcome,
                    points: of.points,
                    max_points: of.check.max_points,
                    measure: of.check.measure.as_ref(),
                    evidence: &of.check.evidence,
                    next_step: of.check.next_step.as_deref(),
                    hints: of.hints,
                })
                .collect();
            Task {
                name: &task.name,
                title: &task.title,
                verdict: task.verdict,
                points: hundredths(checks.iter().map(|check| check.points).sum()),
                max_points: task.max_points,
                stopped: task.stopped.as_ref(),
                hidden: &task.hidden,
                checks,
            }
        })
        .collect()
}

#[cfg(test)]
mod tests;
