//! A lab over the class: who has a grade, the points, and everything that is made of them.

use std::collections::BTreeMap;

use serde::Serialize;

use super::check::{CheckStatistics, checks};
use super::groups::{GroupPoints, attempts, lateness, sections};
use super::mistakes::{MistakeStatistics, mistakes};
use super::runs::{SlowRun, slow_runs};
use super::spread::{Bin, Spread, bins};
use crate::index::{Index, IndexError};
use crate::lab_rows::{self, RecordRow};
use crate::roster::Roster;
use crate::standing::{Standing, Status};

/// The numbers of a lab.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LabStatistics {
    /// The lab's name.
    pub lab: String,
    /// Students of the roster.
    pub students: usize,
    /// How many are where; those with nobody are left out.
    pub statuses: Vec<StatusCount>,
    /// The most that can be earned.
    pub max_points: f64,
    /// The points of those with a grade, points by hand included.
    pub points: Option<Spread>,
    /// How many of them have all points, or more.
    pub full_marks: usize,
    /// How many of them have points by hand.
    pub by_hand: usize,
    /// How the points are distributed.
    pub histogram: Vec<Bin>,
    /// Every check, in the lab's order. Here and below, points by hand do not count.
    pub checks: Vec<CheckStatistics>,
    /// Named mistakes, the most frequent first.
    pub mistakes: Vec<MistakeStatistics>,
    /// The ten slowest runs.
    pub slow_runs: Vec<SlowRun>,
    /// By section; empty where the roster has none.
    pub sections: Vec<GroupPoints>,
    /// By number of attempts.
    pub attempts: Vec<GroupPoints>,
    /// By lateness; empty where it is not known.
    pub lateness: Vec<GroupPoints>,
    /// Engines and versions of the lab that graded, the most frequent first.
    pub versions: Vec<Version>,
}

/// How many students are where.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct StatusCount {
    /// Where their grade is.
    pub status: Status,
    /// How many.
    pub students: usize,
}

/// What graded.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Version {
    /// The engine.
    pub engine: String,
    /// The version of the lab's files.
    pub lab_version: String,
    /// How many students it graded.
    pub students: usize,
}

impl LabStatistics {
    /// How many students are at `status`.
    pub fn at(&self, status: Status) -> usize {
        let mut counts = self.statuses.iter();
        counts
            .find(|count| count.status == status)
            .map_or(0, |count| count.students)
    }
}

/// The numbers of `lab`: `standings` say which record counts, `index` has the records, `roster` the sections.
///
/// # Errors
/// An index that cannot be read.
pub fn of_lab(
    index: &Index,
    lab: &str,
    standings: &[Standing],
    roster: &Roster,
) -> Result<LabStatistics, IndexError> {
    let records = lab_rows::records(index, lab)?;
    let standings: Vec<&Standing> = standings
        .iter()
        .filter(|standing| standing.lab == lab)
        .collect();
    let counting: Vec<&Standing> = standings
        .iter()
        .copied()
        .filter(|standing| standing.status == Status::Graded)
        .collect();
    let keyed: Vec<(&str, &RecordRow)> = counting
        .iter()
        .filter_map(|standing| {
            let key = standing.record.as_deref()?;
            Some((key, records.get(key)?))
        })
        .collect();
    let graded: Vec<&RecordRow> = keyed.iter().map(|(_, record)| *record).collect();
    let points: Vec<f64> = counting
        .iter()
        .filter_map(|standing| standing.points)
        .collect();
    let max_points = counting
        .iter()
        .filter_map(|standing| standing.max_points)
        .fold(0.0, f64::max);
    Ok(LabStatistics {
        lab: lab.to_owned(),
        students: standings.len(),
        statuses: statuses(&standings),
        max_points,
        points: Spread::of(&points),
        full_marks: points
            .iter()
            .filter(|points| max_points > 0.0 && **points >= max_points)
            .count(),
        by_hand: counting
            .iter()
            .filter(|standing| !standing.by_hand.is_empty())
            .count(),
        histogram: bins(&points, max_points),
        checks: checks(&graded),
        mistakes: mistakes(&graded),
        slow_runs: slow_runs(&keyed),
        sections: sections(&standings, roster),
        attempts: attempts(&standings),
        lateness: lateness(&standings),
        versions: versions(&graded),
    })
}

fn statuses(standings: &[&Standing]) -> Vec<StatusCount> {
    let mut counts: BTreeMap<Status, usize> = BTreeMap::new();
    for standing in standings {
        *counts.entry(standing.status).or_default() += 1;
    }
    let counts = counts.into_iter();
    counts
        .map(|(status, students)| StatusCount { status, students })
        .collect()
}

fn versions(graded: &[&RecordRow]) -> Vec<Version> {
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for record in graded {
        *counts
            .entry((&record.engine, &record.lab_version))
            .or_default() += 1;
    }
    let mut versions: Vec<Version> = counts
        .into_iter()
        .map(|((engine, lab_version), students)| Version {
            engine: engine.to_owned(),
            lab_version: lab_version.to_owned(),
            students,
        })
        .collect();
    versions.sort_by_key(|version| std::cmp::Reverse(version.students));
    versions
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::made_up_class::{
        LAB, MadeUpClass, MadeUpStudent, check, lost_in_hidden, task, with_mistake,
    };
    use crate::statistics::HiddenOnly;

    /// Four with grades of 10 points (10, 7, 5, 4), one missing, one excused.
    fn class() -> MadeUpClass {
        let fk = |points: f64| check("position", points, 4.0, 0.02);
        let ik = |points: f64| check("reach", points, 6.0, 0.0);
        let mut students = vec![
            MadeUpStudent::new(
                "s1",
                vec![
                    task("fk", "a", vec![fk(4.0)]),
                    task("ik", "a", vec![ik(6.0)]),
                ],
            ),
            MadeUpStudent::new(
                "s2",
                vec![
                    with_mistake(task("fk", "b", vec![fk(1.0)]), "cosine-sign"),
                    task("ik", "a", vec![ik(6.0)]),
                ],
            ),
            MadeUpStudent::new(
                "s3",
                vec![
                    with_mistake(task("fk", "c", vec![fk(2.0)]), "cosine-sign"),
                    task("ik", "b", vec![lost_in_hidden(ik(3.0))]),
                ],
            ),
            MadeUpStudent::new(
                "s4",
                vec![
                    task("fk", "a", vec![fk(4.0)]),
                    task("ik", "b", vec![ik(0.0)]),
                ],
            ),
            MadeUpStudent::without("s5", Status::Missing),
            MadeUpStudent::without("s6", Status::Excused),
        ];
        for (i, section) in ["A", "A", "B", "B", "B", ""].into_iter().enumerate() {
            section.clone_into(&mut students[i].section);
        }
        students[1].attempts = 2;
        students[2].attempts = 9;
        students[3].late_s = Some(7200);
        students[3].tasks[1].operations = 9000;
        MadeUpClass::of(&students)
    }

    fn statistics(class: &MadeUpClass) -> LabStatistics {
        of_lab(&class.index, LAB, &class.standings, &class.roster).unwrap()
    }

    #[test]
    fn points_of_the_class_are_those_of_hand() {
        let found = statistics(&class());
        assert_eq!((found.students, found.max_points), (6, 10.0));
        assert_eq!(found.at(Status::Graded), 4);
        assert_eq!(
            (found.at(Status::Missing), found.at(Status::Excused)),
            (1, 1)
        );
        assert_eq!(found.at(Status::Pending), 0);
        // 4, 5, 7, 10
        let points = found.points.unwrap();
        assert_eq!((points.mean, points.median), (6.5, 6.0));
        assert_eq!((points.lower_quartile, points.upper_quartile), (4.75, 7.75));
        assert_eq!((found.full_marks, found.by_hand), (1, 0));
        let counts: Vec<usize> = found.histogram.iter().map(|bin| bin.students).collect();
        assert_eq!(counts, [0, 0, 0, 0, 1, 1, 0, 1, 0, 1]);
        let [version] = found.versions.try_into().unwrap();
        assert_eq!(
            (version.students, version.lab_version.as_str()),
            (4, "0123456789abcdef")
        );
    }

    #[test]
    fn checks_mistakes_and_hidden_losses_are_those_of_hand() {
        let found = statistics(&class());
        let [fk, ik] = &found.checks[..] else {
            panic!("{:?}", found.checks)
        };
        assert_eq!((fk.full, fk.partial, fk.none, fk.not_judged), (2, 2, 0, 0));
        assert_eq!(fk.mean_share, Some((1.0 + 0.25 + 0.5 + 1.0) / 4.0));
        assert_eq!((ik.full, ik.partial, ik.none), (2, 1, 1));
        assert_eq!(
            ik.hidden_only,
            HiddenOnly {
                students: 1,
                points: 3.0
            }
        );
        assert_eq!(fk.hidden_only, HiddenOnly::default());
        let [mistake] = &found.mistakes[..] else {
            panic!("{:?}", found.mistakes)
        };
        assert_eq!(
            (mistake.mistake.as_str(), mistake.students),
            ("cosine-sign", 2)
        );
        // 1 and 2 of 4; 7 and 5 of 10
        assert_eq!(
            (mistake.task_share, mistake.lab_share),
            (Some(0.375), Some(0.6))
        );
    }

    #[test]
    fn groups_are_those_of_hand_and_the_excused_are_in_none() {
        let found = statistics(&class());
        let shown = |groups: &[GroupPoints]| -> Vec<(String, usize, Option<f64>)> {
            let groups = groups.iter();
            groups
                .map(|group| {
                    (
                        group.name.clone(),
                        group.students,
                        group.points.map(|spread| spread.mean),
                    )
                })
                .collect()
        };
        let named = |name: &str, students, mean| (name.to_owned(), students, mean);
        assert_eq!(
            shown(&found.sections),
            [named("A", 2, Some(8.5)), named("B", 3, Some(4.5))]
        );
        assert_eq!(
            shown(&found.attempts),
            [
                named("1 attempt", 2, Some(7.0)),
                named("2 attempts", 1, Some(7.0)),
                named("5 attempts or more", 1, Some(5.0)),
            ]
        );
        assert_eq!(
            shown(&found.lateness),
            [
                named("in time", 3, Some(22.0 / 3.0)),
                named("up to a day late", 1, Some(4.0))
            ]
        );
    }

    #[test]
    fn the_slowest_run_is_compared_with_the_class() {
        let found = statistics(&class());
        let slowest = &found.slow_runs[0];
        assert_eq!((slowest.task.as_str(), slowest.operations), ("ik", 9000));
        assert_eq!((slowest.times_median, slowest.students), (Some(9.0), 1));
        assert_eq!(found.slow_runs.len(), 8);
    }

    #[test]
    fn the_order_of_students_does_not_reach_the_numbers() {
        let mut class = class();
        let one = serde_json::to_string(&statistics(&class)).unwrap();
        class.standings.reverse();
        assert_eq!(serde_json::to_string(&statistics(&class)).unwrap(), one);
        for id in ["s1", "s2", "Name of"] {
            assert!(!one.contains(id), "{id} is in the statistics");
        }
    }

    #[test]
    fn nobody_with_a_grade_is_a_class_too() {
        let class = MadeUpClass::of(&[MadeUpStudent::without("s1", Status::Missing)]);
        let found = statistics(&class);
        assert_eq!(
            (found.students, found.points, found.max_points),
            (1, None, 0.0)
        );
        assert!(found.histogram.is_empty() && found.checks.is_empty() && found.sections.is_empty());
    }
}
