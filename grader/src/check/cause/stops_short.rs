//! A stop on the way: the command asks for no motion any more, long before the end of the path and of the run.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::{list, metres, seconds};

use super::tcp_command::{LEAST_RATE, TcpCommand, beside_m};
use super::{Cause, Lost};
use crate::check::path_following::passages;

/// The arm must have been asked to move for so long before, and for none after \[s\].
const LEAST_S: f64 = 0.5;
/// It stops on its path within this \[m\].
const BESIDE_M: f64 = 0.05;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Velocity {
        return None;
    }
    let motion = TcpCommand::new(facts);
    let path = motion.path()?;
    let trace = facts.trace;
    let asks = |tick: &usize| {
        let command = trace.command.at(*tick);
        command.iter().any(|rate| rate.abs() > LEAST_RATE)
    };
    let calls = (0..facts.last_tick()).step_by(motion.stride());
    let last_asking = calls.rev().find(asks)?;
    let stopped = last_asking + motion.stride();
    let least = (LEAST_S / facts.motion.periods.step_s) as usize;
    let last = facts.last_tick();
    if last_asking < least || stopped + least > last {
        return None;
    }
    let passages = passages(&facts.p_tcp_m(), path)?;
    let next = passages.iter().position(|passage| passage.gap_m > 0.0)?;
    let p = trace.tcp_position(last);
    // one that is led beside its path has not only stopped
    if beside_m(path, &p) > BESIDE_M {
        return None;
    }
    Some(Cause {
        words: format!(
            "from {} on `control` returns {} at every call, and the hand stays at {}: {} before point {} of {} of its path",
            seconds(facts.time_s(stopped)),
            list(trace.command.at(stopped)),
            list(p.as_slice()),
            metres((path.points_m[next] - p).norm()),
            next + 1,
            path.points_m.len(),
        ),
        signal: "command".to_owned(),
        tick: stopped,
        question: Some(
            "Which condition of your `control` makes it stop there, and when should that condition hold?"
                .to_owned(),
        ),
    })
}
