//! finish-time: when the last dwell was over \[s\]; never, where some goal earned nothing.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::seconds;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::reading::InTask;
use crate::check::registry::{MotionTable, lacks_goals};
use crate::task::model::{Band, MotionTask};
use crate::task::problem::LabError;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Time that earns all points \[s\].
    full_s: f64,
    /// Time that earns none \[s\].
    zero_s: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "finish-time";
    type Check = FinishTime;

    fn lacks(task: &MotionTask) -> Option<&'static str> {
        lacks_goals(task)
    }

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<FinishTime, LabError> {
        let band = reading.report.band(self.full_s, self.zero_s, at)?;
        Ok(FinishTime { band })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct FinishTime {
    band: Band,
}

impl CheckKind for FinishTime {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, "s"))
    }
}

impl MotionCheck for FinishTime {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let missed = facts
            .stays
            .iter()
            .position(|stay| facts.pose_band.score(stay.settled_m) <= 0.0);
        let last = facts.stays.last().filter(|_| missed.is_none());
        let finish = last.map(|stay| (stay.last, facts.time_s(stay.last)));
        let value = finish.map_or(f64::INFINITY, |(_, time_s)| time_s);
        let mut finding = Finding::against(self.band, value, "s", "end of the last dwell");
        if let Some((tick, time_s)) = finish {
            finding = finding.shown_at(facts, || {
                let message = format!(
                    "the last dwell is over at {}, {} earns everything",
                    seconds(time_s),
                    seconds(self.band.full)
                );
                (message, "tcp".to_owned(), tick)
            });
        }
        if let Some(goal) = missed {
            let message = format!(
                "goal {} was never held, so there is no time to judge",
                goal + 1
            );
            finding = finding.with(facts.evidence(message, "tcp".to_owned(), facts.last_tick()));
        }
        finding.advise("Start the next move as soon as the dwell is over.")
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Evidence
    }
}
