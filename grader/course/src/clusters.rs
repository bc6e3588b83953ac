//! Wrong answers that several students share and that no common mistake names: candidates for next year's mutants.
//!
//! Two ways to be alike are known:
//!
//! - **The same answers.** The digest of the task is equal: bit by bit the same run, or the same answers to every case, visible and
//!   hidden. Tasks whose numbers do not depend on a student's variant are compared over the whole class; others agree only among
//!   students with the same variant.
//! - **The same losses.** Where each student has a variant, no two runs of a task that uses it are equal. Then records are alike that
//!   lose points in the same checks and earn the same hundredths in each, and of at least one check a part: that everything is lost
//!   in one check says nothing about why.
//!
//! What it cannot see: a mistake made in two ways that differ in rounding has two digests; so has a run that prints or plots something
//! else. Submissions that were stopped share where they stopped, not an answer, so only tasks that ran to their end are compared. A
//! cluster that earns nothing is often the starter, or an arm that never moves. One file handed in by several counts as one author:
//! what two people copied is no cluster.

use std::collections::{BTreeMap, BTreeSet};

use kinemark_grader::record::grade::Outcome;
use kinemark_grader::record::verdict::Verdict;
use serde::Serialize;

use crate::index::{Index, IndexError};
use crate::lab_rows::{self, CheckRow, RecordRow, TaskRow, share};
use crate::standing::{Standing, Status};
use crate::student::StudentId;

/// How the answers of a cluster are alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Likeness {
    /// They are equal to the bit.
    Answers,
    /// They lose the same points in the same checks.
    Losses,
}

/// Students with the same wrong answer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cluster {
    /// The task's name.
    pub task: String,
    /// The task's title.
    pub task_title: String,
    /// How they are alike.
    pub likeness: Likeness,
    /// Who, sorted: for course staff alone.
    pub students: Vec<StudentId>,
    /// How many different files they handed in.
    pub submissions: usize,
    /// Titles of the checks that lost points, in the lab's order.
    pub lost: Vec<String>,
    /// The share of the task's points that they keep, from 0 to 1.
    pub keeps: Option<f64>,
    /// The key of one of the records, to look at.
    pub example: String,
}

/// A student's task that lost points for no known reason.
struct Wrong<'a> {
    student: &'a StudentId,
    key: &'a str,
    record: &'a RecordRow,
    task: &'a TaskRow,
    place: usize,
}

/// The clusters of `lab`, the largest first: `standings` say which record counts.
///
/// # Errors
/// An index that cannot be read.
pub fn of_lab(
    index: &Index,
    lab: &str,
    standings: &[Standing],
) -> Result<Vec<Cluster>, IndexError> {
    let records = lab_rows::records(index, lab)?;
    let mut by_answers: BTreeMap<(usize, &str), Vec<Wrong<'_>>> = BTreeMap::new();
    for wrong in wrong(&records, lab, standings) {
        let key = (wrong.place, wrong.task.digest.as_str());
        by_answers.entry(key).or_default().push(wrong);
    }
    let mut clusters = Vec::new();
    let mut by_losses: BTreeMap<(usize, String), Vec<Wrong<'_>>> = BTreeMap::new();
    for ((place, _), alike) in by_answers {
        if let Some(cluster) = cluster(&alike, Likeness::Answers) {
            clusters.push((place, cluster));
            continue;
        }
        for wrong in alike {
            if wrong.record.variant_of.is_some()
                && let Some(losses) = losses(wrong.task)
            {
                by_losses.entry((place, losses)).or_default().push(wrong);
            }
        }
    }
    for ((place, _), alike) in by_losses {
        clusters.extend(cluster(&alike, Likeness::Losses).map(|cluster| (place, cluster)));
    }
    // stable: clusters of one size stay in the order of tasks
    clusters.sort_by_key(|(place, cluster)| {
        (
            std::cmp::Reverse(cluster.students.len()),
            *place,
            cluster.likeness,
        )
    });
    Ok(clusters.into_iter().map(|(_, cluster)| cluster).collect())
}

/// Tasks that ran to their end, lost points, and agree with no known mistake.
fn wrong<'a>(
    records: &'a BTreeMap<String, RecordRow>,
    lab: &str,
    standings: &'a [Standing],
) -> Vec<Wrong<'a>> {
    let graded = standings
        .iter()
        .filter(|standing| standing.lab == lab && standing.status == Status::Graded);
    let mut wrong = Vec::new();
    for standing in graded {
        let found = standing
            .record
            .as_ref()
            .and_then(|key| records.get_key_value(key));
        let Some((key, record)) = found else { continue };
        for (place, task) in record.tasks.iter().enumerate() {
            if task.verdict == Verdict::Missed && task.mistakes.is_empty() {
                wrong.push(Wrong {
                    student: &standing.student,
                    key,
                    record,
                    task,
                    place,
                });
            }
        }
    }
    wrong
}

/// A cluster of at least two students with at least two files.
fn cluster(alike: &[Wrong<'_>], likeness: Likeness) -> Option<Cluster> {
    let files: BTreeSet<&str> = alike
        .iter()
        .map(|wrong| wrong.record.submission.as_str())
        .collect();
    if files.len() < 2 {
        return None;
    }
    let first = alike.iter().min_by_key(|wrong| wrong.student)?;
    let mut students: Vec<StudentId> = alike.iter().map(|wrong| wrong.student.clone()).collect();
    students.sort();
    Some(Cluster {
        task: first.task.name.clone(),
        task_title: first.task.title.clone(),
        likeness,
        students,
        submissions: files.len(),
        lost: lost(first.task).map(|check| check.title.clone()).collect(),
        keeps: share(first.task.points, first.task.max_points),
        example: first.key.to_owned(),
    })
}

fn lost(task: &TaskRow) -> impl Iterator<Item = &CheckRow> {
    task.checks
        .iter()
        .filter(|check| check.outcome != Outcome::Full)
}

/// What a task lost, check by check in hundredths; `None` where no check earned a part, which would say too little.
fn losses(task: &TaskRow) -> Option<String> {
    lost(task).find(|check| check.outcome == Outcome::Partial)?;
    let lost =
        lost(task).map(|check| format!("{} {:?} {:.2}", check.name, check.outcome, check.points));
    Some(lost.collect::<Vec<_>>().join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::made_up_class::{LAB, MadeUpClass, MadeUpStudent, check, task, with_mistake};
    use kinemark_grader::record::grade::TaskGrade;

    fn fk(digest: &str, points: f64) -> TaskGrade {
        task(
            "fk",
            digest,
            vec![
                check("position", points, 4.0, 0.02),
                check("other", 4.0, 4.0, 0.0),
            ],
        )
    }

    fn clusters(students: &[MadeUpStudent]) -> Vec<Cluster> {
        let class = MadeUpClass::of(students);
        of_lab(&class.index, LAB, &class.standings).unwrap()
    }

    fn ids(cluster: &Cluster) -> Vec<&str> {
        cluster.students.iter().map(StudentId::as_str).collect()
    }

    #[test]
    fn equal_wrong_answers_are_a_cluster_and_right_or_named_ones_are_not() {
        let new = |id: &str, task| MadeUpStudent::new(id, vec![task]);
        let found = clusters(&[
            new("s3", fk("wrong", 1.0)),
            new("s1", fk("wrong", 1.0)),
            new("s2", fk("other", 1.0)),
            new("s4", fk("right", 4.0)),
            new("s5", fk("right", 4.0)),
            new("s6", with_mistake(fk("named", 2.0), "cosine-sign")),
            new("s7", with_mistake(fk("named", 2.0), "cosine-sign")),
        ]);
        let [cluster] = &found[..] else {
            panic!("{found:?}")
        };
        assert_eq!(ids(cluster), ["s1", "s3"]);
        assert_eq!(
            (cluster.likeness, cluster.submissions),
            (Likeness::Answers, 2)
        );
        assert_eq!(cluster.lost, ["Check position"]);
        assert_eq!(cluster.keeps, Some(0.625));
    }

    #[test]
    fn one_file_of_two_people_is_no_cluster() {
        let mut students = [
            MadeUpStudent::new("s1", vec![fk("wrong", 1.0)]),
            MadeUpStudent::new("s2", vec![fk("wrong", 1.0)]),
        ];
        students[1].file = students[0].file.clone();
        assert!(clusters(&students).is_empty());
    }

    #[test]
    fn where_each_has_a_variant_equal_losses_are_a_cluster() {
        let new = |id: &str, digest: &str, points: f64| {
            let mut student = MadeUpStudent::new(id, vec![fk(digest, points)]);
            student.has_variant = true;
            student
        };
        let students = [
            new("s1", "a", 1.25),
            new("s2", "b", 1.25),
            new("s3", "c", 1.26),
            // everything lost in one check says nothing about why
            new("s4", "d", 0.0),
            new("s5", "e", 0.0),
        ];
        let found = clusters(&students);
        let [cluster] = &found[..] else {
            panic!("{found:?}")
        };
        assert_eq!(
            (ids(cluster), cluster.likeness),
            (vec!["s1", "s2"], Likeness::Losses)
        );
        // without variants it would have been the same run
        let plain = students.map(|student| MadeUpStudent {
            has_variant: false,
            ..student
        });
        assert!(clusters(&plain).is_empty());
    }

    #[test]
    fn what_was_stopped_is_in_no_cluster() {
        let stopped = || {
            let mut task = fk("stopped", 1.0);
            task.verdict = Verdict::Crashed;
            task
        };
        let students = ["s1", "s2"].map(|id| MadeUpStudent::new(id, vec![stopped()]));
        assert!(clusters(&students).is_empty());
    }
}
