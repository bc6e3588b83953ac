//! The interpreter as every submission finds it: modules that can be imported, `print` and `plot`, and no others.

use kinemark_python_numpy as numpy;
use rustpython_vm::builtins::{PyBaseExceptionRef, PyDictRef, PyTypeRef};
use rustpython_vm::function::{FuncArgs, KwArgs, PosArgs};
use rustpython_vm::{AsObject, Interpreter, PyObjectRef, PyResult, Settings, VirtualMachine};

use crate::host;

/// The classes of what submissions are given.
pub(crate) struct Names {
    pub(crate) observation: PyTypeRef,
    pub(crate) robot: PyTypeRef,
    pub(crate) sensors: PyTypeRef,
    pub(crate) target: PyTypeRef,
    pub(crate) given: PyTypeRef,
}

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
    let builtins = vm.builtins.as_object();
    builtins.set_attr("print", vm.new_function("print", print), vm)?;
    let plot = vm.new_function("plot", plot);
    builtins.set_attr("plot", plot.clone(), vm)?;

    let scope = vm.new_scope_with_builtins();
    vm.run_string(scope.clone(), include_str!("prelude.py"), "kinemark")?;
    let own = vm.new_module("kinemark", vm.ctx.new_dict(), None);
    own.as_object().set_attr("plot", plot, vm)?;
    let native = vm.ctx.new_dict();
    native.set_item("kinemark", own.into(), vm)?;
    let modules: PyDictRef = vm
        .sys_module
        .get_attr("modules", vm)?
        .downcast()
        .map_err(|_| vm.new_type_error("sys.modules is no dict"))?;
    for name in ["math", "numpy", "numpy.linalg"] {
        native.set_item(name, modules.get_item(name, vm)?, vm)?;
    }
    scope.globals.get_item("_start", vm)?.call((native,), vm)?;
    let class = |name: &str| -> PyResult<PyTypeRef> {
        let class = scope.globals.get_item(name, vm)?;
        class
            .downcast()
            .map_err(|_| vm.new_type_error("a class of the prelude is none"))
    };
    Ok(Names {
        observation: class("Observation")?,
        robot: class("Robot")?,
        sensors: class("Sensors")?,
        target: class("Target")?,
        given: class("Given")?,
    })
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

/// `plot(name, value)`: a number, or numbers, each of which is a signal of its own.
fn plot(name: PyObjectRef, value: PyObjectRef, vm: &VirtualMachine) -> PyResult<()> {
    let name = name.str(vm)?.to_string();
    let count = name.chars().count();
    if count == 0 || count > 60 {
        return Err(vm.new_value_error("the name of a signal has 1 to 60 characters"));
    }
    let Some(numbers) = crate::convert::numbers(&value, vm) else {
        let kind = value.class().name().to_string();
        let message = format!("plot() takes a number, or a vector of numbers, not {kind}");
        return Err(vm.new_type_error(message));
    };
    match numbers {
        crate::convert::Numbers::One(number) => host::plot(&name, number),
        crate::convert::Numbers::Several(numbers) => {
            for (i, number) in numbers.iter().enumerate() {
                host::plot(&format!("{name}[{i}]"), *number);
            }
        }
    }
    Ok(())
}
