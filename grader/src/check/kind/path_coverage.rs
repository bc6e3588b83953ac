//! path-coverage: the share of a path that the TCP passes, near enough and in order.
//!
//! Measured is, of the lengths that count of all segments together, what progress gains at positions within `within_m`: see
//! [How a path is followed](#how-a-path-is-followed). More is better.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Problem;
use kinemark_sim::text::number::{list, metres};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::{Finding, measure};
use crate::check::reading::{InTask, NumberAt};
use crate::check::registry::MotionTable;
use crate::check::road;
use crate::record::grade::Evidence;
use crate::record::quantity::with_unit;
use crate::task::model::Band;
use crate::task::problem::LabError;
use crate::task::watched::{PathToFollow, Shares};

/// Shares in the wrong order.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "a coverage needs 0 <= zero <= full <= 1 and `full` above 0, got full = {full} and zero = {zero}"
)]
struct NotInOrder {
    full: f64,
    zero: f64,
}

impl Problem for NotInOrder {
    fn code(&self) -> &'static str {
        "lab::band"
    }

    fn label(&self) -> String {
        "this band".to_owned()
    }

    fn help(&self) -> Option<String> {
        Some("such as `full = 0.98, zero = 0.5`".to_owned())
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// A path of `[tasks.motion.paths]`.
    #[schemars(with = "String")]
    path: Spanned<String>,
    /// How near to the path the TCP passes \[m\].
    #[schemars(with = "f64")]
    within_m: NumberAt,
    /// Share that earns all points.
    full: f64,
    /// Share that earns none; at or below `full`.
    zero: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "path-coverage";
    type Check = PathCoverage;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<PathCoverage, LabError> {
        let (full, zero) = (self.full, self.zero);
        // here more is better, unlike in other bands
        if !(0.0 <= zero && zero <= full && full <= 1.0 && full > 0.0) {
            return reading.report.refuse(at, NotInOrder { full, zero });
        }
        Ok(PathCoverage {
            path: reading.path(&self.path)?,
            within_m: reading.report.positive(&self.within_m, "`within_m`")?,
            shares: Shares { full, zero },
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct PathCoverage {
    path: PathToFollow,
    within_m: f64,
    shares: Shares,
}

impl CheckKind for PathCoverage {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        None
    }

    fn bounds(&self, _: &Robot, _: &[&str]) -> [String; 2] {
        [
            format!("from {}", with_unit(self.shares.full, "")),
            format!("up to {}", with_unit(self.shares.zero, "")),
        ]
    }
}

impl MotionCheck for PathCoverage {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let (path, within) = (&self.path, metres(self.within_m));
        let driven = road::driven(&facts.p_tcp_m(), path).unwrap_or_default();
        let length_m: f64 = driven.iter().map(|segment| segment.length_m).sum();
        let passed_m = driven.iter().map(|segment| segment.passed_m(self.within_m));
        let passed_m: f64 = passed_m.sum();
        // round-off of a sum of thousands of steps
        let share = if passed_m >= length_m * (1.0 - 1e-9) {
            1.0
        } else {
            passed_m / length_m
        };
        // without a path there is no share
        let value = if driven.is_empty() { f64::NAN } else { share };
        let score = self.shares.score(value);
        let mut evidence = Vec::new();
        for (i, segment) in driven.iter().enumerate() {
            let share = segment.passed_m(self.within_m) / segment.length_m;
            if score >= 1.0 || share >= 1.0 - 1e-9 {
                continue;
            }
            let [from, to] = [i, i + 1].map(|k| list(path.points_m[k].as_slice()));
            let message = format!(
                "of segment {} of the path `{}`, from {from} to {to}, {} is passed within {within}",
                i + 1,
                path.name,
                with_unit(share, ""),
            );
            let left = segment.places.last().map_or(0, |place| place.tick);
            evidence.push(Evidence {
                value: Some(share),
                limit: Some(self.shares.full),
                ..facts.evidence(message, "tcp".to_owned(), left)
            });
        }
        let share = |e: &Evidence| e.value.unwrap_or(0.0);
        evidence.sort_by(|a, b| share(a).total_cmp(&share(b)));
        evidence.truncate(3);
        let quantity = format!("share of the path passed within {within}");
        let band = [self.shares.full, self.shares.zero];
        Finding::scored(score, measure(quantity, value, "", band))
            .because(evidence)
            .advise("Follow the path from its first point to its last.")
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Evidence
    }
}
