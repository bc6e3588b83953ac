//! Angles in place of velocities: the numbers that `control` returns are those at which the arm would stand on its path.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::list;

use super::tcp_command::{TcpCommand, beside_m};
use super::{Cause, Lost};
use crate::task::tcp::tcp_in;

/// How near to the path the arm would stand \[m\]: by chance one command in some hundreds is as near.
const ON_PATH_M: f64 = 2e-3;
/// Calls at the start that are all so.
const CALLS: usize = 10;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Velocity {
        return None;
    }
    let motion = TcpCommand::new(facts);
    let path = motion.path()?;
    let first = motion.first_call()?;
    let stands_at = |tick: usize| {
        let command = facts.trace.command.at(tick);
        tcp_in(facts.robot, facts.names.seen_from, command)
    };
    for tick in (first..facts.trace.len())
        .step_by(motion.stride())
        .take(CALLS)
    {
        if beside_m(path, &stands_at(tick)?) > ON_PATH_M {
            return None;
        }
    }
    Some(Cause {
        words: format!(
            "`control` returns {} at first: as angles, they would put the hand at {}, on its path; as velocities, they turn the joints by so much in each second",
            list(facts.trace.command.at(first)),
            list(stands_at(first)?.as_slice()),
        ),
        signal: "command".to_owned(),
        tick: first,
        question: Some(
            "What are the numbers that you return: angles, or angles per second?".to_owned(),
        ),
    })
}
