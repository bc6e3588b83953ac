//! What a lab is once its file has been read: nothing in it can be wrong any more.

use std::sync::Arc;

use kinemark_sim::control::ServoSettings;
use kinemark_sim::robot::{Dimension, Dimensions, Robot, RobotFile};
use kinemark_sim::sensor::Sensor;
use kinemark_sim::source::Source;
use kinemark_sim::ticks::Periods;
use nalgebra::Vector3;

use super::joint_units::JointUnits;
use super::ladder::Ladder;
use super::mesh_file::MeshFile;
use super::scene::LabScene;
use super::step::StepResponse;
use super::variant::{Variant, VariantRule};
use super::watched::{Fall, PathToFollow, Shares, SpeedAt, TouchingParty, Until};
use crate::controller::{Budgets, Grant, Value};
use crate::graded::TcpPath;

/// A lab: ordered tasks on one robot.
#[derive(Debug, Clone)]
pub struct Lab {
    /// Its name, which is its folder's.
    pub name: String,
    /// Its title.
    pub title: String,
    /// What it is about, in a sentence.
    pub summary: String,
    /// The text of `lab.toml`.
    pub source: Source,
    /// Its parameters, with the numbers of its variant where it is one.
    pub parameters: Dimensions,
    /// How variants are drawn; empty where everyone has the same numbers.
    pub variants: Vec<VariantRule>,
    /// The variant it is, if it is one.
    pub variant: Option<Variant>,
    /// The robot file, which variants and cases build with other dimensions.
    pub robot_file: RobotFile,
    /// The meshes the robot file names.
    pub robot_meshes: Vec<MeshFile>,
    /// The robot as its file states it, but for the dimensions that the lab changes.
    pub robot: Robot,
    /// The scenes of its motion tasks, each once, in the order the tasks name them.
    pub scenes: Vec<Arc<LabScene>>,
    /// The frame in which students work.
    pub frame: String,
    /// What submissions may use up.
    pub budgets: Budgets,
    /// The reference solution's TCP paths by task, and the text they were read from.
    pub reference_paths: ReferencePaths,
    /// The tasks, in order.
    pub tasks: Vec<Task>,
}

/// The TCP paths of the reference solution: all that students see of it.
#[derive(Debug, Clone, Default)]
pub struct ReferencePaths {
    /// The file's text; empty where the lab has none.
    pub text: String,
    /// Task names with paths.
    pub paths: Vec<(String, TcpPath)>,
}

/// A task.
#[derive(Debug, Clone)]
pub struct Task {
    /// Its name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// What is done in it.
    pub work: TaskWork,
    /// Its checks, in order.
    pub checks: Vec<Check>,
}

impl Task {
    /// Points of all its checks.
    pub fn max_points(&self) -> f64 {
        self.checks.iter().map(|check| check.points).sum()
    }
}

/// What a task asks for.
#[derive(Debug, Clone)]
pub enum TaskWork {
    /// A function called on cases.
    Function(FunctionTask),
    /// A run under `control`.
    Motion(Box<MotionTask>),
}

/// The function of a function task.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Function {
    /// `forward_kinematics(robot, q)`.
    ForwardKinematics,
    /// `inverse_kinematics(robot, position)`.
    InverseKinematics,
    /// `jacobian(robot, q)`, a matrix of these rows and one column per joint that moves.
    Jacobian(Rows),
    /// A function of the lab's own, of this name: `name(given)`.
    Free(String),
}

impl Function {
    /// Its name in submissions.
    pub fn name(&self) -> &str {
        match self {
            Self::ForwardKinematics => "forward_kinematics",
            Self::InverseKinematics => "inverse_kinematics",
            Self::Jacobian(_) => "jacobian",
            Self::Free(name) => name,
        }
    }
}

/// The rows of a Jacobian that a lab asks for, always in the order of [`Rows::NAMES`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rows([bool; 6]);

impl Rows {
    /// The rows there are: velocity of the TCP along the lab's axes \[m/s\], then its angular velocity about them \[rad/s\].
    pub const NAMES: [&'static str; 6] = ["x", "y", "z", "rx", "ry", "rz"];
    /// The velocity of the TCP's origin alone.
    pub const LINEAR: Self = Self([true, true, true, false, false, false]);

    /// The rows of these names; `None` unless each is a row, named once, in order.
    pub fn named<'n>(names: impl IntoIterator<Item = &'n str>) -> Option<Self> {
        let mut rows = [false; 6];
        let mut next = 0;
        for name in names {
            let row = next + Self::NAMES[next..].iter().position(|row| *row == name)?;
            rows[row] = true;
            next = row + 1;
        }
        (next > 0).then_some(Self(rows))
    }

    /// Their indices among the six.
    pub fn indices(self) -> impl Iterator<Item = usize> {
        (0..6).filter(move |&row| self.0[row])
    }

    /// Their names.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        self.indices().map(|row| Self::NAMES[row])
    }
}

/// A function task.
#[derive(Debug, Clone)]
pub struct FunctionTask {
    /// The function.
    pub function: Function,
    /// Its visible cases.
    pub cases: Vec<Case>,
    /// Functions of `robot` that it grants.
    pub grants: Vec<Grant>,
}

/// One call of a function, and what a right answer is like.
#[derive(Debug, Clone)]
pub struct Case {
    /// Its name; of a hidden case, only its class is ever told.
    pub name: String,
    /// The class of a hidden case; `None` for a visible one.
    pub hidden_class: Option<String>,
    /// Dimensions that differ from the robot file's.
    pub dimensions: Vec<(String, Dimension)>,
    /// What the function is given.
    pub given: Given,
}

/// What a function is given.
#[derive(Debug, Clone, PartialEq)]
pub enum Given {
    /// Joint positions, shape `(n)` \[rad or m\].
    Q(Vec<f64>),
    /// A position of the TCP in the lab's frame \[m\].
    Position {
        /// The position \[m\].
        position_m: [f64; 3],
        /// How many branches reach it; 0 where none does.
        branches: u32,
    },
    /// Numbers and lists of numbers by name, and what a right answer holds.
    Values {
        /// The entries of the map `given`.
        given: Vec<(String, Dimension)>,
        /// The entries of the answer; a single one without a name where the answer is a number.
        expected: Vec<(String, Dimension)>,
    },
}

/// A motion task.
#[derive(Debug, Clone)]
pub struct MotionTask {
    /// Step, servo period, control period.
    pub periods: Periods,
    /// Ticks to run.
    pub ticks: u64,
    /// The servos.
    pub servo: ServoSettings,
    /// What is around the robot, where anything is.
    pub scene: Option<Arc<LabScene>>,
    /// Gravity in the world: the scene's, or the usual one \[m/s²\].
    pub gravity_m_s2: Vector3<f64>,
    /// What the robot measures: its own sensors, with the task's in their place or after them.
    pub sensors: Vec<Sensor>,
    /// Joint positions at the start, shape `(n)` \[rad or m\].
    pub start_q: Vec<f64>,
    /// What `observation.target` holds where there are no goals.
    pub target: Value,
    /// Where the TCP is to go, in order.
    pub goals: Vec<MotionGoal>,
    /// Functions of `robot` that it grants.
    pub grants: Vec<Grant>,
    /// Paths for the TCP, which checks name.
    pub paths: Vec<PathToFollow>,
}

/// A place the TCP is to reach and to stay at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionGoal {
    /// Position in the lab's frame \[m\].
    pub position_m: Vector3<f64>,
    /// Ticks to stay.
    pub dwell_ticks: u64,
}

/// A check: one criterion with its points.
#[derive(Debug, Clone)]
pub struct Check {
    /// Its name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Points there are.
    pub points: f64,
    /// Earlier checks of the task that must earn something before this one counts, by index.
    pub needs: Vec<usize>,
    /// The next step to suggest where points are lost.
    pub hint: Option<String>,
    /// What it looks at.
    pub kind: CheckKind,
}

/// A band of linear partial credit: `full` and better earn everything, `zero` and worse nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// The value that earns all points.
    pub full: f64,
    /// The value that earns none.
    pub zero: f64,
}

impl Band {
    /// The share of points that `value` earns, in `[0, 1]`; NaN and infinity earn nothing.
    pub fn score(&self, value: f64) -> f64 {
        if value <= self.full {
            1.0
        } else if value < self.zero {
            (self.zero - value) / (self.zero - self.full)
        } else {
            0.0
        }
    }
}

/// The kinds of checks; each is a file of [`crate::check`].
#[derive(Debug, Clone)]
pub enum CheckKind {
    /// A joint stands at a position for the last part of the run.
    JointReached {
        /// Index of the joint in `q`.
        joint: usize,
        /// The position \[rad or m\].
        position: f64,
        /// Ticks at the end in which it must stand there.
        hold_ticks: u64,
        /// Distance \[rad or m\].
        band: Band,
    },
    /// Mean distance of the answered position \[m\].
    FkError(Band),
    /// Distance of the best branch's position \[m\].
    IkReach(Band),
    /// Distance of the positions of both branches, which must differ \[m\].
    IkBranches(Band),
    /// `[]` where no branch reaches.
    IkUnreachable,
    /// Mean relative distance of the answered Jacobian.
    JacobianMatch(Band),
    /// Distance from each goal during its dwell \[m\].
    PoseReached(Band),
    /// The end of the last dwell \[s\].
    FinishTime(Band),
    /// How far the TCP runs past a goal, as a fraction of the way to it.
    Overshoot(Band),
    /// Time in which some effort is at its limit \[s\].
    EffortSaturation(Band),
    /// How far a joint leaves its limits \[rad or m\].
    JointLimits(Band),
    /// Distance from the reference's path \[m\].
    TrajectoryMatch {
        /// The part that is compared.
        span: MatchSpan,
        /// Greatest time shift, in ticks.
        max_shift_ticks: u64,
        /// Root mean square distance \[m\].
        band: Band,
    },
    /// A body falls off what it stood on.
    BodyFalls(Fall),
    /// How hard and how long two press on each other.
    ContactImpulse {
        /// The two.
        between: [TouchingParty; 2],
        /// Impulse \[N s\].
        band: Band,
    },
    /// How fast the TCP is.
    TcpSpeed {
        /// When.
        at: SpeedAt,
        /// Speed \[m/s\].
        band: Band,
    },
    /// Distance of the TCP from a path, in the worst of its segments.
    PathDeviation {
        /// The path.
        path: PathToFollow,
        /// The one segment that counts, from 0; the worst of all where there is none.
        segment: Option<usize>,
        /// Root mean square distance \[m\].
        band: Band,
    },
    /// The share of a path that the TCP passes.
    PathCoverage {
        /// The path.
        path: PathToFollow,
        /// How near it passes \[m\].
        within_m: f64,
        /// The share.
        shares: Shares,
    },
    /// Speed of the TCP along a path, in the worst of its segments.
    PathSpeed {
        /// The path.
        path: PathToFollow,
        /// The one segment that counts, from 0; the worst of all where there is none.
        segment: Option<usize>,
        /// The speed \[m/s\].
        speed_m_s: f64,
        /// Root mean square error, as a fraction of the speed.
        band: Band,
    },
    /// When something was done.
    TimeLimit {
        /// What.
        until: Until,
        /// Time \[s\].
        band: Band,
    },
    /// An earlier check, of the same motion under disturbances.
    Robustness(Ladder),
    /// How long a joint takes from one share of its step to another.
    RiseTime {
        /// The response.
        response: StepResponse,
        /// The lower share, above 0.
        from: f64,
        /// The upper share, below 1.
        to: f64,
        /// Time \[s\].
        band: Band,
    },
    /// When a joint comes to stay near its final value.
    SettlingTime {
        /// The response.
        response: StepResponse,
        /// How near, as a share of the step.
        within: f64,
        /// Time \[s\].
        band: Band,
    },
    /// How far a joint goes past its final value, as a share of the step.
    StepOvershoot {
        /// The response.
        response: StepResponse,
        /// The share.
        band: Band,
    },
    /// How far from a target a joint comes to rest.
    SteadyError {
        /// The response.
        response: StepResponse,
        /// The target \[rad or rad/s\].
        target: f64,
        /// Distance \[rad or rad/s\].
        band: Band,
    },
    /// The greatest effort.
    EffortPeak {
        /// Index of the joint in `q`; the worst of all where there is none.
        joint: Option<usize>,
        /// Effort \[N m or N\].
        band: Band,
    },
    /// The root mean square of the effort.
    EffortRms {
        /// Index of the joint in `q`; the worst of all where there is none.
        joint: Option<usize>,
        /// Effort \[N m or N\].
        band: Band,
    },
    /// The mechanical work of all motors, whichever its sign \[J\].
    Energy(Band),
    /// The root mean square jerk of the TCP \[m/s³\].
    Jerk(Band),
    /// The greatest speed of any joint \[rad/s or m/s\].
    JointSpeed(Band),
    /// How often an effort turns round.
    Chatter {
        /// Index of the joint in `q`; the worst of all where there is none.
        joint: Option<usize>,
        /// Reversals in a second \[Hz\].
        band: Band,
    },
    /// Relative errors of what a free function answers.
    FunctionCases {
        /// Relative error of one entry.
        band: Band,
        /// The one entry that counts, where not all do.
        entry: Option<String>,
    },
}

impl CheckKind {
    /// The word of the lab file.
    pub fn name(&self) -> &'static str {
        match self {
            Self::JointReached { .. } => "joint-reached",
            Self::FkError(_) => "fk-error",
            Self::IkReach(_) => "ik-reach",
            Self::IkBranches(_) => "ik-branches",
            Self::IkUnreachable => "ik-unreachable",
            Self::JacobianMatch(_) => "jacobian-match",
            Self::PoseReached(_) => "pose-reached",
            Self::FinishTime(_) => "finish-time",
            Self::Overshoot(_) => "overshoot",
            Self::EffortSaturation(_) => "effort-saturation",
            Self::JointLimits(_) => "joint-limits",
            Self::TrajectoryMatch { .. } => "trajectory-match",
            Self::BodyFalls(_) => "body-falls",
            Self::ContactImpulse { .. } => "contact-impulse",
            Self::TcpSpeed { .. } => "tcp-speed",
            Self::PathDeviation { .. } => "path-deviation",
            Self::PathCoverage { .. } => "path-coverage",
            Self::PathSpeed { .. } => "path-speed",
            Self::TimeLimit { .. } => "time-limit",
            Self::Robustness(_) => "robustness",
            Self::RiseTime { .. } => "rise-time",
            Self::SettlingTime { .. } => "settling-time",
            Self::StepOvershoot { .. } => "step-overshoot",
            Self::SteadyError { .. } => "steady-error",
            Self::EffortPeak { .. } => "effort-peak",
            Self::EffortRms { .. } => "effort-rms",
            Self::Energy(_) => "energy",
            Self::Jerk(_) => "jerk",
            Self::JointSpeed(_) => "joint-speed",
            Self::Chatter { .. } => "chatter",
            Self::FunctionCases { .. } => "function-cases",
        }
    }

    /// Whether it compares a whole run with the one of the lab's own numbers.
    pub(super) fn follows_one_path(&self) -> bool {
        let run = MatchSpan::Run;
        matches!(self, Self::TrajectoryMatch { span, .. } if *span == run)
    }

    /// Its band with the unit of its values on `robot`, where it has one.
    pub fn band(&self, robot: &Robot) -> Option<(Band, &'static str)> {
        match self {
            Self::JointReached { joint, band, .. } => {
                Some((*band, JointUnits::of(robot, *joint).position()))
            }
            Self::JointLimits(band) => Some((*band, JointUnits::of_all(robot).position())),
            Self::FkError(band)
            | Self::IkReach(band)
            | Self::IkBranches(band)
            | Self::PoseReached(band)
            | Self::TrajectoryMatch { band, .. }
            | Self::PathDeviation { band, .. } => Some((*band, "m")),
            Self::FinishTime(band) | Self::EffortSaturation(band) => Some((*band, "s")),
            Self::Overshoot(band)
            | Self::JacobianMatch(band)
            | Self::FunctionCases { band, .. } => Some((*band, "")),
            Self::ContactImpulse { band, .. } => Some((*band, "N s")),
            Self::TcpSpeed { band, .. } => Some((*band, "m/s")),
            Self::IkUnreachable | Self::BodyFalls(_) | Self::PathCoverage { .. } => None,
            Self::PathSpeed { band, .. } => Some((*band, "")),
            Self::TimeLimit { band, .. } => Some((*band, "s")),
            Self::Robustness(_) => None,
            Self::RiseTime { band, .. } | Self::SettlingTime { band, .. } => Some((*band, "s")),
            Self::StepOvershoot { band, .. } => Some((*band, "")),
            Self::SteadyError { band, response, .. } => Some((*band, response.unit())),
            Self::EffortPeak { joint, band } | Self::EffortRms { joint, band } => {
                let all = || JointUnits::of_all(robot);
                let units = joint.map_or_else(all, |joint| JointUnits::of(robot, joint));
                Some((*band, units.effort()))
            }
            Self::Energy(band) => Some((*band, "J")),
            Self::Jerk(band) => Some((*band, "m/s³")),
            Self::JointSpeed(band) => Some((*band, JointUnits::of_all(robot).speed())),
            Self::Chatter { band, .. } => Some((*band, "Hz")),
        }
    }
}

/// The part of a run that is compared with the reference's path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MatchSpan {
    /// The dwells at the goals: between them every path is right.
    Dwells,
    /// The whole run.
    Run,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_falls_linearly_and_nan_earns_nothing() {
        let band = Band {
            full: 2.0,
            zero: 4.0,
        };
        for (value, score) in [(1.0, 1.0), (2.0, 1.0), (3.0, 0.5), (4.0, 0.0), (9.0, 0.0)] {
            assert_eq!(band.score(value), score);
        }
        assert_eq!(band.score(f64::NAN), 0.0);
        assert_eq!(band.score(f64::INFINITY), 0.0);
        assert_eq!(band.score(f64::NEG_INFINITY), 1.0);
    }

    #[test]
    fn rows_are_named_once_and_in_order() {
        let named = |names: &[&str]| Rows::named(names.iter().copied());
        let rows = named(&["x", "y", "rz"]).unwrap();
        assert_eq!(rows.indices().collect::<Vec<_>>(), [0, 1, 5]);
        assert_eq!(rows.names().collect::<Vec<_>>(), ["x", "y", "rz"]);
        assert_eq!(named(&["x", "y", "z"]), Some(Rows::LINEAR));
        for wrong in [&[][..], &["y", "x"], &["x", "x"], &["w"], &["rz", "rz"]] {
            assert_eq!(named(wrong), None, "{wrong:?}");
        }
    }

    #[test]
    fn a_band_of_no_width_is_a_threshold() {
        let band = Band {
            full: 1.0,
            zero: 1.0,
        };
        assert_eq!((band.score(1.0), band.score(1.0 + 1e-12)), (1.0, 0.0));
    }
}
