//! What a task asks for: a function with its cases, or a motion with its goals; and the band of partial credit.

use std::borrow::Cow;
use std::sync::Arc;

use kinemark_sim::control::ServoSettings;
use kinemark_sim::dynamics::GRAVITY_M_S2;
use kinemark_sim::model::joint_friction::JointFriction;
use kinemark_sim::model::push::Push;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::Scene;
use kinemark_sim::model::sensor::Sensor;
use kinemark_sim::text::Dimension;
use kinemark_sim::ticks::Periods;
use kinemark_sim::trajectory::JointLaw;
use nalgebra::{Rotation3, Vector3};

use super::entry::Entry;
use super::grant::Grant;
use super::pose::PoseForm;
use super::quantity::Quantity;
use super::scene::LabScene;
use super::value::Value;
use super::watched::PathToFollow;

/// The function of a function task.
#[derive(Debug, Clone, PartialEq)]
pub enum Function {
    /// `forward_kinematics(robot, q)`: the pose in this form.
    ForwardKinematics(PoseForm),
    /// `inverse_kinematics(robot, position)`: the branches that reach a pose of this form.
    InverseKinematics(PoseForm),
    /// `jacobian(robot, q)`, a matrix of these rows and one column per joint of the task.
    Jacobian(Rows),
    /// A quantity of the robot: `velocity(robot, q, qd)` and others.
    Quantity(Quantity),
    /// A function of the lab's own, of this name: `name(given)`, or `name(robot, given)`.
    Free(String),
}

impl Function {
    /// What it is called in labs, and in submissions where the lab gives it no other name.
    pub fn name(&self) -> &str {
        match self {
            Self::ForwardKinematics(_) => "forward_kinematics",
            Self::InverseKinematics(_) => "inverse_kinematics",
            Self::Jacobian(_) => "jacobian",
            Self::Quantity(quantity) => quantity.name(),
            Self::Free(name) => name,
        }
    }

    /// Its name where kinds of checks of its own judge it; nothing for quantities and functions of the lab's own, whose answers are
    /// judged as numbers.
    pub fn known_name(&self) -> Option<&str> {
        match self {
            Self::Quantity(_) | Self::Free(_) => None,
            known => Some(known.name()),
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
    /// What of the robot it is about.
    pub about: About,
}

impl FunctionTask {
    /// The name of its function in submissions: the one that the lab gives it, or that of the function.
    pub fn name(&self) -> &str {
        self.about.name.as_deref().unwrap_or(self.function.name())
    }

    /// The parameters of its function in submissions.
    pub fn parameters(&self) -> Vec<&'static str> {
        match &self.function {
            Function::ForwardKinematics(_) | Function::Jacobian(_) => vec!["robot", "q"],
            Function::InverseKinematics(form) if form.is_turned() => vec!["robot", "pose"],
            Function::InverseKinematics(_) => vec!["robot", "position"],
            Function::Quantity(quantity) => quantity.parameters(),
            Function::Free(_) if self.about.gives_robot => vec!["robot", "given"],
            Function::Free(_) => vec!["given"],
        }
    }

    /// Whether it is one of the three functions that every submission can have: of positions, under its own name.
    pub fn is_usual(&self) -> bool {
        let of_positions = match &self.function {
            Function::ForwardKinematics(form) | Function::InverseKinematics(form) => {
                !form.is_turned()
            }
            Function::Jacobian(_) => true,
            Function::Quantity(_) | Function::Free(_) => false,
        };
        of_positions && self.about.name.is_none()
    }
}

/// What of the robot a function task is about.
#[derive(Debug, Clone, PartialEq)]
pub struct About {
    /// The name that the lab gives its function in submissions, if that is not the usual one.
    pub name: Option<String>,
    /// The frame of the robot that counts as its TCP; its own where there is none.
    pub frame: Option<String>,
    /// Names of the joints that it neither gives nor asks.
    pub ignored: Vec<String>,
    /// Whether branches beyond the limits of a joint are none.
    pub within_limits: bool,
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: Vector3<f64>,
    /// Whether a function of the lab's own is given the robot.
    pub gives_robot: bool,
    /// How the entries of a function of the lab's own are compared.
    pub compared: Compared,
}

impl Default for About {
    fn default() -> Self {
        Self {
            name: None,
            frame: None,
            ignored: Vec::new(),
            within_limits: true,
            gravity_m_s2: GRAVITY_M_S2,
            gives_robot: false,
            compared: Compared::default(),
        }
    }
}

/// How expected numbers are compared with answered ones.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Compared {
    /// Names of the entries that are angles \[rad\]: whole turns make no difference, and what is off is not relative.
    pub turns: Vec<String>,
    /// What is expected counts as this great where it is smaller.
    pub least_size: f64,
}

/// One call of a function, and what a right answer is like.
#[derive(Debug, Clone)]
pub struct Case {
    /// Its name; of a hidden case, only its class is ever shown.
    pub name: String,
    /// The class of a hidden case; `None` for a visible one.
    pub hidden_class: Option<String>,
    /// The row of joints that is the robot of the case, such as `RzTxRy`; `None` where it is the lab's.
    pub row: Option<String>,
    /// Dimensions that differ from the robot file's.
    pub dimensions: Vec<(String, Dimension)>,
    /// The robot of the case, with those dimensions; `None` where it is the lab's.
    pub robot: Option<Arc<Robot>>,
    /// What the function is given.
    pub given: Given,
}

/// What a function is given.
#[derive(Debug, Clone, PartialEq)]
pub enum Given {
    /// Positions of all joints, shape `(n)`, the robot's loops closed \[rad or m\]: the function is given those of the task's joints.
    Q(Vec<f64>),
    /// A position of the TCP in the lab's frame \[m\].
    Position {
        /// The position \[m\].
        position_m: [f64; 3],
        /// How many branches reach it; 0 where none does.
        branches: u32,
        /// The pose in the form that the function takes, its numbers; those of a matrix row by row.
        pose: Vec<f64>,
    },
    /// How the joints of the task move: positions, then velocities and accelerations as far as the quantity depends on them, each of one
    /// number per joint.
    Motion(Vec<Vec<f64>>),
    /// Numbers, lists and matrices by name, and what a right answer holds.
    Values {
        /// The entries of the map `given`.
        given: Vec<(String, Entry)>,
        /// The entries of the answer; a single one without a name where the answer has none.
        expected: Vec<(String, Entry)>,
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
    /// The air of a task without a scene, if it states any.
    pub air: Option<Arc<Scene>>,
    /// Gravity in the world: the task's, the scene's, or the usual one \[m/s²\].
    pub gravity_m_s2: Vector3<f64>,
    /// Dry friction of the joints in place of the robot's, shape `(n)`, if the task states it.
    pub dry_friction: Option<Arc<[JointFriction]>>,
    /// What the robot measures: its own sensors, with the task's in their place or after them.
    pub sensors: Vec<Sensor>,
    /// Joint positions at the start, shape `(n)` \[rad or m\].
    pub start_q: Vec<f64>,
    /// Joint velocities at the start, shape `(n)` \[rad/s or m/s\].
    pub start_qd: Vec<f64>,
    /// In mode `prescribed`, the laws of the independent joints.
    pub laws: Option<Arc<[JointLaw]>>,
    /// Pushes on links and bodies.
    pub pushes: Vec<Push>,
    /// What `observation.target` holds, unless that is the goals.
    pub target: Value,
    /// Whether the lab states the target.
    pub has_target: bool,
    /// Where the TCP is to go, in order.
    pub goals: Vec<MotionGoal>,
    /// Functions of `robot` that it grants.
    pub grants: Vec<Grant>,
    /// Paths for the TCP, which checks name.
    pub paths: Vec<PathToFollow>,
}

impl MotionTask {
    /// The scene of a run: the one that the task names, or nothing but its air.
    pub fn scene_of_run(&self) -> Option<&Scene> {
        let named = self.scene.as_ref().map(|scene| &scene.scene);
        named.or(self.air.as_deref())
    }

    /// `robot` with the dry friction of this task.
    pub fn robot_of_run<'r>(&self, robot: &'r Robot) -> Cow<'r, Robot> {
        match &self.dry_friction {
            None => Cow::Borrowed(robot),
            Some(friction) => Cow::Owned(robot.clone().with_dry_friction(friction)),
        }
    }

    /// The number that the task's target has under this name.
    pub fn target_number(&self, wanted: &str) -> Option<f64> {
        let Value::Map(entries) = &self.target else {
            return None;
        };
        entries.iter().find_map(|(name, value)| match value {
            Value::Number(number) if name == wanted => Some(*number),
            _ => None,
        })
    }
}

/// A place the TCP is to reach and to stay at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionGoal {
    /// Position in the lab's frame \[m\].
    pub position_m: Vector3<f64>,
    /// Ticks to stay.
    pub dwell_ticks: u64,
    /// How the TCP is to be turned there, if that matters.
    pub orientation: Option<GoalOrientation>,
}

/// How the TCP is to be turned at a goal, in the lab's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GoalOrientation {
    /// Exactly so.
    Rotation(Rotation3<f64>),
    /// One of its axes points somewhere; turning about it makes no difference. Both are unit vectors.
    Axis {
        /// In the frame of the TCP.
        of_tcp: Vector3<f64>,
        /// Where it points.
        along: Vector3<f64>,
    },
}

impl GoalOrientation {
    /// The angle by which `lab_from_tcp` is off, in `[0, π]` \[rad\].
    pub fn angle_rad(&self, lab_from_tcp: &Rotation3<f64>) -> f64 {
        match self {
            Self::Rotation(wanted) => {
                let off = (wanted.inverse() * lab_from_tcp).into_inner();
                // sine and cosine of the angle: each is well known where the other is not
                let twice_sine =
                    Vector3::new(off.m32 - off.m23, off.m13 - off.m31, off.m21 - off.m12);
                libm::atan2(0.5 * twice_sine.norm(), 0.5 * (off.trace() - 1.0))
            }
            Self::Axis { of_tcp, along } => {
                let axis = lab_from_tcp * of_tcp;
                libm::atan2(axis.cross(along).norm(), axis.dot(along))
            }
        }
    }
}

/// A band of linear partial credit: `full` and better earn everything, `zero` and worse nothing. Less is better where `full` is at or
/// below `zero`, and more where it is above.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Band {
    /// The value that earns all points.
    pub full: f64,
    /// The value that earns none.
    pub zero: f64,
}

impl Band {
    /// The share of points that `value` earns, in `[0, 1]`; NaN earns nothing, and so does infinity, which stands for what never happened.
    pub fn score(&self, value: f64) -> f64 {
        if self.more_is_better() {
            return match value {
                value if value.is_infinite() => 0.0,
                value if value >= self.full => 1.0,
                value if value > self.zero => (value - self.zero) / (self.full - self.zero),
                _ => 0.0,
            };
        }
        if value <= self.full {
            1.0
        } else if value < self.zero {
            (self.zero - value) / (self.zero - self.full)
        } else {
            0.0
        }
    }

    /// Whether greater values earn more.
    pub fn more_is_better(&self) -> bool {
        self.full > self.zero
    }

    /// `lower` where a value is to become less, `raise` where it is to become more.
    pub(crate) fn advice<T>(&self, lower: T, raise: T) -> T {
        if self.more_is_better() { raise } else { lower }
    }
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
    fn a_band_where_more_is_better_rises_linearly() {
        let band = Band {
            full: 4.0,
            zero: 2.0,
        };
        for (value, score) in [(1.0, 0.0), (2.0, 0.0), (3.0, 0.5), (4.0, 1.0), (9.0, 1.0)] {
            assert_eq!(band.score(value), score);
        }
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(band.score(value), 0.0);
        }
    }

    #[test]
    fn an_orientation_is_off_by_the_angle_between() {
        let about_z = |angle: f64| Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
        let exact = GoalOrientation::Rotation(about_z(0.3));
        for angle in [0.3, 0.3 + 1e-9, 0.8, -2.0, 0.3 + std::f64::consts::PI] {
            let off = exact.angle_rad(&about_z(angle));
            assert!((off - (angle - 0.3).abs()).abs() < 1e-12, "{angle}: {off}");
        }
        let axis = GoalOrientation::Axis {
            of_tcp: Vector3::x(),
            along: Vector3::y(),
        };
        // a quarter turn about z takes x to y; a turn about the axis itself makes no difference
        let quarter = about_z(std::f64::consts::FRAC_PI_2);
        let turned = quarter * Rotation3::from_axis_angle(&Vector3::x_axis(), 1.1);
        for right in [quarter, turned] {
            assert!(axis.angle_rad(&right) < 1e-12);
        }
        assert!((axis.angle_rad(&about_z(1.0)) - 0.570_796_326_794_896_6).abs() < 1e-12);
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
