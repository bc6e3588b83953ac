//! body-reached: a dynamic body of the scene stands at a place for the last part of the run.
//!
//! Measured is the greatest distance of the body's origin from the place over the last `hold_s` \[m\]. A body that tilts further than
//! `upright_deg` in that time, or is not turned as `turned_deg` says, or with `released` one that the arm still touches, earns nothing.
//! How a body is turned is measured about the vertical, from how it stood at the start.

use nalgebra::Vector3;

use crate::check::prelude::*;
use crate::task::watched::TouchingParty;

problems! {
    /// A tilt or a turn that no body can have.
    enum TiltProblem {
        Range { degrees: f64 }:
            "lab::body_reached", "`upright_deg` is above 0 and at most 180, got {degrees}", "this angle",
            "20 lets a body lean a little; leave it out where it may lie";
        Turned { degrees: f64 }:
            "lab::body_reached", "`turned_deg` is within -360 and 360, got {degrees}", "this angle",
            "90 is a quarter turn counter-clockwise, seen from above";
        Within { degrees: f64, most: f64 }:
            "lab::body_reached", "`turned_within_deg` is above 0 and below {most}, half of what brings the body to itself, got {degrees}", "this angle",
            "5 asks for some care, 20 for little";
        Every { degrees: f64 }:
            "lab::body_reached", "`turned_every_deg` is above 0 and at most 360, got {degrees}", "this angle",
            "180 is that of a bar, 90 that of a cube; leave it out where every side looks different";
        Together:
            "lab::body_reached", "`turned_deg` and `turned_within_deg` are given together, and `turned_every_deg` only with them", "this check",
            "such as `turned_deg = 90.0, turned_within_deg = 10.0`";
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// A dynamic body of the scene.
    body: At<String>,
    /// Where its origin should be, in the lab's frame \[m\].
    position_m: [f64; 3],
    /// The part at the end of the run that counts \[s\]; a multiple of the physics step.
    hold_s: At<f64>,
    /// How far it may be tilted from how it stood at the start \[degrees\]; as far as it likes where it is left out.
    upright_deg: Option<At<f64>>,
    /// How far it should be turned about the vertical from how it stood at the start, counter-clockwise seen from above \[degrees\]; any
    /// way where it is left out.
    turned_deg: Option<At<f64>>,
    /// How far it may be off that \[degrees\].
    turned_within_deg: Option<At<f64>>,
    /// The turn after which it looks the same, such as 180 of a bar \[degrees\]; 360 where it is left out.
    turned_every_deg: Option<At<f64>>,
    /// Whether no link may touch it any more; false where it is left out.
    #[serde(default)]
    released: bool,
    /// Distance that earns all points \[m\].
    full_m: BandEnd,
    /// Distance that earns none \[m\].
    zero_m: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "body-reached";
    type Check = InBand<BodyReached>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let upright_rad = match &self.upright_deg {
            None => None,
            Some(typed) => {
                let degrees = *typed.get_ref();
                if !(degrees > 0.0 && degrees <= 180.0) {
                    return reading.refuse_at(typed, TiltProblem::Range { degrees });
                }
                Some(degrees.to_radians())
            }
        };
        let measure = BodyReached {
            body: reading.free_body(reading.scene(Self::NAME)?, &self.body)?,
            position_m: Vector3::from(self.position_m),
            hold_ticks: reading.ticks(&self.hold_s, "`hold_s`")? as usize,
            upright_rad,
            turn: self.turn(reading)?,
            released: self.released,
        };
        reading.in_band([self.full_m, self.zero_m], "m", measure)
    }
}

impl Table {
    /// How the body should be turned, if that counts.
    fn turn(&self, reading: &MotionReading<'_>) -> Result<Option<Turn>, LabError> {
        let (turned, within) = match (&self.turned_deg, &self.turned_within_deg) {
            (None, None) if self.turned_every_deg.is_none() => return Ok(None),
            (Some(turned), Some(within)) => (turned, within),
            _ => return reading.refuse(TiltProblem::Together),
        };
        let every_deg = match &self.turned_every_deg {
            None => 360.0,
            Some(typed) => {
                let degrees = *typed.get_ref();
                if !(degrees > 0.0 && degrees <= 360.0) {
                    return reading.refuse_at(typed, TiltProblem::Every { degrees });
                }
                degrees
            }
        };
        let (turned_deg, within_deg) = (*turned.get_ref(), *within.get_ref());
        if !(-360.0..=360.0).contains(&turned_deg) {
            let degrees = turned_deg;
            return reading.refuse_at(turned, TiltProblem::Turned { degrees });
        }
        let most = every_deg / 2.0;
        if !(within_deg > 0.0 && within_deg < most) {
            let degrees = within_deg;
            return reading.refuse_at(within, TiltProblem::Within { degrees, most });
        }
        Ok(Some(Turn {
            turned_rad: turned_deg.to_radians(),
            within_rad: within_deg.to_radians(),
            every_rad: every_deg.to_radians(),
        }))
    }
}

/// How a body should be turned about the vertical.
#[derive(Debug, Clone, Copy)]
struct Turn {
    /// From how it stood at the start \[rad\].
    turned_rad: f64,
    /// How far it may be off \[rad\].
    within_rad: f64,
    /// The turn after which it looks the same \[rad\].
    every_rad: f64,
}

impl Turn {
    /// How far a body that is turned by `angle_rad` is off \[rad\].
    fn off_rad(self, angle_rad: f64) -> f64 {
        let off = angle_rad - self.turned_rad;
        (off - libm::round(off / self.every_rad) * self.every_rad).abs()
    }
}

/// The distance of a body from a place.
#[derive(Debug)]
pub(crate) struct BodyReached {
    /// Index in the scene.
    body: usize,
    /// In the lab's frame \[m\].
    position_m: Vector3<f64>,
    /// Ticks at the end in which it must stand there.
    hold_ticks: usize,
    /// Greatest tilt \[rad\].
    upright_rad: Option<f64>,
    /// How it should be turned, if that counts.
    turn: Option<Turn>,
    /// Whether no link may touch it.
    released: bool,
}

impl RunMeasure for BodyReached {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let name = facts.names.body(self.body);
        let last = facts.last_tick();
        let first = last.saturating_sub(self.hold_ticks);
        let away_m = |tick: usize| {
            let at = facts.p_body_in_lab(self.body, tick);
            at.map_or(f64::NAN, |at| (at - self.position_m).norm())
        };
        let distances: Vec<f64> = (0..facts.trace.len()).map(away_m).collect();
        let place = list(self.position_m.as_slice());
        let quantity = format!("distance of `{name}` from {place}");
        let worst = greatest(distances[first..].iter().copied());
        let (worst, value) = worst.map_or((last, f64::NAN), |(i, value)| (first + i, value));
        let spoilt = self
            .tilted(facts, first)
            .or_else(|| self.turned(facts, first))
            .or_else(|| self.touched(facts, first));
        let mut finding = match &spoilt {
            None => Finding::against(band, value, "m", quantity),
            Some(_) => Finding::scored(0.0, measure(quantity, value, "m", [band.full, band.zero])),
        };
        if let Some((message, tick, next_step)) = spoilt {
            finding = finding
                .with(facts.evidence(message, format!("body {name}"), tick))
                .advise(next_step)
                .insisting();
        } else {
            finding = finding
                .shown_at(facts, || {
                    (self.message(facts, (first, worst), value), format!("body {name}"), worst)
                })
                .advise(format!(
                    "Where is `{name}` at the end, and where was it let go? Compare both with {place}."
                ));
        }
        let mut curve = facts.curve(
            format!("distance of `{name}` from its place"),
            "m",
            distances,
            band,
        );
        curve.marks = vec![(facts.time_s(first), "judged from here".to_owned())];
        finding.drawn(curve)
    }
}

impl BodyReached {
    /// Why points are lost: `value` off at tick `worst`, of those from `first` on.
    fn message(
        &self,
        facts: &MotionFacts<'_>,
        (first, worst): (usize, usize),
        value: f64,
    ) -> String {
        let name = facts.names.body(self.body);
        let at = |tick: usize| facts.p_body_in_lab(self.body, tick).unwrap_or_default();
        let last = facts.last_tick();
        if (at(last) - at(0)).norm() < 1e-3 && (at(0) - self.position_m).norm() > 1e-3 {
            return format!(
                "`{name}` is where it began at the end, at {}: it was to be at {}",
                list(at(last).as_slice()),
                list(self.position_m.as_slice()),
            );
        }
        format!(
            "`{name}` is at {}, {} from {}, at {}, within the last {} that count",
            list(at(worst).as_slice()),
            metres(value),
            list(self.position_m.as_slice()),
            seconds(facts.time_s(worst)),
            seconds(facts.time_s(last - first)),
        )
    }

    /// Where it tilts too far from `first` on: in words, when, and what to do.
    fn tilted(&self, facts: &MotionFacts<'_>, first: usize) -> Option<(String, usize, String)> {
        let most = self.upright_rad?;
        let up = up(facts);
        let start = facts.trace.world_from_body(self.body, 0)?;
        let up_in_body = start.inverse_transform_vector(&up);
        let tilt = |tick: usize| {
            let pose = facts.trace.world_from_body(self.body, tick)?;
            let cosine = pose.transform_vector(&up_in_body).dot(&up);
            Some(libm::acos(cosine.clamp(-1.0, 1.0)))
        };
        let tick =
            (first..=facts.last_tick()).find(|tick| tilt(*tick).is_some_and(|t| t > most))?;
        let name = facts.names.body(self.body);
        let [tilt, most] = [tilt(tick).unwrap_or_default(), most].map(f64::to_degrees);
        Some((
            format!(
                "`{name}` is tilted by {} degrees at {}, and by {} at most it may be",
                trimmed(tilt, 1),
                seconds(facts.time_s(tick)),
                trimmed(most, 1)
            ),
            tick,
            format!("Set `{name}` down upright, and let it go only when it stands."),
        ))
    }

    /// Where it is turned otherwise than it should be from `first` on: in words, when, and what to do.
    fn turned(&self, facts: &MotionFacts<'_>, first: usize) -> Option<(String, usize, String)> {
        let turn = self.turn?;
        let up = up(facts);
        let start = facts.trace.world_from_body(self.body, 0)?;
        // a direction that is level at the start shows how the body is turned
        let level = match up.cross(&Vector3::x()) {
            across if across.norm() > 0.5 => across.normalize(),
            _ => Vector3::y(),
        };
        let level_in_body = start.inverse_transform_vector(&level);
        let angle_rad = |tick: usize| {
            let pose = facts.trace.world_from_body(self.body, tick)?;
            let now = pose.transform_vector(&level_in_body);
            Some(libm::atan2(up.dot(&level.cross(&now)), level.dot(&now)))
        };
        let off_rad = |tick: usize| angle_rad(tick).map(|angle| turn.off_rad(angle));
        let tick = (first..=facts.last_tick())
            .find(|tick| off_rad(*tick).is_some_and(|off| off > turn.within_rad))?;
        let name = facts.names.body(self.body);
        let is_turned = angle_rad(tick).unwrap_or_default();
        // of the turns that look the same, the one nearest to what was asked for
        let whole = libm::round((is_turned - turn.turned_rad) / turn.every_rad) * turn.every_rad;
        let [is, asked, within] =
            [is_turned - whole, turn.turned_rad, turn.within_rad].map(f64::to_degrees);
        Some((
            format!(
                "`{name}` is turned by {} degrees from how it stood at {}: it was to be turned by {}, to {} degrees",
                trimmed(is, 1),
                seconds(facts.time_s(tick)),
                trimmed(asked, 1),
                trimmed(within, 1),
            ),
            tick,
            format!("How is the hand turned where it takes `{name}`, and how where it lets it go?"),
        ))
    }

    /// Where a link touches it from `first` on, if none may.
    fn touched(&self, facts: &MotionFacts<'_>, first: usize) -> Option<(String, usize, String)> {
        if !self.released {
            return None;
        }
        let (arm, body) = (TouchingParty::Arm, TouchingParty::Body(self.body));
        let mut contacts = facts.trace.contacts.iter();
        let span = contacts
            .find(|span| arm.meets(body, span.parties) && span.last_tick as usize >= first)?;
        let tick = (span.first_tick as usize).max(first);
        let name = facts.names.body(self.body);
        Some((
            format!(
                "the arm touches `{name}` at {}, within the last {} that count: it was to be let go by then",
                seconds(facts.time_s(tick)),
                seconds(facts.time_s(facts.last_tick() - first)),
            ),
            tick,
            format!("When is `{name}` set down, and what takes the arm away from it after that?"),
        ))
    }
}

/// The direction against gravity; z where there is none.
fn up(facts: &MotionFacts<'_>) -> Vector3<f64> {
    let up = -facts.motion.gravity_m_s2;
    if up.norm() > 0.0 {
        up.normalize()
    } else {
        Vector3::z()
    }
}

#[cfg(test)]
mod tests {
    use super::Turn;

    #[test]
    fn a_bar_looks_the_same_after_half_a_turn_and_a_cup_does_not() {
        let turn = |every_deg: f64| Turn {
            turned_rad: 90_f64.to_radians(),
            within_rad: 0.1,
            every_rad: every_deg.to_radians(),
        };
        let off = |every_deg: f64, deg: f64| turn(every_deg).off_rad(deg.to_radians()).to_degrees();
        for (every_deg, deg, expected) in [
            (360.0, 90.0, 0.0),
            (360.0, -90.0, 180.0),
            (360.0, -265.0, 5.0),
            (180.0, -90.0, 0.0),
            (180.0, 0.0, 90.0),
            (90.0, 40.0, 40.0),
            (90.0, -7.0, 7.0),
        ] {
            assert!(
                (off(every_deg, deg) - expected).abs() < 1e-9,
                "{every_deg} {deg}"
            );
        }
    }
}
