//! The TOML types of a robot file, as typed by a person: numbers may be expressions over `[dimensions]`, and every place a later
//! check may point at keeps its span.

use schemars::{JsonSchema, Schema};
use serde::Deserialize;

use super::drives::{DriveTable, FrictionEntry};
use crate::format::robot_problem::{KIND, RobotProblem};
use crate::part::document::{Document, Tables};
use crate::part::part_tables::{
    ContactTable, DragTable, InertiaTable, NumberAt, OriginTable, ShapeTable, TripleAt,
};
use crate::sensor::SensorTable;
use crate::text::schema::schema_of;
use crate::text::{Dimensions, FileFormat, Spanned};

/// A robot file: its text and its tables. [`RobotFile::build`](RobotFile::build) makes the robot.
pub type RobotFile = Document<RobotTables>;

impl RobotFile {
    /// The JSON schema of a robot file.
    pub fn schema() -> Schema {
        schema_of::<RobotTables>("A robot of Kinemark")
    }
}

impl Tables for RobotTables {
    const KIND: &'static str = KIND;
    type Problem = RobotProblem;

    fn dimensions(&mut self) -> &mut Dimensions {
        &mut self.dimensions
    }

    fn shapes(&self) -> Box<dyn Iterator<Item = &Spanned<ShapeTable>> + '_> {
        Box::new(self.links.iter().flat_map(|link| &link.shapes))
    }
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RobotTables {
    /// The version of the format: 1.
    #[serde(rename = "format")]
    pub(crate) _format: FileFormat,
    /// The robot's name.
    pub(crate) name: Spanned<String>,
    /// Named dimensions, in SI units: numbers and lists of numbers, which any other number may be an expression over.
    #[serde(default)]
    pub(crate) dimensions: Dimensions,
    /// The links, of which the first is the root, fixed to the world.
    #[serde(default)]
    pub(crate) links: Vec<LinkTable>,
    /// The joints, one for every link but the first.
    #[serde(default)]
    pub(crate) joints: Vec<JointTable>,
    /// Named frames, fixed to links.
    #[serde(default)]
    pub(crate) frames: Vec<FrameTable>,
    /// What closes the tree of links and joints to a mechanism.
    #[serde(default)]
    pub(crate) loops: Vec<Spanned<LoopTable>>,
    /// A Denavit-Hartenberg table in place of joints.
    pub(crate) dh: Option<DhTable>,
    /// What the robot measures with.
    #[serde(default)]
    pub(crate) sensors: Vec<SensorTable>,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LinkTable {
    /// Its name.
    pub(crate) name: Spanned<String>,
    /// Its shapes, each of one kind.
    #[serde(default)]
    pub(crate) shapes: Vec<Spanned<ShapeTable>>,
    /// Its mass; none where it is left out.
    pub(crate) inertia: Option<Spanned<InertiaTable>>,
    /// Its surface.
    pub(crate) contact: Option<ContactTable>,
    /// How the air pushes it; not at all where it is left out.
    pub(crate) drag: Option<DragTable>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum JointType {
    Revolute,
    Continuous,
    Prismatic,
    Fixed,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct JointTable {
    /// Its name.
    pub(crate) name: Spanned<String>,
    /// How it moves.
    #[serde(rename = "type")]
    pub(crate) kind: Spanned<JointType>,
    /// The link from which it goes out.
    pub(crate) parent: Spanned<String>,
    /// The link that it moves.
    pub(crate) child: Spanned<String>,
    /// The child's frame in the parent's, at `q = 0`; identity where it is left out.
    pub(crate) origin: Option<OriginTable>,
    /// Its axis in the child's frame, of any length but zero; refused for `fixed`.
    pub(crate) axis: Option<TripleAt>,
    /// Viscous friction \[N m s/rad or N s/m\]; 0 where it is left out.
    pub(crate) damping: Option<NumberAt>,
    /// Dry friction \[N m or N\], or `{ positive, negative }`; 0 where it is left out.
    pub(crate) dry_friction: Option<Spanned<FrictionEntry>>,
    /// Inertia of the drive as felt at the joint \[kg m² or kg\]; 0 where it is left out.
    pub(crate) armature: Option<NumberAt>,
    /// Motor and gear.
    pub(crate) drive: Option<Spanned<DriveTable>>,
    /// Limits of the joint; each may be left out.
    pub(crate) limit: Option<Spanned<LimitTable>>,
    /// Makes the joint follow another; it has no entry in `q` then.
    pub(crate) mimic: Option<MimicTable>,
    /// Whether no drive acts on it: in a loop it follows the other joints; false where it is left out.
    #[serde(default)]
    pub(crate) passive: bool,
    /// Where it is looked for when loops are first closed \[rad or m\]; 0 where it is left out.
    pub(crate) guess: Option<NumberAt>,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MimicTable {
    /// The joint that it follows.
    pub(crate) joint: Spanned<String>,
    /// Its position per unit of that joint; 1 where it is left out.
    pub(crate) multiplier: Option<NumberAt>,
    /// Its position where that joint is at zero \[rad or m\]; 0 where it is left out.
    pub(crate) offset: Option<NumberAt>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum LoopType {
    Revolute,
    Spherical,
    Point,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LoopTable {
    /// `revolute`: origins and axes of the two frames stay together; `spherical` or `point`: only the origins.
    #[serde(rename = "type")]
    pub(crate) kind: LoopType,
    /// The two links; a joint lies between them.
    pub(crate) links: [Spanned<String>; 2],
    /// Where the frame is in the first link; identity where it is left out.
    pub(crate) frame_on_first: Option<OriginTable>,
    /// Where the frame is in the second link; identity where it is left out.
    pub(crate) frame_on_second: Option<OriginTable>,
    /// The hinge's axis in both frames; z where it is left out, refused for `spherical`.
    pub(crate) axis: Option<TripleAt>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum DhConvention {
    Standard,
    Modified,
}

/// A Denavit-Hartenberg table: one chain that starts at the first link.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DhTable {
    /// `standard`: `Rz(theta) Tz(d) Tx(a) Rx(alpha)`; `modified`: `Rx(alpha) Tx(a) Rz(theta) Tz(d)`.
    pub(crate) convention: Spanned<DhConvention>,
    /// Before the first row; identity where it is left out.
    pub(crate) base: Option<OriginTable>,
    /// The frame `tcp` in the last link; identity where it is left out.
    pub(crate) tool: Option<OriginTable>,
    /// The rows, one a joint.
    #[serde(default)]
    pub(crate) rows: Vec<Spanned<DhRowTable>>,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DhRowTable {
    /// Name of the joint.
    pub(crate) joint: Spanned<String>,
    /// Name of the link that it moves; `link1`, `link2`, ... where it is left out.
    pub(crate) link: Option<Spanned<String>>,
    /// How it moves.
    #[serde(rename = "type")]
    pub(crate) kind: Spanned<JointType>,
    /// Link length `a` \[m\]; 0 where it is left out.
    pub(crate) a_m: Option<NumberAt>,
    /// Link twist `alpha` \[deg\]; 0 where it is left out.
    pub(crate) alpha_deg: Option<NumberAt>,
    /// Link offset `d` \[m\]; 0 where it is left out.
    pub(crate) d_m: Option<NumberAt>,
    /// Joint angle `theta` \[deg\]; 0 where it is left out.
    pub(crate) theta_deg: Option<NumberAt>,
    /// -1 where `q` counts against theta or d; 1 where it is left out.
    pub(crate) direction: Option<NumberAt>,
    /// Viscous friction \[N m s/rad or N s/m\]; 0 where it is left out.
    pub(crate) damping: Option<NumberAt>,
    /// Dry friction \[N m or N\], or `{ positive, negative }`; 0 where it is left out.
    pub(crate) dry_friction: Option<Spanned<FrictionEntry>>,
    /// Inertia of the drive as felt at the joint \[kg m² or kg\]; 0 where it is left out.
    pub(crate) armature: Option<NumberAt>,
    /// Motor and gear.
    pub(crate) drive: Option<Spanned<DriveTable>>,
    /// Limits of the joint; each may be left out.
    pub(crate) limit: Option<Spanned<LimitTable>>,
    /// Makes the joint follow another; it has no entry in `q` then.
    pub(crate) mimic: Option<MimicTable>,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LimitTable {
    /// Least position \[rad or m\].
    pub(crate) lower: Option<NumberAt>,
    /// Greatest position \[rad or m\].
    pub(crate) upper: Option<NumberAt>,
    /// Greatest speed, positive \[rad/s or m/s\].
    pub(crate) speed: Option<NumberAt>,
    /// Greatest effort, positive \[N m or N\].
    pub(crate) effort: Option<NumberAt>,
}

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FrameTable {
    /// Its name; `tcp` is the frame that commands and checks refer to.
    pub(crate) name: Spanned<String>,
    /// The link that it is fixed to.
    pub(crate) link: Spanned<String>,
    /// Its pose in that link; identity where it is left out.
    pub(crate) origin: Option<OriginTable>,
}
