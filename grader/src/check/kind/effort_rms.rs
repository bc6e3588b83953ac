//! effort-rms: the root mean square of a joint's effort over the run \[N m or N\].
//!
//! Efforts are those applied, after their limits. An arm that never moves needs little: let this check need another.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::trimmed;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::Finding;
use crate::check::joint_effort::{JointEffort, applied};
use crate::check::reading::InTask;
use crate::check::registry::MotionTable;
use crate::task::model::Band;
use crate::task::problem::LabError;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint; the one with the greatest root mean square where it is left out.
    #[schemars(with = "Option<String>")]
    joint: Option<Spanned<String>>,
    /// Effort that earns all points \[N m, or N of a prismatic joint\].
    full_n_m: f64,
    /// Effort that earns none.
    zero_n_m: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "effort-rms";
    type Check = EffortRms;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<EffortRms, LabError> {
        Ok(EffortRms(JointEffort {
            joint: reading.maybe_joint(self.joint.as_ref())?,
            band: reading.report.band(self.full_n_m, self.zero_n_m, at)?,
        }))
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct EffortRms(JointEffort);

impl CheckKind for EffortRms {
    fn band(&self, robot: &Robot) -> Option<(Band, &'static str)> {
        Some(self.0.band(robot))
    }
}

impl MotionCheck for EffortRms {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let JointEffort { joint, band } = self.0;
        let of_joint = |joint: usize| so_far(&applied(facts, joint));
        let (worst, value) = facts.worst_joint(joint, |joint| {
            of_joint(joint).last().copied().unwrap_or(0.0)
        });
        let (name, unit) = (facts.joint_name(worst), facts.units(worst).effort());
        let quantity = format!("root mean square effort of joint `{name}`");
        let title = format!("{quantity} so far");
        Finding::against(band, value, unit, quantity)
            .shown_at(facts, || {
                let message = format!(
                    "the effort of joint `{name}` has a root mean square of {} {unit} over the run",
                    trimmed(value, 3),
                );
                (message, format!("effort[{worst}]"), facts.applied_ticks())
            })
            .advise("Accelerate less, and do not let efforts work against each other.")
            .drawn(facts.curve(title, unit, of_joint(worst), band))
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::SoFar
    }
}

/// The root mean square up to each tick, that included.
fn so_far(efforts: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let mut count = 0.0;
    let mean_up_to = efforts.iter().map(|effort| {
        sum += effort * effort;
        count += 1.0;
        f64::sqrt(sum / count)
    });
    mean_up_to.collect()
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"effort\"\nduration_s = 1.0";
    const KIND: &str = "effort-rms = { full_n_m = 3.0, zero_n_m = 7.0 }";

    #[test]
    fn half_a_run_at_an_effort_counts_for_its_square() {
        let finding = judged(MOTION, KIND, |t_s| HandRow {
            effort: [-3.0, if t_s < 0.4999 { 7.0 } else { -1.0 }],
            ..HandRow::default()
        });
        // sqrt((49 + 1) / 2) = 5
        assert!((value(&finding) - 5.0).abs() < 1e-12);
        assert!((finding.score - 0.5).abs() < 1e-12);
        assert!(
            finding.evidence[0]
                .message
                .starts_with("the effort of joint `elbow`")
        );
        let shoulder = "effort-rms = { joint = \"shoulder\", full_n_m = 3.0, zero_n_m = 7.0 }";
        let finding = judged(MOTION, shoulder, |_| HandRow {
            effort: [-3.0, 9.0],
            ..HandRow::default()
        });
        assert_eq!(value(&finding), 3.0);
    }

    #[test]
    fn an_effort_that_is_no_number_earns_nothing() {
        let finding = judged(MOTION, KIND, |t_s| HandRow {
            effort: [0.0, if t_s < 0.1 { f64::NAN } else { 0.0 }],
            ..HandRow::default()
        });
        assert_eq!(finding.score, 0.0);
    }
}
