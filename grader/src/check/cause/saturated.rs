//! A motor at its limit while points are lost: the arm cannot do what the command asks.

use kinemark_sim::control::Mode;
use kinemark_sim::text::number::{seconds, trimmed};

use super::{Cause, Lost};

/// A motor at its limit gives this share of it.
const AT_LIMIT: f64 = 0.999;
/// For so long at once \[s\].
const LEAST_S: f64 = 0.15;

pub(super) fn seen(lost: &Lost<'_>) -> Option<Cause> {
    let facts = lost.facts;
    // who commands efforts sees them
    if facts.motion.servo.mode == Mode::Effort {
        return None;
    }
    let until = lost.first_lost.unwrap_or(facts.last_tick());
    let least = (LEAST_S / facts.motion.periods.step_s).ceil() as usize;
    let mut longest: Option<(usize, usize, usize)> = None;
    for joint in 0..facts.robot.n() {
        let limit = facts.motion.servo.gains[joint].effort_limit;
        if !limit.is_finite() {
            continue;
        }
        let efforts = facts.applied_efforts(joint);
        let mut since = None;
        for (tick, effort) in efforts.iter().chain([&0.0]).enumerate() {
            if effort.abs() >= AT_LIMIT * limit {
                since.get_or_insert(tick);
            } else if let Some(from) = since.take() {
                // what comes after points were lost did not cost them
                // and neither did what was over long before
                let counts = tick - from >= least && from <= until && until <= tick + least;
                if counts && longest.is_none_or(|(_, known, to)| tick - from > to - known) {
                    longest = Some((joint, from, tick));
                }
            }
        }
    }
    let (joint, from, to) = longest?;
    let name = facts.joint_name(joint);
    let limit = facts.motion.servo.gains[joint].effort_limit;
    Some(Cause {
        words: format!(
            "the motor of joint `{name}` gives all it can, {} {}, from {} to {}: the arm cannot follow the command there",
            trimmed(limit, 3),
            facts.units(joint).effort(),
            seconds(facts.time_s(from)),
            seconds(facts.time_s(to)),
        ),
        signal: format!("effort[{joint}]"),
        tick: from,
        question: Some(
            "Does your command jump there, or ask for more speed than the motors have?".to_owned(),
        ),
    })
}
