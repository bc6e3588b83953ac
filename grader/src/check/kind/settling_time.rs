//! settling-time: when a joint comes to stay near its final value \[s\].
//!
//! It is the last time at which the signal is further from its final value than `within` times the step, on the straight line
//! between two ticks. A joint that is so far off in the final part has not settled.

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
use crate::check::step_response::{Loss, Measured, Response};
use crate::record::grade::Evidence;
use crate::record::quantity::with_unit;
use crate::task::model::Band;
use crate::task::problem::LabError;

step_table! {
    /// The time at the end of the run whose mean is the final value \[s\]; 0.2 where it is left out.
    final_s = 0.2;
    /// How near, as a share of the step; 0.02 where it is left out.
    #[schemars(with = "Option<f64>")]
    within: Option<NumberAt>,
    /// Time that earns all points \[s\].
    full_s: f64,
    /// Time that earns none \[s\].
    zero_s: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "settling-time";
    type Check = SettlingTime;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<SettlingTime, LabError> {
        let within = reading.share_of_step(self.within.as_ref(), "`within`", 0.02)?;
        Ok(SettlingTime {
            response: reading.step_response(&self.keys(), at.clone())?,
            within,
            band: reading.report.band(self.full_s, self.zero_s, at)?,
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct SettlingTime {
    response: StepResponse,
    /// How near, as a share of the step.
    within: f64,
    band: Band,
}

impl CheckKind for SettlingTime {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, "s"))
    }
}

/// When the signal is last further than `tolerance` from `end`, in ticks; 0 where it never is.
fn last_off(values: &[f64], end: f64, tolerance: f64) -> f64 {
    let far = |value: &f64| {
        let near = (value - end).abs() <= tolerance;
        !near
    };
    let Some(last) = values.iter().rposition(far) else {
        return 0.0;
    };
    let Some(next) = values.get(last + 1) else {
        return f64::INFINITY;
    };
    let edge = if values[last] > end {
        end + tolerance
    } else {
        end - tolerance
    };
    last as f64 + (values[last] - edge) / (values[last] - next)
}

impl MotionCheck for SettlingTime {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let response = Response::new(facts, &self.response);
        let tolerance = self.within * response.step().abs();
        let fault = response.fault(tolerance);
        let ticks = last_off(&response.values, response.end, tolerance);
        let value = match fault {
            Some(_) => f64::INFINITY,
            None => response.time_s(ticks),
        };
        let share = with_unit(self.within, "");
        let short = || {
            let mut message = format!(
                "{} stays within {share} of its step from {} on",
                response.what(),
                seconds(value),
            );
            if let Some(predicted) = response.predicted() {
                let end = response.predicted_end(&predicted);
                let tolerance = self.within * (end - response.start).abs();
                let predicted_s = response.time_s(last_off(&predicted, end, tolerance));
                if predicted_s.is_finite() {
                    message += &format!("; the linear loop does from {}", seconds(predicted_s));
                }
            }
            Loss {
                evidence: Evidence {
                    value: value.is_finite().then_some(value),
                    limit: Some(self.band.full),
                    unit: "s".to_owned(),
                    ..response.evidence(message, ticks.max(0.0) as usize)
                },
                next_step:
                    "Look at the curve: if it swings, add damping; if it creeps, add proportional gain."
                        .to_owned(),
            }
        };
        let marks = if value.is_finite() {
            vec![(value, "settled".to_owned())]
        } else {
            Vec::new()
        };
        let told = format!("within {share} of the final value");
        let edges = (response.end - tolerance, response.end + tolerance, told);
        let drawn = response.end.is_finite().then_some(edges);
        let measured = Measured {
            quantity: format!(
                "time until {} stays within {share} of its step",
                response.what()
            ),
            value,
            unit: "s",
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
        assert!(finding.next_step.starts_with("Come to rest sooner"));
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
