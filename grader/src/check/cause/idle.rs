//! A run in which `control` never asks the arm to move.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::list;

use super::{Cause, Lost};

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    let first = facts.trace.command.at(0);
    let rest = match facts.motion.servo.mode {
        Mode::Position => facts.motion.start_q.clone(),
        Mode::Velocity | Mode::Effort | Mode::Prescribed => vec![0.0; facts.robot.n()],
    };
    let is_rest = |command: &[f64]| {
        let joints = command.iter().zip(&rest);
        joints
            .clone()
            .all(|(asked, rest)| (asked - rest).abs() <= 1e-9)
    };
    let ticks = 0..facts.trace.len();
    if !ticks
        .into_iter()
        .all(|tick| is_rest(facts.trace.command.at(tick)))
    {
        return None;
    }
    let what = match facts.motion.servo.mode {
        Mode::Position => "the angles at which the arm starts",
        Mode::Velocity => "no velocity",
        Mode::Effort | Mode::Prescribed => "no effort",
    };
    Some(Cause {
        words: format!(
            "`control` returns {} at every call, which is {what}",
            list(first)
        ),
        signal: "command".to_owned(),
        tick: 0,
        question: None,
    })
}
