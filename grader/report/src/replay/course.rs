//! Where one thing was at every moment, and the frames that record it: few where it moves evenly, every tick where it is knocked.

use super::between::weights;
use super::column::{Track, quanta_of};

/// Frames are at most so far apart \[s\].
const APART_S: f64 = 0.256;

/// What is recorded of a thing, and so how far two of its rows are apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum What {
    /// One number \[rad, or m by the unit of length\].
    Number,
    /// A point \[m\].
    Place,
    /// A point \[m\] and a quaternion.
    Pose,
}

impl What {
    fn width(self) -> usize {
        match self {
            Self::Number => 1,
            Self::Place => 3,
            Self::Pose => 7,
        }
    }

    /// How far a blend of rows is from a row \[rad, or units of length\]; infinite where the blend is no pose.
    fn apart(self, blend: &[f64], row: &[f64], unit_m: f64) -> f64 {
        let square = |range: std::ops::Range<usize>| -> f64 {
            range
                .map(|c| (blend[c] - row[c]) * (blend[c] - row[c]))
                .sum()
        };
        match self {
            Self::Number => (blend[0] - row[0]).abs() / unit_m,
            Self::Place => square(0..3).sqrt() / unit_m,
            Self::Pose => {
                let place = square(0..3).sqrt() / unit_m;
                let length: f64 = blend[3..7].iter().map(|x| x * x).sum::<f64>().sqrt();
                if length < 1e-3 {
                    return f64::INFINITY;
                }
                // of two near turns the angle between them is twice the distance of their quaternions
                let turn: f64 = (3..7)
                    .map(|c| (blend[c] / length - row[c]) * (blend[c] / length - row[c]))
                    .sum();
                place.max(2.0 * turn.sqrt())
            }
        }
    }
}

/// One thing's rows at the moments that are looked at.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Course {
    what: What,
    /// The length that counts as much as a radian \[m\]; of a number that is an angle, 1.
    unit_m: f64,
    quanta: Vec<f64>,
    rows: Vec<f64>,
}

impl Course {
    pub(super) fn new(what: What, quanta: &[f64], unit_m: f64) -> Self {
        Self {
            what,
            unit_m,
            quanta: quanta.to_vec(),
            rows: Vec::new(),
        }
    }

    /// Adds the next row, each number finite.
    pub(super) fn push(&mut self, row: &[f64]) {
        let start = self.rows.len();
        self.rows.extend_from_slice(&row[..self.what.width()]);
        if self.what == What::Pose && start > 0 {
            // a turn and its negative are the same; the nearer one lets a viewer go between two frames
            let dot: f64 = (3..7)
                .map(|c| self.rows[start - 7 + c] * self.rows[start + c])
                .sum();
            if dot < 0.0 {
                self.rows[start + 3..].iter_mut().for_each(|x| *x = -*x);
            }
        }
    }

    fn row(&self, at: usize) -> &[f64] {
        let width = self.what.width();
        &self.rows[at * width..(at + 1) * width]
    }

    /// Where it is first, if it has a row.
    pub(super) fn start(&self) -> Option<&[f64]> {
        (!self.rows.is_empty()).then(|| self.row(0))
    }

    /// Whether it never leaves where it is first, as far as the record can show.
    pub(super) fn stands_still(&self) -> bool {
        let Some(start) = self.start() else {
            return true;
        };
        let width = self.what.width();
        let whole = |c: usize, value: f64| quanta_of(value, self.quanta[c]);
        self.rows
            .chunks_exact(width)
            .all(|row| (0..width).all(|c| whole(c, row[c]) == whole(c, start[c])))
    }

    /// The track through `ticks`, the moments looked at, one a row, in order: at each of them it is at most `within` \[rad, units of
    /// length\] from the row.
    pub(super) fn track(&self, ticks: &[usize], step_s: f64, within: f64) -> Track {
        let frames = self.frames(ticks, step_s, within);
        let at: Vec<usize> = frames.iter().map(|i| ticks[*i]).collect();
        let rows = frames.iter().map(|i| self.row(*i));
        let within = match self.what {
            // the angle is the greater number
            What::Pose => within,
            What::Number | What::Place => within * self.unit_m,
        };
        Track::through(&at, &self.quanta, rows, within)
    }

    /// Which rows the track needs: from few frames on, halves every interval in which it would be too far off, until none is left.
    fn frames(&self, ticks: &[usize], step_s: f64, within: f64) -> Vec<usize> {
        let Some(last) = ticks.len().checked_sub(1) else {
            return Vec::new();
        };
        let apart = (APART_S / step_s).round().max(1.0) as usize;
        let mut frames = vec![0];
        for (i, tick) in ticks.iter().enumerate().skip(1) {
            let before = ticks[frames[frames.len() - 1]];
            // the tick after would be too far
            if i == last || ticks[i + 1] - before > apart {
                frames.push(i);
            }
            debug_assert!(*tick > before);
        }
        let mut is_open = vec![true; frames.len().saturating_sub(1)];
        while is_open.contains(&true) {
            let mut halved = vec![false; is_open.len()];
            for (k, is_halved) in halved.iter_mut().enumerate() {
                *is_halved = is_open[k] && !self.holds(ticks, &frames, k, within);
            }
            let mut next = Vec::with_capacity(frames.len());
            let mut next_open = Vec::with_capacity(frames.len());
            for (k, frame) in frames.iter().enumerate() {
                next.push(*frame);
                let Some(is_halved) = halved.get(k) else {
                    break;
                };
                // a new frame bends the way beside it, too
                let beside = halved[k.saturating_sub(1)] || halved.get(k + 1) == Some(&true);
                next_open.push(*is_halved || beside);
                if *is_halved {
                    next.push(usize::midpoint(*frame, frames[k + 1]));
                    next_open.push(true);
                }
            }
            frames = next;
            is_open = next_open;
        }
        frames
    }

    /// Whether the way from frame `k` to the next is near enough to every row between them.
    fn holds(&self, ticks: &[usize], frames: &[usize], k: usize, within: f64) -> bool {
        let (from, to) = (frames[k], frames[k + 1]);
        if to - from < 2 {
            return true;
        }
        let around = [
            frames[k.saturating_sub(1)],
            from,
            to,
            frames[(k + 2).min(frames.len() - 1)],
        ];
        let width = self.what.width();
        let mut rounded = [[0.0; 7]; 4];
        for (rounded, at) in rounded.iter_mut().zip(around) {
            let row = self.row(at);
            for c in 0..width {
                rounded[c] = quanta_of(row[c], self.quanta[c]) as f64 * self.quanta[c];
            }
        }
        let at = around.map(|at| ticks[at] as f64);
        let off = |i: usize| {
            let weights = weights(at, ticks[i] as f64);
            let mut blend = [0.0; 7];
            for (rounded, weight) in rounded.iter().zip(weights) {
                for c in 0..width {
                    blend[c] += weight * rounded[c];
                }
            }
            self.what.apart(&blend[..width], self.row(i), self.unit_m)
        };
        // most that fail do so in the middle
        off(usize::midpoint(from, to)) <= within && (from + 1..to).all(|i| off(i) <= within)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(values: impl Iterator<Item = f64>) -> (Course, Vec<usize>) {
        let mut course = Course::new(What::Number, &[1e-5], 1.0);
        values.for_each(|value| course.push(&[value]));
        let ticks = (0..course.rows.len()).collect();
        (course, ticks)
    }

    /// Worst distance of what is read from the rows.
    fn worst(course: &Course, ticks: &[usize], frames: &[usize]) -> f64 {
        let mut off: f64 = 0.0;
        for k in 0..frames.len() - 1 {
            for i in frames[k]..=frames[k + 1] {
                let around = [
                    frames[k.saturating_sub(1)],
                    frames[k],
                    frames[k + 1],
                    frames[(k + 2).min(frames.len() - 1)],
                ];
                let weights = weights(around.map(|at| ticks[at] as f64), ticks[i] as f64);
                let read: f64 = (0..4)
                    .map(|w| weights[w] * (course.row(around[w])[0] / 1e-5).round() * 1e-5)
                    .sum();
                off = off.max((read - course.row(i)[0]).abs());
            }
        }
        off
    }

    #[test]
    fn what_moves_evenly_needs_few_frames_and_a_knock_its_own() {
        let (smooth, ticks) = numbers((0..4001).map(|i| libm::sin(0.002 * f64::from(i))));
        let frames = smooth.frames(&ticks, 0.001, 3e-4);
        assert!(frames.len() < 60, "{} frames", frames.len());
        assert!(worst(&smooth, &ticks, &frames) <= 3e-4);

        // at rest until tick 1003, then away at 5 m/s
        let (knock, ticks) = numbers((0..2001).map(|i| 0.005 * f64::from((i - 1003).max(0))));
        let frames = knock.frames(&ticks, 0.001, 3e-4);
        assert!(frames.contains(&1003) && frames.len() < 60, "{frames:?}");
        assert!(worst(&knock, &ticks, &frames) <= 3e-4);

        // a buzz of every tick is recorded tick by tick
        let (buzz, ticks) = numbers((0..501).map(|i| f64::from(i % 2)));
        assert_eq!(buzz.frames(&ticks, 0.001, 3e-4).len(), 501);
    }

    #[test]
    fn frames_lie_on_the_moments_looked_at_and_no_farther_apart_than_allowed() {
        let (still, _) = numbers((0..401).map(|_| 0.25));
        let ticks: Vec<usize> = (0..401).map(|i| 3 * i).collect();
        let frames = still.frames(&ticks, 0.001, 3e-4);
        assert!(still.stands_still());
        assert_eq!((frames[0], frames.last()), (0, Some(&400)));
        for pair in frames.windows(2) {
            assert!(ticks[pair[1]] - ticks[pair[0]] <= 256, "{frames:?}");
        }
        assert!(frames.len() <= 6, "{frames:?}");
        let (one, _) = numbers([0.5].into_iter());
        assert_eq!(one.frames(&[7], 0.001, 3e-4), [0]);
        let (none, _) = numbers([].into_iter());
        assert!(none.frames(&[], 0.001, 3e-4).is_empty() && none.stands_still());
    }

    #[test]
    fn a_turn_and_its_negative_are_one_and_the_angle_counts() {
        let mut course = Course::new(What::Pose, &[1e-5; 7], 1.0);
        for i in 0..501 {
            let (s, c) = libm::sincos(0.5 * 0.01 * f64::from(i));
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            course.push(&[1.0, 0.0, 0.0, sign * c, 0.0, sign * s, 0.0]);
        }
        let ticks: Vec<usize> = (0..501).collect();
        let frames = course.frames(&ticks, 0.001, 3e-4);
        assert!(frames.len() < 60, "{}", frames.len());
        let what = What::Pose;
        let turned = |angle: f64| {
            let (s, c) = libm::sincos(0.5 * angle);
            [0.0, 0.0, 0.0, c, s, 0.0, 0.0]
        };
        assert!((what.apart(&turned(0.0), &turned(1e-3), 1.0) - 1e-3).abs() < 1e-9);
        assert_eq!(what.apart(&[0.0; 7], &turned(0.0), 1.0), f64::INFINITY);
    }
}
