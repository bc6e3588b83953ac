//! path-speed: how far the speed along a path is from the one that is asked for, in the worst segment \[a fraction of it, root mean
//! square\].
//!
//! On a segment with the direction `a`, the speed at tick `k` is `v[k] = (p[k] - p[k-1]) . a / h`: standing still is no speed, and going
//! back a negative one. With the wanted speed `w`,
//! `rms² = (Σ g[k] (v[k]/w - 1)² + left) / (Σ g[k] + left)`, `g[k] = max(|p[k] - p[k-1]|, w h)`,
//! over the ticks that count ([How a path is followed](#how-a-path-is-followed)): not within `trim` of either end. `left` is the length
//! that progress left out; it counts as an error of 1, as if the TCP stood there. A step weighs by the distance it covered or should
//! have covered, whichever is longer: so a rest costs what the distance it could have covered in that time would.

use nalgebra::Vector3;

use crate::check::path_following::{FollowedSegment, followed};
use crate::check::prelude::*;
use crate::check::segments::{Segments, segment_name};
use crate::record::graded::StepBackdrop;
use crate::task::watched::PathToFollow;

/// Share of the wanted speed below which the TCP stands still.
const RESTS: f64 = 0.05;
/// A shorter rest is a turn \[s\].
const SHORT_REST_S: f64 = 0.2;

/// The keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Table {
    /// A path of `[tasks.motion.paths]`.
    path: At<String>,
    /// The one segment that counts, from 1; the worst of all where it is left out.
    segment: Option<At<u64>>,
    /// The speed that is asked for \[m/s\].
    speed_m_s: At<f64>,
    /// Relative error that earns all points.
    full: BandEnd,
    /// Relative error that earns none.
    zero: BandEnd,
}

impl MotionTable for Table {
    const NAME: &'static str = "path-speed";
    type Check = InBand<PathSpeed>;

    fn read(&self, reading: &MotionReading<'_>) -> Result<Self::Check, LabError> {
        let measure = PathSpeed {
            segments: Segments::read(reading, &self.path, self.segment.as_ref())?,
            speed_m_s: reading.report.positive(&self.speed_m_s, "`speed_m_s`")?,
        };
        reading.in_band([self.full, self.zero], "", measure)
    }
}

/// The error of the speed along the path, in the worst of these segments.
#[derive(Debug)]
pub(crate) struct PathSpeed {
    segments: Segments,
    /// The speed that is asked for.
    speed_m_s: f64,
}

/// How fast one segment was followed.
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
        followed: &FollowedSegment,
        speed_m_s: f64,
        step_s: f64,
    ) -> Self {
        let along = (to - from).normalize();
        let (mut sum, mut weights) = (followed.left_out_m, followed.left_out_m);
        let mut speeds = Vec::new();
        // at the first tick the segment is only begun
        for sample in followed
            .samples
            .iter()
            .skip(1)
            .filter(|sample| sample.counts)
        {
            let step = p_tcp_m[sample.tick] - p_tcp_m[sample.tick - 1];
            let speed = step.dot(&along) / step_s;
            let error = speed / speed_m_s - 1.0;
            let weight = step.norm().max(speed_m_s * step_s);
            sum += weight * error * error;
            weights += weight;
            speeds.push((sample.tick, speed));
        }
        Self {
            rms: (sum / weights).sqrt(),
            speeds,
            left_out_m: followed.left_out_m,
        }
    }

    /// The tick and speed furthest from the wanted one.
    fn furthest(&self, speed_m_s: f64) -> Option<(usize, f64)> {
        let off = |(_, speed): &(usize, f64)| (speed - speed_m_s).abs();
        let (index, _) = greatest(self.speeds.iter().map(off))?;
        Some(self.speeds[index])
    }

    /// The first and last tick of the longest stretch in which it hardly goes on.
    fn longest_rest(&self, speed_m_s: f64) -> Option<[usize; 2]> {
        let rests = self
            .speeds
            .chunk_by(|a, b| a.0 + 1 == b.0 && rests(a.1, speed_m_s) == rests(b.1, speed_m_s))
            .filter(|stretch| rests(stretch[0].1, speed_m_s));
        let longest = rests.max_by_key(|stretch| stretch.len())?;
        Some([longest[0].0, longest[longest.len() - 1].0])
    }

    /// The mean over the time spent \[m/s\].
    fn mean_m_s(&self) -> Option<f64> {
        let sum: f64 = self.speeds.iter().map(|(_, speed)| speed).sum();
        (!self.speeds.is_empty()).then(|| sum / self.speeds.len() as f64)
    }
}

/// Whether a speed is hardly one, compared with what was asked for.
fn rests(speed: f64, speed_m_s: f64) -> bool {
    speed.abs() < RESTS * speed_m_s
}

fn paces(p_tcp_m: &[Vector3<f64>], path: &PathToFollow, speed_m_s: f64, step_s: f64) -> Vec<Pace> {
    let followed = followed(p_tcp_m, path).unwrap_or_default();
    let ends = path.points_m.windows(2);
    ends.zip(&followed)
        .map(|(ends, followed)| Pace::of(p_tcp_m, [ends[0], ends[1]], followed, speed_m_s, step_s))
        .collect()
}

impl RunMeasure for PathSpeed {
    fn judge(&self, facts: &MotionFacts<'_>, band: Band) -> Finding {
        let (segments, speed_m_s) = (&self.segments, self.speed_m_s);
        let p_tcp_m = facts.p_tcp_m();
        let paces = paces(&p_tcp_m, &segments.path, speed_m_s, facts.trace.step_s);
        let rms = |pace: &Pace| pace.rms;
        let lost = segments.lost(&paces, rms, band);
        let evidence = lost.iter().map(|(i, pace)| Evidence {
            value: pace.rms.is_finite().then_some(pace.rms),
            limit: Some(band.full),
            ..self.evidence(facts, *i, pace)
        });
        let slowest = lost.first().and_then(|(_, pace)| pace.mean_m_s());
        let value = segments.worst(&paces, rms);
        let quantity = format!("error of the speed along the path, {}", segments.which());
        Finding::against(band, value, "", quantity)
            .because(evidence.collect())
            .advise(match slowest {
                Some(mean) if mean < speed_m_s => {
                    "Go faster along the path: let the place asked for move on with the wanted speed, and do not wait at its points."
                }
                _ => {
                    "Move the place asked for along the path by the wanted speed times the control period, at every call."
                }
            })
            .drawn(self.curve(facts, &paces, band))
    }
}

impl PathSpeed {
    /// How fast segment `i` was followed.
    fn evidence(&self, facts: &MotionFacts<'_>, i: usize, pace: &Pace) -> Evidence {
        let mut message = format!(
            "{}: the speed along it is {} off {} m/s (root mean square)",
            segment_name(&self.segments.path, i),
            with_unit(pace.rms, ""),
            trimmed(self.speed_m_s, 4),
        );
        let mut tick = facts.last_tick();
        if let (Some(mean), Some((at, furthest))) = (pace.mean_m_s(), pace.furthest(self.speed_m_s))
        {
            tick = at;
            message += &format!(
                "; its mean is {} m/s, and at {} it is {} m/s",
                trimmed(mean, 4),
                seconds(facts.time_s(at)),
                trimmed(furthest, 4),
            );
        }
        if let Some([from, to]) = pace.longest_rest(self.speed_m_s) {
            let [from, to] = [from, to].map(|tick| facts.time_s(tick));
            if to - from > SHORT_REST_S {
                message += &format!(
                    "; it stands still from {} to {}",
                    seconds(from),
                    seconds(to)
                );
            }
        }
        if pace.left_out_m > 1e-3 {
            message += &format!("; {} are never covered", metres(pace.left_out_m));
        }
        facts.evidence(message, "tcp".to_owned(), tick)
    }

    /// The speed along the segments that count, with a gap between two of them.
    fn curve(&self, facts: &MotionFacts<'_>, paces: &[Pace], band: Band) -> Curve {
        let mut t_s = Vec::new();
        let mut values = Vec::new();
        let mut marks = Vec::new();
        let all = paces.iter().enumerate();
        for (i, pace) in all.filter(|(i, _)| self.segments.counts(*i)) {
            if let Some((first, _)) = pace.speeds.first() {
                marks.push((facts.time_s(*first), format!("segment {}", i + 1)));
                t_s.push(facts.time_s(*first));
                values.push(f64::NAN);
            }
            t_s.extend(pace.speeds.iter().map(|(tick, _)| facts.time_s(*tick)));
            values.extend(pace.speeds.iter().map(|(_, speed)| speed));
        }
        Curve {
            marks,
            step: Some(backdrop(self.speed_m_s, band)),
            ..curve("speed along the path", "m/s", t_s, values, None)
        }
    }
}

/// The wanted speed, and around it the errors that earn all points.
fn backdrop(speed_m_s: f64, band: Band) -> StepBackdrop {
    let percent = |share: f64| with_unit(share, "");
    let off_m_s = band.full * speed_m_s;
    let words = format!(
        "full points up to {} off (root mean square), none from {}",
        percent(band.full),
        percent(band.zero)
    );
    StepBackdrop {
        prediction: None,
        target: Some(speed_m_s),
        band: Some((speed_m_s - off_m_s, speed_m_s + off_m_s, words)),
    }
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
        let mut track = vec![Vector3::zeros()];
        for (way_m, speed_m_s) in parts {
            let steps = (way_m / (speed_m_s * STEP_S)).abs().round() as usize;
            for _ in 0..steps {
                x += speed_m_s * STEP_S;
                track.push(Vector3::new(x, 0.0, 0.0));
            }
        }
        track
    }

    fn rms(track: &[Vector3<f64>], points: &[[f64; 2]], speed_m_s: f64) -> Vec<f64> {
        let paces = paces(track, &path(points), speed_m_s, STEP_S);
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
    fn a_rest_on_the_way_is_found() {
        let mut track = drive(&[(0.5, 0.25)]);
        let here = *track.last().expect("a place");
        track.extend(std::iter::repeat_n(here, 600));
        track.extend(drive(&[(0.5, 0.25)]).iter().skip(1).map(|p| p + here));
        let paces = paces(&track, &path(&LINE), 0.25, STEP_S);
        // 2000 steps to the middle
        assert_eq!(paces[0].longest_rest(0.25), Some([2001, 2600]));
        assert_eq!(
            paces[0].longest_rest(0.25).map(|[a, b]| b - a + 1),
            Some(600)
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
        let track = drive(&[(0.04, 1.0), (0.92, 0.25), (0.04, 2.0)]);
        close(rms(&track, &LINE, 0.25)[0], 0.0, 1e-9);
    }

    #[test]
    fn half_of_the_way_at_twice_the_speed_is_half_of_the_squares() {
        let track = drive(&[(0.5, 0.25), (0.5, 0.5)]);
        // 0.45 m without error and 0.45 m with 1: steps of a quarter of a millimetre
        close(rms(&track, &LINE, 0.25)[0], 0.5_f64.sqrt(), 1e-3);
    }

    #[test]
    fn a_rest_costs_the_way_it_could_have_made() {
        let mut track = drive(&[(0.5, 0.25)]);
        let here = track[track.len() - 1];
        // 1.2 s at 0.25 m/s are 0.3 m
        track.extend(vec![here; 1200]);
        track.extend(drive(&[(0.5, 0.25)]).iter().skip(1).map(|p| here + p));
        close(rms(&track, &LINE, 0.25)[0], (0.3_f64 / 1.2).sqrt(), 1e-3);
    }

    #[test]
    fn what_is_never_passed_counts_as_standing() {
        // two thirds of the 0.9 m that count are driven
        let track = drive(&[(0.65, 0.25)]);
        close(rms(&track, &LINE, 0.25)[0], (1.0_f64 / 3.0).sqrt(), 1e-3);
        close(rms(&[Vector3::zeros(); 100], &LINE, 0.25)[0], 1.0, 1e-12);
    }

    #[test]
    fn going_back_is_worse_than_standing() {
        let track = drive(&[(0.6, 0.25), (0.2, -0.25), (0.6, 0.25)]);
        // 0.2 m with an error of -2, of 1.3 m
        close(
            rms(&track, &LINE, 0.25)[0],
            (4.0_f64 * 0.2 / 1.3).sqrt(),
            2e-3,
        );
    }

    #[test]
    fn each_segment_has_its_own_pace() {
        let mut track = drive(&[(1.0, 0.25)]);
        track.extend((1..=2000).map(|k| Vector3::new(1.0, 0.0005 * f64::from(k), 0.0)));
        let corner = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        let found = rms(&track, &corner, 0.25);
        close(found[0], 0.0, 1e-9);
        close(found[1], 1.0, 1e-9);
        let paces = paces(&track, &path(&corner), 0.25, STEP_S);
        close(paces[1].mean_m_s().unwrap(), 0.5, 1e-9);
    }

    #[test]
    fn a_place_that_is_no_number_has_no_pace() {
        let mut track = drive(&[(1.0, 0.25)]);
        track[100].x = f64::NAN;
        assert_eq!(rms(&track, &LINE, 0.25), Vec::<f64>::new());
    }
}
