//! A submission that is loaded, and its calls.

use kinemark_python_wire::{Call, Function, Load, Place, Reads, Reply};
use rustpython_vm::builtins::{PyCode, PyDictRef, PyFunction, PyStr};
use rustpython_vm::compiler::Mode;
use rustpython_vm::{AsObject, PyObjectRef, PyRef, PyResult, VirtualMachine};

use crate::convert::{array, from_value, joints, record, robot, to_value};
use crate::host;
use crate::raised::{raised, set_file};
use crate::start::{Names, end_line};

/// A submission after its module ran.
pub(crate) struct Loaded {
    globals: PyDictRef,
    robot: PyObjectRef,
    task: PyObjectRef,
    target: PyObjectRef,
    sensors: Vec<(String, Reads)>,
    joints: usize,
    most_values: u32,
}

/// Runs the file's statements, which define its functions.
pub(crate) fn load(vm: &VirtualMachine, names: &Names, load: Load) -> (Reply, Option<Loaded>) {
    host::set_text_size(load.text_size);
    set_file(&load.file);
    match loaded(vm, names, load) {
        Ok((reply, loaded)) => (reply, Some(loaded)),
        Err(error) => (raised(&error, vm), None),
    }
}

fn loaded(vm: &VirtualMachine, names: &Names, load: Load) -> PyResult<(Reply, Loaded)> {
    let source = load.source.as_str();
    let code = vm
        .compile(source, Mode::Exec, load.file)
        .map_err(|error| error.into_pyexception(vm, Some(source)))?;
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
    let joints = joints(&load.robot);
    let loaded = Loaded {
        globals,
        task: vm.ctx.new_str(load.task).into(),
        target: from_value(&load.target, &names.target, vm)?,
        joints,
        robot,
        sensors: load.sensors,
        most_values: load.most_values,
    };
    Ok((Reply::Loaded(functions), loaded))
}

/// What can be called, and how; other values have no parameters that can be seen.
fn function(name: String, value: &PyObjectRef, vm: &VirtualMachine) -> Option<Function> {
    if !value.is_callable() || name.starts_with("__") {
        return None;
    }
    let Some(defined) = value.downcast_ref::<PyFunction>() else {
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
    let most = code.code.arg_count;
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
                init.call((self.robot.clone(), self.task.clone()), vm)
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
                let observation = self.observation(vm, names, tick, [time_s, dt_s], &numbers)?;
                control.call((observation,), vm).map(Some)
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

    fn observation(
        &self,
        vm: &VirtualMachine,
        names: &Names,
        tick: u64,
        [time_s, dt_s]: [f64; 2],
        numbers: &[f64],
    ) -> PyResult {
        let mut rest = numbers;
        let mut take = |count: usize| {
            let (taken, left) = rest.split_at(count.min(rest.len()));
            rest = left;
            taken.to_vec()
        };
        let n = self.joints;
        let fields = vm.ctx.new_dict();
        // an interned name has its hash already
        let set = |name: &'static str, value: PyObjectRef| {
            fields.set_item(vm.ctx.intern_str(name), value, vm)
        };
        set("task", self.task.clone())?;
        set("tick", vm.ctx.new_int(tick).into())?;
        set("time", vm.ctx.new_float(time_s).into())?;
        set("dt", vm.ctx.new_float(dt_s).into())?;
        for name in ["q", "qd", "effort"] {
            set(name, array(None, take(n), vm))?;
        }
        set("tcp", array(None, take(3), vm))?;
        set("tcp_rotation", array(Some(3), take(9), vm))?;
        set("target", self.target.clone())?;
        let sensors = vm.ctx.new_dict();
        for (name, reads) in &self.sensors {
            let value = match reads {
                Reads::Truth => vm
                    .ctx
                    .new_bool(take(1).first().is_some_and(|x| *x != 0.0))
                    .into(),
                Reads::Number => {
                    let number = take(1).first().copied().unwrap_or(f64::NAN);
                    vm.ctx.new_float(number).into()
                }
                Reads::Vector(count) => array(None, take(*count as usize), vm),
            };
            sensors.set_item(name.as_str(), value, vm)?;
        }
        set("sensors", record(&names.sensors, sensors))?;
        Ok(record(&names.observation, fields))
    }
}
