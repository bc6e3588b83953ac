//! effort-peak: the greatest effort of a joint, whichever its sign \[N m or N\].
//!
//! Efforts are those applied, after their limits. An arm that never moves needs little: let this check need another.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{seconds, trimmed};
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
    /// The joint; the one with the greatest effort where it is left out.
    #[schemars(with = "Option<String>")]
    joint: Option<Spanned<String>>,
    /// Effort that earns all points \[N m, or N of a prismatic joint\].
    full_n_m: f64,
    /// Effort that earns none.
    zero_n_m: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "effort-peak";
    type Check = EffortPeak;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<EffortPeak, LabError> {
        Ok(EffortPeak(JointEffort {
            joint: reading.maybe_joint(self.joint.as_ref())?,
            band: reading.report.band(self.full_n_m, self.zero_n_m, at)?,
        }))
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct EffortPeak(JointEffort);

impl CheckKind for EffortPeak {
    fn band(&self, robot: &Robot) -> Option<(Band, &'static str)> {
        Some(self.0.band(robot))
    }
}

impl MotionCheck for EffortPeak {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let JointEffort { joint, band } = self.0;
        let size = |tick: usize, joint: usize| facts.trace.effort.at(tick)[joint].abs();
        let peak_tick = |joint: usize| {
            let ticks = 0..facts.applied_ticks();
            // of equal ones the first
            ticks.max_by(|a, b| size(*a, joint).total_cmp(&size(*b, joint)).then(b.cmp(a)))
        };
        let peak = |joint: usize| peak_tick(joint).map_or(0.0, |tick| size(tick, joint));
        let (worst, value) = facts.worst_joint(joint, peak);
        let tick = peak_tick(worst).unwrap_or(0);
        let (name, unit) = (facts.joint_name(worst), facts.units(worst).effort());
        let sizes = applied(facts, worst).into_iter().map(f64::abs).collect();
        let mut curve = facts.curve(
            format!("size of the effort of joint `{name}`"),
            unit,
            sizes,
            band,
        );
        curve.marks = vec![(facts.time_s(tick), "greatest".to_owned())];
        Finding::against(
            band,
            value,
            unit,
            format!("greatest effort of joint `{name}`"),
        )
        .shown_at(facts, || {
            let message = format!(
                "the effort of joint `{name}` is {} {unit} at {}, its greatest",
                trimmed(facts.trace.effort.at(tick)[worst], 3),
                seconds(facts.time_s(tick)),
            );
            (message, format!("effort[{worst}]"), tick)
        })
        .advise("Ask for the step less suddenly, or lower the gains.")
        .drawn(curve)
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Greatest
    }
}

#[cfg(test)]
mod tests {
    use crate::check::by_hand::{HandRow, judged, value};

    const MOTION: &str = "mode = \"effort\"\nduration_s = 1.0";

    fn row(t_s: f64) -> HandRow {
        HandRow {
            // the last row's is never applied
            effort: [2.0, if t_s > 0.9995 { 90.0 } else { -8.0 * t_s }],
            ..HandRow::default()
        }
    }

    #[test]
    fn the_worst_joint_counts_unless_one_is_named() {
        let finding = judged(
            MOTION,
            "effort-peak = { full_n_m = 4.0, zero_n_m = 12.0 }",
            row,
        );
        assert!((value(&finding) - 8.0 * 0.999).abs() < 1e-12);
        assert_eq!(
            finding.evidence[0].message,
            "the effort of joint `elbow` is -7.992 N m at 0.999 s, its greatest"
        );
        let shoulder = "effort-peak = { joint = \"shoulder\", full_n_m = 4.0, zero_n_m = 12.0 }";
        let finding = judged(MOTION, shoulder, row);
        assert_eq!((value(&finding), finding.score), (2.0, 1.0));
    }

    #[test]
    fn an_effort_that_is_no_number_earns_nothing() {
        let kind = "effort-peak = { full_n_m = 4.0, zero_n_m = 12.0 }";
        let finding = judged(MOTION, kind, |t_s| HandRow {
            effort: [0.0, if t_s < 0.1 { -f64::NAN } else { 0.0 }],
            ..HandRow::default()
        });
        assert_eq!(finding.score, 0.0);
    }
}
