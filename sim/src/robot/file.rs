//! The TOML types of a robot file, as typed by a person: numbers may be expressions over `[dimensions]`, and every place a later
//! check may point at keeps its span.

use std::fmt;

use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};
use toml::Spanned;

use super::part::tables::{
    ContactTable, DragTable, InertiaTable, NumberAt, OriginTable, ShapeTable, TripleAt,
};
use super::part::{Meshes, PartProblem};
use super::problem::RobotError;
use crate::sensor::SensorTable;
use crate::source::{Source, TomlRefusal};

/// What messages call this kind of file.
pub(super) const KIND: &str = "robot";

/// A robot file: its text and its tables. [`RobotFile::build`](RobotFile::build) makes the robot.
#[derive(Debug, Clone)]
pub struct RobotFile {
    pub(super) source: Source,
    pub(super) tables: Tables,
    pub(super) meshes: Meshes,
}

impl RobotFile {
    /// Reads a robot file's text.
    ///
    /// # Errors
    /// What the TOML reader refuses: syntax, an unknown key, a wrong type, a missing key.
    pub fn parse(source: Source) -> Result<Self, RobotError> {
        match toml::from_str::<Tables>(source.text()) {
            Ok(tables) => Ok(Self {
                source,
                tables,
                meshes: Meshes::default(),
            }),
            Err(error) => {
                let TomlRefusal { message, help, at } =
                    TomlRefusal::from_error(&error, source.text());
                let problem = PartProblem::Toml { message, help };
                Err(RobotError::new(problem.into(), &source, at))
            }
        }
    }

    /// Reads the meshes that its shapes name, each once, by `read`: the bytes of a file, or why there are none.
    ///
    /// # Errors
    /// A file that cannot be read, or is no mesh.
    pub fn with_meshes(
        mut self,
        read: impl FnMut(&str) -> Result<Vec<u8>, String>,
    ) -> Result<Self, RobotError> {
        let shapes = self.tables.links.iter().flat_map(|link| &link.shapes);
        self.meshes = Meshes::read(&self.source, KIND, shapes, read)?;
        Ok(self)
    }

    /// The text it was read from.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// The dimensions as the file states them.
    pub fn dimensions(&self) -> &Dimensions {
        &self.tables.dimensions
    }
}

/// The named dimensions of a robot, in file order.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Dimensions(Vec<(String, Dimension)>);

/// One named dimension: a number or a list of numbers, SI units.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Dimension {
    /// One number.
    Number(f64),
    /// A list, indexed from zero.
    List(Vec<f64>),
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(_) => write!(f, "one number"),
            Self::List(values) => write!(f, "a list of {}", values.len()),
        }
    }
}

impl Dimensions {
    /// Dimensions in the order given; a later pair of the same name replaces the earlier one.
    pub fn from_pairs(pairs: impl IntoIterator<Item = (String, Dimension)>) -> Self {
        let mut dimensions = Self::default();
        for (name, value) in pairs {
            dimensions.set(name, value);
        }
        dimensions
    }

    /// The dimension called `name`.
    pub fn get(&self, name: &str) -> Option<&Dimension> {
        self.0.iter().find(|(n, _)| n == name).map(|(_, d)| d)
    }

    /// Sets or adds a dimension.
    pub fn set(&mut self, name: String, value: Dimension) {
        match self.0.iter_mut().find(|(n, _)| *n == name) {
            Some((_, old)) => *old = value,
            None => self.0.push((name, value)),
        }
    }

    /// The names, in file order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(name, _)| name.as_str())
    }

    /// Names with values, in file order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Dimension)> {
        self.0.iter().map(|(name, value)| (name.as_str(), value))
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<'de> Deserialize<'de> for Dimensions {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Pairs;
        impl<'de> Visitor<'de> for Pairs {
            type Value = Dimensions;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a table of named dimensions")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Dimensions, A::Error> {
                let mut pairs = Vec::new();
                while let Some(pair) = map.next_entry()? {
                    pairs.push(pair);
                }
                Ok(Dimensions(pairs))
            }
        }
        deserializer.deserialize_map(Pairs)
    }
}

impl<'de> Deserialize<'de> for Dimension {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberOrList;
        impl<'de> Visitor<'de> for NumberOrList {
            type Value = Dimension;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or a list of numbers")
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Dimension, E> {
                Ok(Dimension::Number(value as f64))
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Dimension, E> {
                if value.is_finite() {
                    Ok(Dimension::Number(value))
                } else {
                    Err(E::custom(format!(
                        "a dimension must be finite, got {value}"
                    )))
                }
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Dimension, A::Error> {
                let mut values = Vec::new();
                while let Some(item) = seq.next_element::<Dimension>()? {
                    match item {
                        Dimension::Number(value) => values.push(value),
                        Dimension::List(_) => {
                            return Err(de::Error::custom("a list of lists is no dimension"));
                        }
                    }
                }
                Ok(Dimension::List(values))
            }
        }
        deserializer.deserialize_any(NumberOrList)
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Tables {
    pub(super) format: Spanned<i64>,
    pub(super) name: Spanned<String>,
    #[serde(default)]
    pub(super) dimensions: Dimensions,
    #[serde(default)]
    pub(super) links: Vec<LinkTable>,
    #[serde(default)]
    pub(super) joints: Vec<JointTable>,
    #[serde(default)]
    pub(super) frames: Vec<FrameTable>,
    #[serde(default)]
    pub(super) loops: Vec<Spanned<LoopTable>>,
    pub(super) dh: Option<DhTable>,
    #[serde(default)]
    pub(super) sensors: Vec<SensorTable>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LinkTable {
    pub(super) name: Spanned<String>,
    #[serde(default)]
    pub(super) shapes: Vec<Spanned<ShapeTable>>,
    pub(super) inertia: Option<Spanned<InertiaTable>>,
    pub(super) contact: Option<ContactTable>,
    pub(super) drag: Option<DragTable>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum JointType {
    Revolute,
    Continuous,
    Prismatic,
    Fixed,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct JointTable {
    pub(super) name: Spanned<String>,
    #[serde(rename = "type")]
    pub(super) kind: Spanned<JointType>,
    pub(super) parent: Spanned<String>,
    pub(super) child: Spanned<String>,
    pub(super) origin: Option<OriginTable>,
    pub(super) axis: Option<TripleAt>,
    pub(super) damping: Option<NumberAt>,
    pub(super) dry_friction: Option<NumberAt>,
    pub(super) armature: Option<NumberAt>,
    pub(super) limit: Option<Spanned<LimitTable>>,
    pub(super) mimic: Option<MimicTable>,
    #[serde(default)]
    pub(super) passive: bool,
    pub(super) guess: Option<NumberAt>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MimicTable {
    pub(super) joint: Spanned<String>,
    pub(super) multiplier: Option<NumberAt>,
    pub(super) offset: Option<NumberAt>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum LoopType {
    Revolute,
    Spherical,
    Point,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LoopTable {
    #[serde(rename = "type")]
    pub(super) kind: LoopType,
    pub(super) links: [Spanned<String>; 2],
    pub(super) frame_on_first: Option<OriginTable>,
    pub(super) frame_on_second: Option<OriginTable>,
    pub(super) axis: Option<TripleAt>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum DhConvention {
    Standard,
    Modified,
}

/// A Denavit-Hartenberg table: one chain that starts at the first link.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DhTable {
    pub(super) convention: Spanned<DhConvention>,
    pub(super) base: Option<OriginTable>,
    pub(super) tool: Option<OriginTable>,
    #[serde(default)]
    pub(super) rows: Vec<Spanned<DhRowTable>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DhRowTable {
    pub(super) joint: Spanned<String>,
    pub(super) link: Option<Spanned<String>>,
    #[serde(rename = "type")]
    pub(super) kind: Spanned<JointType>,
    pub(super) a_m: Option<NumberAt>,
    pub(super) alpha_deg: Option<NumberAt>,
    pub(super) d_m: Option<NumberAt>,
    pub(super) theta_deg: Option<NumberAt>,
    pub(super) direction: Option<NumberAt>,
    pub(super) damping: Option<NumberAt>,
    pub(super) dry_friction: Option<NumberAt>,
    pub(super) armature: Option<NumberAt>,
    pub(super) limit: Option<Spanned<LimitTable>>,
    pub(super) mimic: Option<MimicTable>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LimitTable {
    pub(super) lower: Option<NumberAt>,
    pub(super) upper: Option<NumberAt>,
    pub(super) speed: Option<NumberAt>,
    pub(super) effort: Option<NumberAt>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FrameTable {
    pub(super) name: Spanned<String>,
    pub(super) link: Spanned<String>,
    pub(super) origin: Option<OriginTable>,
}
