//! ik-branches: whether an answer has every branch that reaches its target, and no wrong one \[m\].
//!
//! Judged where two or more branches exist. A case is scored by its worst branch; a branch that is missing, or equals another but
//! for whole circles, scores nothing.

use super::{Answered, CaseError, CaseFacts, Finding, summarise};
use crate::attempt::measure::count_distinct;
use crate::lab::model::{Band, Function};
use crate::record::grade::Measure;
use crate::record::quantity::metres;

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
