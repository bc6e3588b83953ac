//! Dwells: where in a run the TCP kept to each goal, in order, for as long as it had to.
//!
//! All choices of one window per goal, each after the one before, are compared; the one that earns most is taken, and of ones that
//! earn the same to a hundredth the earliest. So neither a pass through a goal on the way, nor a late return to it, can cost a point.

use std::collections::VecDeque;

use kinemark_sim::trace::Trace;

use crate::task::model::{Band, MotionGoal};

/// A window of a run at a goal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dwell {
    /// Its first tick.
    pub first: usize,
    /// Its last tick.
    pub last: usize,
    /// Greatest distance from the goal in it \[m\].
    pub worst_m: f64,
    /// The same of the best window before the TCP leaves again \[m\]: the first good window is barely good, later ones show how
    /// near the arm settles.
    pub settled_m: f64,
    /// The last tick of that window.
    pub settled_last: usize,
}

/// The best dwells, one per goal in order; empty where the run is too short for all dwells.
pub fn best_dwells(trace: &Trace, goals: &[MotionGoal], band: Band) -> Vec<Dwell> {
    let ticks = trace.len();
    // best worth with the goals so far, their windows ending at or before a tick; and where the last one ends
    let mut before = vec![Worth::NOTHING; ticks];
    let mut choices: Vec<Vec<Option<usize>>> = Vec::new();
    let mut worsts: Vec<Vec<f64>> = Vec::new();
    for goal in goals {
        let length = goal.dwell_ticks as usize;
        let distances: Vec<f64> = (0..ticks)
            .map(|tick| (trace.tcp_position(tick) - goal.position_m).norm())
            .collect();
        let worst = sliding_maximum(&distances, length + 1);
        let mut best = vec![Worth::IMPOSSIBLE; ticks];
        let mut choice = vec![None; ticks];
        for last in 0..ticks {
            if last > 0 {
                best[last] = best[last - 1];
                choice[last] = choice[last - 1];
            }
            if last < length {
                continue;
            }
            let worth = before[last - length].and(band, worst[last]);
            if worth.is_better_than(best[last]) {
                best[last] = worth;
                choice[last] = Some(last);
            }
        }
        before = best;
        choices.push(choice);
        worsts.push(worst);
    }
    let mut dwells = Vec::new();
    let mut limit = ticks.checked_sub(1);
    for (i, goal) in goals.iter().enumerate().rev() {
        let Some(last) = limit.and_then(|limit| choices[i][limit]) else {
            return Vec::new();
        };
        let first = last - goal.dwell_ticks as usize;
        // what comes after the next goal's dwell has begun is no part of this one
        let until = limit.unwrap_or(last);
        let (later, settled_m) = settled(&worsts[i][last..=until], band);
        dwells.push(Dwell {
            first,
            last,
            worst_m: worsts[i][last],
            settled_m,
            settled_last: last + later,
        });
        limit = Some(first);
    }
    dwells.reverse();
    dwells
}

/// The first of the least distances, with its index, for as long as windows are no worse than the first, or full.
fn settled(worsts: &[f64], band: Band) -> (usize, f64) {
    let no_worse = worsts[0].max(band.full);
    let mut least = (0, worsts[0]);
    for (later, &worst) in worsts.iter().enumerate() {
        if worst > no_worse {
            break;
        }
        if worst < least.1 {
            least = (later, worst);
        }
    }
    least
}

/// What a choice of windows is worth: what it earns; and among those that earn nothing, how near they come.
#[derive(Debug, Clone, Copy)]
struct Worth {
    score: f64,
    nearness: f64,
}

impl Worth {
    const NOTHING: Self = Self {
        score: 0.0,
        nearness: 0.0,
    };
    const IMPOSSIBLE: Self = Self {
        score: f64::NEG_INFINITY,
        nearness: f64::NEG_INFINITY,
    };

    /// This choice with one window more.
    fn and(self, band: Band, worst_m: f64) -> Self {
        let score = band.score(worst_m);
        Self {
            score: self.score + score,
            nearness: self.nearness - if score > 0.0 { 0.0 } else { worst_m },
        }
    }

    /// A later window must earn a hundredth more: an arm that settles creeps on by less and less, and is there long before.
    fn is_better_than(self, other: Self) -> bool {
        let enough = 0.01;
        self.score > other.score + enough
            || (self.score >= other.score && self.nearness > other.nearness)
    }
}

/// For every index the maximum of the `width` values that end there (fewer at the start).
fn sliding_maximum(values: &[f64], width: usize) -> Vec<f64> {
    let mut candidates: VecDeque<usize> = VecDeque::new();
    let mut maxima = Vec::with_capacity(values.len());
    for (i, value) in values.iter().enumerate() {
        while candidates
            .back()
            .is_some_and(|&back| values[back] <= *value)
        {
            candidates.pop_back();
        }
        candidates.push_back(i);
        if candidates[0] + width <= i {
            candidates.pop_front();
        }
        maxima.push(values[candidates[0]]);
    }
    maxima
}

#[cfg(test)]
mod tests {
    use super::sliding_maximum;

    #[test]
    fn the_sliding_maximum_is_the_plain_one() {
        let values = [3.0, 1.0, 4.0, 1.0, 5.0, 9.0, 2.0, 6.0, 5.0, 3.0];
        for width in 1..6 {
            for (i, maximum) in sliding_maximum(&values, width).iter().enumerate() {
                let start = (i + 1).saturating_sub(width);
                let plain = values[start..=i].iter().copied().fold(f64::MIN, f64::max);
                assert_eq!(*maximum, plain, "width {width} at {i}");
            }
        }
    }
}
