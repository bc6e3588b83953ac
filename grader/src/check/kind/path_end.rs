//! path-end: how far the TCP is from the last point of a path at the end of the run \[m\].
//!
//! Measured is the greatest distance over the last `last_s`. So a TCP that only passes the point, goes on beyond it or circles around it
//! is as far off as it gets in that time, whichever of its joints still moves.

use crate::check::prelude::*;
use crate::task::watched::PathToFollow;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// A path of `[tasks.motion.paths]`.
    path: At<String>,
    /// The time at the end of the run that counts \[s\]; 0.5 where it is left out.
    last_s: Option<At<f64>>,
    /// Distance that earns all points \[m\].
    full_m: BandEnd,
    /// Distance that earns none \[m\].
    zero_m: BandEnd,
}

/// The time that counts where a lab names none \[s\].
const LAST_S: f64 = 0.5;

impl MotionTable for Table {
    const NAME: &'static str = "path-end";
    type Check = InBand<PathEnd>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let last_s = match &self.last_s {
            Some(last_s) => reading.report.positive(last_s, "`last_s`")?,
            None => LAST_S,
        };
        let measure = PathEnd {
            path: reading.path(&self.path)?,
            last_s,
        };
        reading.in_band([self.full_m, self.zero_m], "m", measure)
    }
}

/// The distance from the last point of a path.
#[derive(Debug)]
pub(crate) struct PathEnd {
    path: PathToFollow,
    last_s: f64,
}

impl RunMeasure for PathEnd {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let p_tcp_m = facts.p_tcp_m();
        let Some(point) = self.path.points_m.last() else {
            return Finding::against(band, f64::INFINITY, "m", "distance from the path's end");
        };
        let away_m: Vec<f64> = p_tcp_m.iter().map(|p| (p - point).norm()).collect();
        let ticks = (self.last_s / facts.motion.periods.step_s).round() as usize;
        let first = facts.last_tick().saturating_sub(ticks);
        let (after, value) =
            greatest(away_m.iter().skip(first).copied()).unwrap_or((0, f64::INFINITY));
        let worst = first + after;
        let last = facts.last_tick();
        let curve = Curve {
            marks: vec![(facts.time_s(first), "judged from here".to_owned())],
            ..facts.curve("distance from the path's end", "m", away_m.clone(), band)
        };
        let quantity = format!(
            "greatest distance from the end of the path in the last {}",
            seconds(self.last_s)
        );
        Finding::against(band, value, "m", quantity)
            .shown_at(facts, || {
                let [p, end] = [worst, last].map(|tick| p_tcp_m[tick]);
                let message = format!(
                    "in the last {} the TCP is up to {} from the last point, {}: at {} it is at {}, and at the end of the run at {}",
                    seconds(self.last_s),
                    metres(value),
                    list(point.as_slice()),
                    seconds(facts.time_s(worst)),
                    list(p.as_slice()),
                    list(end.as_slice()),
                );
                (message, "tcp".to_owned(), worst)
            })
            .advise("Come to rest at the last point, and stay there.")
            .drawn(curve)
    }

    fn path(&self) -> Option<&str> {
        Some(&self.path.name)
    }
}
