//! Products of vectors and matrices: `@`, dot, inner, outer, cross, kron, and the trace.

use crate::broadcast;
use crate::construct;
use crate::convert;
use crate::dtype::Dtype;
use crate::errors;
use crate::function::Arguments;
use crate::reduce;
use crate::view::{Shape, View};
use rustpython_vm::{PyObject, PyResult, VirtualMachine};

/// The plain product of two matrices whose inner lengths match; the sum of each element goes from first to last.
fn product(left: &View, right: &View, dtype: Dtype, vm: &VirtualMachine) -> PyResult<View> {
    let (rows, inner, columns) = (left.rows(), left.columns(), right.columns());
    let shape = Shape::matrix(rows, columns);
    shape.check_size(vm)?;
    let (left, right) = (left.row_by_row(), right.row_by_row());
    let mut values = Vec::with_capacity(shape.size());
    for row in 0..rows {
        for column in 0..columns {
            let mut sum = 0.0;
            for place in 0..inner {
                sum += left[row * inner + place].get() * right[place * columns + column].get();
            }
            values.push(if dtype == Dtype::Bool {
                dtype.cast(sum)
            } else {
                sum
            });
        }
    }
    Ok(View::new(dtype, shape, values))
}

/// `left @ right`.
///
/// # Errors
///
/// ValueError, with numpy's sentences, for numbers and for lengths that do not match.
pub fn multiplied(left: &View, right: &View, vm: &VirtualMachine) -> PyResult<View> {
    for (place, view) in [left, right].into_iter().enumerate() {
        if view.rank() == 0 {
            return Err(vm.new_value_error(format!(
                "matmul: Input operand {place} does not have enough dimensions (has 0, gufunc core with signature (n?,k),(k,m?)->(n?,m?) requires 1)"
            )));
        }
    }
    let inner = if right.rank() == 1 {
        right.columns()
    } else {
        right.rows()
    };
    if left.columns() != inner {
        return Err(vm.new_value_error(format!(
            "matmul: Input operand 1 has a mismatch in its core dimension 0, with gufunc signature (n?,k),(k,m?)->(n?,m?) \
             (size {inner} is different from {})",
            left.columns()
        )));
    }
    aligned(left, right, vm)
}

/// The product of operands of rank 1 or 2 whose inner lengths match.
fn aligned(left: &View, right: &View, vm: &VirtualMachine) -> PyResult<View> {
    let dtype = left.dtype().max(right.dtype());
    let tall = if right.rank() == 1 {
        right.as_column()
    } else {
        right.clone()
    };
    let result = product(left, &tall, dtype, vm)?;
    Ok(result.reshaped(match (left.rank(), right.rank()) {
        (2, 2) => Shape::matrix(left.rows(), right.columns()),
        (2, _) => Shape::vector(left.rows()),
        (_, 2) => Shape::vector(right.columns()),
        _ => Shape::NUMBER,
    }))
}

/// The operator `@` as Python calls it.
///
/// # Errors
///
/// As [`multiplied`].
pub fn operate(left: &PyObject, right: &PyObject, vm: &VirtualMachine) -> PyResult {
    let (Some(left), Some(right)) = (convert::operand(left, vm)?, convert::operand(right, vm)?)
    else {
        return Ok(vm.ctx.not_implemented());
    };
    Ok(convert::object(multiplied(&left, &right, vm)?, vm))
}

/// `numpy.matmul`.
///
/// # Errors
///
/// As [`multiplied`].
pub fn matmul(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let left = arguments.array("x1", vm)?;
    let right = arguments.array("x2", vm)?;
    let out = arguments.optional("out", vm);
    crate::function::deliver("matmul", multiplied(&left, &right, vm)?, out, vm)
}

fn not_aligned(
    left: &View,
    right: &View,
    axes: (usize, usize),
    vm: &VirtualMachine,
) -> rustpython_vm::builtins::PyBaseExceptionRef {
    let length =
        |view: &View, axis: usize| view.shape().dimensions().get(axis).copied().unwrap_or(0);
    vm.new_value_error(format!(
        "shapes {} and {} not aligned: {} (dim {}) != {} (dim {})",
        left.shape().sentence(),
        right.shape().sentence(),
        length(left, axes.0),
        axes.0,
        length(right, axes.1),
        axes.1
    ))
}

/// `numpy.dot`.
///
/// # Errors
///
/// ValueError for lengths that do not match.
pub fn dot(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let left = arguments.array("a", vm)?;
    let right = arguments.array("b", vm)?;
    let out = arguments.optional("out", vm);
    let result = if left.rank() == 0 || right.rank() == 0 {
        crate::ufunc::MULTIPLY.apply(&left, &right, vm)?
    } else {
        let inner = if right.rank() == 1 {
            right.columns()
        } else {
            right.rows()
        };
        if left.columns() != inner {
            return Err(not_aligned(&left, &right, (left.rank() - 1, 0), vm));
        }
        aligned(&left, &right, vm)?
    };
    crate::function::deliver("dot", result, out, vm)
}

/// `numpy.inner`: products along the last axis of both.
///
/// # Errors
///
/// ValueError for lengths that do not match.
pub fn inner(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let left = arguments.array("a", vm)?;
    let right = arguments.array("b", vm)?;
    if left.rank() == 0 || right.rank() == 0 {
        return Ok(convert::object(
            crate::ufunc::MULTIPLY.apply(&left, &right, vm)?,
            vm,
        ));
    }
    if left.columns() != right.columns() {
        return Err(not_aligned(
            &left,
            &right,
            (left.rank() - 1, right.rank() - 1),
            vm,
        ));
    }
    Ok(convert::object(
        aligned(&left, &right.transposed(), vm)?,
        vm,
    ))
}

/// `numpy.vdot`: the product of all elements as vectors.
///
/// # Errors
///
/// ValueError for sizes that differ.
pub fn vdot(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let flat = |view: View| view.reshaped(Shape::vector(view.size()));
    let left = flat(arguments.array("a", vm)?);
    let right = flat(arguments.array("b", vm)?);
    if left.size() != right.size() {
        return Err(vm.new_value_error("cannot reshape array for vdot: the sizes differ"));
    }
    Ok(convert::object(aligned(&left, &right, vm)?, vm))
}

/// `numpy.outer`: every element of one with every element of the other.
///
/// # Errors
///
/// MemoryError for too many elements.
pub fn outer(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let flat = |view: View| view.reshaped(Shape::vector(view.size()));
    let left = flat(arguments.array("a", vm)?);
    let right = flat(arguments.array("b", vm)?);
    let result = crate::ufunc::MULTIPLY.apply(&left.as_column(), &right.as_row(), vm)?;
    Ok(convert::object(result, vm))
}

/// `numpy.kron`.
///
/// # Errors
///
/// MemoryError for too many elements.
pub fn kron(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let left = arguments.array("a", vm)?;
    let right = arguments.array("b", vm)?;
    let rows = left.rows().saturating_mul(right.rows());
    let columns = left.columns().saturating_mul(right.columns());
    let shape = Shape::matrix(rows, columns).with_rank(left.rank().max(right.rank()));
    shape.check_size(vm)?;
    let mut values = Vec::with_capacity(shape.size());
    for row in 0..rows {
        for column in 0..columns {
            let outer = left.at(row / right.rows(), column / right.columns());
            values.push(outer * right.at(row % right.rows(), column % right.columns()));
        }
    }
    let dtype = left.dtype().max(right.dtype());
    Ok(convert::object(View::new(dtype, shape, values), vm))
}

fn cross_of(left: &[f64], right: &[f64]) -> Vec<f64> {
    let third = |vector: &[f64]| vector.get(2).copied().unwrap_or(0.0);
    if left.len() == 2 && right.len() == 2 {
        return vec![left[0] * right[1] - left[1] * right[0]];
    }
    vec![
        left[1] * third(right) - third(left) * right[1],
        third(left) * right[0] - left[0] * third(right),
        left[0] * right[1] - left[1] * right[0],
    ]
}

/// `numpy.cross` of vectors with 2 or 3 elements, or of rows of them.
///
/// # Errors
///
/// ValueError for other lengths.
pub fn cross(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let left = arguments.array("a", vm)?;
    let right = arguments.array("b", vm)?;
    for keyword in ["axisa", "axisb", "axisc"] {
        if arguments.keyword(keyword, vm).is_some() {
            return Err(vm.new_type_error("cross() here goes along the last axis only"));
        }
    }
    if let Some(axis) = arguments.keyword("axis", vm) {
        let axis = convert::integer(&axis, vm)?;
        if errors::checked_axis(axis, left.rank(), vm)? + 1 != left.rank() {
            return Err(vm.new_value_error("cross() here goes along the last axis only"));
        }
    }
    if left.rank() == 0 || right.rank() == 0 {
        return Err(vm.new_value_error("At least one array has zero dimension"));
    }
    if left.dtype().max(right.dtype()) == Dtype::Bool {
        // the difference refuses bools, as numpy does
        crate::ufunc::SUBTRACT.apply(&left, &left, vm)?;
    }
    let fits = |view: &View| matches!(view.columns(), 2 | 3);
    if !fits(&left) || !fits(&right) {
        return Err(vm.new_value_error(
            "incompatible dimensions for cross product\n(dimension must be 2 or 3)",
        ));
    }
    let rows = match broadcast::common_shape(
        Shape::matrix(left.rows(), 1),
        Shape::matrix(right.rows(), 1),
    ) {
        Some(shape) => shape.rows(),
        None => return Err(errors::no_broadcast(left.shape(), right.shape(), vm)),
    };
    let length = if left.columns() == 2 && right.columns() == 2 {
        1
    } else {
        3
    };
    let line = |view: &View, row: usize| view.row(if view.rows() == 1 { 0 } else { row }).values();
    let mut values = Vec::with_capacity(rows * length);
    for row in 0..rows {
        values.extend(cross_of(&line(&left, row), &line(&right, row)));
    }
    let dtype = left.dtype().max(right.dtype());
    let is_matrix = left.rank() == 2 || right.rank() == 2;
    let shape = match (is_matrix, length) {
        (true, 1) => Shape::vector(rows),
        (true, _) => Shape::matrix(rows, 3),
        (false, 1) => Shape::NUMBER,
        (false, _) => Shape::vector(3),
    };
    Ok(convert::object(View::new(dtype, shape, values), vm))
}

fn diagonal_argument(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult<View> {
    let view = arguments.array("a", vm)?;
    let offset = arguments.optional_integer("offset", vm)?.unwrap_or(0);
    if view.rank() < 2 {
        return Err(vm.new_value_error("diag requires an array of at least two dimensions"));
    }
    Ok(construct::diagonal_of(&view, offset))
}

/// `numpy.trace`.
///
/// # Errors
///
/// ValueError for fewer than two dimensions.
pub fn trace(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let diagonal = diagonal_argument(arguments, vm)?;
    let sum = reduce::total(&diagonal.values());
    Ok(convert::element(sum, diagonal.dtype().max(Dtype::Int), vm))
}

/// `numpy.diagonal`, as a copy.
///
/// # Errors
///
/// ValueError for fewer than two dimensions.
pub fn diagonal(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    Ok(convert::object(
        diagonal_argument(arguments, vm)?.copied(),
        vm,
    ))
}
