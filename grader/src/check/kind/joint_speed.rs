//! joint-speed: the greatest speed of any joint over the run \[rad/s or m/s\]. A speed that is no number earns nothing.

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
use crate::task::joint_units::JointUnits;
use crate::task::model::Band;
use crate::task::problem::LabError;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// Speed that earns all points \[rad/s, or m/s of a prismatic joint\].
    full_rad_s: f64,
    /// Speed that earns none.
    zero_rad_s: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "joint-speed";
    type Check = JointSpeed;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<JointSpeed, LabError> {
        let band = reading.report.band(self.full_rad_s, self.zero_rad_s, at)?;
        Ok(JointSpeed { band })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct JointSpeed {
    band: Band,
}

impl CheckKind for JointSpeed {
    fn band(&self, robot: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, JointUnits::of_all(robot).speed()))
    }
}

impl MotionCheck for JointSpeed {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let mut worst = (0.0_f64, 0, 0); // value, tick, joint
        let mut fastest = Vec::with_capacity(facts.trace.len());
        for tick in 0..facts.trace.len() {
            let mut here = 0.0_f64;
            for (joint, speed) in facts.trace.qd.at(tick).iter().enumerate() {
                let speed = if speed.is_nan() {
                    f64::INFINITY
                } else {
                    speed.abs()
                };
                here = here.max(speed);
                if speed > worst.0 {
                    worst = (speed, tick, joint);
                }
            }
            fastest.push(here);
        }
        let first_above = fastest.iter().position(|speed| *speed > self.band.full);
        let (value, tick, joint) = worst;
        let unit = facts.units(joint).speed();
        let moves = match facts.units(joint) {
            JointUnits::Sliding => "slides",
            JointUnits::Turning | JointUnits::Mixed => "turns",
        };
        let unit_of_all = JointUnits::of_all(facts.robot).speed();
        Finding::against(self.band, value, unit, "greatest speed of a joint")
            .shown_at(facts, || {
                let message = format!(
                    "joint `{}` {moves} at {} {unit} at {}; {} {unit} are first passed at {}",
                    facts.joint_name(joint),
                    trimmed(value, 3),
                    seconds(facts.time_s(tick)),
                    trimmed(self.band.full, 3),
                    seconds(facts.time_s(first_above.unwrap_or(tick))),
                );
                (message, format!("qd[{joint}]"), tick)
            })
            .advise("Scale all joint velocities down together where the largest is too high: the direction of the hand stays.")
            .drawn(facts.curve("speed of the fastest joint", unit_of_all, fastest, self.band))
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Greatest
    }
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"velocity\"\nduration_s = 1.0";
    const KIND: &str = "joint-speed = { full_rad_s = 1.0, zero_rad_s = 3.0 }";

    #[test]
    fn the_fastest_joint_counts_whichever_way_it_turns() {
        let finding = judged(MOTION, KIND, |t_s| HandRow {
            qd: [0.5, -2.0 * t_s],
            ..HandRow::default()
        });
        // the last tick of the run is 1 s
        assert!((value(&finding) - 2.0).abs() < 1e-12, "{finding:?}");
        assert!((finding.score - 0.5).abs() < 1e-12);
        let told = &finding.evidence[0].message;
        assert!(
            told.contains("joint `elbow`") && told.contains("first passed at 0.501 s"),
            "{told}"
        );
        assert_eq!(judged(MOTION, KIND, |_| HandRow::default()).score, 1.0);
    }

    #[test]
    fn a_speed_that_is_no_number_earns_nothing() {
        let finding = judged(MOTION, KIND, |_| HandRow {
            qd: [f64::NAN, 0.0],
            ..HandRow::default()
        });
        assert_eq!(finding.score, 0.0);
    }
}
