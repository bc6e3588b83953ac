//! What a replay is on the page: its JSON, field by field.

use serde::Serialize;

use super::column::Track;
use super::moments::{ContactMark, EventMark};
use super::shapes::{MeshRecord, ShapeRecord};

/// The whole record.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Record<'a> {
    pub(super) format: &'static str,
    pub(super) task: String,
    pub(super) title: String,
    pub(super) step_s: f64,
    pub(super) lab: FrameRecord,
    /// The ticks stepped through, as a column.
    pub(super) ticks: String,
    pub(super) nodes: Vec<NodeRecord>,
    pub(super) meshes: Vec<MeshRecord>,
    pub(super) tcp: Track,
    pub(super) q: Vec<Track>,
    /// The velocity of the TCP by the command at each of the ticks stepped through, where velocities are commanded \[m/s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) wanted: Option<Track>,
    pub(super) tracks: Vec<Track>,
    pub(super) frames: Vec<FrameRecord>,
    pub(super) joints: Vec<JointRecord>,
    pub(super) reference: Option<ReferencePath>,
    /// The numbers of another run beside this one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) other: Option<OtherRecord>,
    pub(super) goals: Vec<GoalRecord>,
    pub(super) paths: Vec<PathRecord<'a>>,
    pub(super) contacts: Vec<ContactMark>,
    pub(super) events: Vec<EventMark>,
    pub(super) ghost_label: Option<String>,
    pub(super) main_label: Option<String>,
    pub(super) ended: Option<String>,
}

#[derive(Debug, Serialize)]
pub(super) struct NodeRecord {
    pub(super) name: String,
    pub(super) kind: &'static str,
    /// The node of the link that its joint hangs on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) parent: Option<usize>,
    pub(super) shapes: Vec<ShapeRecord>,
    #[serde(flatten)]
    pub(super) place: Place,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Place {
    /// In the world, if it never moves.
    Pose([f64; 7]),
    /// Index of its track.
    Track(usize),
}

#[derive(Debug, Serialize)]
pub(super) struct FrameRecord {
    pub(super) name: String,
    pub(super) node: Option<usize>,
    pub(super) pose: [f64; 7],
}

#[derive(Debug, Serialize)]
pub(super) struct JointRecord {
    pub(super) name: String,
    pub(super) unit: &'static str,
}

#[derive(Debug, Serialize)]
pub(super) struct ReferencePath {
    #[serde(rename = "periodS")]
    pub(super) period_s: f64,
    pub(super) path: Track,
}

/// TCP and joints of another run, at each of the ticks stepped through.
#[derive(Debug, Serialize)]
pub(super) struct OtherRecord {
    pub(super) tcp: Track,
    pub(super) q: Vec<OtherJoint>,
}

#[derive(Debug, Serialize)]
pub(super) struct OtherJoint {
    pub(super) name: String,
    pub(super) track: Track,
}

#[derive(Debug, Serialize)]
pub(super) struct GoalRecord {
    pub(super) position: [f64; 3],
    pub(super) full: Option<f64>,
    pub(super) zero: Option<f64>,
}

#[derive(Debug, Serialize)]
pub(super) struct PathRecord<'a> {
    pub(super) name: String,
    pub(super) points: &'a [[f64; 3]],
    pub(super) full: Option<f64>,
    pub(super) zero: Option<f64>,
}
