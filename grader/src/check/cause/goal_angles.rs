//! Position commands that would be right but for the same slip: the arm is sent to rest where angles in degrees, exchanged, with
//! another sign or counted from another axis send it.

use kinemark_sim::control::Mode;
use kinemark_sim::dynamics::gravity_effort;
use nalgebra::Vector3;

use super::angle_slip::{AngleSlip, only_one};
use super::{Cause, Lost};
use crate::check::facts::MotionFacts;
use crate::task::tcp::tcp_in;

/// A command that is held this long is meant to be reached \[s\].
const HELD_S: f64 = 0.2;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Position || facts.motion.goals.is_empty() {
        return None;
    }
    let near_m = facts.pose_band.zero.max(1e-3);
    let held = held_commands(facts);
    if held.is_empty() {
        return None;
    }
    let at = |q: &[f64]| tcp_in(facts.robot, facts.names.seen_from, q);
    let reaches =
        |q: &[f64], goal: &Vector3<f64>| at(q).is_some_and(|p| (p - goal).norm() <= near_m);
    // the tick of the first goal's command, if commands send the arm to all goals in their order
    let in_order = |meant: &dyn Fn(&[f64]) -> Vec<f64>| {
        let mut commands = held.iter();
        let mut first = None;
        // one command that is held to the end may wait for its goal to be reached
        let count = facts.motion.goals.len().min(held.len());
        for goal in &facts.motion.goals[..count] {
            let (tick, _) = commands.find(|(_, command)| {
                let meant = meant(command);
                reaches(&meant, &goal.position_m)
                    || reaches(&without_gravity(facts, &meant), &goal.position_m)
            })?;
            first.get_or_insert(*tick);
        }
        first
    };
    let undone = |slip: AngleSlip| move |command: &[f64]| slip.undone(facts.robot, command);
    if in_order(&|command| command.to_vec()).is_some() {
        return None;
    }
    let slip = only_one(facts.robot, |slip| in_order(&undone(slip)).is_some())?;
    Some(Cause {
        words: format!(
            "the arm would get to {} if {} in the command",
            match held.len() < facts.motion.goals.len() {
                true => "goal 1",
                false => "all goals",
            },
            slip.in_words(facts.robot)
        ),
        signal: "command".to_owned(),
        tick: in_order(&undone(slip))?,
        question: Some(slip.question(facts.robot)),
    })
}

/// The angles at which the arm rests under a command, where its servos alone carry it.
fn without_gravity(facts: &MotionFacts<'_>, command: &[f64]) -> Vec<f64> {
    let servo = &facts.motion.servo;
    let Ok(q) = facts.robot.positions(command) else {
        return command.to_vec();
    };
    if servo.gravity_compensation {
        return command.to_vec();
    }
    let gravity = gravity_effort(facts.robot, &facts.motion.gravity_m_s2, &q);
    let joints = command.iter().zip(gravity.as_slice()).zip(&servo.gains);
    joints
        .map(|((angle, effort), gains)| match gains.kp {
            kp if kp > 0.0 => angle - effort / kp,
            _ => *angle,
        })
        .collect()
}

/// The commands that are held for some time, each with the tick at which it is given.
fn held_commands<'a>(facts: &MotionFacts<'a>) -> Vec<(usize, &'a [f64])> {
    let trace = facts.trace;
    let least = (HELD_S / facts.motion.periods.step_s).round() as usize;
    let mut held = Vec::new();
    let mut since = 0;
    for tick in 1..=trace.len() {
        let goes_on = tick < trace.len() && trace.command.at(tick) == trace.command.at(since);
        if goes_on {
            continue;
        }
        if tick - since >= least {
            held.push((since, trace.command.at(since)));
        }
        since = tick;
    }
    held
}
