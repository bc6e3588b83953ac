//! The tick loop: observe, control, servo, step. Time is counted, never measured.

use nalgebra::Vector3;

use crate::control::servo::{Servo, ServoError, ServoSettings};
use crate::dynamics::SingularMassMatrix;
use crate::dynamics::smooth::SmoothStep;
use crate::kinematics::FramePoses;
use crate::robot::{Frame, Robot};
use crate::spatial::Pose;
use crate::ticks::Periods;

/// Everything a run needs but its controller.
#[derive(Debug, Clone)]
pub struct Setup<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// The frame commands and checks refer to.
    pub tcp: &'a Frame,
    /// The frame in which the TCP is told.
    pub seen_from: &'a Frame,
    /// Step, servo period, control period.
    pub periods: Periods,
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: Vector3<f64>,
    /// The joint servos.
    pub servo: ServoSettings,
    /// Positions at tick 0, shape `(n)` \[rad or m\].
    pub start_q: Vec<f64>,
    /// Velocities at tick 0, shape `(n)` \[rad/s or m/s\].
    pub start_qd: Vec<f64>,
    /// Ticks to run; the last state is recorded at this tick.
    pub ticks: u64,
}

/// What the controller sees at the start of a control period.
#[derive(Debug, Clone, Copy)]
pub struct Observation<'a> {
    /// The tick.
    pub tick: u64,
    /// Its time \[s\].
    pub time_s: f64,
    /// The control period \[s\].
    pub dt_s: f64,
    /// Joint positions \[rad or m\].
    pub q: &'a [f64],
    /// Joint velocities \[rad/s or m/s\].
    pub qd: &'a [f64],
    /// Efforts applied in the tick before; zeros at the start \[N m or N\].
    pub effort: &'a [f64],
    /// The TCP in the frame it is told in.
    pub tcp: &'a Pose,
}

/// One tick: the state, and the command and effort held from it on.
#[derive(Debug, Clone, Copy)]
pub struct Row<'a> {
    /// The tick.
    pub tick: u64,
    /// Joint positions \[rad or m\].
    pub q: &'a [f64],
    /// Joint velocities \[rad/s or m/s\].
    pub qd: &'a [f64],
    /// The command in the servo's mode.
    pub command: &'a [f64],
    /// Joint efforts \[N m or N\].
    pub effort: &'a [f64],
}

/// Takes the rows of a run, tick by tick.
pub trait Recorder {
    /// Takes one row; ticks come in order and none is left out.
    fn row(&mut self, row: Row<'_>);
}

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
pub enum End<E> {
    /// All ticks were run.
    Finished,
    /// The controller stopped it; the tick's row is not recorded.
    Stopped {
        /// The tick.
        tick: u64,
        /// Why.
        why: E,
    },
    /// The state was no longer finite; rows up to the tick before are recorded.
    Diverged {
        /// The first tick without a finite state.
        tick: u64,
    },
}

/// A run that cannot start, or a robot that cannot move.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The servo does not fit.
    #[error(transparent)]
    Servo(#[from] ServoError),
    /// A joint moves no inertia.
    #[error(transparent)]
    Singular(#[from] SingularMassMatrix),
}

/// Runs `setup` under `control`, which writes the command of each control period, and records every tick.
///
/// `control` is called at every tick that starts a control period, except the last tick, whose command would move nothing.
///
/// # Errors
/// [`RunError`] if the servo settings do not fit the robot or a joint moves no inertia.
///
/// # Panics
/// If a start vector does not have the shape of the robot.
pub fn run<E>(
    setup: &Setup<'_>,
    mut control: impl FnMut(&Observation<'_>, &mut [f64]) -> Result<(), E>,
    recorder: &mut impl Recorder,
) -> Result<End<E>, RunError> {
    let Setup {
        robot,
        tcp,
        seen_from,
        periods,
        gravity_m_s2,
        ..
    } = *setup;
    let n = robot.n();
    let mut q = setup.start_q.clone();
    let mut qd = setup.start_qd.clone();
    assert_eq!(
        (q.len(), qd.len()),
        (n, n),
        "a start state per joint that moves"
    );
    let mut command = vec![0.0; n];
    let mut effort = vec![0.0; n];
    let mut poses = FramePoses::new(robot);
    let mut servo = Servo::new(robot, setup.servo.clone(), periods.servo_s(), gravity_m_s2)?;
    let mut step = SmoothStep::new(robot, gravity_m_s2, periods.step_s);
    let (servo_ticks, control_ticks) = (
        u64::from(periods.ticks_per_servo.get()),
        u64::from(periods.ticks_per_control.get()),
    );
    for tick in 0..=setup.ticks {
        if tick % control_ticks == 0 && (tick < setup.ticks || tick == 0) {
            poses.update(robot, &q);
            let tcp = poses.world_from(seen_from).inv_mul(&poses.world_from(tcp));
            let observation = Observation {
                tick,
                time_s: periods.time_s(tick),
                dt_s: periods.control_s(),
                q: &q,
                qd: &qd,
                effort: &effort,
                tcp: &tcp,
            };
            if let Err(why) = control(&observation, &mut command) {
                return Ok(End::Stopped { tick, why });
            }
        }
        if tick % servo_ticks == 0 {
            servo.sample(robot, &command, &q, &qd, &mut effort);
        }
        recorder.row(Row {
            tick,
            q: &q,
            qd: &qd,
            command: &command,
            effort: &effort,
        });
        if tick == setup.ticks {
            break;
        }
        step.advance(robot, &effort, &mut q, &mut qd)?;
        if !q.iter().chain(&qd).all(|x| x.is_finite()) {
            return Ok(End::Diverged { tick: tick + 1 });
        }
    }
    Ok(End::Finished)
}
