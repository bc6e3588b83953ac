//! steady-error: the steady-state error of a joint, how far from its target it comes to rest, in the unit of its signal.
//!
//! Measured is the distance of the mean over the last `last_s` from the target. A joint that hardly moved, or that in this time goes
//! further from the mean than 5 % of the way to the target or than the band's `full`, whichever is more, is not at rest and earns
//! nothing.
//!
//! The evidence says what the error is for: the effort that gravity takes where the joint stands, and the error at which a
//! proportional gain gives it.

use std::ops::Range;

use kinemark_sim::control::Mode;
use kinemark_sim::control::linear_step::Fed;
use kinemark_sim::dynamics::gravity_effort;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Problem;
use kinemark_sim::text::number::trimmed;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::reading::{InTask, NumberAt};
use crate::check::registry::MotionTable;
use crate::check::step_keys::{OfName, StepResponse, step_table};
use crate::check::step_response::{Loss, Measured, Response, SETTLED};
use crate::record::grade::Evidence;
use crate::task::model::Band;
use crate::task::problem::LabError;

/// Efforts below this are no reason for an error \[N m or N\].
const LEAST_EFFORT: f64 = 1e-6;
/// Gravity is the reason where the motor gives what it takes, but for this share.
const SAME_EFFORT: f64 = 0.1;
/// An error that shrinks by more than this share while it is judged is not at rest.
const STILL_NEARING: f64 = 0.1;

step_table! {
    /// The time at the end of the run whose mean counts \[s\]; 0.5 where it is left out.
    last_s = 0.5;
    /// Error of a `position` that earns all points \[rad, or m of a prismatic joint\].
    #[schemars(with = "Option<f64>")]
    full_rad: Option<NumberAt>,
    /// Error of a `position` that earns none.
    #[schemars(with = "Option<f64>")]
    zero_rad: Option<NumberAt>,
    /// Error of a `velocity` that earns all points \[rad/s, or m/s of a prismatic joint\].
    #[schemars(with = "Option<f64>")]
    full_rad_s: Option<NumberAt>,
    /// Error of a `velocity` that earns none.
    #[schemars(with = "Option<f64>")]
    zero_rad_s: Option<NumberAt>,
}

/// A target or a band that is not that of the signal.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
enum Incomplete {
    #[error("a steady error is the distance from a target")]
    NoTarget { unit: &'static str },
    #[error("the band has the unit of another signal than `of` names")]
    BandOfOther { unit: &'static str },
    #[error("a steady error needs its band")]
    NoBand { unit: &'static str },
}

impl Problem for Incomplete {
    fn code(&self) -> &'static str {
        "lab::step"
    }

    fn label(&self) -> String {
        match self {
            Self::NoTarget { .. } => "the target is missing",
            Self::BandOfOther { .. } => "of the wrong unit",
            Self::NoBand { .. } => "the band is not complete",
        }
        .to_owned()
    }

    fn help(&self) -> Option<String> {
        Some(match self {
            Self::NoTarget { unit } => format!("add it, such as `target_{unit} = 1.0`"),
            Self::BandOfOther { unit } | Self::NoBand { unit } => {
                format!("write `full_{unit}` and `zero_{unit}`")
            }
        })
    }
}

impl MotionTable for Table {
    const NAME: &'static str = "steady-error";
    type Check = SteadyError;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<SteadyError, LabError> {
        let report = reading.report;
        let response = reading.step_response(&self.keys(), at.clone())?;
        let of_position = [&self.full_rad, &self.zero_rad];
        let of_velocity = [&self.full_rad_s, &self.zero_rad_s];
        let (unit, band, foreign) = match self.of {
            OfName::Position => ("rad", of_position, of_velocity),
            OfName::Velocity => ("rad_s", of_velocity, of_position),
        };
        let Some(target) = response.target else {
            return report.refuse(at, Incomplete::NoTarget { unit });
        };
        if let Some(typed) = foreign.into_iter().flatten().next() {
            return report.refuse(typed.span(), Incomplete::BandOfOther { unit });
        }
        let [Some(full), Some(zero)] = band else {
            return report.refuse(at, Incomplete::NoBand { unit });
        };
        Ok(SteadyError {
            band: report.band(*full.get_ref(), *zero.get_ref(), at)?,
            response,
            target,
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct SteadyError {
    response: StepResponse,
    /// The setpoint, in the unit of the signal.
    target: f64,
    band: Band,
}

impl CheckKind for SteadyError {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, self.response.unit()))
    }
}

impl MotionCheck for SteadyError {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let response = Response::new(facts, &self.response);
        let (target, unit) = (self.target, self.response.unit());
        let way = (target - response.start).abs();
        // a joint that begins at its target is there to be held
        let stayed = if way > 1e-6 { response.stayed() } else { None };
        let tolerance = (SETTLED * way).max(self.band.full);
        let fault = stayed.or_else(|| response.unsettled(tolerance));
        let value = match fault {
            Some(_) => f64::INFINITY,
            None => (response.end - target).abs(),
        };
        let short = || self.loss(&response, value);
        let judged_from = facts.time_s(response.final_tick);
        let marks = vec![(judged_from, "judged from here".to_owned())];
        let told = format!("within {} {unit}", number(self.band.full));
        let edges = (target - self.band.full, target + self.band.full, told);
        let drawn = (self.band.full > 0.0).then_some(edges);
        let measured = Measured {
            quantity: format!(
                "distance of {} at rest from {}",
                response.what(),
                response.told(target)
            ),
            value,
            unit,
            band: self.band,
        };
        Response::finding(measured, fault, short, response.curve(marks, drawn))
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Evidence
    }
}

impl SteadyError {
    /// Why points are lost where the joint came to rest, `value` off.
    fn loss(&self, response: &Response<'_>, value: f64) -> Loss {
        let mut message = format!(
            "{} settles at {}, {} from {}",
            response.what(),
            response.told(response.end),
            response.told(value),
            response.told(self.target),
        );
        let mut next_step = "Add integral action.".to_owned();
        let rest = Rest::of(response, self.target);
        if let Some(Reason { words, help }) = rest.and_then(|rest| rest.reason()) {
            message += &format!(": {words}");
            next_step = help;
        }
        let last = response.values.len().saturating_sub(1);
        Loss {
            evidence: Evidence {
                value: Some(response.end),
                limit: Some(self.target),
                ..response.evidence(message, last)
            },
            next_step,
        }
    }
}

/// A number with three digits that count, however small.
fn number(value: f64) -> String {
    let size = value.abs();
    let decimals = if size >= 100.0 {
        1
    } else if size >= 0.01 {
        3
    } else {
        6
    };
    trimmed(value, decimals)
}

/// Why a joint rests beside its target, and what helps.
struct Reason {
    words: String,
    help: String,
}

impl Reason {
    fn new(words: impl Into<String>, help: impl Into<String>) -> Option<Self> {
        Some(Self {
            words: words.into(),
            help: help.into(),
        })
    }
}

/// How a joint rests beside its target.
struct Rest<'a> {
    response: &'a Response<'a>,
    target: f64,
    /// From the final value to the target.
    error: f64,
    /// The last tick of the run.
    last: usize,
    /// Mean effort of the joint over the final part \[N m or N\].
    given: f64,
    /// Whether the lab's servo closes the loop over the signal.
    is_servo: bool,
}

impl<'a> Rest<'a> {
    fn of(response: &'a Response<'a>, target: f64) -> Option<Self> {
        let (facts, asked) = (response.facts, response.asked);
        let mut rest = Self {
            response,
            target,
            error: target - response.end,
            last: facts.trace.len().checked_sub(1)?,
            given: 0.0,
            is_servo: matches!(
                (facts.motion.servo.mode, asked.of),
                (Mode::Position, Fed::Position) | (Mode::Velocity, Fed::Velocity)
            ),
        };
        rest.given = rest.mean(|tick| facts.trace.effort.at(tick)[asked.joint]);
        Some(rest)
    }

    /// The mean over the final part; the efforts of the last row are never applied.
    fn mean(&self, value: impl Fn(usize) -> f64) -> f64 {
        let ticks = self.response.final_tick..self.last;
        let count = ticks.len().max(1) as f64;
        ticks.map(value).sum::<f64>() / count
    }

    fn reason(&self) -> Option<Reason> {
        self.command_is_beside()
            .or_else(|| self.is_still_nearing())
            .or_else(|| match self.response.asked.of {
                Fed::Position => self.gravity(),
                Fed::Velocity => self.drag(),
            })
    }

    /// `control` asks the servo for something else.
    fn command_is_beside(&self) -> Option<Reason> {
        let response = self.response;
        let joint = response.asked.joint;
        let commanded = self.mean(|tick| response.facts.trace.command.at(tick)[joint]);
        let beside = (commanded - self.target).abs();
        if !(self.is_servo && beside > 0.5 * self.error.abs()) {
            return None;
        }
        Reason::new(
            format!("`control` asks for {} there", response.told(commanded)),
            format!(
                "Return {} for joint `{}`.",
                response.told(self.target),
                response.name()
            ),
        )
    }

    /// The error still shrinks.
    fn is_still_nearing(&self) -> Option<Reason> {
        let response = self.response;
        let ends = [response.final_tick, self.last].map(|tick| response.values[tick]);
        let [then, now] = ends.map(|value| (value - self.target).abs());
        let nears = then - now > STILL_NEARING * self.error.abs();
        if !nears {
            return None;
        }
        let [from, to] = ends.map(|value| response.told(value));
        Reason::new(
            format!("it is still on its way, from {from} to {to} in this time"),
            "What takes the error away works, and is too slow: a stronger integral, or less for it to do.",
        )
    }

    /// A joint that has to be held against gravity.
    fn gravity(&self) -> Option<Reason> {
        let (facts, asked) = (self.response.facts, self.response.asked);
        let (motion, force) = (facts.motion, asked.units.effort());
        // what holds a robot with loops is shared among its joints
        if motion.servo.gravity_compensation || !facts.robot.loops().is_empty() {
            return None;
        }
        let q = facts.robot.positions(facts.trace.q.at(self.last)).ok()?;
        let gravity = gravity_effort(facts.robot, &motion.gravity_m_s2, &q).as_slice()[asked.joint];
        let limit = motion.servo.gains[asked.joint].effort_limit;
        if self.given.abs() >= 0.99 * limit {
            return Reason::new(
                format!("the motor is at its limit of {} {force}", number(limit)),
                "Ask for less: the motor must have some effort left to correct with.",
            );
        }
        // another torque at work, such as a push of the other joints, would make gravity a wrong reason
        if gravity.abs() < LEAST_EFFORT
            || (self.given - gravity).abs() > SAME_EFFORT * gravity.abs()
        {
            return None;
        }
        let reason = format!("gravity takes {} {force} there", number(gravity.abs()));
        self.proportional(gravity, reason)
    }

    /// A velocity that has to be kept up.
    fn drag(&self) -> Option<Reason> {
        let (given, force) = (self.given, self.response.asked.units.effort());
        if given.abs() < LEAST_EFFORT {
            return None;
        }
        let reason = format!("keeping it takes {} {force}", number(given.abs()));
        self.proportional(given, reason)
    }

    /// The error at which a proportional gain gives `effort`, which is needed for `reason`.
    fn proportional(&self, effort: f64, reason: String) -> Option<Reason> {
        let asked = self.response.asked;
        let (unit, force) = (asked.unit(), asked.units.effort());
        let kp = self.response.facts.motion.servo.gains[asked.joint].kp;
        let (given, error) = (self.given, self.error);
        if self.is_servo && kp > 0.0 {
            let needed = number((effort / kp).abs());
            Reason::new(
                format!(
                    "{reason}, and kp = {} needs {needed} {unit} of error to supply it",
                    number(kp)
                ),
                "More proportional gain makes the error smaller; integral action, or adding that effort yourself, takes it away.",
            )
        } else if given * error < 0.0 && error.abs() > 1e-9 {
            // no feedback of the error alone gives that
            Reason::new(
                format!("{reason}, and the motor gives it on the far side of the target"),
                "Check sign and size of what you add to the feedback: it holds the joint beside its target.",
            )
        } else if error.abs() > 1e-9 {
            Reason::new(
                format!(
                    "{reason}; the motor gives {} {force} with {} {unit} of error: as a proportional gain of {} would",
                    number(given.abs()),
                    number(error.abs()),
                    number((given / error).abs())
                ),
                "Add integral action, or add that effort to what you return.",
            )
        } else {
            Reason::new(reason, "Add integral action.")
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
    fn what_pushes_past_the_target_is_no_proportional_gain() {
        let finding = judged(EFFORT, KIND, at(LEVEL - 0.025, -2.452, -2.452));
        let message = &finding.evidence[0].message;
        assert!(
            message.ends_with("gravity takes 2.452 N m there, and the motor gives it on the far side of the target"),
            "{message}"
        );
        assert!(finding.next_step.starts_with("Check sign and size"));
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
