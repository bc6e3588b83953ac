//! effort-rms: the root mean square of a joint's effort over the run \[N m or N\].
//!
//! Efforts are those applied, after their limits. An arm that never moves needs little: let this check need another.

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint; the one with the greatest root mean square where it is left out.
    joint: Option<At<String>>,
    /// Whether more is better: then all points from `full` on, and none up to `zero`; false where it is left out.
    #[serde(default)]
    at_least: bool,
    /// Effort that earns all points \[N m, or N of a prismatic joint\].
    full_n_m: BandEnd,
    /// Effort that earns none.
    zero_n_m: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "effort-rms";
    type Check = InBand<EffortRms>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let joint = reading.maybe_joint(self.joint.as_ref())?;
        let unit = reading.units(joint).effort();
        reading.in_band_either(
            self.at_least,
            [self.full_n_m, self.zero_n_m],
            unit,
            EffortRms(joint),
        )
    }
}

/// Of the joint of this index in `q`; of the worst one where there is none.
#[derive(Debug)]
pub(crate) struct EffortRms(Option<usize>);

impl RunMeasure for EffortRms {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let so_far = |joint: usize| so_far(&facts.applied_efforts(joint));
        let of_run = |joint: usize| Statistic::SoFar.of(&so_far(joint));
        let (worst, value) = facts.worst_joint(self.0, of_run);
        let (name, unit) = (facts.joint_name(worst), facts.units(worst).effort());
        let quantity = format!("root mean square effort of joint `{name}`");
        let curve = facts.curve(format!("{quantity} so far"), unit, so_far(worst), band);
        Finding::of_curve(band, Statistic::SoFar, unit, quantity, curve)
            .shown_at(facts, || {
                let message = format!(
                    "the effort of joint `{name}` has a root mean square of {} {unit} over the run",
                    trimmed(value, 3),
                );
                (message, format!("effort[{worst}]"), facts.applied_ticks())
            })
            .advise(band.advice(
                "Accelerate less, and do not let efforts work against each other.",
                "Drive the joint harder, or for longer.",
            ))
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
