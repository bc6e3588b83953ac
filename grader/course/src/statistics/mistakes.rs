//! Common mistakes by count, with what those who make them keep: a mistake that is cheap is not worth correcting to a student.

use std::collections::BTreeMap;

use serde::Serialize;

use super::spread::mean;
use crate::lab_rows::{RecordRow, share};

/// A common mistake of a task.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MistakeStatistics {
    /// The task's name.
    pub task: String,
    /// The task's title.
    pub task_title: String,
    /// The mistake's name.
    pub mistake: String,
    /// What a student reads about it.
    pub says: String,
    /// How many make it.
    pub students: usize,
    /// The mean share of the task's points that they keep, from 0 to 1.
    pub task_share: Option<f64>,
    /// The mean share of the lab's points that they keep, from 0 to 1.
    pub lab_share: Option<f64>,
}

#[derive(Default)]
struct Found<'a> {
    task_title: &'a str,
    says: &'a str,
    of_task: Vec<f64>,
    of_lab: Vec<f64>,
    students: usize,
}

/// The named mistakes of the class, the most frequent first.
pub(super) fn mistakes(graded: &[&RecordRow]) -> Vec<MistakeStatistics> {
    let mut all: BTreeMap<(usize, &str, &str), Found<'_>> = BTreeMap::new();
    for record in graded {
        for (place, task) in record.tasks.iter().enumerate() {
            for mistake in &task.mistakes {
                let found = all.entry((place, &task.name, &mistake.name)).or_default();
                (found.task_title, found.says) = (&task.title, &mistake.says);
                found.students += 1;
                found.of_task.extend(share(task.points, task.max_points));
                found.of_lab.extend(share(record.points, record.max_points));
            }
        }
    }
    let mut found: Vec<MistakeStatistics> = all
        .into_iter()
        .map(|((_, task, mistake), found)| MistakeStatistics {
            task: task.to_owned(),
            task_title: found.task_title.to_owned(),
            mistake: mistake.to_owned(),
            says: found.says.to_owned(),
            students: found.students,
            task_share: mean(&found.of_task),
            lab_share: mean(&found.of_lab),
        })
        .collect();
    // stable: equal counts stay in the lab's order
    found.sort_by_key(|mistake| std::cmp::Reverse(mistake.students));
    found
}
