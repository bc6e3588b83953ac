//! Paths of a motion task: long enough for what is cut off them, and not too many.

use std::collections::BTreeMap;

use kinemark_sim::text::Spanned;
use nalgebra::Vector3;

use super::Reader;
use crate::lab::file::PathTable;
use crate::task::problem::{LabError, problems};
use crate::task::watched::PathToFollow;

/// More points than any path of a lab has: each costs memory for every tick.
const MOST_POINTS: usize = 100;
/// Paths of one task.
const MOST_PATHS: usize = 20;

problems! {
    /// What is wrong with the paths of a task.
    enum PathProblem {
        TooMany { count: usize }:
            "lab::path", "a task has at most {MOST_PATHS} paths, got {count}", "too many paths",
            "leave out what no check names";
        Points { count: usize }:
            "lab::path", "a path has 2 to {MOST_POINTS} points, got {count}", "this path",
            "give points in the lab's frame [m], as [x, y, z]";
        FarAway { point: usize, path: String }:
            "lab::path", "point {point} of path `{path}` is not within 1e6 m", "this path",
            "give points in the lab's frame [m], as [x, y, z]";
        NothingLeft { segment: usize, path: String, length_m: f64, trim_m: f64 }:
            "lab::path",
            "segment {segment} of path `{path}` is {length_m} m long: nothing is left of it with {trim_m} m cut off each end",
            "too much is cut off", "cut off less, or leave out one of two points that are as near";
    }
}

impl Reader<'_> {
    /// The paths of a task, in the order of their names.
    pub(super) fn paths(
        &self,
        tables: &BTreeMap<Spanned<String>, PathTable>,
    ) -> Result<Vec<PathToFollow>, LabError> {
        self.report.unique("path", tables.keys())?;
        if let Some(name) = tables.keys().nth(MOST_PATHS) {
            let count = tables.len();
            return self.report.refuse_at(name, PathProblem::TooMany { count });
        }
        let paths = tables.iter();
        paths
            .map(|(name, table)| self.path(name.get_ref(), table))
            .collect()
    }

    fn path(&self, name: &str, table: &PathTable) -> Result<PathToFollow, LabError> {
        let points = &table.points_m;
        let points_m: Vec<Vector3<f64>> = points.get_ref().iter().map(|p| (*p).into()).collect();
        let path = || name.to_owned();
        if !(2..=MOST_POINTS).contains(&points_m.len()) {
            let count = points_m.len();
            return self.report.refuse_at(points, PathProblem::Points { count });
        }
        if let Some(at) = points_m
            .iter()
            .position(|p| !p.iter().all(|x| x.abs() <= 1e6))
        {
            let (point, path) = (at + 1, path());
            return self
                .report
                .refuse_at(points, PathProblem::FarAway { point, path });
        }
        let trim_m = self.positive(&table.trim_m, "`trim_m`")?;
        let lengths = points_m.windows(2).map(|ends| (ends[1] - ends[0]).norm());
        for (i, length_m) in lengths.enumerate() {
            if 2.0 * trim_m >= length_m {
                let problem = PathProblem::NothingLeft {
                    segment: i + 1,
                    path: path(),
                    length_m,
                    trim_m,
                };
                return self.report.refuse_at(&table.trim_m, problem);
            }
        }
        Ok(PathToFollow {
            name: name.to_owned(),
            points_m,
            trim_m,
        })
    }
}
