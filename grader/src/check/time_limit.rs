//! time-limit: when a body fell, or when a path was over \[s\]; never, where that did not happen.
//!
//! A body has fallen at the tick of its first fall ([`kinemark_sim::watch`]), over whatever side. A path is over when the TCP has come
//! within `trim` of each of its points, in order, and then of the last: the earliest such tick ([`super::road`]).

use kinemark_sim::event::{Event, EventKind};
use nalgebra::Vector3;

use super::road;
use super::{Finding, MotionFacts};
use crate::lab::model::Band;
use crate::lab::watched::{PathToFollow, Until};
use crate::record::grade::{Evidence, Measure};
use crate::record::quantity::{list, metres, seconds};

/// The tick of the first fall of a body.
fn fell(events: &[Event], body: usize) -> Option<usize> {
    let falls = events.iter().filter(|event| {
        matches!(event.kind, EventKind::BodyFell { .. }) && event.kind.body() == Some(body)
    });
    falls.map(|event| event.tick as usize).min()
}

/// When a path was over, or why it was not.
#[derive(Debug, Clone, PartialEq)]
enum Over {
    At(usize),
    /// This point, counted from 0, was the one missed by most: how far off the TCP was, and when.
    Missed {
        point: usize,
        off_m: f64,
        tick: usize,
    },
    /// The TCP was at no numbers.
    Nowhere,
}

fn over(p_tcp_m: &[Vector3<f64>], path: &PathToFollow) -> Over {
    let Some(corners) = road::corners_of(p_tcp_m, path) else {
        return Over::Nowhere;
    };
    let all = corners.iter().enumerate();
    // of equal ones the first
    let missed = all
        .rev()
        .max_by(|a, b| a.1.gap_m.total_cmp(&b.1.gap_m))
        .filter(|(_, corner)| corner.gap_m > 0.0);
    match (missed, corners.last()) {
        (Some((point, corner)), _) => Over::Missed {
            point,
            off_m: corner.gap_m + path.trim_m,
            tick: corner.tick,
        },
        (None, Some(last)) => Over::At(last.tick),
        (None, None) => Over::Nowhere,
    }
}

/// Judges the check.
pub fn judge(facts: &MotionFacts<'_>, until: &Until, band: Band) -> Finding {
    let trace = facts.trace;
    let end = trace.len().saturating_sub(1);
    let (done, what, signal, never, never_tick, next_step) = match until {
        Until::Fall(body) => {
            let name = facts.names.body(*body);
            (
                fell(&trace.events, *body),
                format!("`{name}` falls"),
                format!("body {name}"),
                format!("`{name}` never fell, so there is no time to judge"),
                end,
                format!(
                    "Bring `{name}` down sooner: start at once, and go to it by a shorter way."
                ),
            )
        }
        Until::Path(path) => {
            let positions = (0..trace.len()).map(|k| trace.tcp_position(k));
            let p_tcp_m: Vec<Vector3<f64>> = positions.collect();
            let (done, never, tick) = match over(&p_tcp_m, path) {
                Over::At(tick) => (Some(tick), String::new(), end),
                Over::Missed { point, off_m, tick } => (
                    None,
                    format!(
                        "point {} of the path `{}`, at {}, was missed by {}, and counts from {}: the path was never finished",
                        point + 1,
                        path.name,
                        list(path.points_m[point].as_slice()),
                        metres(off_m),
                        metres(path.trim_m)
                    ),
                    tick,
                ),
                Over::Nowhere => (
                    None,
                    format!("the path `{}` was never finished", path.name),
                    end,
                ),
            };
            (
                done,
                format!("the path `{}` is over", path.name),
                "tcp".to_owned(),
                never,
                tick,
                "Go along the path faster, or begin it sooner.".to_owned(),
            )
        }
    };
    let value = done.map_or(f64::INFINITY, |tick| facts.time_s(tick));
    let score = band.score(value);
    let mut evidence = Vec::new();
    match done {
        Some(tick) if score < 1.0 => {
            let message = format!(
                "{what} at {}, up to {} earns everything",
                seconds(value),
                seconds(band.full)
            );
            evidence.push(Evidence {
                value: Some(value),
                limit: Some(band.full),
                unit: "s".to_owned(),
                ..facts.evidence(message, signal, tick)
            });
        }
        Some(_) => {}
        None => evidence.push(facts.evidence(never, signal, never_tick)),
    }
    Finding {
        insists: false,
        score,
        measure: Some(Measure {
            quantity: format!("time until {what}"),
            value: value.is_finite().then_some(value),
            unit: "s".to_owned(),
            full: band.full,
            zero: band.zero,
        }),
        evidence,
        next_step,
        curve: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn event(tick: u64, kind: EventKind) -> Event {
        Event { tick, kind }
    }

    #[test]
    fn the_first_fall_of_that_body_counts() {
        let fall = |body| EventKind::BodyFell { body, side: None };
        let events = [
            event(100, EventKind::Moved { body: 1 }),
            event(150, fall(0)),
            event(200, fall(1)),
            event(900, fall(1)),
        ];
        assert_eq!(fell(&events, 1), Some(200));
        assert_eq!(fell(&events, 0), Some(150));
        assert_eq!(fell(&events, 2), None);
    }

    fn path(points: &[[f64; 2]]) -> PathToFollow {
        PathToFollow {
            name: "line".to_owned(),
            points_m: points
                .iter()
                .map(|[x, y]| Vector3::new(*x, *y, 0.0))
                .collect(),
            trim_m: 0.05,
        }
    }

    /// Through `points` in 100 steps each.
    fn road(points: &[[f64; 2]]) -> Vec<Vector3<f64>> {
        let ends = path(points).points_m;
        let mut road = vec![ends[0]];
        for ends in ends.windows(2) {
            road.extend((1..=100).map(|k| ends[0] + (ends[1] - ends[0]) * (f64::from(k) / 100.0)));
        }
        road
    }

    const CORNER: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];

    #[test]
    fn a_path_is_over_within_trim_of_its_last_point() {
        // steps of 10 mm: the 95th of the second segment is 50 mm from its end, give or take round-off
        let Over::At(tick) = over(&road(&CORNER), &path(&CORNER)) else {
            panic!("not over");
        };
        assert!((195..=196).contains(&tick), "{tick}");
        // what comes after does not count
        let mut longer = road(&CORNER);
        longer.extend(road(&[[1.0, 1.0], [0.0, 0.0], [1.0, 1.0]]));
        assert_eq!(over(&longer, &path(&CORNER)), Over::At(tick));
    }

    #[test]
    fn who_cuts_a_corner_or_stands_never_ends() {
        let found = over(&road(&[[0.0, 0.0], [1.0, 1.0]]), &path(&CORNER));
        let Over::Missed { point, off_m, .. } = found else {
            panic!("{found:?}");
        };
        assert_eq!(point, 1);
        // the straight way passes the corner at half a diagonal
        assert!((off_m - 0.5_f64.sqrt()).abs() < 1e-3, "{off_m}");
        // at the only point of a round trip that is easy to reach
        let round = path(&[[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]);
        let standing = over(&[Vector3::zeros(); 50], &round);
        assert!(matches!(standing, Over::Missed { point: 1, .. }));
        assert_eq!(over(&[], &round), Over::Nowhere);
        assert_eq!(over(&[Vector3::repeat(f64::NAN)], &round), Over::Nowhere);
    }
}
