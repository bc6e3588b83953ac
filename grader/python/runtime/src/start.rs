//! The interpreter as every submission finds it: modules that can be imported, `print` and `plot`, and no others.

use kinemark_python_numpy as numpy;
use rustpython_vm::builtins::{PyBaseExceptionRef, PyDictRef, PyStr, PyTypeRef};
use rustpython_vm::function::{ArgIterable, FuncArgs, KwArgs, PosArgs};
use rustpython_vm::{
    AsObject, FromArgs, Interpreter, Py, PyObject, PyObjectRef, PyResult, Settings, VirtualMachine,
};

use crate::convert::{Numbers, array, numbers};
use crate::host;
use crate::observation::Observation;

/// The classes of what submissions are given.
pub(crate) struct Names {
    pub(crate) robot: PyTypeRef,
    pub(crate) sensors: PyTypeRef,
    pub(crate) target: PyTypeRef,
    pub(crate) given: PyTypeRef,
    /// Says that a record has no such field: a function of its kind, its fields and the name.
    pub(crate) no_field: PyObjectRef,
}

/// What submissions find besides Python's own, in one namespace: each part uses those before it, and the last one starts.
const PRELUDE: [&str; 7] = [
    include_str!("prelude/records.py"),
    include_str!("prelude/annotations.py"),
    include_str!("prelude/containers.py"),
    include_str!("prelude/dataclass.py"),
    include_str!("prelude/enumeration.py"),
    include_str!("prelude/functions.py"),
    include_str!("prelude/imports.py"),
];

/// How deep Python functions may call each other.
const DEEPEST: usize = 200;

/// An interpreter that is ready for a submission.
pub(crate) fn started() -> (Interpreter, Names) {
    let mut settings = Settings::default();
    settings.hash_seed = Some(0);
    settings.install_signal_handlers = false;
    settings.import_site = false;
    settings.user_site_directory = false;
    settings.ignore_environment = true;
    settings.isolated = true;
    settings.write_bytecode = false;
    let interpreter = Interpreter::without_stdlib(settings);
    let names = interpreter.enter(|vm| match prelude(vm) {
        Ok(names) => names,
        Err(error) => panic!("the prelude: {}", words(vm, &error)),
    });
    (interpreter, names)
}

fn words(vm: &VirtualMachine, error: &PyBaseExceptionRef) -> String {
    let mut text = String::new();
    let _ = vm.write_exception(&mut text, error);
    text
}

fn prelude(vm: &VirtualMachine) -> PyResult<Names> {
    numpy::install(vm)?;
    vm.recursion_limit.set(DEEPEST);
    forbid_bytecode(vm)?;
    let builtins = vm.builtins.as_object();
    builtins.set_attr("print", vm.new_function("print", print), vm)?;
    let plot = vm.new_function("plot", plot);
    builtins.set_attr("plot", plot.clone(), vm)?;

    let scope = vm.new_scope_with_builtins();
    for part in PRELUDE {
        vm.run_string(scope.clone(), part, "kinemark")?;
    }
    let own = vm.new_module("kinemark", vm.ctx.new_dict(), None);
    own.as_object().set_attr("plot", plot, vm)?;
    own.as_object()
        .set_attr("Observation", Observation::make_type(), vm)?;
    let near = vm.new_function("_nearest", nearest_name);
    scope.globals.set_item("_nearest", near.into(), vm)?;
    for (name, of) in [
        ("quintic", quintic as fn(f64) -> f64),
        ("quintic_rate", quintic_rate),
    ] {
        let call = move |value: PyObjectRef, vm: &VirtualMachine| of_each(name, of, &value, vm);
        own.as_object()
            .set_attr(name, vm.new_function(name, call), vm)?;
    }
    let native = vm.ctx.new_dict();
    native.set_item("kinemark", own.into(), vm)?;
    let modules: PyDictRef = vm
        .sys_module
        .get_attr("modules", vm)?
        .downcast()
        .map_err(|_| vm.new_type_error("sys.modules is no dict"))?;
    for name in [
        "math",
        "numpy",
        "numpy.linalg",
        "numpy.typing",
        "numpy.exceptions",
    ] {
        native.set_item(name, modules.get_item(name, vm)?, vm)?;
    }
    scope.globals.get_item("_start", vm)?.call((native,), vm)?;
    let class = |name: &str| -> PyResult<PyTypeRef> {
        let class = scope.globals.get_item(name, vm)?;
        let class: PyTypeRef = class
            .downcast()
            .map_err(|_| vm.new_type_error("a class of the prelude is none"))?;
        class.slots.getattro.store(Some(field_first));
        Ok(class)
    };
    Ok(Names {
        robot: class("Robot")?,
        sensors: class("Sensors")?,
        target: class("Target")?,
        given: class("Given")?,
        no_field: scope.globals.get_item("_no_field", vm)?,
    })
}

/// No function can be made of instructions that the compiler did not write: the interpreter trusts them.
fn forbid_bytecode(vm: &VirtualMachine) -> PyResult<()> {
    let refused = |name: &'static str| {
        vm.new_function(name, |_: FuncArgs, vm: &VirtualMachine| -> PyResult {
            Err(vm.new_type_error("code objects are not made or changed here"))
        })
    };
    let code = vm.ctx.types.code_type;
    code.slots().new.store(Some(|_, _, vm| {
        Err(vm.new_type_error("code objects are not made or changed here"))
    }));
    for name in ["replace", "__replace__", "__new__"] {
        code.set_attr(vm.ctx.intern_str(name), refused(name).into());
    }
    let function = vm.ctx.types.function_type;
    let name = vm.ctx.intern_str("__code__");
    if let Some(original) = function.get_attr(name) {
        // reads it as before, and has nothing that writes it
        let read = original.get_attr("__get__", vm)?;
        let readable = vm.ctx.types.property_type.as_object().call((read,), vm)?;
        function.set_attr(name, readable);
    }
    Ok(())
}

/// The one of the names that a name was meant to be, or None.
fn nearest_name(
    name: PyObjectRef,
    names: ArgIterable<PyObjectRef>,
    vm: &VirtualMachine,
) -> PyResult<Option<String>> {
    let Some(name) = name.downcast_ref::<PyStr>() else {
        return Ok(None);
    };
    let mut known = Vec::new();
    for one in names.iter(vm)? {
        if let Some(one) = one?.downcast_ref::<PyStr>() {
            known.push(one.to_string());
        }
    }
    Ok(numpy::absent::meant(&name.to_string(), &known).map(str::to_owned))
}

/// An attribute of a record: a field of it in most cases, which are looked up first.
fn field_first(record: &PyObject, name: &Py<PyStr>, vm: &VirtualMachine) -> PyResult {
    if let Some(fields) = record.dict()
        && let Some(field) = fields.get_item_opt(name, vm)?
    {
        return Ok(field);
    }
    match record.generic_getattr_opt(name, None, vm)? {
        Some(value) => Ok(value),
        None => vm.call_method(record, "__getattr__", (name.to_owned(),)),
    }
}

/// From 0 to 1 while `s` does, at rest at both ends, and still beyond them.
fn quintic(s: f64) -> f64 {
    let s = s.clamp(0.0, 1.0);
    s * s * s * (10.0 + s * (-15.0 + 6.0 * s))
}

/// The derivative of [`quintic`].
fn quintic_rate(s: f64) -> f64 {
    let s = s.clamp(0.0, 1.0);
    30.0 * s * s * (1.0 - s) * (1.0 - s)
}

/// A function of a number, or of each number of an array or list.
fn of_each(name: &str, of: fn(f64) -> f64, value: &PyObject, vm: &VirtualMachine) -> PyResult {
    match numbers(value, vm) {
        Some(Numbers::One(number)) => Ok(vm.ctx.new_float(of(number)).into()),
        Some(Numbers::Several(numbers)) => {
            let shape = value
                .downcast_ref::<numpy::NdArray>()
                .map(|array| array.shape());
            let rows = match shape.as_deref() {
                Some([rows, _]) => Some(*rows as u32),
                _ => None,
            };
            Ok(array(rows, numbers.into_iter().map(of).collect(), vm))
        }
        None => {
            let kind = value.class().name().to_string();
            let message = format!("{name}() takes a number, or an array of numbers, not {kind}");
            Err(vm.new_type_error(message))
        }
    }
}

/// `print(*values, sep=" ", end="\n")`: each line goes to the log; a last line without its end waits for the next call.
fn print(args: FuncArgs, vm: &VirtualMachine) -> PyResult<()> {
    let (values, named): (PosArgs, KwArgs) = args.bind(vm)?;
    let mut between = " ".to_owned();
    let mut end = "\n".to_owned();
    for (name, value) in named {
        let place = match name.to_string().as_str() {
            "sep" => &mut between,
            "end" => &mut end,
            "file" | "flush" => continue,
            other => {
                let message = format!("print() got an unexpected keyword argument '{other}'");
                return Err(vm.new_type_error(message));
            }
        };
        if !vm.is_none(&value) {
            *place = value.str(vm)?.to_string();
        }
    }
    let mut text = String::new();
    for (i, value) in values.into_vec().into_iter().enumerate() {
        if i > 0 {
            text.push_str(&between);
        }
        text.push_str(&value.str(vm)?.to_string());
    }
    text.push_str(&end);
    printed(&text);
    Ok(())
}

thread_local! {
    static LINE: std::cell::RefCell<String> = const { std::cell::RefCell::new(String::new()) };
}

fn printed(text: &str) {
    let printed_in = crate::raised::current_line();
    LINE.with(|line| {
        let mut line = line.borrow_mut();
        let mut parts = text.split('\n');
        line.push_str(parts.next().unwrap_or_default());
        for part in parts {
            host::log(&line, printed_in);
            line.clear();
            line.push_str(part);
        }
    });
}

/// Writes a line that has no end yet.
pub(crate) fn end_line() {
    LINE.with(|line| {
        let mut line = line.borrow_mut();
        if !line.is_empty() {
            host::log(&line, 0);
            line.clear();
        }
    });
}

/// The arguments of `plot`.
#[derive(FromArgs)]
struct Plotted {
    #[pyarg(any)]
    name: PyObjectRef,
    #[pyarg(any)]
    value: PyObjectRef,
}

/// `plot(name, value)`: a number, or numbers, each of which is a signal of its own.
fn plot(Plotted { name, value }: Plotted, vm: &VirtualMachine) -> PyResult<()> {
    let name = name.str(vm)?.to_string();
    let count = name.chars().count();
    if count == 0 || count > 64 {
        return Err(vm.new_value_error("the name of a signal has 1 to 64 characters"));
    }
    let Some(numbers) = numbers(&value, vm) else {
        let kind = value.class().name().to_string();
        let message = format!("plot() takes a number, or a vector of numbers, not {kind}");
        return Err(vm.new_type_error(message));
    };
    match numbers {
        Numbers::One(number) => host::plot(&name, number),
        Numbers::Several(numbers) => {
            for (i, number) in numbers.iter().enumerate() {
                host::plot(&format!("{name}[{i}]"), *number);
            }
        }
    }
    Ok(())
}
