//! The TOML types of a robot file, as typed by a person: numbers may be expressions over `[dimensions]`, and every place a later
//! check may point at keeps its span.

use serde::Deserialize;
use crate::text::Spanned;

use super::drives::{DriveTable, FrictionEntry};
use crate::format::robot_problem::{KIND, RobotProblem};
use crate::part::document::{Document, Tables};
use crate::part::part_tables::{
    ContactTable, DragTable, InertiaTable, NumberAt, OriginTable, ShapeTable, TripleAt,
};
use crate::sensor::SensorTable;
use crate::text::Dimensions;

/// A robot file: its text and its tables. [`RobotFile::build`](RobotFile::build) makes the robot.
pub type RobotFile = Document<RobotTables>;

impl Tables for RobotTables {
    const KIND: &'static str = KIND;
    type Problem = RobotProblem;

    fn format(&self) -> &Spanned<i64> {
        &self.format
    }

    fn dimensions(&mut self) -> &mut Dimensions {
        &mut self.dimensions
    }

    fn shapes(&self) -> Box<dyn Iterator<Item = &Spanned<ShapeTable>> + '_> {
        Box::new(self.links.iter().flat_map(|link| &link.shapes))
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotTables {
    pub(crate) format: Spanned<i64>,
    pub(crate) name: Spanned<String>,
    #[serde(default)]
    pub(crate) dimensions: Dimensions,
    #[serde(default)]
    pub(crate) links: Vec<LinkTable>,
    #[serde(default)]
    pub(crate) joints: Vec<JointTable>,
    #[serde(default)]
    pub(crate) frames: Vec<FrameTable>,
    #[serde(default)]
    pub(crate) loops: Vec<Spanned<LoopTable>>,
    pub(crate) dh: Option<DhTable>,
    #[serde(default)]
    pub(crate) sensors: Vec<SensorTable>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LinkTable {
    pub(crate) name: Spanned<String>,
    #[serde(default)]
    pub(crate) shapes: Vec<Spanned<ShapeTable>>,
    pub(crate) inertia: Option<Spanned<InertiaTable>>,
    pub(crate) contact: Option<ContactTable>,
    pub(crate) drag: Option<DragTable>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum JointType {
    Revolute,
    Continuous,
    Prismatic,
    Fixed,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct JointTable {
    pub(crate) name: Spanned<String>,
    #[serde(rename = "type")]
    pub(crate) kind: Spanned<JointType>,
    pub(crate) parent: Spanned<String>,
    pub(crate) child: Spanned<String>,
    pub(crate) origin: Option<OriginTable>,
    pub(crate) axis: Option<TripleAt>,
    pub(crate) damping: Option<NumberAt>,
    pub(crate) dry_friction: Option<Spanned<FrictionEntry>>,
    pub(crate) armature: Option<NumberAt>,
    pub(crate) drive: Option<Spanned<DriveTable>>,
    pub(crate) limit: Option<Spanned<LimitTable>>,
    pub(crate) mimic: Option<MimicTable>,
    #[serde(default)]
    pub(crate) passive: bool,
    pub(crate) guess: Option<NumberAt>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MimicTable {
    pub(crate) joint: Spanned<String>,
    pub(crate) multiplier: Option<NumberAt>,
    pub(crate) offset: Option<NumberAt>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum LoopType {
    Revolute,
    Spherical,
    Point,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LoopTable {
    #[serde(rename = "type")]
    pub(crate) kind: LoopType,
    pub(crate) links: [Spanned<String>; 2],
    pub(crate) frame_on_first: Option<OriginTable>,
    pub(crate) frame_on_second: Option<OriginTable>,
    pub(crate) axis: Option<TripleAt>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum DhConvention {
    Standard,
    Modified,
}

/// A Denavit-Hartenberg table: one chain that starts at the first link.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DhTable {
    pub(crate) convention: Spanned<DhConvention>,
    pub(crate) base: Option<OriginTable>,
    pub(crate) tool: Option<OriginTable>,
    #[serde(default)]
    pub(crate) rows: Vec<Spanned<DhRowTable>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DhRowTable {
    pub(crate) joint: Spanned<String>,
    pub(crate) link: Option<Spanned<String>>,
    #[serde(rename = "type")]
    pub(crate) kind: Spanned<JointType>,
    pub(crate) a_m: Option<NumberAt>,
    pub(crate) alpha_deg: Option<NumberAt>,
    pub(crate) d_m: Option<NumberAt>,
    pub(crate) theta_deg: Option<NumberAt>,
    pub(crate) direction: Option<NumberAt>,
    pub(crate) damping: Option<NumberAt>,
    pub(crate) dry_friction: Option<Spanned<FrictionEntry>>,
    pub(crate) armature: Option<NumberAt>,
    pub(crate) drive: Option<Spanned<DriveTable>>,
    pub(crate) limit: Option<Spanned<LimitTable>>,
    pub(crate) mimic: Option<MimicTable>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LimitTable {
    pub(crate) lower: Option<NumberAt>,
    pub(crate) upper: Option<NumberAt>,
    pub(crate) speed: Option<NumberAt>,
    pub(crate) effort: Option<NumberAt>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FrameTable {
    pub(crate) name: Spanned<String>,
    pub(crate) link: Spanned<String>,
    pub(crate) origin: Option<OriginTable>,
}
