//! A joint that is let go: the law returns no effort any more, long before the end of the run.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::{list, seconds};

use super::{Cause, Lost};

/// The arm must have been held for so long before, and not for so long after \[s\].
const LEAST_S: f64 = 0.3;
/// An effort below this holds nothing \[N m or N\].
const LEAST_EFFORT: f64 = 1e-9;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    if facts.motion.servo.mode != Mode::Effort {
        return None;
    }
    let trace = facts.trace;
    let stride = facts.motion.periods.ticks_per_control.get() as usize;
    let holds = |tick: &usize| {
        let command = trace.command.at(*tick);
        command.iter().any(|effort| effort.abs() > LEAST_EFFORT)
    };
    let last_held = (0..facts.last_tick()).step_by(stride).rev().find(holds)?;
    let let_go = last_held + stride;
    let least = (LEAST_S / facts.motion.periods.step_s) as usize;
    (last_held >= least && let_go + least <= facts.last_tick()).then(|| Cause {
        words: format!(
            "from {} on `control` returns {} at every call: nothing holds the arm any more",
            seconds(facts.time_s(let_go)),
            list(trace.command.at(let_go)),
        ),
        signal: "command".to_owned(),
        tick: let_go,
        question: Some(
            "Which condition of your `control` returns this, and should the arm be held after it?"
                .to_owned(),
        ),
    })
}
