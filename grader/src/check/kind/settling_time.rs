//! settling-time: when a joint comes to stay near its final value \[s\].
//!
//! It is the last time at which the signal is further from its final value than `within` times the step, on the straight line
//! between two ticks. A joint that is so far off in the final part has not settled.

use crate::check::prelude::*;
use crate::check::step_keys::{StepResponse, step_table};
use crate::check::step_response::Response;

step_table! {
    /// The time at the end of the run whose mean is the final value \[s\]; 0.2 where it is left out.
    final_s = 0.2;
    /// How near, as a share of the step; 0.02 where it is left out.
    within: Option<At<f64>>,
    /// Time that earns all points \[s\].
    full_s: BandEnd,
    /// Time that earns none \[s\].
    zero_s: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "settling-time";
    type Check = InBand<SettlingTime>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let within = reading.share_of_step(self.within.as_ref(), "`within`", 0.02)?;
        let response = reading.step_response(&self.keys())?;
        let measure = SettlingTime { response, within };
        reading.in_band([self.full_s, self.zero_s], "s", measure)
    }
}

/// The time until a joint stays near its final value.
#[derive(Debug)]
pub(crate) struct SettlingTime {
    response: StepResponse,
    /// How near, as a share of the step.
    within: f64,
}

impl RunMeasure for SettlingTime {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let response = Response::new(facts, &self.response);
        let tolerance = self.within * response.step().abs();
        let fault = response.fault(tolerance);
        let ticks = response.measured().settled_at(tolerance);
        let value = match fault {
            Some(_) => f64::INFINITY,
            None => response.time_s(ticks),
        };
        let mark = value.is_finite().then(|| (value, "settled".to_owned()));
        let share = with_unit(self.within, "");
        let words = format!("within {share} of the final value");
        let edges = (response.end - tolerance, response.end + tolerance, words);
        let edges = response.end.is_finite().then_some(edges);
        let what = response.what();
        let quantity = format!("time until {what} stays within {share} of its step");
        let curve = response.curve(mark.into_iter().collect(), edges);
        let predicted_s = response.predicted().map(|predicted| {
            let curve = predicted.curve(response.start);
            let tolerance = self.within * curve.step().abs();
            response.time_s(curve.settled_at(tolerance))
        });
        let finding = Finding::against(band, value, "s", quantity)
            .drawn(curve)
            .beside_prediction(predicted_s);
        Response::finding(finding, fault, || {
            let from = seconds(value);
            let mut message = format!("{what} stays within {share} of its step from {from} on");
            if let Some(predicted_s) = predicted_s.filter(|time_s| time_s.is_finite()) {
                message += &format!("; the linear loop does from {}", seconds(predicted_s));
            }
            let next_step = "Look at the curve: if it swings, add damping; if it creeps, add proportional gain.";
            response.late(message, (value, ticks), band, next_step)
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"effort\"\nduration_s = 2.0";

    fn elbow(q: f64) -> HandRow {
        HandRow {
            q: [0.0, q],
            ..HandRow::default()
        }
    }

    #[test]
    fn a_first_order_lag_settles_to_2_percent_in_ln_50_time_constants() {
        let kind = "settling-time = { joint = \"elbow\", full_s = 0.2, zero_s = 0.6 }";
        let finding = judged(MOTION, kind, |t_s| elbow(3.0 - 3.0 * libm::exp(-t_s / 0.1)));
        // chord of 1 ms, final value reached but for exp(-18)
        assert!((value(&finding) - 0.1 * libm::log(50.0)).abs() < 3e-6);
        assert!(finding.evidence[0].message.contains("from 0.391 s on"));
    }

    #[test]
    fn the_last_excursion_counts_and_not_the_first_arrival() {
        // arrives at 0.1 s, and leaves once more for a triangle between 0.5 s and 0.7 s
        let row = |t_s: f64| {
            let triangle = (0.1 - (t_s - 0.6).abs()).max(0.0);
            elbow((10.0 * t_s).min(1.0) + triangle)
        };
        let kind =
            "settling-time = { joint = \"elbow\", within = 0.05, full_s = 1.0, zero_s = 2.0 }";
        let finding = judged(MOTION, kind, row);
        // back within 0.05 half way down the triangle's side
        assert!((value(&finding) - 0.65).abs() < 1e-9);
        assert_eq!(finding.score, 1.0);
        let curve = finding.curve.expect("a curve");
        let (low, high, _) = curve.step.expect("a backdrop").band.expect("a band");
        assert!((low - 0.95).abs() < 1e-9 && (high - 1.05).abs() < 1e-9);
    }

    #[test]
    fn what_still_moves_at_the_end_never_settles() {
        let kind = "settling-time = { joint = \"elbow\", full_s = 1.0, zero_s = 2.0 }";
        let finding = judged(MOTION, kind, elbow);
        assert_eq!((finding.score, value(&finding)), (0.0, f64::INFINITY));
        let message = &finding.evidence[0].message;
        assert_eq!(
            message,
            "joint `elbow` never settles: in the last 0.2 s it still goes from 1.8 rad to 2 rad"
        );
        assert!(finding.next_step.starts_with("What still drives it"));
        let swings = |t_s: f64| HandRow {
            q: [0.0, t_s.min(1.0) + 0.2 * libm::sin(50.0 * t_s)],
            ..HandRow::default()
        };
        let next_step = judged(MOTION, kind, swings).next_step;
        assert!(next_step.starts_with("Damp the swing"), "{next_step}");
        let rattle = |t_s: f64| {
            let call = (t_s * 100.0 + 1e-6) as u64;
            let side = if call.is_multiple_of(2) { 1.0 } else { -1.0 };
            HandRow {
                q: [0.0, t_s.min(1.0) + 0.1 * libm::sin(314.159 * t_s)],
                command: [0.0, 40.0 * side],
                ..HandRow::default()
            }
        };
        let finding = judged(MOTION, kind, rattle);
        let message = &finding.evidence[0].message;
        assert!(
            message.contains("about 50 times a second; its command turns round at every control period of 10 ms: the gains are too high"),
            "{message}"
        );
        assert!(finding.next_step.starts_with("Lower the gains"));
    }
}
