//! Functions of numbers, applied element by element to vectors and matrices; all from `libm`.

use std::any::TypeId;
use std::f64::consts::{PI, TAU};

use rhai::{Dynamic, INT};

use super::budget::Meter;
use super::library::Library;
use super::mistake::{Problem, fault};
use super::operand::{Operand, as_number, as_whole, number, vector};
use super::words::{self, describe};
use crate::submission::answer::NOT_A_NUMBER;

type Unary = fn(f64) -> f64;
type Binary = fn(f64, f64) -> f64;

/// A test for numbers without a real result, and the valid numbers in words.
type Domain = Option<(fn(f64) -> bool, &'static str)>;

const UNIT_INTERVAL: Domain = Some((|x| x.abs() > 1.0, "a number from -1 to 1"));
const NOT_NEGATIVE: Domain = Some((|x| x < 0.0, "a number from 0"));

/// Functions of one number.
const UNARY: &[(&str, Unary, Domain)] = &[
    ("sin", libm::sin, None),
    ("cos", libm::cos, None),
    ("tan", libm::tan, None),
    ("asin", libm::asin, UNIT_INTERVAL),
    ("acos", libm::acos, UNIT_INTERVAL),
    ("atan", libm::atan, None),
    ("sinh", libm::sinh, None),
    ("cosh", libm::cosh, None),
    ("tanh", libm::tanh, None),
    ("exp", libm::exp, None),
    ("ln", libm::log, NOT_NEGATIVE),
    ("log10", libm::log10, NOT_NEGATIVE),
    ("log2", libm::log2, NOT_NEGATIVE),
    ("sqrt", f64::sqrt, NOT_NEGATIVE),
    ("deg", f64::to_degrees, None),
    ("rad", f64::to_radians, None),
    ("wrap_pi", wrap_pi, None),
    ("quintic", quintic, None),
    ("quintic_rate", quintic_rate, None),
];

/// Functions of one number that give integers for integers.
const ROUNDING: &[(&str, Unary)] = &[
    ("abs", f64::abs),
    ("sign", sign),
    ("floor", f64::floor),
    ("ceil", f64::ceil),
    ("round", f64::round),
    ("trunc", f64::trunc),
];

/// Functions of two numbers.
const BINARY: &[(&str, Binary)] = &[
    ("atan2", libm::atan2),
    ("hypot", libm::hypot),
    ("pow", libm::pow),
    ("max", larger),
    ("min", smaller),
];

/// Numbers with a name, in functions too.
pub(super) const CONSTANTS: &[(&str, f64)] = &[("pi", PI), ("PI", PI), ("inf", f64::INFINITY)];

pub(super) fn register(library: &mut Library) {
    for &(name, function, domain) in UNARY {
        let apply = move |meter: &Meter, arguments: &mut [&mut Dynamic]| {
            each(meter, name, function, domain, arguments[0])
        };
        library.function(name, 1, apply);
        library.shortcut(name, &[TypeId::of::<f64>()], apply);
        library.shortcut(name, &[TypeId::of::<INT>()], apply);
    }
    for &(name, function) in ROUNDING {
        let apply = move |meter: &Meter, arguments: &mut [&mut Dynamic]| {
            let result = each(meter, name, function, None, arguments[0])?;
            // a rounded number is used as a count or an index, so it becomes an integer if it fits
            let keeps_fraction = matches!(name, "abs" | "sign") && !arguments[0].is_int();
            match as_whole(&result) {
                Some(whole) if !keeps_fraction => Ok(Dynamic::from_int(whole)),
                _ => Ok(result),
            }
        };
        library.function(name, 1, apply);
        library.shortcut(name, &[TypeId::of::<f64>()], apply);
    }
    for &(name, function) in BINARY {
        let apply = move |meter: &Meter, arguments: &mut [&mut Dynamic]| {
            each_pair(meter, name, function, arguments[0], arguments[1])
        };
        library.function(name, 2, apply);
        let numbers = [TypeId::of::<f64>(), TypeId::of::<INT>()];
        for left in numbers {
            for right in numbers {
                library.shortcut(name, &[left, right], apply);
            }
        }
    }
    register_others(library);
}

fn register_others(library: &mut Library) {
    for name in ["pi", "PI"] {
        library.function(name, 0, |_, _| Ok(PI.into()));
    }
    library.function("round", 2, |meter, arguments| {
        let digits = number("round", arguments[1])?.clamp(0.0, 15.0);
        let scale = libm::pow(10.0, digits.trunc());
        let round = |x: f64| {
            let scaled = x * scale;
            // a number that large has no decimals to round
            if scaled.is_finite() {
                scaled.round() / scale
            } else {
                x
            }
        };
        each(meter, "round", round, None, arguments[0])
    });
    for (name, function) in [("max", larger as Binary), ("min", smaller)] {
        library.function(name, 1, move |meter, arguments| {
            if as_number(arguments[0]).is_some() {
                return Ok(arguments[0].clone());
            }
            let vector = vector(name, arguments[0])?;
            meter.charge(vector.len())?;
            vector
                .elements()
                .iter()
                .copied()
                .reduce(function)
                .map(Dynamic::from)
                .ok_or_else(|| fault(format!("`{name}` of an empty vector")))
        });
        library.function(name, 3, move |meter, arguments| {
            let first = each_pair(meter, name, function, arguments[0], arguments[1])?;
            each_pair(meter, name, function, &first, arguments[2])
        });
    }
    for (name, holds) in [
        ("is_nan", f64::is_nan as fn(f64) -> bool),
        ("is_finite", f64::is_finite),
    ] {
        library.function(name, 1, move |_, arguments| {
            Ok(holds(number(name, arguments[0])?).into())
        });
    }
    library.function("clamp", 3, |meter, arguments| {
        if let (Some(low), Some(high)) = (as_number(arguments[1]), as_number(arguments[2]))
            && low > high
        {
            return Err(fault(format!(
                "`clamp` from {} to {}: the lower end is above the upper",
                words::number(low),
                words::number(high)
            )));
        }
        let raised = each_pair(meter, "clamp", larger, arguments[0], arguments[1])?;
        each_pair(meter, "clamp", smaller, &raised, arguments[2])
    });
    library.function("lerp", 3, |meter, arguments| {
        let s = number("lerp", arguments[2])?;
        each_pair(
            meter,
            "lerp",
            |a, b| a + (b - a) * s,
            arguments[0],
            arguments[1],
        )
    });
}

/// Applies a function to a number, or to each element.
fn each(
    meter: &Meter,
    name: &str,
    function: impl Fn(f64) -> f64,
    domain: Domain,
    value: &Dynamic,
) -> Result<Dynamic, Problem> {
    let operand = Operand::of(value);
    // a transcendental function takes about as long as an operation
    meter.charge(8 * operand.elements().saturating_sub(1))?;
    if let Some((outside, range)) = domain {
        let refused = match &operand {
            Operand::Vector(vector) => vector.elements().iter().copied().find(|x| outside(*x)),
            Operand::Matrix(matrix) => matrix.elements().find(|x| outside(*x)),
            other => other.number().filter(|x| outside(*x)),
        };
        if let Some(x) = refused {
            meter.note_not_a_number(|| {
                format!(
                    "`{name}` takes {range}, got {}: {NOT_A_NUMBER}",
                    words::number(x)
                )
            });
        }
    }
    Ok(match operand {
        Operand::Int(whole) => function(whole as f64).into(),
        Operand::Float(x) => function(x).into(),
        Operand::Vector(vector) => Dynamic::from(vector.map(function)),
        Operand::Matrix(matrix) => Dynamic::from(matrix.map(function)),
        Operand::Other => {
            return Err(fault(format!(
                "`{name}` takes a number or a vector, got {}",
                describe(value)
            )));
        }
    })
}

/// Applies a function to two numbers, to the elements of two vectors, or to each element and a number.
fn each_pair(
    meter: &Meter,
    name: &str,
    function: impl Fn(f64, f64) -> f64,
    left: &Dynamic,
    right: &Dynamic,
) -> Result<Dynamic, Problem> {
    if let (Ok(a), Ok(b)) = (left.as_int(), right.as_int()) {
        let result = function(a as f64, b as f64);
        return Ok(match as_whole(&result.into()) {
            // `max(1, 2)` is an integer, `hypot(3, 4)` may be one
            Some(whole) => Dynamic::from_int(whole),
            None => result.into(),
        });
    }
    let (a, b) = (Operand::of(left), Operand::of(right));
    meter.charge(8 * a.elements().max(b.elements()).saturating_sub(1))?;
    match (&a, &b) {
        (Operand::Vector(a), Operand::Vector(b)) if a.len() == b.len() => {
            let pairs = a.elements().iter().zip(b.elements());
            Ok(Dynamic::from(
                pairs
                    .map(|(a, b)| function(*a, *b))
                    .collect::<super::vector::Vector>(),
            ))
        }
        (Operand::Vector(a), _) if b.number().is_some() => {
            let b = b.number().unwrap_or_default();
            Ok(Dynamic::from(a.map(|a| function(a, b))))
        }
        (_, Operand::Vector(b)) if a.number().is_some() => {
            let a = a.number().unwrap_or_default();
            Ok(Dynamic::from(b.map(|b| function(a, b))))
        }
        _ => match (a.number(), b.number()) {
            (Some(a), Some(b)) => Ok(function(a, b).into()),
            _ => Err(fault(format!(
                "`{name}` takes numbers, or vectors of the same length, got {} and {}",
                describe(left),
                describe(right)
            ))),
        },
    }
}

/// The angle in (-π, π] that differs by full turns.
fn wrap_pi(angle: f64) -> f64 {
    if angle > -PI && angle <= PI {
        return angle;
    }
    let rest = libm::fmod(angle, TAU);
    if rest > PI {
        rest - TAU
    } else if rest <= -PI {
        rest + TAU
    } else {
        rest
    }
}

/// From 0 to 1 as `s` goes from 0 to 1, at rest at both ends with no acceleration; constant outside.
///
/// Source: Lynch & Park, *Modern Robotics* (2017), section 9.2.2.2, quintic time scaling.
fn quintic(s: f64) -> f64 {
    let s = s.clamp(0.0, 1.0);
    s * s * s * (10.0 + s * (-15.0 + 6.0 * s))
}

/// The derivative of [`quintic`] by `s`.
fn quintic_rate(s: f64) -> f64 {
    let s = s.clamp(0.0, 1.0);
    30.0 * s * s * (1.0 - s) * (1.0 - s)
}

fn sign(x: f64) -> f64 {
    if x > 0.0 {
        1.0
    } else if x < 0.0 {
        -1.0
    } else {
        x
    }
}

/// The larger of two numbers, NaN if either is.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// The smaller of two numbers, NaN if either is.
fn smaller(a: f64, b: f64) -> f64 {
    if a.is_nan() || a < b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        // seven turns and a bit; fmod is exact, so the error is that of 14π itself
        assert!((wrap_pi(7.0 * TAU + 0.5) - 0.5).abs() < 1e-14);
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

    #[test]
    fn not_a_number_is_neither_hidden_by_max_nor_by_min() {
        assert!(larger(f64::NAN, 1.0).is_nan() && larger(1.0, f64::NAN).is_nan());
        assert!(smaller(f64::NAN, 1.0).is_nan() && smaller(1.0, f64::NAN).is_nan());
    }
}
