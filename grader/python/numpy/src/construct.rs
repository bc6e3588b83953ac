//! Functions that make arrays: from lists, of one value, of steps, with a diagonal.

use crate::convert;
use crate::dtype::Dtype;
use crate::errors;
use crate::function::Arguments;
use crate::view::{Shape, View, check_count};
use rustpython_vm::{AsObject as _, PyObjectRef, PyResult, VirtualMachine};

fn done(view: View, vm: &VirtualMachine) -> PyResult {
    Ok(convert::object(view, vm))
}

/// `numpy.array`.
///
/// # Errors
///
/// TypeError for what holds no numbers, ValueError for ragged lists and more than two dimensions.
pub fn array(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let object = arguments.required("object", vm)?;
    let view = convert::view_of(&object, vm)?;
    let dtype = arguments.optional_dtype("dtype", vm)?;
    let _ = arguments.keyword("copy", vm);
    let minimum = arguments.keyword("ndmin", vm);
    let dtype = dtype.unwrap_or(view.dtype());
    // what was read from lists has cells of its own already
    let shared = object.downcast_ref::<crate::array::NdArray>().is_some();
    let mut view = if shared || dtype != view.dtype() {
        view.cast(dtype)
    } else {
        view
    };
    if let Some(minimum) = minimum {
        let minimum = convert::integer(&minimum, vm)?;
        if minimum > 2 {
            return Err(errors::too_many_dimensions(vm));
        }
        let rank = view.rank().max(minimum.max(0) as usize);
        view = view.reshaped(view.shape().with_rank(rank));
    }
    done(view, vm)
}

/// `numpy.asarray`: the same object when it is an array of this kind already.
///
/// # Errors
///
/// As [`array`].
pub fn asarray(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let object = arguments.required("a", vm)?;
    let dtype = arguments.optional_dtype("dtype", vm)?;
    let view = convert::view_of(&object, vm)?;
    if dtype.is_none_or(|dtype| dtype == view.dtype()) {
        if view.rank() > 0 && object.downcast_ref::<crate::array::NdArray>().is_some() {
            return Ok(object);
        }
        return done(view, vm);
    }
    done(view.cast(dtype.unwrap_or(view.dtype())), vm)
}

/// `numpy.copy`.
///
/// # Errors
///
/// As [`array`].
pub fn copy(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    done(arguments.array("a", vm)?.copied(), vm)
}

fn filled(shape: Shape, dtype: Dtype, value: f64, vm: &VirtualMachine) -> PyResult {
    shape.check_size(vm)?;
    done(View::new(dtype, shape, vec![value; shape.size()]), vm)
}

fn constant(arguments: &mut Arguments, value: f64, vm: &VirtualMachine) -> PyResult {
    let shape = arguments.required("shape", vm)?;
    let shape = convert::shape(&shape, vm)?;
    let dtype = arguments
        .optional_dtype("dtype", vm)?
        .unwrap_or(Dtype::Float);
    filled(shape, dtype, value, vm)
}

/// `numpy.zeros`, and `numpy.empty`, so that no run depends on what was in memory.
///
/// # Errors
///
/// TypeError and ValueError for what is no shape, MemoryError for too large a one.
pub fn zeros(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    constant(arguments, 0.0, vm)
}

/// `numpy.ones`.
///
/// # Errors
///
/// As [`zeros`].
pub fn ones(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    constant(arguments, 1.0, vm)
}

fn repeated(shape: Shape, value: &View, dtype: Option<Dtype>, vm: &VirtualMachine) -> PyResult {
    shape.check_size(vm)?;
    let Some(value) = value.broadcast_to(shape) else {
        return Err(vm.new_value_error(format!(
            "could not broadcast input array from shape {} into shape {}",
            value.shape().sentence(),
            shape.sentence()
        )));
    };
    done(value.cast(dtype.unwrap_or(value.dtype())), vm)
}

/// `numpy.full`.
///
/// # Errors
///
/// As [`zeros`]; ValueError when the value does not go into the shape.
pub fn full(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let shape = arguments.required("shape", vm)?;
    let shape = convert::shape(&shape, vm)?;
    let value = arguments.array("fill_value", vm)?;
    let dtype = arguments.optional_dtype("dtype", vm)?;
    repeated(shape, &value, dtype, vm)
}

fn constant_like(arguments: &mut Arguments, value: f64, vm: &VirtualMachine) -> PyResult {
    let like = arguments.array("a", vm)?;
    let dtype = arguments
        .optional_dtype("dtype", vm)?
        .unwrap_or(like.dtype());
    filled(like.shape(), dtype, value, vm)
}

/// `numpy.zeros_like`, and `numpy.empty_like`.
///
/// # Errors
///
/// As [`array`].
pub fn zeros_like(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    constant_like(arguments, 0.0, vm)
}

/// `numpy.ones_like`.
///
/// # Errors
///
/// As [`array`].
pub fn ones_like(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    constant_like(arguments, 1.0, vm)
}

/// `numpy.full_like`.
///
/// # Errors
///
/// As [`array`]; ValueError when the value does not go into the shape.
pub fn full_like(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let like = arguments.array("a", vm)?;
    let value = arguments.array("fill_value", vm)?;
    let dtype = arguments
        .optional_dtype("dtype", vm)?
        .unwrap_or(like.dtype());
    repeated(like.shape(), &value, Some(dtype), vm)
}

fn length(object: &PyObjectRef, vm: &VirtualMachine) -> PyResult<usize> {
    // numpy makes an empty array of a negative length here
    Ok(convert::integer(object, vm)?.max(0) as usize)
}

/// A matrix whose elements depend on their row and column.
fn by_place(
    rows: usize,
    columns: usize,
    dtype: Dtype,
    each: impl Fn(usize, usize) -> f64,
    vm: &VirtualMachine,
) -> PyResult {
    let shape = Shape::matrix(rows, columns);
    shape.check_size(vm)?;
    let mut values = Vec::with_capacity(shape.size());
    for row in 0..rows {
        for column in 0..columns {
            values.push(each(row, column));
        }
    }
    done(View::new(dtype, shape, values), vm)
}

/// `numpy.eye`.
///
/// # Errors
///
/// TypeError for lengths that are no ints.
pub fn eye(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let rows = length(&arguments.required("N", vm)?, vm)?;
    let columns = match arguments.optional("M", vm) {
        Some(object) => length(&object, vm)?,
        None => rows,
    };
    let diagonal = arguments.optional_integer("k", vm)?.unwrap_or(0);
    let dtype = arguments
        .optional_dtype("dtype", vm)?
        .unwrap_or(Dtype::Float);
    let on =
        |row: usize, column: usize| f64::from(u8::from(column as isize - row as isize == diagonal));
    by_place(rows, columns, dtype, on, vm)
}

/// `numpy.identity`.
///
/// # Errors
///
/// TypeError for a length that is no int.
pub fn identity(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let size = length(&arguments.required("n", vm)?, vm)?;
    let dtype = arguments
        .optional_dtype("dtype", vm)?
        .unwrap_or(Dtype::Float);
    by_place(
        size,
        size,
        dtype,
        |row, column| f64::from(u8::from(row == column)),
        vm,
    )
}

/// The elements of a matrix on the diagonal that is `diagonal` places right of the main one.
#[must_use]
pub fn diagonal_of(view: &View, diagonal: isize) -> View {
    let row = (-diagonal).max(0) as usize;
    let column = diagonal.max(0) as usize;
    let count = view
        .rows()
        .saturating_sub(row)
        .min(view.columns().saturating_sub(column));
    let first = if count > 0 {
        view.position(row, column)
    } else {
        0
    };
    let (row_stride, column_stride) = view.strides();
    view.window(first, &[(count, row_stride + column_stride)])
}

/// `numpy.diag`.
///
/// # Errors
///
/// As [`array`]; ValueError for a number.
pub fn diag(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("v", vm)?;
    let diagonal = arguments.optional_integer("k", vm)?.unwrap_or(0);
    match view.rank() {
        0 => Err(vm.new_value_error("Input must be 1- or 2-d.")),
        1 => {
            let size = view.columns() + diagonal.unsigned_abs();
            let row = (-diagonal).max(0) as usize;
            let column = diagonal.max(0) as usize;
            let each = |at_row: usize, at_column: usize| {
                if at_row >= row && at_column >= column && at_row - row == at_column - column {
                    view.at(0, at_row - row)
                } else {
                    0.0
                }
            };
            by_place(size, size, view.dtype(), each, vm)
        }
        _ => done(diagonal_of(&view, diagonal).copied(), vm),
    }
}

fn triangle(
    arguments: &mut Arguments,
    keep: fn(isize, isize) -> bool,
    vm: &VirtualMachine,
) -> PyResult {
    let view = arguments.array("m", vm)?;
    let diagonal = arguments.optional_integer("k", vm)?.unwrap_or(0);
    // numpy repeats a vector to a square
    let size = view.columns();
    let square = if view.rank() < 2 {
        view.broadcast_to(Shape::matrix(size, size))
            .unwrap_or_else(|| view.clone())
    } else {
        view
    };
    let each = |row: usize, column: usize| {
        if keep(column as isize - row as isize, diagonal) {
            square.at(row, column)
        } else {
            0.0
        }
    };
    by_place(square.rows(), square.columns(), square.dtype(), each, vm)
}

/// `numpy.tril`.
///
/// # Errors
///
/// As [`array`].
pub fn tril(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    triangle(arguments, |place, diagonal| place <= diagonal, vm)
}

/// `numpy.triu`.
///
/// # Errors
///
/// As [`array`].
pub fn triu(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    triangle(arguments, |place, diagonal| place >= diagonal, vm)
}

/// `numpy.arange`.
///
/// # Errors
///
/// TypeError without a stop, ZeroDivisionError for a step of zero, MemoryError for too many elements.
pub fn arange(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let mut first = arguments.optional("start", vm);
    let mut second = arguments.optional("stop", vm);
    if first.is_none() {
        first = second.take();
    }
    let step = arguments.optional("step", vm);
    let dtype = arguments.optional_dtype("dtype", vm)?;
    let Some(first) = first else {
        return Err(vm.new_type_error("arange() requires stop to be specified."));
    };
    let read = |object: &PyObjectRef| {
        convert::number(object, vm)?.ok_or_else(|| vm.new_type_error("arange() takes numbers here"))
    };
    let (first, mut kind) = read(&first)?;
    let (start, stop) = match &second {
        Some(second) => {
            let (stop, dtype) = read(second)?;
            kind = kind.max(dtype);
            (first, stop)
        }
        None => (0.0, first),
    };
    let mut by = 1.0;
    if let Some(step) = &step {
        let (value, dtype) = read(step)?;
        by = value;
        kind = kind.max(dtype);
    }
    if by == 0.0 {
        return Err(vm.new_zero_division_error("division by zero"));
    }
    let count = ((stop - start) / by).ceil().max(0.0);
    if !(stop - start).is_finite() || count.is_nan() {
        return Err(vm.new_value_error("arange: cannot compute length"));
    }
    check_count(count as usize, vm)?;
    // numpy takes the difference of the first two elements as the step
    let difference = (start + by) - start;
    let values = (0..count as usize)
        .map(|place| start + place as f64 * difference)
        .collect();
    let view = View::new(Dtype::Float, Shape::vector(count as usize), values);
    done(view.cast(dtype.unwrap_or(kind.max(Dtype::Int))), vm)
}

fn spaced(start: f64, stop: f64, count: usize, endpoint: bool) -> (Vec<f64>, f64) {
    let gaps = if endpoint {
        count.saturating_sub(1)
    } else {
        count
    };
    if gaps == 0 {
        return (vec![start; count], f64::NAN);
    }
    let step = (stop - start) / gaps as f64;
    let mut values: Vec<f64> = (0..count)
        .map(|place| place as f64 * step + start)
        .collect();
    if endpoint && let Some(last) = values.last_mut() {
        *last = stop;
    }
    (values, step)
}

fn count_of(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult<usize> {
    let count = arguments.optional_integer("num", vm)?.unwrap_or(50);
    if count < 0 {
        return Err(
            vm.new_value_error(format!("Number of samples, {count}, must be non-negative."))
        );
    }
    check_count(count as usize, vm)?;
    Ok(count as usize)
}

/// `numpy.linspace`.
///
/// # Errors
///
/// TypeError for what is no number, ValueError for a negative count.
pub fn linspace(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let start = arguments.array("start", vm)?;
    let stop = arguments.array("stop", vm)?;
    let count = count_of(arguments, vm)?;
    let endpoint = arguments.optional_truth("endpoint", vm)?.unwrap_or(true);
    let step_too = arguments.optional_truth("retstep", vm)?.unwrap_or(false);
    let dtype = arguments
        .optional_dtype("dtype", vm)?
        .unwrap_or(Dtype::Float);
    if start.rank() == 0 && stop.rank() == 0 {
        let (values, step) = spaced(start.at(0, 0), stop.at(0, 0), count, endpoint);
        let view = View::vector(values);
        let view = if dtype == Dtype::Int {
            // whole numbers are floored, not truncated
            View::new(
                dtype,
                view.shape(),
                view.values().into_iter().map(f64::floor).collect(),
            )
        } else {
            view.cast(dtype)
        };
        let array = convert::object(view, vm);
        if step_too {
            return Ok(vm
                .ctx
                .new_tuple(vec![array, vm.ctx.new_float(step).into()])
                .into());
        }
        return Ok(array);
    }
    let (start, stop) = crate::broadcast::together(&start, &stop, vm)?;
    if start.rank() > 1 || step_too {
        return Err(errors::too_many_dimensions(vm));
    }
    let shape = Shape::matrix(count, start.columns());
    shape.check_size(vm)?;
    let lines: Vec<Vec<f64>> = (0..start.columns())
        .map(|column| spaced(start.at(0, column), stop.at(0, column), count, endpoint).0)
        .collect();
    let values = (0..count)
        .flat_map(|row| lines.iter().map(move |line| line[row]))
        .collect();
    done(View::new(Dtype::Float, shape, values).cast(dtype), vm)
}

/// `numpy.logspace`.
///
/// # Errors
///
/// As [`linspace`].
pub fn logspace(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let start = convert::float(arguments.required("start", vm)?.as_object(), vm)?;
    let stop = convert::float(arguments.required("stop", vm)?.as_object(), vm)?;
    let count = count_of(arguments, vm)?;
    let endpoint = arguments.optional_truth("endpoint", vm)?.unwrap_or(true);
    let base = arguments.optional_float("base", vm)?.unwrap_or(10.0);
    let (mut values, _) = spaced(start, stop, count, endpoint);
    for value in &mut values {
        *value = libm::pow(base, *value);
    }
    done(View::vector(values), vm)
}

/// `numpy.meshgrid` of two vectors.
///
/// # Errors
///
/// As [`array`]; ValueError for more than two vectors.
pub fn meshgrid(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let across = arguments.array("x", vm)?;
    let down = arguments.array("y", vm)?;
    let indexing = arguments.keyword("indexing", vm);
    let by_matrix = match indexing {
        Some(name) => name.str(vm)?.to_string_lossy() == "ij",
        None => false,
    };
    let flat = |view: &View| view.reshaped(Shape::vector(view.size()));
    let (across, down) = (flat(&across), flat(&down));
    let (first, second, shape) = if by_matrix {
        (
            across.as_column(),
            down.as_row(),
            Shape::matrix(across.size(), down.size()),
        )
    } else {
        (
            across.as_row(),
            down.as_column(),
            Shape::matrix(down.size(), across.size()),
        )
    };
    shape.check_size(vm)?;
    let grids = [first, second]
        .iter()
        .filter_map(|view| view.broadcast_to(shape))
        .map(|view| convert::object(view.copied(), vm))
        .collect();
    Ok(vm.ctx.new_tuple(grids).into())
}
