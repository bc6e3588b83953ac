//! joint-reached: a joint stands at a position for the last part of the run.
//!
//! Measured is the greatest distance from the position over the last `hold_s` \[rad or m\]; the band makes the score of it.

use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::{seconds, trimmed};

/// Judges the check.
pub fn judge(
    facts: &MotionFacts<'_>,
    joint: usize,
    position: f64,
    hold_ticks: u64,
    band: Band,
    check: &str,
) -> Finding {
    let trace = facts.trace;
    let (name, unit) = (facts.joint_name(joint), facts.units(joint).position());
    let last = trace.len().saturating_sub(1);
    let first = last.saturating_sub(hold_ticks as usize);
    let error_at = |tick: usize| (trace.q.at(tick)[joint] - position).abs();
    let worst = (first..=last)
        .max_by(|a, b| error_at(*a).total_cmp(&error_at(*b)))
        .unwrap_or(last);
    let value = error_at(worst);
    let score = band.score(value);
    let mut evidence = Vec::new();
    if score < 1.0 {
        let at_end = trace.q.at(last)[joint];
        let started = trace.q.at(0)[joint];
        let is_to_move = (position - started).abs() > 1e-3;
        let message = if is_to_move && (at_end - started).abs() < 1e-3 {
            format!(
                "joint `{name}` did not move: it stands at {} {unit}, {} {unit} was asked for",
                trimmed(at_end, 4),
                trimmed(position, 4)
            )
        } else {
            format!(
                "joint `{name}` is {} {unit} from {} {unit} at {}, within the last {} that count",
                trimmed(value, 4),
                trimmed(position, 4),
                seconds(facts.time_s(worst)),
                seconds(facts.time_s(last - first)),
            )
        };
        evidence.push(Evidence {
            value: Some(trace.q.at(worst)[joint]),
            limit: Some(position),
            unit: unit.to_owned(),
            ..facts.evidence(message, format!("q[{joint}]"), worst)
        });
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: format!(
                "distance of joint `{name}` from {} {unit}",
                trimmed(position, 4)
            ),
            value: Some(value),
            unit: unit.to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step: format!(
            "Return {} for joint `{name}` from `control`, at every call.",
            trimmed(position, 4)
        ),
        curve: Some(Curve {
            check: check.to_owned(),
            title: format!("distance of joint `{name}` from its target"),
            unit: unit.to_owned(),
            t_s: (0..trace.len()).map(|tick| facts.time_s(tick)).collect(),
            values: (0..trace.len()).map(error_at).collect(),
            full: Some(band.full),
            zero: Some(band.zero),
            marks: vec![(facts.time_s(first), "judged from here".to_owned())],
            step: None,
        }),
    }
}
