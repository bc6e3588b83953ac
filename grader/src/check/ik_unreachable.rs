//! ik-unreachable: targets out of reach are answered with an empty list.

use super::{Answered, CaseError, CaseFacts, Finding, summarise};
use crate::lab::model::Function;
use crate::record::grade::Measure;

/// Judges the check.
pub fn judge(cases: &[CaseFacts<'_>], function: &Function) -> Finding {
    let mut judged = Vec::new();
    let mut failed = Vec::new();
    let mut good = 0.0;
    for facts in cases {
        let CaseError::Unreachable { said_so } = facts.error else {
            continue;
        };
        judged.push(facts);
        if said_so {
            good += 1.0;
            continue;
        }
        let message = match &facts.answer {
            Answered::Invalid(what) => format!("{}: {what}", facts.told()),
            Answered::Stopped => format!("{}: no answer", facts.told()),
            Answered::Branches(_)
            | Answered::Position(_)
            | Answered::Matrix(_)
            | Answered::Entries(_) => {
                format!(
                    "{}: angles for a target no arm of these lengths reaches",
                    facts.told()
                )
            }
        };
        failed.push((facts, 1.0, message));
    }
    let score = if judged.is_empty() {
        0.0
    } else {
        good / judged.len() as f64
    };
    let mut evidence = summarise(function, failed, &judged, 0.0, "");
    for piece in &mut evidence {
        (piece.value, piece.limit) = (None, None);
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "targets out of reach that are told so".to_owned(),
            value: Some(score),
            unit: String::new(),
            full: 1.0,
            zero: 0.0,
        }),
        evidence,
        next_step: "Compare the target's distance from the shoulder with the lengths of the links, and return `[]` where it is too far or too near.".to_owned(),
        curve: None,
    }
}
