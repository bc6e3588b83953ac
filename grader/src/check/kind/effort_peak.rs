//! effort-peak: the greatest effort of a joint, whichever its sign \[N m or N\].
//!
//! Efforts are those applied, after their limits. An arm that never moves needs little: let this check need another.

use crate::check::prelude::*;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// The joint; the one with the greatest effort where it is left out.
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
    const NAME: &'static str = "effort-peak";
    type Check = InBand<EffortPeak>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let joint = reading.maybe_joint(self.joint.as_ref())?;
        let unit = reading.units(joint).effort();
        reading.in_band_either(
            self.at_least,
            [self.full_n_m, self.zero_n_m],
            unit,
            EffortPeak(joint),
        )
    }
}

/// Of the joint of this index in `q`; of the worst one where there is none.
#[derive(Debug)]
pub(crate) struct EffortPeak(Option<usize>);

impl RunMeasure for EffortPeak {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let sizes = |joint: usize| facts.applied_efforts(joint).into_iter().map(f64::abs);
        let peak = |joint: usize| greatest(sizes(joint)).unwrap_or_default();
        let (worst, _) = facts.worst_joint(self.0, |joint| peak(joint).1);
        let (tick, _) = peak(worst);
        let (name, unit) = (facts.joint_name(worst), facts.units(worst).effort());
        let title = format!("size of the effort of joint `{name}`");
        let mut curve = facts.curve(title, unit, sizes(worst).collect(), band);
        curve.marks = vec![(facts.time_s(tick), "greatest".to_owned())];
        let quantity = format!("greatest effort of joint `{name}`");
        Finding::of_curve(band, Statistic::Greatest, unit, quantity, curve)
            .shown_at(facts, || {
                let message = format!(
                    "the effort of joint `{name}` is {} {unit} at {}, its greatest",
                    trimmed(facts.trace.effort.at(tick)[worst], 3),
                    seconds(facts.time_s(tick)),
                );
                (message, format!("effort[{worst}]"), tick)
            })
            .advise(band.advice(
                "Ask for the step less suddenly, or lower the gains.",
                "Drive the joint harder where it needs it most.",
            ))
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
