//! pose-reached: the TCP stays at every goal, in order, for the goal's dwell.
//!
//! Measured at each goal is the greatest distance during the best stay \[m\]; the score is the mean of the goals' scores. Told is
//! how near the arm settles before it leaves.

use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::{list, metres, seconds};

/// Judges the check.
pub fn judge(facts: &MotionFacts<'_>, band: Band, check: &str) -> Finding {
    let goals = &facts.motion.goals;
    let settled = |goal: usize| {
        let stay = facts.stays.get(goal);
        stay.map_or(f64::INFINITY, |stay| stay.settled_m)
    };
    let scores = (0..goals.len()).map(|goal| band.score(settled(goal)));
    let score = scores.sum::<f64>() / goals.len() as f64;
    let mut evidence: Vec<Evidence> = Vec::new();
    for (i, goal) in goals.iter().enumerate() {
        if band.score(settled(i)) >= 1.0 {
            continue;
        }
        let position = list(goal.position_m.as_slice());
        let dwell_s = facts.motion.periods.time_s(goal.dwell_ticks);
        let Some(stay) = facts.stays.get(i) else {
            let last = facts.trace.len().saturating_sub(1);
            let message = format!("the run ended before goal {} at {position} was held", i + 1);
            evidence.push(facts.evidence(message, "tcp".to_owned(), last));
            continue;
        };
        let p = facts.trace.tcp_position(stay.settled_last);
        let away = p - goal.position_m;
        let message = format!(
            "goal {} at {position}: in its best {} (to {}) the TCP is up to {} away, at {} in the end (off by {} along x, y, z)",
            i + 1,
            seconds(dwell_s),
            seconds(facts.time_s(stay.settled_last)),
            metres(stay.settled_m),
            list(p.as_slice()),
            list(away.as_slice()),
        );
        evidence.push(Evidence {
            value: Some(stay.settled_m),
            limit: Some(band.full),
            unit: "m".to_owned(),
            ..facts.evidence(message, "tcp".to_owned(), stay.settled_last)
        });
    }
    evidence.sort_by(|a, b| {
        let value = |e: &Evidence| e.value.unwrap_or(f64::INFINITY);
        value(b).total_cmp(&value(a))
    });
    let worst_of_all = (0..goals.len()).map(settled).fold(0.0, f64::max);
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: "greatest distance from a goal while it is held".to_owned(),
            value: worst_of_all.is_finite().then_some(worst_of_all),
            unit: "m".to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step: "Compare the joint angles you command with those your inverse kinematics gives for the goal, and hold them until the dwell is over.".to_owned(),
        curve: Some(curve(facts, band, check)),
    }
}

/// Distance from the goal that is next: the first until its stay ends, then the second, and so on.
fn curve(facts: &MotionFacts<'_>, band: Band, check: &str) -> Curve {
    let goals = &facts.motion.goals;
    let mut current = 0;
    let mut values = Vec::with_capacity(facts.trace.len());
    for tick in 0..facts.trace.len() {
        while current + 1 < goals.len()
            && facts
                .stays
                .get(current)
                .is_some_and(|stay| stay.last < tick)
        {
            current += 1;
        }
        values.push((facts.trace.tcp_position(tick) - goals[current].position_m).norm());
    }
    let marks = facts.stays.iter().enumerate().map(|(i, stay)| {
        let at = facts.time_s(stay.last);
        let number = i + 1;
        let words = match band.score(stay.settled_m) > 0.0 {
            true => format!("goal {number} held"),
            false => format!("best stay near goal {number} ends"),
        };
        (at, words)
    });
    Curve {
        check: check.to_owned(),
        title: "distance from the next goal".to_owned(),
        unit: "m".to_owned(),
        t_s: (0..facts.trace.len())
            .map(|tick| facts.time_s(tick))
            .collect(),
        values,
        full: Some(band.full),
        zero: Some(band.zero),
        marks: marks.collect(),
        step: None,
    }
}
