//! Powers of dense square matrices by plain loops, whose bits are the same on every processor: the exponential, and the spectral
//! radius with the mode that has it.

use nalgebra::DMatrix;

/// Squarings of a matrix for its spectral radius: the power is then 2^40, and the error of the norm is below 1e-10.
const SQUARINGS: i32 = 40;

/// Roots may be this far outside the unit circle and still count as on it: rounding splits the double root of an uncontrolled joint by
/// about 1e-8. A mode at this bound takes two hours at 1 kHz to double.
const MARGIN: f64 = 1e-7;

/// Terms of the Taylor series: with arguments up to one half the rest is below 1e-18.
const TERMS: u32 = 15;

/// `a b`, both square of the same size.
pub(super) fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let n = a.nrows();
    let mut out = DMatrix::zeros(n, n);
    for (column, out) in b
        .as_slice()
        .chunks_exact(n)
        .zip(out.as_mut_slice().chunks_exact_mut(n))
    {
        for (factor, a) in column.iter().zip(a.as_slice().chunks_exact(n)) {
            if *factor != 0.0 {
                for (out, a) in out.iter_mut().zip(a) {
                    *out += factor * a;
                }
            }
        }
    }
    out
}

/// Root of the sum of squares.
fn norm(a: &DMatrix<f64>) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The exponential, by scaling, Taylor series and squaring; `None` where it is not finite.
pub(in crate::control) fn exponential(a: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let n = a.nrows();
    let (mut scaled, mut halvings) = (a.clone(), 0);
    let mut size = norm(a);
    if !size.is_finite() {
        return None;
    }
    while size > 0.5 {
        size *= 0.5;
        scaled *= 0.5;
        halvings += 1;
    }
    // Horner: 1 + a (1 + a/2 (1 + a/3 (...)))
    let mut sum = DMatrix::identity(n, n);
    for term in (1..=TERMS).rev() {
        sum = product(&scaled, &sum) / f64::from(term);
        for i in 0..n {
            sum[(i, i)] += 1.0;
        }
    }
    for _ in 0..halvings {
        sum = product(&sum, &sum);
    }
    sum.iter().all(|x| x.is_finite()).then_some(sum)
}

/// The powers `a^(2^k)` of a matrix, each scaled to norm one.
struct Powers {
    scaled: DMatrix<f64>,
    /// Logarithm of the norm of the power, and its exponent.
    log_norm: f64,
    exponent: f64,
}

impl Powers {
    /// `None` if a norm is zero, which is a radius of zero, or not finite.
    fn new(a: &DMatrix<f64>) -> Option<Self> {
        let mut powers = Self {
            scaled: a.clone(),
            log_norm: 0.0,
            exponent: 1.0,
        };
        powers.normalize().then_some(powers)
    }

    fn normalize(&mut self) -> bool {
        let norm = norm(&self.scaled);
        self.scaled /= norm;
        self.log_norm += libm::log(norm);
        norm > 0.0 && norm.is_finite()
    }

    fn square(&mut self) -> bool {
        self.scaled = product(&self.scaled, &self.scaled);
        self.log_norm *= 2.0;
        self.exponent *= 2.0;
        self.normalize()
    }
}

/// The largest modulus of an eigenvalue, and a matrix whose columns span the modes that have it.
///
/// Zero and no mode where a power vanishes. `None` where an entry is not finite.
///
/// Source: Gelfand's formula, `ρ = lim ‖aᵏ‖^(1/k)`, by repeated squaring: it always ends, and rounding of the later squarings
/// hardly counts.
pub(super) fn spectral_radius(a: &DMatrix<f64>) -> Option<(f64, DMatrix<f64>)> {
    if !norm(a).is_finite() {
        return None;
    }
    let vanished = || Some((0.0, DMatrix::zeros(a.nrows(), a.nrows())));
    let Some(mut powers) = Powers::new(a) else {
        return vanished();
    };
    for _ in 0..SQUARINGS {
        if !powers.square() {
            return vanished();
        }
    }
    let radius = libm::exp(powers.log_norm / powers.exponent);
    Some((radius, powers.scaled))
}

/// Whether no eigenvalue lies outside the unit circle (by more than a margin of rounding); false where an entry is not finite.
pub(super) fn is_stable(a: &DMatrix<f64>) -> bool {
    if !norm(a).is_finite() {
        return false;
    }
    let Some(mut powers) = Powers::new(&(a / (1.0 + MARGIN))) else {
        return true;
    };
    let log_size = libm::log(a.nrows() as f64);
    for _ in 0..SQUARINGS {
        // a norm below one bounds the radius from above, a trace beyond the size from below
        if powers.log_norm < 0.0 {
            return true;
        }
        if powers.log_norm + libm::log(powers.scaled.trace().abs()) > log_size {
            return false;
        }
        if !powers.square() {
            return true;
        }
    }
    powers.log_norm < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers in (-1, 1) from a seed.
    fn drawn(seed: u64, n: usize) -> DMatrix<f64> {
        let mut numbers = crate::random::SplitMix64::new(seed);
        DMatrix::from_fn(n, n, |_, _| numbers.normal())
    }

    #[test]
    fn the_exponential_of_a_turn_a_decay_and_a_drift() {
        let a = DMatrix::from_row_slice(
            4,
            4,
            &[
                0.0, -30.0, 0.0, 0.0, //
                30.0, 0.0, 0.0, 0.0, //
                0.0, 0.0, -7.0, 2.0, //
                0.0, 0.0, 0.0, 0.0,
            ],
        );
        let e = exponential(&a).unwrap();
        let (s, c) = libm::sincos(30.0);
        let decay = libm::exp(-7.0);
        let expected = DMatrix::from_row_slice(
            4,
            4,
            &[
                c,
                -s,
                0.0,
                0.0, //
                s,
                c,
                0.0,
                0.0, //
                0.0,
                0.0,
                decay,
                2.0 * (1.0 - decay) / 7.0, //
                0.0,
                0.0,
                0.0,
                1.0,
            ],
        );
        // seven squarings of numbers near one, each a few roundings
        assert!((e - expected).amax() < 1e-13);
        assert_eq!(
            exponential(&DMatrix::zeros(2, 2)),
            Some(DMatrix::identity(2, 2))
        );
        assert_eq!(exponential(&DMatrix::from_element(1, 1, 1e6)), None);
        assert_eq!(exponential(&DMatrix::from_element(1, 1, f64::NAN)), None);
    }

    #[test]
    fn the_radius_is_that_of_the_eigenvalues() {
        for seed in 0..40 {
            let a = drawn(seed, 1 + (seed as usize) % 9);
            let by_schur = a.complex_eigenvalues();
            let expected = by_schur
                .iter()
                .fold(0.0, |most: f64, root| most.max(root.norm()));
            let (radius, _) = spectral_radius(&a).unwrap();
            // rounding times the condition of the roots of matrices drawn at random
            assert!(
                (radius - expected).abs() < 1e-11 * expected,
                "{seed}: {radius} {expected}"
            );
            let scaled = |to: f64| &a * (to / expected);
            assert!(is_stable(&scaled(1.0 - 1e-6)), "{seed}");
            assert!(!is_stable(&scaled(1.0 + 1e-6)), "{seed}");
        }
    }

    #[test]
    fn special_matrices() {
        // deadbeat: the square vanishes
        let nilpotent = DMatrix::from_row_slice(2, 2, &[0.0, 1e6, 0.0, 0.0]);
        assert_eq!(spectral_radius(&nilpotent).unwrap().0, 0.0);
        assert!(is_stable(&nilpotent));
        // a double root on the circle grows linearly in time, which does not count as instability
        let drift = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 0.0, 1.0]);
        assert!((spectral_radius(&drift).unwrap().0 - 1.0).abs() < 1e-10);
        assert!(is_stable(&drift));
        // two roots of the same modulus, and minus one
        let turn = DMatrix::from_row_slice(2, 2, &[0.0, -1.5, 1.5, 0.0]);
        // the norm of the power is not its radius: log(2)/2 over 2^40
        assert!((spectral_radius(&turn).unwrap().0 - 1.5).abs() < 1e-11);
        assert!(!is_stable(&turn));
        assert!(!is_stable(&DMatrix::from_element(1, 1, -1.0 - 1e-6)));
        assert!(is_stable(&DMatrix::zeros(3, 3)));
        let broken = DMatrix::from_element(2, 2, f64::NAN);
        assert!(spectral_radius(&broken).is_none() && !is_stable(&broken));
    }

    #[test]
    fn the_mode_is_that_of_the_largest_root() {
        // roots 0.5 and -2, the second along (1, -3)
        let basis = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 1.0, -3.0]);
        let roots = DMatrix::from_row_slice(2, 2, &[0.5, 0.0, 0.0, -2.0]);
        let a = product(
            &product(&basis, &roots),
            &basis.clone().try_inverse().unwrap(),
        );
        let (radius, mode) = spectral_radius(&a).unwrap();
        assert!((radius - 2.0).abs() < 1e-11);
        assert!((mode[(1, 0)] + 3.0 * mode[(0, 0)]).abs() < 1e-14);
    }
}
