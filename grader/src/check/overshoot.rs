//! overshoot: how far the TCP runs past a goal along the way to it, as a fraction of that way.
//!
//! The way to a goal is the straight line from where the TCP was when the move to it began. Past the goal means further along that
//! line; being beside it does not count, so that every road is right.

use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::{metres, trimmed};

/// Judges the check.
pub fn judge(facts: &MotionFacts<'_>, band: Band, check: &str) -> Finding {
    let trace = facts.trace;
    let mut values = vec![0.0; trace.len()];
    let mut worst: Option<(usize, usize, f64, f64)> = None; // goal, tick, fraction, distance
    let mut start = 0;
    for (i, (goal, stay)) in facts.motion.goals.iter().zip(&facts.stays).enumerate() {
        let from = trace.tcp_position(start);
        let way = goal.position_m - from;
        let length = way.norm();
        if length > 1e-6 {
            let along = way / length;
            for (tick, value) in values
                .iter_mut()
                .enumerate()
                .take(stay.last + 1)
                .skip(start)
            {
                let past = (trace.tcp_position(tick) - goal.position_m).dot(&along);
                *value = past.max(0.0) / length;
                if worst.is_none_or(|(.., fraction, _)| *value > fraction) {
                    worst = Some((i, tick, *value, past.max(0.0)));
                }
            }
        }
        start = stay.last;
    }
    let value = worst.map_or(f64::INFINITY, |(.., fraction, _)| fraction);
    let score = band.score(value);
    let mut evidence = Vec::new();
    if let Some((goal, tick, fraction, past_m)) = worst
        && score < 1.0
    {
        let message = format!(
            "on the way to goal {} the TCP runs {} past it, {} % of the way",
            goal + 1,
            metres(past_m),
            trimmed(fraction * 100.0, 1)
        );
        evidence.push(Evidence {
            value: Some(fraction),
            limit: Some(band.full),
            ..facts.evidence(message, "tcp".to_owned(), tick)
        });
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "way past a goal, as a fraction of the way to it".to_owned(),
            value: value.is_finite().then_some(value),
            unit: String::new(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step:
            "Lead the joints to the goal with a smooth profile (`quintic`) instead of a jump."
                .to_owned(),
        curve: Some(Curve {
            check: check.to_owned(),
            title: "way past the goal".to_owned(),
            unit: String::new(),
            t_s: (0..trace.len()).map(|tick| facts.time_s(tick)).collect(),
            values,
            full: Some(band.full),
            zero: Some(band.zero),
            marks: Vec::new(),
            step: None,
        }),
    }
}
