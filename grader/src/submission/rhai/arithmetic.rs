//! Operators: on numbers, and element by element on vectors and matrices.
//!
//! Integers give an integer if the result is one and fits, else a float; nothing overflows. Division by zero gives an infinity or NaN,
//! as IEEE 754 says; the grader refuses an answer that contains one.

use std::any::TypeId;
use std::cmp::Ordering;

use rhai::{Array, Dynamic, INT, ImmutableString, Map};

use super::budget::Meter;
use super::library::{Arguments, Library};
use super::mistake::{Problem, fault, fault_with_help};
use super::operand::{Operand, as_number, as_whole, describe_operand};
use super::range::Range;
use super::vector::{Matrix, Vector};
use super::words::{describe, show};

/// One arithmetic operator on numbers.
#[derive(Clone, Copy)]
struct Operator {
    symbol: &'static str,
    verb: &'static str,
    joiner: &'static str,
    /// The exact result, if it is an integer that fits.
    whole: fn(INT, INT) -> Option<INT>,
    float: fn(f64, f64) -> f64,
}

const ADD: Operator = Operator {
    symbol: "+",
    verb: "add",
    joiner: "and",
    whole: INT::checked_add,
    float: |a, b| a + b,
};
const SUBTRACT: Operator = Operator {
    symbol: "-",
    verb: "subtract",
    joiner: "and",
    whole: INT::checked_sub,
    float: |a, b| a - b,
};
const MULTIPLY: Operator = Operator {
    symbol: "*",
    verb: "multiply",
    joiner: "by",
    whole: INT::checked_mul,
    float: |a, b| a * b,
};
const DIVIDE: Operator = Operator {
    symbol: "/",
    verb: "divide",
    joiner: "by",
    whole: |a, b| match a.checked_rem(b) {
        Some(0) => a.checked_div(b),
        _ => None,
    },
    float: |a, b| a / b,
};
const REMAINDER: Operator = Operator {
    symbol: "%",
    verb: "take the remainder of",
    joiner: "by",
    whole: |a, b| {
        let rest = a.checked_rem(b)?;
        Some(if rest != 0 && (rest < 0) != (b < 0) {
            rest + b
        } else {
            rest
        })
    },
    float: |a, b| {
        let rest = libm::fmod(a, b);
        if rest != 0.0 && (rest < 0.0) != (b < 0.0) {
            rest + b
        } else {
            rest
        }
    },
};
const POWER: Operator = Operator {
    symbol: "**",
    verb: "raise",
    joiner: "to",
    whole: |a, b| a.checked_pow(u32::try_from(b).ok()?),
    float: libm::pow,
};

/// What an operator makes of two values.
pub(super) type Apply = fn(&Meter, &Dynamic, &Dynamic) -> Result<Dynamic, Problem>;

/// The operators that calculate.
const CALCULATE: [(&str, Apply); 6] = [
    ("+", |meter, a, b| calculate(meter, ADD, a, b)),
    ("-", |meter, a, b| calculate(meter, SUBTRACT, a, b)),
    ("*", |meter, a, b| calculate(meter, MULTIPLY, a, b)),
    ("/", |meter, a, b| calculate(meter, DIVIDE, a, b)),
    ("%", |meter, a, b| calculate(meter, REMAINDER, a, b)),
    ("**", |meter, a, b| calculate(meter, POWER, a, b)),
];

/// The operators that compare. NaN has no order, so that every comparison of order with it is false.
const COMPARE: [(&str, Apply); 6] = [
    ("<", |_, a, b| compare("<", Ordering::is_lt, a, b)),
    ("<=", |_, a, b| compare("<=", Ordering::is_le, a, b)),
    (">", |_, a, b| compare(">", Ordering::is_gt, a, b)),
    (">=", |_, a, b| compare(">=", Ordering::is_ge, a, b)),
    ("==", |meter, a, b| Ok(equal(meter, a, b)?.into())),
    ("!=", |meter, a, b| Ok((!equal(meter, a, b)?).into())),
];

/// The operator between two values that is written as `symbol`.
pub(super) fn between(symbol: &str) -> Option<Apply> {
    let mut known = CALCULATE.iter().chain(&COMPARE);
    known
        .find(|(written, _)| *written == symbol)
        .map(|(_, apply)| *apply)
}

pub(super) fn register(library: &mut Library) {
    let numbers = [TypeId::of::<f64>(), TypeId::of::<INT>()];
    let numeric = [numbers[0], numbers[1], TypeId::of::<Vector>()];
    let any = [TypeId::of::<Dynamic>(); 2];
    let calculate = CALCULATE.iter().map(|operator| (operator, &numeric[..]));
    let compare = COMPARE.iter().map(|operator| (operator, &numbers[..]));
    for (&(symbol, apply), mostly) in calculate.chain(compare) {
        let call = move |meter: &Meter, arguments: Arguments<'_, '_>| {
            apply(meter, arguments[0], arguments[1])
        };
        for left in mostly {
            for right in mostly {
                library.shortcut(symbol, &[*left, *right], call);
            }
        }
        library.internal(symbol, &any, call);
    }
    for (symbol, apply) in CALCULATE {
        let assign = move |meter: &Meter, arguments: Arguments<'_, '_>| {
            *arguments[0] = apply(meter, arguments[0], arguments[1])?;
            Ok(Dynamic::UNIT)
        };
        library.internal(&format!("{symbol}="), &any, assign);
    }
    for kind in [
        TypeId::of::<f64>(),
        TypeId::of::<INT>(),
        TypeId::of::<Dynamic>(),
    ] {
        library.internal("-", &[kind], |meter, arguments| negate(meter, arguments[0]));
        library.internal("+", &[kind], |_, arguments| Ok(arguments[0].clone()));
    }
    library.internal(
        "!",
        &[TypeId::of::<Dynamic>()],
        |_, arguments| match arguments[0].as_bool() {
            Ok(boolean) => Ok((!boolean).into()),
            Err(_) => Err(fault(format!(
                "`!` takes true or false, got {}",
                describe(arguments[0])
            ))),
        },
    );
    register_refusals(library);
    register_ranges(library);
}

/// Operators with another meaning in other languages, and bitwise operators, which a controller does not need.
fn register_refusals(library: &mut Library) {
    let any = [TypeId::of::<Dynamic>(); 2];
    for (symbol, message, help) in [
        ("^", "`^` is not a power here", "use ** for powers: x ** 2"),
        ("&", "`&` is not used here", "write && for \"and\""),
        ("|", "`|` is not used here", "write || for \"or\""),
        ("<<", "`<<` is not used here", "multiply by a power of two"),
        (">>", "`>>` is not used here", "divide by a power of two"),
    ] {
        for name in [symbol.to_owned(), format!("{symbol}=")] {
            library.internal(&name, &any, move |_, _| Err(fault_with_help(message, help)));
        }
    }
}

/// Ranges between integers, written as integers or not.
fn register_ranges(library: &mut Library) {
    for types in [[TypeId::of::<INT>(); 2], [TypeId::of::<Dynamic>(); 2]] {
        for (symbol, beyond) in [("..", 0), ("..=", 1)] {
            library.internal(symbol, &types, move |_, arguments| {
                match (as_whole(arguments[0]), as_whole(arguments[1])) {
                    (Some(from), Some(to)) => {
                        let to = to.saturating_add(beyond);
                        Ok(Dynamic::from(Range { from, to }))
                    }
                    _ => Err(fault(format!(
                        "a range goes from one integer to another, got {} and {}",
                        describe(arguments[0]),
                        describe(arguments[1])
                    ))),
                }
            });
        }
    }
}

fn calculate(
    meter: &Meter,
    operator: Operator,
    left: &Dynamic,
    right: &Dynamic,
) -> Result<Dynamic, Problem> {
    if let (Ok(a), Ok(b)) = (left.as_float(), right.as_float()) {
        return Ok((operator.float)(a, b).into());
    }
    let (a, b) = (Operand::of(left), Operand::of(right));
    let elements = a.elements().max(b.elements());
    meter.charge(elements)?;
    if matches!(operator.symbol, "**" | "%") {
        // each takes about as long as an operation
        meter.charge(8 * elements.saturating_sub(1))?;
    }
    if let (Operand::Int(a), Operand::Int(b)) = (&a, &b) {
        return Ok((operator.whole)(*a, *b).map_or_else(
            || (operator.float)(*a as f64, *b as f64).into(),
            Dynamic::from_int,
        ));
    }
    if operator.symbol == "*"
        && let Some(product) = matrix_product(meter, &a, &b)?
    {
        return Ok(product);
    }
    let float = operator.float;
    if let (Some(a), Some(b)) = (a.number(), b.number()) {
        return Ok(float(a, b).into());
    }
    match (&a, &b) {
        (Operand::Other, _) | (_, Operand::Other) => join_text(meter, operator, left, right),
        (Operand::Vector(a), Operand::Vector(b)) if a.len() == b.len() => {
            let pairs = a.elements().iter().zip(b.elements());
            let results: Vector = pairs.map(|(a, b)| float(*a, *b)).collect();
            Ok(Dynamic::from(results))
        }
        (Operand::Vector(vector), Operand::Int(_) | Operand::Float(_)) => {
            let number = b.number().unwrap_or_default();
            Ok(Dynamic::from(vector.map(|x| float(x, number))))
        }
        (Operand::Int(_) | Operand::Float(_), Operand::Vector(vector)) => {
            let number = a.number().unwrap_or_default();
            Ok(Dynamic::from(vector.map(|x| float(number, x))))
        }
        (Operand::Matrix(a), Operand::Matrix(b))
            if (a.rows(), a.columns()) == (b.rows(), b.columns())
                && matches!(operator.symbol, "+" | "-") =>
        {
            let sum = Matrix::from_fn(a.rows(), a.columns(), |i, j| float(a.at(i, j), b.at(i, j)));
            Ok(Dynamic::from(sum))
        }
        (Operand::Matrix(matrix), Operand::Int(_) | Operand::Float(_))
            if matches!(operator.symbol, "+" | "-" | "*" | "/") =>
        {
            let number = b.number().unwrap_or_default();
            Ok(Dynamic::from(matrix.map(|x| float(x, number))))
        }
        (Operand::Int(_) | Operand::Float(_), Operand::Matrix(matrix))
            if matches!(operator.symbol, "+" | "-" | "*") =>
        {
            let number = a.number().unwrap_or_default();
            Ok(Dynamic::from(matrix.map(|x| float(number, x))))
        }
        _ => Err(refuse(operator, left, right)),
    }
}

/// The product of linear algebra, if a matrix takes part.
fn matrix_product(meter: &Meter, a: &Operand, b: &Operand) -> Result<Option<Dynamic>, Problem> {
    Ok(match (a, b) {
        (Operand::Matrix(a), Operand::Vector(b)) if a.columns() == b.len() => {
            Some(Dynamic::from(a.times_vector(b)))
        }
        (Operand::Matrix(a), Operand::Matrix(b)) if a.columns() == b.rows() => {
            meter.charge(a.rows() * a.columns() * b.columns())?;
            meter.list(a.rows() * b.columns())?;
            Some(Dynamic::from(a.times(b)))
        }
        _ => None,
    })
}

/// `+` with a string on either side joins strings; all other operands are refused.
fn join_text(
    meter: &Meter,
    operator: Operator,
    left: &Dynamic,
    right: &Dynamic,
) -> Result<Dynamic, Problem> {
    if operator.symbol == "+" && (left.is_string() || right.is_string()) {
        let mut text = show(meter, left)?;
        text.push_str(&show(meter, right)?);
        meter.text(text.len())?;
        return Ok(text.into());
    }
    Err(refuse(operator, left, right))
}

fn refuse(operator: Operator, left: &Dynamic, right: &Dynamic) -> Problem {
    let message = format!(
        "cannot {} {} {} {}",
        operator.verb,
        describe_operand(left),
        operator.joiner,
        describe_operand(right)
    );
    let (a, b) = (Operand::of(left), Operand::of(right));
    let help = if left.is_unit() || right.is_unit() {
        "`()` means that nothing was set or returned: set what is in `this` in init, and end a function with `return`"
    } else {
        match (&a, &b) {
            (Operand::Vector(_), Operand::Matrix(_)) if operator.symbol == "*" => {
                "write the matrix first: m * v, or transpose(m) * v"
            }
            (Operand::Matrix(_), Operand::Matrix(_) | Operand::Vector(_))
                if operator.symbol == "*" =>
            {
                "the columns of the left must be as many as the rows of the right"
            }
            (_, Operand::Matrix(_)) if operator.symbol == "/" => {
                "solve(m, v) gives the x for which m * x is v"
            }
            (Operand::Vector(_), Operand::Matrix(_)) | (Operand::Matrix(_), Operand::Vector(_))
                if matches!(operator.symbol, "+" | "-") =>
            {
                "a column of a matrix is no vector: write [a, b] or zeros(2) for a vector; col(m, 0) is the first column of m as one"
            }
            (Operand::Vector(_), Operand::Vector(_)) => {
                "element by element needs as many on the left as on the right"
            }
            _ if left.is_array() || right.is_array() => {
                "only lists of numbers can be calculated with; concat(a, b) joins two lists"
            }
            _ => return fault(message),
        }
    };
    fault_with_help(message, help)
}

fn negate(meter: &Meter, value: &Dynamic) -> Result<Dynamic, Problem> {
    let operand = Operand::of(value);
    meter.charge(operand.elements())?;
    Ok(match operand {
        Operand::Int(whole) => whole
            .checked_neg()
            .map_or_else(|| (-(whole as f64)).into(), Dynamic::from_int),
        Operand::Float(number) => (-number).into(),
        Operand::Vector(vector) => Dynamic::from(vector.map(|x| -x)),
        Operand::Matrix(matrix) => Dynamic::from(matrix.map(|x| -x)),
        Operand::Other => return Err(fault(format!("cannot negate {}", describe(value)))),
    })
}

fn compare(
    symbol: &str,
    holds: fn(Ordering) -> bool,
    left: &Dynamic,
    right: &Dynamic,
) -> Result<Dynamic, Problem> {
    let order = order(symbol, left, right)?;
    Ok(order.is_some_and(holds).into())
}

fn order(symbol: &str, left: &Dynamic, right: &Dynamic) -> Result<Option<Ordering>, Problem> {
    if let (Ok(a), Ok(b)) = (left.as_int(), right.as_int()) {
        return Ok(Some(a.cmp(&b)));
    }
    if let (Some(a), Some(b)) = (as_number(left), as_number(right)) {
        return Ok(a.partial_cmp(&b));
    }
    if let (Ok(a), Ok(b)) = (
        left.as_immutable_string_ref(),
        right.as_immutable_string_ref(),
    ) {
        let (a, b): (&ImmutableString, &ImmutableString) = (&a, &b);
        return Ok(Some(a.cmp(b)));
    }
    let message = format!(
        "cannot compare {} {symbol} {}",
        describe(left),
        describe(right)
    );
    let is_vector = |value| matches!(Operand::of(value), Operand::Vector(_));
    Err(if is_vector(left) || is_vector(right) {
        fault_with_help(
            message,
            "compare elements, or one number of it: max(abs(v)), norm(v)",
        )
    } else if left.is_bool() {
        fault_with_help(message, "compare twice: a < x && x < b")
    } else {
        fault(message)
    })
}

/// The one letter of a text: what an index takes out of a string is a letter, and people compare it with a string of one.
fn letter(value: &Dynamic) -> Option<char> {
    if let Ok(letter) = value.as_char() {
        return Some(letter);
    }
    let text = value.as_immutable_string_ref().ok()?;
    let mut letters = text.chars();
    letters.next().filter(|_| letters.next().is_none())
}

/// Whether two values are the same; a list of numbers equals the vector of them.
pub(super) fn equal(meter: &Meter, left: &Dynamic, right: &Dynamic) -> Result<bool, Problem> {
    if let (Ok(a), Ok(b)) = (left.as_int(), right.as_int()) {
        return Ok(a == b);
    }
    if let (Some(a), Some(b)) = (as_number(left), as_number(right)) {
        return Ok(is_equal(a, b));
    }
    if let (Ok(a), Ok(b)) = (left.as_bool(), right.as_bool()) {
        return Ok(a == b);
    }
    if left.is_char() || right.is_char() {
        return Ok(letter(left).is_some_and(|a| letter(right) == Some(a)));
    }
    if let (Ok(a), Ok(b)) = (
        left.as_immutable_string_ref(),
        right.as_immutable_string_ref(),
    ) {
        meter.charge(a.len().min(b.len()))?;
        return Ok(*a == *b);
    }
    if let (Ok(a), Ok(b)) = (left.as_map_ref(), right.as_map_ref()) {
        let (a, b): (&Map, &Map) = (&a, &b);
        if a.len() != b.len() {
            return Ok(false);
        }
        meter.charge(8 * a.len())?;
        for ((key, left), (other_key, right)) in a.iter().zip(b) {
            if key != other_key || !equal(meter, left, right)? {
                return Ok(false);
            }
        }
        return Ok(true);
    }
    if let (Ok(a), Ok(b)) = (left.as_array_ref(), right.as_array_ref()) {
        let (a, b): (&Array, &Array) = (&a, &b);
        if a.len() != b.len() {
            return Ok(false);
        }
        meter.charge(8 * a.len())?;
        for (left, right) in a.iter().zip(b) {
            if !equal(meter, left, right)? {
                return Ok(false);
            }
        }
        return Ok(true);
    }
    let (a, b) = (Operand::of(left), Operand::of(right));
    meter.charge(a.elements() + b.elements())?;
    Ok(match (a, b) {
        (Operand::Vector(a), Operand::Vector(b)) => {
            a.len() == b.len()
                && a.elements()
                    .iter()
                    .zip(b.elements())
                    .all(|(a, b)| is_equal(*a, *b))
        }
        (Operand::Matrix(a), Operand::Matrix(b)) => {
            (a.rows(), a.columns()) == (b.rows(), b.columns())
                && a.elements().zip(b.elements()).all(|(a, b)| is_equal(a, b))
        }
        _ => left.is_unit() && right.is_unit(),
    })
}

#[expect(clippy::float_cmp, reason = "`==` of the language is exact")]
fn is_equal(a: f64, b: f64) -> bool {
    a == b
}
