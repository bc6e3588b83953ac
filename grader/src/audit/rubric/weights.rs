//! How points are shared out: a check that decides alone, or that nobody notices.

use super::{Doubt, Rubric};
use crate::record::quantity::points;

/// With fewer checks, one may well have most of the points.
const MANY: usize = 4;
/// Who loses a check with more than this share has failed the lab.
const MOST: f64 = 0.5;
/// A check with less than this share of the points changes no grade.
const LEAST: f64 = 0.01;

/// Compares the points of each check with those of the lab.
pub(super) fn rule(rubric: &Rubric<'_>, doubts: &mut Vec<Doubt>) {
    let checks: Vec<(String, f64)> = rubric
        .lab
        .tasks
        .iter()
        .flat_map(|task| {
            let checks = task.checks().into_iter();
            checks.map(|check| (format!("{}/{}", task.name, check.name), check.points))
        })
        .collect();
    let all: f64 = checks.iter().map(|(_, points)| points).sum();
    if checks.len() < MANY {
        return;
    }
    for (of, of_check) in checks {
        let share = of_check / all;
        let said = match share {
            share if share > MOST => "more than half of all: who loses it has failed the lab",
            share if share < LEAST => "less than a hundredth of all: nobody notices it",
            _ => continue,
        };
        doubts.push(Doubt {
            rule: "points",
            of,
            what: format!("{} of {} points, {said}", points(of_check), points(all)),
            help: "is the number in `points` right? Share the points out otherwise".to_owned(),
        });
    }
}
