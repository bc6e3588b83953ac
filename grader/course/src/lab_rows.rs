//! The records of a lab as the index has them: tasks, checks, measures and named mistakes, without reading the records themselves.

use std::collections::BTreeMap;

use kinemark_grader::record::grade::Outcome;
use kinemark_grader::record::verdict::Verdict;
use rusqlite::{Row, params};

use crate::index::{Index, IndexError};

/// A record.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RecordRow {
    /// The digest of its submission.
    pub(crate) submission: String,
    pub(crate) engine: String,
    pub(crate) lab_version: String,
    /// The student whose variant it is, if it is one.
    pub(crate) variant_of: Option<String>,
    pub(crate) points: f64,
    pub(crate) max_points: f64,
    /// Its tasks, in the lab's order.
    pub(crate) tasks: Vec<TaskRow>,
}

/// A task of a record.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TaskRow {
    pub(crate) name: String,
    pub(crate) title: String,
    pub(crate) verdict: Verdict,
    pub(crate) points: f64,
    pub(crate) max_points: f64,
    pub(crate) operations: u64,
    /// Digest of its run, or of its answers.
    pub(crate) digest: String,
    /// Its checks, in the lab's order.
    pub(crate) checks: Vec<CheckRow>,
    /// Common mistakes that it was found to agree with.
    pub(crate) mistakes: Vec<MistakeRow>,
}

/// A check of a record.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CheckRow {
    pub(crate) name: String,
    pub(crate) title: String,
    pub(crate) outcome: Outcome,
    pub(crate) points: f64,
    pub(crate) max_points: f64,
    pub(crate) measure: Option<MeasureRow>,
    /// Whether all of its evidence is about hidden cases or runs.
    pub(crate) lost_in_hidden_only: bool,
}

/// What a check measured.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MeasureRow {
    pub(crate) quantity: String,
    pub(crate) unit: String,
    pub(crate) full: f64,
    pub(crate) zero: f64,
    /// Absent where it was not finite.
    pub(crate) value: Option<f64>,
}

/// A common mistake, named.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MistakeRow {
    pub(crate) name: String,
    pub(crate) says: String,
}

const RECORDS: &str = "SELECT key, submission, engine, lab_version, variant_of, points, max_points \
    FROM records WHERE lab = ?1";
const TASKS: &str = "SELECT record, tasks.name, title, tasks.verdict, tasks.points, tasks.max_points, operations, digest \
    FROM tasks JOIN records ON key = record WHERE lab = ?1 ORDER BY record, place";
const CHECKS: &str = "SELECT record, task, checks.name, title, outcome, checks.points, checks.max_points, quantity, unit, full, \
    zero, value, lost_in_hidden_only FROM checks JOIN records ON key = record WHERE lab = ?1 ORDER BY record, task, place";
const MISTAKES: &str = "SELECT record, task, mistake, says FROM mistakes JOIN records ON key = record WHERE lab = ?1 \
    ORDER BY record, task, mistake";

/// All records of a lab, by key.
pub(crate) fn records(index: &Index, lab: &str) -> Result<BTreeMap<String, RecordRow>, IndexError> {
    let mut records: BTreeMap<String, RecordRow> = index
        .rows(RECORDS, params![lab], |row| Ok((row.get(0)?, record(row)?)))?
        .into_iter()
        .collect();
    for (key, task) in index.rows(TASKS, params![lab], |row| {
        Ok((row.get::<_, String>(0)?, task(row)?))
    })? {
        if let Some(record) = records.get_mut(&key) {
            record.tasks.push(task);
        }
    }
    let of_task =
        |row: &Row<'_>| -> rusqlite::Result<(String, String)> { Ok((row.get(0)?, row.get(1)?)) };
    for ((key, task), check) in
        index.rows(CHECKS, params![lab], |row| Ok((of_task(row)?, check(row)?)))?
    {
        if let Some(task) = task_mut(&mut records, &key, &task) {
            task.checks.push(check);
        }
    }
    for ((key, task), mistake) in index.rows(MISTAKES, params![lab], |row| {
        let (name, says) = (row.get(2)?, row.get(3)?);
        Ok((of_task(row)?, MistakeRow { name, says }))
    })? {
        if let Some(task) = task_mut(&mut records, &key, &task) {
            task.mistakes.push(mistake);
        }
    }
    Ok(records)
}

fn task_mut<'r>(
    records: &'r mut BTreeMap<String, RecordRow>,
    key: &str,
    task: &str,
) -> Option<&'r mut TaskRow> {
    let mut tasks = records.get_mut(key)?.tasks.iter_mut();
    tasks.find(|known| known.name == task)
}

fn record(row: &Row<'_>) -> rusqlite::Result<RecordRow> {
    Ok(RecordRow {
        submission: row.get(1)?,
        engine: row.get(2)?,
        lab_version: row.get(3)?,
        variant_of: row.get(4)?,
        points: row.get(5)?,
        max_points: row.get(6)?,
        tasks: Vec::new(),
    })
}

fn task(row: &Row<'_>) -> rusqlite::Result<TaskRow> {
    let verdict: String = row.get(3)?;
    let operations: i64 = row.get(6)?;
    Ok(TaskRow {
        name: row.get(1)?,
        title: row.get(2)?,
        verdict: Verdict::named(&verdict).unwrap_or(Verdict::GraderFault),
        points: row.get(4)?,
        max_points: row.get(5)?,
        operations: operations.unsigned_abs(),
        digest: row.get(7)?,
        checks: Vec::new(),
        mistakes: Vec::new(),
    })
}

fn check(row: &Row<'_>) -> rusqlite::Result<CheckRow> {
    let outcome: String = row.get(4)?;
    let quantity: Option<String> = row.get(7)?;
    let measure = match quantity {
        Some(quantity) => Some(MeasureRow {
            quantity,
            unit: row.get(8)?,
            full: row.get(9)?,
            zero: row.get(10)?,
            value: row.get(11)?,
        }),
        None => None,
    };
    Ok(CheckRow {
        name: row.get(2)?,
        title: row.get(3)?,
        outcome: match outcome.as_str() {
            "full" => Outcome::Full,
            "partial" => Outcome::Partial,
            "none" => Outcome::None,
            _ => Outcome::NotJudged,
        },
        points: row.get(5)?,
        max_points: row.get(6)?,
        measure,
        lost_in_hidden_only: row.get(12)?,
    })
}

/// A share of points, where there are any to have.
pub(crate) fn share(points: f64, of: f64) -> Option<f64> {
    (of > 0.0).then(|| points / of)
}
