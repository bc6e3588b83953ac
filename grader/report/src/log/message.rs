//! The messages of a log, as they are written.

use kinemark_sim::spatial::Pose as Isometry;
use kinemark_sim::trace::quaternion;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// Simulated time.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Time {
    sec: u64,
    nsec: u64,
}

impl Time {
    pub(super) fn from_ns(ns: u64) -> Self {
        Self {
            sec: ns / 1_000_000_000,
            nsec: ns % 1_000_000_000,
        }
    }
}

#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Vector {
    x: f64,
    y: f64,
    z: f64,
}

/// A billionth is far below what a viewer shows; digits beyond it are noise that does not compress.
fn rounded(value: f64) -> f64 {
    if value.abs() > 1e6 {
        return value;
    }
    // adding zero turns -0 into 0
    (value * 1e9).round() / 1e9 + 0.0
}

impl Vector {
    /// Rounded to nanometres.
    pub(super) fn new(metres: [f64; 3]) -> Self {
        let [x, y, z] = metres.map(rounded);
        Self { x, y, z }
    }

    pub(super) fn is_finite(&self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }
}

#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Quaternion {
    x: f64,
    y: f64,
    z: f64,
    w: f64,
}

#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Pose {
    pub(super) position: Vector,
    pub(super) orientation: Quaternion,
}

impl Quaternion {
    /// From `[w, x, y, z]`, each element rounded to a billionth.
    pub(super) fn new(elements: [f64; 4]) -> Self {
        let [w, x, y, z] = elements.map(rounded);
        Self { x, y, z, w }
    }
}

impl Pose {
    pub(super) fn new(pose: &Isometry) -> Self {
        let p = pose.translation.vector;
        Self {
            position: Vector::new([p.x, p.y, p.z]),
            orientation: Quaternion::new(quaternion(pose.rotation.matrix())),
        }
    }

    /// At a place, with the axes of its frame.
    pub(super) fn at(position_m: [f64; 3]) -> Self {
        Self {
            position: Vector::new(position_m),
            orientation: Quaternion::new([1.0, 0.0, 0.0, 0.0]),
        }
    }
}

#[derive(Debug, Clone, Serialize)]
pub(super) struct FrameTransform<'a> {
    pub(super) timestamp: Time,
    pub(super) parent_frame_id: &'a str,
    pub(super) child_frame_id: &'a str,
    pub(super) translation: Vector,
    pub(super) rotation: Quaternion,
}

#[derive(Debug, Clone, Serialize)]
pub(super) struct FrameTransforms<'a> {
    pub(super) transforms: Vec<FrameTransform<'a>>,
}

#[derive(Debug, Clone, Serialize)]
pub(super) struct PoseInFrame<'a> {
    pub(super) timestamp: Time,
    pub(super) frame_id: &'a str,
    pub(super) pose: Pose,
}

/// What is not finite is left out: JSON has no such number.
fn absent(value: &f64) -> bool {
    !value.is_finite()
}

#[derive(Debug, Clone, Serialize)]
pub(super) struct JointState<'a> {
    pub(super) name: &'a str,
    #[serde(skip_serializing_if = "absent")]
    pub(super) position: f64,
    #[serde(skip_serializing_if = "absent")]
    pub(super) velocity: f64,
    #[serde(skip_serializing_if = "absent")]
    pub(super) effort: f64,
}

#[derive(Debug, Clone, Serialize)]
pub(super) struct JointStates<'a> {
    pub(super) timestamp: Time,
    pub(super) joints: Vec<JointState<'a>>,
}

/// How loud a line of the log is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Level {
    Info = 2,
    Warning = 3,
    Error = 4,
}

impl Serialize for Level {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u8(*self as u8)
    }
}

#[derive(Debug, Clone, Serialize)]
pub(super) struct Log<'a> {
    pub(super) timestamp: Time,
    pub(super) level: Level,
    pub(super) message: &'a str,
    pub(super) name: &'a str,
    pub(super) file: &'a str,
    pub(super) line: u32,
}

/// Named numbers; those that are not finite are left out.
#[derive(Debug, Clone)]
pub(super) struct Flat<'a> {
    pub(super) values: Vec<(&'a str, f64)>,
}

impl Serialize for Flat<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for (name, value) in &self.values {
            if value.is_finite() {
                map.serialize_entry(name, value)?;
            }
        }
        map.end()
    }
}
