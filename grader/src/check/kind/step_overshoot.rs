//! step-overshoot: how far a joint goes past its final value, as a fraction of its step.

use crate::check::prelude::*;
use crate::check::step_keys::{StepResponse, step_table};
use crate::check::step_response::{Loss, Response, SETTLED};

step_table! {
    /// The time at the end of the run whose mean is the final value \[s\]; 0.2 where it is left out.
    final_s = 0.2;
    /// Fraction that earns all points.
    full: BandEnd,
    /// Fraction that earns none.
    zero: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "step-overshoot";
    type Check = InBand<StepOvershoot>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let response = reading.step_response(&self.keys())?;
        reading.in_band([self.full, self.zero], "", StepOvershoot(response))
    }
}

/// How far a joint goes past its final value.
#[derive(Debug)]
pub(crate) struct StepOvershoot(StepResponse);

impl RunMeasure for StepOvershoot {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let response = Response::new(facts, &self.0);
        let fault = response.fault(SETTLED * response.step().abs());
        let (over, peak) = response.measured().overshoot();
        let value = if fault.is_some() { f64::INFINITY } else { over };
        let is_past = value > 0.0 && value.is_finite();
        let mark = is_past.then(|| (facts.time_s(peak), "furthest".to_owned()));
        let edge = response.start + (1.0 + band.full) * response.step();
        let words = format!("{} past the final value", with_unit(band.full, ""));
        let edges = (response.end.min(edge), response.end.max(edge), words);
        let edges = (response.end.is_finite() && band.full > 0.0).then_some(edges);
        let curve = response.curve(mark.into_iter().collect(), edges);
        let what = response.what();
        let predicted = response.predicted();
        let predicted = predicted.map(|predicted| predicted.curve(response.start).overshoot().0);
        let finding = Finding::against(band, value, "", format!("overshoot of {what}"))
            .drawn(curve)
            .beside_prediction(predicted);
        Response::finding(finding, fault, || {
            let mut message = format!(
                "{what} goes to {} at {}, {} of its step past the final value of {}",
                response.with_unit(response.values[peak]),
                seconds(facts.time_s(peak)),
                with_unit(value, ""),
                response.with_unit(response.end),
            );
            if let Some(over) = predicted {
                message += &format!("; the linear loop goes {} past", with_unit(over, ""));
            }
            Loss {
                evidence: Evidence {
                    limit: Some(response.end),
                    ..response.evidence(message, peak)
                },
                next_step: "Add damping, or ask for the step less suddenly.".to_owned(),
                insists: false,
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"effort\"\nduration_s = 4.0";
    const KIND: &str = "step-overshoot = { joint = \"elbow\", full = 0.05, zero = 0.45 }";

    fn elbow(q: f64) -> HandRow {
        HandRow {
            q: [0.0, q],
            ..HandRow::default()
        }
    }

    #[test]
    fn a_triangle_past_the_end_counts_as_a_share_of_the_step() {
        // from 1 down to -1, with a peak 0.5 further at 1 s
        let row = |t_s: f64| elbow(1.0 - (2.5 * t_s).min((4.5 - 2.0 * t_s).max(2.0)));
        let finding = judged(MOTION, KIND, row);
        assert!((value(&finding) - 0.25).abs() < 1e-12);
        assert!((finding.score - 0.5).abs() < 1e-12);
        assert_eq!(
            finding.evidence[0].message,
            "joint `elbow` goes to -1.5 rad at 1 s, 25 % of its step past the final value of -1 rad"
        );
    }

    #[test]
    fn a_second_order_loop_overshoots_by_its_damping() {
        // damping ratio 0.5: exp(-pi/√3) of the step
        let (w, zeta) = (20.0, 0.5);
        let damped = w * 0.75_f64.sqrt();
        let row = |t_s: f64| {
            let wave = libm::cos(damped * t_s) + zeta * w / damped * libm::sin(damped * t_s);
            elbow(1.0 - libm::exp(-zeta * w * t_s) * wave)
        };
        let finding = judged(MOTION, KIND, row);
        let expected = libm::exp(-std::f64::consts::PI / 3.0_f64.sqrt());
        // a peak between ticks: curvature w² over half a tick squared
        assert!((value(&finding) - expected).abs() < 1e-4);
    }

    #[test]
    fn what_creeps_up_has_none_and_what_stays_earns_none() {
        let creeps = judged(MOTION, KIND, |t_s| elbow(1.0 - libm::exp(-8.0 * t_s)));
        // the final part is level but for exp(-30)
        assert!(value(&creeps) < 1e-9, "{}", value(&creeps));
        assert_eq!(creeps.score, 1.0);
        assert_eq!(judged(MOTION, KIND, |_| elbow(0.3)).score, 0.0);
        assert_eq!(judged(MOTION, KIND, |_| elbow(f64::NAN)).score, 0.0);
        let jump = |t_s: f64| {
            elbow(if t_s > 1.0 && t_s < 1.1 {
                f64::NAN
            } else {
                t_s.min(1.0)
            })
        };
        assert_eq!(judged(MOTION, KIND, jump).score, 0.0);
    }
}
