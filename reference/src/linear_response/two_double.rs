//! Real and complex numbers of about 32 decimal digits, each real held as the unevaluated sum of two doubles.
//!
//! Roots that nearly meet cost half the digits of a double (a third each for three); with twice the digits, what is
//! left is still a double's worth. Only `+ - * /` are needed, so there is no rounding that a platform could choose.
//!
//! Source: Dekker, *A floating-point technique for extending the available precision* (1971).

use std::ops::{Add, Div, Mul, Neg, Sub};

use nalgebra::Complex;

/// Unit round-off of the arithmetic below, with a margin: products lose a few of the 106 bits.
pub(super) const ROUND_OFF: f64 = 1e-31;

/// A real number `high + low`, where `low` is at most half a unit in the last place of `high`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TwoDouble {
    high: f64,
    low: f64,
}

impl TwoDouble {
    pub(super) const ZERO: Self = Self::exact(0.0);

    pub(super) const fn exact(value: f64) -> Self {
        Self {
            high: value,
            low: 0.0,
        }
    }

    pub(super) fn rounded(self) -> f64 {
        self.high
    }

    /// The sum of `large` and `small`, where `large` is not the smaller in magnitude.
    fn quick_sum(large: f64, small: f64) -> Self {
        let high = large + small;
        Self {
            high,
            low: small - (high - large),
        }
    }

    fn sum_of(a: f64, b: f64) -> Self {
        let high = a + b;
        let b_part = high - a;
        Self {
            high,
            low: (a - (high - b_part)) + (b - b_part),
        }
    }

    fn product_of(a: f64, b: f64) -> Self {
        let high = a * b;
        let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
        Self {
            high,
            low: ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2,
        }
    }
}

/// Splits a double in two of 26 bits each, whose products are exact.
fn halves(value: f64) -> (f64, f64) {
    let scaled = 134_217_729.0 * value; // 2^27 + 1
    let upper = scaled - (scaled - value);
    (upper, value - upper)
}

impl Add for TwoDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let high = Self::sum_of(self.high, other.high);
        let low = Self::sum_of(self.low, other.low);
        let sum = Self::quick_sum(high.high, high.low + low.high);
        Self::quick_sum(sum.high, sum.low + low.low)
    }
}

impl Neg for TwoDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Sub for TwoDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for TwoDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = Self::product_of(self.high, other.high);
        Self::quick_sum(
            product.high,
            product.low + (self.high * other.low + self.low * other.high),
        )
    }
}

impl Div for TwoDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        // long division, three digits of one double each
        let first = self.high / other.high;
        let rest = self - other * Self::exact(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::exact(second);
        let third = rest.high / other.high;
        Self::quick_sum(first, second) + Self::exact(third)
    }
}

/// A complex number of two [`TwoDouble`] parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ComplexTwoDouble {
    pub(super) re: TwoDouble,
    pub(super) im: TwoDouble,
}

impl ComplexTwoDouble {
    pub(super) const ZERO: Self = Self::real(TwoDouble::ZERO);
    pub(super) const ONE: Self = Self::real(TwoDouble::exact(1.0));

    pub(super) const fn real(re: TwoDouble) -> Self {
        Self {
            re,
            im: TwoDouble::ZERO,
        }
    }

    pub(super) const fn exact(re: f64, im: f64) -> Self {
        Self {
            re: TwoDouble::exact(re),
            im: TwoDouble::exact(im),
        }
    }

    pub(super) fn conjugate(self) -> Self {
        Self {
            re: self.re,
            im: -self.im,
        }
    }

    pub(super) fn rounded(self) -> Complex<f64> {
        Complex::new(self.re.rounded(), self.im.rounded())
    }

    /// The magnitude, to a double's accuracy.
    pub(super) fn magnitude(self) -> f64 {
        libm::hypot(self.re.rounded(), self.im.rounded())
    }

    pub(super) fn is_zero(self) -> bool {
        self == Self::ZERO
    }
}

impl Add for ComplexTwoDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            re: self.re + other.re,
            im: self.im + other.im,
        }
    }
}

impl Neg for ComplexTwoDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            re: -self.re,
            im: -self.im,
        }
    }
}

impl Sub for ComplexTwoDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for ComplexTwoDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

impl Mul<TwoDouble> for ComplexTwoDouble {
    type Output = Self;
    fn mul(self, factor: TwoDouble) -> Self {
        Self {
            re: self.re * factor,
            im: self.im * factor,
        }
    }
}

impl Div for ComplexTwoDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        // A power of two brings the divisor near one, so that its square neither overflows nor vanishes.
        let (_, exponent) = libm::frexp(other.magnitude());
        let scale = TwoDouble::exact(libm::ldexp(1.0, -exponent));
        let near_one = other * scale;
        let square = near_one.re * near_one.re + near_one.im * near_one.im;
        let product = self * scale * near_one.conjugate();
        Self {
            re: product.re / square,
            im: product.im / square,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_third_times_three_is_one_to_thirty_digits() {
        let third = TwoDouble::exact(1.0) / TwoDouble::exact(3.0);
        let error = third + third + third - TwoDouble::exact(1.0);
        assert!(error.rounded().abs() < ROUND_OFF, "{error:?}");
    }

    #[test]
    fn a_product_keeps_the_digits_a_double_drops() {
        // (1 + e)(1 - e) = 1 - e², whose second term is far below a double's last place
        let e = 1e-12;
        let product = (TwoDouble::exact(1.0) + TwoDouble::exact(e))
            * (TwoDouble::exact(1.0) - TwoDouble::exact(e));
        let missing = TwoDouble::exact(1.0) - product;
        assert!((missing.rounded() - 1e-24).abs() < ROUND_OFF, "{missing:?}");
    }

    #[test]
    fn a_complex_quotient_returns_its_dividend() {
        let (a, b) = (
            ComplexTwoDouble::exact(0.3, -1.7),
            ComplexTwoDouble::exact(-2e150, 5e150),
        );
        let error = a / b * b - a;
        assert!(error.magnitude() < 4.0 * ROUND_OFF, "{error:?}");
    }
}
