//! The modules `math`, `numpy`, `numpy.linalg` and their small companions: what is in them, and how they get into an interpreter.

use crate::absent;
use crate::array::NdArray;
use crate::convert;
use crate::dtype::{Dtype, DtypeObject};
use crate::errors;
use crate::function::{Arguments, Body, Function, Plain};
use crate::math;
use crate::ufunc::{BINARY, FLOOR_DIVIDE, REMAINDER, UNARY};
use crate::warnings::{self, ErrorState};
use crate::{choose, construct, curves, join, linalg, product, rearrange, reduce};
use rustpython_vm::{
    AsObject as _, Py, PyObject, PyObjectRef, PyRef, PyResult, VirtualMachine,
    builtins::{PyDictRef, PyModule, PyStr},
    types::GetAttr as _,
};
use std::sync::LazyLock;

/// The functions of `numpy` that are not elementwise.
const NUMPY: &[(&str, Plain)] = &[
    ("array", construct::array),
    ("asarray", construct::asarray),
    ("asanyarray", construct::asarray),
    ("ascontiguousarray", construct::asarray),
    ("copy", construct::copy),
    ("zeros", construct::zeros),
    ("ones", construct::ones),
    ("full", construct::full),
    ("empty", construct::zeros),
    ("zeros_like", construct::zeros_like),
    ("ones_like", construct::ones_like),
    ("full_like", construct::full_like),
    ("empty_like", construct::zeros_like),
    ("eye", construct::eye),
    ("identity", construct::identity),
    ("diag", construct::diag),
    ("tril", construct::tril),
    ("triu", construct::triu),
    ("arange", construct::arange),
    ("linspace", construct::linspace),
    ("logspace", construct::logspace),
    ("meshgrid", construct::meshgrid),
    ("concatenate", join::concatenate),
    ("concat", join::concatenate),
    ("vstack", join::vstack),
    ("hstack", join::hstack),
    ("column_stack", join::column_stack),
    ("stack", join::stack),
    ("append", join::append),
    ("block", join::block),
    ("dot", product::dot),
    ("matmul", product::matmul),
    ("inner", product::inner),
    ("vdot", product::vdot),
    ("outer", product::outer),
    ("kron", product::kron),
    ("cross", product::cross),
    ("trace", product::trace),
    ("diagonal", product::diagonal),
    ("sum", reduce::sum),
    ("prod", reduce::prod),
    ("mean", reduce::mean),
    ("average", reduce::weighted),
    ("median", reduce::median),
    ("quantile", reduce::quantile),
    ("percentile", reduce::percentile),
    ("std", reduce::std),
    ("var", reduce::var),
    ("min", reduce::min),
    ("max", reduce::max),
    ("amin", reduce::min),
    ("amax", reduce::max),
    ("ptp", reduce::ptp),
    ("any", reduce::any),
    ("all", reduce::all),
    ("argmin", reduce::argmin),
    ("argmax", reduce::argmax),
    ("cumsum", reduce::cumsum),
    ("cumprod", reduce::cumprod),
    ("count_nonzero", reduce::count_nonzero),
    ("nansum", reduce::nansum),
    ("nanmean", reduce::nanmean),
    ("nanmin", reduce::nanmin),
    ("nanmax", reduce::nanmax),
    ("nanstd", reduce::nanstd),
    ("nanmedian", reduce::nanmedian),
    ("where", choose::choose),
    ("nonzero", choose::nonzero),
    ("flatnonzero", choose::flatnonzero),
    ("argwhere", choose::argwhere),
    ("clip", choose::clip),
    ("round", choose::round),
    ("around", choose::round),
    ("isclose", choose::isclose),
    ("allclose", choose::allclose),
    ("array_equal", choose::array_equal),
    ("nan_to_num", choose::nan_to_num),
    ("isscalar", choose::isscalar),
    ("reshape", rearrange::reshape),
    ("ravel", rearrange::ravel),
    ("transpose", rearrange::transpose),
    ("permute_dims", rearrange::transpose),
    ("swapaxes", rearrange::swapaxes),
    ("squeeze", rearrange::squeeze),
    ("expand_dims", rearrange::expand_dims),
    ("atleast_1d", rearrange::atleast_1d),
    ("atleast_2d", rearrange::atleast_2d),
    ("broadcast_to", rearrange::broadcast_to),
    ("sort", rearrange::sort),
    ("argsort", rearrange::argsort),
    ("unique", rearrange::unique),
    ("flip", rearrange::flip),
    ("flipud", rearrange::flipud),
    ("fliplr", rearrange::fliplr),
    ("roll", rearrange::roll),
    ("tile", rearrange::tile),
    ("repeat", rearrange::repeat),
    ("take", rearrange::take),
    ("delete", rearrange::delete),
    ("shape", rearrange::shape),
    ("ndim", rearrange::ndim),
    ("size", rearrange::size),
    ("diff", curves::diff),
    ("ediff1d", curves::ediff1d),
    ("gradient", curves::gradient),
    ("interp", curves::interp),
    ("unwrap", curves::unwrap),
    ("trapezoid", curves::trapezoid),
    ("convolve", curves::convolve),
    ("polyval", curves::polyval),
    ("vander", curves::vander),
    ("searchsorted", curves::searchsorted),
    ("divmod", divide_with_rest),
    ("issubdtype", issubdtype),
    ("seterr", warnings::seterr),
    ("set_printoptions", warnings::set_printoptions),
];

/// The functions of `numpy.linalg`.
const LINALG: &[(&str, Plain)] = &[
    ("solve", linalg::solve),
    ("inv", linalg::inv),
    ("pinv", linalg::pinv),
    ("det", linalg::det),
    ("slogdet", linalg::slogdet),
    ("norm", linalg::norm),
    ("cond", linalg::cond),
    ("matrix_rank", linalg::matrix_rank),
    ("matrix_power", linalg::matrix_power),
    ("lstsq", linalg::lstsq),
    ("svd", linalg::svd),
    ("qr", linalg::qr),
    ("cholesky", linalg::cholesky),
    ("eigh", linalg::eigh),
    ("eigvalsh", linalg::eigvalsh),
];

/// The float constants of `numpy`.
const CONSTANTS: &[(&str, f64)] = &[
    ("pi", std::f64::consts::PI),
    ("e", std::f64::consts::E),
    ("euler_gamma", 0.577_215_664_901_532_9),
    ("inf", f64::INFINITY),
    ("nan", f64::NAN),
];

/// What else is in `numpy`: types, modules, `newaxis`.
const OTHERS: &[&str] = &[
    "newaxis",
    "float64",
    "double",
    "floating",
    "int64",
    "int_",
    "integer",
    "bool_",
    "bool",
    "ndarray",
    "dtype",
    "errstate",
    "linalg",
    "exceptions",
    "typing",
    "True_",
    "False_",
];

/// The public names of each module.
static NAMES: LazyLock<Vec<(&'static str, Vec<&'static str>)>> = LazyLock::new(listed);

/// Every public name, by module: what the documentation lists is checked against this.
#[must_use]
pub fn names() -> &'static [(&'static str, Vec<&'static str>)] {
    &NAMES
}

fn listed() -> Vec<(&'static str, Vec<&'static str>)> {
    let elementwise = UNARY
        .iter()
        .map(|function| (function.name, function.aliases))
        .chain(
            BINARY
                .iter()
                .map(|function| (function.name, function.aliases)),
        )
        .flat_map(|(name, aliases)| std::iter::once(name).chain(aliases.iter().copied()));
    let mut numpy: Vec<&str> = NUMPY
        .iter()
        .map(|(name, _)| *name)
        .chain(elementwise)
        .collect();
    numpy.extend(CONSTANTS.iter().map(|(name, _)| *name));
    numpy.extend(OTHERS);
    let mut linear: Vec<&str> = LINALG.iter().map(|(name, _)| *name).collect();
    linear.push("LinAlgError");
    let mut plain: Vec<&str> = math::FUNCTIONS.iter().map(|(name, _)| *name).collect();
    plain.extend(math::CONSTANTS.iter().map(|(name, _)| *name));
    let mut all = vec![("math", plain), ("numpy", numpy), ("numpy.linalg", linear)];
    for (_, names) in &mut all {
        names.sort_unstable();
    }
    all
}

/// `numpy.divmod`.
fn divide_with_rest(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let left = arguments.array("x1", vm)?;
    let right = arguments.array("x2", vm)?;
    let parts = vec![
        convert::object(FLOOR_DIVIDE.apply(&left, &right, vm)?, vm),
        convert::object(REMAINDER.apply(&left, &right, vm)?, vm),
    ];
    Ok(vm.ctx.new_tuple(parts).into())
}

/// `numpy.issubdtype`; `floating` and `integer` are Python's float and int here.
fn issubdtype(arguments: &mut Arguments, vm: &VirtualMachine) -> PyResult {
    let left = Dtype::from_object(arguments.required("arg1", vm)?.as_object(), vm)?;
    let right = Dtype::from_object(arguments.required("arg2", vm)?.as_object(), vm)?;
    Ok(vm.ctx.new_bool(left == right).into())
}

/// The attribute of a module; for a name that one of ours does not have, what to do instead.
///
/// Not the modules' `__getattr__`: the interpreter reads an attribute fast where a module has none.
fn attribute(module: &PyObject, name: &Py<PyStr>, vm: &VirtualMachine) -> PyResult {
    let Some(module) = module.downcast_ref::<PyModule>() else {
        return module.generic_getattr(name, vm);
    };
    let error = match PyModule::getattro(module, name, vm) {
        Ok(value) => return Ok(value),
        Err(error) => error,
    };
    let text = name.to_string_lossy();
    if text.starts_with('_') || !error.fast_isinstance(vm.ctx.exceptions.attribute_error) {
        return Err(error);
    }
    let own = module.dict().get_item_opt("__name__", vm)?;
    let own = own.as_deref().and_then(|name| name.downcast_ref::<PyStr>());
    let own = own.map_or_else(String::new, |name| name.to_string());
    let Some((own, known)) = names().iter().find(|(known, _)| *known == own) else {
        return Err(error);
    };
    Err(vm.new_attribute_error(absent::sentence(own, &text, known)))
}

/// A module under construction.
struct Filling<'vm> {
    dict: PyDictRef,
    vm: &'vm VirtualMachine,
}

impl<'vm> Filling<'vm> {
    fn new(vm: &'vm VirtualMachine) -> Self {
        Self {
            dict: vm.ctx.new_dict(),
            vm,
        }
    }

    fn add(&self, name: &'static str, object: PyObjectRef) -> PyResult<()> {
        self.dict
            .set_item(self.vm.ctx.intern_str(name), object, self.vm)
    }

    fn add_function(&self, name: &'static str, body: Body) -> PyResult<()> {
        self.add(name, Function::object(name, body, self.vm))
    }

    fn add_functions(&self, functions: &[(&'static str, Plain)]) -> PyResult<()> {
        functions
            .iter()
            .try_for_each(|(name, body)| self.add_function(name, Body::Plain(*body)))
    }

    fn add_elementwise(&self) -> PyResult<()> {
        for function in UNARY {
            for name in std::iter::once(&function.name).chain(function.aliases) {
                self.add_function(name, Body::Unary(function))?;
            }
        }
        for function in BINARY {
            for name in std::iter::once(&function.name).chain(function.aliases) {
                self.add_function(name, Body::Binary(function))?;
            }
        }
        Ok(())
    }

    fn add_floats(&self, constants: &[(&'static str, f64)]) -> PyResult<()> {
        constants
            .iter()
            .try_for_each(|(name, value)| self.add(name, self.vm.ctx.new_float(*value).into()))
    }

    /// Makes the module, and lets `import` find it.
    fn finish(self, name: &'static str, documentation: &'static str) -> PyResult<PyRef<PyModule>> {
        let vm = self.vm;
        let doc = vm.ctx.new_str(documentation);
        let module = vm.new_module(name, self.dict, Some(doc));
        let loaded = vm.sys_module.get_attr("modules", vm)?;
        loaded.set_item(vm.ctx.intern_str(name), module.clone().into(), vm)?;
        Ok(module)
    }
}

/// Puts the modules into an interpreter, once, before a program runs: `import math` and `import numpy` then find them.
///
/// # Errors
///
/// Those of an interpreter that has no memory or no `sys.modules`.
pub fn install(vm: &VirtualMachine) -> PyResult<()> {
    Function::make_type();
    let dtype = DtypeObject::make_type();
    let array: PyObjectRef = NdArray::make_type().into();
    let error_state = ErrorState::make_type();
    let types = errors::types(vm);
    let module = vm.ctx.types.module_type;
    module.slots().getattro.store(Some(attribute));
    // a truth value out of an array is Python's own, and `~np.any(a)` means what it means in numpy; -2 means nothing to anybody
    let truth = &vm.ctx.types.bool_type.slots().as_number;
    truth.invert.store(Some(|value, vm| {
        let is_true = value.obj.is(&vm.ctx.true_value);
        Ok(vm.ctx.new_bool(!is_true).into())
    }));

    math(vm)?;
    let linear = linear(types.linear_algebra.into(), vm)?;

    let exceptions = Filling::new(vm);
    exceptions.add("AxisError", types.axis.into())?;
    let exceptions = exceptions.finish("numpy.exceptions", "numpy's exceptions.")?;
    let typing = typing(&array, vm)?;

    let numpy = Filling::new(vm);
    numpy.add_functions(NUMPY)?;
    numpy.add_floats(CONSTANTS)?;
    numpy.add_elementwise()?;
    // numbers out of arrays are Python's own, so numpy's scalar types are Python's too
    let float: PyObjectRef = vm.ctx.types.float_type.to_owned().into();
    let int: PyObjectRef = vm.ctx.types.int_type.to_owned().into();
    let truth: PyObjectRef = vm.ctx.types.bool_type.to_owned().into();
    for (name, object) in [
        ("float64", &float),
        ("double", &float),
        ("floating", &float),
        ("int64", &int),
        ("int_", &int),
        ("integer", &int),
        ("bool_", &truth),
        ("bool", &truth),
        ("ndarray", &array),
    ] {
        numpy.add(name, object.clone())?;
    }
    numpy.add("newaxis", vm.ctx.none())?;
    numpy.add("True_", vm.ctx.new_bool(true).into())?;
    numpy.add("False_", vm.ctx.new_bool(false).into())?;
    numpy.add("dtype", dtype.into())?;
    numpy.add("errstate", error_state.into())?;
    numpy.add("linalg", linear.as_object().to_owned())?;
    numpy.add("exceptions", exceptions.as_object().to_owned())?;
    numpy.add("typing", typing.as_object().to_owned())?;
    numpy.add("__version__", vm.ctx.new_str("2.4.6").into())?;
    // a module with a path is a package: `import numpy.linalg` looks inside
    numpy.add("__path__", vm.ctx.new_list(Vec::new()).into())?;
    numpy.finish("numpy", "Arrays of numbers, as numpy has them.")?;
    Ok(())
}

/// Module `math`.
fn math(vm: &VirtualMachine) -> PyResult<()> {
    let plain = Filling::new(vm);
    plain.add_functions(math::FUNCTIONS)?;
    plain.add_floats(math::CONSTANTS)?;
    plain.finish("math", "The functions of numbers.")?;
    Ok(())
}

/// Module `numpy.linalg`.
fn linear(error: PyObjectRef, vm: &VirtualMachine) -> PyResult<PyRef<PyModule>> {
    let linear = Filling::new(vm);
    linear.add_functions(LINALG)?;
    linear.add("LinAlgError", error)?;
    linear.finish("numpy.linalg", "Linear algebra, as numpy has it.")
}

/// Module `numpy.typing`; `array` is the type of arrays.
fn typing(array: &PyObjectRef, vm: &VirtualMachine) -> PyResult<PyRef<PyModule>> {
    let typing = Filling::new(vm);
    let anything: PyObjectRef = vm.ctx.types.object_type.to_owned().into();
    for (name, class) in [
        ("NDArray", array),
        ("ArrayLike", &anything),
        ("DTypeLike", &anything),
    ] {
        typing.add(name, class.clone())?;
    }
    typing.finish("numpy.typing", "Names for annotations.")
}
