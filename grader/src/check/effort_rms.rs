//! effort-rms: the root mean square of a joint's effort over the run, or of the joint with the greatest \[N m or N\].

use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::trimmed;

/// The root mean square up to each tick, that included.
fn so_far(efforts: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut sum = 0.0;
    let mut count = 0.0;
    efforts
        .map(|effort| {
            sum += effort * effort;
            count += 1.0;
            (sum / count).sqrt()
        })
        .collect()
}

/// Judges the check.
pub fn judge(facts: &MotionFacts<'_>, joint: Option<usize>, band: Band, check: &str) -> Finding {
    let trace = facts.trace;
    // the effort of the last row is never applied
    let applied = trace.len().saturating_sub(1);
    let of_joint = |joint: usize| so_far(trace.effort.component(joint).take(applied));
    let (worst, value) = facts.worst_joint(joint, |joint| {
        of_joint(joint).last().copied().unwrap_or(0.0)
    });
    let score = band.score(value);
    let (name, unit) = (facts.joint_name(worst), facts.units(worst).effort());
    let mut evidence = Vec::new();
    if score < 1.0 {
        let message = format!(
            "the effort of joint `{name}` has a root mean square of {} {unit} over the run",
            trimmed(value, 3),
        );
        evidence.push(Evidence {
            value: value.is_finite().then_some(value),
            limit: Some(band.full),
            unit: unit.to_owned(),
            ..facts.evidence(message, format!("effort[{worst}]"), applied)
        });
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: format!("root mean square effort of joint `{name}`"),
            value: value.is_finite().then_some(value),
            unit: unit.to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step: "Accelerate less, and do not let efforts work against each other.".to_owned(),
        curve: Some(Curve {
            check: check.to_owned(),
            title: format!("root mean square effort of joint `{name}` so far"),
            unit: unit.to_owned(),
            t_s: (0..applied).map(|tick| facts.time_s(tick)).collect(),
            values: of_joint(worst),
            full: Some(band.full),
            zero: Some(band.zero),
            marks: Vec::new(),
            step: None,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::super::by_hand::{HandRow, judged, value};

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
