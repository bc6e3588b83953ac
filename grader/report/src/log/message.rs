//! Parts of the messages of a log: Foxglove's own types, filled from those of the simulator, and flat numbers.

use foxglove::messages::{Point3, Pose, Quaternion, Timestamp, Vector3};
use kinemark_sim::spatial::Pose as Isometry;
use kinemark_sim::trace::quaternion as elements_of;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// Simulated time; what is beyond the clock of the messages, 136 years, is its end.
pub(super) fn time(ns: u64) -> Timestamp {
    let sec = u32::try_from(ns / 1_000_000_000).unwrap_or(u32::MAX);
    Timestamp::new(sec, (ns % 1_000_000_000) as u32)
}

/// A billionth is far below what a viewer shows; digits beyond it are noise that does not compress.
fn rounded(value: f64) -> f64 {
    if value.abs() > 1e6 {
        return value;
    }
    // adding zero turns -0 into 0
    (value * 1e9).round() / 1e9 + 0.0
}

/// Rounded to nanometres.
pub(super) fn vector(metres: [f64; 3]) -> Vector3 {
    let [x, y, z] = metres.map(rounded);
    Vector3 { x, y, z }
}

/// Rounded to nanometres; none where a coordinate is not finite.
pub(super) fn point(metres: [f64; 3]) -> Option<Point3> {
    let [x, y, z] = metres.map(rounded);
    let is_finite = x.is_finite() && y.is_finite() && z.is_finite();
    is_finite.then_some(Point3 { x, y, z })
}

/// From `[w, x, y, z]`, each element rounded to a billionth.
pub(super) fn quaternion(elements: [f64; 4]) -> Quaternion {
    let [w, x, y, z] = elements.map(rounded);
    Quaternion { x, y, z, w }
}

/// Position and orientation, rounded as they are alone.
pub(super) fn pose(pose: &Isometry) -> Pose {
    let p = pose.translation.vector;
    Pose {
        position: Some(vector([p.x, p.y, p.z])),
        orientation: Some(quaternion(elements_of(pose.rotation.matrix()))),
    }
}

/// At a place, with the axes of its frame.
pub(super) fn pose_at(position_m: [f64; 3]) -> Pose {
    Pose {
        position: Some(vector(position_m)),
        orientation: Some(quaternion([1.0, 0.0, 0.0, 0.0])),
    }
}

/// A number of a message that may be absent: what is not finite is left out.
pub(super) fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// Named numbers; those that are not finite are left out, for JSON has no such number.
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
