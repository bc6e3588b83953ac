//! Velocity commands in degrees per second: a motion that would be sensible in radians, and is 57 times too fast.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::trimmed;

use super::tcp_command::TcpCommand;
use super::{Cause, Lost};
use crate::check::facts::MotionFacts;

/// A speed is the one that the task asks for, but for this share.
const NEAR: f64 = 0.05;
/// No arm is asked for such a speed of its hand from the first call on \[m/s\].
const TOO_FAST_M_S: f64 = 5.0;
/// Speeds that are asked for \[m/s\].
const SENSIBLE_M_S: [f64; 2] = [0.02, 2.0];
const DEGREES_PER_RAD: f64 = 180.0 / std::f64::consts::PI;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Velocity {
        return None;
    }
    let motion = TcpCommand::new(facts);
    let tick = motion.first_call()?;
    let speed_m_s = motion.velocity_m_s(tick)?.norm();
    let in_degrees = speed_m_s / DEGREES_PER_RAD;
    if speed_m_s < TOO_FAST_M_S
        || !(SENSIBLE_M_S[0]..=SENSIBLE_M_S[1]).contains(&in_degrees)
        || !is_asked_for(facts, in_degrees)
        || motion.angle_aside(tick)? > 0.1
    {
        return None;
    }
    let command = facts.trace.command.at(tick);
    let largest = command
        .iter()
        .fold(0.0, |most: f64, rate| most.max(rate.abs()));
    Some(Cause {
        words: format!(
            "the first command asks a joint for {} rad/s and the hand for {} m/s; taken as degrees per second it would be {} m/s",
            trimmed(largest, 1),
            trimmed(speed_m_s, 1),
            trimmed(in_degrees, 3)
        ),
        signal: "command".to_owned(),
        tick,
        question: Some(
            "In which unit do you return velocities? The arm takes radians per second.".to_owned(),
        ),
    })
}

/// Whether a speed of the hand is the one that the task's target names, if it names one: what is too fast by another factor is not in
/// degrees.
fn is_asked_for(facts: &MotionFacts<'_>, speed_m_s: f64) -> bool {
    let asked = facts.motion.target_number("speed");
    asked.is_none_or(|asked| (speed_m_s - asked).abs() <= NEAR * asked.abs())
}
