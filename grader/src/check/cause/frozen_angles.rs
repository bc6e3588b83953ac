//! Stale angles: velocities that would follow the path if the joints were still where they were earlier.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::{list, seconds, trimmed};

use super::tcp_command::{TcpCommand, angle};
use super::{Cause, Lost};

/// Directions that are the same \[rad\].
const SAME: f64 = 0.01;
/// The command leads aside by more than this \[rad\].
const ASIDE: f64 = 0.1;
/// For so long \[s\].
const LEAST_S: f64 = 0.5;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Velocity {
        return None;
    }
    let motion = TcpCommand::new(facts);
    let trace = facts.trace;
    let calls = (LEAST_S / facts.motion.periods.control_s()).ceil() as usize;
    for ([from, to], [first, last]) in motion.segments()? {
        let along = (to - from).normalize();
        let first_call = first.next_multiple_of(motion.stride());
        for stale in [0, first_call] {
            if stale >= trace.len() {
                continue;
            }
            let (mut seen, mut aside_rad) = (0, 0.0);
            for tick in (first_call..=last).step_by(motion.stride()) {
                let command = trace.command.at(tick);
                let Some(as_if) = motion.under(trace.q.at(stale), command) else {
                    break;
                };
                if as_if.norm() < 1e-6 || angle(&as_if, &along) > SAME {
                    break;
                }
                aside_rad = angle(&motion.velocity_m_s(tick)?, &along);
                seen += 1;
            }
            if seen >= calls && aside_rad > ASIDE {
                return Some(Cause {
                    words: format!(
                        "the command would follow the path if the joints were still at {} as at {}; where they are, it comes to lead {}° aside",
                        list(trace.q.at(stale)),
                        seconds(facts.time_s(stale)),
                        trimmed(aside_rad * 180.0 / std::f64::consts::PI, 0)
                    ),
                    signal: "command".to_owned(),
                    tick: first_call,
                    question: Some("At which angles do you evaluate the Jacobian, and when were they measured?".to_owned()),
                });
            }
        }
    }
    None
}
