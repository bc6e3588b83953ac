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
/// Where the arm stands on its path with all joints at zero, every small velocity is such an angle: then the command must lead along the
/// path, in the end, by this share of its length. A velocity leads there as far as the hand goes in a second.
const ALONG: f64 = 0.6;

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
    let at_zero = tcp_in(
        facts.robot,
        facts.names.seen_from,
        &vec![0.0; facts.robot.n()],
    )?;
    if beside_m(path, &at_zero) <= ON_PATH_M {
        let legs = path
            .points_m
            .windows(2)
            .map(|ends| (ends[1] - ends[0]).norm());
        let along_m = (stands_at(facts.last_tick())? - at_zero).norm();
        if along_m < ALONG * legs.sum::<f64>() {
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
