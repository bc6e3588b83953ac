//! overshoot: how far the TCP runs past a goal along the line to it, as a fraction of that line's length.
//!
//! The line to a goal starts where the TCP was when the move to it began: where the dwell before ended, or the run began. Past the
//! goal means further along that line, up to the end of the dwell at the goal; being beside it does not count, so that every path
//! is right.

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Fraction that earns all points.
    full: BandEnd,
    /// Fraction that earns none.
    zero: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "overshoot";
    type Check = InBand<Overshoot>;

    fn lacks(task: &MotionTask) -> Option<&'static str> {
        lacks_goals(task)
    }

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        reading.in_band([self.full, self.zero], "", Overshoot)
    }
}

/// How far past a goal the TCP is.
#[derive(Debug)]
pub(crate) struct Overshoot;

/// Where the TCP is furthest past a goal, as a fraction of the line to it.
#[derive(Debug, Clone, Copy)]
struct Furthest {
    /// Index of the goal.
    goal: usize,
    tick: usize,
    fraction: f64,
    past_m: f64,
}

/// How far past its goal the TCP is at every tick, as a fraction of the line to it; and where most.
fn past_goals(facts: &MotionFacts<'_>) -> (Vec<f64>, Option<Furthest>) {
    let trace = facts.trace;
    let mut values = vec![0.0; trace.len()];
    let mut furthest: Option<Furthest> = None;
    let mut start = 0;
    for (goal_index, (goal, dwell)) in facts.motion.goals.iter().zip(&facts.dwells).enumerate() {
        let line = goal.position_m - trace.tcp_position(start);
        let length_m = line.norm();
        if length_m > 1e-6 {
            let along = line / length_m;
            let ticks = values.iter_mut().enumerate();
            for (tick, value) in ticks.take(dwell.last + 1).skip(start) {
                let past_m = (trace.tcp_position(tick) - goal.position_m)
                    .dot(&along)
                    .max(0.0);
                let fraction = past_m / length_m;
                *value = fraction;
                if furthest.is_none_or(|furthest| fraction > furthest.fraction) {
                    furthest = Some(Furthest {
                        goal: goal_index,
                        tick,
                        fraction,
                        past_m,
                    });
                }
            }
        }
        start = dwell.last;
    }
    (values, furthest)
}

impl RunMeasure for Overshoot {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let (values, furthest) = past_goals(facts);
        let value = furthest.map_or(f64::INFINITY, |furthest| furthest.fraction);
        let quantity = "overshoot past a goal, as a fraction of the move";
        let curve = facts.curve("way past the goal", "", values, band);
        let mut finding = Finding {
            statistic: Some(Statistic::Greatest),
            ..Finding::against(band, value, "", quantity).drawn(curve)
        };
        if let Some(furthest) = furthest {
            finding = finding.shown_at(facts, || {
                let message = format!(
                    "on the way to goal {} the TCP runs {} past it, {} % of the way",
                    furthest.goal + 1,
                    metres(furthest.past_m),
                    trimmed(furthest.fraction * 100.0, 1)
                );
                (message, "tcp".to_owned(), furthest.tick)
            });
        }
        finding.advise(
            "Lead the joints to the goal with a smooth profile (`quintic`) instead of a jump.",
        )
    }
}
