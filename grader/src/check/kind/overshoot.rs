//! overshoot: how far the TCP runs past a goal along the line to it, as a fraction of that line's length.
//!
//! The line to a goal starts where the TCP was when the move to it began: where the dwell before ended, or the run began. Past the
//! goal means further along that line, up to the end of the dwell at the goal; being beside it does not count, so that every path
//! is right.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{metres, trimmed};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::reading::InTask;
use crate::check::registry::{MotionTable, lacks_goals};
use crate::record::grade::Evidence;
use crate::task::model::{Band, MotionTask};
use crate::task::problem::LabError;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Fraction that earns all points.
    full: f64,
    /// Fraction that earns none.
    zero: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "overshoot";
    type Check = Overshoot;

    fn lacks(task: &MotionTask) -> Option<&'static str> {
        lacks_goals(task)
    }

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<Overshoot, LabError> {
        let band = reading.report.band(self.full, self.zero, at)?;
        Ok(Overshoot { band })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct Overshoot {
    band: Band,
}

impl CheckKind for Overshoot {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, ""))
    }
}

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
    for (goal_index, (goal, stay)) in facts.motion.goals.iter().zip(&facts.stays).enumerate() {
        let line = goal.position_m - trace.tcp_position(start);
        let length_m = line.norm();
        if length_m > 1e-6 {
            let along = line / length_m;
            let ticks = values
                .iter_mut()
                .enumerate()
                .take(stay.last + 1)
                .skip(start);
            for (tick, value) in ticks {
                let past_m = (trace.tcp_position(tick) - goal.position_m).dot(&along);
                *value = past_m.max(0.0) / length_m;
                if furthest.is_none_or(|furthest| *value > furthest.fraction) {
                    furthest = Some(Furthest {
                        goal: goal_index,
                        tick,
                        fraction: *value,
                        past_m: past_m.max(0.0),
                    });
                }
            }
        }
        start = stay.last;
    }
    (values, furthest)
}

impl MotionCheck for Overshoot {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let (values, furthest) = past_goals(facts);
        let value = furthest.map_or(f64::INFINITY, |furthest| furthest.fraction);
        let quantity = "way past a goal, as a fraction of the way to it";
        let mut finding = Finding::against(self.band, value, "", quantity);
        if let (Some(furthest), true) = (furthest, finding.is_lost()) {
            let message = format!(
                "on the way to goal {} the TCP runs {} past it, {} % of the way",
                furthest.goal + 1,
                metres(furthest.past_m),
                trimmed(furthest.fraction * 100.0, 1)
            );
            finding = finding.with(Evidence {
                value: Some(furthest.fraction),
                limit: Some(self.band.full),
                ..facts.evidence(message, "tcp".to_owned(), furthest.tick)
            });
        }
        finding
            .advise(
                "Lead the joints to the goal with a smooth profile (`quintic`) instead of a jump.",
            )
            .drawn(facts.curve("way past the goal", "", values, self.band))
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Greatest
    }
}
