//! joint-limits: how far a joint leaves its position limits \[rad or m\].

use super::{Finding, MotionFacts};
use crate::lab::joint_units::JointUnits;
use crate::lab::model::Band;
use crate::record::grade::{Evidence, Measure};
use crate::record::quantity::{seconds, trimmed};

/// Judges the check. Inside the limits the value is negative: the room that was left.
pub fn judge(facts: &MotionFacts<'_>, band: Band) -> Finding {
    let trace = facts.trace;
    let mut worst = (f64::NEG_INFINITY, 0, 0); // value, tick, joint
    let mut breach: Option<(usize, usize)> = None;
    for (index, joint) in facts.robot.moving_joints().enumerate() {
        let lower = joint.limits.lower.unwrap_or(f64::NEG_INFINITY);
        let upper = joint.limits.upper.unwrap_or(f64::INFINITY);
        for (tick, q) in trace.q.component(index).enumerate() {
            let beyond = (q - upper).max(lower - q);
            if beyond > worst.0 {
                worst = (beyond, tick, index);
            }
            if beyond > band.full && breach.is_none_or(|(first, _)| tick < first) {
                breach = Some((tick, index));
            }
        }
    }
    let (value, tick, joint) = worst;
    let unit = facts.units(joint).position();
    let score = band.score(value);
    let mut evidence = Vec::new();
    if let (Some((first, first_joint)), true) = (breach, score < 1.0) {
        let message = format!(
            "joint `{}` leaves its limits at {}; joint `{}` is {} {unit} beyond at its worst, at {}",
            facts.joint_name(first_joint),
            seconds(facts.time_s(first)),
            facts.joint_name(joint),
            trimmed(value, 4),
            seconds(facts.time_s(tick)),
        );
        evidence.push(Evidence {
            value: Some(trace.q.at(first)[first_joint]),
            limit: Some(band.full),
            unit: facts.units(first_joint).position().to_owned(),
            ..facts.evidence(message, format!("q[{first_joint}]"), first)
        });
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "way beyond a joint's limits (negative inside)".to_owned(),
            value: value.is_finite().then_some(value),
            unit: unit.to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step: match facts.units(joint) {
            JointUnits::Sliding => "Take positions between the limits.",
            JointUnits::Turning | JointUnits::Mixed => {
                "Take angles between the limits: `wrap_pi` brings an angle into (-pi, pi]."
            }
        }
        .to_owned(),
        curve: None,
    }
}
