//! The submissions that used the most operations, compared with the class.

use std::collections::BTreeMap;

use serde::Serialize;

use super::spread::Spread;
use crate::lab_rows::RecordRow;

/// How many are listed.
const MOST_RUNS: usize = 10;

/// A task of a record, by what it used.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SlowRun {
    /// The task's name.
    pub task: String,
    /// The task's title.
    pub task_title: String,
    /// The key of the record.
    pub record: String,
    /// How many students have this record: those who handed in the same file.
    pub students: usize,
    /// Operations of the task; in a function task those of visible cases.
    pub operations: u64,
    /// How many times the median of the class; absent where that is 0.
    pub times_median: Option<f64>,
}

/// The ten tasks of records that used the most operations, the slowest first; `graded` has key and record of each graded student.
pub(super) fn slow_runs(graded: &[(&str, &RecordRow)]) -> Vec<SlowRun> {
    let mut of_task: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    let mut runs: BTreeMap<(&str, usize), SlowRun> = BTreeMap::new();
    for (key, record) in graded {
        for (place, task) in record.tasks.iter().enumerate() {
            of_task
                .entry(&task.name)
                .or_default()
                .push(task.operations as f64);
            let run = runs.entry((key, place)).or_insert_with(|| SlowRun {
                task: task.name.clone(),
                task_title: task.title.clone(),
                record: (*key).to_owned(),
                students: 0,
                operations: task.operations,
                times_median: None,
            });
            run.students += 1;
        }
    }
    let medians: BTreeMap<&str, f64> = of_task
        .into_iter()
        .filter_map(|(task, operations)| Some((task, Spread::of(&operations)?.median)))
        .collect();
    let mut runs: Vec<SlowRun> = runs.into_values().collect();
    // stable: equal ones stay in the order of keys
    runs.sort_by_key(|run| std::cmp::Reverse(run.operations));
    runs.truncate(MOST_RUNS);
    for run in &mut runs {
        let median = medians
            .get(run.task.as_str())
            .filter(|median| **median > 0.0);
        run.times_median = median.map(|median| run.operations as f64 / median);
    }
    runs
}
