//! The run: the whole robot in the simulator, with gravity, air, friction, effort limits and sampled servos.

use nalgebra::Vector3;

use kinemark_sim::control::linear_step::Fed;
use kinemark_sim::model::air::AIR_DENSITY_KG_M3;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::{Scene, Wind};
use kinemark_sim::run;
use kinemark_sim::run::{End, Recorder, Row, Setup};
use kinemark_sim::ticks::Periods;

use super::settings::{ResponseError, ResponseSettings};

/// Another joint than the one that gets the step.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherJoint {
    /// Its entry of `q`.
    pub joint: usize,
    /// Its signal at every physics step, of the kind that is fed back \[rad or m, rad/s or m/s\].
    pub values: Vec<f64>,
    /// The value that it is commanded to keep.
    pub command: f64,
    /// How far it leaves that at most, with its sign.
    pub greatest_deviation: f64,
    /// When \[s\].
    pub at_s: f64,
    /// How far it is off its command at the end, with its sign.
    pub last_deviation: f64,
}

/// Where a run diverged.
#[derive(Debug, Clone, PartialEq)]
pub struct Divergence {
    /// When \[s\].
    pub time_s: f64,
    /// How, in words.
    pub how: String,
}

/// What a run did.
#[derive(Debug, Clone, PartialEq)]
pub struct RunCurves {
    /// The physics step \[s\].
    pub step_s: f64,
    /// The signal of the joint at every physics step \[rad or m, rad/s or m/s\].
    pub values: Vec<f64>,
    /// The effort of its motor \[N m or N\].
    pub effort: Vec<f64>,
    /// The greatest effort that the motor can give; infinite if there is no limit.
    pub effort_limit: f64,
    /// The others, in the order of `q`.
    pub others: Vec<OtherJoint>,
    /// Where it diverged, if it did: there is no value from there on.
    pub divergence: Option<Divergence>,
}

impl RunCurves {
    /// The greatest effort in size \[N m or N\].
    pub fn peak_effort(&self) -> f64 {
        self.effort
            .iter()
            .fold(0.0, |most, effort| most.max(effort.abs()))
    }

    /// Whether the motor was at its limit.
    pub fn is_limited(&self) -> bool {
        self.peak_effort() >= self.effort_limit
    }
}

/// Keeps the joint's effort, and the signal of all joints.
struct Curves {
    fed: Fed,
    joint: usize,
    signals: Vec<Vec<f64>>,
    effort: Vec<f64>,
}

impl Recorder for Curves {
    fn row(&mut self, row: Row<'_>) {
        let values = match self.fed {
            Fed::Position => row.q,
            Fed::Velocity => row.qd,
        };
        for (signal, value) in self.signals.iter_mut().zip(values) {
            signal.push(*value);
        }
        self.effort.push(row.effort[self.joint]);
    }
}

/// The scene around the robot: nothing but air. Without air there is none, and limits of position and speed do not act.
fn air(settings: &ResponseSettings, robot: &Robot, gravity_m_s2: Vector3<f64>) -> Option<Scene> {
    let surroundings = &settings.surroundings;
    let has_drag = robot.links().iter().any(|link| link.drag.is_some());
    // drag without wind is that of still air
    let still = (surroundings.drag.is_some() && has_drag).then_some([0.0; 3]);
    let velocity_m_s = surroundings.wind_m_s.or(still)?;
    let wind = Wind {
        velocity_m_s: velocity_m_s.into(),
        air_density_kg_m3: AIR_DENSITY_KG_M3,
        gust: None,
    };
    Some(Scene::of_air(gravity_m_s2, wind))
}

/// Runs the step on `robot`, which has the friction and the drag of the settings already.
pub(super) fn run_step(
    robot: &Robot,
    settings: &ResponseSettings,
    start_q: &[f64],
) -> Result<RunCurves, ResponseError> {
    let step_s = settings.physics_step_s();
    let period_s = settings.servo_period_s;
    // a period is cut into equal steps, so these always fit
    let periods =
        Periods::new(step_s, period_s, period_s).map_err(|_| ResponseError::OutOfRange {
            what: "the servo period",
            expected: "a time that a computer can count".to_owned(),
            found: period_s,
        })?;
    let gravity_m_s2 = Vector3::new(0.0, 0.0, -settings.surroundings.gravity_m_s2);
    let scene = air(settings, robot, gravity_m_s2);
    let servo = settings.servo(robot)?;
    let effort_limit = servo.gains[settings.joint].effort_limit;
    let command = settings.command(start_q);
    let setup = Setup {
        robot,
        scene: scene.as_ref(),
        tcp: robot.tcp(),
        seen_from: &robot.frames()[0],
        periods,
        gravity_m_s2,
        servo,
        sensors: Vec::new(),
        start_q: start_q.to_vec(),
        start_qd: vec![0.0; robot.n()],
        laws: None,
        pushes: Vec::new(),
        ticks: (settings.duration_s / step_s).round() as u64,
    };
    let mut curves = Curves {
        fed: settings.fed,
        joint: settings.joint,
        signals: vec![Vec::new(); robot.n()],
        effort: Vec::new(),
    };
    let control = |_: &run::Observation<'_>, slot: &mut [f64]| -> Result<(), ResponseError> {
        slot.copy_from_slice(&command);
        Ok(())
    };
    let divergence = match run::run(&setup, control, &mut curves)? {
        End::Finished => None,
        End::Stopped { why, .. } => return Err(why),
        End::Diverged { tick, what } => Some(Divergence {
            time_s: periods.time_s(tick),
            how: what.to_string(),
        }),
    };
    let mut others = Vec::new();
    let mut values = Vec::new();
    for (joint, signal) in curves.signals.into_iter().enumerate() {
        if joint == settings.joint {
            values = signal;
        } else {
            others.push(other(joint, signal, command[joint], &periods));
        }
    }
    Ok(RunCurves {
        step_s,
        values,
        effort: curves.effort,
        effort_limit,
        others,
        divergence,
    })
}

fn other(joint: usize, values: Vec<f64>, command: f64, periods: &Periods) -> OtherJoint {
    let mut greatest = (0, 0.0_f64);
    for (tick, value) in values.iter().enumerate() {
        let deviation = value - command;
        if deviation.abs() > greatest.1.abs() {
            greatest = (tick, deviation);
        }
    }
    OtherJoint {
        joint,
        last_deviation: values.last().map_or(0.0, |last| last - command),
        values,
        command,
        greatest_deviation: greatest.1,
        at_s: periods.time_s(greatest.0 as u64),
    }
}
