//! Gravity compensation with the wrong sign or twice, in position commands: an arm that rests twice as low as its servos alone would
//! leave it, or as high above its goal as they would leave it below.

use kinemark_sim::control::Mode;
use kinemark_sim::dynamics::gravity_effort;
use kinemark_sim::text::number::metres;
use nalgebra::Vector3;

use super::tcp_command::{TcpCommand, damped_inverse};
use super::{Cause, Lost};
use crate::check::facts::MotionFacts;
use crate::task::tcp::tcp_in;

/// Efforts of gravity below this say nothing \[N m or N\].
const LEAST_EFFORT: f64 = 0.5;
/// How near a whole number of compensations is.
const NEAR: f64 = 0.15;
/// An arm is at rest below this \[rad/s or m/s\].
const AT_REST: f64 = 0.02;
const MOST_STEPS: usize = 30;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    let servo = &facts.motion.servo;
    let integrates = servo.gains.iter().any(|gains| gains.ki > 0.0);
    if servo.mode != Mode::Position || servo.gravity_compensation || integrates {
        return None;
    }
    let missed = facts.motion.goals.iter().zip(&facts.dwells).enumerate();
    let missed = missed.filter(|(_, (_, dwell))| facts.pose_band.score(dwell.settled_m) < 1.0);
    let mut seen: Option<(i32, Cause)> = None;
    for (i, (goal, dwell)) in missed {
        let Some((tick, times)) = (dwell.first..=dwell.last)
            .min_by(|a, b| motion_at(facts, *a).total_cmp(&motion_at(facts, *b)))
            .and_then(|tick| Some((tick, compensations(facts, tick, goal.position_m)?)))
        else {
            continue;
        };
        if seen.as_ref().is_some_and(|(known, _)| *known != times) {
            return None;
        }
        let (what, question) = match times {
            -1 => (
                "its joints hang about twice as far below the angles that this goal needs as gravity alone would pull them: the commands are that much below, too",
                "Which way does gravity pull the joint, and which way does your command move away from the angle that you want?",
            ),
            2 => (
                "its commands are above the angles that this goal needs by about twice what gravity takes",
                "How often is gravity allowed for on the way from the angles that you want to the command?",
            ),
            _ => return None,
        };
        let number = i + 1;
        let cause = Cause {
            words: format!(
                "where the arm rests for goal {number}, {} away, {what}",
                metres((facts.trace.tcp_position(tick) - goal.position_m).norm())
            ),
            signal: "command".to_owned(),
            tick,
            question: Some(question.to_owned()),
        };
        seen.get_or_insert((times, cause));
    }
    seen.map(|(_, cause)| cause)
}

/// How often the commands at rest allow for gravity, the same in all joints that feel it; none where that is no whole number.
fn compensations(facts: &MotionFacts<'_>, tick: usize, goal_m: Vector3<f64>) -> Option<i32> {
    let (trace, gains) = (facts.trace, &facts.motion.servo.gains);
    if motion_at(facts, tick) > AT_REST {
        return None;
    }
    let wanted = angles_at(facts, trace.q.at(tick), goal_m)?;
    let gravity = gravity_effort(
        facts.robot,
        &facts.motion.gravity_m_s2,
        &facts.robot.positions(&wanted).ok()?,
    );
    let mut times = None;
    for (joint, effort) in gravity.as_slice().iter().enumerate() {
        if effort.abs() < LEAST_EFFORT || gains[joint].kp <= 0.0 {
            continue;
        }
        let ahead = trace.command.at(tick)[joint] - wanted[joint];
        let found = ahead * gains[joint].kp / effort;
        let whole = found.round();
        let agrees = times.is_none_or(|known| known == whole as i32);
        if (found - whole).abs() > NEAR || !agrees {
            return None;
        }
        times = Some(whole as i32);
    }
    times
}

/// The greatest speed of a joint \[rad/s or m/s\].
fn motion_at(facts: &MotionFacts<'_>, tick: usize) -> f64 {
    let rates = facts.trace.qd.at(tick).iter();
    rates.fold(0.0, |most: f64, rate| most.max(rate.abs()))
}

/// The angles nearest to `q` that put the TCP at `goal_m`, by Newton's method.
fn angles_at(facts: &MotionFacts<'_>, q: &[f64], goal_m: Vector3<f64>) -> Option<Vec<f64>> {
    let motion = TcpCommand::new(facts);
    let mut q = q.to_vec();
    for _ in 0..MOST_STEPS {
        let p = tcp_in(facts.robot, facts.names.seen_from, &q)?;
        let off = goal_m - p;
        if off.norm() < 1e-9 {
            return Some(q);
        }
        let jacobian = motion.jacobian(&q)?;
        let along = damped_inverse(&jacobian)? * off;
        for (value, column) in q.iter_mut().zip(&jacobian) {
            *value += column.dot(&along).clamp(-0.3, 0.3);
        }
    }
    None
}
