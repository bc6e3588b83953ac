//! Numbers drawn from a seed: the same for the same seed on every platform.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

/// A stream of 64-bit numbers; its whole state is one of them, so a copy of it goes on with the same numbers.
///
/// Source: Steele, Lea & Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014 (SplitMix64).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SplitMix64 {
    state: u64,
}

impl SplitMix64 {
    /// The stream of `seed`.
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// The next number, uniform in `[0, 1)`, a multiple of 2⁻⁵³.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// The next number of the standard normal distribution; takes two uniform ones.
    ///
    /// Source: Box & Muller, "A Note on the Generation of Random Normal Deviates", 1958; the cosine only, so that nothing is
    /// kept between calls.
    pub fn normal(&mut self) -> f64 {
        // from (0, 1], where the logarithm is finite
        let radius = (-2.0 * libm::log(1.0 - self.uniform())).sqrt();
        radius * libm::cos(TAU * self.uniform())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stream_is_that_of_the_published_generator() {
        // the check values that are published for the seed 1234567
        let mut numbers = SplitMix64::new(1_234_567);
        let first: [u64; 5] = std::array::from_fn(|_| numbers.bits());
        assert_eq!(
            first,
            [
                6_457_827_717_110_365_317,
                3_203_168_211_198_807_973,
                9_817_491_932_198_370_423,
                4_593_380_528_125_082_431,
                16_408_922_859_458_223_821,
            ]
        );
    }

    #[test]
    fn normal_numbers_have_the_moments_of_their_distribution() {
        let mut numbers = SplitMix64::new(7);
        let n = 200_000;
        let (mut first, mut second, mut fourth) = (0.0, 0.0, 0.0);
        for _ in 0..n {
            let x = numbers.normal();
            first += x;
            second += x * x;
            fourth += x * x * x * x;
        }
        let n = f64::from(n);
        // five standard errors: sqrt(1/n), sqrt(2/n), sqrt(96/n)
        assert!((first / n).abs() < 0.0112, "{}", first / n);
        assert!((second / n - 1.0).abs() < 0.0159, "{}", second / n);
        assert!((fourth / n - 3.0).abs() < 0.11, "{}", fourth / n);
    }
}
