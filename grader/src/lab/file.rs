//! The TOML types of `lab.toml`, as typed; spans are kept wherever a later check may point.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

use kinemark_sim::control::{Derivative, Mode};
use kinemark_sim::sensor::SensorTable;
use kinemark_sim::text::ParameterSchema;
use kinemark_sim::text::schema::{either, exactly_one};
use kinemark_sim::text::{FileFormat, Spanned};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::parameters::NumbersTable;
use crate::check::check_schema::only_kinds_that_fit;
use crate::check::registry::CheckTable;
use crate::task::entry::Entry;
use crate::task::law::{LawOf, SineTable, TimesTable, TrapezoidTable};

/// A number as typed, whole or not.
pub(super) type NumberAt = Spanned<f64>;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct LabTable {
    /// The version of the format: 1.
    #[serde(rename = "format")]
    _format: FileFormat,
    /// The folder's name.
    pub(super) name: Spanned<String>,
    /// One line, which students read.
    pub(super) title: String,
    /// One sentence, which `kinemark` lists.
    #[serde(default)]
    pub(super) summary: String,
    /// Name of a file in `robots/`, without `.toml`; or a URDF with its ending, such as `arm.urdf`.
    pub(super) robot: Spanned<String>,
    /// How that URDF is read.
    pub(super) robot_options: Option<Spanned<RobotOptionsTable>>,
    /// The robot's frame in which students work; its first link where it is left out.
    pub(super) frame: Option<Spanned<String>>,
    /// How much a submission may compute.
    #[serde(default)]
    pub(super) budgets: BudgetTable,
    /// The share of its points that a run keeps in which the submission failed, 0 to 1; 0.8 where it is left out.
    pub(super) kept_after_stop: Option<NumberAt>,
    /// Named numbers, or lists of them, for expressions such as `"= line_x"`.
    // read before all else, for the expressions: see `parameters`
    #[serde(default, rename = "parameters")]
    #[schemars(with = "BTreeMap<String, ParameterSchema>")]
    _parameters: NumbersTable,
    /// Dimensions of the robot that this lab changes.
    #[serde(default)]
    pub(super) dimensions: NumbersTable,
    /// The values that parameters take in students' variants: `{ from, to, step }`, or a list of such tables for a list.
    #[serde(default)]
    pub(super) variants: BTreeMap<Spanned<String>, Spanned<VariesTable>>,
    /// The tasks, in the order in which they are graded and shown.
    #[serde(default)]
    pub(super) tasks: Vec<TaskTable>,
}

/// How a URDF is read.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RobotOptionsTable {
    /// Whether mimic joints have entries of their own in `q`; false where it is left out.
    #[serde(default)]
    pub(super) ignore_mimic: bool,
    /// Whether inertias that no body can have are taken as they are; false where it is left out.
    #[serde(default)]
    pub(super) accept_unphysical: bool,
    /// Whether the principal moments of such inertias become their mean; false where it is left out.
    #[serde(default)]
    pub(super) balance: bool,
    /// Folders of packages of ROS, by their names.
    #[serde(default)]
    pub(super) packages: BTreeMap<String, String>,
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct BudgetTable {
    /// Operations of a script in a call, 1 to 1,000,000,000; 25,000 where it is left out.
    pub(super) operations_per_call: Option<Spanned<u64>>,
    /// Operations of a script in a task, 1 to 1,000,000,000; 5,000,000 where it is left out.
    pub(super) operations_per_task: Option<Spanned<u64>>,
    /// Instructions of a compiled module in a call, 1 to 40,000,000,000; 1,000,000 where it is left out.
    pub(super) instructions_per_call: Option<Spanned<u64>>,
    /// Instructions of a compiled module in a task, 1 to 40,000,000,000; 200,000,000 where it is left out.
    pub(super) instructions_per_task: Option<Spanned<u64>>,
}

/// A task is of one kind.
fn of_one_work(schema: &mut Schema) {
    exactly_one(&["function", "motion"])(schema);
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = of_one_work, transform = only_kinds_that_fit)]
pub(super) struct TaskTable {
    /// Its name: lower-case letters, digits and `-`.
    pub(super) name: Spanned<String>,
    /// One line, which students read.
    pub(super) title: String,
    /// A function of the submission is called on cases.
    pub(super) function: Option<FunctionTable>,
    /// The robot moves under the submission's `control`.
    pub(super) motion: Option<Spanned<MotionTable>>,
    /// What earns points, at least one.
    #[serde(default)]
    pub(super) checks: Vec<Spanned<CheckTable>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FunctionTable {
    /// `forward_kinematics`, `inverse_kinematics`, `jacobian`, or a function of the lab's own.
    pub(super) call: Spanned<String>,
    /// The function's name in submissions, where it is not the name in `call`.
    pub(super) r#as: Option<Spanned<String>>,
    /// The rows of `jacobian`, `velocity` or `acceleration`: some of `x`, `y`, `z`, `rx`, `ry`, `rz`, in this order; `["x", "y", "z"]`
    /// where it is left out.
    pub(super) rows: Option<Spanned<Vec<String>>>,
    /// How much of the pose counts for the two kinematics: `position`, `yaw`, `axis` or `full`.
    pub(super) pose: Option<Spanned<String>>,
    /// With `pose = "axis"`: the axis of the TCP that counts; `[0, 0, 1]` where it is left out.
    pub(super) axis: Option<Spanned<[f64; 3]>>,
    /// The frame or link of the robot that is the TCP in this task.
    pub(super) frame: Option<Spanned<String>>,
    /// Joints that the function neither is given nor answers.
    #[serde(default)]
    pub(super) ignore: Vec<Spanned<String>>,
    /// For `inverse_kinematics`: whether a branch beyond the limits of a joint is none; true where it is left out.
    pub(super) within_limits: Option<Spanned<bool>>,
    /// For `torque` and `gravity`: gravity in the world \[m/s²\].
    pub(super) gravity_m_s2: Option<Spanned<[f64; 3]>>,
    /// Whether a function of the lab's own is given the robot.
    pub(super) with_robot: Option<Spanned<bool>>,
    /// Entries of the answer that are angles, or `true` for an answer without names.
    pub(super) turns: Option<Spanned<TurnsTable>>,
    /// What is expected counts as this great where it is smaller.
    pub(super) least_size: Option<NumberAt>,
    /// Functions of `robot` that the task lends: `fk`, `jacobian`, `gravity`, `mass_matrix`.
    #[serde(default)]
    pub(super) grants: Vec<Spanned<String>>,
    /// The visible cases, at least one.
    #[serde(default)]
    pub(super) cases: Vec<Spanned<CaseTable>>,
}

/// Which entries are angles: the answer itself, or those of these names.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "`turns` is true, or a list of names of entries")]
pub(super) enum TurnsTable {
    /// Whether the answer itself is one.
    Whole(bool),
    /// Those of these names.
    Entries(Vec<String>),
}

/// What a free function is to answer.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "`expected` is a number, a list of numbers or of rows, or a table of these"
)]
pub(super) enum ExpectedTable {
    /// A number, a list of numbers or a matrix.
    Whole(Entry),
    /// Entries by name.
    Entries(BTreeMap<String, Entry>),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CaseTable {
    /// Its name, which reports show.
    pub(super) name: Spanned<String>,
    /// A row of joints such as `RzTxRy` in place of the lab's robot.
    pub(super) robot: Option<Spanned<String>>,
    /// Joint positions, one per joint of the task \[rad, or m of a prismatic joint\].
    pub(super) q_rad: Option<Spanned<Vec<f64>>>,
    /// Joint velocities \[rad/s, or m/s of a prismatic joint\].
    pub(super) qd_rad_s: Option<Spanned<Vec<f64>>>,
    /// Joint accelerations \[rad/s², or m/s² of a prismatic joint\].
    pub(super) qdd_rad_s2: Option<Spanned<Vec<f64>>>,
    /// Where the TCP is to be, for `inverse_kinematics`: `[x, y, z]` in the lab's frame \[m\].
    pub(super) position_m: Option<[f64; 3]>,
    /// The heading of the TCP there, with `pose = "yaw"` \[degrees\].
    pub(super) yaw_deg: Option<NumberAt>,
    /// Where the axis of the TCP points there, with `pose = "axis"`.
    pub(super) axis: Option<Spanned<[f64; 3]>>,
    /// How the TCP is turned there, with `pose = "full"`: roll, pitch, yaw \[degrees\].
    pub(super) rpy_deg: Option<Spanned<[f64; 3]>>,
    /// How many branches reach the position; 2 where it is left out, 1 at the boundary, 0 out of reach.
    pub(super) branches: Option<Spanned<u64>>,
    /// Dimensions of the robot that differ in this case.
    #[serde(default)]
    pub(super) dimensions: BTreeMap<String, kinemark_sim::text::Dimension>,
    /// The argument of a function of the lab's own: numbers, lists of numbers and matrices by name.
    pub(super) given: Option<BTreeMap<String, Entry>>,
    /// What a function of the lab's own is to answer.
    pub(super) expected: Option<ExpectedTable>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MotionTable {
    /// What a command means; or `prescribed`: the joints follow `laws`, and a command is the effort that the submission expects.
    pub(super) mode: Mode,
    /// What is around the robot: name of a file in `scenes/`, without `.toml`, or a table with its name and dimensions that differ.
    pub(super) scene: Option<Spanned<SceneTable>>,
    /// Length of the run, a whole multiple of the physics step \[s\].
    pub(super) duration_s: NumberAt,
    /// Physics step \[ms\]; 1 where it is left out.
    pub(super) physics_step_ms: Option<NumberAt>,
    /// Servo period, a whole multiple of the physics step \[ms\]; 1 where it is left out.
    pub(super) servo_period_ms: Option<NumberAt>,
    /// Control period, a whole multiple of the servo period \[ms\]; 10 where it is left out.
    pub(super) control_period_ms: Option<NumberAt>,
    /// Positions at the start, one per joint that moves \[rad, or m of a prismatic joint\]; the robot's home where it is left out.
    pub(super) start_rad: Option<Spanned<Vec<f64>>>,
    /// Velocities at the start, one per joint that moves \[rad/s, or m/s of a prismatic joint\]; at rest where it is left out.
    pub(super) start_rad_s: Option<Spanned<Vec<f64>>>,
    /// Laws of motion in mode `prescribed`, and only there.
    #[serde(default)]
    pub(super) laws: Vec<Spanned<LawTable>>,
    /// Pushes on links and bodies.
    #[serde(default)]
    pub(super) pushes: Vec<Spanned<PushTable>>,
    /// Acceleration of free fall, `[x, y, z]` in the world \[m/s²\]; the scene's where it is left out, else 9.81 downwards.
    pub(super) gravity_m_s2: Option<Spanned<[f64; 3]>>,
    /// The air around the robot; the scene's where it is left out, else none.
    pub(super) wind: Option<Spanned<WindTable>>,
    /// Dry friction of all joints, or a list with one per joint that moves \[N m or N\]; the robot's where it is left out.
    pub(super) dry_friction: Option<Spanned<FrictionTable>>,
    /// What `observation.target` holds: anything but dates; the goals where it is left out.
    #[schemars(with = "Option<serde_json::Value>")]
    pub(super) target: Option<Spanned<toml::Value>>,
    /// Where the TCP is to go and stay, in order.
    #[serde(default)]
    pub(super) goals: Vec<GoalTable>,
    /// The joint servo; all gains are zero where it is left out.
    pub(super) servo: Option<Spanned<ServoTable>>,
    /// Sensors of this task: one with the name of a sensor of the robot replaces it, others are added.
    #[serde(default)]
    pub(super) sensors: Vec<SensorTable>,
    /// Functions of `robot` that the task lends: `fk`, `jacobian`, `gravity`, `mass_matrix`.
    #[serde(default)]
    pub(super) grants: Vec<Spanned<String>>,
    /// Paths for the TCP by name, which checks refer to.
    #[serde(default)]
    pub(super) paths: BTreeMap<Spanned<String>, PathTable>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct GoalTable {
    /// Position of the TCP in the lab's frame \[m\].
    pub(super) position_m: [f64; 3],
    /// How long it stays, a whole multiple of the physics step \[s\].
    pub(super) dwell_s: NumberAt,
    /// Rotation of the TCP: roll, pitch and yaw about the fixed axes of the lab's frame \[deg\].
    pub(super) rpy_deg: Option<Spanned<[f64; 3]>>,
    /// Where one axis of the TCP points, in place of a rotation.
    pub(super) axis: Option<Spanned<AxisTable>>,
}

/// An axis of the TCP and where it points.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct AxisTable {
    /// The axis, in the frame of the TCP.
    pub(super) of_tcp: [f64; 3],
    /// Where it points, in the lab's frame.
    pub(super) along: [f64; 3],
}

/// A joint has one law.
fn of_one_law(schema: &mut Schema) {
    exactly_one(&["constant", "polynomial", "sine", "trapezoid", "table"])(schema);
}

/// The law of a joint in mode `prescribed`: its name, and one kind of law.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = of_one_law)]
pub(super) struct LawTable {
    /// The joint.
    pub(super) joint: Spanned<String>,
    /// At rest here \[rad, or m of a prismatic joint\].
    pub(super) constant: Option<f64>,
    /// `[c0, c1, c2, ...]`: `c0 + c1 t + c2 t² + ...`.
    pub(super) polynomial: Option<Vec<f64>>,
    /// `offset + amplitude sin(ω t + phase)`.
    pub(super) sine: Option<SineTable>,
    /// From rest to rest with a trapezoidal velocity.
    pub(super) trapezoid: Option<TrapezoidTable>,
    /// A cubic spline.
    pub(super) table: Option<TimesTable>,
}

impl LawTable {
    /// Its law, without the joint.
    pub(super) fn law(&self) -> LawOf {
        LawOf {
            constant: self.constant,
            polynomial: self.polynomial.clone(),
            sine: self.sine.clone(),
            trapezoid: self.trapezoid.clone(),
            table: self.table.clone(),
        }
    }
}

/// A push on a link or a body.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PushTable {
    /// A link behind a joint that moves, or a dynamic body of the scene.
    pub(super) on: Spanned<String>,
    /// When it begins, a whole multiple of the physics step \[s\].
    pub(super) at_s: NumberAt,
    /// How long it lasts, a whole multiple of the physics step \[s\].
    pub(super) for_s: NumberAt,
    /// Force, `[x, y, z]` in the world \[N\].
    pub(super) force_n: Option<Spanned<[f64; 3]>>,
    /// Moment besides that of the force, `[x, y, z]` in the world \[N m\]; links only.
    pub(super) moment_n_m: Option<Spanned<[f64; 3]>>,
    /// Where the force acts, in the link's frame \[m\]; the centre of mass where it is left out.
    pub(super) point_m: Option<Spanned<[f64; 3]>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct WindTable {
    /// Mean velocity of the air, in the world \[m/s\].
    pub(super) velocity_m_s: Spanned<[f64; 3]>,
    /// Density of the air \[kg/m³\]; 1.225 where it is left out.
    pub(super) air_density_kg_m3: Option<NumberAt>,
    /// What comes and goes along the mean velocity.
    pub(super) gust: Option<Spanned<GustTable>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct GustTable {
    /// Standard deviation of the speed, zero or more \[m/s\].
    pub(super) speed_m_s: NumberAt,
    /// Time in which the correlation falls to 1/e, positive \[s\].
    pub(super) correlation_s: NumberAt,
    /// The same seed gives the same gusts on every machine.
    pub(super) seed: u64,
}

/// Dry friction of a joint: the same in both directions, or one for each.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected an effort, or { positive, negative }")]
pub(super) enum FrictionAt {
    /// The same in both directions \[N m or N\].
    Both(f64),
    /// One for each direction.
    Directions {
        /// Effort against motion in the positive direction \[N m or N\].
        positive: f64,
        /// Effort against motion in the negative direction \[N m or N\].
        negative: f64,
    },
}

/// One for all joints, or one per joint.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected an effort or { positive, negative }, or a list of them, one per joint"
)]
pub(super) enum FrictionTable {
    /// Of all joints.
    All(FrictionAt),
    /// One per joint that moves.
    Each(Vec<FrictionAt>),
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ServoTable {
    /// Gain of the position, or of the velocity in mode `velocity`; 0 where it is left out. One number for all joints, or one per joint.
    pub(super) kp: Option<PerJoint>,
    /// Gain of the integral; 0 where it is left out. One number for all joints, or one per joint.
    pub(super) ki: Option<PerJoint>,
    /// Gain of the derivative; 0 where it is left out. One number for all joints, or one per joint.
    pub(super) kd: Option<PerJoint>,
    /// What the derivative is of; `measurement` where it is left out.
    pub(super) derivative: Option<Derivative>,
    /// Greatest effort \[N m or N\]; the robot's where it is left out, and never beyond it. One number for all joints, or one per joint.
    pub(super) effort_limit: Option<PerJoint>,
    /// Greatest effort of the integral part \[N m or N\]; none where it is left out. One number for all joints, or one per joint.
    pub(super) integral_limit: Option<PerJoint>,
    /// Whether the effort that holds the robot against gravity is added; false where it is left out.
    #[serde(default)]
    pub(super) gravity_compensation: bool,
}

/// One number for all joints, or one per joint.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum PerJoint {
    All(f64),
    Each(Vec<f64>),
}

impl JsonSchema for PerJoint {
    fn schema_name() -> Cow<'static, str> {
        "PerJoint".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        kinemark_sim::text::Dimension::json_schema(generator)
    }
}

impl<'de> Deserialize<'de> for PerJoint {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        use kinemark_sim::text::Dimension;
        Ok(match Dimension::deserialize(deserializer)? {
            Dimension::Number(value) => Self::All(value),
            Dimension::List(values) => Self::Each(values),
            Dimension::Text(_) => {
                let message = "expected a number, or a list of numbers, one per joint";
                return Err(serde::de::Error::custom(message));
            }
        })
    }
}

/// A path of straight segments, named by its key in `[tasks.motion.paths]`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PathTable {
    /// Corners of the path in the lab's frame, at least two \[m\].
    pub(super) points_m: Spanned<Vec<[f64; 3]>>,
    /// Length at either end of a segment that is not looked at \[m\].
    pub(super) trim_m: NumberAt,
}

/// `hidden.toml` in the staff's folder.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct HiddenTable {
    /// The version of the format: 1.
    #[serde(rename = "format")]
    _format: FileFormat,
    /// A text that nobody guesses: the numbers are drawn from it.
    pub(super) salt: Spanned<String>,
    /// Hidden cases of function tasks.
    #[serde(default)]
    pub(super) draws: Vec<Spanned<DrawTable>>,
    /// Hidden runs of motion tasks.
    #[serde(default)]
    pub(super) runs: Vec<Spanned<HiddenRunsTable>>,
}

/// Cases drawn at random, all of one class.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct DrawTable {
    /// A function task.
    pub(super) task: Spanned<String>,
    /// All that students learn about these cases.
    pub(super) class: Spanned<String>,
    /// How many cases, 1 to 1000.
    pub(super) count: Spanned<u32>,
    /// Rows of joints of equal length, one of which each case has for its robot.
    #[serde(default)]
    pub(super) robots: Vec<Spanned<String>>,
    /// `[low, high]` per joint of the task \[rad, or m of a prismatic joint\]; for `inverse_kinematics` the target is the pose there.
    pub(super) q_rad: Option<Spanned<Vec<[f64; 2]>>>,
    /// `[low, high]` per joint of the task: joint velocities \[rad/s or m/s\].
    pub(super) qd_rad_s: Option<Spanned<Vec<[f64; 2]>>>,
    /// `[low, high]` per joint of the task: joint accelerations \[rad/s² or m/s²\].
    pub(super) qdd_rad_s2: Option<Spanned<Vec<[f64; 2]>>>,
    /// For `inverse_kinematics`: `[low, high]` for x, y and z in the lab's frame \[m\].
    pub(super) position_m: Option<Spanned<[[f64; 2]; 3]>>,
    /// How many branches reach the positions; 2 where it is left out with `q_rad`, needed with `position_m`.
    pub(super) branches: Option<u32>,
    /// Dimensions of the robot: `[low, high]`, or a list of such ranges for a list.
    #[serde(default)]
    pub(super) dimensions: RangesTable,
    /// For a function of the lab's own: `[low, high]` for every name that the visible cases give, or a list of such ranges for a list.
    pub(super) given: Option<RangesTable>,
}

/// Names with ranges, the places of both kept.
pub(super) type RangesTable = BTreeMap<Spanned<String>, Spanned<Ranges>>;

/// A range for a number, or one for each number of a list.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Ranges {
    One([f64; 2]),
    Each(Vec<[f64; 2]>),
}

impl Ranges {
    /// All of them.
    pub(super) fn all(&self) -> &[[f64; 2]] {
        match self {
            Self::One(range) => std::slice::from_ref(range),
            Self::Each(ranges) => ranges,
        }
    }

    /// The low ends (0) or the high ones (1).
    pub(super) fn end(&self, end: usize) -> kinemark_sim::text::Dimension {
        use kinemark_sim::text::Dimension;
        match self {
            Self::One(range) => Dimension::Number(range[end]),
            Self::Each(ranges) => Dimension::List(ranges.iter().map(|r| r[end]).collect()),
        }
    }
}

impl JsonSchema for Ranges {
    fn schema_name() -> Cow<'static, str> {
        "Ranges".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let each = <Vec<[f64; 2]>>::json_schema(generator);
        either(<[f64; 2]>::json_schema(generator), each)
    }
}

impl<'de> Deserialize<'de> for Ranges {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OneOrEach;
        impl<'de> serde::de::Visitor<'de> for OneOrEach {
            type Value = Ranges;
            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("[low, high], or a list of them")
            }
            fn visit_seq<A: serde::de::SeqAccess<'de>>(
                self,
                mut seq: A,
            ) -> Result<Ranges, A::Error> {
                use kinemark_sim::text::Dimension;
                let mut numbers = Vec::new();
                let mut pairs = Vec::new();
                while let Some(item) = seq.next_element::<Dimension>()? {
                    match item {
                        Dimension::Number(number) => numbers.push(number),
                        Dimension::List(list) => match <[f64; 2]>::try_from(list) {
                            Ok(pair) => pairs.push(pair),
                            Err(_) => {
                                return Err(serde::de::Error::custom("a range is [low, high]"));
                            }
                        },
                        Dimension::Text(_) => {
                            return Err(serde::de::Error::custom("a range is of numbers"));
                        }
                    }
                }
                match (<[f64; 2]>::try_from(numbers), pairs.is_empty()) {
                    (Ok(pair), true) => Ok(Ranges::One(pair)),
                    (Err(numbers), false) if numbers.is_empty() => Ok(Ranges::Each(pairs)),
                    _ => Err(serde::de::Error::custom(
                        "expected [low, high], or a list of them",
                    )),
                }
            }
        }
        deserializer.deserialize_seq(OneOrEach)
    }
}

/// `mutants.toml` in the staff's folder.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MutantsTable {
    /// The version of the format: 1.
    #[serde(rename = "format")]
    _format: FileFormat,
    /// The mutants.
    #[serde(default)]
    pub(super) mutants: Vec<MutantTable>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MutantTable {
    /// Its name: the submission is `mutants/NAME.rhai`.
    pub(super) name: Spanned<String>,
    /// The tasks in which the misconception shows.
    pub(super) tasks: Spanned<Vec<Spanned<String>>>,
    /// The misconception in words, as students read it; or such words for each of the tasks, by their names.
    pub(super) says: Spanned<SaysTable>,
}

/// What a mutant says.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "`says` is a text, or a table with a text for each task: { fk = \"...\", ik = \"...\" }"
)]
pub(super) enum SaysTable {
    /// The same in every task.
    All(String),
    /// For each task by its name.
    Each(BTreeMap<String, String>),
}

/// The scene of a motion task: its name alone, or with dimensions that differ from its file's.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct SceneTable {
    pub(super) name: String,
    pub(super) dimensions: BTreeMap<String, kinemark_sim::text::Dimension>,
    /// Where the name stands in a table.
    pub(super) name_at: Option<Range<usize>>,
    /// Where the dimensions' names stand.
    pub(super) dimensions_at: BTreeMap<String, Range<usize>>,
}

/// A scene as a table.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct NamedScene {
    /// Name of a file in `scenes/`, without `.toml`.
    name: Spanned<String>,
    /// Dimensions of the scene file that differ.
    #[serde(default)]
    dimensions: BTreeMap<Spanned<String>, kinemark_sim::text::Dimension>,
}

impl JsonSchema for SceneTable {
    fn schema_name() -> Cow<'static, str> {
        "SceneTable".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        either(
            String::json_schema(generator),
            NamedScene::json_schema(generator),
        )
    }
}

impl<'de> Deserialize<'de> for SceneTable {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NameOrTable;
        impl<'de> serde::de::Visitor<'de> for NameOrTable {
            type Value = SceneTable;
            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("the name of a scene, or { name = \"...\", dimensions = { ... } }")
            }
            fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<SceneTable, E> {
                Ok(SceneTable {
                    name: name.to_owned(),
                    ..SceneTable::default()
                })
            }
            fn visit_map<A: serde::de::MapAccess<'de>>(
                self,
                map: A,
            ) -> Result<SceneTable, A::Error> {
                let table = serde::de::value::MapAccessDeserializer::new(map);
                let NamedScene { name, dimensions } = NamedScene::deserialize(table)?;
                let places = dimensions.keys();
                Ok(SceneTable {
                    name_at: Some(name.span()),
                    dimensions_at: places.map(|at| (at.get_ref().clone(), at.span())).collect(),
                    name: name.into_inner(),
                    dimensions: dimensions
                        .into_iter()
                        .map(|(name, value)| (name.into_inner(), value))
                        .collect(),
                })
            }
        }
        deserializer.deserialize_any(NameOrTable)
    }
}

/// The values that a parameter takes in variants.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct StepsTable {
    /// The first value.
    pub(super) from: f64,
    /// No value is beyond this.
    pub(super) to: f64,
    /// From one value to the next.
    pub(super) step: f64,
}

/// What a parameter varies over: steps of a number, one such table for each number of a list, or choices of anything.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected { from, to, step }, a list of such tables, or { choices = [...] }"
)]
pub(super) enum VariesTable {
    /// Steps of a number.
    Steps(StepsTable),
    /// Steps of each number of a list.
    Each(Vec<StepsTable>),
    /// One of several values.
    Choices(ChoicesTable),
}

/// Choices, all of the parameter's shape.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ChoicesTable {
    /// The values, each as likely as the others.
    #[schemars(with = "Vec<ParameterSchema>")]
    pub(super) choices: Vec<kinemark_sim::text::Dimension>,
}

/// A motion task that is run again with other parameters, drawn at random.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct HiddenRunsTable {
    /// A motion task.
    pub(super) task: Spanned<String>,
    /// All that students learn about these runs.
    pub(super) class: Spanned<String>,
    /// How many runs, 1 to 20.
    pub(super) count: Spanned<u32>,
    /// Parameters that are drawn: `[low, high]`, or a list of such ranges for a list.
    pub(super) parameters: Spanned<RangesTable>,
}
