//! Ratios of polynomials in `s`, and their responses to a unit step.

use std::fmt;

use nalgebra::Complex;

use super::exponential_sum::ExponentialSum;
use super::polynomial::{Polynomial, rounded_roots};
use super::two_double::ComplexTwoDouble;

/// A proper rational transfer function with real coefficients.
///
/// Common factors `s` of numerator and denominator are cancelled (a PID without `Ki` has one); other common factors
/// stay, and their share of the response comes out as zero.
#[derive(Debug, Clone, PartialEq)]
pub struct TransferFunction {
    numerator: Polynomial,
    denominator: Polynomial,
}

/// Why two lists of coefficients are not a transfer function with a step response.
#[derive(Debug, Clone, PartialEq)]
pub enum TransferFunctionError {
    /// Every coefficient of the denominator is zero.
    DenominatorIsZero,
    /// The numerator's degree exceeds the denominator's: a step would give an impulse.
    Improper {
        /// The numerator's degree.
        numerator_degree: usize,
        /// The denominator's degree.
        denominator_degree: usize,
    },
    /// A coefficient is infinite or not a number.
    NotFinite {
        /// The coefficient.
        coefficient: f64,
    },
}

impl fmt::Display for TransferFunctionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DenominatorIsZero => write!(f, "every coefficient of the denominator is zero"),
            Self::Improper {
                numerator_degree,
                denominator_degree,
            } => write!(
                f,
                "numerator of degree {numerator_degree} exceeds denominator of degree {denominator_degree}"
            ),
            Self::NotFinite { coefficient } => {
                write!(f, "coefficients must be finite, got {coefficient}")
            }
        }
    }
}

impl std::error::Error for TransferFunctionError {}

impl TransferFunction {
    /// Makes the function from coefficients in descending powers of `s`, which need not be normalised.
    ///
    /// # Errors
    ///
    /// - [`TransferFunctionError::NotFinite`]: a coefficient is infinite or NaN.
    /// - [`TransferFunctionError::DenominatorIsZero`]: nothing to divide by.
    /// - [`TransferFunctionError::Improper`]: the numerator has the higher degree.
    pub fn new(numerator: &[f64], denominator: &[f64]) -> Result<Self, TransferFunctionError> {
        if let Some(&coefficient) = numerator.iter().chain(denominator).find(|a| !a.is_finite()) {
            return Err(TransferFunctionError::NotFinite { coefficient });
        }
        let (numerator, denominator) = (Polynomial::new(numerator), Polynomial::new(denominator));
        if denominator.is_zero() {
            return Err(TransferFunctionError::DenominatorIsZero);
        }
        if numerator.degree() > denominator.degree() {
            return Err(TransferFunctionError::Improper {
                numerator_degree: numerator.degree(),
                denominator_degree: denominator.degree(),
            });
        }
        if numerator.is_zero() {
            return Ok(Self {
                numerator,
                denominator: Polynomial::new(&[1.0]),
            });
        }
        let common = numerator.roots_at_zero().min(denominator.roots_at_zero());
        Ok(Self {
            numerator: numerator.without_roots_at_zero(common),
            denominator: denominator.without_roots_at_zero(common),
        })
    }

    /// Coefficients of the numerator in descending powers of `s`, without leading zeros; empty for the zero function.
    pub fn numerator(&self) -> &[f64] {
        self.numerator.coefficients()
    }

    /// Coefficients of the denominator in descending powers of `s`, without leading zeros.
    pub fn denominator(&self) -> &[f64] {
        self.denominator.coefficients()
    }

    /// Poles \[1/s\] with multiplicity, by rising real part, then falling imaginary part.
    ///
    /// Right to a double's accuracy for single and double poles, to about 1e-10 of the magnitude for triple ones.
    pub fn poles(&self) -> Vec<Complex<f64>> {
        rounded_roots(&self.denominator.roots())
    }

    /// Zeros \[1/s\] with multiplicity, in the order and accuracy of [`Self::poles`].
    pub fn zeros(&self) -> Vec<Complex<f64>> {
        rounded_roots(&self.numerator.roots())
    }

    /// Whether every pole has a negative real part; one on the imaginary axis is not stable.
    pub fn is_stable(&self) -> bool {
        self.poles().iter().all(|pole| pole.re < 0.0)
    }

    /// The value at `s = 0`; `None` with a pole there. It is the steady state of a unit step only if stable.
    pub fn dc_gain(&self) -> Option<f64> {
        let at_zero = self.denominator.coefficient(0);
        (at_zero != 0.0).then(|| self.numerator.coefficient(0) / at_zero)
    }

    /// The unit step response just after the step: the value for infinite `s`, zero where strictly proper.
    pub fn value_at_0plus(&self) -> f64 {
        let degree = self.denominator.degree();
        self.numerator.coefficient(degree) / self.denominator.coefficient(degree)
    }

    /// The response to a unit step at `t = 0` from rest.
    pub fn step_response(&self) -> StepResponse {
        let leading = self.denominator.coefficient(self.denominator.degree());
        let mut poles = self.denominator.roots();
        let dc_gain = self.dc_gain();
        // The step's own pole at zero gives the constant, unless it meets one of the function.
        let step_pole = ComplexTwoDouble::ZERO;
        poles.push(step_pole);
        let left_out = dc_gain.map(|_| step_pole);
        let varying = ExponentialSum::new(self.numerator(), leading, &poles, left_out);
        StepResponse {
            constant: dc_gain.unwrap_or(0.0),
            slope: varying.differentiated(),
            varying,
            value_at_0plus: self.value_at_0plus(),
            steady_state: dc_gain.filter(|_| self.is_stable()),
        }
    }
}

/// The response of a transfer function to a unit step, in closed form.
#[derive(Debug, Clone)]
pub struct StepResponse {
    constant: f64,
    pub(super) varying: ExponentialSum,
    slope: ExponentialSum,
    value_at_0plus: f64,
    steady_state: Option<f64>,
}

impl StepResponse {
    /// The response at `t_s`, in units of output per unit of input; zero before the step, [`Self::value_at_0plus`] at it.
    ///
    /// An unstable response that exceeds a double's range is given as infinity, without its sign.
    pub fn value(&self, t_s: f64) -> f64 {
        if t_s < 0.0 {
            0.0
        } else if t_s == 0.0 {
            self.value_at_0plus
        } else if t_s == f64::INFINITY {
            self.steady_state.unwrap_or(f64::INFINITY)
        } else {
            infinite_if_overflowed(self.constant + self.varying.value(t_s))
        }
    }

    /// The time derivative of the response at `t_s` \[1/s\], from the right at the step; zero before it.
    pub fn slope(&self, t_s: f64) -> f64 {
        if t_s < 0.0 {
            0.0
        } else {
            infinite_if_overflowed(self.slope.value(t_s))
        }
    }

    /// The value just after the step, zero where the function is strictly proper.
    pub fn value_at_0plus(&self) -> f64 {
        self.value_at_0plus
    }

    /// What the response tends to; `None` where a pole is not stable.
    pub fn steady_state(&self) -> Option<f64> {
        self.steady_state
    }
}

fn infinite_if_overflowed(value: f64) -> f64 {
    if value.is_nan() { f64::INFINITY } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(numerator: &[f64], denominator: &[f64]) -> StepResponse {
        TransferFunction::new(numerator, denominator)
            .unwrap()
            .step_response()
    }

    #[test]
    fn refuses_what_is_no_transfer_function() {
        assert_eq!(
            TransferFunction::new(&[1.0], &[0.0]),
            Err(TransferFunctionError::DenominatorIsZero)
        );
        let improper = TransferFunction::new(&[1.0, 0.0, 0.0], &[1.0, 1.0]).unwrap_err();
        assert_eq!(
            improper.to_string(),
            "numerator of degree 2 exceeds denominator of degree 1"
        );
        assert!(TransferFunction::new(&[f64::NAN], &[1.0]).is_err());
    }

    #[test]
    fn common_factors_of_s_cancel() {
        let function = TransferFunction::new(&[2.0, 8.0, 0.0], &[1.0, 3.0, 4.0, 0.0]).unwrap();
        assert_eq!(function.numerator(), [2.0, 8.0]);
        assert_eq!(function.denominator(), [1.0, 3.0, 4.0]);
        assert_eq!(function.dc_gain(), Some(2.0));
        assert!(function.is_stable());
    }

    #[test]
    fn the_zero_function_stays_at_zero() {
        let response = step(&[0.0], &[1.0, 0.0]);
        assert_eq!((response.value(0.0), response.value(3.0)), (0.0, 0.0));
        assert_eq!(response.steady_state(), Some(0.0));
    }

    #[test]
    fn a_gain_is_constant() {
        let response = step(&[3.0], &[2.0]);
        assert_eq!((response.value(0.0), response.value(5.0)), (1.5, 1.5));
        assert_eq!((response.value(-1.0), response.slope(5.0)), (0.0, 0.0));
    }

    #[test]
    fn two_integrators_give_a_parabola() {
        let response = step(&[1.0], &[1.0, 0.0, 0.0]);
        for t in [0.0, 0.3, 2.0, 1e4] {
            let error = response.value(t) - t * t / 2.0;
            assert!(error.abs() <= 1e-15 * t * t, "t={t}: {error}");
        }
        assert_eq!(response.steady_state(), None);
    }

    #[test]
    fn an_integrator_with_a_lag_ramps() {
        // 1/(s(s+1)): t - 1 + e^{-t}
        let response = step(&[1.0], &[1.0, 1.0, 0.0]);
        for t in [0.0, 0.01, 1.0, 30.0] {
            let error = response.value(t) - (t - 1.0 + libm::exp(-t));
            assert!(error.abs() < 1e-14, "t={t}: {error}");
        }
    }

    #[test]
    fn an_exactly_repeated_pole() {
        // 1/(s+2)³, times 8: 1 - e^{-2t}(1 + 2t + 2t²)
        let response = step(&[8.0], &[1.0, 6.0, 12.0, 8.0]);
        for t in [0.0, 0.1, 1.0, 10.0, 400.0] {
            let error =
                response.value(t) - (1.0 - libm::exp(-2.0 * t) * (1.0 + 2.0 * t + 2.0 * t * t));
            assert!(error.abs() < 1e-10, "t={t}: {error}");
        }
    }

    #[test]
    fn the_response_is_continuous_as_poles_meet() {
        // Critically damped and as near to it as a double can be, from both sides, and at the edge of a cluster.
        let exact = |t: f64| 1.0 - libm::exp(-10.0 * t) * (1.0 + 10.0 * t);
        for gap in [0.0, 1e-16, 1e-12, 1e-8, 1e-4, -1e-12, -1e-8] {
            let response = step(&[100.0], &[1.0, 20.0, 100.0 * (1.0 - gap)]);
            for t in [0.0, 0.01, 0.1, 0.5, 3.0] {
                let error = response.value(t) - exact(t);
                assert!(
                    error.abs() <= 2.0 * gap.abs() + 1e-14,
                    "gap {gap}, t={t}: {error}"
                );
            }
        }
    }

    #[test]
    fn an_overflowing_response_is_infinite_and_not_nan() {
        for denominator in [[1.0, -2.0, 5.0], [1.0, -3.0, 2.0], [1.0, -2.0, 1.0]] {
            let value = step(&[1.0], &denominator).value(1e5);
            assert!(value.is_infinite(), "{value}");
        }
    }
}
