//! tcp-speed: how fast the TCP is when the arm first touches a body, or at its fastest \[m/s\].
//!
//! The speed at tick `k` is `|p[k] - p[k-1]| / h`, the mean over the physics step that ends there; at tick 0 the arm is at rest. At
//! a touch it is that of the last step before the one in which the two first pressed, so the blow itself does not count. An arm that
//! never touches has no such speed and earns nothing.

use kinemark_sim::trace::Trace;

use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::lab::watched::{SpeedAt, TouchingParty};
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::{seconds, trimmed};

/// Speed of the TCP at every tick \[m/s\].
fn speeds_m_s(trace: &Trace) -> Vec<f64> {
    let speed = |tick: usize| match tick.checked_sub(1) {
        None => 0.0,
        Some(before) => {
            (trace.tcp_position(tick) - trace.tcp_position(before)).norm() / trace.step_s
        }
    };
    (0..trace.len()).map(speed).collect()
}

/// The tick of the greatest speed; one that is no number is the greatest of all.
fn fastest(speeds_m_s: &[f64]) -> Option<usize> {
    (0..speeds_m_s.len()).max_by(|a, b| {
        let speed = |tick: usize| speeds_m_s[tick].abs();
        // of equal ones the first
        speed(*a).total_cmp(&speed(*b)).then(b.cmp(a))
    })
}

/// Judges the check.
pub fn judge(facts: &MotionFacts<'_>, at: SpeedAt, band: Band, check: &str) -> Finding {
    let trace = facts.trace;
    let speeds = speeds_m_s(trace);
    let (touch, tick, what) = match at {
        SpeedAt::Run => (None, fastest(&speeds), "its greatest speed".to_owned()),
        SpeedAt::Touch(body) => {
            let contacts = trace.contacts.iter();
            let touches = contacts.filter(|contact| {
                TouchingParty::Arm.meets(TouchingParty::Body(body), contact.parties)
            });
            let first = touches.map(|contact| contact.first_tick as usize).min();
            // the step that ends at the touch has the blow in it
            let before = first.map(|tick| tick.saturating_sub(1));
            let name = facts.names.body(body);
            (
                first,
                before,
                format!("when the arm first touches `{name}`"),
            )
        }
    };
    let speed = tick.and_then(|tick| speeds.get(tick).copied());
    let value = speed.unwrap_or(f64::INFINITY);
    let score = band.score(value);
    let mut evidence = Vec::new();
    match (tick, at) {
        (Some(tick), _) if score < 1.0 => {
            let message = format!(
                "the TCP goes at {} m/s at {}, {what}",
                trimmed(value, 3),
                seconds(facts.time_s(tick)),
            );
            evidence.push(Evidence {
                value: value.is_finite().then_some(value),
                limit: Some(band.full),
                unit: "m/s".to_owned(),
                ..facts.evidence(message, "tcp".to_owned(), tick)
            });
        }
        (None, SpeedAt::Touch(body)) => {
            let message = format!("the arm never touched `{}`", facts.names.body(body));
            let last = trace.len().saturating_sub(1);
            evidence.push(facts.evidence(message, "contacts".to_owned(), last));
        }
        _ => {}
    }
    let (quantity, next_step) = match at {
        SpeedAt::Run => (
            "greatest speed of the TCP".to_owned(),
            "Give the fastest part of the move more time.".to_owned(),
        ),
        SpeedAt::Touch(body) => {
            let name = facts.names.body(body);
            let next_step = if tick.is_some() {
                format!("Come to `{name}` more slowly: a push is enough.")
            } else {
                format!("Lead the arm to `{name}`.")
            };
            (format!("speed of the TCP {what}"), next_step)
        }
    };
    let touch = touch.map(|tick| (facts.time_s(tick), "first touch".to_owned()));
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity,
            value: value.is_finite().then_some(value),
            unit: "m/s".to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step,
        curve: Some(Curve {
            check: check.to_owned(),
            title: "speed of the TCP".to_owned(),
            unit: "m/s".to_owned(),
            t_s: (0..trace.len()).map(|tick| facts.time_s(tick)).collect(),
            values: speeds,
            full: Some(band.full),
            zero: Some(band.zero),
            marks: touch.into_iter().collect(),
            step: None,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_speed_of_a_turning_link_is_radius_times_rate() {
        // one joint at 0.5 rad/s; the TCP of this chain is the last link's frame, 0.2 m from the first axis of two
        let run = crate::record::sample::chain(2, 100, |tick, joint| {
            if joint == 0 {
                0.0005 * tick as f64
            } else {
                0.0
            }
        });
        let speeds = speeds_m_s(&run.trace);
        let expected = 0.2 * 0.5;
        assert_eq!(speeds[0], 0.0);
        for speed in &speeds[1..] {
            // chord against arc: relative 1e-8 at 0.5 mrad a step
            assert!((speed - expected).abs() < 1e-8, "{speed}");
        }
    }

    #[test]
    fn the_fastest_is_the_first_of_equals_and_nan_is_faster_than_all() {
        assert_eq!(fastest(&[0.0, 2.0, 1.0, 2.0]), Some(1));
        assert_eq!(fastest(&[0.0, -f64::NAN, f64::INFINITY]), Some(1));
        assert_eq!(fastest(&[]), None);
    }
}
