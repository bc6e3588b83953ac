//! All randomness: where seeds come from, and the numbers drawn from them, the same on every platform.
//!
//! | drawn | seed | numbers |
//! |---|---|---|
//! | noise of a sensor, gusts, disturbances | stated, or [`seed_of_name`] | [`SplitMix64`] |
//! | anything keyed by names, such as the cases of a class | [`KeyedStream::new`] | [`KeyedStream`] |
//!
//! Recorded grades depend on every bit of both schemes: add a new scheme if one is needed, but never change these.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

/// A stream of 64-bit numbers. Its state is a single number, so a copy continues with the same sequence.
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

/// A seed from a name: its 64-bit FNV-1a hash.
///
/// Source: Fowler, Noll & Vo, "The FNV Non-Cryptographic Hash Algorithm", RFC 9923.
pub fn seed_of_name(name: &str) -> u64 {
    name.bytes().fold(0xCBF2_9CE4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
    })
}

/// A stream of numbers keyed by names: BLAKE3 with a derived key, in extendable-output mode. Without the names nobody can predict its
/// numbers or those of another key.
#[derive(Debug, Clone)]
pub struct KeyedStream(blake3::OutputReader);

impl KeyedStream {
    /// The stream of `names` and `index` in a `context`, which says what the numbers are for; each context has its own numbers.
    ///
    /// Every name is hashed with its length, so that no two lists of names make the same key; `index` holds the bytes of an integer
    /// that distinguishes things of the same names, or is empty.
    pub fn new(context: &str, names: &[&str], index: &[u8]) -> Self {
        let mut hasher = blake3::Hasher::new_derive_key(context);
        for name in names {
            hasher.update(&(name.len() as u64).to_le_bytes());
            hasher.update(name.as_bytes());
        }
        hasher.update(index);
        Self(hasher.finalize_xof())
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        let mut bytes = [0; 8];
        self.0.fill(&mut bytes);
        u64::from_le_bytes(bytes)
    }

    /// The next number, uniform in `[low, high)`, of 53 random bits.
    pub fn between(&mut self, [low, high]: [f64; 2]) -> f64 {
        let unit = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    /// The next integer below `count`, uniform: for a `count` of at most a million no value is preferred by more than a part in 10¹³.
    pub fn below(&mut self, count: u64) -> u64 {
        let product = u128::from(self.bits()) * u128::from(count);
        (product >> 64) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_seed_of_a_name_is_its_published_hash() {
        // check values of the algorithm's own test suite
        assert_eq!(seed_of_name(""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(seed_of_name("a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(seed_of_name("foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn a_keyed_stream_is_the_output_of_the_hash_and_names_do_not_run_together() {
        let mut key = blake3::Hasher::new_derive_key("a context");
        key.update(b"\x02\0\0\0\0\0\0\0ab\x01\0\0\0\0\0\0\0c\x07\0\0\0");
        let mut bytes = [0; 24];
        key.finalize_xof().fill(&mut bytes);
        let word = |i: usize| u64::from_le_bytes(std::array::from_fn(|k| bytes[8 * i + k]));
        let mut stream = KeyedStream::new("a context", &["ab", "c"], &7_u32.to_le_bytes());
        assert_eq!(stream.bits(), word(0));
        assert_eq!(
            stream.between([-1.0, 3.0]),
            -1.0 + 4.0 * ((word(1) >> 11) as f64 / (1_u64 << 53) as f64)
        );
        assert_eq!(
            stream.below(1000),
            (word(2) as f64 / (2.0 * (1_u64 << 63) as f64) * 1000.0) as u64
        );
        let mut other = KeyedStream::new("a context", &["a", "bc"], &7_u32.to_le_bytes());
        assert_ne!(other.bits(), word(0));
    }

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
