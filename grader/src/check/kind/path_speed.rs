//! path-speed: how far the speed along a path is from the one that is asked for, in the worst segment \[a fraction of it, root mean
//! square\].
//!
//! On a segment with the direction `a`, the speed at tick `k` is `v[k] = (p[k] - p[k-1]) . a / h`: standing still is no speed, and going
//! back a negative one. With the wanted speed `w`,
//! `rms² = (Σ g[k] (v[k]/w - 1)² + left) / (Σ g[k] + left)`, `g[k] = max(|p[k] - p[k-1]|, w h)`,
//! over the ticks that count ([How a path is followed](#how-a-path-is-followed)): not within `trim` of either end. `left` is the length
//! that progress left out; it counts as an error of 1, as if the TCP stood there. A step weighs by the distance it covered or should
//! have covered, whichever is longer: so a rest costs what the distance it could have covered in that time would.

use std::ops::Range;

use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::number::{list, metres, seconds, trimmed};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use super::path_deviation::which;
use crate::check::contract::{CheckKind, FirstLoss, MotionCheck};
use crate::check::facts::MotionFacts;
use crate::check::finding::{Finding, curve};
use crate::check::reading::{InTask, NumberAt};
use crate::check::registry::MotionTable;
use crate::check::road::{self, Driven};
use crate::record::grade::Evidence;
use crate::record::graded::{Curve, StepBackdrop};
use crate::record::quantity::with_unit;
use crate::task::model::Band;
use crate::task::problem::LabError;
use crate::task::watched::PathToFollow;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// A path of `[tasks.motion.paths]`.
    #[schemars(with = "String")]
    path: Spanned<String>,
    /// The one segment that counts, from 1; the worst of all where it is left out.
    #[schemars(with = "Option<u64>")]
    segment: Option<Spanned<u64>>,
    /// The speed that is asked for \[m/s\].
    #[schemars(with = "f64")]
    speed_m_s: NumberAt,
    /// Relative error that earns all points.
    full: f64,
    /// Relative error that earns none.
    zero: f64,
}

impl MotionTable for Table {
    const NAME: &'static str = "path-speed";
    type Check = PathSpeed;

    fn read(&self, at: Range<usize>, reading: &InTask<'_>) -> Result<PathSpeed, LabError> {
        let path = reading.path(&self.path)?;
        Ok(PathSpeed {
            only: reading.segment(self.segment.as_ref(), &path)?,
            path,
            speed_m_s: reading.report.positive(&self.speed_m_s, "`speed_m_s`")?,
            band: reading.report.band(self.full, self.zero, at)?,
        })
    }
}

/// The check as read.
#[derive(Debug)]
pub(crate) struct PathSpeed {
    path: PathToFollow,
    /// The one segment that counts, from 0; the worst of all where there is none.
    only: Option<usize>,
    speed_m_s: f64,
    band: Band,
}

impl CheckKind for PathSpeed {
    fn band(&self, _: &Robot) -> Option<(Band, &'static str)> {
        Some((self.band, ""))
    }
}

/// How fast one segment was driven.
#[derive(Debug, Clone, PartialEq)]
struct Pace {
    /// Root mean square error, as a fraction of the wanted speed.
    rms: f64,
    /// Speeds along the segment at the ticks that count, in order \[m/s\].
    speeds: Vec<(usize, f64)>,
    /// Of the length that counts, what was never passed \[m\].
    left_out_m: f64,
}

impl Pace {
    fn of(
        p_tcp_m: &[Vector3<f64>],
        [from, to]: [Vector3<f64>; 2],
        driven: &Driven,
        speed_m_s: f64,
        step_s: f64,
    ) -> Self {
        let along = (to - from).normalize();
        let (mut sum, mut weights) = (driven.left_out_m, driven.left_out_m);
        let mut speeds = Vec::new();
        // at the first tick the segment is only begun
        for place in driven.places.iter().skip(1).filter(|place| place.counts) {
            let step = p_tcp_m[place.tick] - p_tcp_m[place.tick - 1];
            let speed = step.dot(&along) / step_s;
            let error = speed / speed_m_s - 1.0;
            let weight = step.norm().max(speed_m_s * step_s);
            sum += weight * error * error;
            weights += weight;
            speeds.push((place.tick, speed));
        }
        Self {
            rms: (sum / weights).sqrt(),
            speeds,
            left_out_m: driven.left_out_m,
        }
    }

    /// The tick and speed furthest from the wanted one.
    fn furthest(&self, speed_m_s: f64) -> Option<(usize, f64)> {
        let off = |(_, speed): &(usize, f64)| (speed - speed_m_s).abs();
        let furthest = self.speeds.iter();
        // of equal ones the first
        furthest
            .rev()
            .max_by(|a, b| off(a).total_cmp(&off(b)))
            .copied()
    }

    /// The mean over the time spent \[m/s\].
    fn mean_m_s(&self) -> Option<f64> {
        let sum: f64 = self.speeds.iter().map(|(_, speed)| speed).sum();
        (!self.speeds.is_empty()).then(|| sum / self.speeds.len() as f64)
    }
}

fn paces(p_tcp_m: &[Vector3<f64>], path: &PathToFollow, speed_m_s: f64, step_s: f64) -> Vec<Pace> {
    let driven = road::driven(p_tcp_m, path).unwrap_or_default();
    let ends = path.points_m.windows(2);
    ends.zip(&driven)
        .map(|(ends, driven)| Pace::of(p_tcp_m, [ends[0], ends[1]], driven, speed_m_s, step_s))
        .collect()
}

impl MotionCheck for PathSpeed {
    fn judge(&self, facts: &MotionFacts<'_>) -> Finding {
        let speed_m_s = self.speed_m_s;
        let paces = paces(&facts.p_tcp_m(), &self.path, speed_m_s, facts.trace.step_s);
        let counts = |i: usize| self.only.is_none_or(|only| only == i);
        let counted: Vec<(usize, &Pace)> = paces
            .iter()
            .enumerate()
            .filter(|(i, _)| counts(*i))
            .collect();
        let worst = counted.iter().map(|(_, pace)| pace.rms);
        // of the sizes, so that one that is no number is the worst
        let worst = worst.max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let value = worst.unwrap_or(f64::INFINITY);
        let mut lost = counted.clone();
        lost.retain(|(_, pace)| self.band.score(pace.rms) < 1.0);
        lost.sort_by(|a, b| b.1.rms.total_cmp(&a.1.rms));
        let evidence = lost.iter().take(3).map(|(i, pace)| Evidence {
            value: pace.rms.is_finite().then_some(pace.rms),
            limit: Some(self.band.full),
            ..told(facts, &self.path, *i, pace, speed_m_s)
        });
        let slowest = lost.first().and_then(|(_, pace)| pace.mean_m_s());
        let quantity = format!("error of the speed along the path, {}", which(self.only));
        Finding::against(self.band, value, "", quantity)
            .because(evidence.collect())
            .advise(match slowest {
                Some(mean) if mean < speed_m_s => {
                    "Go faster along the path: let the place asked for move on with the wanted speed, and do not wait at its points."
                }
                _ => {
                    "Move the place asked for along the path by the wanted speed times the control period, at every call."
                }
            })
            .drawn(self.curve(facts, &counted))
    }

    fn first_loss(&self) -> FirstLoss {
        FirstLoss::Evidence
    }
}

impl PathSpeed {
    /// The speed along the segments that count, with a gap between two of them.
    fn curve(&self, facts: &MotionFacts<'_>, counted: &[(usize, &Pace)]) -> Curve {
        let mut t_s = Vec::new();
        let mut values = Vec::new();
        let mut marks = Vec::new();
        for (i, pace) in counted {
            if let Some((first, _)) = pace.speeds.first() {
                marks.push((facts.time_s(*first), format!("segment {}", i + 1)));
                t_s.push(facts.time_s(*first));
                values.push(f64::NAN);
            }
            for (tick, speed) in &pace.speeds {
                t_s.push(facts.time_s(*tick));
                values.push(*speed);
            }
        }
        Curve {
            marks,
            step: Some(backdrop(self.speed_m_s, self.band)),
            ..curve("speed along the path", "m/s", t_s, values, None)
        }
    }
}

/// The wanted speed, and around it the errors that earn all points.
fn backdrop(speed_m_s: f64, band: Band) -> StepBackdrop {
    let percent = |share: f64| with_unit(100.0 * share, "%");
    let off_m_s = band.full * speed_m_s;
    let told = format!(
        "full points up to {} off (root mean square), none from {}",
        percent(band.full),
        percent(band.zero)
    );
    StepBackdrop {
        prediction: None,
        target: Some(speed_m_s),
        band: Some((speed_m_s - off_m_s, speed_m_s + off_m_s, told)),
    }
}

fn told(
    facts: &MotionFacts<'_>,
    path: &PathToFollow,
    i: usize,
    pace: &Pace,
    speed_m_s: f64,
) -> Evidence {
    let [from, to] = [i, i + 1].map(|k| list(path.points_m[k].as_slice()));
    let mut message = format!(
        "segment {} of the path `{}`, from {from} to {to}: the speed along it is {} off {} m/s (root mean square)",
        i + 1,
        path.name,
        with_unit(pace.rms, ""),
        trimmed(speed_m_s, 4),
    );
    let mut tick = facts.trace.len().saturating_sub(1);
    if let (Some(mean), Some((at, furthest))) = (pace.mean_m_s(), pace.furthest(speed_m_s)) {
        tick = at;
        message += &format!(
            "; its mean is {} m/s, the furthest from it {} m/s at {}",
            trimmed(mean, 4),
            trimmed(furthest, 4),
            seconds(facts.time_s(at)),
        );
    }
    if pace.left_out_m > 1e-3 {
        message += &format!("; {} are never passed", metres(pace.left_out_m));
    }
    facts.evidence(message, "tcp".to_owned(), tick)
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP_S: f64 = 0.001;

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

    /// Along the x axis with the speeds of `parts`, each for as long a way.
    fn drive(parts: &[(f64, f64)]) -> Vec<Vector3<f64>> {
        let mut x = 0.0;
        let mut road = vec![Vector3::zeros()];
        for (way_m, speed_m_s) in parts {
            let steps = (way_m / (speed_m_s * STEP_S)).abs().round() as usize;
            for _ in 0..steps {
                x += speed_m_s * STEP_S;
                road.push(Vector3::new(x, 0.0, 0.0));
            }
        }
        road
    }

    fn rms(road: &[Vector3<f64>], points: &[[f64; 2]], speed_m_s: f64) -> Vec<f64> {
        let paces = paces(road, &path(points), speed_m_s, STEP_S);
        paces.iter().map(|pace| pace.rms).collect()
    }

    const LINE: [[f64; 2]; 2] = [[0.0, 0.0], [1.0, 0.0]];

    fn close(value: f64, expected: f64, tolerance: f64) {
        assert!(
            (value - expected).abs() <= tolerance,
            "{value} for {expected}"
        );
    }

    #[test]
    fn a_steady_speed_is_as_far_off_as_it_is() {
        for (speed, expected) in [(0.25, 0.0), (0.125, 0.5), (0.5, 1.0), (0.275, 0.1)] {
            // no weight matters where every error is the same; at half the speed nothing is left out
            close(rms(&drive(&[(1.0, speed)]), &LINE, 0.25)[0], expected, 1e-9);
        }
    }

    #[test]
    fn haste_near_the_ends_does_not_count() {
        let road = drive(&[(0.04, 1.0), (0.92, 0.25), (0.04, 2.0)]);
        close(rms(&road, &LINE, 0.25)[0], 0.0, 1e-9);
    }

    #[test]
    fn half_of_the_way_at_twice_the_speed_is_half_of_the_squares() {
        let road = drive(&[(0.5, 0.25), (0.5, 0.5)]);
        // 0.45 m without error and 0.45 m with 1: steps of a quarter of a millimetre
        close(rms(&road, &LINE, 0.25)[0], 0.5_f64.sqrt(), 1e-3);
    }

    #[test]
    fn a_rest_costs_the_way_it_could_have_made() {
        let mut road = drive(&[(0.5, 0.25)]);
        let here = road[road.len() - 1];
        // 1.2 s at 0.25 m/s are 0.3 m
        road.extend(vec![here; 1200]);
        road.extend(drive(&[(0.5, 0.25)]).iter().skip(1).map(|p| here + p));
        close(rms(&road, &LINE, 0.25)[0], (0.3_f64 / 1.2).sqrt(), 1e-3);
    }

    #[test]
    fn what_is_never_passed_counts_as_standing() {
        // two thirds of the 0.9 m that count are driven
        let road = drive(&[(0.65, 0.25)]);
        close(rms(&road, &LINE, 0.25)[0], (1.0_f64 / 3.0).sqrt(), 1e-3);
        close(rms(&[Vector3::zeros(); 100], &LINE, 0.25)[0], 1.0, 1e-12);
    }

    #[test]
    fn going_back_is_worse_than_standing() {
        let road = drive(&[(0.6, 0.25), (0.2, -0.25), (0.6, 0.25)]);
        // 0.2 m with an error of -2, of 1.3 m
        close(
            rms(&road, &LINE, 0.25)[0],
            (4.0_f64 * 0.2 / 1.3).sqrt(),
            2e-3,
        );
    }

    #[test]
    fn each_segment_has_its_own_pace() {
        let mut road = drive(&[(1.0, 0.25)]);
        road.extend((1..=2000).map(|k| Vector3::new(1.0, 0.0005 * f64::from(k), 0.0)));
        let corner = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        let found = rms(&road, &corner, 0.25);
        close(found[0], 0.0, 1e-9);
        close(found[1], 1.0, 1e-9);
        let paces = paces(&road, &path(&corner), 0.25, STEP_S);
        close(paces[1].mean_m_s().unwrap(), 0.5, 1e-9);
    }

    #[test]
    fn a_place_that_is_no_number_has_no_pace() {
        let mut road = drive(&[(1.0, 0.25)]);
        road[100].x = f64::NAN;
        assert_eq!(rms(&road, &LINE, 0.25), Vec::<f64>::new());
    }
}
