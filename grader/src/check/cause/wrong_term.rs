//! A term of a feedback law that works against the others: a brake that pushes, a brake beside which the error hardly pulls, a
//! compensation of gravity with the wrong sign or twice. It is read from what `control` returned.

use kinemark_sim::text::number::{seconds, trimmed};

use super::Law;
use crate::check::shape::Seen;
use crate::check::step_response::Response;

/// How near a whole number of compensations is.
const NEAR: f64 = 0.1;
/// Time in which a brake that pushes shows \[s\].
const SHOWS_S: f64 = 0.05;
/// A joint with such a time constant, as a share of the run, still has `exp(-1 / 0.5)`, an eighth of its way, before it at the end.
const CREEPS: f64 = 0.5;

/// A law whose effort grows with the speed of its own joint.
pub(in crate::check) fn speed_term(response: &Response<'_>) -> Option<Seen> {
    let law = Law::of(response)?;
    // what is no more than rounding pushes nothing
    if law.speed <= 1e-3 * law.error.abs() || law.error <= 0.0 {
        return None;
    }
    let units = response.asked.units;
    let tick = (SHOWS_S / response.facts.motion.periods.step_s) as usize;
    Some(Seen {
        words: format!(
            "what `control` returns for joint `{}` grows by {} {} for each {} of its speed, so it pushes a motion on and does not brake it",
            response.name(),
            trimmed(law.speed, 3),
            units.effort(),
            units.speed(),
        ),
        tick: tick.min(response.facts.last_tick()),
        next_step: "Which sign has the term with the speed? It should act against the motion."
            .to_owned(),
    })
}

/// A law whose brake is so strong beside its pull that the joint creeps for as long as the run lasts.
pub(in crate::check) fn creeping_law(response: &Response<'_>) -> Option<Seen> {
    let law = Law::of(response)?;
    let brake = -law.speed;
    if law.error <= 0.0 || brake <= 0.0 {
        return None;
    }
    // where the brake outweighs the inertia, the error shrinks by e in this time
    let constant_s = brake / law.error;
    let last = response.facts.last_tick();
    let run_s = response.facts.time_s(last);
    if constant_s < CREEPS * run_s {
        return None;
    }
    let units = response.asked.units;
    let mut words = format!(
        "what `control` returns for joint `{}` pulls with {} {} for each {} of error and brakes with {} {} for each {} of speed, so an \
         error shrinks with a time constant of {}",
        response.name(),
        trimmed(law.error, 1),
        units.effort(),
        units.position(),
        trimmed(brake, 1),
        units.effort(),
        units.speed(),
        seconds(constant_s),
    );
    let is = |value: f64, name: &str| {
        let asked = response.facts.motion.target_number(name);
        asked.is_some_and(|it| (value - it).abs() <= 0.01 * it.abs())
    };
    if is(law.error, "kd") && is(brake, "kp") {
        words += "; these are the `kd` and the `kp` of the target, the other way round";
    }
    Some(Seen {
        words,
        tick: last,
        next_step: "Which of your gains stands before the error, and which before the speed?"
            .to_owned(),
    })
}

/// A law that adds gravity with the wrong sign, or twice: what is seen, and what to ask.
pub(in crate::check) fn gravity_term(response: &Response<'_>) -> Option<(String, String)> {
    let law = Law::of(response)?;
    let is = |times: f64| (law.gravity - times).abs() <= NEAR;
    if is(-1.0) {
        Some((
            "`control` adds as much in the direction in which gravity already pulls".to_owned(),
            "Which way does gravity pull the joint there, and which way does the term that you add?"
                .to_owned(),
        ))
    } else if is(2.0) {
        Some((
            "what `control` adds is twice as much".to_owned(),
            "How often is gravity in what you return? With a model of your own: is a mass or its lever arm too large?"
                .to_owned(),
        ))
    } else {
        None
    }
}
