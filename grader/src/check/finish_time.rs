//! finish-time: when the last dwell was over \[s\]; never, where some goal earned nothing.

use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::record::grade::{Evidence, Measure};
use crate::record::quantity::seconds;

/// Judges the check.
pub fn judge(facts: &MotionFacts<'_>, band: Band, pose: Band) -> Finding {
    let missed = facts
        .stays
        .iter()
        .position(|stay| pose.score(stay.settled_m) <= 0.0);
    let last = facts.stays.last().filter(|_| missed.is_none());
    let finish = last.map(|stay| (stay.last, facts.time_s(stay.last)));
    let value = finish.map_or(f64::INFINITY, |(_, time_s)| time_s);
    let score = band.score(value);
    let mut evidence = Vec::new();
    if let Some((tick, time_s)) = finish
        && score < 1.0
    {
        let message = format!(
            "the last dwell is over at {}, {} earns everything",
            seconds(time_s),
            seconds(band.full)
        );
        evidence.push(Evidence {
            value: Some(time_s),
            limit: Some(band.full),
            unit: "s".to_owned(),
            ..facts.evidence(message, "tcp".to_owned(), tick)
        });
    }
    if let Some(goal) = missed {
        let message = format!(
            "goal {} was never held, so there is no time to judge",
            goal + 1
        );
        let last = facts.trace.len().saturating_sub(1);
        evidence.push(facts.evidence(message, "tcp".to_owned(), last));
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "end of the last dwell".to_owned(),
            value: finish.map(|(_, time_s)| time_s),
            unit: "s".to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step: "Start the next move as soon as the dwell is over.".to_owned(),
        curve: None,
    }
}
