//! steady-error: how far from its target a joint comes to rest, in the unit of its signal.
//!
//! Measured is the distance of the mean over the last `last_s` (0.5 s where the lab does not say) from the target. A joint that
//! hardly moved, or that in this time goes further from the mean than 5 % of the way to the target or than the band's
//! `full`, whichever is more, is at no rest and earns nothing.
//!
//! The evidence says what the error is for: the effort that gravity takes where the joint stands, and the error at which a
//! proportional gain gives it.

use kinemark_sim::control::Mode;
use kinemark_sim::control::linear_step::Fed;
use kinemark_sim::dynamics::gravity_effort;

use super::response::{Loss, Measured, Response, SETTLED};
use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::lab::step::StepResponse;
use crate::record::grade::Evidence;
use crate::record::quantity::trimmed;

/// Efforts below this are no reason for an error \[N m or N\].
const LEAST_EFFORT: f64 = 1e-6;
/// Gravity is the reason where the motor gives what it takes, but for this share.
const SAME_EFFORT: f64 = 0.1;
/// An error that shrinks by more than this share while it is judged is not at rest.
const STILL_NEARING: f64 = 0.1;

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

/// Why the joint rests beside its target, and what helps.
fn reason(response: &Response<'_>, target: f64) -> Option<(String, String)> {
    let (facts, asked) = (response.facts, response.asked);
    let (trace, motion) = (facts.trace, facts.motion);
    let (joint, unit, force) = (asked.joint, asked.unit(), asked.units.effort());
    let error = target - response.end;
    let last = trace.len().checked_sub(1)?;
    // the efforts of the last row are never applied
    let rest = response.final_tick..last;
    let mean = |value: &dyn Fn(usize) -> f64| {
        rest.clone().map(value).sum::<f64>() / rest.len().max(1) as f64
    };
    let given = mean(&|tick| trace.effort.at(tick)[joint]);
    let gains = motion.servo.gains[joint];
    let is_servo = matches!(
        (motion.servo.mode, asked.of),
        (Mode::Position, Fed::Position) | (Mode::Velocity, Fed::Velocity)
    );
    if is_servo {
        let commanded = mean(&|tick| trace.command.at(tick)[joint]);
        let beside = (commanded - target).abs();
        if beside > 0.5 * error.abs() {
            return Some((
                format!("`control` asks for {} there", response.told(commanded)),
                format!(
                    "Return {} for joint `{}`.",
                    response.told(target),
                    response.name()
                ),
            ));
        }
    }
    let nearing = {
        let then = response.values[response.final_tick] - target;
        let now = response.values[last] - target;
        then.abs() - now.abs() > STILL_NEARING * error.abs()
    };
    if nearing {
        let [from, to] =
            [response.final_tick, last].map(|tick| response.told(response.values[tick]));
        return Some((
            format!("it is still on its way, from {from} to {to} in this time"),
            "What takes the error away works, and is too slow: a stronger integral, or less for it to do."
                .to_owned(),
        ));
    }
    let proportional = |effort: f64, reason: String| {
        if is_servo && gains.kp > 0.0 {
            let needed = number((effort / gains.kp).abs());
            (
                format!(
                    "{reason}, and kp = {} needs {needed} {unit} of error to supply it",
                    number(gains.kp)
                ),
                "More proportional gain makes the error smaller; integral action, or adding that effort yourself, takes it away.",
            )
        } else if given * error < 0.0 && error.abs() > 1e-9 {
            // no feedback of the error alone gives that
            (
                format!("{reason}, and the motor gives it on the far side of the target"),
                "Check sign and size of what you add to the feedback: it holds the joint beside its target.",
            )
        } else if error.abs() > 1e-9 {
            (
                format!(
                    "{reason}; the motor gives {} {force} with {} {unit} of error: as a proportional gain of {} would",
                    number(given.abs()),
                    number(error.abs()),
                    number((given / error).abs())
                ),
                "Add integral action, or add that effort to what you return.",
            )
        } else {
            (reason, "Add integral action.")
        }
    };
    let (words, help) = match asked.of {
        Fed::Position => {
            // what holds a robot with loops is shared among its joints
            if motion.servo.gravity_compensation || !facts.robot.loops().is_empty() {
                return None;
            }
            let q = facts.robot.positions(trace.q.at(last)).ok()?;
            let gravity = gravity_effort(facts.robot, &motion.gravity_m_s2, &q).as_slice()[joint];
            let limit = gains.effort_limit;
            if given.abs() >= 0.99 * limit {
                return Some((
                    format!("the motor is at its limit of {} {force}", number(limit)),
                    "Ask for less: the motor must have some effort left to correct with."
                        .to_owned(),
                ));
            }
            // another torque at work, such as a push of the other joints, would make gravity a wrong reason
            if gravity.abs() < LEAST_EFFORT || (given - gravity).abs() > SAME_EFFORT * gravity.abs()
            {
                return None;
            }
            proportional(
                gravity,
                format!("gravity takes {} {force} there", number(gravity.abs())),
            )
        }
        Fed::Velocity => {
            if given.abs() < LEAST_EFFORT {
                return None;
            }
            proportional(
                given,
                format!("keeping it takes {} {force}", number(given.abs())),
            )
        }
    };
    Some((words, help.to_owned()))
}

/// Judges the check.
pub fn judge(
    facts: &MotionFacts<'_>,
    asked: &StepResponse,
    target: f64,
    band: Band,
    check: &str,
) -> Finding {
    let response = Response::new(facts, asked);
    let way = (target - response.start).abs();
    // a joint that begins at its target is there to be held
    let stayed = if way > 1e-6 { response.stayed() } else { None };
    let tolerance = (SETTLED * way).max(band.full);
    let fault = stayed.or_else(|| response.unsettled(tolerance));
    let value = match fault {
        Some(_) => f64::INFINITY,
        None => (response.end - target).abs(),
    };
    let last = response.values.len().saturating_sub(1);
    let short = || {
        let mut message = format!(
            "{} settles at {}, {} from {}",
            response.what(),
            response.told(response.end),
            response.told(value),
            response.told(target),
        );
        let mut next_step = "Add integral action.".to_owned();
        if let Some((why, help)) = reason(&response, target) {
            message += &format!(": {why}");
            next_step = help;
        }
        Loss {
            evidence: Evidence {
                value: Some(response.end),
                limit: Some(target),
                ..response.evidence(message, last)
            },
            next_step,
        }
    };
    let marks = vec![(
        facts.time_s(response.final_tick),
        "judged from here".to_owned(),
    )];
    let told = format!("within {} {}", number(band.full), asked.unit());
    let edges = (target - band.full, target + band.full, told);
    let drawn = (band.full > 0.0).then_some(edges);
    let measured = Measured {
        quantity: format!(
            "distance of {} at rest from {}",
            response.what(),
            response.told(target)
        ),
        value,
        unit: asked.unit(),
        band,
    };
    Response::finding(measured, fault, short, response.curve(check, marks, drawn))
}

#[cfg(test)]
mod tests {
    use super::super::by_hand::{HandRow, judged, value};

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
