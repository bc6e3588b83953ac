//! The operation `simulate`: its fields, what they must be, and the run they describe.

use kinemark_sim::control::{Derivative, GainLists, Mode, ServoError, ServoSettings};
use kinemark_sim::kinematics::closure::loop_gap_m;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::run;
use kinemark_sim::run::{End, Setup};
use kinemark_sim::ticks::{Periods, whole_ratio};
use serde::Deserialize;

use super::dynamics::gravity_or_earths;
use super::joint_state::{efforts, positions, velocities, zeros_elsewhere};
use super::number_fields::{Numbers, positive};
use super::operation::Subject;
use super::refusal::{Code, Refusal, refuse};
use super::simulation_record::{SampledRun, Sampler};
use crate::joint_names::joint_names;

/// More steps than this take minutes.
const MOST_STEPS: u64 = 100_000_000;
/// More numbers than this do not belong on one line.
const MOST_NUMBERS: u64 = 2_000_000;
/// A start counts as closed below this gap; the first step takes up what is left.
const MOST_GAP_M: f64 = 1e-6;

/// A run from a state under given commands, alone or in a scene.
#[derive(Debug, Clone, PartialEq, Deserialize)]
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

/// What the commands of a request are: a request has no laws of motion, so that nothing is prescribed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CommandMode {
    /// Joint positions \[rad or m\].
    Position,
    /// Joint velocities \[rad/s or m/s\].
    Velocity,
    /// Joint efforts \[N m or N\].
    Effort,
}

impl From<CommandMode> for Mode {
    fn from(mode: CommandMode) -> Self {
        match mode {
            CommandMode::Position => Self::Position,
            CommandMode::Velocity => Self::Velocity,
            CommandMode::Effort => Self::Effort,
        }
    }
}

/// The joint servos; every number is one for all joints, or one per joint.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct ServoTable {
    /// What commands are.
    pub mode: CommandMode,
    /// What the derivative term takes; the measurement where it is not given.
    pub derivative: Option<Derivative>,
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

/// Runs from the state under the commands.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn simulate(subject: Subject<'_>, request: &Simulate) -> Result<SampledRun, Refusal> {
    let Subject { robot, scene } = subject;
    robot.check_inertias()?;
    let q0 = positions(robot, "q0", &request.q0)?;
    refuse_open_loop(robot, q0.as_slice())?;
    let qd0 = velocities(robot, "qd0", &q0, &request.qd0)?;
    let commands = request.commands(robot)?;
    let (periods, ticks, stride) = request.periods()?;
    let servo = request.servo.settings(robot)?;
    let gravity_m_s2 = match (scene, request.gravity_m_s2) {
        (Some(scene), None) => scene.environment.gravity_m_s2,
        (Some(_), Some(_)) => {
            return refuse(
                Code::UnknownField,
                "the scene sets gravity; leave `gravity_m_s2` out",
            );
        }
        (None, given) => gravity_or_earths(given),
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
        laws: None,
        pushes: Vec::new(),
        ticks,
    };
    let mut sampler = Sampler::new(&setup, stride);
    let end = run::run(
        &setup,
        |seen, slot| {
            let period = seen.tick / u64::from(periods.ticks_per_control.get());
            // the last one stands for the rest of the run
            let last = commands.len() - 1;
            let i = usize::try_from(period).map_or(last, |period| period.min(last));
            slot.copy_from_slice(&commands[i]);
            Ok::<(), Refusal>(())
        },
        &mut sampler,
    )
    .map_err(|error| Refusal::new(Code::CannotRun, error))?;
    match end {
        End::Finished => sampler.answer(),
        End::Stopped { why, .. } => Err(why),
        End::Diverged { tick, what } => refuse(Code::Diverged, sampler.divergence(tick, &what)),
    }
}

fn refuse_open_loop(robot: &Robot, q: &[f64]) -> Result<(), Refusal> {
    let gap_m = loop_gap_m(robot, q);
    let closed = gap_m <= MOST_GAP_M;
    if closed {
        return Ok(());
    }
    refuse(
        Code::OpenLoop,
        format!(
            "`q0` leaves a loop open by {gap_m} m, at most {MOST_GAP_M} m; give the independent joints only ({}), and the others \
             follow",
            joint_names(robot, robot.independent()).join(", ")
        ),
    )
}

fn refuse_too_large(ticks: u64, rows: u64, numbers_per_row: usize) -> Result<(), Refusal> {
    let numbers = rows.saturating_mul(numbers_per_row as u64);
    if ticks <= MOST_STEPS && numbers <= MOST_NUMBERS {
        return Ok(());
    }
    refuse(
        Code::TooLarge,
        format!("{ticks} steps and {numbers} numbers; at most {MOST_STEPS} and {MOST_NUMBERS}"),
    )
}

impl Simulate {
    /// The setpoints of the servos: a row for each period, the last one for the rest of the run.
    fn commands(&self, robot: &Robot) -> Result<Vec<Vec<f64>>, Refusal> {
        let (n, k) = (robot.n(), robot.independent().len());
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
            (Some(command), None, None) => Ok(vec![
                efforts(robot, "command", command)?.as_slice().to_vec(),
            ]),
            (None, Some(_), None) => refuse(Code::MissingField, "`command_period_s` is missing"),
            (None, Some(rows), Some(_)) if rows.is_empty() => {
                refuse(Code::WrongLength, "`commands` has no row")
            }
            (None, Some(rows), Some(_)) => {
                let whole = |(i, row): (usize, &Vec<f64>)| match row.len() {
                    found if found == n => Ok(row.clone()),
                    found if found == k => Ok(zeros_elsewhere(robot, row)),
                    found => {
                        let expected = match k < n {
                            true => format!("{k} (independent joints) or {n}"),
                            false => n.to_string(),
                        };
                        let message =
                            format!("`commands[{i}]` has {found} numbers, expected {expected}");
                        refuse(Code::WrongLength, message)
                    }
                };
                rows.iter().enumerate().map(whole).collect()
            }
        }
    }

    /// The periods of the run, its physics steps, and those from one row of the answer to the next.
    fn periods(&self) -> Result<(Periods, u64, u64), Refusal> {
        let named = |name, time_s| positive(name, time_s).map(|time_s| (name, time_s));
        let duration = named("duration_s", self.duration_s)?;
        let servo = named("servo_period_s", self.servo_period_s)?;
        // a faster servo needs a step at least as short
        let step_s = self.physics_step_s.unwrap_or(servo.1.min(0.001));
        let step = named("physics_step_s", step_s)?;
        let sample = named("sample_period_s", self.sample_period_s)?;
        let control_s = self.command_period_s.unwrap_or(servo.1);
        let control = named("command_period_s", control_s)?;
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
        divides(control, servo)?;
        let periods = Periods::new(step.1, servo.1, control.1)
            .map_err(|error| Refusal::new(Code::BadPeriod, error))?;
        Ok((periods, ticks, stride))
    }
}

impl ServoTable {
    fn settings(&self, robot: &Robot) -> Result<ServoSettings, Refusal> {
        let mut gains = GainLists::none(robot.n());
        for (name, given, list) in [
            ("kp", &self.kp, &mut gains.kp),
            ("ki", &self.ki, &mut gains.ki),
            ("kd", &self.kd, &mut gains.kd),
            ("effort_limit", &self.effort_limit, &mut gains.effort_limit),
            (
                "integral_limit",
                &self.integral_limit,
                &mut gains.integral_limit,
            ),
        ] {
            if let Some(given) = given {
                *list = per_joint(robot, &format!("servo.{name}"), given)?;
            }
        }
        let derivative = self.derivative.unwrap_or(Derivative::Measurement);
        let compensates = self.gravity_compensation.unwrap_or(false);
        ServoSettings::new(robot, self.mode.into(), derivative, &gains, compensates).map_err(
            |error| {
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
            },
        )
    }
}

/// A number for all joints, or one per joint or per independent joint, with zeros at dependent joints then.
fn per_joint(robot: &Robot, name: &str, given: &Numbers) -> Result<Vec<f64>, Refusal> {
    let (n, k) = (robot.n(), robot.independent().len());
    match given {
        Numbers::List(values) if values.len() == k && k < n => Ok(zeros_elsewhere(robot, values)),
        Numbers::List(values) if values.len() != n && k < n => refuse(
            Code::WrongLength,
            format!(
                "`{name}` has {} numbers, expected 1, {k} or {n}",
                values.len()
            ),
        ),
        numbers => numbers.per_axis(name, n),
    }
}
