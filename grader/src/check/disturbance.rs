//! The levels of a robustness sweep: disturbances under which a motion is run again, as a lab file states them and in words.

use kinemark_sim::kinematics::closure::{closed_positions, closed_velocities};
use kinemark_sim::model::push::Push;
use kinemark_sim::text::number::{seconds, trimmed};
use kinemark_sim::ticks::whole_ratio;
use schemars::JsonSchema;
use serde::Deserialize;

use super::reading::{At, MotionReading};
use crate::task::joint_units::JointUnits;
use crate::task::problem::{LabError, problems};
use crate::task::push::{PushReading, PushTable};

/// Control periods by which a command may be late.
const MOST_DELAY_PERIODS: u64 = 1000;
/// Above this, only numbers blow up.
const MOST_AMOUNT: f64 = 1e6;
/// No start is farther off, in SI units.
const MOST_OFFSET: f64 = 1e3;

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
    /// Pushes on links and bodies, besides those of the task.
    #[serde(default)]
    pushes: Vec<At<PushTable>>,
    /// How far the start is off: one number per joint that moves, or per independent joint of a robot with loops \[rad, or m\].
    start_offset_rad: Option<At<Vec<f64>>>,
    /// How far the velocities at the start are off, in the same joints \[rad/s, or m/s\].
    start_offset_rad_s: Option<At<Vec<f64>>>,
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
            "give it `noise`, `delay_ms`, `payload_kg`, `friction_n_m`, `damping`, `pushes` or `start_offset_rad`";
        Offsets { what: &'static str, found: usize, n: usize, joints: Vec<String> }:
            "lab::joint_count", "`{what}` has a length of {found} for {n} joints", "one number per joint",
            format!("joints: {}", joints.join(", "));
        Offset { what: &'static str }:
            "lab::out_of_range", "a number of `{what}` is beyond 1000", "out of range";
        Unclosed { error: String }:
            "lab::start", "with this offset a loop stays open: {error}", "no place where the robot can be",
            "choose a smaller offset";
        OfLaws:
            "lab::start", "in mode `prescribed` the robot starts where its laws say", "of no effect", "leave it out";
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
    /// Pushes besides those of the task.
    pub pushes: Vec<(String, Push)>,
    /// Another start, where it changes.
    pub start: Option<LevelStart>,
}

/// The start of a run under a level.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelStart {
    /// Joint positions, shape `(n)` \[rad or m\].
    pub q: Vec<f64>,
    /// Joint velocities, shape `(n)` \[rad/s or m/s\].
    pub qd: Vec<f64>,
    /// By what it is off: a joint, a number and its unit each.
    pub offsets: Vec<(String, f64, &'static str)>,
}

impl Level {
    /// Whether a run under `other` is the same: the share may differ, and the name where there is no noise, whose seed it is.
    pub fn is_same_run(&self, other: &Self) -> bool {
        let is_noisy = self.q_noise > 0.0 || self.qd_noise > 0.0;
        let renamed = Self {
            name: if is_noisy { &self.name } else { &other.name }.clone(),
            share: other.share,
            ..self.clone()
        };
        renamed == *other
    }

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
        let pushes = self.pushes.iter();
        parts.extend(pushes.map(|(words, _)| words.clone()));
        let offsets = self.start.iter().flat_map(|start| &start.offsets);
        let offsets = offsets.map(|(joint, off, unit)| format!("{off:+} {unit} at `{joint}`"));
        let offsets: Vec<String> = offsets.collect();
        if !offsets.is_empty() {
            parts.push(format!("started {}", offsets.join(" and ")));
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
            // times one is as it was
            damping: amount(&table.damping, "`damping`")?
                .filter(|factor| (factor - 1.0).abs() > 0.0),
            pushes: table.pushes(reading)?,
            start: table.start(reading)?,
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

    /// The pushes of the level, in words each.
    fn pushes(&self, reading: &MotionReading<'_>) -> Result<Vec<(String, Push)>, LabError> {
        let motion = reading.motion;
        let pushes = PushReading {
            report: reading.report,
            robot: reading.robot,
            scene: motion.scene.as_deref(),
            periods: &motion.periods,
            ticks: motion.ticks,
        };
        let words = self.pushes.iter().map(|push| push.get_ref().in_words());
        Ok(words.zip(pushes.all(&self.pushes)?).collect())
    }

    /// The start of the level, where it is another one.
    fn start(&self, reading: &MotionReading<'_>) -> Result<Option<LevelStart>, LabError> {
        let typed = [&self.start_offset_rad, &self.start_offset_rad_s];
        let Some(first) = typed.into_iter().flatten().next() else {
            return Ok(None);
        };
        if reading.motion.laws.is_some() {
            return reading.refuse_at(first, LevelProblem::OfLaws);
        }
        let robot = reading.robot;
        let q_off = offsets(reading, typed[0].as_ref(), "start_offset_rad")?;
        let qd_off = offsets(reading, typed[1].as_ref(), "start_offset_rad_s")?;
        let moved = |of: &[f64], by: &[f64]| -> Vec<f64> {
            let independent = robot.independent().iter().zip(by);
            independent.map(|(&joint, by)| of[joint] + by).collect()
        };
        let unclosed = |error: String| LevelProblem::Unclosed { error };
        let q = moved(&reading.motion.start_q, &q_off);
        let q = closed_positions(robot, &q)
            .or_else(|error| reading.refuse_at(first, unclosed(error.to_string())))?;
        let qd = moved(&reading.motion.start_qd, &qd_off);
        let qd = closed_velocities(robot, &q, &qd)
            .or_else(|error| reading.refuse_at(first, unclosed(error.to_string())))?;
        let mut said = Vec::new();
        for (row, &joint) in robot.independent().iter().enumerate() {
            let units = JointUnits::of(robot, joint);
            let name = robot.moving_joints().nth(joint).map(|joint| &joint.name);
            let parts = [(q_off[row], units.position()), (qd_off[row], units.speed())];
            for (off, unit) in parts.into_iter().filter(|(off, _)| off.abs() > 0.0) {
                said.push((name.cloned().unwrap_or_default(), off, unit));
            }
        }
        let offsets = said;
        Ok((!offsets.is_empty()).then_some(LevelStart { q, qd, offsets }))
    }
}

/// Offsets of the independent joints, zero where none are typed.
fn offsets(
    reading: &MotionReading<'_>,
    typed: Option<&At<Vec<f64>>>,
    what: &'static str,
) -> Result<Vec<f64>, LabError> {
    let robot = reading.robot;
    let independent = robot.independent();
    let Some(typed) = typed else {
        return Ok(vec![0.0; independent.len()]);
    };
    let numbers = typed.get_ref();
    if numbers.len() != independent.len() {
        let joints = independent.iter().filter_map(|&joint| {
            let mut moving = robot.moving_joints();
            moving.nth(joint).map(|joint| joint.name.clone())
        });
        let problem = LevelProblem::Offsets {
            what,
            found: numbers.len(),
            n: independent.len(),
            joints: joints.collect(),
        };
        return reading.refuse_at(typed, problem);
    }
    if numbers.iter().any(|number| number.abs() > MOST_OFFSET) {
        return reading.refuse_at(typed, LevelProblem::Offset { what });
    }
    Ok(numbers.clone())
}

#[cfg(test)]
mod tests {
    use super::{Level, LevelStart};

    #[test]
    fn runs_are_the_same_where_nothing_but_names_and_shares_differ() {
        let level = with_everything();
        let named = |level: &Level| Level {
            name: "another".to_owned(),
            share: 2.0,
            ..level.clone()
        };
        let quiet = Level {
            q_noise: 0.0,
            qd_noise: 0.0,
            ..level.clone()
        };
        assert!(quiet.is_same_run(&named(&quiet)));
        assert!(!level.is_same_run(&named(&level)), "another seed");
        let share = Level {
            share: 3.0,
            ..level.clone()
        };
        assert!(level.is_same_run(&share));
        let heavier = Level {
            payload_kg: 0.3,
            ..quiet.clone()
        };
        assert!(!quiet.is_same_run(&heavier));
        let at_rest = Level {
            start: None,
            ..quiet.clone()
        };
        assert!(!quiet.is_same_run(&at_rest));
    }

    #[test]
    fn a_level_says_all_that_is_different() {
        let level = with_everything();
        assert_eq!(
            level.in_words(),
            "noise of 0.0001 rad on q and 0.01 rad/s on qd, commands 0.02 s late, 0.2 kg more at the TCP, \
             0.3 N m more friction in every joint, 1.3 times the damping, started +0.2 rad/s at `shoulder` and -0.05 rad at `elbow`"
        );
    }

    fn with_everything() -> Level {
        Level {
            name: "all".to_owned(),
            share: 1.0,
            q_noise: 1e-4,
            qd_noise: 0.01,
            delay_periods: 2,
            delay_s: 0.02,
            payload_kg: 0.2,
            friction: 0.3,
            damping: Some(1.3),
            pushes: Vec::new(),
            start: Some(LevelStart {
                q: vec![0.7, -1.0],
                qd: vec![0.2, 0.0],
                offsets: vec![
                    ("shoulder".to_owned(), 0.2, "rad/s"),
                    ("elbow".to_owned(), -0.05, "rad"),
                ],
            }),
        }
    }
}
