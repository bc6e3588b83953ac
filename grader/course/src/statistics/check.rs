//! What a check shows of a class: how many earned what, the values over its band, and whether it goes with the rest of the points.

use std::collections::BTreeMap;

use kinemark_grader::record::grade::Outcome;
use kinemark_grader::record::quantity::{sum_of_points, with_unit};
use serde::Serialize;

use super::spread::{correlation, mean};
use crate::lab_rows::{CheckRow, MeasureRow, RecordRow, share};

/// A value is near an edge of the band within this share of the band's width.
const NEAR: f64 = 0.05;
/// Where fewer than this earn another share than the most frequent one, a correlation says nothing.
const FEWEST_DIFFERENT: usize = 5;
/// A pile is at least so many values ...
const FEWEST_IN_PILE: usize = 5;
/// ... and at least this share of all: three times what evenly spread values would put there.
const SHARE_OF_PILE: f64 = 0.15;

/// A check over the class.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckStatistics {
    /// The task's name.
    pub task: String,
    /// The task's title.
    pub task_title: String,
    /// The check's name.
    pub name: String,
    /// The check's title.
    pub title: String,
    /// Its points.
    pub max_points: f64,
    /// Graded students with this check.
    pub students: usize,
    /// Those of whom it was judged.
    pub judged: usize,
    /// Those with all of its points.
    pub full: usize,
    /// Those with some.
    pub partial: usize,
    /// Those who were judged and earned none.
    pub none: usize,
    /// Those of whom it was not judged, which earns none.
    pub not_judged: usize,
    /// The mean share of its points, from 0 to 1, over all students with it.
    pub mean_share: Option<f64>,
    /// Correlation of the share earned here with the points earned in the rest of the lab, over those of whom it was judged: near 0
    /// it says nothing about the rest, below 0 it goes against it. Absent below ten students, or where all but a few earned the same.
    pub discrimination: Option<f64>,
    /// The values, where it measures something.
    pub values: Option<CheckValues>,
    /// What was lost in hidden cases and runs alone.
    pub hidden_only: HiddenOnly,
}

/// Points lost where everything visible was full.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct HiddenOnly {
    /// Of how many students.
    pub students: usize,
    /// How many points, of all together.
    pub points: f64,
}

/// A band: what earns all points and what earns none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Band {
    /// The value that earns all.
    pub full: f64,
    /// The value that earns none.
    pub zero: f64,
}

/// Measured values over the band.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckValues {
    /// What was measured.
    pub quantity: String,
    /// Unit of values and band; empty for a ratio.
    pub unit: String,
    /// The band that most were judged by; those of variants may differ.
    pub band: Band,
    /// How many different bands there are.
    pub bands: usize,
    /// The values, from the least to the greatest.
    pub values: Vec<f64>,
    /// Where each value lies in its own band, from the least to the greatest: 0 earns all points, 1 none. Empty where the band has no
    /// width.
    pub positions: Vec<f64>,
    /// Values that were not finite.
    pub not_finite: usize,
    /// Piles at the edges of the band.
    pub piles: Vec<Pile>,
}

/// Many values at one edge of a band.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Pile {
    /// How many values are near the edge, but not on it.
    pub values: usize,
    /// What it says, in words.
    pub says: String,
}

/// A record with one of its checks.
struct Judged<'a> {
    record: &'a RecordRow,
    check: &'a CheckRow,
}

/// The checks of the class, in the lab's order; `graded` has the record of each graded student.
pub(super) fn checks(graded: &[&RecordRow]) -> Vec<CheckStatistics> {
    // the least place it has in any version of the lab
    let mut places: BTreeMap<(&str, &str), (usize, usize)> = BTreeMap::new();
    for record in graded {
        for (i, task) in record.tasks.iter().enumerate() {
            for (j, check) in task.checks.iter().enumerate() {
                let place = places.entry((&task.name, &check.name)).or_insert((i, j));
                *place = (*place).min((i, j));
            }
        }
    }
    let by_place = places.into_iter().map(|(names, place)| (place, names));
    let mut order: Vec<_> = by_place.collect();
    order.sort_unstable();
    let names = order.into_iter().map(|(_, names)| names);
    names
        .filter_map(|(task, name)| statistics(graded, task, name))
        .collect()
}

fn statistics(graded: &[&RecordRow], task: &str, name: &str) -> Option<CheckStatistics> {
    let of_record = |record: &&'_ RecordRow| {
        let task = record.tasks.iter().position(|known| known.name == task)?;
        let checks = &record.tasks[task].checks;
        Some((task, checks.iter().position(|known| known.name == name)?))
    };
    let found = graded.iter().filter_map(|record| {
        let (task, check) = of_record(record)?;
        let task = &record.tasks[task];
        Some((
            task,
            Judged {
                record,
                check: &task.checks[check],
            },
        ))
    });
    let (tasks, all): (Vec<_>, Vec<Judged<'_>>) = found.unzip();
    let first = all.first()?.check;
    let count = |outcome: Outcome| {
        all.iter()
            .filter(|one| one.check.outcome == outcome)
            .count()
    };
    let not_judged = count(Outcome::NotJudged);
    let shares: Vec<f64> = all
        .iter()
        .filter_map(|one| share(one.check.points, one.check.max_points))
        .collect();
    let measures: Vec<&MeasureRow> = all
        .iter()
        .filter(|one| one.check.outcome != Outcome::NotJudged)
        .filter_map(|one| one.check.measure.as_ref())
        .collect();
    Some(CheckStatistics {
        task: task.to_owned(),
        task_title: tasks.first()?.title.clone(),
        name: name.to_owned(),
        title: first.title.clone(),
        max_points: first.max_points,
        students: all.len(),
        judged: all.len() - not_judged,
        full: count(Outcome::Full),
        partial: count(Outcome::Partial),
        none: count(Outcome::None),
        not_judged,
        mean_share: mean(&shares),
        discrimination: discrimination(&all),
        values: values(&measures),
        hidden_only: hidden_only(&all),
    })
}

fn discrimination(all: &[Judged<'_>]) -> Option<f64> {
    let judged = all
        .iter()
        .filter(|one| one.check.outcome != Outcome::NotJudged);
    let pairs: Vec<(f64, f64)> = judged
        .filter_map(|Judged { record, check }| {
            let here = share(check.points, check.max_points)?;
            let rest = share(
                record.points - check.points,
                record.max_points - check.max_points,
            )?;
            // hundredths: equal points are equal, however they were added up
            Some((here, (rest * 1e6).round() / 1e6))
        })
        .collect();
    let mut counts: BTreeMap<u64, usize> = BTreeMap::new();
    for (here, _) in &pairs {
        *counts.entry(here.to_bits()).or_default() += 1;
    }
    let same = counts.values().max()?;
    (pairs.len() - same >= FEWEST_DIFFERENT)
        .then(|| correlation(&pairs))
        .flatten()
}

fn hidden_only(all: &[Judged<'_>]) -> HiddenOnly {
    let lost = |check: &CheckRow| matches!(check.outcome, Outcome::Partial | Outcome::None);
    let only: Vec<&CheckRow> = all
        .iter()
        .map(|one| one.check)
        .filter(|check| check.lost_in_hidden_only && lost(check))
        .collect();
    HiddenOnly {
        students: only.len(),
        points: sum_of_points(only.iter().map(|check| check.max_points - check.points)),
    }
}

fn values(measures: &[&MeasureRow]) -> Option<CheckValues> {
    let mut bands: BTreeMap<(u64, u64), (usize, &MeasureRow)> = BTreeMap::new();
    for measure in measures {
        let band = (measure.full.to_bits(), measure.zero.to_bits());
        bands.entry(band).or_insert((0, measure)).0 += 1;
    }
    let (_, typical) = bands.values().max_by_key(|(count, _)| *count)?;
    let band = Band {
        full: typical.full,
        zero: typical.zero,
    };
    let mut values = Vec::new();
    let mut positions = Vec::new();
    let mut near = [0, 0];
    let mut lost_narrowly = 0;
    for measure in measures {
        let Some(value) = measure.value.filter(|value| value.is_finite()) else {
            continue;
        };
        values.push(value);
        let own = Band {
            full: measure.full,
            zero: measure.zero,
        };
        if let Some(position) = own.position(value) {
            positions.push(position);
            near[0] += usize::from(own.is_near_full(value));
            lost_narrowly += usize::from(own.is_near_full(value) && position > 0.0);
            near[1] += usize::from(own.is_near_zero(value));
        }
    }
    values.sort_by(f64::total_cmp);
    positions.sort_by(f64::total_cmp);
    // where nobody loses a point by it, it is as good as can be: 99 % of 98 % is no pile
    if lost_narrowly < FEWEST_IN_PILE {
        near[0] = 0;
    }
    let edges = [
        (near[0], band.full, "all points"),
        (near[1], band.zero, "no points"),
    ];
    let piles = edges.into_iter().filter_map(|(near, edge, earns)| {
        let edge = with_unit(edge, &typical.unit);
        pile(near, values.len(), &format!("{edge}, which earns {earns}"))
    });
    Some(CheckValues {
        quantity: typical.quantity.clone(),
        unit: typical.unit.clone(),
        band,
        bands: bands.len(),
        not_finite: measures.len() - values.len(),
        piles: piles.collect(),
        values,
        positions,
    })
}

impl Band {
    /// Where a value lies: 0 at full, 1 at zero; none in a band without width.
    fn position(self, value: f64) -> Option<f64> {
        let position = (value - self.full) / (self.zero - self.full);
        position.is_finite().then_some(position)
    }

    /// Whether a value lies by 5 % of the band's width at the edge of full points, and not on it: what is as good as can be, such as
    /// an error of 0, is often the edge itself. Where it earns all points it must come as near to the edge's own size, too: an
    /// error of 1e-16 has not just met a limit of 1e-4.
    fn is_near_full(self, value: f64) -> bool {
        let (width, beyond) = (self.zero - self.full, value - self.full);
        if beyond * width > 0.0 {
            beyond.abs() <= NEAR * width.abs()
        } else {
            beyond != 0.0 && beyond.abs() <= NEAR * width.abs().min(self.full.abs())
        }
    }

    /// The same at the edge of no points.
    fn is_near_zero(self, value: f64) -> bool {
        let turned = Self {
            full: self.zero,
            zero: self.full,
        };
        turned.is_near_full(value)
    }
}

fn pile(near: usize, of: usize, edge: &str) -> Option<Pile> {
    let share = near as f64 / of as f64;
    (near >= FEWEST_IN_PILE && share >= SHARE_OF_PILE).then(|| Pile {
        values: near,
        says: format!(
            "{near} of {of} values are close to {edge} (within 5 % of the band's width). A pile at the edge says that the band is wrong."
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab_rows::TaskRow;
    use kinemark_grader::record::verdict::Verdict;

    fn check(name: &str, outcome: Outcome, points: f64, value: Option<f64>) -> CheckRow {
        CheckRow {
            name: name.to_owned(),
            title: format!("the {name}"),
            outcome,
            points,
            max_points: 4.0,
            measure: Some(MeasureRow {
                quantity: "error".to_owned(),
                unit: "m".to_owned(),
                full: 0.01,
                zero: 0.05,
                value,
            }),
            lost_in_hidden_only: false,
        }
    }

    fn record(checks: Vec<CheckRow>) -> RecordRow {
        let sum = |of: fn(&CheckRow) -> f64| checks.iter().map(of).sum::<f64>();
        let (points, max_points) = (sum(|check| check.points), sum(|check| check.max_points));
        RecordRow {
            submission: "u".to_owned(),
            engine: "e".to_owned(),
            lab_version: "v".to_owned(),
            variant_of: None,
            points,
            max_points,
            tasks: vec![TaskRow {
                name: "fk".to_owned(),
                title: "Forward".to_owned(),
                verdict: Verdict::Missed,
                points,
                max_points,
                operations: 1,
                digest: "d".to_owned(),
                checks,
                mistakes: Vec::new(),
            }],
        }
    }

    #[test]
    fn outcomes_are_counted_and_what_is_not_judged_earns_nothing() {
        let mut hidden = check("a", Outcome::Partial, 2.5, Some(0.02));
        hidden.lost_in_hidden_only = true;
        let records = [
            record(vec![check("a", Outcome::Full, 4.0, Some(0.0))]),
            record(vec![hidden]),
            record(vec![check("a", Outcome::None, 0.0, None)]),
            record(vec![check("a", Outcome::NotJudged, 0.0, Some(0.03))]),
        ];
        let graded: Vec<&RecordRow> = records.iter().collect();
        let [a] = checks(&graded).try_into().unwrap();
        assert_eq!((a.students, a.judged), (4, 3));
        assert_eq!([a.full, a.partial, a.none, a.not_judged], [1; 4]);
        assert_eq!(a.mean_share, Some((1.0 + 0.625) / 4.0));
        assert_eq!(
            a.hidden_only,
            HiddenOnly {
                students: 1,
                points: 1.5
            }
        );
        assert_eq!(a.discrimination, None, "four students");
        let values = a.values.unwrap();
        assert_eq!(values.values, [0.0, 0.02]);
        assert_eq!(values.positions, [-0.25, 0.25]);
        assert_eq!((values.not_finite, values.bands), (1, 1));
    }

    #[test]
    fn a_check_that_goes_with_the_rest_discriminates() {
        let good = |i: usize| {
            if i < 6 {
                (Outcome::Full, 4.0)
            } else {
                (Outcome::None, 0.0)
            }
        };
        let records: Vec<RecordRow> = (0..12)
            .map(|i| {
                let (outcome, points) = good(i);
                let (turned, less) = good(11 - i);
                record(vec![
                    check("with", outcome, points, None),
                    check("rest", outcome, points, None),
                    check("more", outcome, points, None),
                    check("against", turned, less, None),
                    check("same", Outcome::Full, 4.0, None),
                ])
            })
            .collect();
        let graded: Vec<&RecordRow> = records.iter().collect();
        let found: Vec<Option<f64>> = checks(&graded)
            .iter()
            .map(|check| check.discrimination)
            .collect();
        assert!((found[0].unwrap() - 1.0).abs() < 1e-9, "{found:?}");
        assert!((found[3].unwrap() + 1.0).abs() < 1e-9, "{found:?}");
        assert_eq!(found[4], None, "everybody has it");
        assert_eq!(
            checks(&graded[..9])[0].discrimination,
            None,
            "nine students"
        );
    }

    #[test]
    fn what_all_but_a_few_earn_discriminates_nobody() {
        let of = |losers: usize| {
            let records: Vec<RecordRow> = (0..40)
                .map(|i| {
                    let (outcome, points) = match i {
                        i if i < losers => (Outcome::None, 0.0),
                        _ => (Outcome::Full, 4.0),
                    };
                    let rest = f64::from(u8::from(i % 2 == 0));
                    record(vec![
                        check("few", outcome, points, None),
                        check("rest", Outcome::Partial, rest, None),
                    ])
                })
                .collect();
            let graded: Vec<&RecordRow> = records.iter().collect();
            checks(&graded)[0].discrimination
        };
        assert_eq!(of(4), None);
        assert!(of(5).is_some());
    }

    #[test]
    fn values_near_an_edge_are_a_pile_and_perfect_ones_are_not() {
        let band = Band {
            full: 1e-4,
            zero: 5e-3,
        };
        assert!(band.is_near_full(1.1e-4) && band.is_near_full(0.97e-4));
        assert!(!band.is_near_full(1e-16) && !band.is_near_full(1e-4) && !band.is_near_full(5e-4));
        assert!(band.is_near_zero(4.9e-3) && band.is_near_zero(5.1e-3) && !band.is_near_zero(5e-3));
        // more is better: 1 is all there can be
        let up = Band {
            full: 1.0,
            zero: 0.5,
        };
        assert!(up.is_near_full(0.98) && !up.is_near_full(1.0) && !up.is_near_full(0.9));
        let records: Vec<RecordRow> = (0..20)
            .map(|i| {
                let value = if i < 6 { 0.0105 } else { 0.0 };
                record(vec![check("a", Outcome::Partial, 3.9, Some(value))])
            })
            .collect();
        let graded: Vec<&RecordRow> = records.iter().collect();
        let [a] = checks(&graded).try_into().unwrap();
        let [pile] = a.values.unwrap().piles.try_into().unwrap();
        assert_eq!(pile.values, 6);
        assert!(pile.says.starts_with(
            "6 of 20 values are close to 10.0 mm, which earns all points (within 5 % of the band's width)."
        ));
        assert!(
            pile.says
                .contains("A pile at the edge says that the band is wrong")
        );
        // nobody loses a point by it
        let inside: Vec<RecordRow> = (0..20)
            .map(|_| record(vec![check("a", Outcome::Full, 4.0, Some(0.0099))]))
            .collect();
        let inside: Vec<&RecordRow> = inside.iter().collect();
        let [a] = checks(&inside).try_into().unwrap();
        assert!(a.values.unwrap().piles.is_empty());
    }

    #[test]
    fn checks_are_in_the_order_of_the_lab() {
        let records = [
            record(vec![check("z", Outcome::Full, 4.0, None)]),
            record(vec![
                check("z", Outcome::Full, 4.0, None),
                check("a", Outcome::Full, 4.0, None),
            ]),
        ];
        let graded: Vec<&RecordRow> = records.iter().collect();
        let found = checks(&graded);
        let names: Vec<&str> = found.iter().map(|check| check.name.as_str()).collect();
        assert_eq!(names, ["z", "a"]);
        assert_eq!((found[0].students, found[1].students), (2, 1));
    }
}
