//! The levels of a robustness sweep: disturbances under which a motion is run again, as a lab file states them and in words.

use kinemark_sim::text::number::{seconds, trimmed};
use kinemark_sim::ticks::whole_ratio;
use schemars::JsonSchema;
use serde::Deserialize;

use super::reading::{At, MotionReading};
use crate::task::problem::{LabError, problems};

/// Control periods by which a command may be late.
const MOST_DELAY_PERIODS: u64 = 1000;
/// Above this, only numbers blow up.
const MOST_AMOUNT: f64 = 1e6;

/// A level: at least one disturbance.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct LevelTable {
    /// Shown in reports; lower-case letters, digits and `-`.
    pub(super) name: At<String>,
    /// The weight of the level; 1 where it is left out.
    share: Option<At<f64>>,
    /// Normal noise on what is measured.
    noise: Option<At<NoiseTable>>,
    /// Commands reach the servo this much later \[ms\]: 1 to 1000 whole control periods.
    delay_ms: Option<At<f64>>,
    /// A point mass at the TCP, fixed to the TCP's link \[kg\].
    payload_kg: Option<At<f64>>,
    /// Additional dry friction in every joint that moves \[N m, or N of a prismatic joint\].
    friction_n_m: Option<At<f64>>,
    /// Factor of every joint's viscous damping; refused for a robot without any.
    damping: Option<At<f64>>,
}

/// Standard deviations.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct NoiseTable {
    /// On measured positions \[rad, or m\].
    #[serde(default)]
    q_rad: f64,
    /// On measured velocities \[rad/s, or m/s\].
    #[serde(default)]
    qd_rad_s: f64,
}

problems! {
    /// What is wrong with a level.
    enum LevelProblem {
        Delay { delay_ms: f64, period_ms: String, nearest_ms: String }:
            "lab::periods", "a delay of {delay_ms} ms is not 1 to {MOST_DELAY_PERIODS} whole control periods of {period_ms} ms",
            "does not divide", format!("the nearest delay that fits is {nearest_ms} ms");
        Noise { q_rad: f64, qd_rad_s: f64 }:
            "lab::out_of_range", "noise is up to 1000 and not all zero, got q_rad = {q_rad} and qd_rad_s = {qd_rad_s}", "this noise",
            "such as `noise = { q_rad = 1e-4, qd_rad_s = 1e-2 }`";
        TooMuch { what: &'static str, value: f64 }:
            "lab::out_of_range", "{what} is at most 1e6, got {value:e}", "out of range";
        NoDamping { robot: String }:
            "lab::robustness", "robot `{robot}` has no damping that could be multiplied", "changes nothing",
            "add dry friction instead, such as `friction_n_m = 0.3`";
        Nothing { rung: String }:
            "lab::robustness", "level `{rung}` changes nothing", "this level",
            "give it `noise`, `delay_ms`, `payload_kg`, `friction_n_m` or `damping`";
    }
}

/// One level: the disturbance under which the motion is run again. It is the same for every submission.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Unique in its sweep.
    pub name: String,
    /// How much it counts against the others; positive.
    pub share: f64,
    /// Standard deviation of the noise on measured joint positions \[rad or m\].
    pub q_noise: f64,
    /// Standard deviation of the noise on measured joint velocities \[rad/s or m/s\].
    pub qd_noise: f64,
    /// By how many control periods commands are late.
    pub delay_periods: u32,
    /// The same as a time \[s\].
    pub delay_s: f64,
    /// Mass at the TCP that is not in the submission's model \[kg\].
    pub payload_kg: f64,
    /// Dry friction that every joint has more \[N m or N\].
    pub friction: f64,
    /// Factor of every joint's viscous damping, where it changes.
    pub damping: Option<f64>,
}

impl Level {
    /// What is different, in words: `commands 0.01 s late, 0.2 kg more at the TCP`.
    pub fn in_words(&self) -> String {
        let mut parts = Vec::new();
        let noises = [(self.q_noise, "rad on q"), (self.qd_noise, "rad/s on qd")];
        let noises = noises.iter().filter(|(noise, _)| *noise > 0.0);
        let noises: Vec<String> = noises
            .map(|(noise, what)| format!("{noise} {what}"))
            .collect();
        if !noises.is_empty() {
            parts.push(format!("noise of {}", noises.join(" and ")));
        }
        if self.delay_periods > 0 {
            parts.push(format!("commands {} late", seconds(self.delay_s)));
        }
        if self.payload_kg > 0.0 {
            let mass = trimmed(self.payload_kg, 4);
            parts.push(format!("{mass} kg more at the TCP"));
        }
        if self.friction > 0.0 {
            let friction = trimmed(self.friction, 4);
            parts.push(format!("{friction} N m more friction in every joint"));
        }
        if let Some(factor) = self.damping {
            let factor = trimmed(factor, 4);
            parts.push(format!("{factor} times the damping"));
        }
        parts.join(", ")
    }
}

impl LevelTable {
    /// The level that is typed in this table.
    pub(super) fn read(typed: &At<Self>, reading: &MotionReading<'_>) -> Result<Level, LabError> {
        let table = typed.get_ref();
        let (delay_periods, delay_s) = table.delay(reading)?;
        let (q_noise, qd_noise) = table.noise(reading)?;
        let amount = |typed: &Option<At<f64>>, what: &'static str| {
            let amount = typed.as_ref().map(|number| amount(reading, number, what));
            amount.transpose()
        };
        let level = Level {
            name: table.name.get_ref().clone(),
            share: amount(&table.share, "`share`")?.unwrap_or(1.0),
            q_noise,
            qd_noise,
            delay_periods,
            delay_s,
            payload_kg: amount(&table.payload_kg, "`payload_kg`")?.unwrap_or(0.0),
            friction: amount(&table.friction_n_m, "`friction_n_m`")?.unwrap_or(0.0),
            damping: amount(&table.damping, "`damping`")?,
        };
        let mut joints = reading.robot.joints().iter();
        let is_damped = joints.any(|joint| joint.damping > 0.0);
        if let Some(damping) = table.damping.as_ref().filter(|_| !is_damped) {
            let robot = reading.robot.name().to_owned();
            return reading.refuse_at(damping, LevelProblem::NoDamping { robot });
        }
        if level.in_words().is_empty() {
            let rung = level.name;
            return reading.refuse_at(typed, LevelProblem::Nothing { rung });
        }
        Ok(level)
    }
}

/// A positive number with which a run stays within what numbers can hold.
fn amount(
    reading: &MotionReading<'_>,
    typed: &At<f64>,
    what: &'static str,
) -> Result<f64, LabError> {
    let value = reading.report.positive(typed, what)?;
    if value > MOST_AMOUNT {
        return reading.refuse_at(typed, LevelProblem::TooMuch { what, value });
    }
    Ok(value)
}

impl LevelTable {
    /// How late commands are, in control periods and in seconds.
    fn delay(&self, reading: &MotionReading<'_>) -> Result<(u32, f64), LabError> {
        let Some(delay_ms) = &self.delay_ms else {
            return Ok((0, 0.0));
        };
        let delay_s = reading.report.positive(delay_ms, "`delay_ms`")? / 1000.0;
        let period_s = reading.motion.periods.control_s();
        if let Some(periods) = whole_ratio(delay_s, period_s)
            && periods <= MOST_DELAY_PERIODS
        {
            return Ok((periods as u32, delay_s));
        }
        let nearest = (delay_s / period_s).round().max(1.0);
        let nearest_ms = nearest.min(MOST_DELAY_PERIODS as f64) * period_s * 1e3;
        let problem = LevelProblem::Delay {
            delay_ms: *delay_ms.get_ref(),
            period_ms: trimmed(period_s * 1e3, 6),
            nearest_ms: trimmed(nearest_ms, 6),
        };
        reading.refuse_at(delay_ms, problem)
    }

    /// Standard deviations of the noise on positions and velocities.
    fn noise(&self, reading: &MotionReading<'_>) -> Result<(f64, f64), LabError> {
        let Some(noise) = &self.noise else {
            return Ok((0.0, 0.0));
        };
        let NoiseTable { q_rad, qd_rad_s } = *noise.get_ref();
        let fits = |x: f64| (0.0..=1e3).contains(&x);
        if fits(q_rad) && fits(qd_rad_s) && q_rad + qd_rad_s > 0.0 {
            return Ok((q_rad, qd_rad_s));
        }
        let problem = LevelProblem::Noise { q_rad, qd_rad_s };
        reading.refuse_at(noise, problem)
    }
}

#[cfg(test)]
mod tests {
    use super::Level;

    #[test]
    fn a_level_says_all_that_is_different() {
        let level = Level {
            name: "all".to_owned(),
            share: 1.0,
            q_noise: 1e-4,
            qd_noise: 0.01,
            delay_periods: 2,
            delay_s: 0.02,
            payload_kg: 0.2,
            friction: 0.3,
            damping: Some(1.3),
        };
        assert_eq!(
            level.in_words(),
            "noise of 0.0001 rad on q and 0.01 rad/s on qd, commands 0.02 s late, 0.2 kg more at the TCP, \
             0.3 N m more friction in every joint, 1.3 times the damping"
        );
    }
}
