//! What a lab is once its file has been read: nothing in it can be wrong any more.

use std::sync::Arc;

use kinemark_sim::robot::{Dimensions, Robot, RobotFile};
use kinemark_sim::source::Source;

use super::joint_units::JointUnits;
use super::ladder::Ladder;
use super::mesh_file::MeshFile;
use super::scene::LabScene;
use super::step::StepResponse;
use super::variant::{Variant, VariantRule};
use super::watched::{Fall, PathToFollow, Shares, SpeedAt, TouchingParty, Until};
use crate::record::graded::TcpPath;
use crate::submission::controller::Budgets;
pub use crate::task::model::{
    Band, Case, Function, FunctionTask, Given, MotionGoal, MotionTask, Rows, TaskWork,
};
use crate::task::workcell::Workcell;

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

impl Lab {
    /// What its tasks are done with.
    pub fn workcell(&self) -> Workcell<'_> {
        Workcell {
            robot: &self.robot,
            robot_file: &self.robot_file,
            frame: &self.frame,
        }
    }
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
