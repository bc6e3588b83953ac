//! joint-speed: the greatest speed of any joint over the run \[rad/s or m/s\].

use super::{Finding, MotionFacts};
use crate::lab::joint_units::JointUnits;
use crate::lab::model::Band;
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::{seconds, trimmed};

/// Judges the check. A speed that is no number earns nothing.
pub fn judge(facts: &MotionFacts<'_>, band: Band, check: &str) -> Finding {
    let qd = &facts.trace.qd;
    let mut worst = (0.0_f64, 0, 0); // value, tick, joint
    let mut first_above = None;
    let mut fastest = Vec::with_capacity(facts.trace.len());
    for tick in 0..facts.trace.len() {
        let mut here = 0.0_f64;
        for (joint, speed) in qd.at(tick).iter().enumerate() {
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
        if here > band.full && first_above.is_none() {
            first_above = Some(tick);
        }
        fastest.push(here);
    }
    let (value, tick, joint) = worst;
    let units = facts.units(joint);
    let (unit, moves) = match units {
        JointUnits::Sliding => (units.speed(), "slides"),
        JointUnits::Turning | JointUnits::Mixed => (units.speed(), "turns"),
    };
    let score = band.score(value);
    let mut evidence = Vec::new();
    if let (Some(first), true) = (first_above, score < 1.0) {
        let message = format!(
            "joint `{}` {moves} at {} {unit} at {}; {} {unit} are first passed at {}",
            facts.joint_name(joint),
            trimmed(value, 3),
            seconds(facts.time_s(tick)),
            trimmed(band.full, 3),
            seconds(facts.time_s(first)),
        );
        evidence.push(Evidence {
            value: value.is_finite().then_some(value),
            limit: Some(band.full),
            unit: unit.to_owned(),
            ..facts.evidence(message, format!("qd[{joint}]"), tick)
        });
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "greatest speed of a joint".to_owned(),
            value: value.is_finite().then_some(value),
            unit: unit.to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step: "Scale all joint velocities down together where the largest is too high: the direction of the hand stays."
            .to_owned(),
        curve: Some(Curve {
            check: check.to_owned(),
            title: "speed of the fastest joint".to_owned(),
            unit: JointUnits::of_all(facts.robot).speed().to_owned(),
            t_s: (0..facts.trace.len()).map(|tick| facts.time_s(tick)).collect(),
            values: fastest,
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
