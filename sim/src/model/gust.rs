//! Gusts of wind: a first-order Markov process drawn from a seed.

use serde::{Deserialize, Serialize};

use crate::random::SplitMix64;

/// Gusts along the mean wind: normally distributed with zero mean and an exponentially decaying correlation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gust {
    /// Standard deviation of the speed \[m/s\].
    pub speed_m_s: f64,
    /// Time in which the correlation falls to 1/e \[s\].
    pub correlation_s: f64,
    /// Seed of the numbers.
    pub seed: u64,
}

impl Gust {
    /// An endless series of speeds along the mean wind \[m/s\], one for each step of `step_s` from the start of a run.
    ///
    /// The step decides which numbers are drawn, but not their distribution, which is that of the continuous process for any step.
    /// A step of zero stays at its first speed.
    ///
    /// Source: Gillespie, "Exact numerical simulation of the Ornstein-Uhlenbeck process and its integral", Phys. Rev. E 54
    /// (1996), eq. 2.7, with a start drawn from the stationary distribution.
    pub fn sequence(&self, step_s: f64) -> GustSequence {
        let steps = step_s / self.correlation_s;
        GustSequence {
            numbers: SplitMix64::new(self.seed),
            kept: libm::exp(-steps),
            fresh_m_s: self.speed_m_s * (-libm::expm1(-2.0 * steps)).sqrt(),
            first_m_s: Some(self.speed_m_s),
            speed_m_s: 0.0,
        }
    }
}

/// Speeds of a [`Gust`], step by step; a copy continues with the same speeds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GustSequence {
    numbers: SplitMix64,
    /// Correlation of successive speeds: the fraction of a speed that remains after one step.
    kept: f64,
    /// Standard deviation of the increment of one step \[m/s\].
    fresh_m_s: f64,
    /// Standard deviation of the first speed, until it is drawn \[m/s\].
    first_m_s: Option<f64>,
    speed_m_s: f64,
}

impl Iterator for GustSequence {
    type Item = f64;

    fn next(&mut self) -> Option<f64> {
        self.speed_m_s = match self.first_m_s.take() {
            Some(first) => first * self.numbers.normal(),
            None => self.kept * self.speed_m_s + self.fresh_m_s * self.numbers.normal(),
        };
        Some(self.speed_m_s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GUST: Gust = Gust {
        speed_m_s: 2.0,
        correlation_s: 0.5,
        seed: 11,
    };

    /// Mean, variance, and correlation at `lag` steps.
    fn moments(speeds: &[f64], lag: usize) -> (f64, f64, f64) {
        let n = speeds.len() as f64;
        let mean = speeds.iter().sum::<f64>() / n;
        let variance = speeds.iter().map(|v| v * v).sum::<f64>() / n;
        let pairs = speeds.iter().zip(&speeds[lag..]);
        let covariance = pairs.map(|(a, b)| a * b).sum::<f64>() / (n - lag as f64);
        (mean, variance, covariance / variance)
    }

    #[test]
    fn mean_variance_and_correlation_are_those_of_the_process_at_any_step() {
        for step_s in [0.01, 0.1, 2.0] {
            let n = 400_000;
            let speeds: Vec<f64> = GUST.sequence(step_s).take(n).collect();
            let lag = (0.5 / step_s).ceil() as usize;
            let (mean, variance, correlation) = moments(&speeds, lag);
            // independent samples are about 2 T / step apart; five standard errors
            let independent = n as f64 / (2.0 * 0.5 / step_s).max(1.0);
            let error = 5.0 / independent.sqrt();
            assert!(mean.abs() < 2.0 * error, "{step_s}: mean {mean}");
            let spread = 4.0 * error * 2.0_f64.sqrt();
            assert!((variance - 4.0).abs() < spread, "{step_s}: {variance}");
            let expected = libm::exp(-(lag as f64) * step_s / 0.5);
            assert!(
                (correlation - expected).abs() < error,
                "{step_s}: {correlation} against {expected}"
            );
        }
    }

    #[test]
    fn the_first_speed_is_drawn_like_all_others() {
        let n = 40_000;
        let squares: f64 = (0..n)
            .map(|seed| {
                let first = Gust { seed, ..GUST }.sequence(0.001).next().unwrap();
                first * first
            })
            .sum();
        // five standard errors of a variance of 4: 5 * 4 * sqrt(2 / n)
        assert!((squares / n as f64 - 4.0).abs() < 0.15);
    }

    #[test]
    fn a_seed_gives_the_same_speeds_and_another_seed_others() {
        let speeds = |seed| -> Vec<u64> {
            let gust = Gust { seed, ..GUST };
            gust.sequence(0.001).take(100).map(f64::to_bits).collect()
        };
        assert_eq!(speeds(1), speeds(1));
        assert_ne!(speeds(1), speeds(2));
        // and a copy taken in the middle goes on with the same
        let mut sequence = GUST.sequence(0.001);
        sequence.nth(50);
        let copy = sequence.clone();
        assert!(sequence.take(100).eq(copy.take(100)));
    }

    #[test]
    fn no_speed_is_no_gust_and_no_time_no_change() {
        let calm = Gust {
            speed_m_s: 0.0,
            ..GUST
        };
        assert!(calm.sequence(0.001).take(10).all(|v| v == 0.0));
        let mut held = GUST.sequence(0.0);
        let first = held.next();
        assert_eq!(held.nth(5), first);
    }
}
