//! path-deviation: how far the TCP is from a path of straight segments, in the worst of them \[m, root mean square\].
//!
//! The formula is in [How a path is followed](#how-a-path-is-followed): along the distance travelled, so that speed does not count,
//! with progress that never goes back; what is never covered counts with its distance.

use crate::check::path_following::{FollowedSegment, followed};
use crate::check::prelude::*;
use crate::check::segments::{Segments, segment_name};

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// A path of `[tasks.motion.paths]`.
    path: At<String>,
    /// The one segment that counts, from 1; the worst of all where it is left out.
    segment: Option<At<u64>>,
    /// Distance that earns all points \[m\].
    full_m: BandEnd,
    /// Distance that earns none \[m\].
    zero_m: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "path-deviation";
    type Check = InBand<PathDeviation>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let segments = Segments::read(reading, &self.path, self.segment.as_ref())?;
        reading.in_band([self.full_m, self.zero_m], "m", PathDeviation(segments))
    }
}

/// The distance from the path, in the worst of these segments.
#[derive(Debug)]
pub(crate) struct PathDeviation(Segments);

impl RunMeasure for PathDeviation {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let Self(segments) = self;
        let followed = followed(&facts.p_tcp_m(), &segments.path).unwrap_or_default();
        let rms_m = |segment: &FollowedSegment| segment.rms_m;
        let lost = segments.lost(&followed, rms_m, band);
        let evidence = lost.iter().map(|(i, segment)| Evidence {
            value: Some(segment.rms_m),
            limit: Some(band.full),
            unit: "m".to_owned(),
            ..self.evidence(facts, *i, segment)
        });
        let quantity = format!("distance from the path, {}", segments.which());
        let value = segments.worst(&followed, rms_m);
        Finding {
            curve: self.curve(facts, &followed, band),
            statistic: Some(Statistic::RootMeanSquare),
            ..Finding::against(band, value, "m", quantity)
        }
        .because(evidence.collect())
        .advise("Lead the TCP along each segment to its end before the next one, and correct what it is aside.")
    }

    fn path(&self) -> Option<&str> {
        Some(&self.0.path.name)
    }
}

impl PathDeviation {
    /// How segment `i` was followed, at its furthest.
    fn evidence(&self, facts: &MotionFacts<'_>, i: usize, segment: &FollowedSegment) -> Evidence {
        let mut message = format!(
            "{}: {} off (root mean square along the path travelled{})",
            segment_name(&self.0.path, i),
            metres(segment.rms_m),
            // which alone can be further away than any place of the run
            match segment.left_out_m > 1e-3 {
                true => " and what is never covered",
                false => "",
            },
        );
        let mut tick = segment.samples.last().map_or(0, |sample| sample.tick);
        if let Some(furthest) = segment.furthest() {
            tick = furthest.tick;
            let at = seconds(facts.time_s(tick));
            // behind rather than beside: 0.7 is half in squares
            message += &if furthest.back_m > 0.7 * furthest.deviation_m {
                format!("; at {at} it has gone back by {}", metres(furthest.back_m))
            } else {
                format!("; the furthest is {} at {at}", metres(furthest.deviation_m))
            };
        }
        if segment.left_out_m > 1e-3 {
            message += &format!(
                "; {} of {} are never covered",
                metres(segment.left_out_m),
                metres(segment.length_m)
            );
        }
        facts.evidence(message, "tcp".to_owned(), tick)
    }

    /// Deviation while the path is followed; near its points, where it does not count, there are gaps.
    fn curve(
        &self,
        facts: &MotionFacts<'_>,
        followed: &[FollowedSegment],
        band: Band,
    ) -> Option<Curve> {
        let mut t_s = Vec::new();
        let mut values = Vec::new();
        let mut marks = Vec::new();
        for (i, segment) in followed.iter().enumerate() {
            marks.push(self.mark(facts, i, segment.samples.first()?.tick, band));
            for sample in &segment.samples {
                t_s.push(facts.time_s(sample.tick));
                let counts = sample.counts && self.0.counts(i);
                values.push(if counts { sample.deviation_m } else { f64::NAN });
            }
        }
        let left = followed.last()?.samples.last()?;
        marks.push(self.mark(facts, followed.len(), left.tick, band));
        Some(Curve {
            marks,
            ..curve("distance from the path", "m", t_s, values, Some(band))
        })
    }

    /// The moment at which the TCP was nearest to point `i` in its turn, with words that say no more than that where it was not within
    /// the band.
    fn mark(&self, facts: &MotionFacts<'_>, i: usize, tick: usize, band: Band) -> (f64, String) {
        let path = &self.0.path;
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
}
