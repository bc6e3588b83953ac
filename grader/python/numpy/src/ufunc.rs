//! The tables of functions that work element by element, and of the operators, which are some of them.
//!
//! Every transcendental function is that of the crate `libm`, so that a number has the same bits on every machine.

use crate::array::NdArray;
use crate::broadcast;
use crate::convert;
use crate::dtype::Dtype;
use crate::errors;
use crate::function::Arguments;
use crate::view::View;
use rustpython_vm::{PyObject, PyObjectRef, PyResult, VirtualMachine};

/// What a function does with elements of one kind.
#[derive(Clone, Copy, Debug)]
pub enum Loop<F> {
    /// It has no loop for this kind: the elements count as the next larger kind.
    Next,
    /// The kind of the result and the function.
    Gives(Dtype, F),
    /// A TypeError with this sentence.
    Refuses(&'static str),
    /// A TypeError with numpy's sentence for kinds that a function does not take.
    Unsupported,
}

/// A function of one element.
pub type One = fn(f64) -> f64;
/// A function of two elements.
pub type Two = fn(f64, f64) -> f64;

/// An elementwise function: its name and its loops for bools, ints and floats.
#[derive(Debug)]
pub struct Elementwise<F: 'static> {
    /// The name in module `numpy`.
    pub name: &'static str,
    /// Other names of the same function.
    pub aliases: &'static [&'static str],
    bools: Loop<F>,
    ints: Loop<F>,
    floats: Loop<F>,
}

/// An elementwise function of one array.
pub type Unary = Elementwise<One>;
/// An elementwise function of two arrays.
pub type Binary = Elementwise<Two>;

impl<F: Copy> Elementwise<F> {
    /// The kind of the result and the function for elements of this kind.
    ///
    /// # Errors
    ///
    /// TypeError when there is none.
    pub fn select(&self, dtype: Dtype, vm: &VirtualMachine) -> PyResult<(Dtype, F)> {
        let mut loops = [self.bools, self.ints, self.floats]
            .into_iter()
            .skip(dtype as usize);
        loop {
            match loops.next() {
                Some(Loop::Gives(dtype, function)) => return Ok((dtype, function)),
                Some(Loop::Next) => {}
                Some(Loop::Refuses(sentence)) => return Err(vm.new_type_error(sentence)),
                Some(Loop::Unsupported) | None => {
                    return Err(vm.new_type_error(format!(
                        "ufunc '{}' not supported for the input types, and the inputs could not be safely coerced to any supported types \
                         according to the casting rule ''safe''",
                        self.name
                    )));
                }
            }
        }
    }
}

impl Unary {
    /// The function of one number that is called with nothing else; `None` for other arguments.
    ///
    /// # Errors
    ///
    /// As [`Unary::apply`].
    pub fn of_number(
        &self,
        arguments: &Arguments,
        vm: &VirtualMachine,
    ) -> PyResult<Option<PyObjectRef>> {
        let Some([operand]) = arguments.only_positional() else {
            return Ok(None);
        };
        let Some((value, dtype)) = convert::number(operand, vm)? else {
            return Ok(None);
        };
        let (dtype, function) = self.select(dtype, vm)?;
        Ok(Some(convert::element(function(value), dtype, vm)))
    }

    /// The function of every element.
    ///
    /// # Errors
    ///
    /// TypeError when it has no loop for the kind of the elements.
    pub fn apply(&self, view: &View, vm: &VirtualMachine) -> PyResult<View> {
        let (dtype, function) = self.select(view.dtype(), vm)?;
        Ok(broadcast::map(view, dtype, function))
    }
}

impl Binary {
    /// The function of two numbers that is called with nothing else; `None` for other arguments.
    ///
    /// # Errors
    ///
    /// As [`Binary::apply`].
    pub fn of_numbers(
        &self,
        arguments: &Arguments,
        vm: &VirtualMachine,
    ) -> PyResult<Option<PyObjectRef>> {
        let Some([left, right]) = arguments.only_positional() else {
            return Ok(None);
        };
        // `apply` looks at exponents before it takes any
        if self.name == POWER.name {
            return Ok(None);
        }
        let (Some((left, left_dtype)), Some((right, right_dtype))) =
            (convert::number(left, vm)?, convert::number(right, vm)?)
        else {
            return Ok(None);
        };
        let (dtype, function) = self.select(left_dtype.max(right_dtype), vm)?;
        Ok(Some(convert::element(function(left, right), dtype, vm)))
    }

    /// The function of every pair of elements.
    ///
    /// # Errors
    ///
    /// TypeError when it has no loop for the kinds, ValueError when the shapes do not go together.
    pub fn apply(&self, left: &View, right: &View, vm: &VirtualMachine) -> PyResult<View> {
        let (dtype, function) = self.select(left.dtype().max(right.dtype()), vm)?;
        if self.name == "power"
            && dtype == Dtype::Int
            && right.values().iter().any(|&exponent| exponent < 0.0)
        {
            return Err(vm.new_value_error("Integers to negative integer powers are not allowed."));
        }
        broadcast::combine(left, right, dtype, function, vm)
    }

    /// The operator between Python objects, one of which is an array.
    ///
    /// # Errors
    ///
    /// As [`Binary::apply`], and those of reading a list as an array.
    pub fn operate(&self, left: &PyObject, right: &PyObject, vm: &VirtualMachine) -> PyResult {
        if let Some(result) = self.with_number(left, right, vm)? {
            return Ok(convert::object(result, vm));
        }
        if let (Some(left), Some(right)) = (
            left.downcast_ref::<NdArray>(),
            right.downcast_ref::<NdArray>(),
        ) {
            return Ok(convert::object(
                self.apply(left.view(), right.view(), vm)?,
                vm,
            ));
        }
        let (Some(left), Some(right)) = (convert::operand(left, vm)?, convert::operand(right, vm)?)
        else {
            return Ok(vm.ctx.not_implemented());
        };
        Ok(convert::object(self.apply(&left, &right, vm)?, vm))
    }

    /// The operator between an array and a number, which is no array here first; `None` for other operands.
    fn with_number(
        &self,
        left: &PyObject,
        right: &PyObject,
        vm: &VirtualMachine,
    ) -> PyResult<Option<View>> {
        let arrays = (
            left.downcast_ref::<NdArray>(),
            right.downcast_ref::<NdArray>(),
        );
        let (array, other) = match arrays {
            (Some(array), None) => (array.view(), right),
            (None, Some(array)) => (array.view(), left),
            _ => return Ok(None),
        };
        let Some((number, dtype)) = convert::number(other, vm)? else {
            return Ok(None);
        };
        // `apply` looks at exponents before it takes any
        if self.name == POWER.name {
            return Ok(None);
        }
        let (dtype, function) = self.select(array.dtype().max(dtype), vm)?;
        Ok(Some(match arrays.0 {
            Some(_) => broadcast::map(array, dtype, |element| function(element, number)),
            None => broadcast::map(array, dtype, |element| function(number, element)),
        }))
    }

    /// The operator in place: the result goes into the cells of the array on the left.
    ///
    /// # Errors
    ///
    /// As [`Binary::apply`]; UFuncTypeError when the result is of a larger kind than the array, ValueError when it is of a larger shape.
    pub fn operate_in_place(
        &self,
        left: &PyObject,
        right: &PyObject,
        vm: &VirtualMachine,
    ) -> PyResult {
        let (Some(view), Some(right)) = (convert::operand(left, vm)?, convert::operand(right, vm)?)
        else {
            return Ok(vm.ctx.not_implemented());
        };
        // numpy looks at the kinds before it looks at the shapes
        let (dtype, _) = self.select(view.dtype().max(right.dtype()), vm)?;
        check_kind(self.name, dtype, view.dtype(), vm)?;
        let result = self.apply(&view, &right, vm)?;
        store(self.name, &result, &view, vm)?;
        Ok(left.to_owned())
    }
}

/// Refuses to put results of the kind `from` into an array of the kind `to`, when that is a smaller one.
///
/// # Errors
///
/// UFuncTypeError, with numpy's sentence.
fn check_kind(name: &str, from: Dtype, to: Dtype, vm: &VirtualMachine) -> PyResult<()> {
    if from.may_become(to) {
        return Ok(());
    }
    Err(errors::ufunc(
        format!(
            "Cannot cast ufunc '{name}' output from dtype('{}') to dtype('{}') with casting rule 'same_kind'",
            from.name(),
            to.name()
        ),
        vm,
    ))
}

/// Puts the result of a function into an array that exists: for `+=` and its like, and for `out=`.
///
/// # Errors
///
/// UFuncTypeError when the result is of a larger kind than the array, ValueError when it is of another shape.
pub fn store(name: &str, result: &View, target: &View, vm: &VirtualMachine) -> PyResult<()> {
    check_kind(name, result.dtype(), target.dtype(), vm)?;
    let fits = result.shape() == target.shape()
        || (result.rank() <= target.rank()
            && broadcast::common_shape(result.shape(), target.shape()) == Some(target.shape()));
    match result.broadcast_to(target.shape()) {
        Some(result) if fits => {
            target.assign(&result);
            Ok(())
        }
        _ => Err(vm.new_value_error(format!(
            "non-broadcastable output operand with shape {} doesn't match the broadcast shape {}",
            target.shape().sentence(),
            result.shape().sentence()
        ))),
    }
}

/// The operator of one array as Python calls it.
///
/// # Errors
///
/// As [`Unary::apply`].
pub fn operate_unary(
    function: &Unary,
    operand: &PyObject,
    vm: &VirtualMachine,
) -> PyResult<PyObjectRef> {
    let view = convert::view_of(operand, vm)?;
    Ok(convert::object(function.apply(&view, vm)?, vm))
}

const fn truth(value: bool) -> f64 {
    if value { 1.0 } else { 0.0 }
}

/// `a % b` of floats: the sign is that of the divisor.
#[must_use]
pub fn remainder(left: f64, right: f64) -> f64 {
    let rest = left % right;
    if rest == 0.0 {
        return 0.0_f64.copysign(right);
    }
    if (rest < 0.0) == (right < 0.0) || rest.is_nan() {
        rest
    } else {
        rest + right
    }
}

/// `a // b` of floats, consistent with [`remainder`].
#[must_use]
pub fn floor_divide(left: f64, right: f64) -> f64 {
    if right == 0.0 {
        return left / right;
    }
    let rest = left % right;
    let mut quotient = (left - rest) / right;
    if rest != 0.0 && (rest < 0.0) != (right < 0.0) {
        quotient -= 1.0;
    }
    if quotient == 0.0 {
        return 0.0_f64.copysign(left / right);
    }
    let whole = quotient.floor();
    if quotient - whole > 0.5 {
        whole + 1.0
    } else {
        whole
    }
}

/// `a ** b` of floats; the exponents that occur most are exact, as numpy has them.
#[must_use]
pub fn power(base: f64, exponent: f64) -> f64 {
    if exponent == 2.0 {
        base * base
    } else if exponent == 1.0 {
        base
    } else if exponent == 0.5 {
        base.sqrt()
    } else if exponent == -1.0 {
        1.0 / base
    } else {
        libm::pow(base, exponent)
    }
}

/// `a ** b` of whole numbers by squaring, exact to 2**53; the exponent is not negative.
#[must_use]
pub fn whole_power(base: f64, exponent: f64) -> f64 {
    let (mut result, mut square, mut left) = (1.0, base, exponent as u64);
    while left > 0 {
        if left & 1 == 1 {
            result *= square;
        }
        left >>= 1;
        if left > 0 {
            square *= square;
        }
    }
    result
}

fn whole(left: f64, right: f64, each: fn(i64, i64) -> i64) -> f64 {
    each(left as i64, right as i64) as f64
}

fn greatest_common_divisor(left: i64, right: i64) -> i64 {
    let (mut left, mut right) = (left.unsigned_abs(), right.unsigned_abs());
    while right != 0 {
        (left, right) = (right, left % right);
    }
    left as i64
}

fn sign(value: f64) -> f64 {
    if value > 0.0 {
        1.0
    } else if value < 0.0 {
        -1.0
    } else if value == 0.0 {
        0.0
    } else {
        value
    }
}

fn larger(left: f64, right: f64) -> f64 {
    if left.is_nan() || left >= right {
        left
    } else {
        right
    }
}

fn smaller(left: f64, right: f64) -> f64 {
    if left.is_nan() || left <= right {
        left
    } else {
        right
    }
}

/// As libm's, which says nothing about values below 1.
#[must_use]
pub fn inverse_hyperbolic_cosine(value: f64) -> f64 {
    if value < 1.0 {
        f64::NAN
    } else {
        libm::acosh(value)
    }
}

fn sinc(value: f64) -> f64 {
    if value == 0.0 {
        return 1.0;
    }
    let angle = std::f64::consts::PI * value;
    libm::sin(angle) / angle
}

fn log_of_sum(left: f64, right: f64) -> f64 {
    if left == right {
        return left + std::f64::consts::LN_2;
    }
    let difference = left - right;
    if difference > 0.0 {
        left + libm::log1p(libm::exp(-difference))
    } else if difference <= 0.0 {
        right + libm::log1p(libm::exp(difference))
    } else {
        difference
    }
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;
const RADIAN: f64 = 180.0 / std::f64::consts::PI;

const fn floating(name: &'static str, aliases: &'static [&'static str], function: One) -> Unary {
    Elementwise {
        name,
        aliases,
        bools: Loop::Next,
        ints: Loop::Next,
        floats: Loop::Gives(Dtype::Float, function),
    }
}

const fn rounding(name: &'static str, function: One) -> Unary {
    Elementwise {
        name,
        aliases: &[],
        bools: Loop::Gives(Dtype::Bool, |value| value),
        ints: Loop::Gives(Dtype::Int, |value| value),
        floats: Loop::Gives(Dtype::Float, function),
    }
}

const fn testing(name: &'static str, function: One) -> Unary {
    Elementwise {
        name,
        aliases: &[],
        bools: Loop::Next,
        ints: Loop::Next,
        floats: Loop::Gives(Dtype::Bool, function),
    }
}

/// `-a`.
pub const NEGATIVE: Unary = Elementwise {
    name: "negative",
    aliases: &[],
    bools: Loop::Refuses(
        "The numpy boolean negative, the `-` operator, is not supported, use the `~` operator or the logical_not function instead.",
    ),
    // a whole number has no negative zero
    ints: Loop::Gives(Dtype::Int, |value| 0.0 - value),
    floats: Loop::Gives(Dtype::Float, |value| -value),
};

/// `+a`.
pub const POSITIVE: Unary = Elementwise {
    name: "positive",
    aliases: &[],
    bools: Loop::Unsupported,
    ints: Loop::Gives(Dtype::Int, |value| value),
    floats: Loop::Gives(Dtype::Float, |value| value),
};

/// `abs(a)`.
pub const ABSOLUTE: Unary = Elementwise {
    name: "absolute",
    aliases: &["abs"],
    bools: Loop::Gives(Dtype::Bool, |value| value),
    ints: Loop::Gives(Dtype::Int, f64::abs),
    floats: Loop::Gives(Dtype::Float, f64::abs),
};

/// `~a`.
pub const INVERT: Unary = Elementwise {
    name: "invert",
    aliases: &["bitwise_not", "bitwise_invert"],
    bools: Loop::Gives(Dtype::Bool, |value| 1.0 - value),
    ints: Loop::Gives(Dtype::Int, |value| -1.0 - value),
    floats: Loop::Unsupported,
};

/// Every elementwise function of one array.
pub static UNARY: &[Unary] = &[
    NEGATIVE,
    POSITIVE,
    ABSOLUTE,
    INVERT,
    floating("fabs", &[], f64::abs),
    floating("sqrt", &[], f64::sqrt),
    floating("cbrt", &[], libm::cbrt),
    floating("exp", &[], libm::exp),
    floating("exp2", &[], libm::exp2),
    floating("expm1", &[], libm::expm1),
    floating("log", &[], libm::log),
    floating("log2", &[], libm::log2),
    floating("log10", &[], libm::log10),
    floating("log1p", &[], libm::log1p),
    floating("sin", &[], libm::sin),
    floating("cos", &[], libm::cos),
    floating("tan", &[], libm::tan),
    floating("arcsin", &["asin"], libm::asin),
    floating("arccos", &["acos"], libm::acos),
    floating("arctan", &["atan"], libm::atan),
    floating("sinh", &[], libm::sinh),
    floating("cosh", &[], libm::cosh),
    floating("tanh", &[], libm::tanh),
    floating("arcsinh", &["asinh"], libm::asinh),
    floating("arccosh", &["acosh"], inverse_hyperbolic_cosine),
    floating("arctanh", &["atanh"], libm::atanh),
    floating("deg2rad", &["radians"], |value| value * DEGREE),
    floating("rad2deg", &["degrees"], |value| value * RADIAN),
    floating("rint", &[], f64::round_ties_even),
    floating("sinc", &[], sinc),
    rounding("floor", f64::floor),
    rounding("ceil", f64::ceil),
    rounding("trunc", f64::trunc),
    rounding("fix", f64::trunc),
    testing("isnan", |value| truth(value.is_nan())),
    testing("isinf", |value| truth(value.is_infinite())),
    testing("isfinite", |value| truth(value.is_finite())),
    testing("signbit", |value| truth(value.is_sign_negative())),
    testing("logical_not", |value| truth(value == 0.0)),
    Elementwise {
        name: "square",
        aliases: &[],
        bools: Loop::Next,
        ints: Loop::Gives(Dtype::Int, |value| value * value),
        floats: Loop::Gives(Dtype::Float, |value| value * value),
    },
    Elementwise {
        name: "sign",
        aliases: &[],
        bools: Loop::Refuses(
            "ufunc 'sign' did not contain a loop with signature matching types <class 'numpy.dtypes.BoolDType'> -> None",
        ),
        ints: Loop::Gives(Dtype::Int, sign),
        floats: Loop::Gives(Dtype::Float, sign),
    },
    Elementwise {
        name: "reciprocal",
        aliases: &[],
        bools: Loop::Next,
        ints: Loop::Gives(Dtype::Int, |value| Dtype::Int.cast(1.0 / value)),
        floats: Loop::Gives(Dtype::Float, |value| 1.0 / value),
    },
];

const fn pairwise(name: &'static str, aliases: &'static [&'static str], function: Two) -> Binary {
    Elementwise {
        name,
        aliases,
        bools: Loop::Next,
        ints: Loop::Next,
        floats: Loop::Gives(Dtype::Float, function),
    }
}

const fn comparing(name: &'static str, function: Two) -> Binary {
    Elementwise {
        name,
        aliases: &[],
        bools: Loop::Next,
        ints: Loop::Next,
        floats: Loop::Gives(Dtype::Bool, function),
    }
}

const fn choosing(name: &'static str, function: Two) -> Binary {
    Elementwise {
        name,
        aliases: &[],
        bools: Loop::Gives(Dtype::Bool, function),
        ints: Loop::Gives(Dtype::Int, function),
        floats: Loop::Gives(Dtype::Float, function),
    }
}

const fn bitwise(name: &'static str, bools: Loop<Two>, ints: Two) -> Binary {
    Elementwise {
        name,
        aliases: &[],
        bools,
        ints: Loop::Gives(Dtype::Int, ints),
        floats: Loop::Unsupported,
    }
}

/// `a + b`.
pub const ADD: Binary = Elementwise {
    name: "add",
    aliases: &[],
    bools: Loop::Gives(Dtype::Bool, larger),
    ints: Loop::Gives(Dtype::Int, |left, right| left + right),
    floats: Loop::Gives(Dtype::Float, |left, right| left + right),
};

/// `a - b`.
pub const SUBTRACT: Binary = Elementwise {
    name: "subtract",
    aliases: &[],
    bools: Loop::Refuses(
        "numpy boolean subtract, the `-` operator, is not supported, use the bitwise_xor, the `^` operator, or the logical_xor function instead.",
    ),
    ints: Loop::Gives(Dtype::Int, |left, right| left - right),
    floats: Loop::Gives(Dtype::Float, |left, right| left - right),
};

/// `a * b`.
pub const MULTIPLY: Binary = Elementwise {
    name: "multiply",
    aliases: &[],
    bools: Loop::Gives(Dtype::Bool, smaller),
    // whole numbers have no negative zero
    ints: Loop::Gives(Dtype::Int, |left, right| left * right + 0.0),
    floats: Loop::Gives(Dtype::Float, |left, right| left * right),
};

/// `a / b`.
pub const DIVIDE: Binary = pairwise("divide", &["true_divide"], |left, right| left / right);

/// `a // b`.
pub const FLOOR_DIVIDE: Binary = Elementwise {
    name: "floor_divide",
    aliases: &[],
    bools: Loop::Next,
    ints: Loop::Gives(Dtype::Int, |left, right| {
        whole(left, right, |left, right| {
            if right == 0 {
                return 0;
            }
            let quotient = left.wrapping_div(right);
            if left.wrapping_rem(right) != 0 && (left < 0) != (right < 0) {
                quotient - 1
            } else {
                quotient
            }
        })
    }),
    floats: Loop::Gives(Dtype::Float, floor_divide),
};

/// `a % b`.
pub const REMAINDER: Binary = Elementwise {
    name: "remainder",
    aliases: &["mod"],
    bools: Loop::Next,
    ints: Loop::Gives(Dtype::Int, |left, right| {
        whole(left, right, |left, right| {
            if right == 0 {
                return 0;
            }
            let rest = left.wrapping_rem(right);
            if rest != 0 && (rest < 0) != (right < 0) {
                rest + right
            } else {
                rest
            }
        })
    }),
    floats: Loop::Gives(Dtype::Float, remainder),
};

/// `a ** b`.
pub const POWER: Binary = Elementwise {
    name: "power",
    aliases: &["pow"],
    bools: Loop::Next,
    ints: Loop::Gives(Dtype::Int, whole_power),
    floats: Loop::Gives(Dtype::Float, power),
};

/// `a & b`.
pub const BITWISE_AND: Binary = bitwise(
    "bitwise_and",
    Loop::Gives(Dtype::Bool, smaller),
    |left, right| whole(left, right, |left, right| left & right),
);

/// `a | b`.
pub const BITWISE_OR: Binary = bitwise(
    "bitwise_or",
    Loop::Gives(Dtype::Bool, larger),
    |left, right| whole(left, right, |left, right| left | right),
);

/// `a ^ b`.
pub const BITWISE_XOR: Binary = bitwise(
    "bitwise_xor",
    Loop::Gives(Dtype::Bool, |left, right| truth(left != right)),
    |left, right| whole(left, right, |left, right| left ^ right),
);

/// `a << b`.
pub const LEFT_SHIFT: Binary = bitwise("left_shift", Loop::Next, |left, right| {
    whole(left, right, |left, right| {
        u32::try_from(right)
            .ok()
            .and_then(|by| left.checked_shl(by))
            .unwrap_or(0)
    })
});

/// `a >> b`.
pub const RIGHT_SHIFT: Binary = bitwise("right_shift", Loop::Next, |left, right| {
    whole(left, right, |left, right| left >> right.clamp(0, 63))
});

/// `a == b`.
pub const EQUAL: Binary = comparing("equal", |left, right| truth(left == right));
/// `a != b`.
pub const NOT_EQUAL: Binary = comparing("not_equal", |left, right| truth(left != right));
/// `a < b`.
pub const LESS: Binary = comparing("less", |left, right| truth(left < right));
/// `a <= b`.
pub const LESS_EQUAL: Binary = comparing("less_equal", |left, right| truth(left <= right));
/// `a > b`.
pub const GREATER: Binary = comparing("greater", |left, right| truth(left > right));
/// `a >= b`.
pub const GREATER_EQUAL: Binary = comparing("greater_equal", |left, right| truth(left >= right));
/// The larger of two, nan when one is nan.
pub const MAXIMUM: Binary = choosing("maximum", larger);
/// The smaller of two, nan when one is nan.
pub const MINIMUM: Binary = choosing("minimum", smaller);

/// Every elementwise function of two arrays.
pub static BINARY: &[Binary] = &[
    ADD,
    SUBTRACT,
    MULTIPLY,
    DIVIDE,
    FLOOR_DIVIDE,
    REMAINDER,
    POWER,
    BITWISE_AND,
    BITWISE_OR,
    BITWISE_XOR,
    LEFT_SHIFT,
    RIGHT_SHIFT,
    EQUAL,
    NOT_EQUAL,
    LESS,
    LESS_EQUAL,
    GREATER,
    GREATER_EQUAL,
    MAXIMUM,
    MINIMUM,
    choosing("fmax", |left, right| {
        if left.is_nan() {
            right
        } else if right.is_nan() {
            left
        } else {
            larger(left, right)
        }
    }),
    choosing("fmin", |left, right| {
        if left.is_nan() {
            right
        } else if right.is_nan() {
            left
        } else {
            smaller(left, right)
        }
    }),
    Elementwise {
        name: "fmod",
        aliases: &[],
        bools: Loop::Next,
        ints: Loop::Gives(Dtype::Int, |left, right| {
            whole(left, right, |left, right| {
                if right == 0 {
                    0
                } else {
                    left.wrapping_rem(right)
                }
            })
        }),
        floats: Loop::Gives(Dtype::Float, |left, right| left % right),
    },
    pairwise("float_power", &[], power),
    pairwise("arctan2", &["atan2"], libm::atan2),
    pairwise("hypot", &[], libm::hypot),
    pairwise("copysign", &[], f64::copysign),
    pairwise("nextafter", &[], libm::nextafter),
    pairwise("logaddexp", &[], log_of_sum),
    pairwise("heaviside", &[], |value, at_zero| {
        if value == 0.0 {
            at_zero
        } else if value.is_nan() {
            value
        } else {
            truth(value > 0.0)
        }
    }),
    comparing("logical_and", |left, right| {
        truth(left != 0.0 && right != 0.0)
    }),
    comparing("logical_or", |left, right| {
        truth(left != 0.0 || right != 0.0)
    }),
    comparing("logical_xor", |left, right| {
        truth((left != 0.0) != (right != 0.0))
    }),
    bitwise("gcd", Loop::Next, |left, right| {
        whole(left, right, greatest_common_divisor)
    }),
    bitwise("lcm", Loop::Next, |left, right| {
        whole(left, right, |left, right| {
            match greatest_common_divisor(left, right) {
                0 => 0,
                divisor => (left / divisor).wrapping_mul(right).wrapping_abs(),
            }
        })
    }),
];
