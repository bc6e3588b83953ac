//! ik-reach: how near the best branch of each answer comes to its target, by our forward kinematics \[m\].
//!
//! Each reachable case is scored by the band; the check's score is their mean. Turns by whole circles and the order of branches
//! make no difference.

use super::{Answered, CaseError, CaseFacts, Finding, summarise};
use crate::lab::model::{Band, Function};
use crate::record::grade::Measure;
use crate::record::quantity::metres;

/// Judges the check.
pub fn judge(cases: &[CaseFacts<'_>], band: Band, function: &Function) -> Finding {
    let mut reachable = Vec::new();
    let mut failed = Vec::new();
    let mut sum = 0.0;
    for facts in cases {
        let CaseError::Reach { branches_m, .. } = &facts.error else {
            continue;
        };
        reachable.push(facts);
        let nearest = branches_m.first().copied().unwrap_or(f64::INFINITY);
        sum += band.score(nearest);
        if band.score(nearest) < 1.0 {
            let message = match &facts.answer {
                Answered::Invalid(what) => format!("{}: {what}", facts.told()),
                Answered::Stopped => format!("{}: no answer", facts.told()),
                Answered::Branches(branches) if branches.is_empty() => {
                    format!("{}: said to be out of reach, but it is not", facts.told())
                }
                Answered::Branches(_)
                | Answered::Position(_)
                | Answered::Matrix(_)
                | Answered::Entries(_) => format!(
                    "{}: the arm ends {} from the target",
                    facts.told(),
                    metres(nearest)
                ),
            };
            failed.push((facts, nearest, message));
        }
    }
    let score = if reachable.is_empty() {
        0.0
    } else {
        sum / reachable.len() as f64
    };
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "targets reached".to_owned(),
            value: Some(score),
            unit: String::new(),
            full: 1.0,
            zero: 0.0,
        }),
        evidence: summarise(function, failed, &reachable, band.full, "m"),
        next_step:
            "Put your angles through your own forward kinematics: it must give the target back."
                .to_owned(),
        curve: None,
    }
}
