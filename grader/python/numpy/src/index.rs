//! Square brackets: what a key selects of an array, reading it and assigning to it.
//!
//! Numbers, slices, `...` and `None` select a window on the same cells; masks and lists of places select copies.

use crate::array::NdArray;
use crate::broadcast;
use crate::convert;
use crate::dtype::Dtype;
use crate::errors;
use crate::view::{Shape, View, check_count};
use rustpython_vm::{
    AsObject as _, PyObject, PyObjectRef, PyResult, VirtualMachine,
    builtins::{PyBaseExceptionRef, PyFloat, PyInt, PySlice, PyStr, PyTuple},
    sliceable::SaturatedSlice,
};

/// One of the comma-separated parts of a key.
enum Part {
    At(isize),
    Slice(SaturatedSlice),
    NewAxis,
    Ellipsis,
    Places(View),
    Mask(View),
}

impl Part {
    const fn axes(&self) -> usize {
        match self {
            Self::NewAxis | Self::Ellipsis => 0,
            Self::Mask(mask) => mask.rank(),
            Self::At(_) | Self::Slice(_) | Self::Places(_) => 1,
        }
    }

    const fn whole() -> Self {
        Self::Slice(SaturatedSlice::from_parts(0, isize::MAX, 1))
    }
}

/// What a key selects.
enum Selection {
    /// A window that shares cells.
    Window(View),
    /// Elements at these positions of the cells.
    Gather(Shape, Vec<usize>),
    /// Elements at these positions, where a mask of the whole array is true.
    Masked(Vec<usize>),
}

fn not_an_index(vm: &VirtualMachine) -> PyBaseExceptionRef {
    vm.new_index_error(
        "only integers, slices (`:`), ellipsis (`...`), numpy.newaxis (`None`) and integer or boolean arrays are valid indices",
    )
}

fn part(key: &PyObject, vm: &VirtualMachine) -> PyResult<Part> {
    if let Some(int) = key.downcast_ref::<PyInt>() {
        if key.class().is(vm.ctx.types.bool_type) {
            return Err(not_an_index(vm));
        }
        return int
            .try_to_primitive(vm)
            .map(Part::At)
            .map_err(|_| vm.new_index_error("cannot fit 'int' into an index-sized integer"));
    }
    if let Some(slice) = key.downcast_ref::<PySlice>() {
        return slice.to_saturated(vm).map(Part::Slice);
    }
    if vm.is_none(key) {
        return Ok(Part::NewAxis);
    }
    if key.is(&vm.ctx.ellipsis) {
        return Ok(Part::Ellipsis);
    }
    if key.downcast_ref::<PyFloat>().is_some() {
        return Err(not_an_index(vm));
    }
    match convert::operand(key, vm)? {
        Some(view) if view.dtype() == Dtype::Bool => Ok(Part::Mask(view)),
        Some(view) if view.dtype() == Dtype::Int || view.size() == 0 => Ok(Part::Places(view)),
        Some(_) if key.downcast_ref::<NdArray>().is_none() => Err(not_an_index(vm)),
        Some(_) => {
            Err(vm.new_index_error("arrays used as indices must be of integer (or boolean) type"))
        }
        None => match key.try_index_opt(vm) {
            Some(int) => int?.try_to_primitive(vm).map(Part::At),
            None => Err(not_an_index(vm)),
        },
    }
}

fn parts(view: &View, key: &PyObject, vm: &VirtualMachine) -> PyResult<Vec<Part>> {
    let mut parts = match key.downcast_ref::<PyTuple>() {
        Some(tuple) => tuple
            .as_slice()
            .iter()
            .map(|key| part(key, vm))
            .collect::<PyResult<Vec<_>>>()?,
        None => vec![part(key, vm)?],
    };
    let used: usize = parts.iter().map(Part::axes).sum();
    if used > view.rank() {
        return Err(vm.new_index_error(format!(
            "too many indices for array: array is {}-dimensional, but {used} were indexed",
            view.rank()
        )));
    }
    let ellipses = parts
        .iter()
        .filter(|part| matches!(part, Part::Ellipsis))
        .count();
    if ellipses > 1 {
        return Err(vm.new_index_error("an index can only have a single ellipsis ('...')"));
    }
    // what the key leaves out is taken whole: at the ellipsis, or at the end
    let place = parts
        .iter()
        .position(|part| matches!(part, Part::Ellipsis))
        .unwrap_or_else(|| {
            parts.push(Part::Ellipsis);
            parts.len() - 1
        });
    parts.splice(place..=place, (used..view.rank()).map(|_| Part::whole()));
    Ok(parts)
}

fn checked(index: isize, axis: usize, length: usize, vm: &VirtualMachine) -> PyResult<usize> {
    let signed = length as isize;
    if index < -signed || index >= signed {
        return Err(vm.new_index_error(format!(
            "index {index} is out of bounds for axis {axis} with size {length}"
        )));
    }
    Ok(if index < 0 { index + signed } else { index } as usize)
}

/// The length, and the distance in cells, along an axis of the array.
fn axis_of(view: &View, axis: usize) -> (usize, isize) {
    if view.rank() == 2 && axis == 0 {
        (view.rows(), view.strides().0)
    } else {
        (view.columns(), view.strides().1)
    }
}

fn select(view: &View, key: &PyObject, vm: &VirtualMachine) -> PyResult<Selection> {
    let parts = parts(view, key, vm)?;
    if parts
        .iter()
        .any(|part| matches!(part, Part::Places(_) | Part::Mask(_)))
    {
        return gather(view, parts, vm);
    }
    let mut first = view.position(0, 0) as isize;
    let mut dimensions = Vec::with_capacity(2);
    let mut axis = 0;
    for part in parts {
        if matches!(part, Part::NewAxis) {
            dimensions.push((1, 0));
            continue;
        }
        let (length, stride) = axis_of(view, axis);
        match part {
            Part::At(index) => first += checked(index, axis, length, vm)? as isize * stride,
            Part::Slice(slice) => {
                let (start, step, count) = places_of(&slice, length);
                if count > 0 {
                    first += start as isize * stride;
                }
                // the step over one element or none can be any number
                dimensions.push((count, if count > 1 { stride * step } else { stride }));
            }
            Part::NewAxis | Part::Ellipsis | Part::Places(_) | Part::Mask(_) => {}
        }
        axis += 1;
    }
    if dimensions.len() > 2 {
        return Err(errors::too_many_dimensions(vm));
    }
    // an empty window reads no cell, so its first position does not matter
    Ok(Selection::Window(
        view.window(first.max(0) as usize, &dimensions),
    ))
}

/// The first place, the step and the number of places that a slice takes of an axis.
fn places_of(slice: &SaturatedSlice, length: usize) -> (usize, isize, usize) {
    let (range, step, count) = slice.adjust_indices(length);
    let start = if step < 0 {
        range.end.saturating_sub(1)
    } else {
        range.start
    };
    (start, step, count)
}

/// The places a mask is true at.
fn places_of_mask(mask: &View) -> View {
    let values = mask
        .values()
        .into_iter()
        .enumerate()
        .filter(|(_, value)| *value != 0.0)
        .map(|(place, _)| place as f64)
        .collect::<Vec<_>>();
    View::new(Dtype::Int, Shape::vector(values.len()), values)
}

fn check_mask(length: usize, axis: usize, mask: usize, vm: &VirtualMachine) -> PyResult<()> {
    if mask == length {
        return Ok(());
    }
    Err(vm.new_index_error(format!(
        "boolean index did not match indexed array along axis {axis}; size of axis is {length} but size of corresponding boolean axis is {mask}"
    )))
}

/// The places of a part of a key, as numbers within its axis, and whether they come from a slice.
fn places_along(
    view: &View,
    axis: usize,
    part: Part,
    vm: &VirtualMachine,
) -> PyResult<(View, bool)> {
    let (length, _) = axis_of(view, axis);
    Ok(match part {
        Part::Slice(slice) => {
            let (start, step, count) = places_of(&slice, length);
            let values = (0..count)
                .map(|place| (start as isize + place as isize * step) as f64)
                .collect();
            (View::new(Dtype::Int, Shape::vector(count), values), true)
        }
        Part::Mask(mask) => {
            check_mask(length, axis, mask.columns(), vm)?;
            (places_of_mask(&mask), false)
        }
        Part::Places(places) => (places, false),
        Part::At(index) => (View::number(Dtype::Int, index as f64), false),
        Part::NewAxis | Part::Ellipsis => {
            return Err(vm.new_index_error(
                "numpy.newaxis together with a mask or a list of places is not supported here: index twice",
            ));
        }
    })
}

fn gather(view: &View, parts: Vec<Part>, vm: &VirtualMachine) -> PyResult<Selection> {
    if let [Part::Mask(mask)] = parts.as_slice()
        && mask.rank() == view.rank()
    {
        if mask.rank() == 2 {
            check_mask(view.rows(), 0, mask.rows(), vm)?;
        }
        check_mask(view.columns(), mask.rank() - 1, mask.columns(), vm)?;
        let positions: Vec<usize> = view
            .positions()
            .zip(mask.values())
            .filter(|(_, value)| *value != 0.0)
            .map(|(position, _)| position)
            .collect();
        return Ok(Selection::Masked(positions));
    }
    let axes = parts.into_iter().enumerate();
    let axes = axes
        .map(|(axis, part)| places_along(view, axis, part, vm))
        .collect::<PyResult<Vec<_>>>()?;
    let place = |value: f64, axis: usize| checked(value as isize, axis, axis_of(view, axis).0, vm);
    if let [(places, _)] = axes.as_slice() {
        let mut positions = Vec::with_capacity(places.size());
        for value in places.values() {
            positions.push(view.position(0, place(value, 0)?));
        }
        return Ok(Selection::Gather(places.shape(), positions));
    }
    let [(rows, whole_rows), (columns, whole_columns)] = axes.as_slice() else {
        return Err(errors::too_many_dimensions(vm));
    };
    // also those that no element is selected by
    for (axis, places) in [rows, columns].into_iter().enumerate() {
        for value in places.values() {
            place(value, axis)?;
        }
    }
    let (rows, columns) = if *whole_rows || *whole_columns {
        // a slice beside places: every row with every column
        if rows.rank() > 1 || columns.rank() > 1 {
            return Err(errors::too_many_dimensions(vm));
        }
        let shape = Shape::matrix(rows.size(), columns.size());
        check_count(shape.size(), vm)?;
        match (
            rows.as_column().broadcast_to(shape),
            columns.as_row().broadcast_to(shape),
        ) {
            (Some(rows), Some(columns)) => (rows, columns),
            _ => return Err(errors::no_broadcast(rows.shape(), columns.shape(), vm)),
        }
    } else {
        broadcast::together(rows, columns, vm).map_err(|_| {
            vm.new_index_error(format!(
                "shape mismatch: indexing arrays could not be broadcast together with shapes {} {} ",
                rows.shape().sentence(),
                columns.shape().sentence()
            ))
        })?
    };
    let mut positions = Vec::with_capacity(rows.size());
    for (row, column) in rows.values().into_iter().zip(columns.values()) {
        positions.push(view.position(place(row, 0)?, place(column, 1)?));
    }
    Ok(Selection::Gather(rows.shape(), positions))
}

/// `view[key]`.
///
/// # Errors
///
/// IndexError, with numpy's sentences, for keys outside the array.
pub fn get(view: &View, key: &PyObject, vm: &VirtualMachine) -> PyResult {
    if let Some(position) = single(view, key, vm)? {
        return Ok(convert::element(
            view.cell(position).get(),
            view.dtype(),
            vm,
        ));
    }
    let (shape, positions) = match select(view, key, vm)? {
        Selection::Window(window) => return Ok(convert::object(window, vm)),
        Selection::Gather(shape, positions) => (shape, positions),
        Selection::Masked(positions) => (Shape::vector(positions.len()), positions),
    };
    let values = positions
        .iter()
        .map(|position| view.cell(*position).get())
        .collect();
    Ok(convert::object(View::new(view.dtype(), shape, values), vm))
}

/// The position of the one element that plain ints select: most keys in a loop are of this kind.
fn single(view: &View, key: &PyObject, vm: &VirtualMachine) -> PyResult<Option<usize>> {
    let plain = |key: &PyObject| {
        key.downcast_ref_if_exact::<PyInt>(vm)
            .and_then(|int| isize::try_from(int.as_bigint()).ok())
    };
    if view.rank() == 1
        && let Some(index) = plain(key)
    {
        return checked(index, 0, view.columns(), vm).map(|column| Some(view.position(0, column)));
    }
    if view.rank() == 2
        && let Some(tuple) = key.downcast_ref::<PyTuple>()
        && let [row, column] = tuple.as_slice()
        && let (Some(row), Some(column)) = (plain(row), plain(column))
    {
        let row = checked(row, 0, view.rows(), vm)?;
        let column = checked(column, 1, view.columns(), vm)?;
        return Ok(Some(view.position(row, column)));
    }
    Ok(None)
}

/// A number on its way into an array of whole numbers must be one that an int can hold.
fn check_number(value: f64, dtype: Dtype, vm: &VirtualMachine) -> PyResult<()> {
    if dtype != Dtype::Int || (value.is_finite() && value.abs() < 9.223_372_036_854_775e18) {
        return Ok(());
    }
    Err(if value.is_nan() {
        vm.new_value_error("cannot convert float NaN to integer")
    } else if value.is_infinite() {
        vm.new_overflow_error("cannot convert float infinity to integer")
    } else {
        vm.new_overflow_error("Python int too large to convert to C long")
    })
}

/// `view[key] = value`.
///
/// # Errors
///
/// IndexError for keys outside the array, ValueError for values of another shape.
pub fn set(view: &View, key: &PyObject, value: &PyObject, vm: &VirtualMachine) -> PyResult<()> {
    let number = convert::number(value, vm)?;
    if let Some((number, _)) = number {
        check_number(number, view.dtype(), vm)?;
        if let Some(position) = single(view, key, vm)? {
            view.cell(position).set(view.dtype().cast(number));
            return Ok(());
        }
    }
    let selection = select(view, key, vm)?;
    let shape = match &selection {
        Selection::Window(window) => window.shape(),
        Selection::Gather(shape, _) => *shape,
        Selection::Masked(positions) => Shape::vector(positions.len()),
    };
    if let Some(text) = value.downcast_ref::<PyStr>() {
        let text = text.as_object().repr(vm)?.to_string_lossy().into_owned();
        return Err(vm.new_value_error(format!("could not convert string to float: {text}")));
    }
    let source = convert::view_of(value, vm)?;
    let is_array = value.downcast_ref::<NdArray>().is_some();
    if let Selection::Masked(positions) = &selection {
        if source.rank() > 1 {
            return Err(vm.new_type_error(
                "NumPy boolean array indexing assignment requires a 0 or 1-dimensional input, input has 2 dimensions",
            ));
        }
        if source.rank() == 1 && source.size() != 1 && source.size() != positions.len() {
            return Err(vm.new_value_error(format!(
                "NumPy boolean array indexing assignment cannot assign {} input values to the {} output values where the mask is true",
                source.size(),
                positions.len()
            )));
        }
    }
    if shape.rank() > 0 && source.rank() > shape.rank() && !is_array {
        return Err(vm.new_value_error(format!(
            "setting an array element with a sequence. The requested array would exceed the maximum number of dimension of {}.",
            shape.rank()
        )));
    }
    if shape.rank() == 0 {
        if view.dtype() == Dtype::Int && number.is_none() && !is_array {
            // numpy asks Python for the int here
            return Err(vm.new_type_error(format!(
                "int() argument must be a string, a bytes-like object or a real number, not '{}'",
                value.class().name()
            )));
        }
        if number.is_none() && !(is_array && source.size() == 1) {
            return Err(vm.new_value_error("setting an array element with a sequence."));
        }
        check_number(source.at(0, 0), view.dtype(), vm)?;
    }
    let Some(source) = source.broadcast_to(shape) else {
        return Err(vm.new_value_error(format!(
            "could not broadcast input array from shape {} into shape {}",
            source.shape().sentence(),
            shape.sentence()
        )));
    };
    match selection {
        Selection::Window(window) => window.assign(&source),
        Selection::Gather(_, positions) | Selection::Masked(positions) => {
            for (position, value) in positions.into_iter().zip(source.values()) {
                view.cell(position).set(view.dtype().cast(value));
            }
        }
    }
    Ok(())
}

/// `needle in view`.
///
/// # Errors
///
/// ValueError when the needle's shape does not go with the array's.
pub fn contains(view: &View, needle: &PyObject, vm: &VirtualMachine) -> PyResult<bool> {
    let Some(needle) = convert::operand(needle, vm)? else {
        return Ok(false);
    };
    let (left, right) = broadcast::together(view, &needle, vm)?;
    Ok(left
        .values()
        .iter()
        .zip(right.values())
        .any(|(left, right)| *left == right))
}

/// The elements as nested lists of Python numbers.
#[must_use]
pub fn to_list(view: &View, vm: &VirtualMachine) -> PyObjectRef {
    let row = |row: usize| {
        let items = (0..view.columns())
            .map(|column| convert::element(view.at(row, column), view.dtype(), vm))
            .collect();
        vm.ctx.new_list(items).into()
    };
    match view.rank() {
        0 => convert::element(view.at(0, 0), view.dtype(), vm),
        1 => row(0),
        _ => vm.ctx.new_list((0..view.rows()).map(row).collect()).into(),
    }
}
