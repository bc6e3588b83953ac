//! Paths of a motion task: long enough for what is cut off them, and not too many.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use toml::Spanned;

use super::Reader;
use crate::lab::file::PathTable;
use crate::task::problem::LabError;
use crate::task::watched::PathToFollow;

/// More points than any path of a lab has: each costs memory for every tick.
const MOST_POINTS: usize = 100;
/// Paths of one task.
const MOST_PATHS: usize = 20;

impl Reader<'_> {
    /// The paths of a task, in the order of their names.
    pub(super) fn paths(
        &self,
        tables: &BTreeMap<Spanned<String>, PathTable>,
    ) -> Result<Vec<PathToFollow>, LabError> {
        self.report.unique("path", tables.keys())?;
        if let Some(name) = tables.keys().nth(MOST_PATHS) {
            return self.report.err(
                name.span(),
                "lab::path",
                format!(
                    "a task has at most {MOST_PATHS} paths, got {}",
                    tables.len()
                ),
                "one more than there may be",
                Some("leave out what no check names".to_owned()),
            );
        }
        let paths = tables.iter();
        paths
            .map(|(name, table)| self.path(name.get_ref(), table))
            .collect()
    }

    fn path(&self, name: &str, table: &PathTable) -> Result<PathToFollow, LabError> {
        let points = &table.points_m;
        let points_m: Vec<Vector3<f64>> = points.get_ref().iter().map(|p| (*p).into()).collect();
        let refuse = |message: String| {
            self.report.err(
                points.span(),
                "lab::path",
                message,
                "this path",
                Some("give points in the lab's frame [m], as [x, y, z]".to_owned()),
            )
        };
        if !(2..=MOST_POINTS).contains(&points_m.len()) {
            let count = points_m.len();
            return refuse(format!("a path has 2 to {MOST_POINTS} points, got {count}"));
        }
        if let Some(at) = points_m
            .iter()
            .position(|p| !p.iter().all(|x| x.abs() <= 1e6))
        {
            return refuse(format!(
                "point {} of path `{name}` is not within 1e6 m",
                at + 1
            ));
        }
        let trim_m = self.positive(&table.trim_m, "`trim_m`")?;
        let lengths = points_m.windows(2).map(|ends| (ends[1] - ends[0]).norm());
        for (i, length_m) in lengths.enumerate() {
            if 2.0 * trim_m >= length_m {
                return self.report.err(
                    table.trim_m.span(),
                    "lab::path",
                    format!(
                        "segment {} of path `{name}` is {length_m} m long: nothing is left of it with {trim_m} m cut off each end",
                        i + 1
                    ),
                    "too much is cut off",
                    Some("cut off less, or leave out one of two points that are as near".to_owned()),
                );
            }
        }
        Ok(PathToFollow {
            name: name.to_owned(),
            points_m,
            trim_m,
        })
    }
}
