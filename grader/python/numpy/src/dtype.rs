//! The three kinds of elements an array can have, and numpy's `dtype` objects that name them.

use rustpython_vm::{
    AsObject, Py, PyObject, PyObjectRef, PyPayload, PyRef, PyResult, VirtualMachine,
    builtins::{PyStr, PyType},
    class::PyClassImpl as _,
    common::hash::PyHash,
    function::PyComparisonValue,
    pyclass,
    types::{Comparable, Constructor, Hashable, PyComparisonOp, Representable},
};

/// The kind of an array's elements. The order is the order of promotion: the result of an operation has the larger of the kinds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Dtype {
    /// `bool`, stored as 0 and 1.
    Bool,
    /// `int64`, stored as whole numbers: exact to 2**53.
    Int,
    /// `float64`.
    Float,
}

impl Dtype {
    /// numpy's name of the kind.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bool => "bool",
            Self::Int => "int64",
            Self::Float => "float64",
        }
    }

    /// Whether an operation may put elements of this kind into an array of kind `to` (numpy's rule `same_kind`).
    #[must_use]
    pub fn may_become(self, to: Self) -> bool {
        self <= to
    }

    /// The value as this kind stores it: numpy truncates toward zero, and what has no integer becomes the smallest one.
    #[must_use]
    pub fn cast(self, value: f64) -> f64 {
        match self {
            Self::Bool => f64::from(u8::from(value != 0.0)),
            Self::Int if value.is_finite() && value.abs() < 9.3e18 => value.trunc() + 0.0,
            Self::Int => -9_223_372_036_854_775_808.0,
            Self::Float => value,
        }
    }

    /// The kind that `dtype=` names: a type, numpy's name, or a dtype object.
    ///
    /// # Errors
    ///
    /// TypeError for a kind that arrays here do not have.
    pub fn from_object(object: &PyObject, vm: &VirtualMachine) -> PyResult<Self> {
        if let Some(dtype) = object.downcast_ref::<DtypeObject>() {
            return Ok(dtype.dtype);
        }
        if let Some(class) = object.downcast_ref::<PyType>() {
            let types = &vm.ctx.types;
            for (known, dtype) in [
                (types.bool_type, Self::Bool),
                (types.int_type, Self::Int),
                (types.float_type, Self::Float),
            ] {
                if class.is(known) {
                    return Ok(dtype);
                }
            }
        } else if let Some(name) = object.downcast_ref::<PyStr>() {
            match name.to_string_lossy().trim_start_matches(['<', '=']) {
                "float" | "float64" | "f8" | "d" | "double" => return Ok(Self::Float),
                "int" | "int64" | "i8" | "l" | "q" => return Ok(Self::Int),
                "bool" | "bool_" | "?" | "b1" => return Ok(Self::Bool),
                _ => {}
            }
        }
        let shown = match object.downcast_ref::<PyType>() {
            Some(class) => class.name().to_string(),
            None => object.repr(vm)?.to_string_lossy().into_owned(),
        };
        Err(vm.new_type_error(format!(
            "data type {shown} not understood: arrays here are float64, int64 or bool"
        )))
    }
}

/// The object that `array.dtype` gives.
#[pyclass(module = "numpy", name = "dtype")]
#[derive(Debug, PyPayload)]
pub struct DtypeObject {
    /// The kind this object names.
    pub dtype: Dtype,
}

impl DtypeObject {
    /// A new object that names `dtype`.
    #[must_use]
    pub fn object(dtype: Dtype, vm: &VirtualMachine) -> PyObjectRef {
        Self { dtype }.into_ref(&vm.ctx).into()
    }

    /// Makes the Python class; called once, before the first object.
    pub fn make_type() -> PyRef<PyType> {
        Self::make_static_type()
    }
}

#[pyclass(with(Comparable, Hashable, Representable, Constructor))]
impl DtypeObject {
    #[pygetset]
    fn name(zelf: &Py<Self>) -> &'static str {
        zelf.dtype.name()
    }

    #[pygetset]
    fn kind(zelf: &Py<Self>) -> &'static str {
        match zelf.dtype {
            Dtype::Bool => "b",
            Dtype::Int => "i",
            Dtype::Float => "f",
        }
    }

    #[pygetset]
    fn itemsize(zelf: &Py<Self>) -> usize {
        if zelf.dtype == Dtype::Bool { 1 } else { 8 }
    }

    #[pygetset(name = "type")]
    fn python_type(zelf: &Py<Self>, vm: &VirtualMachine) -> PyObjectRef {
        let types = &vm.ctx.types;
        let class = match zelf.dtype {
            Dtype::Bool => types.bool_type,
            Dtype::Int => types.int_type,
            Dtype::Float => types.float_type,
        };
        class.to_owned().into()
    }

    #[pymethod]
    fn __str__(zelf: &Py<Self>) -> &'static str {
        zelf.dtype.name()
    }
}

impl Constructor for DtypeObject {
    type Args = (PyObjectRef,);

    fn py_new(_class: &Py<PyType>, (object,): Self::Args, vm: &VirtualMachine) -> PyResult<Self> {
        Ok(Self {
            dtype: Dtype::from_object(&object, vm)?,
        })
    }
}

impl Representable for DtypeObject {
    fn repr_str(zelf: &Py<Self>, _vm: &VirtualMachine) -> PyResult<String> {
        Ok(format!("dtype('{}')", zelf.dtype.name()))
    }
}

impl Hashable for DtypeObject {
    fn hash(zelf: &Py<Self>, _vm: &VirtualMachine) -> PyResult<PyHash> {
        Ok(zelf.dtype as PyHash)
    }
}

impl Comparable for DtypeObject {
    fn cmp(
        zelf: &Py<Self>,
        other: &PyObject,
        op: PyComparisonOp,
        vm: &VirtualMachine,
    ) -> PyResult<PyComparisonValue> {
        op.eq_only(|| {
            // what names no kind is simply not equal, as in numpy
            let equal = Dtype::from_object(other, vm).is_ok_and(|dtype| dtype == zelf.dtype);
            Ok(PyComparisonValue::Implemented(equal))
        })
    }
}
