//! steady-error: the steady-state error of a joint, how far from its target it comes to rest, in the unit of its signal.
//!
//! Measured is the distance of the mean over the last `last_s` from the target. A joint that hardly moved, or that in this time goes
//! further from the mean than 5 % of the way to the target or than the band's `full`, whichever is more, is not at rest and earns
//! nothing.
//!
//! The evidence says what the error is for: the effort that gravity takes where the joint stands, and the error at which a
//! proportional gain gives it.

use crate::check::prelude::*;
use crate::check::rest_error::{Reason, number, reason};
use crate::check::step_keys::{OfName, StepResponse, step_table};
use crate::check::step_response::{Loss, Response, SETTLED};

step_table! {
    /// The time at the end of the run whose mean counts \[s\]; 0.5 where it is left out.
    last_s = 0.5;
    /// Error of a `position` that earns all points \[rad, or m of a prismatic joint\].
    full_rad: Option<At<BandEnd>>,
    /// Error of a `position` that earns none.
    zero_rad: Option<At<BandEnd>>,
    /// Error of a `velocity` that earns all points \[rad/s, or m/s of a prismatic joint\].
    full_rad_s: Option<At<BandEnd>>,
    /// Error of a `velocity` that earns none.
    zero_rad_s: Option<At<BandEnd>>,
}

problems! {
    /// A target or a band that is not that of the signal.
    enum SignalProblem {
        NoTarget { unit: &'static str }:
            "lab::step", "a steady error is the distance from a target", "the target is missing",
            format!("add it, such as `target_{unit} = 1.0`");
        BandOfOther { unit: &'static str }:
            "lab::step", "the band has the unit of another signal than `of` names", "of the wrong unit",
            format!("write `full_{unit}` and `zero_{unit}`");
        NoBand { unit: &'static str }:
            "lab::step", "a steady error needs its band", "the band is not complete",
            format!("write `full_{unit}` and `zero_{unit}`");
    }
}

impl MotionTable for Table {
    const NAME: &'static str = "steady-error";
    type Check = InBand<SteadyError>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let response = reading.step_response(&self.keys())?;
        let of_position = [&self.full_rad, &self.zero_rad];
        let of_velocity = [&self.full_rad_s, &self.zero_rad_s];
        let (unit, band, foreign) = match self.of {
            OfName::Position => ("rad", of_position, of_velocity),
            OfName::Velocity => ("rad_s", of_velocity, of_position),
        };
        let Some(target) = response.target else {
            return reading.refuse(SignalProblem::NoTarget { unit });
        };
        if let Some(typed) = foreign.into_iter().flatten().next() {
            return reading.refuse_at(typed, SignalProblem::BandOfOther { unit });
        }
        let [Some(full), Some(zero)] = band else {
            return reading.refuse(SignalProblem::NoBand { unit });
        };
        let (band, unit) = ([*full.get_ref(), *zero.get_ref()], response.unit());
        reading.in_band(band, unit, SteadyError { response, target })
    }
}

/// The distance of a joint at rest from its target.
#[derive(Debug)]
pub(crate) struct SteadyError {
    response: StepResponse,
    /// The setpoint, in the unit of the signal.
    target: f64,
}

impl RunMeasure for SteadyError {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let response = Response::new(facts, &self.response);
        let (target, unit) = (self.target, self.response.unit());
        let way = (target - response.start).abs();
        // a joint that begins at its target is there to be held
        let stayed = if way > 1e-6 { response.stayed() } else { None };
        let tolerance = (SETTLED * way).max(band.full);
        let fault = stayed.or_else(|| response.unsettled(tolerance));
        let value = match fault {
            Some(_) => f64::INFINITY,
            None => (response.end - target).abs(),
        };
        let judged_from = facts.time_s(response.final_tick);
        let marks = vec![(judged_from, "judged from here".to_owned())];
        let words = format!("within {} {unit}", number(band.full));
        let edges = (target - band.full, target + band.full, words);
        let curve = response.curve(marks, (band.full > 0.0).then_some(edges));
        let what = response.what();
        let quantity = format!(
            "steady-state error of {what} (target {})",
            response.with_unit(target)
        );
        let predicted = response
            .predicted()
            .map(|predicted| (predicted.end - target).abs());
        let finding = Finding::against(band, value, unit, quantity)
            .drawn(curve)
            .beside_prediction(predicted);
        Response::finding(finding, fault, || self.loss(&response, value))
    }
}

impl SteadyError {
    /// Why points are lost where the joint came to rest, `value` off.
    fn loss(&self, response: &Response<'_>, value: f64) -> Loss {
        let reason = reason(response, self.target);
        let moves = reason.as_ref().is_some_and(|reason| reason.moves);
        let mut message = format!(
            "{} {} {}, {} from {}",
            response.what(),
            if moves { "ends at" } else { "settles at" },
            response.with_unit(response.end),
            response.with_unit(value),
            response.with_unit(self.target),
        );
        let insists = reason.as_ref().is_some_and(|reason| reason.insists);
        let mut next_step = "Add integral action.".to_owned();
        if moves {
            message += ", and is still moving";
        }
        if let Some(Reason { words, help, .. }) = reason {
            message += &format!(": {words}");
            next_step = help;
        }
        Loss {
            evidence: Evidence {
                value: Some(response.end),
                limit: Some(self.target),
                ..response.evidence(message, response.facts.last_tick())
            },
            next_step,
            insists,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

    const SERVO: &str = "mode = \"position\"\nduration_s = 2.0\nservo = { kp = 100.0, kd = 10.0 }";
    const EFFORT: &str = "mode = \"effort\"\nduration_s = 2.0";
    const KIND: &str = "steady-error = { joint = \"elbow\", target_rad = 1.5707963267948966, full_rad = 0.0, zero_rad = 0.1 }";
    /// The forearm level: 0.5 kg at 0.5 m takes 2.4525 N m, downward where `q` grows.
    const LEVEL: f64 = std::f64::consts::FRAC_PI_2;

    fn at(q: f64, command: f64, effort: f64) -> impl Fn(f64) -> HandRow {
        move |t_s| HandRow {
            q: [0.0, q * (10.0 * t_s).min(1.0)],
            command: [0.0, command],
            effort: [0.0, effort],
            ..HandRow::default()
        }
    }

    #[test]
    fn gravity_and_a_proportional_gain_explain_the_error() {
        let finding = judged(SERVO, KIND, at(LEVEL + 0.025, LEVEL, -2.5));
        assert!((value(&finding) - 0.025).abs() < 1e-12);
        assert!((finding.score - 0.75).abs() < 1e-9);
        assert_eq!(
            finding.evidence[0].message,
            "joint `elbow` settles at 1.5958 rad, 0.025 rad from 1.5708 rad: gravity takes 2.452 N m there, \
             and kp = 100 needs 0.025 rad of error to supply it"
        );
        assert!(finding.next_step.contains("integral action"));
        let finding = judged(EFFORT, KIND, at(LEVEL + 0.025, -2.452, -2.452));
        assert_eq!(
            finding.evidence[0].message,
            "joint `elbow` settles at 1.5958 rad, 0.025 rad from 1.5708 rad: gravity takes 2.452 N m there; \
             the motor gives 2.452 N m with 0.025 rad of error: as a proportional gain of 98.08 would"
        );
    }

    #[test]
    fn an_error_that_still_shrinks_is_reported_as_moving() {
        let nears = |t_s: f64| HandRow {
            q: [
                0.0,
                (LEVEL - 0.05 * libm::exp(-0.5 * t_s)) * (10.0 * t_s).min(1.0),
            ],
            command: [0.0, LEVEL],
            ..HandRow::default()
        };
        let finding = judged(SERVO, KIND, nears);
        let message = &finding.evidence[0].message;
        assert!(message.contains(" ends at "), "{message}");
        assert!(message.contains("and is still moving: from "), "{message}");
        assert!(finding.next_step.contains("removed too slowly"));
        let quantity = finding.measure.expect("measured").quantity;
        assert_eq!(
            quantity,
            "steady-state error of joint `elbow` (target 1.5708 rad)"
        );
    }

    #[test]
    fn what_pushes_past_the_target_is_no_proportional_gain() {
        let finding = judged(EFFORT, KIND, at(LEVEL - 0.025, -2.452, -2.452));
        let message = &finding.evidence[0].message;
        assert!(
            message.ends_with("gravity takes 2.452 N m there, and the motor gives it although feedback of this error alone would push the other way"),
            "{message}"
        );
        assert!(finding.next_step.starts_with("Look at what you add"));
    }

    #[test]
    fn a_command_beside_the_target_is_the_first_reason() {
        let finding = judged(SERVO, KIND, at(1.525, 1.5, -2.5));
        let message = &finding.evidence[0].message;
        assert!(
            message.ends_with("`control` asks for 1.5 rad there"),
            "{message}"
        );
        assert_eq!(finding.next_step, "Return 1.5708 rad for joint `elbow`.");
    }

    #[test]
    fn a_velocity_lags_by_what_keeps_it_up() {
        let motion = "mode = \"velocity\"\nduration_s = 2.0\nservo = { kp = 100.0 }";
        let kind = "steady-error = { joint = \"elbow\", of = \"velocity\", target_rad_s = 1.0, full_rad_s = 0.001, zero_rad_s = 0.1 }";
        let finding = judged(motion, kind, |t_s| HandRow {
            qd: [0.0, 0.993 * (10.0 * t_s).min(1.0)],
            command: [0.0, 1.0],
            effort: [0.0, 0.7],
            ..HandRow::default()
        });
        assert!((value(&finding) - 0.007).abs() < 1e-12);
        let message = &finding.evidence[0].message;
        assert!(
            message.ends_with("0.007 rad/s from 1 rad/s: keeping it takes 0.7 N m, and kp = 100 needs 0.007 rad/s of error to supply it"),
            "{message}"
        );
    }

    #[test]
    fn what_swings_around_its_target_is_not_there() {
        let swings = |t_s: f64| HandRow {
            q: [0.0, LEVEL + 0.5 * libm::sin(62.8318 * t_s)],
            ..HandRow::default()
        };
        let finding = judged(EFFORT, KIND, swings);
        assert_eq!((finding.score, value(&finding)), (0.0, f64::INFINITY));
        assert_eq!(judged(EFFORT, KIND, at(0.0, 0.0, 0.0)).score, 0.0);
        assert_eq!(judged(EFFORT, KIND, at(f64::NAN, 0.0, 0.0)).score, 0.0);
        // held where it began
        let kind = "steady-error = { joint = \"elbow\", target_rad = 0.0, full_rad = 0.01, zero_rad = 0.1 }";
        assert_eq!(judged(EFFORT, kind, at(0.005, 0.0, 0.0)).score, 1.0);
    }
}
