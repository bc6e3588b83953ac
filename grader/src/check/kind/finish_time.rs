//! finish-time: when the last dwell was over \[s\]; never, where some goal earned nothing.

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Whether more is better: then all points from `full` on, and none up to `zero`; false where it is left out.
    #[serde(default)]
    at_least: bool,
    /// Time that earns all points \[s\].
    full_s: BandEnd,
    /// Time that earns none \[s\].
    zero_s: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "finish-time";
    type Check = InBand<FinishTime>;

    fn lacks(task: &MotionTask) -> Option<&'static str> {
        lacks_goals(task)
    }

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        reading.in_band_either(self.at_least, [self.full_s, self.zero_s], "s", FinishTime)
    }
}

/// The end of the last dwell.
#[derive(Debug)]
pub(crate) struct FinishTime;

/// A finding of a run in which a goal was never held, and so nothing after it can be judged.
pub(super) fn first_hold(finding: Finding, goal: usize) -> Finding {
    let goal = goal + 1;
    let next_step = format!(
        "First see why the TCP does not come to goal {goal} and stay: before that there is nothing to judge here."
    );
    Finding {
        waits_for_goals: true,
        ..finding.advise(next_step).insisting()
    }
}

impl RunMeasure for FinishTime {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let missed = |dwell: &Dwell| facts.pose_band.score(dwell.settled_m) <= 0.0;
        let missed = facts.dwells.iter().position(missed);
        let last = facts.dwells.last().filter(|_| missed.is_none());
        let value = last.map_or(f64::INFINITY, |dwell| facts.time_s(dwell.last));
        let mut finding = Finding::against(band, value, "s", "end of the last dwell");
        if let Some(dwell) = last {
            finding = finding.shown_at(facts, || {
                let message = format!(
                    "the last dwell is over at {}, {} earns everything",
                    seconds(value),
                    seconds(band.full)
                );
                (message, "tcp".to_owned(), dwell.last)
            });
        }
        if let Some(goal) = missed {
            let message = format!(
                "goal {} was never held, so there is no time to judge",
                goal + 1
            );
            finding = finding.with(facts.evidence(message, "tcp".to_owned(), facts.last_tick()));
            return first_hold(finding, goal);
        }
        finding.advise(band.advice(
            "Start the next move as soon as the dwell is over.",
            "Move more slowly, or stay longer before the next move.",
        ))
    }
}
