//! The operation `simulate`: its fields, what they must be, and the run they describe.

use kinemark_sim::control::{Derivative, GainLists, Mode, ServoError, ServoSettings};
use kinemark_sim::kinematics::closure::loop_gap_m;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::run;
use kinemark_sim::run::{End, Setup};
use kinemark_sim::ticks::{Periods, whole_ratio};
use serde::{Deserialize, Serialize};

use super::dynamics::gravity;
use super::joint_state::{efforts, positions, velocities, zeros_elsewhere};
use super::number_fields::{Numbers, positive};
use super::operation::{Operation, Subject};
use super::refusal::{Code, Refusal};
use super::simulation_record::{SampledRun, Sampler};
use crate::joint_names::joint_names;

/// More steps than this take minutes.
const MOST_STEPS: u64 = 100_000_000;
/// More numbers than this do not belong on one line.
const MOST_NUMBERS: u64 = 2_000_000;
/// A start counts as closed below this gap; the first step takes up what is left.
const MOST_GAP_M: f64 = 1e-6;

/// A run from a state under given commands, alone or in a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Simulate {
    /// Joint positions at the start \[rad or m\].
    pub q0: Numbers,
    /// Joint velocities at the start \[rad/s or m/s\].
    pub qd0: Numbers,
    /// One constant command, in the servo's mode.
    pub command: Option<Numbers>,
    /// In place of `command`: one for each period; the last one stands for the rest of the run.
    pub commands: Option<Vec<Vec<f64>>>,
    /// How long each of `commands` stands.
    pub command_period_s: Option<f64>,
    /// How long the run is.
    pub duration_s: f64,
    /// Time between two samples of the servo.
    pub servo_period_s: f64,
    /// The integrator's step; a millisecond, or the servo's period where that is shorter, if it is not given.
    pub physics_step_s: Option<f64>,
    /// Time between two rows of the answer.
    pub sample_period_s: f64,
    /// The joint servos.
    pub servo: ServoTable,
    /// Gravity in the world \[m/s²\]; not in a scene, which has its own.
    pub gravity_m_s2: Option<[f64; 3]>,
}

/// The joint servos; every number is one for all joints, or one per joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ServoTable {
    /// What commands are.
    pub mode: ServoMode,
    /// What the derivative term takes; the measurement where it is not given.
    pub derivative: Option<ServoDerivative>,
    /// Proportional gain.
    pub kp: Option<Numbers>,
    /// Integral gain.
    pub ki: Option<Numbers>,
    /// Derivative gain.
    pub kd: Option<Numbers>,
    /// Greatest effort, gravity compensation included \[N m or N\].
    pub effort_limit: Option<Numbers>,
    /// Bound of the integral term \[N m or N\].
    pub integral_limit: Option<Numbers>,
    /// Whether the effort that holds the robot against gravity is added.
    pub gravity_compensation: Option<bool>,
}

/// What commands are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ServoMode {
    /// Positions \[rad or m\].
    Position,
    /// Velocities \[rad/s or m/s\].
    Velocity,
    /// Efforts \[N m or N\].
    Effort,
}

/// What the derivative term takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ServoDerivative {
    /// The difference of errors.
    Error,
    /// The difference of measured positions.
    Measurement,
    /// The measured velocity.
    Velocity,
}

impl Operation for Simulate {
    const NAME: &'static str = "simulate";
    type Answer = SampledRun;

    fn answer(self, Subject { robot, scene }: Subject<'_>) -> Result<SampledRun, Refusal> {
        let q0 = positions(robot, "q0", &self.q0)?;
        refuse_open_loop(robot, q0.as_slice())?;
        let qd0 = velocities(robot, "qd0", &q0, &self.qd0)?;
        let commands = self.commands(robot)?;
        let (periods, ticks, stride) = self.periods(&commands)?;
        let servo = self.servo.settings(robot)?;
        let gravity_m_s2 = match (scene, self.gravity_m_s2) {
            (Some(scene), None) => scene.environment.gravity_m_s2,
            (Some(_), Some(_)) => {
                return Err(Refusal::new(
                    Code::UnknownField,
                    "the scene sets gravity; leave `gravity_m_s2` out",
                ));
            }
            (None, given) => gravity(given),
        };
        let channels = robot
            .sensors()
            .iter()
            .map(|sensor| sensor.kind.measured().channels());
        let bodies = scene.map_or(0, |scene| scene.bodies.len());
        let numbers_per_row = 3 * robot.n() + 7 * bodies + channels.sum::<usize>() + 1;
        refuse_too_large(ticks, ticks / stride + 1, numbers_per_row)?;
        let setup = Setup {
            robot,
            scene,
            tcp: robot.tcp(),
            seen_from: &robot.frames()[0],
            periods,
            gravity_m_s2,
            servo,
            sensors: robot.sensors().to_vec(),
            start_q: q0.as_slice().to_vec(),
            start_qd: qd0.as_slice().to_vec(),
            ticks,
        };
        let mut sampler = Sampler::new(&setup, stride);
        let end = run::run(
            &setup,
            |seen, slot| {
                let period = seen.tick / u64::from(periods.ticks_per_control.get());
                slot.copy_from_slice(commands.at(period));
                Ok::<(), Refusal>(())
            },
            &mut sampler,
        )
        .map_err(|error| Refusal::new(Code::CannotRun, error.to_string()))?;
        match end {
            End::Finished => sampler.answer(&setup),
            End::Stopped { why, .. } => Err(why),
            End::Diverged { tick, what } => Err(Refusal::new(
                Code::Diverged,
                format!("{what} at {} s", periods.time_s(tick)),
            )),
        }
    }
}

fn refuse_open_loop(robot: &Robot, q: &[f64]) -> Result<(), Refusal> {
    let gap_m = loop_gap_m(robot, q);
    let closed = gap_m <= MOST_GAP_M;
    if closed {
        return Ok(());
    }
    Err(Refusal::new(
        Code::OpenLoop,
        format!(
            "`q0` leaves a loop open by {gap_m} m, at most {MOST_GAP_M} m; give the independent joints only ({}), and the others \
             follow",
            joint_names(robot, robot.independent()).join(", ")
        ),
    ))
}

fn refuse_too_large(ticks: u64, rows: u64, numbers_per_row: usize) -> Result<(), Refusal> {
    let numbers = rows.saturating_mul(numbers_per_row as u64);
    if ticks <= MOST_STEPS && numbers <= MOST_NUMBERS {
        return Ok(());
    }
    Err(Refusal::new(
        Code::TooLarge,
        format!("{ticks} steps and {numbers} numbers; at most {MOST_STEPS} and {MOST_NUMBERS}"),
    ))
}

/// The setpoints of the servos over the run.
enum Commands {
    /// One command for the whole run.
    Constant(Vec<f64>),
    /// A row for each period, the last one for the rest of the run.
    Rows { rows: Vec<Vec<f64>>, period_s: f64 },
}

impl Commands {
    /// The command of a period, from zero.
    fn at(&self, period: u64) -> &[f64] {
        match self {
            Self::Constant(command) => command,
            Self::Rows { rows, .. } => {
                let last = rows.len() - 1;
                &rows[usize::try_from(period).map_or(last, |period| period.min(last))]
            }
        }
    }
}

impl Simulate {
    fn commands(&self, robot: &Robot) -> Result<Commands, Refusal> {
        let refuse = |code, message: &str| Err(Refusal::new(code, message));
        let n = robot.n();
        match (&self.command, &self.commands, self.command_period_s) {
            (None, None, _) => refuse(Code::MissingField, "`command` is missing"),
            (Some(_), Some(_), _) => refuse(
                Code::UnknownField,
                "`command` and `commands` exclude each other",
            ),
            (Some(_), None, Some(_)) => refuse(
                Code::UnknownField,
                "`command_period_s` is for `commands`, which are not given",
            ),
            (Some(command), None, None) => {
                let command = efforts(robot, "command", command)?;
                Ok(Commands::Constant(command.as_slice().to_vec()))
            }
            (None, Some(_), None) => refuse(Code::MissingField, "`command_period_s` is missing"),
            (None, Some(rows), Some(period_s)) => {
                let period_s = positive("command_period_s", period_s)?;
                if rows.is_empty() {
                    return refuse(Code::WrongLength, "`commands` has no row");
                }
                if let Some(i) = rows.iter().position(|row| row.len() != n) {
                    let message = format!(
                        "`commands[{i}]` has {} numbers, expected {n}",
                        rows[i].len()
                    );
                    return Err(Refusal::new(Code::WrongLength, message));
                }
                let rows = rows.clone();
                Ok(Commands::Rows { rows, period_s })
            }
        }
    }

    /// The periods of the run, its physics steps, and those from one row of the answer to the next.
    fn periods(&self, commands: &Commands) -> Result<(Periods, u64, u64), Refusal> {
        let duration = ("duration_s", positive("duration_s", self.duration_s)?);
        let servo = (
            "servo_period_s",
            positive("servo_period_s", self.servo_period_s)?,
        );
        let step = match self.physics_step_s {
            // a faster servo needs a step at least as short
            None => servo.1.min(0.001),
            Some(step_s) => positive("physics_step_s", step_s)?,
        };
        let step = ("physics_step_s", step);
        let sample = (
            "sample_period_s",
            positive("sample_period_s", self.sample_period_s)?,
        );
        let divides = |(longer, longer_s): (&str, f64), (shorter, shorter_s): (&str, f64)| {
            whole_ratio(longer_s, shorter_s).ok_or_else(|| {
                Refusal::new(
                    Code::BadPeriod,
                    format!("`{longer}` of {longer_s} s is not an integer multiple of `{shorter}` of {shorter_s} s"),
                )
            })
        };
        let ticks = divides(duration, step)?;
        let stride = divides(sample, step)?;
        divides(duration, sample)?;
        divides(servo, step)?;
        let control_s = match commands {
            Commands::Constant(_) => servo.1,
            Commands::Rows { period_s, .. } => {
                divides(("command_period_s", *period_s), servo)?;
                *period_s
            }
        };
        let periods = Periods::new(step.1, servo.1, control_s)
            .map_err(|error| Refusal::new(Code::BadPeriod, error.to_string()))?;
        Ok((periods, ticks, stride))
    }
}

impl ServoTable {
    fn settings(&self, robot: &Robot) -> Result<ServoSettings, Refusal> {
        let mut gains = GainLists::none(robot.n());
        for (name, given, list) in [
            ("servo.kp", &self.kp, &mut gains.kp),
            ("servo.ki", &self.ki, &mut gains.ki),
            ("servo.kd", &self.kd, &mut gains.kd),
            (
                "servo.effort_limit",
                &self.effort_limit,
                &mut gains.effort_limit,
            ),
            (
                "servo.integral_limit",
                &self.integral_limit,
                &mut gains.integral_limit,
            ),
        ] {
            if let Some(given) = given {
                *list = per_joint(robot, name, given)?;
            }
        }
        let mode = match self.mode {
            ServoMode::Position => Mode::Position,
            ServoMode::Velocity => Mode::Velocity,
            ServoMode::Effort => Mode::Effort,
        };
        let derivative = match self.derivative {
            Some(ServoDerivative::Error) => Derivative::Error,
            None | Some(ServoDerivative::Measurement) => Derivative::Measurement,
            Some(ServoDerivative::Velocity) => Derivative::Velocity,
        };
        let compensates = self.gravity_compensation.unwrap_or(false);
        ServoSettings::new(robot, mode, derivative, &gains, compensates).map_err(|error| {
            let code = match error {
                ServoError::Gain { .. } | ServoError::Limit { .. } => Code::OutOfRange,
                ServoError::Count { .. } => Code::WrongLength,
                ServoError::VelocityOfVelocity => Code::CannotRun,
            };
            // a list of gains is a field of `servo`
            let message = match &error {
                ServoError::Gain { what, .. } | ServoError::Limit { what, .. } => error
                    .to_string()
                    .replace(&format!("`{what}`"), &format!("`servo.{what}`")),
                ServoError::Count { .. } | ServoError::VelocityOfVelocity => error.to_string(),
            };
            Refusal::new(code, message)
        })
    }
}

/// A number for all joints, or one per joint or per independent joint, with zeros at dependent joints then.
fn per_joint(robot: &Robot, name: &str, given: &Numbers) -> Result<Vec<f64>, Refusal> {
    let (n, k) = (robot.n(), robot.independent().len());
    match given {
        Numbers::List(values) if values.len() == k && k < n => Ok(zeros_elsewhere(robot, values)),
        Numbers::List(values) if values.len() != n && k < n => Err(Refusal::new(
            Code::WrongLength,
            format!(
                "`{name}` has {} numbers, expected 1, {k} or {n}",
                values.len()
            ),
        )),
        numbers => numbers.per_axis(name, n),
    }
}
