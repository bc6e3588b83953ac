//! energy: the mechanical work of all motors, whichever its sign \[J\].
//!
//! `Σ |τ[k] (q[k+1] - q[k])|` over ticks and joints: the effort is held from tick to tick, so each term is the work over the step.
//! Work against a motor counts as much as work of it: brakes get hot, too.

use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::trimmed;

/// Judges the check.
pub fn judge(facts: &MotionFacts<'_>, band: Band, check: &str) -> Finding {
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
    let score = band.score(sum);
    let mut evidence = Vec::new();
    if score < 1.0 {
        let (worst, of_worst) = facts.worst_joint(None, |joint| of_joints[joint]);
        let message = format!(
            "the motors do {} J of work, {} J of it the one of joint `{}`",
            trimmed(sum, 3),
            trimmed(of_worst, 3),
            facts.joint_name(worst)
        );
        let last = trace.len().saturating_sub(1);
        evidence.push(Evidence {
            value: sum.is_finite().then_some(sum),
            limit: Some(band.full),
            unit: "J".to_owned(),
            ..facts.evidence(message, format!("effort[{worst}]"), last)
        });
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "work of the motors".to_owned(),
            value: sum.is_finite().then_some(sum),
            unit: "J".to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step: "Take a shorter way, or a slower one that needs less braking.".to_owned(),
        curve: Some(Curve {
            check: check.to_owned(),
            title: "work of the motors so far".to_owned(),
            unit: "J".to_owned(),
            t_s: (0..trace.len()).map(|tick| facts.time_s(tick)).collect(),
            values,
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
