//! The Python object for a function of these modules, and the reading of its arguments.

use crate::convert;
use crate::dtype::Dtype;
use crate::fold;
use crate::ufunc::{self, Binary, Unary};
use crate::view::View;
use rustpython_vm::{
    Py, PyObject, PyObjectRef, PyPayload, PyRef, PyResult, VirtualMachine,
    builtins::{PyStr, PyType},
    class::PyClassImpl as _,
    function::FuncArgs,
    pyclass,
    types::{Callable, Representable},
};
use std::vec::IntoIter;

/// What a function does with its arguments.
pub type Plain = fn(&mut Arguments, &VirtualMachine) -> PyResult;

/// What runs when a function is called.
#[derive(Clone, Copy, Debug)]
pub enum Body {
    /// A function of its own.
    Plain(Plain),
    /// A function of each element.
    Unary(&'static Unary),
    /// A function of each pair of elements.
    Binary(&'static Binary),
}

/// A function of module `math`, `numpy` or `numpy.linalg`.
#[pyclass(module = "numpy", name = "function")]
#[derive(Debug, PyPayload)]
pub struct Function {
    name: &'static str,
    body: Body,
}

impl Function {
    /// The Python object for the function `name`.
    #[must_use]
    pub fn object(name: &'static str, body: Body, vm: &VirtualMachine) -> PyObjectRef {
        Self { name, body }.into_ref(&vm.ctx).into()
    }

    /// Makes the Python class; called once, before the first object.
    pub fn make_type() -> PyRef<PyType> {
        let class = Self::make_static_type();
        class.slots().vectorcall.store(Some(called));
        class
    }

    fn run(&self, mut arguments: Arguments, vm: &VirtualMachine) -> PyResult {
        let result = match self.body {
            Body::Plain(body) => {
                let result = body(&mut arguments, vm)?;
                arguments.finish(vm)?;
                return Ok(result);
            }
            Body::Unary(function) => {
                if let Some(result) = function.of_number(&arguments, vm)? {
                    return Ok(result);
                }
                let operand = arguments.array("x", vm)?;
                function.apply(&operand, vm)?
            }
            Body::Binary(function) => {
                if let Some(result) = function.of_numbers(&arguments, vm)? {
                    return Ok(result);
                }
                let left = arguments.array("x1", vm)?;
                let right = arguments.array("x2", vm)?;
                function.apply(&left, &right, vm)?
            }
        };
        let out = arguments.optional("out", vm);
        arguments.finish(vm)?;
        deliver(self.name, result, out, vm)
    }
}

type Fold = fn(&'static Binary, &mut Arguments, &VirtualMachine) -> PyResult;

impl Function {
    /// Runs a method that only functions of two arrays have.
    fn fold(
        &self,
        method: &'static str,
        body: Fold,
        args: FuncArgs,
        vm: &VirtualMachine,
    ) -> PyResult {
        let Body::Binary(function) = self.body else {
            return Err(vm.new_attribute_error(format!(
                "function '{}' has no method '{method}'",
                self.name
            )));
        };
        let mut arguments = Arguments::new(method, args);
        let result = body(function, &mut arguments, vm)?;
        arguments.finish(vm)?;
        Ok(result)
    }
}

/// Runs a function of its own with `args`; what it leaves of them is an error.
///
/// # Errors
///
/// Those of the function; TypeError for arguments that it does not take.
pub fn call(name: &'static str, body: Plain, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
    let mut arguments = Arguments::new(name, args);
    let result = body(&mut arguments, vm)?;
    arguments.finish(vm)?;
    Ok(result)
}

/// Runs a function as a method: `object` is its first argument.
///
/// # Errors
///
/// As [`call`].
pub fn call_method(
    name: &'static str,
    body: Plain,
    object: PyObjectRef,
    mut args: FuncArgs,
    vm: &VirtualMachine,
) -> PyResult {
    args.args.insert(0, object);
    call(name, body, args, vm)
}

#[pyclass(with(Callable, Representable))]
impl Function {
    #[pygetset]
    fn __name__(zelf: &Py<Self>) -> &'static str {
        zelf.name
    }

    #[pymethod]
    fn reduce(zelf: &Py<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        zelf.fold("reduce", fold::reduce, args, vm)
    }

    #[pymethod]
    fn accumulate(zelf: &Py<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        zelf.fold("accumulate", fold::accumulate, args, vm)
    }

    #[pymethod]
    fn outer(zelf: &Py<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        zelf.fold("outer", fold::outer, args, vm)
    }
}

impl Callable for Function {
    type Args = FuncArgs;

    fn call(zelf: &Py<Self>, args: FuncArgs, vm: &VirtualMachine) -> PyResult {
        zelf.run(Arguments::new(zelf.name, args), vm)
    }
}

/// As `Callable::call`, for the arguments as they lie on the interpreter's stack: positional ones, then those with these names.
fn called(
    function: &PyObject,
    mut values: Vec<PyObjectRef>,
    positional: usize,
    names: Option<&[PyObjectRef]>,
    vm: &VirtualMachine,
) -> PyResult {
    let Some(function) = function.downcast_ref::<Function>() else {
        return Err(vm.new_type_error("a function of numpy is called as another object"));
    };
    let mut keywords = Vec::new();
    if let Some(names) = names {
        let named = values.drain(positional..).zip(names);
        keywords.extend(named.map(|(value, name)| (name_of(name), value)));
    }
    let arguments = Arguments {
        function: function.name,
        positional: values.into_iter(),
        keywords,
    };
    function.run(arguments, vm)
}

fn name_of(name: &PyObject) -> String {
    let name = name.downcast_ref::<PyStr>();
    name.map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// The result as a new object, or in the array that `out=` gives.
///
/// # Errors
///
/// TypeError when `out` is no array or of a smaller kind, ValueError when it is of another shape.
pub fn deliver(
    name: &str,
    result: View,
    out: Option<PyObjectRef>,
    vm: &VirtualMachine,
) -> PyResult {
    let Some(out) = out else {
        return Ok(convert::object(result, vm));
    };
    let Some(array) = out.downcast_ref::<crate::array::NdArray>() else {
        return Err(vm.new_type_error("return arrays must be of ArrayType"));
    };
    ufunc::store(name, &result, array.view(), vm)?;
    Ok(out)
}

impl Representable for Function {
    fn repr_str(zelf: &Py<Self>, _vm: &VirtualMachine) -> PyResult<String> {
        Ok(match zelf.body {
            Body::Plain(_) => format!("<function {}>", zelf.name),
            Body::Unary(_) | Body::Binary(_) => format!("<ufunc '{}'>", zelf.name),
        })
    }
}

/// The arguments of a call, taken one by one under their names.
#[derive(Debug)]
pub struct Arguments {
    function: &'static str,
    positional: IntoIter<PyObjectRef>,
    keywords: Vec<(String, PyObjectRef)>,
}

impl Arguments {
    /// The arguments with which `function` was called.
    #[must_use]
    pub fn new(function: &'static str, args: FuncArgs) -> Self {
        let keywords = args.kwargs.into_iter();
        Self {
            function,
            positional: args.args.into_iter(),
            keywords: keywords
                .map(|(name, value)| (name.to_string(), value))
                .collect(),
        }
    }

    /// The positional arguments that are left, if there are no others.
    #[must_use]
    pub fn only_positional(&self) -> Option<&[PyObjectRef]> {
        self.keywords
            .is_empty()
            .then_some(self.positional.as_slice())
    }

    fn named(&mut self, name: &str) -> Option<PyObjectRef> {
        let place = self.keywords.iter().position(|(known, _)| known == name)?;
        Some(self.keywords.remove(place).1)
    }

    /// The next positional argument, or the one with this name; `None` when there is neither.
    pub fn next(&mut self, name: &str) -> Option<PyObjectRef> {
        self.positional.next().or_else(|| self.named(name))
    }

    /// As [`Arguments::next`], and Python's None counts as nothing given.
    pub fn optional(&mut self, name: &str, vm: &VirtualMachine) -> Option<PyObjectRef> {
        self.next(name).filter(|object| !vm.is_none(object))
    }

    /// The argument that can be given by its name only; Python's None counts as nothing given.
    pub fn keyword(&mut self, name: &str, vm: &VirtualMachine) -> Option<PyObjectRef> {
        self.named(name).filter(|object| !vm.is_none(object))
    }

    /// The next argument, which must be there.
    ///
    /// # Errors
    ///
    /// TypeError when it is not.
    pub fn required(&mut self, name: &str, vm: &VirtualMachine) -> PyResult {
        self.next(name).ok_or_else(|| {
            vm.new_type_error(format!(
                "{}() missing required argument '{name}'",
                self.function
            ))
        })
    }

    /// The next argument as an array.
    ///
    /// # Errors
    ///
    /// TypeError when it is missing or holds no numbers, ValueError for ragged lists.
    pub fn array(&mut self, name: &str, vm: &VirtualMachine) -> PyResult<View> {
        let object = self.required(name, vm)?;
        convert::view_of(&object, vm)
    }

    /// The next argument as an array, when it is given.
    ///
    /// # Errors
    ///
    /// TypeError when it holds no numbers, ValueError for ragged lists.
    pub fn optional_array(&mut self, name: &str, vm: &VirtualMachine) -> PyResult<Option<View>> {
        self.optional(name, vm)
            .map(|object| convert::view_of(&object, vm))
            .transpose()
    }

    /// The next argument as a whole number, when it is given.
    ///
    /// # Errors
    ///
    /// TypeError when it is no int.
    pub fn optional_integer(&mut self, name: &str, vm: &VirtualMachine) -> PyResult<Option<isize>> {
        self.optional(name, vm)
            .map(|object| convert::integer(&object, vm))
            .transpose()
    }

    /// The next argument as a float, when it is given.
    ///
    /// # Errors
    ///
    /// TypeError when it is no real number.
    pub fn optional_float(&mut self, name: &str, vm: &VirtualMachine) -> PyResult<Option<f64>> {
        self.optional(name, vm)
            .map(|object| convert::float(&object, vm))
            .transpose()
    }

    /// The next argument as a truth value, when it is given.
    ///
    /// # Errors
    ///
    /// Those of the object's `__bool__`.
    pub fn optional_truth(&mut self, name: &str, vm: &VirtualMachine) -> PyResult<Option<bool>> {
        self.optional(name, vm)
            .map(|object| object.try_to_bool(vm))
            .transpose()
    }

    /// The next argument as the kind of elements, when it is given.
    ///
    /// # Errors
    ///
    /// TypeError for a kind that arrays here do not have.
    pub fn optional_dtype(&mut self, name: &str, vm: &VirtualMachine) -> PyResult<Option<Dtype>> {
        self.optional(name, vm)
            .map(|object| Dtype::from_object(&object, vm))
            .transpose()
    }

    /// All positional arguments that are left.
    pub fn rest(&mut self) -> Vec<PyObjectRef> {
        self.positional.by_ref().collect()
    }

    /// The number of positional arguments that are left.
    #[must_use]
    pub fn left(&self) -> usize {
        self.positional.len()
    }

    /// Refuses arguments that nothing has taken.
    ///
    /// # Errors
    ///
    /// TypeError when there are any.
    pub fn finish(&mut self, vm: &VirtualMachine) -> PyResult<()> {
        if let Some((name, _)) = self.keywords.first() {
            return Err(vm.new_type_error(format!(
                "{}() got an unexpected keyword argument '{name}'",
                self.function
            )));
        }
        if self.positional.len() > 0 {
            return Err(vm.new_type_error(format!("{}() got too many arguments", self.function)));
        }
        Ok(())
    }
}
