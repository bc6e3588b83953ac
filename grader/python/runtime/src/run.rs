//! A submission that is loaded, and its calls.

use std::rc::Rc;

use kinemark_python_wire::{Call, Function, Load, Place, Reply};
use rustpython_vm::builtins::{PyCode, PyDictRef, PyFunction, PyStr};
use rustpython_vm::compiler::Mode;
use rustpython_vm::{AsObject, PyObject, PyObjectRef, PyPayload, PyRef, PyResult, VirtualMachine};

use crate::convert::{Given, from_value, joints, robot, to_value};
use crate::host;
use crate::observation::{Moment, Observation, Setting};
use crate::raised::{not_compiled, raised, set_file};
use crate::start::{Names, end_line};

/// A submission after its module ran.
pub(crate) struct Loaded {
    globals: PyDictRef,
    robot: PyObjectRef,
    setting: Rc<Setting>,
    most_values: u32,
}

/// Runs the file's statements, which define its functions.
pub(crate) fn load(vm: &VirtualMachine, names: &Names, load: Load) -> (Reply, Option<Loaded>) {
    host::set_text_size(load.text_size);
    set_file(&load.file);
    // editors of Windows begin a file with a mark of its encoding
    let source = load.source.trim_start_matches('\u{feff}');
    let code = match vm.compile(source, Mode::Exec, load.file.clone()) {
        Ok(code) => code,
        Err(error) => {
            let error = error.into_pyexception(vm, Some(source));
            return (not_compiled(&error, vm), None);
        }
    };
    match loaded(vm, names, load, code) {
        Ok((reply, loaded)) => (reply, Some(loaded)),
        Err(error) => (raised(&error, vm), None),
    }
}

fn loaded(
    vm: &VirtualMachine,
    names: &Names,
    load: Load,
    code: PyRef<PyCode>,
) -> PyResult<(Reply, Loaded)> {
    let scope = vm.new_scope_with_builtins();
    let globals = scope.globals.clone();
    globals.set_item("__name__", vm.ctx.new_str("submission").into(), vm)?;
    vm.run_code_obj(code, scope)?;
    end_line();
    let functions = globals
        .clone()
        .into_iter()
        .filter_map(|(name, value)| {
            let name = name.downcast_ref::<PyStr>()?.to_string();
            function(name, &value, vm)
        })
        .collect();
    let robot = robot(&load.robot, names, vm)?;
    let setting = Setting {
        task: vm.ctx.new_str(load.task).into(),
        target: Given::of(load.target, names.target.clone(), vm)?,
        joints: joints(&load.robot),
        sensors: load.sensors,
        sensors_class: names.sensors.clone(),
        no_field: names.no_field.clone(),
    };
    let loaded = Loaded {
        globals,
        robot,
        setting: Rc::new(setting),
        most_values: load.most_values,
    };
    Ok((Reply::Loaded(functions), loaded))
}

/// What can be called, and how; other values have no parameters that can be seen.
fn function(name: String, value: &PyObjectRef, vm: &VirtualMachine) -> Option<Function> {
    if !value.is_callable() || name.starts_with("__") {
        return None;
    }
    // of a method, and of an object that can be called, the first parameter is given
    let attribute = |of: &PyObject, name: &'static str| of.get_attr(name, vm).ok();
    let mut given = 0;
    let mut defined = value.clone();
    for name in ["__call__", "__func__"] {
        if defined.downcast_ref::<PyFunction>().is_none()
            && let Some(inner) = attribute(&defined, name)
            && (name == "__func__" || attribute(&inner, "__func__").is_some())
        {
            given = 1;
            defined = inner;
        }
    }
    let Some(defined) = defined.downcast_ref::<PyFunction>() else {
        let parameters = (0, None);
        let place = None;
        return Some(Function {
            name,
            parameters,
            place,
        });
    };
    let code: PyRef<PyCode> = defined
        .as_object()
        .get_attr("__code__", vm)
        .ok()?
        .downcast()
        .ok()?;
    let defaults = defined.as_object().get_attr("__defaults__", vm).ok()?;
    let defaults = defaults.length(vm).unwrap_or(0) as u32;
    let most = code.code.arg_count.saturating_sub(given);
    let takes_any = code
        .code
        .flags
        .contains(rustpython_compiler_core::bytecode::CodeFlags::VARARGS);
    let place = code.code.first_line_number.map(|line| Place {
        line: line.get() as u32,
        column: 1,
    });
    Some(Function {
        name,
        parameters: (most.saturating_sub(defaults), (!takes_any).then_some(most)),
        place,
    })
}

impl Loaded {
    /// Calls a function.
    pub(crate) fn call(&mut self, vm: &VirtualMachine, names: &Names, call: Call) -> Reply {
        let most = self.most_values;
        let result = match self.called(vm, names, call) {
            Ok(Some(value)) => match to_value(&value, most, vm) {
                Some(value) => Reply::Returned(value),
                None => Reply::TooMany,
            },
            Ok(None) => Reply::Missing,
            Err(error) => raised(&error, vm),
        };
        end_line();
        result
    }

    fn called(
        &mut self,
        vm: &VirtualMachine,
        names: &Names,
        call: Call,
    ) -> PyResult<Option<PyObjectRef>> {
        let function = |name: &str| self.globals.get_item_opt(name, vm);
        match call {
            Call::Init => {
                let Some(init) = function("init")? else {
                    return Ok(None);
                };
                init.call((self.robot.clone(), self.setting.task.clone()), vm)
                    .map(Some)
            }
            Call::Control {
                tick,
                time_s,
                dt_s,
                numbers,
            } => {
                let Some(control) = function("control")? else {
                    return Ok(None);
                };
                let moment = Moment {
                    tick,
                    time_s,
                    dt_s,
                    numbers,
                };
                let observation = Observation::new(Rc::clone(&self.setting), moment);
                control.call((observation.into_ref(&vm.ctx),), vm).map(Some)
            }
            Call::Function {
                name,
                robot: facts,
                arguments,
            } => {
                let Some(function) = function(&name)? else {
                    return Ok(None);
                };
                let mut given: Vec<PyObjectRef> = Vec::new();
                if let Some(facts) = facts {
                    given.push(robot(&facts, names, vm)?);
                }
                for argument in &arguments {
                    given.push(from_value(argument, &names.given, vm)?);
                }
                function.call(given, vm).map(Some)
            }
        }
    }
}
