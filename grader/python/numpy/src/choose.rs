//! Functions that choose or compare elements: where, clip, round, nonzero, isclose and their like.

use crate::broadcast;
use crate::convert;
use crate::dtype::Dtype;
use crate::function::{Arguments, deliver};
use crate::ufunc;
use crate::view::{Shape, View};
use rustpython_vm::{PyObjectRef, PyResult, VirtualMachine};

/// For each axis, the places of the elements that are not zero.
fn places(view: &View) -> Vec<View> {
    let mut rows = Vec::new();
    let mut columns = Vec::new();
    for row in 0..view.rows() {
        for column in 0..view.columns() {
            if view.at(row, column) != 0.0 {
                rows.push(row as f64);
                columns.push(column as f64);
            }
        }
    }
    let vector = |values: Vec<f64>| View::new(Dtype::Int, Shape::vector(values.len()), values);
    if view.rank() == 2 {
        vec![vector(rows), vector(columns)]
    } else {
        vec![vector(columns)]
    }
}

fn tuple_of(views: Vec<View>, vm: &VirtualMachine) -> PyObjectRef {
    let arrays = views
        .into_iter()
        .map(|view| convert::object(view, vm))
        .collect();
    vm.ctx.new_tuple(arrays).into()
}

/// `numpy.nonzero`.
///
/// # Errors
///
/// TypeError for what holds no numbers.
pub fn nonzero(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    Ok(tuple_of(places(&view), vm))
}

/// `numpy.flatnonzero`.
///
/// # Errors
///
/// As [`nonzero`].
pub fn flatnonzero(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let flat = view.reshaped(Shape::vector(view.size()));
    Ok(convert::object(places(&flat).swap_remove(0), vm))
}

/// `numpy.argwhere`.
///
/// # Errors
///
/// As [`nonzero`].
pub fn argwhere(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let axes = places(&view);
    let count = axes.first().map_or(0, View::size);
    let values = (0..count)
        .flat_map(|place| axes.iter().map(move |axis| axis.at(0, place)))
        .collect();
    Ok(convert::object(
        View::new(Dtype::Int, Shape::matrix(count, axes.len()), values),
        vm,
    ))
}

/// `numpy.where`, with three arguments or with the condition only.
///
/// # Errors
///
/// ValueError for two arguments, and for shapes that do not go together.
pub fn choose(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let condition = arguments.array("condition", vm)?;
    let yes = arguments.next("x");
    let no = arguments.next("y");
    let (yes, no) = match (yes, no) {
        (Some(yes), Some(no)) => (convert::view_of(&yes, vm)?, convert::view_of(&no, vm)?),
        (None, None) => return Ok(tuple_of(places(&condition), vm)),
        _ => return Err(vm.new_value_error("either both or neither of x and y should be given")),
    };
    let dtype = yes.dtype().max(no.dtype());
    let both = broadcast::common_shape(yes.shape(), no.shape());
    let shape = both.and_then(|shape| broadcast::common_shape(condition.shape(), shape));
    let views = shape.and_then(|shape| {
        Some((
            condition.broadcast_to(shape)?,
            yes.broadcast_to(shape)?,
            no.broadcast_to(shape)?,
        ))
    });
    let Some((condition, yes, no)) = views else {
        return Err(vm.new_value_error(format!(
            "operands could not be broadcast together with shapes {} {} {} ",
            condition.shape().sentence(),
            yes.shape().sentence(),
            no.shape().sentence()
        )));
    };
    condition.shape().check_size(vm)?;
    let chosen = condition
        .values()
        .into_iter()
        .zip(yes.values().into_iter().zip(no.values()))
        .map(|(condition, (yes, no))| if condition != 0.0 { yes } else { no })
        .collect();
    Ok(convert::object(
        View::new(dtype, condition.shape(), chosen),
        vm,
    ))
}

/// `numpy.clip`.
///
/// # Errors
///
/// ValueError for shapes that do not go together.
pub fn clip(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let mut view = arguments.array("a", vm)?;
    let low = arguments.optional_array("a_min", vm)?;
    let high = arguments.optional_array("a_max", vm)?;
    let out = arguments.optional("out", vm);
    let low = match low {
        Some(low) => Some(low),
        None => keyword_array(arguments, "min", vm)?,
    };
    let high = match high {
        Some(high) => Some(high),
        None => keyword_array(arguments, "max", vm)?,
    };
    if let Some(low) = low {
        view = ufunc::MAXIMUM.apply(&view, &low, vm)?;
    }
    if let Some(high) = high {
        view = ufunc::MINIMUM.apply(&view, &high, vm)?;
    }
    let result = if out.is_some() { view } else { view.copied() };
    deliver("clip", result, out, vm)
}

fn keyword_array(
    arguments: &mut Arguments,
    name: &str,
    vm: &VirtualMachine,
) -> PyResult<Option<View>> {
    arguments
        .keyword(name, vm)
        .map(|object| convert::view_of(&object, vm))
        .transpose()
}

fn power_of_ten(exponent: usize) -> f64 {
    (0..exponent.min(400)).fold(1.0, |power, _| power * 10.0)
}

/// `numpy.round`: halves go to the even neighbour.
///
/// # Errors
///
/// TypeError for what holds no numbers.
pub fn round(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let decimals = arguments.optional_integer("decimals", vm)?.unwrap_or(0);
    let out = arguments.optional("out", vm);
    let scale = power_of_ten(decimals.unsigned_abs());
    let result = match (view.dtype(), decimals) {
        (Dtype::Bool | Dtype::Int, 0..) => view.copied(),
        (_, 0) => broadcast::map(&view, view.dtype(), f64::round_ties_even),
        (dtype, 1..) => broadcast::map(&view, dtype, |value| {
            (value * scale).round_ties_even() / scale
        }),
        (dtype, _) => broadcast::map(&view, dtype, |value| {
            (value / scale).round_ties_even() * scale
        }),
    };
    deliver("round", result, out, vm)
}

struct Closeness {
    relative: f64,
    absolute: f64,
    equal_nan: bool,
}

impl Closeness {
    fn read(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult<Self> {
        Ok(Self {
            relative: arguments.optional_float("rtol", vm)?.unwrap_or(1e-5),
            absolute: arguments.optional_float("atol", vm)?.unwrap_or(1e-8),
            equal_nan: arguments.optional_truth("equal_nan", vm)?.unwrap_or(false),
        })
    }

    fn holds(&self, left: f64, right: f64) -> bool {
        if left.is_nan() || right.is_nan() {
            return self.equal_nan && left.is_nan() && right.is_nan();
        }
        if left.is_infinite() || right.is_infinite() {
            return left == right;
        }
        (left - right).abs() <= self.absolute + self.relative * right.abs()
    }
}

fn closeness(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult<View> {
    let left = arguments.array("a", vm)?;
    let right = arguments.array("b", vm)?;
    let close = Closeness::read(arguments, vm)?;
    let each = |left, right| f64::from(u8::from(close.holds(left, right)));
    broadcast::combine(&left, &right, Dtype::Bool, each, vm)
}

/// `numpy.isclose`.
///
/// # Errors
///
/// ValueError for shapes that do not go together.
pub fn isclose(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    Ok(convert::object(closeness(arguments, vm)?, vm))
}

/// `numpy.allclose`.
///
/// # Errors
///
/// ValueError for shapes that do not go together.
pub fn allclose(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let all = closeness(arguments, vm)?
        .values()
        .iter()
        .all(|value| *value != 0.0);
    Ok(vm.ctx.new_bool(all).into())
}

/// `numpy.array_equal`.
///
/// # Errors
///
/// TypeError for what holds no numbers.
pub fn array_equal(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let left = arguments.array("a1", vm)?;
    let right = arguments.array("a2", vm)?;
    let equal_nan = arguments.optional_truth("equal_nan", vm)?.unwrap_or(false);
    let same = |(left, right): (&f64, f64)| {
        *left == right || (equal_nan && left.is_nan() && right.is_nan())
    };
    let equal = left.shape() == right.shape() && left.values().iter().zip(right.values()).all(same);
    Ok(vm.ctx.new_bool(equal).into())
}

/// `numpy.nan_to_num`.
///
/// # Errors
///
/// TypeError for what holds no numbers.
pub fn nan_to_num(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("x", vm)?;
    let _ = arguments.optional("copy", vm);
    let nan = arguments.optional_float("nan", vm)?.unwrap_or(0.0);
    let positive = arguments.optional_float("posinf", vm)?.unwrap_or(f64::MAX);
    let negative = arguments.optional_float("neginf", vm)?.unwrap_or(f64::MIN);
    let each = |value: f64| {
        if value.is_nan() {
            nan
        } else if value == f64::INFINITY {
            positive
        } else if value == f64::NEG_INFINITY {
            negative
        } else {
            value
        }
    };
    Ok(convert::object(
        broadcast::map(&view, view.dtype(), each),
        vm,
    ))
}

/// `numpy.isscalar`.
///
/// # Errors
///
/// OverflowError for an int that int64 does not hold.
pub fn isscalar(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let object = arguments.required("element", vm)?;
    let is_text = object
        .downcast_ref::<rustpython_vm::builtins::PyStr>()
        .is_some();
    let scalar = is_text || convert::number(&object, vm)?.is_some();
    Ok(vm.ctx.new_bool(scalar).into())
}
