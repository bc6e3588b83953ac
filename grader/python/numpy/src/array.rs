//! The class `numpy.ndarray`.

use crate::convert;
use crate::dtype::{Dtype, DtypeObject};
use crate::errors;
use crate::function::{Arguments, call_method};
use crate::index;
use crate::print;
use crate::ufunc::{self, Binary};
use crate::view::{Shape, View};
use crate::{choose, product, rearrange, reduce};
use rustpython_vm::{
    AsObject as _, Py, PyObject, PyObjectRef, PyPayload, PyRef, PyResult, VirtualMachine,
    atomic_func,
    builtins::{PyStrRef, PyType},
    class::PyClassImpl as _,
    function::{Either, FuncArgs, PyComparisonValue},
    protocol::{PyIterReturn, PyMappingMethods, PyNumberMethods, PySequenceMethods},
    pyclass,
    types::{
        AsMapping, AsNumber, AsSequence, Comparable, IterNext, Iterable, PyComparisonOp,
        Representable, SelfIter,
    },
};
use std::cell::Cell;

/// An array of rank 1 or 2: a view on cells that other arrays may share.
#[pyclass(module = "numpy", name = "ndarray", unhashable = true)]
#[derive(Debug, PyPayload)]
pub struct NdArray {
    view: View,
}

impl NdArray {
    /// A vector of floats.
    #[must_use]
    pub fn from_vector(values: Vec<f64>) -> Self {
        Self::from_view(View::vector(values))
    }

    /// A matrix of floats, row by row.
    ///
    /// # Panics
    ///
    /// When there are not `rows * columns` values.
    #[must_use]
    pub fn from_matrix(rows: usize, columns: usize, values: Vec<f64>) -> Self {
        Self::from_view(View::matrix(rows, columns, values))
    }

    /// The array of a view of rank 1 or 2.
    #[must_use]
    pub const fn from_view(view: View) -> Self {
        Self { view }
    }

    /// The view that this array is.
    #[must_use]
    pub const fn view(&self) -> &View {
        &self.view
    }

    /// The dimensions: one for a vector, two for a matrix.
    #[must_use]
    pub fn shape(&self) -> Vec<usize> {
        self.view.shape().dimensions()
    }

    /// A copy of the elements, row by row; bools are 0 and 1.
    #[must_use]
    pub fn to_f64(&self) -> Vec<f64> {
        self.view.values()
    }

    /// Whether the elements are bools.
    #[must_use]
    pub fn is_bool(&self) -> bool {
        self.view.dtype() == Dtype::Bool
    }

    /// Makes the Python classes; called once, before the first array.
    pub fn make_type() -> PyRef<PyType> {
        let _ = ArrayIterator::make_static_type();
        Self::make_static_type()
    }

    fn only_element(&self, vm: &VirtualMachine) -> PyResult<f64> {
        if self.view.size() == 1 {
            return Ok(self.view.at(0, 0));
        }
        Err(vm.new_type_error("only length-1 arrays can be converted to Python scalars"))
    }

    fn truth(&self, vm: &VirtualMachine) -> PyResult<bool> {
        match self.view.size() {
            0 => Err(vm.new_value_error(
                "The truth value of an empty array is ambiguous. Use `array.size > 0` to check that an array is not empty.",
            )),
            1 => Ok(self.view.at(0, 0) != 0.0),
            _ => Err(vm.new_value_error(
                "The truth value of an array with more than one element is ambiguous. Use a.any() or a.all()",
            )),
        }
    }

    fn length(&self) -> usize {
        if self.view.rank() == 2 {
            self.view.rows()
        } else {
            self.view.columns()
        }
    }

    /// The element or row at this place, which exists.
    fn item_at(&self, place: usize, vm: &VirtualMachine) -> PyObjectRef {
        if self.view.rank() == 2 {
            convert::object(self.view.row(place), vm)
        } else {
            convert::element(self.view.at(0, place), self.view.dtype(), vm)
        }
    }
}

#[pyclass(with(Comparable, AsMapping, AsSequence, AsNumber, Iterable, Representable))]
impl NdArray {
    #[pyslot]
    fn slot_new(
        _class: rustpython_vm::builtins::PyTypeRef,
        _args: FuncArgs,
        vm: &VirtualMachine,
    ) -> PyResult {
        Err(vm.new_type_error("arrays are made with np.array, np.zeros and their like"))
    }

    // annotations such as `np.ndarray[tuple[int], float]` and `NDArray[np.float64]` mean the class
    #[pyclassmethod]
    fn __class_getitem__(
        class: rustpython_vm::builtins::PyTypeRef,
        _parameters: PyObjectRef,
    ) -> PyObjectRef {
        class.into()
    }

    #[pyslot]
    fn slot_str(zelf: &PyObject, vm: &VirtualMachine) -> PyResult<PyStrRef> {
        let Some(zelf) = zelf.downcast_ref::<Self>() else {
            return zelf.repr(vm);
        };
        Ok(vm.ctx.new_str(print::str(&zelf.view)))
    }

    #[pygetset(name = "shape")]
    fn python_shape(zelf: &Py<Self>, vm: &VirtualMachine) -> PyObjectRef {
        convert::tuple_of_sizes(&zelf.shape(), vm)
    }

    #[pygetset]
    fn ndim(zelf: &Py<Self>) -> usize {
        zelf.view.rank()
    }

    #[pygetset]
    fn size(zelf: &Py<Self>) -> usize {
        zelf.view.size()
    }

    #[pygetset]
    fn dtype(zelf: &Py<Self>, vm: &VirtualMachine) -> PyObjectRef {
        DtypeObject::object(zelf.view.dtype(), vm)
    }

    #[pygetset]
    fn itemsize(zelf: &Py<Self>) -> usize {
        if zelf.is_bool() { 1 } else { 8 }
    }

    #[pygetset]
    fn nbytes(zelf: &Py<Self>) -> usize {
        if zelf.is_bool() {
            zelf.view.size()
        } else {
            8 * zelf.view.size()
        }
    }

    #[pygetset(name = "T")]
    fn transposed(zelf: &Py<Self>) -> Self {
        Self::from_view(zelf.view.transposed())
    }

    #[pygetset]
    fn real(zelf: &Py<Self>) -> Self {
        Self::from_view(zelf.view.clone())
    }

    #[pygetset]
    fn flat(zelf: &Py<Self>) -> Self {
        let size = zelf.view.size();
        Self::from_view(zelf.view.reshaped(Shape::vector(size)))
    }

    #[pymethod]
    fn copy(zelf: &Py<Self>, _args: FuncArgs) -> Self {
        Self::from_view(zelf.view.copied())
    }

    #[pymethod]
    fn __copy__(zelf: &Py<Self>) -> Self {
        Self::from_view(zelf.view.copied())
    }

    #[pymethod]
    fn __deepcopy__(zelf: &Py<Self>, _args: FuncArgs) -> Self {
        Self::from_view(zelf.view.copied())
    }

    #[pymethod]
    fn conj(zelf: &Py<Self>) -> Self {
        Self::from_view(zelf.view.copied())
    }

    #[pymethod]
    fn flatten(zelf: &Py<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult<Self> {
        let mut arguments = Arguments::new("flatten", args);
        let order = arguments.optional("order", vm);
        arguments.finish(vm)?;
        let view = rearrange::in_order(zelf.view.clone(), order, vm)?;
        let shape = Shape::vector(view.size());
        Ok(Self::from_view(View::new(
            view.dtype(),
            shape,
            view.values(),
        )))
    }

    #[pymethod]
    fn tolist(zelf: &Py<Self>, vm: &VirtualMachine) -> PyObjectRef {
        index::to_list(&zelf.view, vm)
    }

    #[pymethod]
    fn fill(zelf: &Py<Self>, value: PyObjectRef, vm: &VirtualMachine) -> PyResult<()> {
        index::set(&zelf.view, vm.ctx.ellipsis.as_object(), &value, vm)
    }

    #[pymethod]
    fn item(zelf: &Py<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        match args.args.as_slice() {
            [] if zelf.view.size() == 1 => {
                Ok(convert::element(zelf.view.at(0, 0), zelf.view.dtype(), vm))
            }
            [] => Err(vm.new_value_error("can only convert an array of size 1 to a Python scalar")),
            [place]
                if zelf.view.rank() == 2
                    && place
                        .downcast_ref::<rustpython_vm::builtins::PyTuple>()
                        .is_none() =>
            {
                index::get(
                    &zelf.view.reshaped(Shape::vector(zelf.view.size())),
                    place,
                    vm,
                )
            }
            [place] => index::get(&zelf.view, place, vm),
            places => index::get(
                &zelf.view,
                vm.ctx.new_tuple(places.to_vec()).as_object(),
                vm,
            ),
        }
    }

    #[pymethod]
    fn astype(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult<Self> {
        let mut arguments = Arguments::new("astype", args);
        let dtype = Dtype::from_object(arguments.required("dtype", vm)?.as_object(), vm)?;
        let _ = arguments.keyword("copy", vm);
        arguments.finish(vm)?;
        Ok(Self::from_view(zelf.view.cast(dtype)))
    }

    #[pymethod]
    fn reshape(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        let mut arguments = Arguments::new("reshape", args);
        let lengths = arguments.rest();
        let shape = match lengths.as_slice() {
            [shape] => shape.clone(),
            lengths => vm.ctx.new_tuple(lengths.to_vec()).into(),
        };
        let order = arguments.optional("order", vm);
        arguments.finish(vm)?;
        rearrange::in_shape(zelf.view.clone(), &shape, order, vm)
    }

    #[pymethod]
    fn transpose(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        let axes = match args.args.as_slice() {
            [] => vm.ctx.none(),
            [axes] => axes.clone(),
            axes => vm.ctx.new_tuple(axes.to_vec()).into(),
        };
        call_method(
            "transpose",
            rearrange::transpose,
            zelf.into(),
            vec![axes].into(),
            vm,
        )
    }

    #[pymethod]
    fn sort(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult<()> {
        let mut arguments = Arguments::new("sort", args);
        let axis = arguments.optional_integer("axis", vm)?.unwrap_or(-1);
        arguments.finish(vm)?;
        let axis = errors::checked_axis(axis, zelf.view.rank(), vm)?;
        zelf.view.assign(&rearrange::sorted(&zelf.view, axis));
        Ok(())
    }

    #[pymethod]
    fn sum(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("sum", reduce::sum, zelf.into(), args, vm)
    }

    #[pymethod]
    fn prod(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("prod", reduce::prod, zelf.into(), args, vm)
    }

    #[pymethod]
    fn min(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("min", reduce::min, zelf.into(), args, vm)
    }

    #[pymethod]
    fn max(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("max", reduce::max, zelf.into(), args, vm)
    }

    #[pymethod]
    fn mean(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("mean", reduce::mean, zelf.into(), args, vm)
    }

    #[pymethod]
    fn std(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("std", reduce::std, zelf.into(), args, vm)
    }

    #[pymethod]
    fn var(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("var", reduce::var, zelf.into(), args, vm)
    }

    #[pymethod]
    fn any(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("any", reduce::any, zelf.into(), args, vm)
    }

    #[pymethod]
    fn all(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("all", reduce::all, zelf.into(), args, vm)
    }

    #[pymethod]
    fn argmin(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("argmin", reduce::argmin, zelf.into(), args, vm)
    }

    #[pymethod]
    fn argmax(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("argmax", reduce::argmax, zelf.into(), args, vm)
    }

    #[pymethod]
    fn cumsum(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("cumsum", reduce::cumsum, zelf.into(), args, vm)
    }

    #[pymethod]
    fn cumprod(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("cumprod", reduce::cumprod, zelf.into(), args, vm)
    }

    #[pymethod]
    fn dot(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("dot", product::dot, zelf.into(), args, vm)
    }

    #[pymethod]
    fn trace(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("trace", product::trace, zelf.into(), args, vm)
    }

    #[pymethod]
    fn diagonal(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("diagonal", product::diagonal, zelf.into(), args, vm)
    }

    #[pymethod]
    fn clip(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("clip", choose::clip, zelf.into(), args, vm)
    }

    #[pymethod]
    fn round(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("round", choose::round, zelf.into(), args, vm)
    }

    #[pymethod]
    fn nonzero(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("nonzero", choose::nonzero, zelf.into(), args, vm)
    }

    #[pymethod]
    fn argsort(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("argsort", rearrange::argsort, zelf.into(), args, vm)
    }

    #[pymethod]
    fn repeat(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("repeat", rearrange::repeat, zelf.into(), args, vm)
    }

    #[pymethod]
    fn squeeze(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("squeeze", rearrange::squeeze, zelf.into(), args, vm)
    }

    #[pymethod]
    fn swapaxes(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("swapaxes", rearrange::swapaxes, zelf.into(), args, vm)
    }

    #[pymethod]
    fn ravel(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("ravel", rearrange::ravel, zelf.into(), args, vm)
    }

    #[pymethod]
    fn take(zelf: PyRef<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        call_method("take", rearrange::take, zelf.into(), args, vm)
    }
}

impl Representable for NdArray {
    fn repr_str(zelf: &Py<Self>, _vm: &VirtualMachine) -> PyResult<String> {
        Ok(print::repr(&zelf.view))
    }
}

impl Comparable for NdArray {
    fn slot_richcompare(
        zelf: &PyObject,
        other: &PyObject,
        op: PyComparisonOp,
        vm: &VirtualMachine,
    ) -> PyResult<Either<PyObjectRef, PyComparisonValue>> {
        let function: &Binary = match op {
            PyComparisonOp::Eq => &ufunc::EQUAL,
            PyComparisonOp::Ne => &ufunc::NOT_EQUAL,
            PyComparisonOp::Lt => &ufunc::LESS,
            PyComparisonOp::Le => &ufunc::LESS_EQUAL,
            PyComparisonOp::Gt => &ufunc::GREATER,
            PyComparisonOp::Ge => &ufunc::GREATER_EQUAL,
        };
        let result = function.operate(zelf, other, vm)?;
        if !result.is(&vm.ctx.not_implemented) {
            return Ok(Either::A(result));
        }
        // an array equals nothing that is not a number, element by element, as in numpy
        let equal = match op {
            PyComparisonOp::Eq => 0.0,
            PyComparisonOp::Ne => 1.0,
            _ => return Ok(Either::B(PyComparisonValue::NotImplemented)),
        };
        let view = convert::view_of(zelf, vm)?;
        let values = vec![equal; view.size()];
        Ok(Either::A(convert::object(
            View::new(Dtype::Bool, view.shape(), values),
            vm,
        )))
    }

    fn cmp(
        _zelf: &Py<Self>,
        _other: &PyObject,
        _op: PyComparisonOp,
        _vm: &VirtualMachine,
    ) -> PyResult<PyComparisonValue> {
        // `slot_richcompare` answers, because a comparison of arrays is an array
        Ok(PyComparisonValue::NotImplemented)
    }
}

impl AsMapping for NdArray {
    fn as_mapping() -> &'static PyMappingMethods {
        static METHODS: PyMappingMethods = PyMappingMethods {
            length: atomic_func!(|mapping, _vm| Ok(NdArray::mapping_downcast(mapping).length())),
            subscript: atomic_func!(|mapping, key, vm| index::get(
                &NdArray::mapping_downcast(mapping).view,
                key,
                vm
            )),
            ass_subscript: atomic_func!(|mapping, key, value, vm| match value {
                Some(value) =>
                    index::set(&NdArray::mapping_downcast(mapping).view, key, &value, vm),
                None => Err(vm.new_value_error("cannot delete array elements")),
            }),
        };
        &METHODS
    }
}

impl AsSequence for NdArray {
    fn as_sequence() -> &'static PySequenceMethods {
        static METHODS: PySequenceMethods = PySequenceMethods {
            length: atomic_func!(|sequence, _vm| Ok(NdArray::sequence_downcast(sequence).length())),
            item: atomic_func!(|sequence, place, vm| {
                let key: PyObjectRef = vm.ctx.new_int(place).into();
                index::get(&NdArray::sequence_downcast(sequence).view, &key, vm)
            }),
            contains: atomic_func!(|sequence, needle, vm| index::contains(
                &NdArray::sequence_downcast(sequence).view,
                needle,
                vm
            )),
            ..PySequenceMethods::NOT_IMPLEMENTED
        };
        &METHODS
    }
}

fn power(left: &PyObject, right: &PyObject, modulus: &PyObject, vm: &VirtualMachine) -> PyResult {
    if vm.is_none(modulus) {
        ufunc::POWER.operate(left, right, vm)
    } else {
        Ok(vm.ctx.not_implemented())
    }
}

fn power_in_place(
    left: &PyObject,
    right: &PyObject,
    _modulus: &PyObject,
    vm: &VirtualMachine,
) -> PyResult {
    ufunc::POWER.operate_in_place(left, right, vm)
}

fn divmod(left: &PyObject, right: &PyObject, vm: &VirtualMachine) -> PyResult {
    let quotient = ufunc::FLOOR_DIVIDE.operate(left, right, vm)?;
    if quotient.is(&vm.ctx.not_implemented) {
        return Ok(quotient);
    }
    let rest = ufunc::REMAINDER.operate(left, right, vm)?;
    Ok(vm.ctx.new_tuple(vec![quotient, rest]).into())
}

fn matrix_multiply_in_place(left: &PyObject, right: &PyObject, vm: &VirtualMachine) -> PyResult {
    let (Some(view), Some(right)) = (convert::operand(left, vm)?, convert::operand(right, vm)?)
    else {
        return Ok(vm.ctx.not_implemented());
    };
    ufunc::store(
        "matmul",
        &product::multiplied(&view, &right, vm)?,
        &view,
        vm,
    )?;
    Ok(left.to_owned())
}

impl AsNumber for NdArray {
    fn as_number() -> &'static PyNumberMethods {
        static METHODS: PyNumberMethods = PyNumberMethods {
            add: Some(|left, right, vm| ufunc::ADD.operate(left, right, vm)),
            subtract: Some(|left, right, vm| ufunc::SUBTRACT.operate(left, right, vm)),
            multiply: Some(|left, right, vm| ufunc::MULTIPLY.operate(left, right, vm)),
            remainder: Some(|left, right, vm| ufunc::REMAINDER.operate(left, right, vm)),
            lshift: Some(|left, right, vm| ufunc::LEFT_SHIFT.operate(left, right, vm)),
            rshift: Some(|left, right, vm| ufunc::RIGHT_SHIFT.operate(left, right, vm)),
            and: Some(|left, right, vm| ufunc::BITWISE_AND.operate(left, right, vm)),
            xor: Some(|left, right, vm| ufunc::BITWISE_XOR.operate(left, right, vm)),
            or: Some(|left, right, vm| ufunc::BITWISE_OR.operate(left, right, vm)),
            floor_divide: Some(|left, right, vm| ufunc::FLOOR_DIVIDE.operate(left, right, vm)),
            true_divide: Some(|left, right, vm| ufunc::DIVIDE.operate(left, right, vm)),
            inplace_add: Some(|left, right, vm| ufunc::ADD.operate_in_place(left, right, vm)),
            inplace_subtract: Some(|left, right, vm| {
                ufunc::SUBTRACT.operate_in_place(left, right, vm)
            }),
            inplace_multiply: Some(|left, right, vm| {
                ufunc::MULTIPLY.operate_in_place(left, right, vm)
            }),
            inplace_remainder: Some(|left, right, vm| {
                ufunc::REMAINDER.operate_in_place(left, right, vm)
            }),
            inplace_lshift: Some(|left, right, vm| {
                ufunc::LEFT_SHIFT.operate_in_place(left, right, vm)
            }),
            inplace_rshift: Some(|left, right, vm| {
                ufunc::RIGHT_SHIFT.operate_in_place(left, right, vm)
            }),
            inplace_and: Some(|left, right, vm| {
                ufunc::BITWISE_AND.operate_in_place(left, right, vm)
            }),
            inplace_xor: Some(|left, right, vm| {
                ufunc::BITWISE_XOR.operate_in_place(left, right, vm)
            }),
            inplace_or: Some(|left, right, vm| ufunc::BITWISE_OR.operate_in_place(left, right, vm)),
            inplace_floor_divide: Some(|left, right, vm| {
                ufunc::FLOOR_DIVIDE.operate_in_place(left, right, vm)
            }),
            inplace_true_divide: Some(|left, right, vm| {
                ufunc::DIVIDE.operate_in_place(left, right, vm)
            }),
            power: Some(power),
            inplace_power: Some(power_in_place),
            divmod: Some(divmod),
            matrix_multiply: Some(product::operate),
            inplace_matrix_multiply: Some(matrix_multiply_in_place),
            negative: Some(|number, vm| ufunc::operate_unary(&ufunc::NEGATIVE, number.obj, vm)),
            positive: Some(|number, vm| ufunc::operate_unary(&ufunc::POSITIVE, number.obj, vm)),
            absolute: Some(|number, vm| ufunc::operate_unary(&ufunc::ABSOLUTE, number.obj, vm)),
            invert: Some(|number, vm| ufunc::operate_unary(&ufunc::INVERT, number.obj, vm)),
            boolean: Some(|number, vm| NdArray::number_downcast(number).truth(vm)),
            float: Some(|number, vm| {
                let value = NdArray::number_downcast(number).only_element(vm)?;
                Ok(vm.ctx.new_float(value).into())
            }),
            int: Some(|number, vm| {
                let value = NdArray::number_downcast(number).only_element(vm)?;
                Ok(vm.ctx.new_float(value).as_object().try_int(vm)?.into())
            }),
            ..PyNumberMethods::NOT_IMPLEMENTED
        };
        &METHODS
    }
}

impl Iterable for NdArray {
    fn iter(zelf: PyRef<Self>, vm: &VirtualMachine) -> PyResult {
        let iterator = ArrayIterator {
            array: zelf,
            next: Cell::new(0),
        };
        Ok(iterator.into_ref(&vm.ctx).into())
    }
}

/// The iterator over an array: numbers of a vector, rows of a matrix (which share its cells).
#[pyclass(module = "numpy", name = "ndarray_iterator")]
#[derive(Debug, PyPayload)]
pub struct ArrayIterator {
    array: PyRef<NdArray>,
    next: Cell<usize>,
}

#[pyclass(with(Iterable, IterNext))]
impl ArrayIterator {}

impl SelfIter for ArrayIterator {}

impl IterNext for ArrayIterator {
    fn next(zelf: &Py<Self>, vm: &VirtualMachine) -> PyResult<PyIterReturn> {
        let place = zelf.next.get();
        if place >= zelf.array.length() {
            return Ok(PyIterReturn::StopIteration(None));
        }
        zelf.next.set(place + 1);
        Ok(PyIterReturn::Return(zelf.array.item_at(place, vm)))
    }
}
