//! Joint positions spread evenly over their ranges: always the same low-discrepancy sequence, without the gaps of random samples.

use super::position_range::{PositionRange, position_ranges};
use crate::model::robot::Robot;

/// An endless sequence of joint positions inside the ranges of a robot.
///
/// Source: the additive recurrence of M. Roberts, *The unreasonable effectiveness of quasirandom sequences* (2018): entry `k` of
/// sample `i` is `frac(1/2 + i φ^-(k+1))`, `φ` the root of `x^(d+1) = x + 1` for `d` entries.
#[derive(Debug, Clone)]
pub struct JointSamples {
    lower: Vec<f64>,
    width: Vec<f64>,
    step: Vec<f64>,
    drawn: u64,
}

impl JointSamples {
    /// The sequence over the whole `q` of `robot`, from its first sample: the middle of every range.
    pub fn new(robot: &Robot) -> Self {
        let all: Vec<usize> = (0..robot.n()).collect();
        Self::over(&position_ranges(robot), &all)
    }

    /// The sequence over the entries `which` of `q` alone.
    pub(crate) fn over(ranges: &[PositionRange], which: &[usize]) -> Self {
        let mut lower = Vec::with_capacity(which.len());
        let mut width = Vec::with_capacity(which.len());
        for &entry in which {
            let (low, high) = ranges[entry].sampled();
            lower.push(low);
            width.push(high - low);
        }
        let root = generalised_golden_ratio(which.len());
        let mut power = 1.0;
        let step = which.iter().map(|_| {
            power /= root;
            power
        });
        Self {
            step: step.collect(),
            lower,
            width,
            drawn: 0,
        }
    }

    /// Restarts with the first sample.
    pub(crate) fn restart(&mut self) {
        self.drawn = 0;
    }

    /// Writes the next sample into `positions`.
    ///
    /// # Panics
    /// If `positions` has another length than the sequence has entries.
    pub fn next_into(&mut self, positions: &mut [f64]) {
        assert_eq!(positions.len(), self.step.len(), "one position per entry");
        let i = self.drawn as f64;
        for (k, position) in positions.iter_mut().enumerate() {
            let along = 0.5 + i * self.step[k];
            *position = self.lower[k] + (along - along.floor()) * self.width[k];
        }
        self.drawn = self.drawn.wrapping_add(1);
    }
}

/// The root above one of `x^(d+1) = x + 1`.
fn generalised_golden_ratio(d: usize) -> f64 {
    // Newton from above, where x^(d+1) is at least e: the function is convex, so it never overshoots; it doubles its digits
    let power = d.max(1) as f64;
    let mut x = 1.0 + 1.0 / power;
    for _ in 0..20 {
        let raised = libm::pow(x, power);
        x -= (raised * x - x - 1.0) / ((power + 1.0) * raised - 1.0);
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_entry_steps_by_the_golden_ratio_two_by_the_plastic_number() {
        assert!((generalised_golden_ratio(1) - 0.5 * (1.0 + 5.0_f64.sqrt())).abs() < 1e-15);
        // the real root of x³ = x + 1, OEIS A060006
        assert!((generalised_golden_ratio(2) - 1.324_717_957_244_746).abs() < 1e-15);
        // nothing to sample, and very much to sample
        assert!(generalised_golden_ratio(0).is_finite());
        assert!(generalised_golden_ratio(10_000) > 1.0);
    }

    #[test]
    fn every_tenth_of_a_range_gets_its_tenth_of_the_samples() {
        let range = PositionRange {
            lower: -1.0,
            upper: 4.0,
            turns: true,
            repeats: true,
        };
        let mut samples = JointSamples::over(&[range; 3], &[0, 1, 2]);
        let mut counts = [[0_usize; 10]; 3];
        let mut q = [0.0; 3];
        for i in 0..1000 {
            samples.next_into(&mut q);
            if i == 0 {
                assert_eq!(q, [1.5; 3]);
            }
            for (k, position) in q.iter().enumerate() {
                assert!(range.contains(*position));
                counts[k][((position + 1.0) * 2.0) as usize] += 1;
            }
        }
        // a low-discrepancy sequence is off by O(log), a random draw would be off by 10 typically
        assert!(
            counts.iter().flatten().all(|&c| c.abs_diff(100) <= 4),
            "{counts:?}"
        );
    }
}
