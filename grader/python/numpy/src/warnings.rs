//! The calls with which programs silence or choose numpy's warnings: there are no warnings here, so they do nothing.

use crate::function::Arguments;
use rustpython_vm::{
    Py, PyObjectRef, PyPayload, PyRef, PyResult, VirtualMachine,
    builtins::{PyType, PyTypeRef},
    class::PyClassImpl as _,
    function::FuncArgs,
    pyclass,
};

/// `numpy.errstate`: a context that changes nothing.
#[pyclass(module = "numpy", name = "errstate")]
#[derive(Debug, PyPayload)]
pub struct ErrorState {}

impl ErrorState {
    /// Makes the Python class; called once.
    pub fn make_type() -> PyRef<PyType> {
        Self::make_static_type()
    }
}

#[pyclass]
impl ErrorState {
    #[pyslot]
    fn slot_new(_class: PyTypeRef, _args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        Ok(Self {}.into_ref(&vm.ctx).into())
    }

    #[pymethod]
    fn __enter__(_zelf: &Py<Self>) {}

    #[pymethod]
    fn __exit__(_zelf: &Py<Self>, _args: FuncArgs) -> bool {
        false
    }
}

/// `numpy.seterr`, which here says nothing and changes nothing.
///
/// # Errors
///
/// None.
pub fn seterr(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    ignore(
        arguments,
        &["all", "divide", "over", "under", "invalid"],
        vm,
    );
    Ok(vm.ctx.new_dict().into())
}

/// `numpy.set_printoptions`, which here changes nothing.
///
/// # Errors
///
/// None.
pub fn set_printoptions(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let names = [
        "precision",
        "threshold",
        "edgeitems",
        "linewidth",
        "suppress",
        "nanstr",
        "infstr",
        "formatter",
        "sign",
        "floatmode",
    ];
    ignore(arguments, &names, vm);
    Ok(vm.ctx.none())
}

fn ignore(arguments: &mut Arguments, names: &[&str], vm: &VirtualMachine) {
    for name in names {
        let _: Option<PyObjectRef> = arguments.optional(name, vm);
    }
}
