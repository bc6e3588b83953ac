//! path-coverage: the share of a path that the TCP passes, near enough and in order.
//!
//! Measured is, of the lengths that count of all segments together, what progress gains at places within `within_m`: see
//! [`super::road`].

use nalgebra::Vector3;

use super::road;
use super::{Finding, MotionFacts};
use crate::lab::watched::{PathToFollow, Shares};
use crate::record::grade::{Evidence, Measure};
use crate::record::quantity::{list, metres, with_unit};

/// Judges the check.
pub fn judge(
    facts: &MotionFacts<'_>,
    path: &PathToFollow,
    within_m: f64,
    shares: Shares,
) -> Finding {
    let trace = facts.trace;
    let p_tcp_m: Vec<Vector3<f64>> = (0..trace.len()).map(|k| trace.tcp_position(k)).collect();
    let driven = road::driven(&p_tcp_m, path).unwrap_or_default();
    let length_m: f64 = driven.iter().map(|segment| segment.length_m).sum();
    let passed_m = driven.iter().map(|segment| segment.passed_m(within_m));
    let passed_m: f64 = passed_m.sum();
    // round-off of a sum of thousands of steps
    let value = if passed_m >= length_m * (1.0 - 1e-9) {
        1.0
    } else {
        passed_m / length_m
    };
    let score = if driven.is_empty() {
        0.0
    } else {
        shares.score(value)
    };
    let mut evidence = Vec::new();
    for (i, segment) in driven.iter().enumerate() {
        let share = segment.passed_m(within_m) / segment.length_m;
        if score >= 1.0 || share >= 1.0 - 1e-9 {
            continue;
        }
        let [from, to] = [i, i + 1].map(|k| list(path.points_m[k].as_slice()));
        let message = format!(
            "of segment {} of the path `{}`, from {from} to {to}, {} is passed within {}",
            i + 1,
            path.name,
            with_unit(share, ""),
            metres(within_m)
        );
        let left = segment.places.last().map_or(0, |place| place.tick);
        evidence.push(Evidence {
            value: Some(share),
            limit: Some(shares.full),
            ..facts.evidence(message, "tcp".to_owned(), left)
        });
    }
    let share = |e: &Evidence| e.value.unwrap_or(0.0);
    evidence.sort_by(|a, b| share(a).total_cmp(&share(b)));
    evidence.truncate(3);
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: format!("share of the path passed within {}", metres(within_m)),
            value: (!driven.is_empty()).then_some(value),
            unit: String::new(),
            full: shares.full,
            zero: shares.zero,
        }),
        evidence,
        next_step: "Follow the path from its first point to its last.".to_owned(),
        curve: None,
    }
}
