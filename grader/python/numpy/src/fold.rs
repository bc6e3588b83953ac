//! The methods of elementwise functions of two arrays: `np.add.reduce`, `np.maximum.accumulate`, `np.subtract.outer`.

use crate::convert;
use crate::dtype::Dtype;
use crate::errors;
use crate::function::{Arguments, deliver};
use crate::reduce;
use crate::ufunc::{Binary, Two};
use crate::view::{Shape, View};
use rustpython_vm::{PyResult, VirtualMachine};

/// The elements, the kind of the result and the function that a fold uses: sums and products of bools count.
fn start(function: &Binary, view: View, vm: &VirtualMachine) -> PyResult<(View, Dtype, Two)> {
    let counts = matches!(function.name, "add" | "multiply") && view.dtype() == Dtype::Bool;
    let view = if counts { view.cast(Dtype::Int) } else { view };
    let (dtype, each) = function.select(view.dtype(), vm)?;
    Ok((view, dtype, each))
}

/// What a fold of no elements gives.
fn identity(name: &str) -> Option<f64> {
    match name {
        "add" | "logical_or" | "logical_xor" | "bitwise_or" | "bitwise_xor" | "hypot" | "gcd" => {
            Some(0.0)
        }
        "multiply" | "logical_and" => Some(1.0),
        "bitwise_and" => Some(-1.0),
        _ => None,
    }
}

/// `function.reduce(array, axis=0)`.
///
/// # Errors
///
/// AxisError for an axis that is not there, ValueError for no elements.
pub fn reduce(
    function: &'static Binary,
    arguments: &mut Arguments,
    vm: &VirtualMachine,
) -> PyResult {
    let view = arguments.array("array", vm)?;
    let axis = match arguments.next("axis") {
        None => Some(0),
        Some(axis) if vm.is_none(&axis) => None,
        Some(axis) => reduce::axis_of(Some(axis), view.rank(), vm)?,
    };
    let view = match arguments.optional_dtype("dtype", vm)? {
        Some(dtype) => view.cast(dtype),
        None => view,
    };
    let out = arguments.optional("out", vm);
    let keep_dimensions = arguments.optional_truth("keepdims", vm)?.unwrap_or(false);
    let (view, dtype, each) = start(function, view, vm)?;
    let result = reduce::along(&view, axis, keep_dimensions, dtype, |lane| {
        let first = lane.first().copied().or_else(|| identity(function.name));
        let Some(first) = first else {
            return Err(vm.new_value_error(format!(
                "zero-size array to reduction operation {} which has no identity",
                function.name
            )));
        };
        Ok(dtype.cast(
            lane.iter()
                .skip(1)
                .fold(first, |known, value| each(known, *value)),
        ))
    })?;
    deliver(function.name, result, out, vm)
}

/// `function.accumulate(array, axis=0)`.
///
/// # Errors
///
/// AxisError for an axis that is not there, TypeError for a number.
pub fn accumulate(
    function: &'static Binary,
    arguments: &mut Arguments,
    vm: &VirtualMachine,
) -> PyResult {
    let view = arguments.array("array", vm)?;
    let axis = arguments.optional_integer("axis", vm)?.unwrap_or(0);
    if view.rank() == 0 {
        return Err(vm.new_type_error("cannot accumulate on a scalar"));
    }
    let axis = errors::checked_axis(axis, view.rank(), vm)?;
    let (view, dtype, each) = start(function, view, vm)?;
    let result = reduce::lanes(&view, axis, dtype, |lane| {
        let mut known: Option<f64> = None;
        let next = |value: &f64| {
            let next = known.map_or(*value, |known| each(known, *value));
            known = Some(next);
            dtype.cast(next)
        };
        lane.iter().map(next).collect()
    });
    Ok(convert::object(result, vm))
}

/// `function.outer(a, b)`: every element of one with every element of the other.
///
/// # Errors
///
/// ValueError for a result of more than two dimensions.
pub fn outer(
    function: &'static Binary,
    arguments: &mut Arguments,
    vm: &VirtualMachine,
) -> PyResult {
    let left = arguments.array("A", vm)?;
    let right = arguments.array("B", vm)?;
    let rank = left.rank() + right.rank();
    if rank > 2 {
        return Err(errors::too_many_dimensions(vm));
    }
    if left.rank() == 0 || right.rank() == 0 {
        return Ok(convert::object(function.apply(&left, &right, vm)?, vm));
    }
    let flat = |view: View| view.reshaped(Shape::vector(view.size()));
    let result = function.apply(&flat(left).as_column(), &flat(right).as_row(), vm)?;
    Ok(convert::object(result, vm))
}
