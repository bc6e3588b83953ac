//! effort-peak: the greatest effort of a joint, or of the joint with the greatest, whichever its sign \[N m or N\].

use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::{seconds, trimmed};

/// Judges the check.
pub fn judge(facts: &MotionFacts<'_>, joint: Option<usize>, band: Band, check: &str) -> Finding {
    let trace = facts.trace;
    // the effort of the last row is never applied
    let applied = trace.len().saturating_sub(1);
    let size = |tick: usize, joint: usize| trace.effort.at(tick)[joint].abs();
    let peak_tick = |joint: usize| {
        let ticks = 0..applied;
        // of equal ones the first
        ticks.max_by(|a, b| size(*a, joint).total_cmp(&size(*b, joint)).then(b.cmp(a)))
    };
    let peak = |joint: usize| peak_tick(joint).map_or(0.0, |tick| size(tick, joint));
    let (worst, value) = facts.worst_joint(joint, peak);
    let tick = peak_tick(worst).unwrap_or(0);
    let score = band.score(value);
    let (name, unit) = (facts.joint_name(worst), facts.units(worst).effort());
    let mut evidence = Vec::new();
    if score < 1.0 {
        let message = format!(
            "the effort of joint `{name}` is {} {unit} at {}, its greatest",
            trimmed(trace.effort.at(tick)[worst], 3),
            seconds(facts.time_s(tick)),
        );
        evidence.push(Evidence {
            value: value.is_finite().then_some(value),
            limit: Some(band.full),
            unit: unit.to_owned(),
            ..facts.evidence(message, format!("effort[{worst}]"), tick)
        });
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: format!("greatest effort of joint `{name}`"),
            value: value.is_finite().then_some(value),
            unit: unit.to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step: "Ask for the step less suddenly, or lower the gains.".to_owned(),
        curve: Some(Curve {
            check: check.to_owned(),
            title: format!("size of the effort of joint `{name}`"),
            unit: unit.to_owned(),
            t_s: (0..applied).map(|tick| facts.time_s(tick)).collect(),
            values: (0..applied).map(|tick| size(tick, worst)).collect(),
            full: Some(band.full),
            zero: Some(band.zero),
            marks: vec![(facts.time_s(tick), "greatest".to_owned())],
            step: None,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::super::by_hand::{HandRow, judged, value};

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
