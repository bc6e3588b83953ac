//! Paths of a motion task, and the checks that name them: paths are long enough for what is cut off them, segments are there.

use std::collections::BTreeMap;

use kinemark_sim::source::suggest;
use nalgebra::Vector3;
use toml::Spanned;

use super::Reader;
use crate::lab::model::{CheckKind, TaskWork};
use crate::lab::path_tables::{
    PathCoverageTable, PathDeviationTable, PathSpeedTable, PathTable, TimeLimitTable, UntilName,
};
use crate::lab::problem::LabError;
use crate::lab::watched::{PathToFollow, Shares, Until};

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
        self.unique("path", tables.keys())?;
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

    /// The path of the task that a check names.
    fn named_path(
        &self,
        name: &Spanned<String>,
        work: &TaskWork,
    ) -> Result<PathToFollow, LabError> {
        let paths = match work {
            TaskWork::Motion(motion) => &motion.paths[..],
            TaskWork::Function(_) => &[],
        };
        if let Some(path) = paths.iter().find(|path| path.name == *name.get_ref()) {
            return Ok(path.clone());
        }
        let help = if paths.is_empty() {
            format!(
                "add a table: [tasks.motion.paths] with `{} = {{ points_m = [[..], [..]], trim_m = 0.05 }}`",
                name.get_ref()
            )
        } else {
            let known = paths.iter().map(|path| path.name.as_str());
            suggest(name.get_ref(), "paths", known)
        };
        self.report.err(
            name.span(),
            "lab::unknown_path",
            format!("this task has no path `{}`", name.get_ref()),
            "not a path of [tasks.motion.paths]",
            Some(help),
        )
    }

    /// The index of a segment that is counted from 1.
    fn segment(
        &self,
        typed: Option<&Spanned<u64>>,
        path: &PathToFollow,
    ) -> Result<Option<usize>, LabError> {
        let Some(typed) = typed else {
            return Ok(None);
        };
        let count = path.points_m.len() - 1;
        let found = usize::try_from(*typed.get_ref()).ok();
        match found.filter(|segment| (1..=count).contains(segment)) {
            Some(segment) => Ok(Some(segment - 1)),
            None => self.report.err(
                typed.span(),
                "lab::path",
                format!(
                    "path `{}` has segments 1 to {count}, got {}",
                    path.name,
                    typed.get_ref()
                ),
                "not a segment of this path",
                Some("leave `segment` out to have the worst one counted".to_owned()),
            ),
        }
    }

    pub(super) fn path_deviation(
        &self,
        table: &Spanned<PathDeviationTable>,
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let at = table.span();
        let table = table.get_ref();
        let path = self.named_path(&table.path, work)?;
        Ok(CheckKind::PathDeviation {
            segment: self.segment(table.segment.as_ref(), &path)?,
            path,
            band: self.band(table.full_m, table.zero_m, at)?,
        })
    }

    pub(super) fn path_coverage(
        &self,
        table: &Spanned<PathCoverageTable>,
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let at = table.span();
        let table = table.get_ref();
        let (full, zero) = (table.full, table.zero);
        // here more is better, unlike in other bands
        if !(0.0 <= zero && zero <= full && full <= 1.0 && full > 0.0) {
            return self.report.err(
                at,
                "lab::band",
                format!("a coverage needs 0 <= zero <= full <= 1 and `full` above 0, got full = {full} and zero = {zero}"),
                "this band",
                Some("such as `full = 0.98, zero = 0.5`".to_owned()),
            );
        }
        Ok(CheckKind::PathCoverage {
            path: self.named_path(&table.path, work)?,
            within_m: self.positive(&table.within_m, "`within_m`")?,
            shares: Shares { full, zero },
        })
    }

    pub(super) fn path_speed(
        &self,
        table: &Spanned<PathSpeedTable>,
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let at = table.span();
        let table = table.get_ref();
        let path = self.named_path(&table.path, work)?;
        Ok(CheckKind::PathSpeed {
            segment: self.segment(table.segment.as_ref(), &path)?,
            path,
            speed_m_s: self.positive(&table.speed_m_s, "`speed_m_s`")?,
            band: self.band(table.full, table.zero, at)?,
        })
    }

    pub(super) fn time_limit(
        &self,
        table: &Spanned<TimeLimitTable>,
        work: &TaskWork,
    ) -> Result<CheckKind, LabError> {
        let at = table.span();
        let table = table.get_ref();
        let until = match (table.until, &table.body, &table.path) {
            (UntilName::Fall, Some(body), None) => {
                let scene = self.scene_of(work, "time-limit", at.clone())?;
                Until::Fall(self.free_body(scene, body)?)
            }
            (UntilName::Path, None, Some(path)) => Until::Path(self.named_path(path, work)?),
            (until, body, path) => {
                let (wanted, other, example) = match until {
                    UntilName::Fall => ("body", path, "until = \"fall\", body = \"can\""),
                    UntilName::Path => ("path", body, "until = \"path\", path = \"line\""),
                };
                let given = other.as_ref().map_or(at, Spanned::span);
                return self.report.err(
                    given,
                    "lab::time_limit",
                    format!("this time limit needs `{wanted}` and nothing else to wait for"),
                    "this check",
                    Some(format!("write `{example}`")),
                );
            }
        };
        Ok(CheckKind::TimeLimit {
            until,
            band: self.band(table.full_s, table.zero_s, at)?,
        })
    }
}
