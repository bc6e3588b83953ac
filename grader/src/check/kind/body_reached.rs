//! body-reached: a dynamic body of the scene stands at a place for the last part of the run.
//!
//! Measured is the greatest distance of the body's origin from the place over the last `hold_s` \[m\]. A body that tilts further than
//! `upright_deg` in that time, or with `released` one that the arm still touches, earns nothing.

use nalgebra::Vector3;

use crate::check::prelude::*;
use crate::task::watched::TouchingParty;

problems! {
    /// A tilt that no body can have.
    enum TiltProblem {
        Range { degrees: f64 }:
            "lab::body_reached", "`upright_deg` is above 0 and at most 180, got {degrees}", "this angle",
            "20 lets a body lean a little; leave it out where it may lie";
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
            released: self.released,
        };
        reading.in_band([self.full_m, self.zero_m], "m", measure)
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
        let up = -facts.motion.gravity_m_s2;
        let up = if up.norm() > 0.0 {
            up.normalize()
        } else {
            Vector3::z()
        };
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
            format!("Open the hand and move it away from `{name}` sooner."),
        ))
    }
}
