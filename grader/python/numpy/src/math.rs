//! The module `math`: the functions of one number, with CPython's exceptions.
//!
//! Floats go through the crate `libm`; whole numbers stay Python's own ints, however long they are.

use crate::array::NdArray;
use crate::convert;
use crate::function::{Arguments, Plain};
use crate::ufunc;
use rustpython_vm::{
    AsObject as _, PyObject, PyObjectRef, PyResult, VirtualMachine,
    builtins::{PyBaseExceptionRef, PyFloat, PyInt},
    types::PyComparisonOp,
};

/// The constants.
pub const CONSTANTS: &[(&str, f64)] = &[
    ("pi", std::f64::consts::PI),
    ("e", std::f64::consts::E),
    ("tau", std::f64::consts::TAU),
    ("inf", f64::INFINITY),
    ("nan", f64::NAN),
];

/// The functions.
pub const FUNCTIONS: &[(&str, Plain)] = &[
    ("sin", |arguments, vm| one(arguments, libm::sin, vm)),
    ("cos", |arguments, vm| one(arguments, libm::cos, vm)),
    ("tan", |arguments, vm| one(arguments, libm::tan, vm)),
    ("asin", |arguments, vm| one(arguments, libm::asin, vm)),
    ("acos", |arguments, vm| one(arguments, libm::acos, vm)),
    ("atan", |arguments, vm| one(arguments, libm::atan, vm)),
    ("sinh", |arguments, vm| one(arguments, libm::sinh, vm)),
    ("cosh", |arguments, vm| one(arguments, libm::cosh, vm)),
    ("tanh", |arguments, vm| one(arguments, libm::tanh, vm)),
    ("asinh", |arguments, vm| one(arguments, libm::asinh, vm)),
    ("acosh", |arguments, vm| {
        one(arguments, ufunc::inverse_hyperbolic_cosine, vm)
    }),
    ("atanh", |arguments, vm| {
        one_with_poles(arguments, libm::atanh, vm)
    }),
    ("exp", |arguments, vm| one(arguments, libm::exp, vm)),
    ("exp2", |arguments, vm| one(arguments, libm::exp2, vm)),
    ("expm1", |arguments, vm| one(arguments, libm::expm1, vm)),
    ("log", log),
    ("log2", |arguments, vm| {
        one_with_poles(arguments, libm::log2, vm)
    }),
    ("log10", |arguments, vm| {
        one_with_poles(arguments, libm::log10, vm)
    }),
    ("log1p", |arguments, vm| {
        one_with_poles(arguments, libm::log1p, vm)
    }),
    ("sqrt", |arguments, vm| one(arguments, f64::sqrt, vm)),
    ("cbrt", |arguments, vm| one(arguments, libm::cbrt, vm)),
    ("fabs", |arguments, vm| one(arguments, f64::abs, vm)),
    ("degrees", |arguments, vm| {
        one(
            arguments,
            |value| value * (180.0 / std::f64::consts::PI),
            vm,
        )
    }),
    ("radians", |arguments, vm| {
        one(
            arguments,
            |value| value * (std::f64::consts::PI / 180.0),
            vm,
        )
    }),
    ("erf", |arguments, vm| one(arguments, libm::erf, vm)),
    ("erfc", |arguments, vm| one(arguments, libm::erfc, vm)),
    ("gamma", gamma),
    ("lgamma", lgamma),
    ("ulp", |arguments, vm| {
        one(arguments, unit_in_last_place, vm)
    }),
    ("atan2", |arguments, vm| two(arguments, libm::atan2, vm)),
    ("copysign", |arguments, vm| {
        two(arguments, f64::copysign, vm)
    }),
    ("fmod", |arguments, vm| {
        two(arguments, |left, right| left % right, vm)
    }),
    ("remainder", |arguments, vm| {
        two(arguments, libm::remainder, vm)
    }),
    ("nextafter", |arguments, vm| {
        two(arguments, libm::nextafter, vm)
    }),
    ("pow", pow),
    ("hypot", hypot),
    ("dist", dist),
    ("floor", |arguments, vm| {
        rounded(arguments, f64::floor, "__floor__", vm)
    }),
    ("ceil", |arguments, vm| {
        rounded(arguments, f64::ceil, "__ceil__", vm)
    }),
    ("trunc", |arguments, vm| {
        rounded(arguments, f64::trunc, "__trunc__", vm)
    }),
    ("isnan", |arguments, vm| test(arguments, f64::is_nan, vm)),
    ("isinf", |arguments, vm| {
        test(arguments, f64::is_infinite, vm)
    }),
    ("isfinite", |arguments, vm| {
        test(arguments, f64::is_finite, vm)
    }),
    ("isclose", isclose),
    ("modf", modf),
    ("frexp", frexp),
    ("ldexp", ldexp),
    ("fsum", fsum),
    ("prod", prod),
    ("sumprod", sumprod),
    ("factorial", factorial),
    ("comb", comb),
    ("perm", perm),
    ("gcd", gcd),
    ("lcm", lcm),
    ("isqrt", isqrt),
    ("fma", fma),
];

/// The float that an argument is: a number, or anything with `__float__`.
fn real(object: &PyObject, vm: &VirtualMachine) -> PyResult<f64> {
    if let Some(float) = object.downcast_ref_if_exact::<PyFloat>(vm) {
        return Ok(float.to_f64());
    }
    convert::float(object, vm)
}

fn next(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult<f64> {
    real(arguments.required("x", vm)?.as_object(), vm)
}

fn float(value: f64, vm: &VirtualMachine) -> PyResult {
    Ok(vm.ctx.new_float(value).into())
}

fn domain(vm: &VirtualMachine) -> PyBaseExceptionRef {
    vm.new_value_error("math domain error")
}

fn range(vm: &VirtualMachine) -> PyBaseExceptionRef {
    vm.new_overflow_error("math range error")
}

/// A function of one float: nan out of a number is outside the domain, infinity out of a finite one too large.
fn one(arguments: &mut Arguments, function: fn(f64) -> f64, vm: &VirtualMachine) -> PyResult {
    let value = next(arguments, vm)?;
    let result = function(value);
    if result.is_nan() && !value.is_nan() {
        return Err(domain(vm));
    }
    if result.is_infinite() && value.is_finite() {
        return Err(range(vm));
    }
    float(result, vm)
}

/// As [`one`], for functions that are infinite at the edge of their domain.
fn one_with_poles(
    arguments: &mut Arguments,
    function: fn(f64) -> f64,
    vm: &VirtualMachine,
) -> PyResult {
    let value = next(arguments, vm)?;
    checked_pole(value, function(value), vm)
}

fn checked_pole(value: f64, result: f64, vm: &VirtualMachine) -> PyResult {
    if (result.is_nan() && !value.is_nan()) || (result.is_infinite() && value.is_finite()) {
        return Err(domain(vm));
    }
    float(result, vm)
}

fn two(arguments: &mut Arguments, function: fn(f64, f64) -> f64, vm: &VirtualMachine) -> PyResult {
    let left = next(arguments, vm)?;
    let right = next(arguments, vm)?;
    let result = function(left, right);
    if result.is_nan() && !left.is_nan() && !right.is_nan() {
        return Err(domain(vm));
    }
    float(result, vm)
}

fn test(arguments: &mut Arguments, function: fn(f64) -> bool, vm: &VirtualMachine) -> PyResult {
    let value = next(arguments, vm)?;
    Ok(vm.ctx.new_bool(function(value)).into())
}

fn log(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let value = next(arguments, vm)?;
    let result = libm::log(value);
    match arguments.optional("base", vm) {
        None => checked_pole(value, result, vm),
        Some(base) => {
            checked_pole(value, result, vm)?;
            let base = real(&base, vm)?;
            let divisor = libm::log(base);
            checked_pole(base, divisor, vm)?;
            if divisor == 0.0 {
                return Err(vm.new_zero_division_error("division by zero"));
            }
            float(result / divisor, vm)
        }
    }
}

fn gamma(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let value = next(arguments, vm)?;
    if value == f64::NEG_INFINITY || (value <= 0.0 && value == value.floor()) {
        return Err(domain(vm));
    }
    let result = libm::tgamma(value);
    if result.is_infinite() && value.is_finite() {
        return Err(range(vm));
    }
    float(result, vm)
}

fn lgamma(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let value = next(arguments, vm)?;
    if value.is_finite() && value <= 0.0 && value == value.floor() {
        return Err(domain(vm));
    }
    float(libm::lgamma(value), vm)
}

fn unit_in_last_place(value: f64) -> f64 {
    let size = value.abs();
    if !size.is_finite() {
        return size;
    }
    let next = libm::nextafter(size, f64::INFINITY);
    if next.is_finite() {
        next - size
    } else {
        size - libm::nextafter(size, 0.0)
    }
}

fn pow(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let base = next(arguments, vm)?;
    let exponent = next(arguments, vm)?;
    let result = libm::pow(base, exponent);
    if base.is_finite() && exponent.is_finite() && !result.is_finite() {
        return Err(if result.is_nan() || base == 0.0 {
            domain(vm)
        } else {
            range(vm)
        });
    }
    float(result, vm)
}

/// The length of a vector, scaled so that no square overflows.
fn length(values: &[f64]) -> f64 {
    if values.iter().any(|value| value.is_infinite()) {
        return f64::INFINITY;
    }
    if let [left, right] = values {
        return libm::hypot(*left, *right);
    }
    let largest = values.iter().fold(0.0, |known: f64, value| {
        if known.is_nan() || known >= value.abs() {
            known
        } else {
            value.abs()
        }
    });
    if largest == 0.0 || largest.is_nan() {
        return largest;
    }
    let sum = values.iter().fold(0.0, |sum, value| {
        let share = value / largest;
        sum + share * share
    });
    largest * sum.sqrt()
}

fn reals(objects: &[PyObjectRef], vm: &VirtualMachine) -> PyResult<Vec<f64>> {
    objects.iter().map(|object| real(object, vm)).collect()
}

fn hypot(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let values = reals(&arguments.rest(), vm)?;
    float(length(&values), vm)
}

/// The elements of anything that can be iterated over.
fn elements(object: PyObjectRef, vm: &VirtualMachine) -> PyResult<Vec<PyObjectRef>> {
    object.try_to_value(vm)
}

fn dist(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let left = reals(&elements(arguments.required("p", vm)?, vm)?, vm)?;
    let right = reals(&elements(arguments.required("q", vm)?, vm)?, vm)?;
    if left.len() != right.len() {
        return Err(vm.new_value_error("both points must have the same number of dimensions"));
    }
    let differences: Vec<f64> = left
        .iter()
        .zip(&right)
        .map(|(left, right)| left - right)
        .collect();
    float(length(&differences), vm)
}

fn rounded(
    arguments: &mut Arguments,
    function: fn(f64) -> f64,
    method: &'static str,
    vm: &VirtualMachine,
) -> PyResult {
    let object = arguments.required("x", vm)?;
    if object.downcast_ref::<PyInt>().is_some() {
        return Ok(object.try_int(vm)?.into());
    }
    let is_array = object.downcast_ref::<NdArray>().is_some();
    if object.downcast_ref::<PyFloat>().is_none()
        && !is_array
        && let Some(method) = vm.get_attribute_opt(&object, vm.ctx.intern_str(method))?
    {
        return method.call((), vm);
    }
    let value = function(real(&object, vm)?);
    Ok(vm.ctx.new_float(value).as_object().try_int(vm)?.into())
}

fn isclose(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let left = next(arguments, vm)?;
    let right = next(arguments, vm)?;
    let mut keyword = |name: &str, default: f64| match arguments.keyword(name, vm) {
        Some(object) => real(&object, vm),
        None => Ok(default),
    };
    let relative = keyword("rel_tol", 1e-9)?;
    let absolute = keyword("abs_tol", 0.0)?;
    if relative < 0.0 || absolute < 0.0 {
        return Err(vm.new_value_error("tolerances must be non-negative"));
    }
    let difference = (left - right).abs();
    let close = left == right
        || (left.is_finite()
            && right.is_finite()
            && (difference <= (relative * right).abs()
                || difference <= (relative * left).abs()
                || difference <= absolute));
    Ok(vm.ctx.new_bool(close).into())
}

fn modf(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let value = next(arguments, vm)?;
    let (fraction, whole) = if value.is_infinite() {
        (0.0_f64.copysign(value), value)
    } else {
        libm::modf(value)
    };
    let parts = vec![float(fraction, vm)?, float(whole, vm)?];
    Ok(vm.ctx.new_tuple(parts).into())
}

fn frexp(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let value = next(arguments, vm)?;
    let (mantissa, exponent) = if value.is_finite() {
        libm::frexp(value)
    } else {
        (value, 0)
    };
    let parts = vec![float(mantissa, vm)?, vm.ctx.new_int(exponent).into()];
    Ok(vm.ctx.new_tuple(parts).into())
}

fn ldexp(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let value = next(arguments, vm)?;
    let exponent = arguments.required("i", vm)?;
    if exponent.downcast_ref::<PyInt>().is_none() {
        return Err(vm.new_type_error("Expected an int as second argument to ldexp."));
    }
    // beyond these the result is zero or infinite whatever the value
    let exponent =
        convert::integer(&exponent, vm).map_or(5000, |exponent| exponent.clamp(-5000, 5000)) as i32;
    let result = libm::scalbn(value, exponent);
    if result.is_infinite() && value.is_finite() {
        return Err(range(vm));
    }
    float(result, vm)
}

/// The exact sum of floats, rounded once (Shewchuk's partial sums).
fn exact_sum(values: &[f64]) -> f64 {
    let mut partials: Vec<f64> = Vec::new();
    let mut special = 0.0;
    for &value in values {
        if !value.is_finite() {
            special += value;
            continue;
        }
        let mut carried = value;
        let mut kept = 0;
        for place in 0..partials.len() {
            let mut other = partials[place];
            if carried.abs() < other.abs() {
                std::mem::swap(&mut carried, &mut other);
            }
            let high = carried + other;
            let low = other - (high - carried);
            if low != 0.0 {
                partials[kept] = low;
                kept += 1;
            }
            carried = high;
        }
        partials.truncate(kept);
        partials.push(carried);
    }
    if special != 0.0 || f64::is_nan(special) {
        return special;
    }
    let Some(mut high) = partials.pop() else {
        return 0.0;
    };
    let mut low = 0.0;
    while let Some(next) = partials.pop() {
        let before = high;
        high = before + next;
        low = next - (high - before);
        if low != 0.0 {
            break;
        }
    }
    // half-way cases are rounded by what is left below
    if let Some(last) = partials.last()
        && ((low < 0.0 && *last < 0.0) || (low > 0.0 && *last > 0.0))
    {
        let doubled = low * 2.0;
        let rounded = high + doubled;
        if doubled == rounded - high {
            high = rounded;
        }
    }
    high
}

fn fsum(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let values = reals(&elements(arguments.required("seq", vm)?, vm)?, vm)?;
    let sum = exact_sum(&values);
    if sum.is_infinite() && values.iter().all(|value| value.is_finite()) {
        return Err(vm.new_overflow_error("intermediate overflow in fsum"));
    }
    if sum.is_nan() && values.iter().all(|value| !value.is_nan()) {
        return Err(vm.new_value_error("-inf + inf in fsum"));
    }
    float(sum, vm)
}

fn prod(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let items = elements(arguments.required("iterable", vm)?, vm)?;
    let start = arguments
        .keyword("start", vm)
        .unwrap_or_else(|| vm.ctx.new_int(1).into());
    items
        .iter()
        .try_fold(start, |product, item| vm._mul(&product, item))
}

/// The product of two floats as the rounded product and what was lost (Dekker).
fn exact_product(left: f64, right: f64) -> (f64, f64) {
    let split = |value: f64| {
        let scaled = value * 134_217_729.0;
        let high = scaled - (scaled - value);
        (high, value - high)
    };
    let product = left * right;
    let ((left_high, left_low), (right_high, right_low)) = (split(left), split(right));
    let lost = ((left_high * right_high - product) + left_high * right_low + left_low * right_high)
        + left_low * right_low;
    (product, if lost.is_finite() { lost } else { 0.0 })
}

fn sumprod(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let left = elements(arguments.required("p", vm)?, vm)?;
    let right = elements(arguments.required("q", vm)?, vm)?;
    if left.len() != right.len() {
        return Err(vm.new_value_error("Inputs are not the same length"));
    }
    let is_float = |object: &PyObjectRef| object.downcast_ref::<PyFloat>().is_some();
    if left.iter().chain(&right).any(is_float) {
        let (left, right) = (reals(&left, vm)?, reals(&right, vm)?);
        let mut parts = Vec::with_capacity(2 * left.len());
        for (left, right) in left.iter().zip(&right) {
            let (product, lost) = exact_product(*left, *right);
            parts.extend([product, lost]);
        }
        return float(exact_sum(&parts), vm);
    }
    let zero: PyObjectRef = vm.ctx.new_int(0).into();
    left.iter()
        .zip(&right)
        .try_fold(zero, |sum, (left, right)| {
            let product = vm._mul(left, right)?;
            vm._add(&sum, &product)
        })
}

fn fma(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let (left, right, more) = (
        next(arguments, vm)?,
        next(arguments, vm)?,
        next(arguments, vm)?,
    );
    // one rounding, by software on every machine
    let result = libm::fma(left, right, more);
    if result.is_nan() && !left.is_nan() && !right.is_nan() && !more.is_nan() {
        return Err(vm.new_value_error("invalid operation in fma"));
    }
    if result.is_infinite() && left.is_finite() && right.is_finite() && more.is_finite() {
        return Err(vm.new_overflow_error("overflow in fma"));
    }
    float(result, vm)
}

/// An argument that must be a whole number, as Python's int.
fn whole(object: &PyObject, vm: &VirtualMachine) -> PyResult {
    Ok(object.try_index(vm)?.into())
}

fn is_negative(object: &PyObjectRef, vm: &VirtualMachine) -> PyResult<bool> {
    let zero: PyObjectRef = vm.ctx.new_int(0).into();
    object.rich_compare_bool(&zero, PyComparisonOp::Lt, vm)
}

/// A whole number that counts steps of a loop.
fn count(object: &PyObjectRef, vm: &VirtualMachine) -> PyResult<u64> {
    object
        .try_index(vm)?
        .try_to_primitive(vm)
        .map_err(|_| vm.new_overflow_error("a whole number here is too large to count with"))
}

fn factorial(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let object = whole(arguments.required("n", vm)?.as_object(), vm)?;
    if is_negative(&object, vm)? {
        return Err(vm.new_value_error("factorial() not defined for negative values"));
    }
    let mut product: PyObjectRef = vm.ctx.new_int(1).into();
    for factor in 2..=count(&object, vm)? {
        product = vm._mul(&product, vm.ctx.new_int(factor).as_object())?;
    }
    Ok(product)
}

fn counts(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult<(u64, Option<u64>)> {
    let all = whole(arguments.required("n", vm)?.as_object(), vm)?;
    if is_negative(&all, vm)? {
        return Err(vm.new_value_error("n must be a non-negative integer"));
    }
    let chosen = match arguments.optional("k", vm) {
        Some(object) => {
            let chosen = whole(&object, vm)?;
            if is_negative(&chosen, vm)? {
                return Err(vm.new_value_error("k must be a non-negative integer"));
            }
            Some(count(&chosen, vm)?)
        }
        None => None,
    };
    Ok((count(&all, vm)?, chosen))
}

fn comb(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let (all, chosen) = counts(arguments, vm)?;
    let Some(chosen) = chosen else {
        return Err(vm.new_type_error("comb expected 2 arguments, got 1"));
    };
    if chosen > all {
        return Ok(vm.ctx.new_int(0).into());
    }
    let mut result: PyObjectRef = vm.ctx.new_int(1).into();
    for step in 0..chosen.min(all - chosen) {
        result = vm._mul(&result, vm.ctx.new_int(all - step).as_object())?;
        result = vm._floordiv(&result, vm.ctx.new_int(step + 1).as_object())?;
    }
    Ok(result)
}

fn perm(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let (all, chosen) = counts(arguments, vm)?;
    let chosen = chosen.unwrap_or(all);
    let mut result: PyObjectRef = vm.ctx.new_int(u8::from(chosen <= all)).into();
    for step in 0..chosen.min(all) {
        if chosen > all {
            break;
        }
        result = vm._mul(&result, vm.ctx.new_int(all - step).as_object())?;
    }
    Ok(result)
}

fn greatest_common_divisor(left: PyObjectRef, right: PyObjectRef, vm: &VirtualMachine) -> PyResult {
    let (mut left, mut right) = (vm._abs(&left)?, vm._abs(&right)?);
    while right.clone().try_to_bool(vm)? {
        let rest = vm._mod(&left, &right)?;
        (left, right) = (right, rest);
    }
    Ok(left)
}

fn gcd(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let mut known: PyObjectRef = vm.ctx.new_int(0).into();
    for object in arguments.rest() {
        known = greatest_common_divisor(known, whole(&object, vm)?, vm)?;
    }
    Ok(known)
}

fn lcm(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let mut known: PyObjectRef = vm.ctx.new_int(1).into();
    for object in arguments.rest() {
        let next = whole(&object, vm)?;
        let divisor = greatest_common_divisor(known.clone(), next.clone(), vm)?;
        if !divisor.clone().try_to_bool(vm)? || !next.clone().try_to_bool(vm)? {
            known = vm.ctx.new_int(0).into();
            continue;
        }
        let part = vm._floordiv(&known, &divisor)?;
        known = vm._abs(vm._mul(&part, &next)?.as_object())?;
    }
    Ok(known)
}

fn isqrt(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let object = whole(arguments.required("n", vm)?.as_object(), vm)?;
    if is_negative(&object, vm)? {
        return Err(vm.new_value_error("isqrt() argument must be nonnegative"));
    }
    if !object.clone().try_to_bool(vm)? {
        return Ok(object);
    }
    // Newton's method from above: 2 to the power of half the bits, rounded up
    let bits: u64 = vm
        .call_method(&object, "bit_length", ())?
        .try_to_value(vm)?;
    let one: PyObjectRef = vm.ctx.new_int(1).into();
    let mut root = vm._lshift(&one, vm.ctx.new_int(bits.div_ceil(2)).as_object())?;
    loop {
        let sum = vm._add(&root, vm._floordiv(&object, &root)?.as_object())?;
        let next = vm._rshift(&sum, &one)?;
        if !next.rich_compare_bool(&root, PyComparisonOp::Lt, vm)? {
            return Ok(root);
        }
        root = next;
    }
}
