//! joint-limits: how far a joint leaves its position limits \[rad or m\]. Inside the limits the value is negative: the margin that is
//! left.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{seconds, trimmed};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::reading::InTask;
use crate::check::registry::MotionTable;
use crate::record::grade::Evidence;
use crate::task::joint_units::JointUnits;
use crate::task::model::Band;
use crate::task::problem::LabError;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Distance beyond a limit that earns all points \[rad, or m of a prismatic joint\].
    full_rad: f64,
    /// Distance that earns none.
    zero_rad: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "joint-limits";
    type Check = JointLimits;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<JointLimits, LabError> {
        let band = reading.report.band(self.full_rad, self.zero_rad, at)?;
        Ok(JointLimits { band })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct JointLimits {
    band: Band,
}

impl CheckKind for JointLimits {
    fn band(&self, robot: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, JointUnits::of_all(robot).position()))
    }
}

impl MotionCheck for JointLimits {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let trace = facts.trace;
        let mut worst = (f64::NEG_INFINITY, 0, 0); // value, tick, joint
        let mut breach: Option<(usize, usize)> = None;
        for (index, joint) in facts.robot.moving_joints().enumerate() {
            let lower = joint.limits.lower.unwrap_or(f64::NEG_INFINITY);
            let upper = joint.limits.upper.unwrap_or(f64::INFINITY);
            for (tick, q) in trace.q.component(index).enumerate() {
                let beyond = (q - upper).max(lower - q);
                if beyond > worst.0 {
                    worst = (beyond, tick, index);
                }
                if beyond > self.band.full && breach.is_none_or(|(first, _)| tick < first) {
                    breach = Some((tick, index));
                }
            }
        }
        let (value, tick, joint) = worst;
        let unit = facts.units(joint).position();
        let quantity = "way beyond a joint's limits (negative inside)";
        let mut finding = Finding::against(self.band, value, unit, quantity);
        if let (Some((first, first_joint)), true) = (breach, finding.is_lost()) {
            let message = format!(
                "joint `{}` leaves its limits at {}; joint `{}` is {} {unit} beyond at its worst, at {}",
                facts.joint_name(first_joint),
                seconds(facts.time_s(first)),
                facts.joint_name(joint),
                trimmed(value, 4),
                seconds(facts.time_s(tick)),
            );
            finding = finding.with(Evidence {
                value: Some(trace.q.at(first)[first_joint]),
                limit: Some(self.band.full),
                unit: facts.units(first_joint).position().to_owned(),
                ..facts.evidence(message, format!("q[{first_joint}]"), first)
            });
        }
        finding.advise(match facts.units(joint) {
            JointUnits::Sliding => "Take positions between the limits.",
            JointUnits::Turning | JointUnits::Mixed => {
                "Take angles between the limits: `wrap_pi` brings an angle into (-pi, pi]."
            }
        })
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Evidence
    }
}
