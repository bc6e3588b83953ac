//! A motor at its limit while points are lost: the arm cannot do what the command asks.

use kinemark_sim::control::Mode;
use kinemark_sim::model::contact::Party;
use kinemark_sim::text::number::{list, seconds, trimmed};
use kinemark_sim::watch::ContactSpan;

use super::{Cause, Lost};
use crate::check::dwell::Dwell;
use crate::check::facts::MotionFacts;

/// A motor at its limit gives this share of it.
const AT_LIMIT: f64 = 0.999;
/// A position command so far from where the joint is is no lag of it \[rad or m\].
const FAR_AHEAD: f64 = 0.7;
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
    if let Some(cause) = blocked(facts, [from, to]) {
        return Some(cause);
    }
    // a motor that is at its limit on the way, and not where the arm should stand, costs time and no place
    let all_dwell = |dwell: &Dwell| {
        let command = |tick: usize| facts.trace.command.at(tick);
        from <= dwell.first && to >= dwell.last && command(dwell.first) == command(dwell.last)
    };
    if !facts.motion.goals.is_empty() && !facts.dwells.iter().any(all_dwell) {
        return None;
    }
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
        question: Some(question(facts, joint, usize::midpoint(from, to))),
    })
}

/// What to ask of a joint whose motor is at its limit at a tick.
fn question(facts: &MotionFacts<'_>, joint: usize, tick: usize) -> String {
    let ahead = facts.trace.command.at(tick)[joint] - facts.trace.q.at(tick)[joint];
    if facts.motion.servo.mode == Mode::Position && ahead.abs() > FAR_AHEAD {
        return format!(
            "At {} the command for joint `{}` is {} {} away from where the joint is: where should it be, and in which unit is your command?",
            seconds(facts.time_s(tick)),
            facts.joint_name(joint),
            trimmed(ahead.abs(), 2),
            facts.units(joint).position(),
        );
    }
    "Does your command jump there, or ask for more speed than the motors have?".to_owned()
}

/// The arm presses on a body while a motor is at its limit: it cannot follow because something stands in its way.
fn blocked(facts: &MotionFacts<'_>, [from, to]: [usize; 2]) -> Option<Cause> {
    let mut contacts = facts.trace.contacts.iter().filter(|contact| {
        let lasts = contact.last_tick - contact.first_tick;
        let overlaps = contact.first_tick < to as u64 && contact.last_tick > from as u64;
        overlaps && facts.motion.periods.time_s(lasts) >= LEAST_S
    });
    let link_first = |contact: &&ContactSpan| matches!(contact.parties[0], Party::Link(_));
    let contact = contacts.find(link_first)?;
    let [one, other] = contact.parties.map(|party| facts.names.party(party));
    let tick = contact.first_tick as usize;
    Some(Cause {
        words: format!(
            "`{one}` presses on `{other}` from {} to {}, with the hand at {} at first: the arm cannot follow the command there",
            seconds(facts.motion.periods.time_s(contact.first_tick)),
            seconds(facts.motion.periods.time_s(contact.last_tick)),
            list(
                facts
                    .trace
                    .tcp_position(tick.min(facts.last_tick()))
                    .as_slice()
            ),
        ),
        signal: "contacts".to_owned(),
        tick,
        question: Some(format!(
            "Where should the hand be when `{one}` meets `{other}`, and where is it?"
        )),
    })
}
