//! Statistics of a signal over a run: what of a curve counts, and so where points were first lost.

/// What of a check's curve is held against the band.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Statistic {
    /// The greatest value: the first one beyond the band costs points.
    Greatest,
    /// The root mean square: points are lost from where the curve leaves the band for what the evidence shows.
    RootMeanSquare,
    /// The last value: the curve is what has come together so far.
    SoFar,
}

impl Statistic {
    /// Its value over a signal; 0 over one without values. A signal that is no number somewhere has no greatest value.
    pub(super) fn of(self, values: &[f64]) -> f64 {
        match self {
            Self::Greatest => greatest(values.iter().copied()).map_or(0.0, |(_, value)| value),
            Self::RootMeanSquare => {
                let squares: f64 = values.iter().map(|value| value * value).sum();
                (squares / values.len().max(1) as f64).sqrt()
            }
            Self::SoFar => values.last().copied().unwrap_or(0.0),
        }
    }
}

/// The greatest value with its index, of equal ones the first; one that is no number is greater than all.
pub(super) fn greatest(values: impl IntoIterator<Item = f64>) -> Option<(usize, f64)> {
    let rank = |value: f64| {
        if value.is_nan() {
            f64::NAN.abs()
        } else {
            value
        }
    };
    let values = values.into_iter().enumerate();
    values.reduce(|most, next| {
        let is_greater = rank(next.1).total_cmp(&rank(most.1)).is_gt();
        if is_greater { next } else { most }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_greatest_is_the_first_of_equals_and_nan_is_greater_than_all() {
        assert_eq!(greatest([0.0, 2.0, 1.0, 2.0]), Some((1, 2.0)));
        let (index, value) = greatest([0.0, -f64::NAN, f64::INFINITY]).unwrap();
        assert!(index == 1 && value.is_nan());
        assert_eq!(greatest([]), None);
    }

    #[test]
    fn each_statistic_of_a_signal() {
        let signal = [1.0, -7.0, 5.0];
        assert_eq!(Statistic::Greatest.of(&signal), 5.0);
        assert_eq!(Statistic::RootMeanSquare.of(&signal), 5.0);
        assert_eq!(Statistic::SoFar.of(&signal), 5.0);
        assert_eq!(Statistic::RootMeanSquare.of(&[]), 0.0);
    }
}
