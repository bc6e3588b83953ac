//! The TOML types of `lab.toml`, as typed; spans are kept wherever a later check may point.

use std::collections::BTreeMap;
use std::ops::Range;

use kinemark_sim::control::{Derivative, Mode};
use kinemark_sim::sensor::SensorTable;
use kinemark_sim::text::Spanned;
use serde::Deserialize;

use super::parameters::NumbersTable;
use crate::check::registry::CheckTable;
use crate::task::entry::Entry;
use crate::task::law::{LawOf, SineTable, TimesTable, TrapezoidTable};

/// A number as typed, whole or not.
pub(super) type NumberAt = Spanned<f64>;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LabTable {
    pub(super) format: Spanned<i64>,
    pub(super) name: Spanned<String>,
    pub(super) title: String,
    #[serde(default)]
    pub(super) summary: String,
    pub(super) robot: Spanned<String>,
    pub(super) robot_options: Option<Spanned<RobotOptionsTable>>,
    pub(super) frame: Option<Spanned<String>>,
    #[serde(default)]
    pub(super) budgets: BudgetTable,
    pub(super) kept_after_stop: Option<NumberAt>,
    // read before all else, for the expressions: see `parameters`
    #[serde(default, rename = "parameters")]
    _parameters: NumbersTable,
    #[serde(default)]
    pub(super) dimensions: NumbersTable,
    #[serde(default)]
    pub(super) variants: BTreeMap<Spanned<String>, Spanned<VariesTable>>,
    #[serde(default)]
    pub(super) tasks: Vec<TaskTable>,
}

/// How a URDF is read.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RobotOptionsTable {
    #[serde(default)]
    pub(super) ignore_mimic: bool,
    #[serde(default)]
    pub(super) accept_unphysical: bool,
    #[serde(default)]
    pub(super) balance: bool,
    #[serde(default)]
    pub(super) packages: BTreeMap<String, String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BudgetTable {
    pub(super) operations_per_call: Option<Spanned<u64>>,
    pub(super) operations_per_task: Option<Spanned<u64>>,
    pub(super) instructions_per_call: Option<Spanned<u64>>,
    pub(super) instructions_per_task: Option<Spanned<u64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TaskTable {
    pub(super) name: Spanned<String>,
    pub(super) title: String,
    pub(super) function: Option<FunctionTable>,
    pub(super) motion: Option<Spanned<MotionTable>>,
    #[serde(default)]
    pub(super) checks: Vec<Spanned<CheckTable>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FunctionTable {
    pub(super) call: Spanned<String>,
    pub(super) r#as: Option<Spanned<String>>,
    pub(super) rows: Option<Spanned<Vec<String>>>,
    pub(super) pose: Option<Spanned<String>>,
    pub(super) axis: Option<Spanned<[f64; 3]>>,
    pub(super) frame: Option<Spanned<String>>,
    #[serde(default)]
    pub(super) ignore: Vec<Spanned<String>>,
    pub(super) within_limits: Option<Spanned<bool>>,
    pub(super) gravity_m_s2: Option<Spanned<[f64; 3]>>,
    pub(super) with_robot: Option<Spanned<bool>>,
    pub(super) turns: Option<Spanned<TurnsTable>>,
    pub(super) least_size: Option<NumberAt>,
    #[serde(default)]
    pub(super) grants: Vec<Spanned<String>>,
    #[serde(default)]
    pub(super) cases: Vec<Spanned<CaseTable>>,
}

/// Which entries are angles: the answer itself, or those of these names.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged, expecting = "`turns` is true, or a list of names of entries")]
pub(super) enum TurnsTable {
    Whole(bool),
    Entries(Vec<String>),
}

/// What a free function is to answer.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(
    untagged,
    expecting = "`expected` is a number, a list of numbers or of rows, or a table of these"
)]
pub(super) enum ExpectedTable {
    Whole(Entry),
    Entries(BTreeMap<String, Entry>),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CaseTable {
    pub(super) name: Spanned<String>,
    pub(super) robot: Option<Spanned<String>>,
    pub(super) q_rad: Option<Spanned<Vec<f64>>>,
    pub(super) qd_rad_s: Option<Spanned<Vec<f64>>>,
    pub(super) qdd_rad_s2: Option<Spanned<Vec<f64>>>,
    pub(super) position_m: Option<[f64; 3]>,
    pub(super) yaw_deg: Option<NumberAt>,
    pub(super) axis: Option<Spanned<[f64; 3]>>,
    pub(super) rpy_deg: Option<Spanned<[f64; 3]>>,
    pub(super) branches: Option<Spanned<u64>>,
    #[serde(default)]
    pub(super) dimensions: BTreeMap<String, kinemark_sim::text::Dimension>,
    pub(super) given: Option<BTreeMap<String, Entry>>,
    pub(super) expected: Option<ExpectedTable>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MotionTable {
    pub(super) mode: Mode,
    pub(super) scene: Option<Spanned<SceneTable>>,
    pub(super) duration_s: NumberAt,
    pub(super) physics_step_ms: Option<NumberAt>,
    pub(super) servo_period_ms: Option<NumberAt>,
    pub(super) control_period_ms: Option<NumberAt>,
    pub(super) start_rad: Option<Spanned<Vec<f64>>>,
    pub(super) start_rad_s: Option<Spanned<Vec<f64>>>,
    #[serde(default)]
    pub(super) laws: Vec<Spanned<LawTable>>,
    #[serde(default)]
    pub(super) pushes: Vec<Spanned<PushTable>>,
    pub(super) gravity_m_s2: Option<Spanned<[f64; 3]>>,
    pub(super) wind: Option<Spanned<WindTable>>,
    pub(super) dry_friction: Option<Spanned<FrictionTable>>,
    pub(super) target: Option<Spanned<toml::Value>>,
    #[serde(default)]
    pub(super) goals: Vec<GoalTable>,
    pub(super) servo: Option<Spanned<ServoTable>>,
    #[serde(default)]
    pub(super) sensors: Vec<SensorTable>,
    #[serde(default)]
    pub(super) grants: Vec<Spanned<String>>,
    #[serde(default)]
    pub(super) paths: BTreeMap<Spanned<String>, PathTable>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GoalTable {
    pub(super) position_m: [f64; 3],
    pub(super) dwell_s: NumberAt,
    pub(super) rpy_deg: Option<Spanned<[f64; 3]>>,
    pub(super) axis: Option<Spanned<AxisTable>>,
}

/// An axis of the TCP and where it points.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AxisTable {
    pub(super) of_tcp: [f64; 3],
    pub(super) along: [f64; 3],
}

/// The law of a joint in mode `prescribed`: its name, and one kind of law.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LawTable {
    pub(super) joint: Spanned<String>,
    pub(super) constant: Option<f64>,
    pub(super) polynomial: Option<Vec<f64>>,
    pub(super) sine: Option<SineTable>,
    pub(super) trapezoid: Option<TrapezoidTable>,
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
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PushTable {
    pub(super) on: Spanned<String>,
    pub(super) at_s: NumberAt,
    pub(super) for_s: NumberAt,
    pub(super) force_n: Option<Spanned<[f64; 3]>>,
    pub(super) moment_n_m: Option<Spanned<[f64; 3]>>,
    pub(super) point_m: Option<Spanned<[f64; 3]>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WindTable {
    pub(super) velocity_m_s: Spanned<[f64; 3]>,
    pub(super) air_density_kg_m3: Option<NumberAt>,
    pub(super) gust: Option<Spanned<GustTable>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GustTable {
    pub(super) speed_m_s: NumberAt,
    pub(super) correlation_s: NumberAt,
    pub(super) seed: u64,
}

/// Dry friction of a joint: the same in both directions, or one for each.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(untagged, expecting = "expected an effort, or { positive, negative }")]
pub(super) enum FrictionAt {
    Both(f64),
    Directions { positive: f64, negative: f64 },
}

/// One for all joints, or one per joint.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(
    untagged,
    expecting = "expected an effort or { positive, negative }, or a list of them, one per joint"
)]
pub(super) enum FrictionTable {
    All(FrictionAt),
    Each(Vec<FrictionAt>),
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ServoTable {
    pub(super) kp: Option<PerJoint>,
    pub(super) ki: Option<PerJoint>,
    pub(super) kd: Option<PerJoint>,
    pub(super) derivative: Option<Derivative>,
    pub(super) effort_limit: Option<PerJoint>,
    pub(super) integral_limit: Option<PerJoint>,
    #[serde(default)]
    pub(super) gravity_compensation: bool,
}

/// One number for all joints, or one per joint.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum PerJoint {
    All(f64),
    Each(Vec<f64>),
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
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PathTable {
    pub(super) points_m: Spanned<Vec<[f64; 3]>>,
    pub(super) trim_m: NumberAt,
}

/// `hidden.toml` in the staff's folder.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HiddenTable {
    pub(super) format: Spanned<i64>,
    pub(super) salt: Spanned<String>,
    #[serde(default)]
    pub(super) draws: Vec<Spanned<DrawTable>>,
    #[serde(default)]
    pub(super) runs: Vec<Spanned<HiddenRunsTable>>,
}

/// Cases drawn at random, all of one class.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DrawTable {
    pub(super) task: Spanned<String>,
    pub(super) class: Spanned<String>,
    pub(super) count: Spanned<u32>,
    #[serde(default)]
    pub(super) robots: Vec<Spanned<String>>,
    pub(super) q_rad: Option<Spanned<Vec<[f64; 2]>>>,
    pub(super) qd_rad_s: Option<Spanned<Vec<[f64; 2]>>>,
    pub(super) qdd_rad_s2: Option<Spanned<Vec<[f64; 2]>>>,
    pub(super) position_m: Option<Spanned<[[f64; 2]; 3]>>,
    pub(super) branches: Option<u32>,
    #[serde(default)]
    pub(super) dimensions: RangesTable,
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
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MutantsTable {
    pub(super) format: Spanned<i64>,
    #[serde(default)]
    pub(super) mutants: Vec<MutantTable>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MutantTable {
    pub(super) name: Spanned<String>,
    pub(super) tasks: Spanned<Vec<Spanned<String>>>,
    pub(super) says: Spanned<String>,
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
                #[derive(Deserialize)]
                #[serde(deny_unknown_fields)]
                struct Table {
                    name: Spanned<String>,
                    #[serde(default)]
                    dimensions: BTreeMap<Spanned<String>, kinemark_sim::text::Dimension>,
                }
                let table = serde::de::value::MapAccessDeserializer::new(map);
                let Table { name, dimensions } = Table::deserialize(table)?;
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
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StepsTable {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) step: f64,
}

/// What a parameter varies over: steps of a number, one such table for each number of a list, or choices of anything.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(
    untagged,
    expecting = "expected { from, to, step }, a list of such tables, or { choices = [...] }"
)]
pub(super) enum VariesTable {
    Steps(StepsTable),
    Each(Vec<StepsTable>),
    Choices {
        choices: Vec<kinemark_sim::text::Dimension>,
    },
}

/// A motion task that is run again with other parameters, drawn at random.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HiddenRunsTable {
    pub(super) task: Spanned<String>,
    pub(super) class: Spanned<String>,
    pub(super) count: Spanned<u32>,
    pub(super) parameters: Spanned<RangesTable>,
}
