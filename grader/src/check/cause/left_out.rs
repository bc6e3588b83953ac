//! A joint that is left out: its velocity is asked for at no call, while the others are asked to move.

use kinemark_sim::control::Mode;

use super::tcp_command::{LEAST_RATE, TcpCommand};
use super::{Cause, Lost};

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Velocity || facts.robot.n() != 2 {
        return None;
    }
    let motion = TcpCommand::new(facts);
    // only where there is a path to follow; one that a joint alone can follow is not recognised
    motion.path()?;
    let first = motion.first_call()?;
    let asks = |joint: usize| {
        let mut calls = (0..facts.last_tick()).step_by(motion.stride());
        calls.any(|tick| facts.trace.command.at(tick)[joint].abs() > LEAST_RATE)
    };
    let left_out = (0..facts.robot.n()).find(|joint| !asks(*joint))?;
    let name = facts.joint_name(left_out);
    Some(Cause {
        words: format!("`control` returns 0 for joint `{name}` at every call"),
        signal: format!("command[{left_out}]"),
        tick: first,
        question: Some(format!(
            "Which velocity does your inverse give for joint `{name}`, and does it reach what you return?"
        )),
    })
}
