//! time-limit: when a body fell, or when a path was over \[s\]; never, where that did not happen.
//!
//! A body has fallen at the tick of its first fall, over whatever side. A path is over when the TCP has come within `trim` of each of
//! its points, in order, and then of the last: the earliest such tick. For goals, use `finish-time`.

use kinemark_sim::watch::event::{Event, EventKind};
use nalgebra::Vector3;

use crate::check::path_following::passages;
use crate::check::prelude::*;
use crate::task::watched::PathToFollow;

/// What ends the time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum UntilName {
    Fall,
    Path,
}

problems! {
    /// A time limit that waits for nothing, or for two things.
    enum EndProblem {
        NotOneEnd { wanted: &'static str, example: &'static str }:
            "lab::time_limit", "this time limit needs `{wanted}` and nothing else to wait for", "this check",
            format!("write `{example}`");
    }
}

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// What ends the time: `fall` (of `body`) or `path` (the end of `path`).
    until: UntilName,
    /// A dynamic body of the scene.
    body: Option<At<String>>,
    /// A path of `[tasks.motion.paths]`.
    path: Option<At<String>>,
    /// Whether more is better: then all points from `full` on, and none up to `zero`; false where it is left out.
    #[serde(default)]
    at_least: bool,
    /// Time that earns all points \[s\].
    full_s: BandEnd,
    /// Time that earns none \[s\].
    zero_s: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "time-limit";
    type Check = InBand<TimeLimit>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let until = match (self.until, &self.body, &self.path) {
            (UntilName::Fall, Some(body), None) => {
                TimeLimit::Fall(reading.free_body(reading.scene(Self::NAME)?, body)?)
            }
            (UntilName::Path, None, Some(path)) => TimeLimit::Path(reading.path(path)?),
            (until, body, path) => {
                let (wanted, other, example) = match until {
                    UntilName::Fall => ("body", path, "until = \"fall\", body = \"can\""),
                    UntilName::Path => ("path", body, "until = \"path\", path = \"line\""),
                };
                let problem = EndProblem::NotOneEnd { wanted, example };
                return match other {
                    Some(other) => reading.refuse_at(other, problem),
                    None => reading.refuse(problem),
                };
            }
        };
        reading.in_band_either(self.at_least, [self.full_s, self.zero_s], "s", until)
    }
}

/// What ends the time.
#[derive(Debug)]
pub(crate) enum TimeLimit {
    /// The body of this index in the scene falls.
    Fall(usize),
    /// The TCP is at the last point of a path.
    Path(PathToFollow),
}

/// The tick of the first fall of a body.
pub(super) fn fell(events: &[Event], body: usize) -> Option<usize> {
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
    let passages = passages(p_tcp_m, path).unwrap_or_default();
    let Some(last) = passages.last() else {
        return Over::Nowhere;
    };
    match greatest(passages.iter().map(|passage| passage.gap_m)) {
        Some((point, gap_m)) if gap_m > 0.0 => Over::Missed {
            point,
            off_m: gap_m + path.trim_m,
            tick: passages[point].tick,
        },
        _ => Over::At(last.tick),
    }
}

/// What a time limit waits for, and whether it happened.
struct End {
    /// What, such as `` `can` falls ``.
    what: String,
    /// The signal it shows in.
    signal: String,
    /// The tick, or why it never happened and where that shows.
    done: Result<usize, (String, usize)>,
    next_step: String,
}

fn end_of_fall(facts: &MotionFacts<'_>, body: usize) -> End {
    let name = facts.names.body(body);
    let never = format!("`{name}` never fell, so there is no time to judge");
    End {
        what: format!("`{name}` falls"),
        signal: format!("body {name}"),
        done: fell(&facts.trace.events, body).ok_or((never, facts.last_tick())),
        next_step: format!(
            "Bring `{name}` down sooner: start at once, and go to it by a shorter way."
        ),
    }
}

fn end_of_path(facts: &MotionFacts<'_>, path: &PathToFollow) -> End {
    let name = &path.name;
    let done = match over(&facts.p_tcp_m(), path) {
        Over::At(tick) => Ok(tick),
        Over::Missed { point, off_m, tick } => {
            let message = format!(
                "point {} of the path `{name}`, at {}, was missed by {}, and counts from {}: the path was never finished",
                point + 1,
                list(path.points_m[point].as_slice()),
                metres(off_m),
                metres(path.trim_m)
            );
            Err((message, tick))
        }
        Over::Nowhere => {
            let message = format!("the path `{name}` was never finished");
            Err((message, facts.last_tick()))
        }
    };
    End {
        what: format!("the path `{name}` is over"),
        signal: "tcp".to_owned(),
        done,
        next_step: "Go along the path faster, or begin it sooner.".to_owned(),
    }
}

impl RunMeasure for TimeLimit {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let end = match self {
            Self::Fall(body) => end_of_fall(facts, *body),
            Self::Path(path) => end_of_path(facts, path),
        };
        let End { what, signal, .. } = end;
        let value = match &end.done {
            Ok(tick) => facts.time_s(*tick),
            Err(_) => f64::INFINITY,
        };
        let quantity = format!("time until {what}");
        let finding = Finding::against(band, value, "s", quantity).advise(end.next_step);
        match end.done {
            Ok(tick) => finding.shown_at(facts, || {
                let message = format!(
                    "{what} at {}, up to {} earns everything",
                    seconds(value),
                    seconds(band.full)
                );
                (message, signal, tick)
            }),
            Err((never, tick)) => finding.with(facts.evidence(never, signal, tick)),
        }
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
    fn through(points: &[[f64; 2]]) -> Vec<Vector3<f64>> {
        let ends = path(points).points_m;
        let mut track = vec![ends[0]];
        for ends in ends.windows(2) {
            track.extend((1..=100).map(|k| ends[0] + (ends[1] - ends[0]) * (f64::from(k) / 100.0)));
        }
        track
    }

    const CORNER: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];

    #[test]
    fn a_path_is_over_within_trim_of_its_last_point() {
        // steps of 10 mm: the 95th of the second segment is 50 mm from its end, give or take round-off
        let Over::At(tick) = over(&through(&CORNER), &path(&CORNER)) else {
            panic!("not over");
        };
        assert!((195..=196).contains(&tick), "{tick}");
        // what comes after does not count
        let mut longer = through(&CORNER);
        longer.extend(through(&[[1.0, 1.0], [0.0, 0.0], [1.0, 1.0]]));
        assert_eq!(over(&longer, &path(&CORNER)), Over::At(tick));
    }

    #[test]
    fn who_cuts_a_corner_or_stands_never_ends() {
        let found = over(&through(&[[0.0, 0.0], [1.0, 1.0]]), &path(&CORNER));
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
