//! Means, quartiles, correlation and bins of numbers. Values are sorted before they are summed: their order does not reach the result.

use kinemark_sim::text::number::{exponent, power_of_ten};
use serde::Serialize;

/// A correlation of fewer pairs than this says nothing.
const FEWEST_PAIRS: usize = 10;
/// A histogram has at most so many bins, unless one more holds what is beyond the maximum.
const MOST_BINS: f64 = 12.0;

/// How values are spread. Quartiles are interpolated linearly between neighbours (type 7 of Hyndman and Fan, *Sample Quantiles in
/// Statistical Packages*, 1996; the default of R and NumPy).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// How many values there are.
    pub n: usize,
    /// Their mean.
    pub mean: f64,
    /// The least.
    pub least: f64,
    /// A quarter of the values lies below.
    pub lower_quartile: f64,
    /// Half of the values lies below.
    pub median: f64,
    /// Three quarters of the values lie below.
    pub upper_quartile: f64,
    /// The greatest.
    pub greatest: f64,
}

impl Spread {
    /// The spread of the finite ones of `values`; none of none.
    pub fn of(values: &[f64]) -> Option<Self> {
        let sorted = sorted(values);
        let (least, greatest) = (*sorted.first()?, *sorted.last()?);
        Some(Self {
            n: sorted.len(),
            mean: mean(&sorted)?,
            least,
            lower_quartile: quantile(&sorted, 0.25),
            median: quantile(&sorted, 0.5),
            upper_quartile: quantile(&sorted, 0.75),
            greatest,
        })
    }
}

/// The finite values, from the least to the greatest.
pub(super) fn sorted(values: &[f64]) -> Vec<f64> {
    let finite = values.iter().copied().filter(|value| value.is_finite());
    let mut sorted: Vec<f64> = finite.collect();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// The value below which a share of sorted values lies.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let at = share * (sorted.len() - 1) as f64;
    let (below, rest) = (at.floor() as usize, at - at.floor());
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + rest * (sorted[above] - sorted[below])
}

/// The mean of the finite ones of `values`; none of none.
pub fn mean(values: &[f64]) -> Option<f64> {
    let sorted = sorted(values);
    let n = sorted.len();
    (n > 0).then(|| sorted.iter().sum::<f64>() / n as f64)
}

/// Pearson's correlation of pairs, from -1 to 1. None of fewer than ten pairs, or where either side is always the same.
pub fn correlation(pairs: &[(f64, f64)]) -> Option<f64> {
    let finite = pairs.iter().filter(|(x, y)| x.is_finite() && y.is_finite());
    let mut pairs: Vec<(f64, f64)> = finite.copied().collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let side = |of: fn(&(f64, f64)) -> f64| Spread::of(&pairs.iter().map(of).collect::<Vec<_>>());
    let (x, y) = (side(|pair| pair.0)?, side(|pair| pair.1)?);
    // compared exactly: the rounding of a mean would look like a spread
    let has_spread = x.least < x.greatest && y.least < y.greatest;
    if pairs.len() < FEWEST_PAIRS || !has_spread {
        return None;
    }
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    for pair in &pairs {
        let (dx, dy) = (pair.0 - x.mean, pair.1 - y.mean);
        xx += dx * dx;
        yy += dy * dy;
        xy += dx * dy;
    }
    let r = xy / (xx.sqrt() * yy.sqrt());
    r.is_finite().then(|| r.clamp(-1.0, 1.0))
}

/// A bin of a histogram.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bin {
    /// Its lower end, which belongs to it.
    pub from: f64,
    /// Its upper end, which belongs to the next bin; that of the last one to itself.
    pub to: f64,
    /// How many values are in it.
    pub students: usize,
}

/// Bins from 0 to `max`, and on to the greatest value where that is beyond; their width is 1, 2, 2.5 or 5 times a power of ten, so
/// that there are at most twelve up to `max`. A value on an edge belongs to the bin above it. No bins where `max` is not positive.
pub fn bins(values: &[f64], max: f64) -> Vec<Bin> {
    if !(max.is_finite() && max > 0.0) {
        return Vec::new();
    }
    let values = sorted(values);
    let top = values.last().map_or(max, |greatest| greatest.max(max));
    let width = width(max / MOST_BINS);
    let count = (top / width - 1e-9).ceil().max(1.0) as usize;
    let mut bins: Vec<Bin> = (0..count)
        .map(|i| Bin {
            from: i as f64 * width,
            to: ((i + 1) as f64 * width).min(top),
            students: 0,
        })
        .collect();
    for value in values {
        // points are hundredths: an edge is met but for rounding
        let at = (value / width + 1e-9).floor().max(0.0) as usize;
        bins[at.min(count - 1)].students += 1;
    }
    bins
}

/// The least of 1, 2, 2.5, 5 and 10 times a power of ten that is not below `least`.
fn width(least: f64) -> f64 {
    let power = power_of_ten(exponent(least));
    let rounds = [1.0, 2.0, 2.5, 5.0, 10.0].map(|round| round * power);
    let fits = rounds
        .into_iter()
        .find(|width| *width >= least * (1.0 - 1e-9));
    fits.unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_are_interpolated_between_neighbours() {
        let spread = Spread::of(&[4.0, 1.0, 3.0, 2.0]).unwrap();
        assert_eq!((spread.n, spread.mean), (4, 2.5));
        assert_eq!((spread.least, spread.greatest), (1.0, 4.0));
        let quartiles = [spread.lower_quartile, spread.median, spread.upper_quartile];
        assert_eq!(quartiles, [1.75, 2.5, 3.25]);
        let one = Spread::of(&[7.0, f64::NAN]).unwrap();
        assert_eq!(
            (one.n, one.lower_quartile, one.upper_quartile),
            (1, 7.0, 7.0)
        );
        assert_eq!(Spread::of(&[]), None);
        assert_eq!(mean(&[f64::INFINITY]), None);
    }

    #[test]
    fn the_order_of_values_does_not_reach_the_bits() {
        let values = [0.1, 0.2, 0.3, 1e16, -1e16, 0.7];
        let turned: Vec<f64> = values.iter().rev().copied().collect();
        assert_eq!(Spread::of(&values), Spread::of(&turned));
    }

    /// x = 0 to 9, and y the same but for the last, which is 0.
    #[test]
    fn a_correlation_is_that_of_the_formula() {
        let line: Vec<(f64, f64)> = (0..10).map(|i| (f64::from(i), f64::from(i))).collect();
        assert!((correlation(&line).unwrap() - 1.0).abs() < 1e-12);
        let down: Vec<(f64, f64)> = line.iter().map(|(x, y)| (*x, -2.0 * y)).collect();
        assert!((correlation(&down).unwrap() + 1.0).abs() < 1e-12);
        let mut bent = line.clone();
        bent[9].1 = 0.0;
        // sum x = 45, sum y = 36, sum xx = 285, sum yy = 204, sum xy = 204
        let (sxy, sxx, syy) = (204.0 - 162.0, 285.0 - 202.5, 204.0 - 129.6);
        let expected = sxy / f64::sqrt(sxx * syy);
        assert!((correlation(&bent).unwrap() - expected).abs() < 1e-12);
        assert_eq!(correlation(&line[..9]), None, "too few");
        let flat: Vec<(f64, f64)> = line.iter().map(|(x, _)| (*x, 0.1)).collect();
        assert_eq!(correlation(&flat), None, "no spread");
    }

    #[test]
    fn bins_are_round_and_hold_every_value_once() {
        let edges = |bins: &[Bin]| -> Vec<f64> { bins.iter().map(|bin| bin.to).collect() };
        let counts = |bins: &[Bin]| -> Vec<usize> { bins.iter().map(|bin| bin.students).collect() };
        let of_24 = bins(&[0.0, 1.99, 2.0, 23.99, 24.0], 24.0);
        assert_eq!(of_24.len(), 12);
        assert_eq!(
            (of_24[0].students, of_24[1].students, of_24[11].students),
            (2, 1, 2)
        );
        assert_eq!(edges(&bins(&[], 10.0)).len(), 10);
        assert_eq!(bins(&[], 30.0)[0].to, 2.5);
        // the last bin ends at the maximum, and points by hand may go beyond it
        let of_17 = bins(&[17.0, 18.5], 17.0);
        assert_eq!(edges(&of_17)[7..], [16.0, 18.0, 18.5]);
        assert_eq!(counts(&of_17)[7..], [0, 1, 1]);
        // 0.3 / 0.1 is below 3 in binary
        assert_eq!(bins(&[0.3], 1.0)[3].students, 1);
        assert!(bins(&[1.0], 0.0).is_empty());
    }
}
