//! The TOML types of a motion task: goals, laws, surroundings, servo, paths, scene.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

use kinemark_sim::control::{Derivative, Mode};
use kinemark_sim::sensor::SensorTable;
use kinemark_sim::text::Spanned;
use kinemark_sim::text::schema::{either, exactly_one};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::NumberAt;
use crate::task::law::{LawOf, SineTable, TimesTable, TrapezoidTable};
use crate::task::push::PushTable;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct MotionTable {
    /// What a command means; or `prescribed`: the joints follow `laws`, and a command is the effort that the submission expects.
    pub(in crate::lab) mode: Mode,
    /// What is around the robot: name of a file in `scenes/`, without `.toml`, or a table with its name and dimensions that differ.
    pub(in crate::lab) scene: Option<Spanned<SceneTable>>,
    /// Length of the run, a whole multiple of the physics step \[s\].
    pub(in crate::lab) duration_s: NumberAt,
    /// Physics step \[ms\]; 1 where it is left out.
    pub(in crate::lab) physics_step_ms: Option<NumberAt>,
    /// Servo period, a whole multiple of the physics step \[ms\]; 1 where it is left out.
    pub(in crate::lab) servo_period_ms: Option<NumberAt>,
    /// Control period, a whole multiple of the servo period \[ms\]; 10 where it is left out.
    pub(in crate::lab) control_period_ms: Option<NumberAt>,
    /// Positions at the start, one per joint that moves \[rad, or m of a prismatic joint\]; the robot's home where it is left out.
    pub(in crate::lab) start_rad: Option<Spanned<Vec<f64>>>,
    /// Velocities at the start, one per joint that moves \[rad/s, or m/s of a prismatic joint\]; at rest where it is left out.
    pub(in crate::lab) start_rad_s: Option<Spanned<Vec<f64>>>,
    /// Laws of motion in mode `prescribed`, and only there.
    #[serde(default)]
    pub(in crate::lab) laws: Vec<Spanned<LawTable>>,
    /// Pushes on links and bodies.
    #[serde(default)]
    pub(in crate::lab) pushes: Vec<Spanned<PushTable>>,
    /// Acceleration of free fall, `[x, y, z]` in the world \[m/s²\]; the scene's where it is left out, else 9.81 downwards.
    pub(in crate::lab) gravity_m_s2: Option<Spanned<[f64; 3]>>,
    /// The air around the robot; the scene's where it is left out, else none.
    pub(in crate::lab) wind: Option<Spanned<WindTable>>,
    /// Dry friction of all joints, or a list with one per joint that moves \[N m or N\]; the robot's where it is left out.
    pub(in crate::lab) dry_friction: Option<Spanned<FrictionTable>>,
    /// What `observation.target` holds: anything but dates; the goals where it is left out.
    #[schemars(with = "Option<serde_json::Value>")]
    pub(in crate::lab) target: Option<Spanned<toml::Value>>,
    /// Where the TCP is to go and stay, in order.
    #[serde(default)]
    pub(in crate::lab) goals: Vec<GoalTable>,
    /// The joint servo; all gains are zero where it is left out.
    pub(in crate::lab) servo: Option<Spanned<ServoTable>>,
    /// Sensors of this task: one with the name of a sensor of the robot replaces it, others are added.
    #[serde(default)]
    pub(in crate::lab) sensors: Vec<SensorTable>,
    /// Functions of `robot` that the task lends: `fk`, `jacobian`, `gravity`, `mass_matrix`.
    #[serde(default)]
    pub(in crate::lab) grants: Vec<Spanned<String>>,
    /// Paths for the TCP by name, which checks refer to.
    #[serde(default)]
    pub(in crate::lab) paths: BTreeMap<Spanned<String>, PathTable>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct GoalTable {
    /// Position of the TCP in the lab's frame \[m\].
    pub(in crate::lab) position_m: [f64; 3],
    /// How long it stays, a whole multiple of the physics step \[s\].
    pub(in crate::lab) dwell_s: NumberAt,
    /// Rotation of the TCP: roll, pitch and yaw about the fixed axes of the lab's frame \[deg\].
    pub(in crate::lab) rpy_deg: Option<Spanned<[f64; 3]>>,
    /// Where one axis of the TCP points, in place of a rotation.
    pub(in crate::lab) axis: Option<Spanned<AxisTable>>,
}

/// An axis of the TCP and where it points.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct AxisTable {
    /// The axis, in the frame of the TCP.
    pub(in crate::lab) of_tcp: [f64; 3],
    /// Where it points, in the lab's frame.
    pub(in crate::lab) along: [f64; 3],
}

/// A joint has one law.
fn of_one_law(schema: &mut Schema) {
    exactly_one(&["constant", "polynomial", "sine", "trapezoid", "table"])(schema);
}

/// The law of a joint in mode `prescribed`: its name, and one kind of law.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = of_one_law)]
pub(in crate::lab) struct LawTable {
    /// The joint.
    pub(in crate::lab) joint: Spanned<String>,
    /// At rest here \[rad, or m of a prismatic joint\].
    pub(in crate::lab) constant: Option<f64>,
    /// `[c0, c1, c2, ...]`: `c0 + c1 t + c2 t² + ...`.
    pub(in crate::lab) polynomial: Option<Vec<f64>>,
    /// `offset + amplitude sin(ω t + phase)`.
    pub(in crate::lab) sine: Option<SineTable>,
    /// From rest to rest with a trapezoidal velocity.
    pub(in crate::lab) trapezoid: Option<TrapezoidTable>,
    /// A cubic spline.
    pub(in crate::lab) table: Option<TimesTable>,
}

impl LawTable {
    /// Its law, without the joint.
    pub(in crate::lab) fn law(&self) -> LawOf {
        LawOf {
            constant: self.constant,
            polynomial: self.polynomial.clone(),
            sine: self.sine.clone(),
            trapezoid: self.trapezoid.clone(),
            table: self.table.clone(),
        }
    }
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct WindTable {
    /// Mean velocity of the air, in the world \[m/s\].
    pub(in crate::lab) velocity_m_s: Spanned<[f64; 3]>,
    /// Density of the air \[kg/m³\]; 1.225 where it is left out.
    pub(in crate::lab) air_density_kg_m3: Option<NumberAt>,
    /// What comes and goes along the mean velocity.
    pub(in crate::lab) gust: Option<Spanned<GustTable>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct GustTable {
    /// Standard deviation of the speed, zero or more \[m/s\].
    pub(in crate::lab) speed_m_s: NumberAt,
    /// Time in which the correlation falls to 1/e, positive \[s\].
    pub(in crate::lab) correlation_s: NumberAt,
    /// The same seed gives the same gusts on every machine.
    pub(in crate::lab) seed: u64,
}

/// Dry friction of a joint: the same in both directions, or one for each.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected an effort, or { positive, negative }")]
pub(in crate::lab) enum FrictionAt {
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
pub(in crate::lab) enum FrictionTable {
    /// Of all joints.
    All(FrictionAt),
    /// One per joint that moves.
    Each(Vec<FrictionAt>),
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(in crate::lab) struct ServoTable {
    /// Gain of the position, or of the velocity in mode `velocity`; 0 where it is left out. One number for all joints, or one per joint.
    pub(in crate::lab) kp: Option<PerJoint>,
    /// Gain of the integral; 0 where it is left out. One number for all joints, or one per joint.
    pub(in crate::lab) ki: Option<PerJoint>,
    /// Gain of the derivative; 0 where it is left out. One number for all joints, or one per joint.
    pub(in crate::lab) kd: Option<PerJoint>,
    /// What the derivative is of; `measurement` where it is left out.
    pub(in crate::lab) derivative: Option<Derivative>,
    /// Greatest effort \[N m or N\]; the robot's where it is left out, and never beyond it. One number for all joints, or one per joint.
    pub(in crate::lab) effort_limit: Option<PerJoint>,
    /// Greatest effort of the integral part \[N m or N\]; none where it is left out. One number for all joints, or one per joint.
    pub(in crate::lab) integral_limit: Option<PerJoint>,
    /// Whether the effort that holds the robot against gravity is added; false where it is left out.
    #[serde(default)]
    pub(in crate::lab) gravity_compensation: bool,
}

/// One number for all joints, or one per joint.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::lab) enum PerJoint {
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
pub(in crate::lab) struct PathTable {
    /// Corners of the path in the lab's frame, at least two \[m\].
    pub(in crate::lab) points_m: Spanned<Vec<[f64; 3]>>,
    /// Length at either end of a segment that is not looked at \[m\].
    pub(in crate::lab) trim_m: NumberAt,
}

/// The scene of a motion task: its name alone, or with dimensions that differ from its file's.
#[derive(Debug, Clone, PartialEq, Default)]
pub(in crate::lab) struct SceneTable {
    pub(in crate::lab) name: String,
    pub(in crate::lab) dimensions: BTreeMap<String, kinemark_sim::text::Dimension>,
    /// Where the name stands in a table.
    pub(in crate::lab) name_at: Option<Range<usize>>,
    /// Where the dimensions' names stand.
    pub(in crate::lab) dimensions_at: BTreeMap<String, Range<usize>>,
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
