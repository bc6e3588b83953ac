//! pose-reached: the TCP stays at every goal, in order, for the goal's dwell.
//!
//! Measured at each goal is the greatest distance during the best dwell \[m\]; the score is the mean of the goals' scores. Reported
//! is how near the arm settles before it leaves.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{list, metres, seconds};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::{Finding, measure};
use crate::check::reading::InTask;
use crate::check::registry::{MotionTable, lacks_goals};
use crate::record::grade::Evidence;
use crate::record::graded::Curve;
use crate::task::model::{Band, MotionTask};
use crate::task::problem::LabError;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Distance from a goal that earns all points \[m\].
    full_m: f64,
    /// Distance from a goal that earns none \[m\].
    zero_m: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "pose-reached";
    type Check = PoseReached;

    fn lacks(task: &MotionTask) -> Option<&'static str> {
        lacks_goals(task)
    }

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<PoseReached, LabError> {
        let band = reading.report.band(self.full_m, self.zero_m, at)?;
        Ok(PoseReached { band })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct PoseReached {
    band: Band,
}

impl CheckKind for PoseReached {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, "m"))
    }
}

impl MotionCheck for PoseReached {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let goals = 0..facts.motion.goals.len();
        let settled_m = |goal: usize| {
            let stay = facts.stays.get(goal);
            stay.map_or(f64::INFINITY, |stay| stay.settled_m)
        };
        let scores = goals.clone().map(|goal| self.band.score(settled_m(goal)));
        let score = scores.sum::<f64>() / goals.len() as f64;
        let lost = goals
            .clone()
            .filter(|goal| self.band.score(settled_m(*goal)) < 1.0);
        let mut evidence: Vec<Evidence> = lost.map(|goal| self.evidence(facts, goal)).collect();
        evidence.sort_by(|a, b| {
            let value = |e: &Evidence| e.value.unwrap_or(f64::INFINITY);
            value(b).total_cmp(&value(a))
        });
        let worst_m = goals.map(settled_m).fold(0.0, f64::max);
        let measure = measure(
            "greatest distance from a goal while it is held",
            worst_m,
            "m",
            [self.band.full, self.band.zero],
        );
        Finding::scored(score, measure)
            .because(evidence)
            .advise("Compare the joint angles you command with those your inverse kinematics gives for the goal, and hold them until the dwell is over.")
            .drawn(self.curve(facts))
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Evidence
    }

    fn dwell_band(&self) -> Option<Band> {
        Some(self.band)
    }
}

impl PoseReached {
    /// Why the goal with this index loses points.
    fn evidence(&self, facts: &MotionFacts<'_>, index: usize) -> Evidence {
        let (number, goal) = (index + 1, &facts.motion.goals[index]);
        let position = list(goal.position_m.as_slice());
        let Some(stay) = facts.stays.get(index) else {
            let message = format!("the run ended before goal {number} at {position} was held");
            return facts.evidence(message, "tcp".to_owned(), facts.last_tick());
        };
        let p = facts.trace.tcp_position(stay.settled_last);
        let away = p - goal.position_m;
        let message = format!(
            "goal {number} at {position}: in its best {} (to {}) the TCP is up to {} away, at {} in the end (off by {} along x, y, z)",
            seconds(facts.motion.periods.time_s(goal.dwell_ticks)),
            seconds(facts.time_s(stay.settled_last)),
            metres(stay.settled_m),
            list(p.as_slice()),
            list(away.as_slice()),
        );
        Evidence {
            value: Some(stay.settled_m),
            limit: Some(self.band.full),
            unit: "m".to_owned(),
            ..facts.evidence(message, "tcp".to_owned(), stay.settled_last)
        }
    }

    /// Distance from the goal that is next: the first until its dwell ends, then the second, and so on.
    fn curve(&self, facts: &MotionFacts<'_>) -> Curve {
        let goals = &facts.motion.goals;
        let mut current = 0;
        let mut values = Vec::with_capacity(facts.trace.len());
        for tick in 0..facts.trace.len() {
            while current + 1 < goals.len()
                && facts
                    .stays
                    .get(current)
                    .is_some_and(|stay| stay.last < tick)
            {
                current += 1;
            }
            values.push((facts.trace.tcp_position(tick) - goals[current].position_m).norm());
        }
        let marks = facts.stays.iter().enumerate().map(|(i, stay)| {
            let at = facts.time_s(stay.last);
            let number = i + 1;
            let words = match self.band.score(stay.settled_m) > 0.0 {
                true => format!("goal {number} held"),
                false => format!("best stay near goal {number} ends"),
            };
            (at, words)
        });
        Curve {
            marks: marks.collect(),
            ..facts.curve("distance from the next goal", "m", values, self.band)
        }
    }
}
