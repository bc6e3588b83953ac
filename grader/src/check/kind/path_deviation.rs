//! path-deviation: how far the TCP is from a path of straight segments, in the worst of them \[m, root mean square\].
//!
//! The formula is in [How a path is followed](#how-a-path-is-followed): along the distance travelled, so that speed does not count,
//! with progress that never goes back; what is never passed counts with its distance.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{list, metres, seconds};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::{Finding, curve};
use crate::check::reading::InTask;
use crate::check::registry::MotionTable;
use crate::check::road::{self, Driven};
use crate::record::grade::Evidence;
use crate::record::graded::Curve;
use crate::task::model::Band;
use crate::task::problem::LabError;
use crate::task::watched::PathToFollow;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// A path of `[tasks.motion.paths]`.
    #[schemars(with = "String")]
    path: Spanned<String>,
    /// The one segment that counts, from 1; the worst of all where it is left out.
    #[schemars(with = "Option<u64>")]
    segment: Option<Spanned<u64>>,
    /// Distance that earns all points \[m\].
    full_m: f64,
    /// Distance that earns none \[m\].
    zero_m: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "path-deviation";
    type Check = PathDeviation;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<PathDeviation, LabError> {
        let path = reading.path(&self.path)?;
        Ok(PathDeviation {
            only: reading.segment(self.segment.as_ref(), &path)?,
            path,
            band: reading.report.band(self.full_m, self.zero_m, at)?,
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct PathDeviation {
    path: PathToFollow,
    /// The one segment that counts, from 0; the worst of all where there is none.
    only: Option<usize>,
    band: Band,
}

impl CheckKind for PathDeviation {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, "m"))
    }
}

/// Which segment a measure of a path is of.
pub(super) fn which(only: Option<usize>) -> String {
    only.map_or_else(
        || "in its worst segment".to_owned(),
        |segment| format!("in its segment {}", segment + 1),
    )
}

fn told(facts: &MotionFacts<'_>, path: &PathToFollow, i: usize, segment: &Driven) -> Evidence {
    let [from, to] = [i, i + 1].map(|k| list(path.points_m[k].as_slice()));
    let mut message = format!(
        "segment {} of the path `{}`, from {from} to {to}: {} off (root mean square along the path travelled)",
        i + 1,
        path.name,
        metres(segment.rms_m),
    );
    let mut tick = segment.places.last().map_or(0, |place| place.tick);
    if let Some(furthest) = segment.furthest() {
        tick = furthest.tick;
        let at = seconds(facts.time_s(tick));
        // behind rather than beside: 0.7 is half in squares
        message += &if furthest.back_m > 0.7 * furthest.aside_m {
            format!("; at {at} it has gone back by {}", metres(furthest.back_m))
        } else {
            format!("; the furthest is {} at {at}", metres(furthest.aside_m))
        };
    }
    if segment.left_out_m > 1e-3 {
        message += &format!(
            "; {} of {} are never passed",
            metres(segment.left_out_m),
            metres(segment.length_m)
        );
    }
    facts.evidence(message, "tcp".to_owned(), tick)
}

/// The moment at which the TCP was nearest to a point of the path in its turn, with words that say no more than that where it was not
/// within the band.
fn point(
    facts: &MotionFacts<'_>,
    path: &PathToFollow,
    i: usize,
    tick: usize,
    band: Band,
) -> (f64, String) {
    let number = i + 1;
    let away_m = path.points_m.get(i).map_or(f64::INFINITY, |point| {
        (facts.trace.tcp_position(tick) - point).norm()
    });
    let words = match away_m <= path.trim_m + band.zero {
        true => format!("point {number}"),
        false => format!("nearest to point {number}"),
    };
    (facts.time_s(tick), words)
}

impl MotionCheck for PathDeviation {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let driven = road::driven(&facts.p_tcp_m(), &self.path).unwrap_or_default();
        let segments = driven.iter().enumerate().filter(|(i, _)| self.counts(*i));
        let worst = segments.clone().map(|(_, segment)| segment.rms_m);
        // of the sizes, so that one that is no number is the worst
        let worst = worst.max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let value = worst.unwrap_or(f64::INFINITY);
        let mut lost: Vec<(usize, &Driven)> = segments.collect();
        lost.retain(|(_, segment)| self.band.score(segment.rms_m) < 1.0);
        lost.sort_by(|a, b| b.1.rms_m.total_cmp(&a.1.rms_m));
        let evidence = lost.iter().take(3).map(|(i, segment)| Evidence {
            value: Some(segment.rms_m),
            limit: Some(self.band.full),
            unit: "m".to_owned(),
            ..told(facts, &self.path, *i, segment)
        });
        let quantity = format!("distance from the path, {}", which(self.only));
        let mut finding = Finding::against(self.band, value, "m", quantity)
            .because(evidence.collect())
            .advise("Lead the TCP along each segment to its end before the next one, and correct what it is aside.");
        finding.curve = self.curve(facts, &driven);
        finding
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Mean
    }

    fn path_band(&self, path: &str) -> Option<Band> {
        (self.path.name == path).then_some(self.band)
    }
}

impl PathDeviation {
    /// Whether a segment, from 0, is looked at.
    fn counts(&self, segment: usize) -> bool {
        self.only.is_none_or(|only| only == segment)
    }

    /// Distance aside while the path is driven; near the corners, where it does not count, there are gaps.
    fn curve(&self, facts: &MotionFacts<'_>, driven: &[Driven]) -> Option<Curve> {
        let mut t_s = Vec::new();
        let mut values = Vec::new();
        let mut marks = Vec::new();
        for (i, segment) in driven.iter().enumerate() {
            let begun = segment.places.first()?;
            marks.push(point(facts, &self.path, i, begun.tick, self.band));
            for place in &segment.places {
                t_s.push(facts.time_s(place.tick));
                let counts = place.counts && self.counts(i);
                values.push(if counts { place.aside_m } else { f64::NAN });
            }
        }
        let left = driven.last()?.places.last()?;
        marks.push(point(facts, &self.path, driven.len(), left.tick, self.band));
        Some(Curve {
            marks,
            ..curve("distance from the path", "m", t_s, values, Some(self.band))
        })
    }
}
