//! No stop at the end: the hand comes to the last point of its path and goes on.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::{metres, seconds};

use super::tcp_command::TcpCommand;
use super::{Cause, Lost};
use crate::check::path_following::passages;

/// A command that still asks for this of the hand does not stop it \[m/s\].
const STILL_M_S: f64 = 0.01;

/// When that is looked at, after the hand has come to the last point \[s\].
const AFTER_S: f64 = 0.3;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Velocity {
        return None;
    }
    let motion = TcpCommand::new(facts);
    let path = motion.path()?;
    let end = *path.points_m.last()?;
    let positions_m = facts.p_tcp_m();
    let passages = passages(&positions_m, path)?;
    let arrived = passages.last()?;
    let are_passed = passages.iter().all(|passage| passage.gap_m <= 0.0);
    let last = facts.last_tick();
    let beyond_m = (positions_m[last] - end).norm();
    // later it may have come to the end of its reach
    let after = arrived.tick + (AFTER_S / facts.motion.periods.step_s) as usize;
    let speed_m_s = motion.velocity_m_s(after.min(last))?.norm();
    // what was lost before the hand arrived has another cause
    let before = lost.first_lost.is_some_and(|tick| tick < arrived.tick);
    if !are_passed || before || beyond_m < 3.0 * path.trim_m || speed_m_s < STILL_M_S {
        return None;
    }
    Some(Cause {
        words: format!(
            "the hand comes to the last point of its path at {} and goes on: at the end of the run it is {} from there",
            seconds(facts.time_s(arrived.tick)),
            metres(beyond_m)
        ),
        signal: "tcp".to_owned(),
        tick: arrived.tick,
        question: Some("What does `control` return once the hand is at the last point?".to_owned()),
    })
}
