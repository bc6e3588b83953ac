//! Functions of numbers with the bits that scripts get: those of `math.h`, which Kinemark computes, and those that scripts have besides.
//!
//! What a number does by itself needs no function here: `x.abs()`, `x.min(y)`, `x.max(y)`, `x.clamp(low, high)`, `x.to_radians()`.

use core::f64::consts::{PI, TAU};

macro_rules! functions {
    ($($(#[$doc:meta])* $name:ident($($argument:ident),+) = $c_name:literal;)+) => {
        // without the attribute, as in an author's own tests, they are those of the system's C library
        #[cfg_attr(target_arch = "wasm32", link(wasm_import_module = "env"))]
        unsafe extern "C" {
            $($(#[$doc])* #[link_name = $c_name] pub safe fn $name($($argument: f64),+) -> f64;)+
        }

        #[cfg(test)]
        const C_NAMES: &[&str] = &[$($c_name),+];
    };
}

functions! {
    /// The angle in \[0, π\] whose cosine is `x`; NaN outside of \[-1, 1\].
    acos(x) = "acos";
    /// The inverse of [`cosh`]; NaN below 1.
    acosh(x) = "acosh";
    /// The angle in \[-π/2, π/2\] whose sine is `x`; NaN outside of \[-1, 1\].
    asin(x) = "asin";
    /// The inverse of [`sinh`].
    asinh(x) = "asinh";
    /// The angle in (-π/2, π/2) whose tangent is `x`.
    atan(x) = "atan";
    /// The angle in \[-π, π\] from the x axis to the point (`x`, `y`): `y` comes first.
    atan2(y, x) = "atan2";
    /// The inverse of [`tanh`].
    atanh(x) = "atanh";
    /// The cube root.
    cbrt(x) = "cbrt";
    /// The smallest integer that is not less than `x`.
    ceil(x) = "ceil";
    /// The cosine of an angle \[rad\].
    cos(x) = "cos";
    /// The hyperbolic cosine.
    cosh(x) = "cosh";
    /// e to the power of `x`.
    exp(x) = "exp";
    /// 2 to the power of `x`.
    exp2(x) = "exp2";
    /// `exp(x) - 1`, exact near 0.
    exp_m1(x) = "expm1";
    /// The largest integer that is not more than `x`.
    floor(x) = "floor";
    /// The remainder of `x / y` with the sign of `x`: what `x % y` is, in fewer instructions.
    fmod(x, y) = "fmod";
    /// The root of `x² + y²`.
    hypot(x, y) = "hypot";
    /// The natural logarithm; NaN below 0.
    ln(x) = "log";
    /// `ln(1 + x)`, exact near 0.
    ln_1p(x) = "log1p";
    /// The logarithm to base 10; NaN below 0.
    log10(x) = "log10";
    /// The logarithm to base 2; NaN below 0.
    log2(x) = "log2";
    /// `x` to the power of `y`.
    pow(x, y) = "pow";
    /// The nearest integer; halves go away from 0.
    round(x) = "round";
    /// The sine of an angle \[rad\].
    sin(x) = "sin";
    /// The hyperbolic sine.
    sinh(x) = "sinh";
    /// The square root; NaN below 0.
    sqrt(x) = "sqrt";
    /// The tangent of an angle \[rad\].
    tan(x) = "tan";
    /// The hyperbolic tangent.
    tanh(x) = "tanh";
    /// `x` without what stands after its point.
    trunc(x) = "trunc";
}

/// The angle in (-π, π] that differs from `angle` by full turns \[rad\].
pub fn wrap_pi(angle: f64) -> f64 {
    if angle > -PI && angle <= PI {
        return angle;
    }
    let rest = fmod(angle, TAU);
    if rest > PI {
        rest - TAU
    } else if rest <= -PI {
        rest + TAU
    } else {
        rest
    }
}

/// From `a` to `b` as `s` goes from 0 to 1, and straight on outside.
pub fn lerp(a: f64, b: f64, s: f64) -> f64 {
    a + (b - a) * s
}

/// From 0 to 1 as `s` goes from 0 to 1, at rest at both ends with no acceleration; constant outside.
///
/// Source: Lynch & Park, *Modern Robotics* (2017), section 9.2.2.2, quintic time scaling.
pub fn quintic(s: f64) -> f64 {
    let s = s.clamp(0.0, 1.0);
    s * s * s * (10.0 + s * (-15.0 + 6.0 * s))
}

/// The derivative of [`quintic`] by `s`.
pub fn quintic_rate(s: f64) -> f64 {
    let s = s.clamp(0.0, 1.0);
    30.0 * s * s * (1.0 - s) * (1.0 - s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// What of `math.h` a number has by itself.
    const INHERENT: [&str; 4] = ["copysign", "fabs", "fmax", "fmin"];

    #[test]
    fn every_function_of_the_header_is_there() {
        let header = include_str!("../../c/kinemark.h");
        let (_, from) = header.split_once("/* Functions of math.h").expect("math.h");
        let (functions, _) = from.split_once("/*").expect("the next heading");
        let named: BTreeSet<&str> = functions
            .split_once("*/")
            .expect("the end of the comment")
            .1
            .split("(double")
            .filter_map(|before| before.rsplit([' ', ',', '\n']).next())
            .filter(|name| !name.is_empty() && !name.starts_with(')'))
            .collect();
        let here: BTreeSet<&str> = C_NAMES.iter().chain(&INHERENT).copied().collect();
        assert_eq!(named, here);
    }

    #[test]
    fn angles_wrap_into_one_turn_with_pi_inside() {
        for (angle, wrapped) in [
            (0.0, 0.0),
            (PI, PI),
            (-PI, PI),
            (3.0, 3.0),
            (4.0, 4.0 - TAU),
            (-4.0, TAU - 4.0),
        ] {
            assert_eq!(wrap_pi(angle).to_bits(), f64::to_bits(wrapped), "{angle}");
        }
    }

    #[test]
    fn a_quintic_starts_and_ends_at_rest() {
        for (s, value, rate) in [
            (-1.0, 0.0, 0.0),
            (0.0, 0.0, 0.0),
            (0.5, 0.5, 1.875),
            (1.0, 1.0, 0.0),
            (2.0, 1.0, 0.0),
        ] {
            assert!((quintic(s) - value).abs() < 1e-15, "{s}");
            assert!((quintic_rate(s) - rate).abs() < 1e-15, "{s}");
        }
    }
}
