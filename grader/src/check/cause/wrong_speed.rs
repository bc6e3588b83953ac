//! Another speed than the one that is asked for, from the first calls on: a direction that is not of length 1, or a factor too many.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::trimmed;

use super::tcp_command::{TcpCommand, angle};
use super::{Cause, Lost};

/// The command goes along the path within this \[rad\].
const ALONG: f64 = 0.1;
/// A speed that is this many times what is asked for, or less than its inverse, is another one.
const TIMES: f64 = 1.5;
/// The speed is the same at all calls that are looked at, but for this share.
const STEADY: f64 = 0.1;
/// A hand that is asked to move is faster \[m/s\].
const LEAST_M_S: f64 = 1e-3;
/// The calls that are looked at: a soft start is over after this share of the run.
const LOOKED_AT: [f64; 2] = [0.04, 0.1];

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Velocity {
        return None;
    }
    let asked_m_s = facts.motion.target_number("speed").filter(|it| *it > 0.0)?;
    let motion = TcpCommand::new(facts);
    let ([from, to], [begun, left]) = motion.segments()?.into_iter().next()?;
    let along = (to - from).normalize();
    // a hand that is much too fast is at the end before that
    let run = (left - begun) as f64;
    let [first, last] = LOOKED_AT.map(|share| begun + (share * run) as usize);
    let first = first.next_multiple_of(motion.stride());
    let mut speeds_m_s = Vec::new();
    for tick in (first..=last).step_by(motion.stride()) {
        let v = motion.velocity_m_s(tick)?;
        if angle(&v, &along) > ALONG {
            return None;
        }
        speeds_m_s.push(v.norm());
    }
    let count = speeds_m_s.len();
    let mean_m_s = speeds_m_s.iter().sum::<f64>() / count as f64;
    let is_steady = speeds_m_s
        .iter()
        .all(|speed| (speed - mean_m_s).abs() <= STEADY * mean_m_s);
    let times = mean_m_s / asked_m_s;
    // a hand that still waits has no speed of its own
    if count < 2 || mean_m_s < LEAST_M_S || !is_steady || (TIMES.recip()..=TIMES).contains(&times) {
        return None;
    }
    let mut words = format!(
        "the command asks the hand for {} m/s along its path, {} times the {} m/s of `observation.target.speed`",
        trimmed(mean_m_s, 3),
        trimmed(times, 2),
        trimmed(asked_m_s, 3),
    );
    let length_m = (to - from).norm();
    if (times - length_m).abs() <= 0.02 * length_m {
        words += &format!(
            "; the line is {} m long, as much as that factor",
            trimmed(length_m, 3)
        );
    }
    Some(Cause {
        words,
        signal: "command".to_owned(),
        tick: first,
        question: Some(
            "How long is the vector that you use as a direction, and what do you multiply it by?"
                .to_owned(),
        ),
    })
}
