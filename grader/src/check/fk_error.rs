//! fk-error: the mean distance of the answered positions from the true ones \[m\]. One answer that is no position makes it
//! infinite.

use super::{Answered, CaseError, CaseFacts, Finding, summarise};
use crate::lab::model::{Band, Function};
use crate::record::grade::Measure;
use crate::record::quantity::metres;

/// Judges the check.
pub fn judge(cases: &[CaseFacts<'_>], band: Band, function: &Function) -> Finding {
    let error = |facts: &CaseFacts<'_>| match facts.error {
        CaseError::Position(error_m) => error_m,
        CaseError::Reach { .. }
        | CaseError::Unreachable { .. }
        | CaseError::Jacobian { .. }
        | CaseError::Entries(_) => f64::INFINITY,
    };
    let mean = cases.iter().map(error).sum::<f64>() / cases.len() as f64;
    let score = band.score(mean);
    let mut failed = Vec::new();
    if score < 1.0 {
        for facts in cases {
            let error_m = error(facts);
            if error_m > band.full {
                let message = match &facts.answer {
                    Answered::Invalid(what) => format!("{}: {what}", facts.told()),
                    Answered::Stopped => format!("{}: no answer", facts.told()),
                    Answered::Position(_)
                    | Answered::Branches(_)
                    | Answered::Matrix(_)
                    | Answered::Entries(_) => {
                        format!(
                            "{}: {} from the true position",
                            facts.told(),
                            metres(error_m)
                        )
                    }
                };
                failed.push((facts, error_m, message));
            }
        }
    }
    let all: Vec<&CaseFacts<'_>> = cases.iter().collect();
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "mean position error".to_owned(),
            value: mean.is_finite().then_some(mean),
            unit: "m".to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence: summarise(function, failed, &all, band.full, "m"),
        next_step: "Work one of these cases by hand, and compare.".to_owned(),
        curve: None,
    }
}
