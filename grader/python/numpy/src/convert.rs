//! From Python objects (numbers, nested lists, arrays) to views, and back.

use crate::array::NdArray;
use crate::dtype::Dtype;
use crate::errors;
use crate::view::{MAX_ELEMENTS, Shape, View, check_count};
use rustpython_vm::{
    AsObject as _, PyObject, PyObjectRef, PyPayload as _, PyResult, VirtualMachine,
    builtins::{PyFloat, PyInt, PyList, PyRange, PyTuple},
};

/// The number that a Python object is, with its kind; `None` when it is no real number.
///
/// # Errors
///
/// OverflowError for an int that int64 does not hold.
pub fn number(object: &PyObject, vm: &VirtualMachine) -> PyResult<Option<(f64, Dtype)>> {
    if let Some(float) = object.downcast_ref::<PyFloat>() {
        return Ok(Some((float.to_f64(), Dtype::Float)));
    }
    let Some(int) = object.downcast_ref::<PyInt>() else {
        return Ok(None);
    };
    let dtype = if object.class().is(vm.ctx.types.bool_type) {
        Dtype::Bool
    } else {
        Dtype::Int
    };
    match i64::try_from(int.as_bigint()) {
        Ok(value) => Ok(Some((value as f64, dtype))),
        Err(_) => Err(vm.new_overflow_error("Python int too large to convert to C long")),
    }
}

/// The elements of a list, tuple or range; `None` for any other object.
///
/// # Errors
///
/// Those of iterating over a range; MemoryError for too long a one.
pub fn sequence(object: &PyObject, vm: &VirtualMachine) -> PyResult<Option<Vec<PyObjectRef>>> {
    if let Some(list) = object.downcast_ref::<PyList>() {
        return Ok(Some(list.borrow_vec().to_vec()));
    }
    if let Some(tuple) = object.downcast_ref::<PyTuple>() {
        return Ok(Some(tuple.as_slice().to_vec()));
    }
    if object.downcast_ref::<PyRange>().is_some() {
        check_count(object.length(vm)?, vm)?;
        return object.to_owned().try_to_value(vm).map(Some);
    }
    if is_other_sequence(object, vm) {
        check_count(object.length(vm)?, vm)?;
        return object.to_owned().try_to_value(vm).map(Some);
    }
    Ok(None)
}

/// Whether numpy takes an object apart that is no list, tuple or range: a deque, or one of a class with a length and elements by place.
fn is_other_sequence(object: &PyObject, vm: &VirtualMachine) -> bool {
    let no_elements = [
        vm.ctx.types.str_type,
        vm.ctx.types.bytes_type,
        vm.ctx.types.bytearray_type,
        vm.ctx.types.dict_type,
        vm.ctx.types.set_type,
        vm.ctx.types.frozenset_type,
        vm.ctx.types.type_type,
    ];
    let has = |name| object.class().has_attr(vm.ctx.intern_str(name));
    object.downcast_ref::<NdArray>().is_none()
        && has("__len__")
        && has("__getitem__")
        && !has("keys")
        && !no_elements
            .iter()
            .any(|class| object.fast_isinstance(class))
}

fn not_a_number(
    object: &PyObject,
    vm: &VirtualMachine,
) -> rustpython_vm::builtins::PyBaseExceptionRef {
    vm.new_type_error(format!(
        "arrays here hold numbers and bools, not '{}'",
        object.class().name()
    ))
}

/// Elements on their way into an array.
struct Gathered {
    values: Vec<f64>,
    dtype: Option<Dtype>,
}

impl Gathered {
    fn admit(&mut self, dtype: Dtype) {
        self.dtype = Some(self.dtype.map_or(dtype, |known| known.max(dtype)));
    }

    /// Takes the elements of a list or tuple of floats alone, as most are, and gives their number; `None` for others.
    fn take_floats(&mut self, object: &PyObject, vm: &VirtualMachine) -> PyResult<Option<usize>> {
        let list = object
            .downcast_ref::<PyList>()
            .map(|list| list.borrow_vec());
        let items = match (&list, object.downcast_ref::<PyTuple>()) {
            (Some(list), _) => list,
            (None, Some(tuple)) => tuple.as_slice(),
            (None, None) => return Ok(None),
        };
        if items.is_empty() {
            return Ok(None);
        }
        check_count(self.values.len() + items.len(), vm)?;
        let before = self.values.len();
        for item in items {
            let Some(float) = item.downcast_ref::<PyFloat>() else {
                self.values.truncate(before);
                return Ok(None);
            };
            self.values.push(float.to_f64());
        }
        self.admit(Dtype::Float);
        Ok(Some(items.len()))
    }

    /// Takes the elements of `object`, and gives the shape they have.
    fn take(&mut self, object: &PyObject, depth: usize, vm: &VirtualMachine) -> PyResult<Shape> {
        if let Some((value, dtype)) = number(object, vm)? {
            if self.values.len() >= MAX_ELEMENTS {
                check_count(self.values.len() + 1, vm)?;
            }
            self.admit(dtype);
            self.values.push(value);
            return Ok(Shape::NUMBER);
        }
        if let Some(array) = object.downcast_ref::<NdArray>() {
            let view = array.view();
            check_count(self.values.len() + view.size(), vm)?;
            self.admit(view.dtype());
            self.values.extend(view.values());
            return Ok(view.shape());
        }
        if depth < 2
            && let Some(length) = self.take_floats(object, vm)?
        {
            return Ok(Shape::vector(length));
        }
        let Some(children) = sequence(object, vm)? else {
            return Err(not_a_number(object, vm));
        };
        if depth >= 2 {
            return Err(errors::too_many_dimensions(vm));
        }
        let mut inner: Option<Shape> = None;
        for child in &children {
            let shape = self.take(child, depth + 1, vm)?;
            if inner.is_some_and(|known| known != shape) {
                return Err(ragged(depth, children.len(), vm));
            }
            inner = Some(shape);
        }
        match inner {
            None => Ok(Shape::vector(0)),
            Some(shape) if shape.rank() == 0 => Ok(Shape::vector(children.len())),
            Some(shape) if shape.rank() == 1 => Ok(Shape::matrix(children.len(), shape.columns())),
            Some(_) => Err(errors::too_many_dimensions(vm)),
        }
    }
}

fn ragged(
    depth: usize,
    length: usize,
    vm: &VirtualMachine,
) -> rustpython_vm::builtins::PyBaseExceptionRef {
    vm.new_value_error(format!(
        "setting an array element with a sequence. The requested array has an inhomogeneous shape after {} dimensions. \
         The detected shape was ({length},) + inhomogeneous part.",
        depth + 1
    ))
}

/// The view that an object is or describes: an array's own view, or new cells from numbers and nested lists.
///
/// # Errors
///
/// TypeError for what holds no numbers, ValueError for ragged lists.
pub fn view_of(object: &PyObject, vm: &VirtualMachine) -> PyResult<View> {
    if let Some(array) = object.downcast_ref::<NdArray>() {
        return Ok(array.view().clone());
    }
    if let Some((value, dtype)) = number(object, vm)? {
        return Ok(View::number(dtype, value));
    }
    let mut gathered = Gathered {
        values: Vec::new(),
        dtype: None,
    };
    let shape = gathered.take(object, 0, vm)?;
    Ok(View::new(
        gathered.dtype.unwrap_or(Dtype::Float),
        shape,
        gathered.values,
    ))
}

/// The operand of an operator: as [`view_of`], but `None` for an object that is no operand of arrays, so that Python's own TypeError follows.
///
/// # Errors
///
/// ValueError for ragged lists, TypeError for lists of something else.
pub fn operand(object: &PyObject, vm: &VirtualMachine) -> PyResult<Option<View>> {
    let suits = object.downcast_ref::<NdArray>().is_some()
        || object.downcast_ref::<PyFloat>().is_some()
        || object.downcast_ref::<PyInt>().is_some()
        || object.downcast_ref::<PyList>().is_some()
        || object.downcast_ref::<PyTuple>().is_some()
        || object.downcast_ref::<PyRange>().is_some()
        || is_other_sequence(object, vm);
    if suits {
        view_of(object, vm).map(Some)
    } else {
        Ok(None)
    }
}

/// The Python number for an element.
#[must_use]
pub fn element(value: f64, dtype: Dtype, vm: &VirtualMachine) -> PyObjectRef {
    match dtype {
        Dtype::Bool => vm.ctx.new_bool(value != 0.0).into(),
        Dtype::Int => vm.ctx.new_int(value as i64).into(),
        Dtype::Float => vm.ctx.new_float(value).into(),
    }
}

/// The Python object for a result: an array, or a number for rank 0.
#[must_use]
pub fn object(view: View, vm: &VirtualMachine) -> PyObjectRef {
    if view.rank() == 0 {
        element(view.at(0, 0), view.dtype(), vm)
    } else {
        NdArray::from_view(view).into_ref(&vm.ctx).into()
    }
}

/// A tuple of whole numbers, as `shape` is.
#[must_use]
pub fn tuple_of_sizes(sizes: &[usize], vm: &VirtualMachine) -> PyObjectRef {
    let items = sizes
        .iter()
        .map(|size| vm.ctx.new_int(*size).into())
        .collect();
    vm.ctx.new_tuple(items).into()
}

/// A whole number that an argument must be.
///
/// # Errors
///
/// TypeError for anything that is no int.
pub fn integer(object: &PyObject, vm: &VirtualMachine) -> PyResult<isize> {
    let int = object.try_index(vm)?;
    match i64::try_from(int.as_bigint()) {
        Ok(value) => Ok(clamped(value)),
        Err(_) => Err(vm.new_overflow_error("Python int too large to convert to C long")),
    }
}

/// No length, place or axis is larger than this: so the machine's own width does not show, and sums of a few do not overflow.
fn clamped(value: i64) -> isize {
    let bound = i64::from(i32::MAX);
    value.clamp(-bound, bound) as isize
}

/// A float that an argument must be: any real number, or an array of one element.
///
/// # Errors
///
/// TypeError for anything else.
pub fn float(object: &PyObject, vm: &VirtualMachine) -> PyResult<f64> {
    Ok(object.try_float(vm)?.to_f64())
}

/// The shape that an argument describes: a length or a tuple of lengths.
///
/// # Errors
///
/// TypeError for what is no whole number, ValueError for negative lengths and for more than two, MemoryError for too many elements.
pub fn shape(object: &PyObject, vm: &VirtualMachine) -> PyResult<Shape> {
    let lengths = integers(object, vm)?;
    let mut dimensions = Vec::with_capacity(lengths.len());
    for length in lengths {
        if length < 0 {
            return Err(vm.new_value_error("negative dimensions are not allowed"));
        }
        dimensions.push(length as usize);
    }
    let shape = Shape::from_dimensions(&dimensions, vm)?;
    shape.check_size(vm)?;
    Ok(shape)
}

/// Whole numbers: one, or a sequence of them.
///
/// # Errors
///
/// TypeError for what is no whole number.
pub fn integers(object: &PyObject, vm: &VirtualMachine) -> PyResult<Vec<isize>> {
    if object.downcast_ref::<PyInt>().is_some() {
        return Ok(vec![integer(object, vm)?]);
    }
    if let Some(items) = sequence(object, vm)? {
        return items.iter().map(|item| integer(item, vm)).collect();
    }
    if let Some(array) = object.downcast_ref::<NdArray>()
        && array.view().dtype() == Dtype::Int
    {
        return Ok(array
            .view()
            .values()
            .into_iter()
            .map(|value| clamped(value as i64))
            .collect());
    }
    Ok(vec![integer(object, vm)?])
}
