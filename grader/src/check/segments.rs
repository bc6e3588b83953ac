//! The segments of a path that a check looks at: all of them, of which the worst counts, or one.

use kinemark_sim::text::number::list;

use super::reading::{At, MotionReading};
use super::signal::greatest;
use crate::task::model::Band;
use crate::task::problem::LabError;
use crate::task::watched::PathToFollow;

/// A path, and what of it counts.
#[derive(Debug)]
pub(super) struct Segments {
    pub(super) path: PathToFollow,
    /// The one segment that counts, from 0; the worst of all where there is none.
    only: Option<usize>,
}

impl Segments {
    /// The segment that is typed, or all, of the path called `path`.
    pub(super) fn read(
        reading: &MotionReading<'_>,
        path: &At<String>,
        segment: Option<&At<u64>>,
    ) -> Result<Self, LabError> {
        let path = reading.path(path)?;
        let only = reading.segment(segment, &path)?;
        Ok(Self { path, only })
    }

    /// Which segment a measure is of, in words.
    pub(super) fn which(&self) -> String {
        self.only.map_or_else(
            || "in its worst segment".to_owned(),
            |segment| format!("in its segment {}", segment + 1),
        )
    }

    /// Whether a segment, from 0, counts.
    pub(super) fn counts(&self, segment: usize) -> bool {
        self.only.is_none_or(|only| only == segment)
    }

    /// The worst `value` of the segments that count; infinite where nothing was followed.
    pub(super) fn worst<T>(&self, all: &[T], value: impl Fn(&T) -> f64) -> f64 {
        let counted = all.iter().enumerate().filter(|(i, _)| self.counts(*i));
        greatest(counted.map(|(_, segment)| value(segment)))
            .map_or(f64::INFINITY, |(_, worst)| worst)
    }

    /// The segments that count and lose points, with their index, worst first: three at most.
    pub(super) fn lost<'s, T>(
        &self,
        all: &'s [T],
        value: impl Fn(&T) -> f64,
        band: Band,
    ) -> Vec<(usize, &'s T)> {
        let mut lost: Vec<(usize, &T)> = all.iter().enumerate().collect();
        lost.retain(|(i, segment)| self.counts(*i) && band.score(value(segment)) < 1.0);
        lost.sort_by(|a, b| value(b.1).total_cmp(&value(a.1)));
        lost.truncate(3);
        lost
    }
}

/// A segment of a path, from 0, as it stands in a sentence.
pub(super) fn segment_name(path: &PathToFollow, segment: usize) -> String {
    let [from, to] = [segment, segment + 1].map(|k| list(path.points_m[k].as_slice()));
    format!(
        "segment {} of the path `{}`, from {from} to {to}",
        segment + 1,
        path.name
    )
}
