//! ik-branches: whether an answer has every branch that reaches its target, and no wrong one \[m\].
//!
//! Judged where two or more branches exist. A case is scored by its worst branch; a branch that is missing, or equals another but
//! for whole circles, scores nothing.

use super::{Answered, CaseError, CaseFacts, Finding, summarise};
use crate::lab::model::{Band, Function};
use crate::record::grade::Measure;
use crate::record::quantity::metres;
use kinemark_sim::robot::Robot;

/// Judges the check.
pub fn judge(cases: &[CaseFacts<'_>], band: Band, function: &Function) -> Finding {
    let mut judged = Vec::new();
    let mut failed = Vec::new();
    let mut sum = 0.0;
    for facts in cases {
        let CaseError::Reach {
            branches_m,
            expected,
        } = &facts.error
        else {
            continue;
        };
        if *expected < 2 {
            continue;
        }
        judged.push(facts);
        let distinct = match &facts.answer {
            Answered::Branches(branches) => count_distinct(&facts.robot, branches),
            Answered::Position(_)
            | Answered::Matrix(_)
            | Answered::Entries(_)
            | Answered::Invalid(_)
            | Answered::Stopped => 0,
        };
        let complete = distinct >= *expected as usize;
        let worst = if complete {
            branches_m.last().copied().unwrap_or(f64::INFINITY)
        } else {
            f64::INFINITY
        };
        sum += band.score(worst);
        if band.score(worst) < 1.0 {
            let message = if complete {
                format!(
                    "{}: one of the branches ends {} from the target",
                    facts.told(),
                    metres(worst)
                )
            } else {
                format!("{}: {distinct} of {expected} branches", facts.told())
            };
            failed.push((facts, worst, message));
        }
    }
    let score = if judged.is_empty() {
        0.0
    } else {
        sum / judged.len() as f64
    };
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "targets with every branch".to_owned(),
            value: Some(score),
            unit: String::new(),
            full: 1.0,
            zero: 0.0,
        }),
        evidence: summarise(function, failed, &judged, band.full, "m"),
        next_step: "The arm can bend either way: return both, `[[q1, q2], [q1, q2]]`.".to_owned(),
        curve: None,
    }
}

/// How many of the branches differ by more than whole circles and rounding.
pub(crate) fn count_distinct(robot: &Robot, branches: &[Vec<f64>]) -> usize {
    let mut distinct: Vec<&Vec<f64>> = Vec::new();
    for branch in branches {
        if !distinct
            .iter()
            .any(|other| same_branch(robot, branch, other))
        {
            distinct.push(branch);
        }
    }
    distinct.len()
}

/// Whether two answers are one configuration: angles equal but for whole circles, slides equal, to a fiftieth and a thousandth.
pub(crate) fn same_branch(robot: &Robot, a: &[f64], b: &[f64]) -> bool {
    // what moves the hand by less than a band is no other branch; two branches inside the boundary differ by far more
    let (near_rad, near_m) = (0.02, 1e-3);
    robot
        .moving_joints()
        .zip(a.iter().zip(b))
        .all(|(joint, (a, b))| {
            let circle = 2.0 * std::f64::consts::PI;
            if joint.kind.turns() {
                let gap = (a - b).abs() % circle;
                gap.min(circle - gap) <= near_rad
            } else {
                (a - b).abs() <= near_m
            }
        })
}
