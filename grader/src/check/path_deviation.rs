//! path-deviation: how far the TCP is from a path of straight segments, in the worst of them \[m, root mean square\].
//!
//! The formula is that of [`super::road`]: along the road, so that speed does not count, with progress that never goes back; what is
//! never passed counts with its distance.

use nalgebra::Vector3;

use super::road::{self, Driven};
use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::lab::watched::PathToFollow;
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::{list, metres, seconds};

/// Judges the check.
pub fn judge(
    facts: &MotionFacts<'_>,
    path: &PathToFollow,
    only: Option<usize>,
    band: Band,
    check: &str,
) -> Finding {
    let trace = facts.trace;
    let p_tcp_m: Vec<Vector3<f64>> = (0..trace.len()).map(|k| trace.tcp_position(k)).collect();
    let driven = road::driven(&p_tcp_m, path).unwrap_or_default();
    let counts = |i: usize| only.is_none_or(|only| only == i);
    let segments = driven.iter().enumerate().filter(|(i, _)| counts(*i));
    let worst = segments.clone().map(|(_, segment)| segment.rms_m);
    // of the sizes, so that one that is no number is the worst
    let worst = worst.max_by(|a, b| a.abs().total_cmp(&b.abs()));
    let value = worst.unwrap_or(f64::INFINITY);
    let score = band.score(value);
    let mut lost: Vec<(usize, &Driven)> = segments.collect();
    lost.retain(|(_, segment)| band.score(segment.rms_m) < 1.0);
    lost.sort_by(|a, b| b.1.rms_m.total_cmp(&a.1.rms_m));
    let evidence = lost.iter().take(3).map(|(i, segment)| Evidence {
        value: Some(segment.rms_m),
        limit: Some(band.full),
        unit: "m".to_owned(),
        ..told(facts, path, *i, segment)
    });
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: format!("distance from the path, {}", which(only)),
            value: value.is_finite().then_some(value),
            unit: "m".to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence: evidence.collect(),
        next_step: "Lead the TCP along each segment to its end before the next one, and correct what it is aside.".to_owned(),
        curve: curve(facts, path, &driven, only, band, check),
    }
}

/// Which segment a measure of a path is of.
pub(super) fn which(only: Option<usize>) -> String {
    only.map_or_else(
        || "in its worst segment".to_owned(),
        |segment| format!("in its segment {}", segment + 1),
    )
}

fn told(facts: &MotionFacts<'_>, path: &PathToFollow, i: usize, segment: &Driven) -> Evidence {
    let [from, to] = [i, i + 1].map(|k| list(path.points_m[k].as_slice()));
    let mut message = format!(
        "segment {} of the path `{}`, from {from} to {to}: {} off (root mean square along the path travelled)",
        i + 1,
        path.name,
        metres(segment.rms_m),
    );
    let mut tick = segment.places.last().map_or(0, |place| place.tick);
    if let Some(furthest) = segment.furthest() {
        tick = furthest.tick;
        let at = seconds(facts.time_s(tick));
        // behind rather than beside: 0.7 is half in squares
        message += &if furthest.back_m > 0.7 * furthest.aside_m {
            format!("; at {at} it has gone back by {}", metres(furthest.back_m))
        } else {
            format!("; the furthest is {} at {at}", metres(furthest.aside_m))
        };
    }
    if segment.left_out_m > 1e-3 {
        message += &format!(
            "; {} of {} are never passed",
            metres(segment.left_out_m),
            metres(segment.length_m)
        );
    }
    facts.evidence(message, "tcp".to_owned(), tick)
}

/// The moment at which the TCP was nearest to a point of the path in its turn, with words that say no more than that where it was not
/// within the band.
fn point(
    facts: &MotionFacts<'_>,
    path: &PathToFollow,
    i: usize,
    tick: usize,
    band: Band,
) -> (f64, String) {
    let number = i + 1;
    let away_m = path.points_m.get(i).map_or(f64::INFINITY, |point| {
        (facts.trace.tcp_position(tick) - point).norm()
    });
    let words = match away_m <= path.trim_m + band.zero {
        true => format!("point {number}"),
        false => format!("nearest to point {number}"),
    };
    (facts.time_s(tick), words)
}

/// Distance aside while the path is driven; near the corners, where it does not count, there are gaps.
fn curve(
    facts: &MotionFacts<'_>,
    path: &PathToFollow,
    driven: &[Driven],
    only: Option<usize>,
    band: Band,
    check: &str,
) -> Option<Curve> {
    let mut t_s = Vec::new();
    let mut values = Vec::new();
    let mut marks = Vec::new();
    for (i, segment) in driven.iter().enumerate() {
        let begun = segment.places.first()?;
        marks.push(point(facts, path, i, begun.tick, band));
        for place in &segment.places {
            t_s.push(facts.time_s(place.tick));
            values.push(if place.counts && only.is_none_or(|only| only == i) {
                place.aside_m
            } else {
                f64::NAN
            });
        }
    }
    let left = driven.last()?.places.last()?;
    marks.push(point(facts, path, driven.len(), left.tick, band));
    Some(Curve {
        check: check.to_owned(),
        title: "distance from the path".to_owned(),
        unit: "m".to_owned(),
        t_s,
        values,
        full: Some(band.full),
        zero: Some(band.zero),
        marks,
        step: None,
    })
}
