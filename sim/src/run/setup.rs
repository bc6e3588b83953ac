//! What a run needs, what its controller and its recorder see, and how it ends.

use std::sync::Arc;

use nalgebra::Vector3;

use super::divergence::DivergenceKind;
use crate::control::servo::{ServoError, ServoSettings};
use crate::dynamics::SingularMassMatrix;
use crate::engine::EngineError;
use crate::kinematics::closure::LoopError;
use crate::model::push::Push;
use crate::model::robot::{Frame, Robot};
use crate::model::scene::Scene;
use crate::model::sensor::Sensor;
use crate::model::unphysical::UnphysicalLinks;
use crate::sensing::SensorError;
use crate::spatial::Pose;
use crate::step::hybrid::HybridStep;
use crate::ticks::Periods;
use crate::trajectory::JointLaw;

/// Everything a run needs but its controller.
#[derive(Debug, Clone)]
pub struct Setup<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// The scene around the robot, if there is one.
    pub scene: Option<&'a Scene>,
    /// The frame commands and checks refer to.
    pub tcp: &'a Frame,
    /// The frame in which the TCP is reported.
    pub seen_from: &'a Frame,
    /// Step, servo period, control period.
    pub periods: Periods,
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: Vector3<f64>,
    /// The joint servos.
    pub servo: ServoSettings,
    /// The sensors of the run: [`Robot::sensors`], or others in their place.
    pub sensors: Vec<Sensor>,
    /// Positions at tick 0, shape `(n)` \[rad or m\].
    pub start_q: Vec<f64>,
    /// Velocities at tick 0, shape `(n)` \[rad/s or m/s\].
    pub start_qd: Vec<f64>,
    /// In mode `Prescribed`, and only there: the laws of the independent joints, which say where the run starts, too.
    pub laws: Option<Arc<[JointLaw]>>,
    /// Pushes on links and bodies.
    pub pushes: Vec<Push>,
    /// Ticks to run; the last state is recorded at this tick.
    pub ticks: u64,
}

/// What the controller gets at the start of a control period.
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
    /// The TCP in the frame in which it is reported.
    pub tcp: &'a Pose,
    /// What the sensors read, channel by channel in the order of [`Setup::sensors`].
    pub sensors: &'a [f64],
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
    /// Joint efforts as the drives deliver them: after limit switches opened their motors, within speed limits and torque-speed lines \[N m or N\].
    pub effort: &'a [f64],
    /// What the sensors read, channel by channel in the order of [`Setup::sensors`].
    pub sensors: &'a [f64],
    /// The scene at the tick, with what happened in the step that ended there.
    pub scene: Option<&'a HybridStep>,
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
    /// The run diverged; rows up to the tick before are recorded.
    Diverged {
        /// The first tick without a usable state.
        tick: u64,
        /// How it diverged.
        what: DivergenceKind,
    },
}

/// A run that cannot start, or a robot that cannot move.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RunError {
    /// No body can have the mass properties of some links.
    #[error(transparent)]
    Unphysical(#[from] UnphysicalLinks),
    /// The servo does not fit.
    #[error(transparent)]
    Servo(#[from] ServoError),
    /// A joint moves no inertia.
    #[error(transparent)]
    Singular(#[from] SingularMassMatrix),
    /// Robot or scene cannot have contact.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// A sensor does not fit the physics step.
    #[error(transparent)]
    Sensor(#[from] SensorError),
    /// What moves is near more triangles of a surface than fit into memory.
    #[error("too many triangles of a surface are near what moves: give it a coarser mesh")]
    TooManyTriangles,
    /// Laws that the closed loops of the robot cannot follow.
    #[error("at {time_s} s the laws of motion leave what the robot can do: {error}")]
    Loops {
        /// When \[s\].
        time_s: f64,
        /// Why.
        error: LoopError,
    },
    /// More work than a run may be.
    #[error(
        "at {time_s} s the run has been more work than a run may be: leave out bodies and shapes that nothing needs, \
         use coarser meshes, or make it shorter"
    )]
    TooMuchWork {
        /// When \[s\].
        time_s: f64,
    },
}
