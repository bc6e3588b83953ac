//! Efforts that the submission limits itself, far below what the motor could give: the arm cannot do what the law asks for.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::{seconds, trimmed};

use super::{Cause, Lost};

/// Of the calls, this share returns the limit; fewer may be a peak.
const LEAST_SHARE: f64 = 0.1;
/// Other values than the limit that a law returns, at least: a constant, or a switch between two, limits nothing.
const LEAST_OTHERS: usize = 20;
/// A joint at rest gets the same effort from any law; one this fast does not \[rad/s or m/s\].
const MOVES: f64 = 1e-3;
/// A limit above this share of the motor's leaves it nearly all it has.
const FAR_BELOW: f64 = 0.7;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Effort {
        return None;
    }
    let stride = facts.motion.periods.ticks_per_control.get() as usize;
    let calls: Vec<usize> = (0..facts.last_tick()).step_by(stride).collect();
    let joints = (0..facts.robot.n()).rev();
    let (joint, limit, at_limit) = joints.into_iter().find_map(|joint| {
        let returned = |tick: &usize| facts.trace.command.at(*tick)[joint];
        let limit = calls.iter().map(returned).map(f64::abs).fold(0.0, f64::max);
        let motor = facts.motion.servo.gains[joint].effort_limit;
        let (at_limit, others): (Vec<usize>, Vec<usize>) =
            calls.iter().partition(|tick| returned(tick).abs() >= limit);
        let moves = |tick: &&usize| facts.trace.qd.at(**tick)[joint].abs() > MOVES;
        let often =
            at_limit.iter().filter(moves).count() as f64 >= LEAST_SHARE * calls.len() as f64;
        let is_law = others.len() >= LEAST_OTHERS;
        (limit > 0.0 && limit < FAR_BELOW * motor && often && is_law)
            .then_some((joint, limit, at_limit))
    })?;
    let motor = facts.motion.servo.gains[joint].effort_limit;
    let name = facts.joint_name(joint);
    let force = facts.units(joint).effort();
    let motor_gives = if motor.is_finite() {
        format!("its motor can give {} {force}", trimmed(motor, 3))
    } else {
        "its motor has no limit".to_owned()
    };
    let first = *at_limit.first()?;
    Some(Cause {
        words: format!(
            "at {} of {} calls `control` returns {} {force}, forwards or backwards, for joint `{name}`, and never more: {motor_gives}",
            at_limit.len(),
            calls.len(),
            trimmed(limit, 3),
        ),
        signal: format!("command[{joint}]"),
        tick: first,
        question: Some(format!(
            "What limits the effort that you return for joint `{name}`? At {} it is at that limit for the first time.",
            seconds(facts.time_s(first))
        )),
    })
}
