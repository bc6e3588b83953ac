//! A law of motion of one joint as a lab file has it: one of five kinds.

use kinemark_sim::trajectory::{JointLaw, Limits, Sine, SplineEnds, TrajectoryError};
use schemars::JsonSchema;
use serde::Deserialize;

/// Exactly one kind of law.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LawOf {
    /// At rest here \[rad, or m of a prismatic joint\].
    pub(crate) constant: Option<f64>,
    /// `[c0, c1, c2, ...]`: `c0 + c1 t + c2 t² + ...`.
    pub(crate) polynomial: Option<Vec<f64>>,
    /// `offset + amplitude sin(ω t + phase)`.
    pub(crate) sine: Option<SineTable>,
    /// From rest to rest with a trapezoidal velocity.
    pub(crate) trapezoid: Option<TrapezoidTable>,
    /// A cubic spline.
    pub(crate) table: Option<TimesTable>,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SineTable {
    /// Greatest distance from the offset \[rad, or m of a prismatic joint\].
    amplitude: f64,
    /// Angular frequency `ω` \[rad/s\].
    angular_frequency_rad_s: f64,
    /// Phase at time zero \[rad\]; 0 where it is left out.
    #[serde(default)]
    phase_rad: f64,
    /// Position about which it swings; 0 where it is left out.
    #[serde(default)]
    offset: f64,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TrapezoidTable {
    /// Where it starts.
    from: f64,
    /// Where it ends.
    to: f64,
    /// Greatest speed \[rad/s, or m/s of a prismatic joint\].
    speed: f64,
    /// Acceleration and deceleration \[rad/s², or m/s² of a prismatic joint\].
    acceleration: f64,
    /// When it starts \[s\]; 0 where it is left out.
    #[serde(default)]
    start_s: f64,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TimesTable {
    /// Times \[s\], each after the one before.
    times_s: Vec<f64>,
    /// Positions at these times.
    positions: Vec<f64>,
    /// `rest`: it starts and ends at rest; `natural`: without acceleration; `rest` where it is left out.
    #[serde(default)]
    ends: EndsTable,
}

/// How a spline starts and ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum EndsTable {
    #[default]
    Rest,
    Natural,
}

impl LawOf {
    /// The law; `None` unless exactly one kind is given.
    pub(crate) fn law(&self) -> Option<Result<JointLaw, TrajectoryError>> {
        let Self {
            constant,
            polynomial,
            sine,
            trapezoid,
            table,
        } = self;
        Some(match (constant, polynomial, sine, trapezoid, table) {
            (Some(position), None, None, None, None) => JointLaw::constant(*position),
            (None, Some(coefficients), None, None, None) => JointLaw::polynomial(coefficients),
            (None, None, Some(sine), None, None) => JointLaw::sine(Sine {
                amplitude: sine.amplitude,
                angular_frequency_rad_s: sine.angular_frequency_rad_s,
                phase_rad: sine.phase_rad,
                offset: sine.offset,
            }),
            (None, None, None, Some(trapezoid), None) => {
                let limits = Limits {
                    speed: trapezoid.speed,
                    acceleration: trapezoid.acceleration,
                };
                let (from, to) = (trapezoid.from, trapezoid.to);
                JointLaw::trapezoid(from, to, &limits, trapezoid.start_s)
            }
            (None, None, None, None, Some(table)) => {
                let ends = match table.ends {
                    EndsTable::Rest => SplineEnds::AT_REST,
                    EndsTable::Natural => SplineEnds::Natural,
                };
                JointLaw::table(&table.times_s, &table.positions, ends)
            }
            _ => return None,
        })
    }
}
