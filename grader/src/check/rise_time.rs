//! rise-time: how long a joint takes from one share of its step to another \[s\].
//!
//! The shares, 0.1 and 0.9 where the lab does not say, are of the way from the start to the final value. Each is passed where the
//! signal first reaches it, on the straight line between two ticks.

use super::response::{Loss, Measured, Response, SETTLED};
use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::lab::step::StepResponse;
use crate::record::grade::Evidence;
use crate::record::quantity::{seconds, trimmed, with_unit};

/// When the signal first reaches a share of the way from `start` to `end`, in ticks.
fn first_at(values: &[f64], start: f64, end: f64, share: f64) -> Option<f64> {
    let gone = |tick: usize| (values[tick] - start) / (end - start);
    let tick = (0..values.len()).find(|tick| gone(*tick) >= share)?;
    let Some(before) = tick.checked_sub(1) else {
        return Some(0.0);
    };
    let (from, to) = (gone(before), gone(tick));
    Some(before as f64 + (share - from) / (to - from))
}

/// When the signal passes both shares, in ticks.
fn passes(values: &[f64], start: f64, end: f64, shares: [f64; 2]) -> Option<[f64; 2]> {
    let [from, to] = shares.map(|share| first_at(values, start, end, share));
    Some([from?, to?])
}

/// Judges the check.
pub fn judge(
    facts: &MotionFacts<'_>,
    asked: &StepResponse,
    shares: [f64; 2],
    band: Band,
    check: &str,
) -> Finding {
    let response = Response::new(facts, asked);
    let fault = response.fault(SETTLED * response.step().abs());
    let passed = match fault {
        Some(_) => None,
        None => passes(&response.values, response.start, response.end, shares),
    };
    let [from_s, to_s] = passed.map_or([f64::NAN; 2], |ticks| {
        ticks.map(|ticks| response.time_s(ticks))
    });
    let value = if passed.is_some() {
        to_s - from_s
    } else {
        f64::INFINITY
    };
    let told = shares.map(|share| with_unit(share, ""));
    let mut marks = Vec::new();
    if passed.is_some() {
        marks.push((from_s, format!("{} of the step", told[0])));
        marks.push((to_s, format!("{} of the step", told[1])));
    }
    let short = || {
        let mut message = format!(
            "{} takes {} from {} to {} of its step, from {} to {}",
            response.what(),
            seconds(value),
            told[0],
            told[1],
            seconds(from_s),
            seconds(to_s),
        );
        if let Some(predicted) = response.predicted() {
            let end = response.predicted_end(&predicted);
            if let Some([from, to]) = passes(&predicted, response.start, end, shares) {
                message += &format!(
                    "; the linear loop takes {}",
                    seconds(response.time_s(to - from))
                );
            }
        }
        let tick = passed.map_or(0.0, |ticks| ticks[1]).max(0.0) as usize;
        Loss {
            evidence: Evidence {
                value: value.is_finite().then_some(value),
                limit: Some(band.full),
                unit: "s".to_owned(),
                ..response.evidence(message, tick.min(response.values.len() - 1))
            },
            next_step: "Make it faster: more proportional gain, or less damping.".to_owned(),
        }
    };
    let measured = Measured {
        quantity: format!(
            "time of {} from {} to {} of its step of {} {}",
            response.what(),
            told[0],
            told[1],
            trimmed(response.step(), 4),
            asked.unit()
        ),
        value,
        unit: "s",
        band,
    };
    Response::finding(measured, fault, short, response.curve(check, marks, None))
}

#[cfg(test)]
mod tests {
    use super::super::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"effort\"\nduration_s = 2.0";
    const KIND: &str = "rise-time = { joint = \"elbow\", full_s = 0.2, zero_s = 1.0 }";

    fn elbow(q: f64) -> HandRow {
        HandRow {
            q: [0.0, q],
            ..HandRow::default()
        }
    }

    #[test]
    fn a_ramp_takes_the_share_of_its_time() {
        // from 0.5 to -0.5 in a second: 0.8 s between a tenth and nine tenths
        let finding = judged(MOTION, KIND, |t_s| elbow(0.5 - t_s.min(1.0)));
        // ticks are 1 ms apart and the ramp is straight between them
        assert!((value(&finding) - 0.8).abs() < 1e-12);
        assert!((finding.score - 0.25).abs() < 1e-12);
        let message = &finding.evidence[0].message;
        assert_eq!(
            message,
            "joint `elbow` takes 0.8 s from 10 % to 90 % of its step, from 0.1 s to 0.9 s"
        );
        let wide =
            "rise-time = { joint = \"elbow\", from = 0.25, to = 0.75, full_s = 0.5, zero_s = 1.0 }";
        let finding = judged(MOTION, wide, |t_s| elbow(0.5 - t_s.min(1.0)));
        assert!((value(&finding) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn a_first_order_lag_rises_in_its_time_constant_times_ln_9() {
        let lag = |t_s: f64| elbow(1.0 - libm::exp(-t_s / 0.1));
        let finding = judged(MOTION, KIND, lag);
        // the chord of 1 ms is off by (h/T)²/8 T = 1e-6 s, and the final value is reached but for exp(-18)
        assert!((value(&finding) - 0.1 * libm::log(9.0)).abs() < 3e-6);
        assert!((finding.score - (1.0 - value(&finding)) / 0.8).abs() < 1e-12);
    }

    #[test]
    fn a_velocity_is_looked_at_where_it_is_asked_for() {
        let kind =
            "rise-time = { joint = \"elbow\", of = \"velocity\", full_s = 0.9, zero_s = 1.0 }";
        let finding = judged(MOTION, kind, |t_s| HandRow {
            qd: [0.0, 2.0 * t_s.min(1.0)],
            ..HandRow::default()
        });
        assert!((value(&finding) - 0.8).abs() < 1e-12);
        assert_eq!(finding.score, 1.0);
    }

    #[test]
    fn no_step_has_no_rise() {
        let with_target =
            "rise-time = { joint = \"elbow\", target_rad = 1.0, full_s = 0.2, zero_s = 1.0 }";
        for (kind, row, words) in [
            (KIND, 0.0, "hardly moved"),
            (KIND, 5e-4, "hardly moved"),
            (with_target, 9e-3, "did not go to its target"),
            (with_target, -1.0, "did not go to its target"),
            (KIND, f64::NAN, ""),
        ] {
            let finding = judged(MOTION, kind, |t_s| elbow(row * t_s.min(1.0)));
            assert_eq!(
                (finding.score, value(&finding)),
                (0.0, f64::INFINITY),
                "{row}"
            );
            let message = &finding.evidence[0].message;
            assert!(message.contains(words), "{message}");
        }
        // swings on for ever: 5 Hz, as wide as the step
        let finding = judged(MOTION, KIND, |t_s| elbow(1.0 - libm::cos(31.4159 * t_s)));
        assert_eq!(finding.score, 0.0);
        let message = &finding.evidence[0].message;
        assert!(message.contains("never settles"), "{message}");
    }
}
