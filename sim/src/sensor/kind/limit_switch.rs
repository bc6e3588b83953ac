//! limit-switch: 1 while a joint is at a position or beyond it, else 0; while it is pressed, the motor cannot push on.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::model::robot::Robot;
use crate::model::sensor::{Gauge, Measured, Seen, SensorKind, Surroundings, moved_by};
use crate::part::part_problem::PartError;
use crate::part::part_tables::NumberAt;
use crate::part::toml_text::quoted;
use crate::part::values::Allowed;
use crate::sensor::registry::{KindTable, SensorReading};
use crate::text::Spanned;

/// How far from a joint's limit a switch at that limit is already pressed \[rad or m\]: contact may hold a joint a
/// tenth of this away from its stop.
const SWITCH_TRAVEL: f64 = 1e-6;

/// The side to which a switch is pressed.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
enum Side {
    /// Towards lesser positions.
    Lower,
    /// Towards greater positions.
    Upper,
}

impl Side {
    fn name(self) -> &'static str {
        match self {
            Self::Lower => "lower",
            Self::Upper => "upper",
        }
    }
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Table {
    /// The joint that presses it.
    joint: Spanned<String>,
    /// Where it starts to be pressed \[rad or m\]; the joint's limit on that side where it is left out.
    at: Option<NumberAt>,
    /// On which side of `at` it is pressed.
    side: Side,
    /// Whether the motor gives no effort towards its side while it is pressed; true where it is left out.
    opens_motor: Option<bool>,
    /// How far the joint goes back before it is released \[rad or m\]; 0 where it is left out.
    hysteresis: Option<NumberAt>,
    /// Whether it stays pressed until the motor has driven the joint away; false where it is left out.
    latch: Option<bool>,
}

impl KindTable for Table {
    const NAME: &'static str = "limit-switch";
    const IS_NOISY: bool = false;
    #[cfg(test)]
    const EXAMPLE: &'static str = "joint = 'elbow'\nside = 'lower'\nat = -0.25\nopens_motor = false\nhysteresis = 0.01\nlatch = true";
    type Kind = LimitSwitch;

    fn read(&self, reading: &SensorReading<'_>) -> Result<LimitSwitch, PartError> {
        let (index, joint) = reading.moving_joint(&self.joint)?;
        let limit = match self.side {
            Side::Lower => joint.limits.lower.map(|limit| limit + SWITCH_TRAVEL),
            Side::Upper => joint.limits.upper.map(|limit| limit - SWITCH_TRAVEL),
        };
        let at = match (&self.at, limit) {
            (Some(number), _) => reading.values.number(number, "at", Allowed::Any)?,
            (None, Some(limit)) => limit,
            (None, None) => {
                let (joint, side) = (&joint.name, self.side.name());
                return reading.refuse(
                    self.joint.span(),
                    format!("joint `{joint}` has no {side} limit to put a switch at"),
                    format!("say where with `at`, or give the joint a limit `{side}`"),
                );
            }
        };
        Ok(LimitSwitch {
            joint: index,
            at,
            side: self.side,
            opens_motor: self.opens_motor.unwrap_or(true),
            hysteresis: reading.values.number_or(
                self.hysteresis.as_ref(),
                "hysteresis",
                Allowed::NotNegative,
                0.0,
            )?,
            latches: self.latch.unwrap_or(false),
        })
    }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct LimitSwitch {
    /// Index among all joints.
    joint: usize,
    /// Where it starts to be pressed \[rad or m\].
    at: f64,
    /// To which side it goes on being pressed.
    side: Side,
    /// Whether it opens the motor's circuit: pressed, it leaves no effort towards its side.
    opens_motor: bool,
    /// How far the joint goes back before it is released, zero or more \[rad or m\].
    hysteresis: f64,
    /// Whether, once pressed, it stays so until the motor has driven the joint away.
    latches: bool,
}

impl LimitSwitch {
    /// Whether a joint at `position` \[rad or m\] presses it; never for NaN.
    fn is_pressed_at(&self, position: f64) -> bool {
        match self.side {
            Side::Lower => position <= self.at,
            Side::Upper => position >= self.at,
        }
    }

    /// Whether a joint at `position` keeps it pressed, once it is; never for NaN.
    fn is_kept_at(&self, position: f64) -> bool {
        match self.side {
            Side::Lower => position <= self.at + self.hysteresis,
            Side::Upper => position >= self.at - self.hysteresis,
        }
    }
}

impl SensorKind for LimitSwitch {
    fn measured(&self) -> Measured {
        Measured::Switch
    }

    fn unit(&self, _: &Robot, _: usize) -> &'static str {
        ""
    }

    fn keys(&self, robot: &Robot) -> String {
        let joint = quoted(&robot.joints()[self.joint].name);
        let (at, side) = (self.at, self.side.name());
        let opens = if self.opens_motor {
            ""
        } else {
            "opens_motor = false\n"
        };
        let hysteresis = match self.hysteresis {
            h if h > 0.0 => format!("hysteresis = {h:?}\n"),
            _ => String::new(),
        };
        let latch = if self.latches { "latch = true\n" } else { "" };
        format!("joint = {joint}\nat = {at:?}\nside = \"{side}\"\n{opens}{hysteresis}{latch}")
    }

    fn gauge(&self, robot: &Robot, _: f64) -> Box<dyn Gauge> {
        let body = moved_by(robot, self.joint);
        Box::new(Circuit {
            switch: *self,
            pressed: false,
            motor: body.map(|body| {
                let outwards = match self.side {
                    Side::Lower => -body.gear,
                    Side::Upper => body.gear,
                };
                (body.q_index, outwards)
            }),
        })
    }
}

/// A switch at work. Noise, rate and delay do not matter to its circuit: what counts is the position at the last tick.
struct Circuit {
    switch: LimitSwitch,
    pressed: bool,
    /// The joint's motor: its entry in `q`, and a number that is positive where positive efforts push
    /// towards the switch. A mimic joint's motor is its master's.
    motor: Option<(usize, f64)>,
}

impl Gauge for Circuit {
    fn watch(&mut self, seen: &Seen<'_>) {
        let body = moved_by(seen.robot, self.switch.joint);
        self.pressed = body.is_some_and(|body| {
            let position = body.position(seen.q);
            let held = self.pressed && (self.switch.is_kept_at(position) || !self.resets(seen));
            self.switch.is_pressed_at(position) || held
        });
    }

    fn read(&mut self, _: &Seen<'_>, _: &dyn Surroundings, values: &mut [f64]) {
        values[0] = f64::from(u8::from(self.pressed));
    }

    fn open_motor(&self, effort: &mut [f64]) {
        if let (Some((entry, outwards)), true) =
            (self.motor, self.pressed && self.switch.opens_motor)
            && outwards * effort[entry] > 0.0
        {
            effort[entry] = 0.0;
        }
    }
}

impl Circuit {
    /// Whether it is released once the joint is away: at once, or where it latches after a step in which the motor drove away from it.
    fn resets(&self, seen: &Seen<'_>) -> bool {
        !self.switch.latches
            || self
                .motor
                .is_some_and(|(entry, outwards)| outwards * seen.effort[entry] < 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_switch_is_pressed_at_its_place_and_beyond() {
        let mut switch = LimitSwitch {
            joint: 0,
            at: 0.25,
            side: Side::Upper,
            opens_motor: true,
            hysteresis: 0.0,
            latches: false,
        };
        for (position, upper, lower) in [
            (0.249, false, true),
            (0.25, true, true),
            (7.0, true, false),
            (f64::NAN, false, false),
        ] {
            switch.side = Side::Upper;
            assert_eq!(switch.is_pressed_at(position), upper, "{position}");
            switch.side = Side::Lower;
            assert_eq!(switch.is_pressed_at(position), lower, "{position}");
        }
    }
}
