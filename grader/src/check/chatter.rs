//! chatter: how often the effort of a joint turns round, in reversals per second \[Hz\].
//!
//! A *reversal* is counted where the effort has come back from its last extreme by more than 1 % of the joint's effort limit (of
//! the joint's greatest effort in the run, where it has no limit). The side from which it goes first is no reversal. The count is
//! divided by the length of the run; of several joints the worst counts. An effort that swings at `f` turns round `2 f` times a second.

use super::{Finding, MotionFacts, alternation};
use crate::lab::model::Band;
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::seconds;

/// An effort comes back by more than this share of its limit to have turned round.
const HYSTERESIS: f64 = 0.01;

/// The ticks at which the effort has come back from an extreme by more than `hysteresis`.
fn reversals(efforts: &[f64], hysteresis: f64) -> Vec<usize> {
    let mut ticks = Vec::new();
    let Some(&first) = efforts.first() else {
        return ticks;
    };
    // before it has gone anywhere both ends of its range are extremes
    let (mut low, mut high) = (first, first);
    let mut rises = None;
    for (tick, &effort) in efforts.iter().enumerate() {
        (low, high) = (low.min(effort), high.max(effort));
        let turned = match rises {
            None => (high - low > hysteresis).then_some(effort > low),
            Some(true) => (high - effort > hysteresis).then_some(false),
            Some(false) => (effort - low > hysteresis).then_some(true),
        };
        if turned.is_some() {
            if rises.is_some() {
                ticks.push(tick);
            }
            rises = turned;
            (low, high) = (effort, effort);
        }
    }
    ticks
}

/// Judges the check.
pub fn judge(facts: &MotionFacts<'_>, joint: Option<usize>, band: Band, check: &str) -> Finding {
    let trace = facts.trace;
    // the effort of the last row is never applied
    let applied = trace.len().saturating_sub(1);
    let of_joint = |joint: usize| -> Option<Vec<usize>> {
        let efforts: Vec<f64> = trace.effort.component(joint).take(applied).collect();
        if !efforts.iter().all(|effort| effort.is_finite()) {
            return None;
        }
        let limit = facts.motion.servo.gains[joint].effort_limit;
        let limit = if limit.is_finite() {
            limit
        } else {
            efforts.iter().fold(0.0, |most: f64, e| most.max(e.abs()))
        };
        Some(reversals(&efforts, HYSTERESIS * limit))
    };
    let run_s = facts.time_s(applied);
    let per_second = |count: usize| count as f64 / run_s;
    let (worst, value) = facts.worst_joint(joint, |joint| {
        of_joint(joint).map_or(f64::NAN, |ticks| per_second(ticks.len()))
    });
    let score = band.score(value);
    let name = facts.joint_name(worst);
    let ticks = of_joint(worst).unwrap_or_default();
    let mut evidence = Vec::new();
    let mut next_step =
        "Lower the gains that see noise, derivatives first, or filter what they see.".to_owned();
    if score < 1.0 {
        let first = ticks.first().copied().unwrap_or(0);
        let mut message = format!(
            "the effort of joint `{name}` turns round {} times in {}, first at {}",
            ticks.len(),
            seconds(run_s),
            seconds(facts.time_s(first)),
        );
        if let Some((why, help)) = alternation::told(facts, worst, first) {
            message = format!("{message}; {why}");
            next_step = help;
        }
        evidence.push(Evidence {
            value: value.is_finite().then_some(value),
            limit: Some(band.full),
            unit: "Hz".to_owned(),
            ..facts.evidence(message, format!("effort[{worst}]"), first)
        });
    }
    let mut so_far = vec![0.0; trace.len()];
    for tick in ticks {
        so_far[tick] = 1.0;
    }
    let mut count = 0.0;
    for value in &mut so_far {
        count += *value;
        *value = count / run_s;
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: format!("reversals of the effort of joint `{name}` per second"),
            value: value.is_finite().then_some(value),
            unit: "Hz".to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step,
        curve: Some(Curve {
            check: check.to_owned(),
            title: format!(
                "reversals of the effort of joint `{name}` so far, per second of the run"
            ),
            unit: "Hz".to_owned(),
            t_s: (0..trace.len()).map(|tick| facts.time_s(tick)).collect(),
            values: so_far,
            full: Some(band.full),
            zero: Some(band.zero),
            marks: Vec::new(),
            step: None,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::super::by_hand::{HandRow, judged, value};
    use super::reversals;

    const MOTION: &str = "mode = \"effort\"\nduration_s = 2.0";
    const KIND: &str = "chatter = { full_hz = 10.0, zero_hz = 50.0 }";

    #[test]
    fn turning_points_beyond_the_hysteresis_count() {
        let of = |efforts: &[f64]| reversals(efforts, 1.0);
        assert!(of(&[0.0, 5.0, 10.0]).is_empty());
        assert_eq!(of(&[0.0, 5.0, 10.0, 9.5, 12.0, 10.5, 9.0]), [5]);
        assert_eq!(of(&[0.0, -5.0, 5.0, -5.0]), [2, 3]);
        // from the first extreme, not from the first value
        assert_eq!(of(&[0.0, 0.9, -0.9, -3.0, -1.5]), [4]);
        assert!(of(&[]).is_empty());
    }

    #[test]
    fn a_swing_turns_round_twice_a_period() {
        // 10 Hz, ±2 N m: well above 1 % of 100 N m; and the other joint below it
        let finding = judged(MOTION, KIND, |t_s| {
            let wave = libm::cos(2.0 * std::f64::consts::PI * 10.0 * t_s);
            HandRow {
                effort: [0.4 * wave, 2.0 * wave],
                ..HandRow::default()
            }
        });
        // begins at a crest, so the first half period goes down and every later one turns it: 39 of 40
        assert_eq!(value(&finding), 19.5);
        let expected = (50.0 - 19.5) / 40.0;
        assert!((finding.score - expected).abs() < 1e-12);
        assert!(
            finding.evidence[0]
                .message
                .starts_with("the effort of joint `elbow` turns round 39 times in 2 s"),
            "{}",
            finding.evidence[0].message
        );
    }

    #[test]
    fn a_command_that_alternates_is_explained() {
        let finding = judged(MOTION, KIND, |t_s| {
            let call = (t_s * 100.0 + 1e-6) as u64;
            let effort = if call.is_multiple_of(2) { 30.0 } else { -30.0 };
            HandRow {
                command: [0.0, effort],
                effort: [0.0, effort],
                ..HandRow::default()
            }
        });
        // 200 calls, 199 changes, the first of which is no reversal
        assert_eq!((value(&finding), finding.score), (99.0, 0.0));
        assert!(
            finding.evidence[0]
                .message
                .contains("turns round at every control period of 10 ms"),
            "{}",
            finding.evidence[0].message
        );
        let steady = judged(MOTION, KIND, |_| HandRow {
            effort: [3.0, 4.0],
            ..HandRow::default()
        });
        assert_eq!((value(&steady), steady.score), (0.0, 1.0));
        let lost = judged(MOTION, KIND, |_| HandRow {
            effort: [f64::NAN, 0.0],
            ..HandRow::default()
        });
        assert_eq!(lost.score, 0.0);
    }
}
