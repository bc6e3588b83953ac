//! effort-saturation: for how long some joint's effort is at its limit \[s\].

use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::{seconds, trimmed};

/// Judges the check.
pub fn judge(facts: &MotionFacts<'_>, band: Band, check: &str) -> Finding {
    let trace = facts.trace;
    let limits: Vec<f64> = facts
        .motion
        .servo
        .gains
        .iter()
        .map(|g| g.effort_limit)
        .collect();
    let at_limit = |tick: usize| {
        let efforts = trace.effort.at(tick).iter().zip(&limits);
        efforts
            .clone()
            .position(|(effort, limit)| effort.abs() >= *limit)
    };
    // the effort of the last row is never applied
    let applied = trace.len().saturating_sub(1);
    let mut count = 0;
    let mut values = Vec::with_capacity(trace.len());
    let mut first = None;
    let mut breach = None;
    for tick in 0..trace.len() {
        if tick < applied
            && let Some(joint) = at_limit(tick)
        {
            count += 1;
            first.get_or_insert((tick, joint));
            if breach.is_none() && facts.time_s(count) > band.full {
                breach = Some((tick, joint));
            }
        }
        values.push(facts.time_s(count));
    }
    let value = facts.time_s(count);
    let score = band.score(value);
    let mut evidence = Vec::new();
    if let (Some((tick, joint)), true) = (breach, score < 1.0) {
        let started = first.map_or(tick, |(tick, _)| tick);
        let message = format!(
            "efforts are at their limit for {} in all, first at {}; the {} allowed are used up at {} by joint `{}` at {} {}",
            seconds(value),
            seconds(facts.time_s(started)),
            seconds(band.full),
            seconds(facts.time_s(tick)),
            facts.joint_name(joint),
            trimmed(trace.effort.at(tick)[joint], 3),
            facts.units(joint).effort(),
        );
        evidence.push(Evidence {
            value: Some(value),
            limit: Some(band.full),
            unit: "s".to_owned(),
            ..facts.evidence(message, format!("effort[{joint}]"), tick)
        });
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "time with an effort at its limit".to_owned(),
            value: Some(value),
            unit: "s".to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step: "Ask for smaller steps: spread the move over more time.".to_owned(),
        curve: Some(Curve {
            check: check.to_owned(),
            title: "time with an effort at its limit".to_owned(),
            unit: "s".to_owned(),
            t_s: (0..trace.len()).map(|tick| facts.time_s(tick)).collect(),
            values,
            full: Some(band.full),
            zero: Some(band.zero),
            marks: Vec::new(),
            step: None,
        }),
    }
}
