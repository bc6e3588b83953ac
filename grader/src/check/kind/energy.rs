//! energy: the mechanical work of all motors, whichever its sign \[J\].
//!
//! `Σ |τ[k] (q[k+1] - q[k])|` over ticks and joints: the effort is held from tick to tick, so each term is the work over the step.
//! Work against a motor counts as much as work of it: brakes get hot, too.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::trimmed;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::reading::InTask;
use crate::check::registry::MotionTable;
use crate::task::model::Band;
use crate::task::problem::LabError;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Work that earns all points \[J\].
    full_j: f64,
    /// Work that earns none \[J\].
    zero_j: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "energy";
    type Check = Energy;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<Energy, LabError> {
        let band = reading.report.band(self.full_j, self.zero_j, at)?;
        Ok(Energy { band })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct Energy {
    band: Band,
}

impl CheckKind for Energy {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, "J"))
    }
}

impl MotionCheck for Energy {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let trace = facts.trace;
        let mut of_joints = vec![0.0; facts.robot.n()];
        let mut sum = 0.0;
        let mut values = Vec::with_capacity(trace.len());
        for tick in 0..trace.len() {
            values.push(sum);
            if tick + 1 < trace.len() {
                let ways = trace.q.at(tick + 1).iter().zip(trace.q.at(tick));
                let efforts = trace.effort.at(tick).iter().zip(&mut of_joints);
                for ((effort, of_joint), (to, from)) in efforts.zip(ways) {
                    let work = (effort * (to - from)).abs();
                    *of_joint += work;
                    sum += work;
                }
            }
        }
        Finding::against(self.band, sum, "J", "work of the motors")
            .shown_at(facts, || {
                let (worst, of_worst) = facts.worst_joint(None, |joint| of_joints[joint]);
                let message = format!(
                    "the motors do {} J of work, {} J of it the one of joint `{}`",
                    trimmed(sum, 3),
                    trimmed(of_worst, 3),
                    facts.joint_name(worst)
                );
                (message, format!("effort[{worst}]"), facts.last_tick())
            })
            .advise("Take a shorter way, or a slower one that needs less braking.")
            .drawn(facts.curve("work of the motors so far", "J", values, self.band))
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::SoFar
    }
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"effort\"\nduration_s = 1.0";
    const KIND: &str = "energy = { full_j = 3.0, zero_j = 7.0 }";

    #[test]
    fn work_of_and_against_the_motors_adds_up() {
        // 4 N m over half a radian there and back, and 2 N m over half a radian: 2 + 2 + 1
        let finding = judged(MOTION, KIND, |t_s| HandRow {
            q: [0.5 - (t_s - 0.5).abs(), -0.5 * t_s],
            effort: [4.0, 2.0],
            ..HandRow::default()
        });
        assert!((value(&finding) - 5.0).abs() < 1e-12);
        assert!((finding.score - 0.5).abs() < 1e-12);
        assert_eq!(
            finding.evidence[0].message,
            "the motors do 5 J of work, 4 J of it the one of joint `shoulder`"
        );
    }

    #[test]
    fn holding_still_is_no_work_and_no_number_earns_nothing() {
        let finding = judged(MOTION, KIND, |_| HandRow {
            effort: [50.0, 50.0],
            ..HandRow::default()
        });
        assert_eq!((value(&finding), finding.score), (0.0, 1.0));
        let finding = judged(MOTION, KIND, |_| HandRow {
            effort: [f64::NAN, 0.0],
            ..HandRow::default()
        });
        assert_eq!(finding.score, 0.0);
    }
}
