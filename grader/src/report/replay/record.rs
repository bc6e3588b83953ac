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
    /// The way from frame to frame: a `line`, or a `curve` where frames are so far apart that a line would cut corners.
    pub(super) between: &'static str,
    pub(super) lab: FrameRecord,
    #[serde(flatten)]
    pub(super) coded: Coded,
    pub(super) frames: Vec<FrameRecord>,
    pub(super) joints: Vec<JointRecord>,
    pub(super) reference: Option<ReferencePath>,
    pub(super) goals: Vec<GoalRecord>,
    pub(super) paths: Vec<PathRecord<'a>>,
    pub(super) contacts: Vec<ContactMark>,
    pub(super) events: Vec<EventMark>,
    pub(super) ghost_label: Option<String>,
    pub(super) main_label: Option<String>,
    pub(super) ended: Option<String>,
}

/// What depends on which frames there are.
#[derive(Debug, Default, Serialize)]
pub(super) struct Coded {
    pub(super) ticks: String,
    pub(super) nodes: Vec<NodeRecord>,
    pub(super) meshes: Vec<MeshRecord>,
    pub(super) tcp: Track,
    pub(super) q: Track,
    pub(super) tracks: Vec<Track>,
}

impl Coded {
    /// Characters of coded data, meshes apart.
    pub(super) fn size(&self) -> usize {
        let tracks: usize = self.tracks.iter().map(Track::size).sum();
        self.ticks.len() + self.tcp.size() + self.q.size() + tracks
    }
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
