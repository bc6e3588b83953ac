//! A feedback law that steers a joint to another place than the one that was asked for, such as the target in degrees. It is read from
//! what `control` returned.

use std::f64::consts::PI;

use super::law::setpoint;
use crate::check::shape::Seen;
use crate::check::step_response::Response;

/// Numbers that are the same, as a share.
const SAME: f64 = 0.01;
/// A setpoint is another one than the target from this share of the way on.
const LEAST_SHARE: f64 = 0.05;

/// A law whose setpoint is not the target.
pub(in crate::check) fn wrong_setpoint(response: &Response<'_>) -> Option<Seen> {
    let target = response.asked.target?;
    let way = target - response.start;
    let setpoint = setpoint(response)?;
    if (setpoint - target).abs() <= LEAST_SHARE * way.abs() {
        return None;
    }
    let is = |value: f64| (setpoint - value).abs() <= SAME * value.abs();
    let (what, question) = if is(target * 180.0 / PI) {
        (
            format!(", which is {} in degrees", response.with_unit(target)),
            "In which unit is your setpoint? The arm measures radians.",
        )
    } else if is(target * PI / 180.0) {
        (
            format!(", which is {} taken as degrees", response.with_unit(target)),
            "In which unit is the target given? It is in radians already.",
        )
    } else {
        // a push that stands against gravity looks like another setpoint, and ends near the target
        let [to_setpoint, to_target] = [setpoint, target].map(|to| (response.end - to).abs());
        if to_setpoint.is_nan() || to_setpoint >= to_target {
            return None;
        }
        (
            format!("; {} was asked for", response.with_unit(target)),
            "Which terms of your law depend on what is measured, and what do you subtract it from? Together they are 0 there.",
        )
    };
    Some(Seen {
        words: format!(
            "what `control` returns is 0 where {} is {}{what}",
            response.what(),
            response.with_unit(setpoint)
        ),
        tick: 0,
        next_step: question.to_owned(),
    })
}
