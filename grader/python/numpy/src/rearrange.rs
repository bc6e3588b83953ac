//! Functions that put the same elements in another shape or order.

use crate::convert;
use crate::dtype::Dtype;
use crate::errors;
use crate::function::Arguments;
use crate::reduce;
use crate::view::{Shape, View, check_count};
use rustpython_vm::{AsObject as _, PyObjectRef, PyResult, VirtualMachine};

fn done(view: View, vm: &VirtualMachine) -> PyResult {
    Ok(convert::object(view, vm))
}

fn flat(view: &View) -> View {
    view.reshaped(Shape::vector(view.size()))
}

/// The elements in the shape that an argument of `reshape` describes; one length may be -1.
///
/// # Errors
///
/// ValueError when the size does not fit.
pub fn reshaped(view: &View, shape: &PyObjectRef, vm: &VirtualMachine) -> PyResult<View> {
    let lengths = convert::integers(shape, vm)?;
    let refuse = || {
        // numpy writes an unknown length so
        let write = |length: &isize| {
            if *length < 0 {
                "newaxis".to_owned()
            } else {
                length.to_string()
            }
        };
        let dimensions: Vec<String> = lengths.iter().map(write).collect();
        let comma = if dimensions.len() == 1 { "," } else { "" };
        vm.new_value_error(format!(
            "cannot reshape array of size {} into shape ({}{comma})",
            view.size(),
            dimensions.join(",")
        ))
    };
    let unknown = lengths.iter().filter(|length| **length < 0).count();
    if unknown > 1 {
        return Err(vm.new_value_error("can only specify one unknown dimension"));
    }
    let known: usize = lengths
        .iter()
        .filter(|length| **length >= 0)
        .fold(1, |product, length| {
            product.saturating_mul(*length as usize)
        });
    let mut dimensions = Vec::with_capacity(lengths.len());
    for length in &lengths {
        dimensions.push(if *length >= 0 {
            *length as usize
        } else if known == 0 || !view.size().is_multiple_of(known) {
            return Err(refuse());
        } else {
            view.size() / known
        });
    }
    let size = dimensions
        .iter()
        .fold(1, |product: usize, length| product.saturating_mul(*length));
    if size != view.size() {
        return Err(refuse());
    }
    Ok(view.reshaped(Shape::from_dimensions(&dimensions, vm)?))
}

/// `numpy.reshape`.
///
/// # Errors
///
/// ValueError when the size does not fit.
pub fn reshape(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let shape = match arguments.keyword("newshape", vm) {
        Some(shape) => shape,
        None => arguments.required("shape", vm)?,
    };
    let order = arguments.optional("order", vm);
    in_shape(view, &shape, order, vm)
}

/// The elements in another shape, read and written in this order.
///
/// # Errors
///
/// As [`reshape`].
pub fn in_shape(
    view: View,
    shape: &PyObjectRef,
    order: Option<PyObjectRef>,
    vm: &VirtualMachine,
) -> PyResult {
    let plain = reshaped(&view, shape, vm)?;
    if !is_by_columns(order, vm)? {
        return done(plain, vm);
    }
    // column by column in both: row by row in the transposes
    let target = plain.shape();
    let turned = match target.rank() {
        2 => Shape::matrix(target.columns(), target.rows()),
        _ => target,
    };
    let filled = View::new(view.dtype(), turned, view.transposed().values());
    done(filled.transposed(), vm)
}

/// The view whose rows, one after the other, are the elements in this order: `"C"`, row by row, or `"F"`, column by column.
///
/// # Errors
///
/// ValueError for another order.
pub fn in_order(view: View, order: Option<PyObjectRef>, vm: &VirtualMachine) -> PyResult<View> {
    Ok(match is_by_columns(order, vm)? {
        true => view.transposed(),
        false => view,
    })
}

fn is_by_columns(order: Option<PyObjectRef>, vm: &VirtualMachine) -> PyResult<bool> {
    let Some(order) = order else {
        return Ok(false);
    };
    match order.str(vm)?.to_string().as_str() {
        "C" | "A" | "K" => Ok(false),
        "F" => Ok(true),
        _ => Err(vm.new_value_error("order must be one of 'C', 'F', 'A', or 'K'")),
    }
}

/// `numpy.ravel`.
///
/// # Errors
///
/// TypeError for what holds no numbers.
pub fn ravel(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let view = in_order(view, arguments.optional("order", vm), vm)?;
    done(flat(&view), vm)
}

/// `numpy.transpose`.
///
/// # Errors
///
/// ValueError for axes that are not those of the array.
pub fn transpose(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let Some(axes) = arguments.optional("axes", vm) else {
        return done(view.transposed(), vm);
    };
    let axes = convert::integers(&axes, vm)?;
    if axes.len() != view.rank() {
        return Err(vm.new_value_error("axes don't match array"));
    }
    let axes: Vec<usize> = axes
        .into_iter()
        .map(|axis| errors::checked_axis(axis, view.rank(), vm))
        .collect::<PyResult<_>>()?;
    match axes.as_slice() {
        [0] | [0, 1] | [] => done(view, vm),
        [1, 0] => done(view.transposed(), vm),
        _ => Err(vm.new_value_error("repeated axis in transpose")),
    }
}

/// `numpy.swapaxes`.
///
/// # Errors
///
/// AxisError for an axis that is not there.
pub fn swapaxes(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let first = convert::integer(arguments.required("axis1", vm)?.as_object(), vm)?;
    let second = convert::integer(arguments.required("axis2", vm)?.as_object(), vm)?;
    let first = errors::checked_axis(first, view.rank(), vm)?;
    let second = errors::checked_axis(second, view.rank(), vm)?;
    done(
        if first == second {
            view
        } else {
            view.transposed()
        },
        vm,
    )
}

/// `numpy.squeeze`.
///
/// # Errors
///
/// ValueError for an axis that is longer than 1.
pub fn squeeze(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let lengths = view.shape().dimensions();
    let kept: Vec<usize> = match arguments.optional("axis", vm) {
        None => lengths
            .iter()
            .copied()
            .filter(|length| *length != 1)
            .collect(),
        Some(axes) => {
            let mut dropped = Vec::new();
            for axis in convert::integers(&axes, vm)? {
                let axis = errors::checked_axis(axis, view.rank(), vm)?;
                if lengths.get(axis) != Some(&1) {
                    return Err(vm.new_value_error(
                        "cannot select an axis to squeeze out which has size not equal to one",
                    ));
                }
                dropped.push(axis);
            }
            let keep = lengths
                .iter()
                .enumerate()
                .filter(|(axis, _)| !dropped.contains(axis));
            keep.map(|(_, length)| *length).collect()
        }
    };
    done(view.reshaped(Shape::from_dimensions(&kept, vm)?), vm)
}

/// `numpy.expand_dims`.
///
/// # Errors
///
/// AxisError for an axis that is not there, ValueError for more than two dimensions.
pub fn expand_dims(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let axis = convert::integer(arguments.required("axis", vm)?.as_object(), vm)?;
    let axis = errors::checked_axis(axis, view.rank() + 1, vm)?;
    let mut lengths = view.shape().dimensions();
    lengths.insert(axis, 1);
    done(view.reshaped(Shape::from_dimensions(&lengths, vm)?), vm)
}

/// `numpy.atleast_1d` of one array.
///
/// # Errors
///
/// TypeError for what holds no numbers.
pub fn atleast_1d(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let rank = view.rank().max(1);
    done(view.reshaped(view.shape().with_rank(rank)), vm)
}

/// `numpy.atleast_2d` of one array.
///
/// # Errors
///
/// TypeError for what holds no numbers.
pub fn atleast_2d(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    done(arguments.array("a", vm)?.as_row(), vm)
}

/// `numpy.broadcast_to`, as a copy.
///
/// # Errors
///
/// ValueError when the shape does not allow it.
pub fn broadcast_to(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("array", vm)?;
    let shape = convert::shape(arguments.required("shape", vm)?.as_object(), vm)?;
    let fitting = if view.rank() > shape.rank() {
        None
    } else {
        view.broadcast_to(shape)
    };
    match fitting {
        Some(repeated) => done(repeated.copied(), vm),
        None => Err(vm.new_value_error(format!(
            "operands could not be broadcast together with remapped shapes [original->remapped]: {} and requested shape {}",
            view.shape().sentence(),
            shape.sentence()
        ))),
    }
}

/// numpy's order: numbers upward, nan last.
fn order(left: f64, right: f64) -> std::cmp::Ordering {
    left.partial_cmp(&right)
        .unwrap_or_else(|| left.is_nan().cmp(&right.is_nan()))
}

/// The elements in rising order along the axis.
#[must_use]
pub fn sorted(view: &View, axis: usize) -> View {
    reduce::lanes(view, axis, view.dtype(), |lane| {
        let mut lane = lane.to_vec();
        lane.sort_by(|left, right| order(*left, *right));
        lane
    })
}

/// The array and the axis that sorting goes along: the last unless another is named, none for the flat elements.
fn along(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult<(View, usize)> {
    let view = arguments.array("a", vm)?;
    let result = match arguments.next("axis") {
        Some(axis) if vm.is_none(&axis) => (flat(&view), 0),
        axis => {
            let axis = axis
                .map(|axis| convert::integer(&axis, vm))
                .transpose()?
                .unwrap_or(-1);
            let axis = errors::checked_axis(axis, view.rank(), vm)?;
            (view, axis)
        }
    };
    let _ = arguments.optional("kind", vm);
    Ok(result)
}

/// `numpy.sort`.
///
/// # Errors
///
/// AxisError for an axis that is not there.
pub fn sort(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let (view, axis) = along(arguments, vm)?;
    let _ = arguments.keyword("stable", vm);
    done(sorted(&view, axis), vm)
}

/// `numpy.argsort`; equal elements keep their order.
///
/// # Errors
///
/// AxisError for an axis that is not there.
pub fn argsort(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let (view, axis) = along(arguments, vm)?;
    let _ = arguments.keyword("stable", vm);
    let places = reduce::lanes(&view, axis, Dtype::Int, |lane| {
        let mut places: Vec<usize> = (0..lane.len()).collect();
        places.sort_by(|left, right| order(lane[*left], lane[*right]));
        places.into_iter().map(|place| place as f64).collect()
    });
    done(places, vm)
}

/// `numpy.unique`: the different elements in rising order; on request where each is first, which of them each element is, how often each occurs.
///
/// # Errors
///
/// TypeError for what holds no numbers.
pub fn unique(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("ar", vm)?;
    let index_too = arguments.optional_truth("return_index", vm)? == Some(true);
    let inverse_too = arguments.optional_truth("return_inverse", vm)? == Some(true);
    let counts_too = arguments.optional_truth("return_counts", vm)? == Some(true);
    let all = view.values();
    let mut places: Vec<usize> = (0..all.len()).collect();
    places.sort_by(|left, right| order(all[*left], all[*right]));
    let mut values: Vec<f64> = Vec::new();
    let mut counts: Vec<f64> = Vec::new();
    let mut firsts: Vec<f64> = Vec::new();
    let mut inverse = vec![0.0; all.len()];
    for place in places {
        let value = all[place];
        let known = values
            .last()
            .is_some_and(|last| *last == value || (last.is_nan() && value.is_nan()));
        match counts.last_mut() {
            Some(count) if known => *count += 1.0,
            _ => {
                values.push(value);
                counts.push(1.0);
                firsts.push(place as f64);
            }
        }
        inverse[place] = (values.len() - 1) as f64;
    }
    let shape = Shape::vector(values.len());
    let array = convert::object(View::new(view.dtype(), shape, values), vm);
    let mut results = vec![array];
    let indices = |shape, numbers| convert::object(View::new(Dtype::Int, shape, numbers), vm);
    if index_too {
        results.push(indices(shape, firsts));
    }
    if inverse_too {
        results.push(indices(view.shape(), inverse));
    }
    if counts_too {
        results.push(indices(shape, counts));
    }
    match results.len() {
        1 => Ok(results.remove(0)),
        _ => Ok(vm.ctx.new_tuple(results).into()),
    }
}

fn reversed(view: &View, axes: &[usize]) -> View {
    let (row_stride, column_stride) = view.strides();
    if view.size() == 0 {
        return view.clone();
    }
    let by_row = view.rank() == 2 && axes.contains(&0);
    let by_column = axes.contains(&(view.rank().saturating_sub(1)));
    let row = if by_row { view.rows() - 1 } else { 0 };
    let column = if by_column { view.columns() - 1 } else { 0 };
    let row_stride = if by_row { -row_stride } else { row_stride };
    let column_stride = if by_column {
        -column_stride
    } else {
        column_stride
    };
    let first = view.position(row, column);
    if view.rank() == 2 {
        view.window(
            first,
            &[(view.rows(), row_stride), (view.columns(), column_stride)],
        )
    } else {
        view.window(first, &[(view.columns(), column_stride)])
    }
}

/// `numpy.flip`.
///
/// # Errors
///
/// AxisError for an axis that is not there.
pub fn flip(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("m", vm)?;
    let axes = match arguments.optional("axis", vm) {
        None => (0..view.rank()).collect(),
        Some(axes) => convert::integers(&axes, vm)?
            .into_iter()
            .map(|axis| errors::checked_axis(axis, view.rank(), vm))
            .collect::<PyResult<Vec<_>>>()?,
    };
    if view.rank() == 0 {
        return done(view, vm);
    }
    done(reversed(&view, &axes), vm)
}

/// `numpy.flipud`.
///
/// # Errors
///
/// ValueError for a number.
pub fn flipud(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("m", vm)?;
    if view.rank() == 0 {
        return Err(vm.new_value_error("Input must be >= 1-d."));
    }
    done(reversed(&view, &[0]), vm)
}

/// `numpy.fliplr`.
///
/// # Errors
///
/// ValueError for fewer than two dimensions.
pub fn fliplr(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("m", vm)?;
    if view.rank() < 2 {
        return Err(vm.new_value_error("Input must be >= 2-d."));
    }
    done(reversed(&view, &[1]), vm)
}

/// `numpy.roll`.
///
/// # Errors
///
/// AxisError for an axis that is not there.
pub fn roll(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let shift = convert::integer(arguments.required("shift", vm)?.as_object(), vm)?;
    let axis = arguments.optional_integer("axis", vm)?;
    let turn = |lane: &[f64]| {
        let mut lane = lane.to_vec();
        if !lane.is_empty() {
            let by = shift.rem_euclid(lane.len() as isize) as usize;
            lane.rotate_right(by);
        }
        lane
    };
    match axis {
        None => done(
            View::new(view.dtype(), view.shape(), turn(&view.values())),
            vm,
        ),
        Some(axis) => {
            let axis = errors::checked_axis(axis, view.rank(), vm)?;
            done(reduce::lanes(&view, axis, view.dtype(), turn), vm)
        }
    }
}

/// `numpy.tile`.
///
/// # Errors
///
/// MemoryError for too many elements, ValueError for more than two dimensions.
pub fn tile(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("A", vm)?;
    let times = convert::integers(arguments.required("reps", vm)?.as_object(), vm)?;
    if times.iter().any(|count| *count < 0) {
        return Err(vm.new_value_error("negative dimensions are not allowed"));
    }
    let (down, across) = match *times.as_slice() {
        [] => (1, 1),
        [across] => (1, across as usize),
        [down, across] => (down as usize, across as usize),
        _ => return Err(errors::too_many_dimensions(vm)),
    };
    let rank = view.rank().max(times.len());
    let (rows, columns) = (
        view.rows().saturating_mul(down),
        view.columns().saturating_mul(across),
    );
    let shape = Shape::matrix(rows, columns).with_rank(rank);
    shape.check_size(vm)?;
    let mut values = Vec::with_capacity(shape.size());
    for row in 0..rows {
        for column in 0..columns {
            values.push(view.at(row % view.rows(), column % view.columns()));
        }
    }
    done(View::new(view.dtype(), shape, values), vm)
}

/// `numpy.repeat`.
///
/// # Errors
///
/// ValueError for counts that do not fit, MemoryError for too many elements.
pub fn repeat(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let counts = convert::integers(arguments.required("repeats", vm)?.as_object(), vm)?;
    let axis = arguments.optional_integer("axis", vm)?;
    if counts.iter().any(|count| *count < 0) {
        return Err(vm.new_value_error("repeats may not contain negative values."));
    }
    let (view, axis) = match axis {
        None => (flat(&view), 0),
        Some(axis) => {
            let axis = errors::checked_axis(axis, view.rank(), vm)?;
            (view, axis)
        }
    };
    let length = if view.rank() == 2 && axis == 0 {
        view.rows()
    } else {
        view.columns()
    };
    let counts = if counts.len() == 1 {
        vec![counts[0]; length]
    } else {
        counts
    };
    if counts.len() != length {
        return Err(vm.new_value_error(format!(
            "operands could not be broadcast together with shape ({length},) ({},)",
            counts.len()
        )));
    }
    let total = counts
        .iter()
        .fold(0_usize, |sum, count| sum.saturating_add(*count as usize));
    check_count(
        total.saturating_mul(view.size().checked_div(length).unwrap_or(0)),
        vm,
    )?;
    let result = reduce::lanes(&view, axis, view.dtype(), |lane| {
        let pairs = lane.iter().zip(&counts);
        pairs
            .flat_map(|(value, count)| std::iter::repeat_n(*value, *count as usize))
            .collect()
    });
    done(result, vm)
}

/// `numpy.take`.
///
/// # Errors
///
/// IndexError for a place that is not there.
pub fn take(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let places = arguments.required("indices", vm)?;
    match arguments.optional_integer("axis", vm)? {
        None => crate::index::get(&flat(&view), &places, vm),
        Some(axis) => {
            let axis = errors::checked_axis(axis, view.rank(), vm)?;
            if axis == 0 {
                return crate::index::get(&view, &places, vm);
            }
            let key = vm
                .ctx
                .new_tuple(vec![vm.ctx.ellipsis.clone().into(), places]);
            crate::index::get(&view, key.as_object(), vm)
        }
    }
}

/// `numpy.delete` of a vector, or of rows or columns.
///
/// # Errors
///
/// IndexError for a place that is not there.
pub fn delete(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("arr", vm)?;
    let places = convert::integers(arguments.required("obj", vm)?.as_object(), vm)?;
    let axis = arguments.optional_integer("axis", vm)?;
    let (view, axis) = match axis {
        None => (flat(&view), 0),
        Some(axis) => {
            let axis = errors::checked_axis(axis, view.rank(), vm)?;
            (view, axis)
        }
    };
    let length = if view.rank() == 2 && axis == 0 {
        view.rows()
    } else {
        view.columns()
    } as isize;
    for place in &places {
        if *place < -length || *place >= length {
            return Err(vm.new_index_error(format!(
                "index {place} is out of bounds for axis {axis} with size {length}"
            )));
        }
    }
    let gone = |place: usize| {
        let place = place as isize;
        places.contains(&place) || places.contains(&(place - length))
    };
    let result = reduce::lanes(&view, axis, view.dtype(), |lane| {
        let kept = lane.iter().enumerate().filter(|(place, _)| !gone(*place));
        kept.map(|(_, value)| *value).collect()
    });
    done(result, vm)
}

/// `numpy.shape`.
///
/// # Errors
///
/// TypeError for what holds no numbers.
pub fn shape(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    Ok(convert::tuple_of_sizes(&view.shape().dimensions(), vm))
}

/// `numpy.ndim`.
///
/// # Errors
///
/// TypeError for what holds no numbers.
pub fn ndim(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    Ok(vm.ctx.new_int(arguments.array("a", vm)?.rank()).into())
}

/// `numpy.size`.
///
/// # Errors
///
/// AxisError for an axis that is not there.
pub fn size(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let view = arguments.array("a", vm)?;
    let size = match arguments.optional_integer("axis", vm)? {
        None => view.size(),
        Some(axis) => {
            let axis = errors::checked_axis(axis, view.rank(), vm)?;
            view.shape().dimensions()[axis]
        }
    };
    Ok(vm.ctx.new_int(size).into())
}
