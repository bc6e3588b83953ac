//! Functions that make one array of several: concatenate, stack and their like.

use crate::convert;
use crate::dtype::Dtype;
use crate::errors;
use crate::function::Arguments;
use crate::view::{Shape, View};
use rustpython_vm::{PyObjectRef, PyResult, VirtualMachine};

/// The arrays of a list, tuple or matrix.
fn arrays(object: &PyObjectRef, vm: &VirtualMachine) -> PyResult<Vec<View>> {
    if let Some(items) = convert::sequence(object, vm)? {
        return items
            .iter()
            .map(|item| convert::view_of(item, vm))
            .collect();
    }
    if object.downcast_ref::<crate::array::NdArray>().is_some() {
        let view = convert::view_of(object, vm)?;
        if view.rank() == 2 {
            return Ok((0..view.rows()).map(|row| view.row(row)).collect());
        }
        let numbers = view.values().into_iter();
        return Ok(numbers
            .map(|value| View::number(view.dtype(), value))
            .collect());
    }
    Err(vm.new_type_error("arrays to join must be given as a list or tuple"))
}

fn kind_of(views: &[View]) -> Dtype {
    views.iter().map(View::dtype).max().unwrap_or(Dtype::Float)
}

/// The arrays one after the other along an axis that they have.
///
/// # Errors
///
/// ValueError, with numpy's sentences, for shapes that do not go together.
fn concatenated(views: &[View], axis: isize, vm: &VirtualMachine) -> PyResult<View> {
    let Some(first) = views.first() else {
        return Err(vm.new_value_error("need at least one array to concatenate"));
    };
    if first.rank() == 0 {
        return Err(vm.new_value_error("zero-dimensional arrays cannot be concatenated"));
    }
    let axis = errors::checked_axis(axis, first.rank(), vm)?;
    let down = first.rank() == 2 && axis == 0;
    let (mut rows, mut columns) = (0, 0);
    for (place, view) in views.iter().enumerate() {
        if view.rank() != first.rank() {
            return Err(vm.new_value_error(format!(
                "all the input arrays must have same number of dimensions, but the array at index 0 has {} dimension(s) \
                 and the array at index {place} has {} dimension(s)",
                first.rank(),
                view.rank()
            )));
        }
        let (other, known, found) = if down {
            (1, first.columns(), view.columns())
        } else {
            (0, first.rows(), view.rows())
        };
        if known != found {
            return Err(vm.new_value_error(format!(
                "all the input array dimensions except for the concatenation axis must match exactly, but along dimension {other}, \
                 the array at index 0 has size {known} and the array at index {place} has size {found}"
            )));
        }
        rows = if down {
            rows + view.rows()
        } else {
            view.rows()
        };
        columns = if down {
            view.columns()
        } else {
            columns + view.columns()
        };
    }
    let shape = Shape::matrix(rows, columns).with_rank(first.rank());
    shape.check_size(vm)?;
    let mut values = Vec::with_capacity(shape.size());
    if down {
        for view in views {
            values.extend(view.values());
        }
    } else {
        for row in 0..rows {
            for view in views {
                values.extend(view.row(row).values());
            }
        }
    }
    Ok(View::new(kind_of(views), shape, values))
}

/// `view` with what goes before and after it along `axis`; a number is one layer of it.
///
/// # Errors
///
/// ValueError for shapes that do not go together.
pub(crate) fn between(
    before: Option<View>,
    view: View,
    after: Option<View>,
    axis: usize,
    vm: &VirtualMachine,
) -> PyResult<View> {
    let shape = match (view.rank(), axis) {
        (2, 0) => Shape::matrix(1, view.columns()),
        (2, _) => Shape::matrix(view.rows(), 1),
        _ => Shape::vector(1),
    };
    let layer = |part: View| match part.rank() {
        0 => View::new(part.dtype(), shape, vec![part.at(0, 0); shape.size()]),
        _ => part,
    };
    let views: Vec<View> = [before.map(layer), Some(view), after.map(layer)]
        .into_iter()
        .flatten()
        .collect();
    concatenated(&views, if axis == 0 { 0 } else { -1 }, vm)
}

/// `numpy.concatenate`.
///
/// # Errors
///
/// ValueError for shapes that do not go together.
pub fn concatenate(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let views = arrays(&arguments.required("arrays", vm)?, vm)?;
    let result = match arguments.next("axis") {
        Some(axis) if vm.is_none(&axis) => {
            let flat: Vec<View> = views
                .iter()
                .map(|view| view.reshaped(Shape::vector(view.size())))
                .collect();
            concatenated(&flat, 0, vm)?
        }
        Some(axis) => concatenated(&views, convert::integer(&axis, vm)?, vm)?,
        None => concatenated(&views, 0, vm)?,
    };
    Ok(convert::object(result, vm))
}

/// `numpy.vstack`.
///
/// # Errors
///
/// ValueError for shapes that do not go together.
pub fn vstack(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let views = arrays(&arguments.required("tup", vm)?, vm)?;
    let rows: Vec<View> = views.iter().map(View::as_row).collect();
    Ok(convert::object(concatenated(&rows, 0, vm)?, vm))
}

/// `numpy.hstack`.
///
/// # Errors
///
/// ValueError for shapes that do not go together.
pub fn hstack(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let views = arrays(&arguments.required("tup", vm)?, vm)?;
    let views: Vec<View> = views
        .iter()
        .map(|view| view.reshaped(view.shape().with_rank(view.rank().max(1))))
        .collect();
    let axis = if views.first().is_some_and(|view| view.rank() == 2) {
        1
    } else {
        0
    };
    Ok(convert::object(concatenated(&views, axis, vm)?, vm))
}

/// `numpy.column_stack`.
///
/// # Errors
///
/// ValueError for shapes that do not go together.
pub fn column_stack(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let views = arrays(&arguments.required("tup", vm)?, vm)?;
    let columns: Vec<View> = views
        .iter()
        .map(|view| {
            if view.rank() < 2 {
                view.as_column()
            } else {
                view.clone()
            }
        })
        .collect();
    Ok(convert::object(concatenated(&columns, 1, vm)?, vm))
}

/// `numpy.stack`: numbers to a vector, vectors to a matrix.
///
/// # Errors
///
/// ValueError for shapes that differ, and for matrices, because a stack of them has three dimensions.
pub fn stack(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let views = arrays(&arguments.required("arrays", vm)?, vm)?;
    let axis = arguments.optional_integer("axis", vm)?.unwrap_or(0);
    let Some(first) = views.first() else {
        return Err(vm.new_value_error("need at least one array to stack"));
    };
    if views.iter().any(|view| view.shape() != first.shape()) {
        return Err(vm.new_value_error("all input arrays must have the same shape"));
    }
    let axis = errors::checked_axis(axis, first.rank() + 1, vm)?;
    let result = match (first.rank(), axis) {
        (0, _) => {
            let values = views.iter().map(|view| view.at(0, 0)).collect();
            View::new(kind_of(&views), Shape::vector(views.len()), values)
        }
        (1, 0) => concatenated(&views.iter().map(View::as_row).collect::<Vec<_>>(), 0, vm)?,
        (1, _) => concatenated(
            &views.iter().map(View::as_column).collect::<Vec<_>>(),
            1,
            vm,
        )?,
        _ => return Err(errors::too_many_dimensions(vm)),
    };
    Ok(convert::object(result, vm))
}

/// `numpy.append`.
///
/// # Errors
///
/// ValueError for shapes that do not go together.
pub fn append(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let array = arguments.array("arr", vm)?;
    let values = arguments.array("values", vm)?;
    let result = match arguments.optional_integer("axis", vm)? {
        Some(axis) => concatenated(&[array, values], axis, vm)?,
        None => {
            let flat = |view: View| view.reshaped(Shape::vector(view.size()));
            concatenated(&[flat(array), flat(values)], 0, vm)?
        }
    };
    Ok(convert::object(result, vm))
}

/// `numpy.block`: a list of arrays side by side, or a list of such lists one below the other.
///
/// # Errors
///
/// ValueError for shapes that do not go together.
pub fn block(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let object = arguments.required("arrays", vm)?;
    let Some(items) = convert::sequence(&object, vm)? else {
        return Ok(convert::object(convert::view_of(&object, vm)?, vm));
    };
    let is_list = |item: &PyObjectRef| convert::sequence(item, vm).map(|items| items.is_some());
    let side_by_side = |views: Vec<View>, rank: usize| {
        let rank = views.iter().map(View::rank).max().unwrap_or(1).max(rank);
        let views: Vec<View> = views
            .iter()
            .map(|view| view.reshaped(view.shape().with_rank(rank)))
            .collect();
        concatenated(&views, -1, vm)
    };
    let mut nested = false;
    for item in &items {
        nested |= is_list(item)?;
    }
    let result = if nested {
        let mut rows = Vec::with_capacity(items.len());
        for item in &items {
            rows.push(side_by_side(arrays(item, vm)?, 2)?);
        }
        concatenated(&rows, 0, vm)?
    } else {
        side_by_side(arrays(&object, vm)?, 1)?
    };
    Ok(convert::object(result, vm))
}
