//! rise-time: how long a joint takes from one share of its step to another \[s\].
//!
//! The shares are of the way from the start to the final value. Each is passed where the signal first reaches it, on the straight
//! line between two ticks.

use crate::check::prelude::*;
use crate::check::step_keys::{StepResponse, step_table};
use crate::check::step_response::{Response, SETTLED};

problems! {
    /// Shares that do not go up.
    enum ShareProblem {
        NoRise { from: f64, to: f64 }:
            "lab::step", "a rise goes up: `from` must be below `to`, got {from} and {to}", "this share of the step",
            "left out they are 0.1 and 0.9";
    }
}

step_table! {
    /// The time at the end of the run whose mean is the final value \[s\]; 0.2 where it is left out.
    final_s = 0.2;
    /// The lower share of the step, above 0; 0.1 where it is left out.
    from: Option<At<f64>>,
    /// The upper share of the step, below 1; 0.9 where it is left out.
    to: Option<At<f64>>,
    /// Time that earns all points \[s\].
    full_s: BandEnd,
    /// Time that earns none \[s\].
    zero_s: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "rise-time";
    type Check = InBand<RiseTime>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let from = reading.share_of_step(self.from.as_ref(), "`from`", 0.1)?;
        let to = reading.share_of_step(self.to.as_ref(), "`to`", 0.9)?;
        if from >= to {
            let problem = ShareProblem::NoRise { from, to };
            return match self.from.as_ref().or(self.to.as_ref()) {
                Some(typed) => reading.refuse_at(typed, problem),
                None => reading.refuse(problem),
            };
        }
        let measure = RiseTime {
            response: reading.step_response(&self.keys())?,
            shares: [from, to],
        };
        reading.in_band([self.full_s, self.zero_s], "s", measure)
    }
}

/// The time from one share of a step to another.
#[derive(Debug)]
pub(crate) struct RiseTime {
    response: StepResponse,
    /// Where the time begins and ends, in `(0, 1)` and rising.
    shares: [f64; 2],
}

impl RunMeasure for RiseTime {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let response = Response::new(facts, &self.response);
        let fault = response.fault(SETTLED * response.step().abs());
        let passed = match fault {
            Some(_) => None,
            None => response.measured().passes(self.shares),
        };
        let times_s = passed.map(|ticks| ticks.map(|ticks| response.time_s(ticks)));
        let value = times_s.map_or(f64::INFINITY, |[from_s, to_s]| to_s - from_s);
        let [from_s, to_s] = times_s.unwrap_or([f64::NAN; 2]);
        let [from, to] = self.shares.map(|share| with_unit(share, ""));
        let marks = match times_s {
            Some(_) => vec![
                (from_s, format!("{from} of the step")),
                (to_s, format!("{to} of the step")),
            ],
            None => Vec::new(),
        };
        let what = response.what();
        let quantity = format!(
            "time of {what} from {from} to {to} of its step of {}",
            response.with_unit(response.step())
        );
        let predicted_s = response.predicted().and_then(|predicted| {
            let [from, to] = predicted.curve(response.start).passes(self.shares)?;
            Some(response.time_s(to - from))
        });
        let finding = Finding::against(band, value, "s", quantity)
            .drawn(response.curve(marks, None))
            .beside_prediction(predicted_s);
        Response::finding(finding, fault, || {
            let mut message = format!(
                "{what} takes {} from {from} to {to} of its step, from {} to {}",
                seconds(value),
                seconds(from_s),
                seconds(to_s),
            );
            if let Some(predicted_s) = predicted_s {
                message += &format!("; the linear loop takes {}", seconds(predicted_s));
            }
            let last = passed.map_or(0.0, |ticks| ticks[1]);
            let next_step = "Make it faster: more proportional gain, or less damping.";
            response.late(message, (value, last), band, next_step)
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

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
            (KIND, 0.0, "ends where it began"),
            (KIND, 5e-4, "ends where it began"),
            (with_target, 9e-3, "is not at its target at the end"),
            (with_target, -1.0, "moves away from its target at once"),
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
        let words = "swings back and forth across its final value and does not get smaller";
        assert!(message.contains(words), "{message}");
    }
}
