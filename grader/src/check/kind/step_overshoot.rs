//! step-overshoot: how far a joint goes past its final value, as a fraction of its step.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::seconds;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::reading::{InTask, NumberAt};
use crate::check::registry::MotionTable;
use crate::check::step_keys::{StepResponse, step_table};
use crate::check::step_response::{Loss, Measured, Response, SETTLED};
use crate::record::grade::Evidence;
use crate::record::quantity::with_unit;
use crate::task::model::Band;
use crate::task::problem::LabError;

step_table! {
    /// The time at the end of the run whose mean is the final value \[s\]; 0.2 where it is left out.
    final_s = 0.2;
    /// Fraction that earns all points.
    full: f64,
    /// Fraction that earns none.
    zero: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "step-overshoot";
    type Check = StepOvershoot;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<StepOvershoot, LabError> {
        Ok(StepOvershoot {
            response: reading.step_response(&self.keys(), at.clone())?,
            band: reading.report.band(self.full, self.zero, at)?,
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct StepOvershoot {
    response: StepResponse,
    band: Band,
}

impl CheckKind for StepOvershoot {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, ""))
    }
}

/// The greatest share of the way from `start` to `end` beyond all of it, and its tick; none of it is 0, and NaN stays.
fn beyond(values: &[f64], start: f64, end: f64) -> (f64, usize) {
    let gone = |tick: usize| (values[tick] - start) / (end - start);
    let peak = (0..values.len())
        .max_by(|a, b| gone(*a).total_cmp(&gone(*b)).then(b.cmp(a)))
        .unwrap_or(0);
    let over = gone(peak) - 1.0;
    (if over < 0.0 { 0.0 } else { over }, peak)
}

impl MotionCheck for StepOvershoot {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let response = Response::new(facts, &self.response);
        let fault = response.fault(SETTLED * response.step().abs());
        let (over, peak) = beyond(&response.values, response.start, response.end);
        let value = if fault.is_some() { f64::INFINITY } else { over };
        let short = || {
            let mut message = format!(
                "{} goes to {} at {}, {} of its step past the final value of {}",
                response.what(),
                response.told(response.values[peak]),
                seconds(facts.time_s(peak)),
                with_unit(value, ""),
                response.told(response.end),
            );
            if let Some(predicted) = response.predicted() {
                let end = response.predicted_end(&predicted);
                let (over, _) = beyond(&predicted, response.start, end);
                message += &format!("; the linear loop goes {} past", with_unit(over, ""));
            }
            Loss {
                evidence: Evidence {
                    limit: Some(response.end),
                    ..response.evidence(message, peak)
                },
                next_step: "Add damping, or ask for the step less suddenly.".to_owned(),
            }
        };
        let marks = if value > 0.0 && value.is_finite() {
            vec![(facts.time_s(peak), "furthest".to_owned())]
        } else {
            Vec::new()
        };
        let edge = response.start + (1.0 + self.band.full) * response.step();
        let told = format!("{} past the final value", with_unit(self.band.full, ""));
        let edges = (response.end.min(edge), response.end.max(edge), told);
        let drawn = (response.end.is_finite() && self.band.full > 0.0).then_some(edges);
        let measured = Measured {
            quantity: format!("overshoot of {}", response.what()),
            value,
            unit: "",
            band: self.band,
        };
        Response::finding(measured, fault, short, response.curve(marks, drawn))
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Evidence
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
