//! Path following: how the TCP went along a path of straight segments, whatever its speed.
//!
//! **Passages.** Each point of the path gets a tick, in order, so that `Σ max(0, |p[t_i] - P_i| - trim)²` is least; of choices that are
//! equal the earliest. So following begins when the TCP first comes within `trim` of the first point, and ends when, after the other
//! points, it first comes within `trim` of the last; what went before and comes after does not count. Segment `i` is followed between
//! the ticks of its two ends.
//!
//! **Progress** along a segment is the greatest projection of the TCP onto it so far, `m[k] = max(m[k-1], u[k])`: it never goes back.
//! **Deviation** is the distance of the TCP from the point at its progress: across the segment, and back along it.
//!
//! The **root mean square deviation** is taken along the distance travelled, so that neither haste nor waiting changes it:
//! `rms² = (Σ d[k]² |p[k] - p[k-1]| + ∫ |P(s) - p|² ds) / (Σ |p[k] - p[k-1]| + ∫ ds)`. The sums leave out ticks within `trim` of
//! either end of the segment; the integrals are over what progress left out of `[trim, L - trim]`, from the TCP where the segment was
//! begun or left.

use nalgebra::Vector3;

use crate::task::watched::PathToFollow;

/// One segment as it was followed.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FollowedSegment {
    /// Length that counts: without what is cut off its ends \[m\].
    pub(super) length_m: f64,
    /// Root mean square deviation along the distance travelled \[m\].
    pub(super) rms_m: f64,
    /// Of the length that counts, what progress left out \[m\].
    pub(super) left_out_m: f64,
    /// From the tick at which it was begun to the one at which it was left; at least one.
    pub(super) samples: Vec<Sample>,
}

/// Where the TCP was on a segment at a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sample {
    /// The tick.
    pub(super) tick: usize,
    /// Progress within the length that counts, from 0 to it \[m\].
    pub(super) progress_m: f64,
    /// Distance from the point at its progress \[m\].
    pub(super) deviation_m: f64,
    /// How far behind its progress the TCP is \[m\].
    pub(super) back_m: f64,
    /// Whether it is not within what is cut off the ends.
    pub(super) counts: bool,
}

impl FollowedSegment {
    /// The sample with the greatest deviation of those that count.
    pub(super) fn furthest(&self) -> Option<&Sample> {
        let samples = self.samples.iter().filter(|sample| sample.counts);
        samples.max_by(|a, b| a.deviation_m.total_cmp(&b.deviation_m))
    }

    /// The longest stretch of the length that counts that was not passed within `within_m`: its two ends \[m\], and the tick in its
    /// middle; of equal ones the first. What was left out before the first sample and after the last one counts, too.
    pub(super) fn longest_gap(&self, within_m: f64) -> Option<([f64; 2], usize)> {
        let first = self.samples.first()?;
        let last = self.samples.last()?;
        let mut gaps = vec![([0.0, first.progress_m], [first.tick; 2])];
        for step in self.samples.windows(2) {
            let [before, after] = [step[0], step[1]];
            if after.deviation_m <= within_m {
                continue;
            }
            match gaps.last_mut() {
                Some((ends, ticks)) if ends[1] >= before.progress_m => {
                    (ends[1], ticks[1]) = (after.progress_m, after.tick);
                }
                _ => gaps.push((
                    [before.progress_m, after.progress_m],
                    [before.tick, after.tick],
                )),
            }
        }
        match gaps.last_mut() {
            Some((ends, _)) if ends[1] >= last.progress_m => ends[1] = self.length_m,
            _ => gaps.push(([last.progress_m, self.length_m], [last.tick; 2])),
        }
        let length = |ends: &[f64; 2]| ends[1] - ends[0];
        let mut longest: Option<([f64; 2], [usize; 2])> = None;
        for gap in gaps {
            if longest.is_none_or(|known| length(&gap.0) > length(&known.0)) {
                longest = Some(gap);
            }
        }
        let (ends, [from, to]) = longest.filter(|(ends, _)| length(ends) > 0.0)?;
        Some((ends, usize::midpoint(from, to)))
    }

    /// Of the length that counts, what was passed within `within_m` \[m\].
    pub(super) fn passed_m(&self, within_m: f64) -> f64 {
        let steps = self.samples.windows(2);
        let near = steps.filter(|step| step[1].deviation_m <= within_m);
        near.map(|step| step[1].progress_m - step[0].progress_m)
            .sum()
    }
}

/// How the TCP, at `p_tcp_m` tick by tick, went along `path`, segment by segment; none where it was nowhere, or at no numbers.
pub(super) fn followed(
    p_tcp_m: &[Vector3<f64>],
    path: &PathToFollow,
) -> Option<Vec<FollowedSegment>> {
    let passages = passages(p_tcp_m, path)?;
    let ends = path.points_m.windows(2).zip(passages.windows(2));
    let segments = ends.map(|(ends, passages)| {
        let (first, last) = (passages[0].tick, passages[1].tick);
        segment(
            &p_tcp_m[first..=last],
            first,
            [ends[0], ends[1]],
            path.trim_m,
        )
    });
    Some(segments.collect())
}

/// Where the TCP came nearest to a point of a path, in its turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Passage {
    /// The tick.
    pub(super) tick: usize,
    /// How far outside `trim` of the point the TCP is there \[m\]; 0 where it came as near as that.
    pub(super) gap_m: f64,
}

/// Where the TCP, at `p_tcp_m` tick by tick, came to each point of `path` in order; none where it was nowhere, or at no numbers.
pub(super) fn passages(p_tcp_m: &[Vector3<f64>], path: &PathToFollow) -> Option<Vec<Passage>> {
    let are_numbers = p_tcp_m.iter().all(|p| p.iter().all(|x| x.is_finite()));
    let last_tick = p_tcp_m.len().checked_sub(1).filter(|_| are_numbers)?;
    let gap_m =
        |p: &Vector3<f64>, point: &Vector3<f64>| ((p - point).norm() - path.trim_m).max(0.0);
    // least cost of the points so far, the last of them at or before a tick; and where that one is
    let mut before = vec![0.0; p_tcp_m.len()];
    let mut choices: Vec<Vec<usize>> = Vec::new();
    for point in &path.points_m {
        let (mut least, mut at) = (f64::INFINITY, 0);
        let mut choice = Vec::with_capacity(p_tcp_m.len());
        for (tick, (p, before)) in p_tcp_m.iter().zip(&mut before).enumerate() {
            let gap_m = gap_m(p, point);
            let cost = *before + gap_m * gap_m;
            if cost < least {
                (least, at) = (cost, tick);
            }
            *before = least;
            choice.push(at);
        }
        choices.push(choice);
    }
    let mut tick = last_tick;
    let mut passages = Vec::new();
    for (choice, point) in choices.iter().zip(&path.points_m).rev() {
        tick = choice[tick];
        let gap_m = gap_m(&p_tcp_m[tick], point);
        passages.push(Passage { tick, gap_m });
    }
    passages.reverse();
    Some(passages)
}

fn segment(
    p_tcp_m: &[Vector3<f64>],
    first_tick: usize,
    [from, to]: [Vector3<f64>; 2],
    trim_m: f64,
) -> FollowedSegment {
    let whole_m = (to - from).norm();
    let along = (to - from) / whole_m;
    let (low, high) = (trim_m, whole_m - trim_m);
    let mut progress_m: f64 = 0.0;
    let (mut sum, mut travelled_m) = (0.0, 0.0);
    let mut samples: Vec<Sample> = Vec::with_capacity(p_tcp_m.len());
    for (k, p) in p_tcp_m.iter().enumerate() {
        let u = (p - from).dot(&along).clamp(0.0, whole_m);
        progress_m = progress_m.max(u);
        let deviation_m = (p - (from + along * progress_m)).norm();
        let counts = (p - from).norm() > trim_m && (p - to).norm() > trim_m;
        if counts && k > 0 {
            let gone_m = (p - p_tcp_m[k - 1]).norm();
            sum += deviation_m * deviation_m * gone_m;
            travelled_m += gone_m;
        }
        samples.push(Sample {
            tick: first_tick + k,
            progress_m: progress_m.clamp(low, high) - low,
            deviation_m,
            back_m: progress_m - u,
            counts,
        });
    }
    // what was left out: before where it was begun, after where it was left
    let mut left_out_m = 0.0;
    if let ([begun, ..], [.., left]) = (&samples[..], &samples[..]) {
        for (p, a, b) in [
            (p_tcp_m[0], low, low + begun.progress_m),
            (p_tcp_m[p_tcp_m.len() - 1], low + left.progress_m, high),
        ] {
            left_out_m += b - a;
            sum += squares(&(p - from), &along, a, b);
        }
    }
    FollowedSegment {
        length_m: high - low,
        // a segment is longer than what is cut off its ends, so it was followed or left out
        rms_m: (sum / (travelled_m + left_out_m)).sqrt(),
        left_out_m,
        samples,
    }
}

/// `∫ |s along - p|² ds` for `s` from `a` to `b`, `along` a unit vector.
fn squares(p: &Vector3<f64>, along: &Vector3<f64>, a: f64, b: f64) -> f64 {
    let u = p.dot(along);
    let across = p - along * u;
    let (a, b) = (a - u, b - u);
    across.norm_squared() * (b - a) + (b * b * b - a * a * a) / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A segment of 1 m, sampled at these progresses and deviations, a tick each.
    fn sampled(samples: &[(f64, f64)]) -> FollowedSegment {
        let samples = samples.iter().enumerate();
        FollowedSegment {
            length_m: 1.0,
            rms_m: 0.0,
            left_out_m: 0.0,
            samples: samples
                .map(|(i, &(progress_m, deviation_m))| Sample {
                    tick: 100 + i,
                    progress_m,
                    deviation_m,
                    back_m: 0.0,
                    counts: true,
                })
                .collect(),
        }
    }

    #[test]
    fn a_hand_that_stops_early_has_its_gap_at_the_end_of_what_counts() {
        // along 1 m with 50 mm cut off each end, to 120 mm before the end
        let p: Vec<Vector3<f64>> = (0..=88)
            .map(|step| Vector3::new(0.01 * f64::from(step), 0.0, 0.0))
            .collect();
        let ends = [Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)];
        let followed = segment(&p, 0, ends, 0.05);
        let (gap, tick) = followed.longest_gap(0.02).expect("a gap");
        assert!(
            (gap[0] - 0.83).abs() < 1e-12 && (gap[1] - 0.9).abs() < 1e-12,
            "{gap:?}"
        );
        assert_eq!(tick, 88);
        assert!((followed.left_out_m - 0.07).abs() < 1e-12);
        assert!((followed.passed_m(0.02) - 0.83).abs() < 1e-12);
        // what is begun late has it at the beginning
        let followed = segment(&p[20..], 20, ends, 0.05);
        let (gap, _) = followed.longest_gap(0.02).expect("a gap");
        assert!(
            (gap[0]).abs() < 1e-12 && (gap[1] - 0.15).abs() < 1e-12,
            "{gap:?}"
        );
    }

    #[test]
    fn the_longest_gap_is_found_wherever_it_is() {
        let near = [(0.0, 0.0), (0.5, 0.0), (1.0, 0.0)];
        assert_eq!(sampled(&near).longest_gap(0.01), None);
        // a hump of two steps in the middle, and a short one before
        let hump = [
            (0.0, 0.0),
            (0.1, 0.05),
            (0.3, 0.0),
            (0.5, 0.05),
            (0.75, 0.05),
            (1.0, 0.0),
        ];
        assert_eq!(sampled(&hump).longest_gap(0.01), Some(([0.3, 0.75], 103)));
        // begun late, and left early
        let late = [(0.4, 0.0), (0.7, 0.0)];
        assert_eq!(sampled(&late).longest_gap(0.01), Some(([0.0, 0.4], 100)));
        let early = [(0.0, 0.0), (0.25, 0.0), (0.5, 0.05)];
        assert_eq!(sampled(&early).longest_gap(0.01), Some(([0.25, 1.0], 101)));
    }

    fn path(points: &[[f64; 2]]) -> PathToFollow {
        PathToFollow {
            name: "path".to_owned(),
            points_m: points
                .iter()
                .map(|[x, y]| Vector3::new(*x, *y, 0.05))
                .collect(),
            trim_m: 0.05,
        }
    }

    const LINE: [[f64; 2]; 2] = [[0.0, 0.0], [1.0, 0.0]];
    const CORNER: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];

    /// The TCP through `points`, in steps of a thousandth of each segment.
    fn through(points: &[[f64; 2]]) -> Vec<Vector3<f64>> {
        let ends = path(points).points_m;
        let mut track = vec![ends[0]];
        for ends in ends.windows(2) {
            track.extend(
                (1..=1000).map(|k| ends[0] + (ends[1] - ends[0]) * (f64::from(k) / 1000.0)),
            );
        }
        track
    }

    fn of(track: &[Vector3<f64>], points: &[[f64; 2]]) -> Vec<FollowedSegment> {
        followed(track, &path(points)).expect("numbers")
    }

    fn close(value: f64, expected: f64, tolerance: f64) {
        assert!(
            (value - expected).abs() <= tolerance,
            "{value} for {expected}"
        );
    }

    #[test]
    fn who_stays_on_the_path_deviates_by_nothing_at_any_speed() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
        let there_and_back = [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]];
        for points in [&CORNER[..], &square[..], &there_and_back[..]] {
            let even = through(points);
            // waits at every place for as many ticks as it likes
            let uneven = even.iter().enumerate();
            let uneven: Vec<_> = uneven.flat_map(|(k, p)| vec![*p; 1 + k % 7]).collect();
            let fast: Vec<_> = even.iter().step_by(20).copied().collect();
            for track in [even, uneven, fast] {
                for segment in of(&track, points) {
                    // round-off of positions near 1 m
                    close(segment.rms_m, 0.0, 1e-12);
                    close(segment.left_out_m, 0.0, 1e-12);
                    close(segment.passed_m(0.001), 0.9, 1e-12);
                }
            }
        }
    }

    #[test]
    fn what_comes_before_and_after_the_path_does_not_count() {
        let track = through(&[[-1.0, 0.7], [0.0, 0.0], [1.0, 0.0], [0.2, 0.3], [1.0, 0.0]]);
        let segments = of(&track, &LINE);
        // it comes to the first point from one side, within what is cut off
        close(segments[0].rms_m, 0.0, 1e-12);
        close(segments[0].passed_m(0.001), 0.9, 1e-12);
    }

    #[test]
    fn beside_the_path_is_as_far_as_it_is() {
        let segments = of(&through(&[[0.0, 0.01], [1.0, 0.01]]), &LINE);
        // within 0.05 of an end is a little less than 0.05 of the way: 1 part in 1000 of the root; steps of 1 mm another
        close(segments[0].rms_m, 0.01, 2e-5);
        close(segments[0].passed_m(0.011), 0.9, 1e-12);
        assert_eq!(segments[0].passed_m(0.009), 0.0);
    }

    #[test]
    fn who_cuts_the_corner_loses_in_both_segments() {
        let segments = of(&through(&[[0.0, 0.0], [1.0, 1.0]]), &CORNER);
        // half way each: ∫ x² √2 dx from 0.05/√2 to 1/2, and from (1/2, 1/2) to what is left of the segment
        let a = 0.05 / 2.0_f64.sqrt();
        let beside = 2.0_f64.sqrt() * (0.125 - a * a * a) / 3.0;
        let left = 0.25 * 0.45 + 0.45 * 0.45 * 0.45 / 3.0;
        let travelled_m = 2.0_f64.sqrt() * (0.5 - a) + 0.45;
        let expected = ((beside + left) / travelled_m).sqrt();
        for segment in &segments {
            // steps of 1.4 mm against the integral
            close(segment.rms_m, expected, 1e-3);
            close(segment.left_out_m, 0.45, 1e-3);
        }
    }

    #[test]
    fn who_goes_there_and_back_loses() {
        let segments = of(
            &through(&[[0.0, 0.0], [0.6, 0.0], [0.2, 0.0], [1.0, 0.0]]),
            &LINE,
        );
        // 0.4 m back and 0.4 m forth again: 2 ∫ s² ds, of 0.9 + 0.8 m gone
        let expected = (2.0 * 0.4 * 0.4 * 0.4 / 3.0 / 1.7_f64).sqrt();
        close(segments[0].rms_m, expected, 1e-3);
        close(segments[0].furthest().expect("one").back_m, 0.4, 1e-9);
        // from the second point back to the first, before it goes on
        let track = through(&[[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
        let worst = of(&track, &CORNER)
            .iter()
            .map(|s| s.rms_m)
            .fold(0.0, f64::max);
        // one metre back and forth: (2/3)/(0.9 + 2) under the root
        assert!(worst > 0.45, "{worst}");
    }

    #[test]
    fn who_stands_still_covers_nothing_and_is_far_from_the_rest() {
        for x in [0.0, 0.5] {
            let segments = of(&[Vector3::new(x, 0.0, 0.05); 500], &LINE);
            let (a, b) = (0.05 - x, 0.95 - x);
            let expected = ((b * b * b - a * a * a) / 3.0 / 0.9).sqrt();
            close(segments[0].rms_m, expected, 1e-12);
            assert_eq!(segments[0].passed_m(1.0), 0.0);
            close(segments[0].left_out_m, 0.9, 1e-12);
        }
    }

    #[test]
    fn positions_that_are_no_numbers_follow_nothing() {
        let mut track = through(&LINE);
        track[500].y = f64::NAN;
        assert_eq!(followed(&track, &path(&LINE)), None);
        assert_eq!(followed(&[], &path(&LINE)), None);
    }
}
