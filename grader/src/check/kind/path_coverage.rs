//! path-coverage: the share of a path that the TCP passes, near enough and in order.
//!
//! Measured is, of the lengths that count of all segments together, what progress gains at positions within `within_m`: see
//! [How a path is followed](#how-a-path-is-followed). More is better.

use nalgebra::Vector3;

use crate::check::path_following::followed;
use crate::check::prelude::*;
use crate::check::segments::segment_name;
use crate::task::watched::PathToFollow;

problems! {
    /// Shares in the wrong order.
    enum ShareProblem {
        NotInOrder { full: f64, zero: f64 }:
            "lab::band", "a coverage needs 0 <= zero <= full <= 1 and `full` above 0, got full = {full} and zero = {zero}",
            "this band", "such as `full = 0.98, zero = 0.5`";
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// A path of `[tasks.motion.paths]`.
    path: At<String>,
    /// How near to the path the TCP passes \[m\].
    within_m: At<f64>,
    /// Share that earns all points.
    full: f64,
    /// Share that earns none; at or below `full`.
    zero: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "path-coverage";
    type Check = PathCoverage;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let (full, zero) = (self.full, self.zero);
        // here more is better, unlike in other bands
        if !(0.0 <= zero && zero <= full && full <= 1.0 && full > 0.0) {
            return reading.refuse(ShareProblem::NotInOrder { full, zero });
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

impl PathCoverage {
    /// The point of a segment so far along what counts of it \[m\], in the lab's frame, to a millimetre.
    fn point(&self, segment: usize, along_m: f64) -> Vector3<f64> {
        let [from, to] = [segment, segment + 1].map(|i| self.path.points_m[i]);
        let length_m = (to - from).norm();
        let share = (self.path.trim_m + along_m) / length_m;
        let rounded = |x: f64| (x * 1000.0).round() / 1000.0 + 0.0;
        (from + (to - from) * share).map(rounded)
    }
}

impl MotionCheck for PathCoverage {
    fn bounds(&self) -> [String; 2] {
        [
            format!("from {}", with_unit(self.shares.full, "")),
            format!("up to {}", with_unit(self.shares.zero, "")),
        ]
    }

    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let within = metres(self.within_m);
        let followed = followed(&facts.p_tcp_m(), &self.path).unwrap_or_default();
        let length_m: f64 = followed.iter().map(|segment| segment.length_m).sum();
        let passed = followed
            .iter()
            .map(|segment| segment.passed_m(self.within_m));
        let passed_m: f64 = passed.sum();
        // without a path there is no share; what a sum of thousands of steps is off by rounding is none
        let value = if followed.is_empty() {
            f64::NAN
        } else if passed_m >= length_m * (1.0 - 1e-9) {
            1.0
        } else {
            passed_m / length_m
        };
        let score = self.shares.score(value);
        let mut evidence = Vec::new();
        for (i, segment) in followed.iter().enumerate() {
            let share = segment.passed_m(self.within_m) / segment.length_m;
            if score >= 1.0 || share >= 1.0 - 1e-9 {
                continue;
            }
            let mut message = format!(
                "of {}, {} is covered within {within}",
                segment_name(&self.path, i),
                with_unit(share, ""),
            );
            let left = segment.samples.last().map_or(0, |sample| sample.tick);
            let gap = segment.longest_gap(self.within_m);
            // where nothing of it is covered there is no place and no moment to name
            if let Some((ends_m, tick)) = gap.filter(|_| share > 0.0) {
                let [from, to] = ends_m.map(|along_m| self.point(i, along_m));
                message += &format!(
                    "; not from {} to {}, about {}",
                    list(from.as_slice()),
                    list(to.as_slice()),
                    seconds(facts.time_s(tick)),
                );
            }
            let tick = gap.map_or(left, |(_, tick)| tick);
            evidence.push(Evidence {
                value: Some(share),
                limit: Some(self.shares.full),
                ..facts.evidence(message, "tcp".to_owned(), tick)
            });
        }
        let share = |e: &Evidence| e.value.unwrap_or(0.0);
        evidence.sort_by(|a, b| share(a).total_cmp(&share(b)));
        evidence.truncate(3);
        let quantity = format!("share of the path covered within {within}");
        let band = [self.shares.full, self.shares.zero];
        Finding::scored(score, measure(quantity, value, "", band))
            .because(evidence)
            .advise("Follow the path from its first point to its last.")
    }
}

/// A band of shares: more is better.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Shares {
    /// The share that earns all points.
    full: f64,
    /// The share that earns none; at or below `full`.
    zero: f64,
}

impl Shares {
    /// The share of points that `value` earns, in `[0, 1]`; NaN earns nothing.
    fn score(&self, value: f64) -> f64 {
        if value >= self.full {
            1.0
        } else if value > self.zero {
            (value - self.zero) / (self.full - self.zero)
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_rise_linearly_and_nan_earns_nothing() {
        let shares = Shares {
            full: 1.0,
            zero: 0.5,
        };
        for (value, score) in [(1.0, 1.0), (0.75, 0.5), (0.5, 0.0), (0.0, 0.0)] {
            assert_eq!(shares.score(value), score);
        }
        assert_eq!(shares.score(f64::NAN), 0.0);
        let threshold = Shares {
            full: 0.5,
            zero: 0.5,
        };
        assert_eq!((threshold.score(0.5), threshold.score(0.49)), (1.0, 0.0));
    }
}
