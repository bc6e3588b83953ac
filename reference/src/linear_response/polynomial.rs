//! Polynomials with real coefficients, highest power first, and all their roots.

use std::f64::consts::PI;

use nalgebra::Complex;

use super::two_double::{ComplexTwoDouble, ROUND_OFF, TwoDouble};

/// Far beyond need: simple roots converge cubically, a double root gains about half a digit a step.
const MOST_STEPS: usize = 500;

/// A polynomial `a₀ sⁿ + a₁ sⁿ⁻¹ + … + aₙ` whose leading coefficient is not zero; the zero polynomial is empty.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Polynomial {
    descending: Vec<f64>,
}

impl Polynomial {
    /// Takes coefficients in descending powers and drops leading zeros.
    pub(super) fn new(descending: &[f64]) -> Self {
        let first = descending
            .iter()
            .position(|&a| a != 0.0)
            .unwrap_or(descending.len());
        Self {
            descending: descending[first..].to_vec(),
        }
    }

    pub(super) fn coefficients(&self) -> &[f64] {
        &self.descending
    }

    pub(super) fn is_zero(&self) -> bool {
        self.descending.is_empty()
    }

    /// The highest power; 0 for a constant, and also for the zero polynomial.
    pub(super) fn degree(&self) -> usize {
        self.descending.len().saturating_sub(1)
    }

    /// The coefficient of `s^power`, zero above the degree.
    pub(super) fn coefficient(&self, power: usize) -> f64 {
        self.descending
            .iter()
            .rev()
            .nth(power)
            .copied()
            .unwrap_or(0.0)
    }

    /// How many roots lie at exactly zero: the number of trailing zero coefficients.
    pub(super) fn roots_at_zero(&self) -> usize {
        self.descending
            .iter()
            .rev()
            .take_while(|&&a| a == 0.0)
            .count()
    }

    /// Divides by `s^power`, which must not exceed [`Self::roots_at_zero`].
    pub(super) fn without_roots_at_zero(&self, power: usize) -> Self {
        Self {
            descending: self.descending[..self.descending.len() - power].to_vec(),
        }
    }

    /// All roots with multiplicity, by rising real part, then falling imaginary part; complex ones in exact pairs.
    ///
    /// The Ehrlich-Aberth iteration on all roots at once, in twice the digits of a double: a double root is still
    /// right to a double's accuracy, a triple one to about 1e-10 of its magnitude.
    ///
    /// Source: Bini, *Numerical computation of polynomial zeros by means of Aberth's method* (1996).
    pub(super) fn roots(&self) -> Vec<ComplexTwoDouble> {
        let at_zero = self.roots_at_zero();
        let deflated = self.without_roots_at_zero(at_zero);
        let mut roots = deflated.starting_points();
        let mut moving = vec![true; roots.len()];
        for _ in 0..MOST_STEPS {
            for (i, moving) in moving.iter_mut().enumerate().filter(|(_, moving)| **moving) {
                *moving = deflated.improve(&mut roots, i);
            }
            if !moving.contains(&true) {
                break;
            }
        }
        pair_conjugates(&mut roots);
        roots.extend(vec![ComplexTwoDouble::ZERO; at_zero]);
        roots.sort_by(|a, b| {
            let (a, b) = (a.rounded(), b.rounded());
            a.re.total_cmp(&b.re).then(b.im.total_cmp(&a.im))
        });
        roots
    }

    /// Moves root `i` by one Aberth step; false where it can get no better.
    fn improve(&self, roots: &mut [ComplexTwoDouble], i: usize) -> bool {
        let z = roots[i];
        let (value, slope, noise) = self.value_slope_and_noise(z);
        if value.magnitude() <= noise {
            return false;
        }
        let mut repulsion = ComplexTwoDouble::ZERO;
        for (j, &other) in roots.iter().enumerate() {
            // Two guesses that fell on one point do not repel: each then takes Newton's step.
            if j != i && other != z {
                repulsion = repulsion + ComplexTwoDouble::ONE / (z - other);
            }
        }
        let inverse_step = slope / value - repulsion;
        if inverse_step.is_zero() {
            return false;
        }
        let step = ComplexTwoDouble::ONE / inverse_step;
        roots[i] = z - step;
        step.magnitude() > ROUND_OFF * z.magnitude()
    }

    /// Value and slope at `z` by Horner's rule, and a bound on the round-off of the value.
    fn value_slope_and_noise(
        &self,
        z: ComplexTwoDouble,
    ) -> (ComplexTwoDouble, ComplexTwoDouble, f64) {
        let (mut value, mut slope) = (ComplexTwoDouble::ZERO, ComplexTwoDouble::ZERO);
        let (mut size, z_size) = (0.0, z.magnitude());
        for &a in &self.descending {
            slope = slope * z + value;
            value = value * z + ComplexTwoDouble::real(TwoDouble::exact(a));
            size = size * z_size + a.abs();
        }
        (value, slope, size * ROUND_OFF)
    }

    /// First guesses on circles whose radii the Newton polygon of `log |a|` gives: the roots' magnitudes, roughly.
    ///
    /// Roots of one loop can be 10⁷ apart; guesses on a single circle would take long to reach the small ones.
    fn starting_points(&self) -> Vec<ComplexTwoDouble> {
        let log_size: Vec<(f64, f64)> = (self.descending.iter().rev().enumerate())
            .filter(|&(_, &a)| a != 0.0)
            .map(|(power, &a)| (power as f64, libm::log(a.abs())))
            .collect();
        // upper convex hull, left to right
        let mut hull: Vec<(f64, f64)> = Vec::new();
        for point in log_size {
            while let [.., a, b] = hull[..] {
                let above = (b.0 - a.0) * (point.1 - a.1) < (point.0 - a.0) * (b.1 - a.1);
                if above {
                    break;
                }
                hull.pop();
            }
            hull.push(point);
        }
        let mut points = Vec::new();
        for edge in hull.windows(2) {
            let count = edge[1].0 - edge[0].0;
            let radius = libm::exp((edge[0].1 - edge[1].1) / count);
            for k in 0..count as usize {
                // The offset keeps guesses off the real axis, from which a real polynomial could not push them.
                let angle_rad = 2.0 * PI * k as f64 / count + 0.7 + points.len() as f64;
                let (sin, cos) = libm::sincos(angle_rad);
                points.push(ComplexTwoDouble::exact(radius * cos, radius * sin));
            }
        }
        points
    }
}

/// Makes the roots of a real polynomial exactly symmetric about the real axis.
fn pair_conjugates(roots: &mut [ComplexTwoDouble]) {
    let mut unpaired: Vec<usize> = (0..roots.len()).collect();
    while let Some(&i) = unpaired.first() {
        let mirror = roots[i].conjugate();
        let distance = |&j: &usize| (roots[j] - mirror).magnitude();
        let nearest = (unpaired.iter().copied())
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .unwrap_or(i);
        if nearest == i {
            roots[i].im = TwoDouble::ZERO;
        } else {
            roots[i] = (roots[i] + roots[nearest].conjugate()) * TwoDouble::exact(0.5);
            roots[nearest] = roots[i].conjugate();
        }
        unpaired.retain(|&j| j != i && j != nearest);
    }
}

/// Rounds roots to doubles, and a real part that is round-off of the magnitude to zero.
pub(super) fn rounded_roots(roots: &[ComplexTwoDouble]) -> Vec<Complex<f64>> {
    // Coefficients are doubles: a damping ratio below their last place says nothing.
    let damping_floor = 4.0 * f64::EPSILON;
    (roots.iter().map(|root| root.rounded()))
        .map(|z| {
            let undamped = z.re.abs() <= damping_floor * z.im.abs();
            Complex::new(if undamped { 0.0 } else { z.re }, z.im)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn roots_of(descending: &[f64]) -> Vec<Complex<f64>> {
        rounded_roots(&Polynomial::new(descending).roots())
    }

    fn assert_roots(descending: &[f64], expected: &[(f64, f64)], relative: f64) {
        let roots = roots_of(descending);
        assert_eq!(roots.len(), expected.len(), "{roots:?}");
        for (root, &(re, im)) in roots.iter().zip(expected) {
            let size = libm::hypot(re, im);
            let error = libm::hypot(root.re - re, root.im - im);
            assert!(error <= relative * size, "{roots:?} expected {expected:?}");
        }
    }

    #[test]
    fn simple_roots_of_very_different_size() {
        // (s + 1e-8)(s + 1)(s + 1e8); the product's coefficients round, hence not exactly
        let [a, b, c] = [1e-8, 1.0, 1e8];
        assert_roots(
            &[1.0, a + b + c, a * b + b * c + c * a, a * b * c],
            &[(-1e8, 0.0), (-1.0, 0.0), (-1e-8, 0.0)],
            1e-14,
        );
    }

    #[test]
    fn complex_roots_are_exact_conjugates() {
        let roots = roots_of(&[1.0, 2.0, 5.0]);
        assert_roots(&[1.0, 2.0, 5.0], &[(-1.0, 2.0), (-1.0, -2.0)], 1e-15);
        assert_eq!(roots[0], roots[1].conj());
    }

    #[test]
    fn an_undamped_pair_has_no_real_part() {
        assert_roots(&[1.0, 0.0, 9.0], &[(0.0, 3.0), (0.0, -3.0)], 1e-15);
        assert!(roots_of(&[1.0, 0.0, 9.0]).iter().all(|z| z.re == 0.0));
    }

    #[test]
    fn repeated_roots() {
        assert_roots(&[1.0, 20.0, 100.0], &[(-10.0, 0.0); 2], 1e-15);
        assert_roots(&[1.0, 6.0, 12.0, 8.0], &[(-2.0, 0.0); 3], 1e-9);
    }

    #[test]
    fn roots_at_zero_are_exact() {
        assert_roots(
            &[2.0, 6.0, 0.0, 0.0],
            &[(-3.0, 0.0), (0.0, 0.0), (0.0, 0.0)],
            0.0,
        );
    }

    #[test]
    fn constants_have_no_roots() {
        assert!(roots_of(&[3.0]).is_empty());
        assert!(roots_of(&[]).is_empty());
        assert!(roots_of(&[0.0, 0.0]).is_empty());
    }
}
