//! Values between the grader and Python.

use kinemark_python_numpy::NdArray;
use kinemark_python_numpy::convert::sequence;
use kinemark_python_wire::{Robot, Value};
use rustpython_vm::builtins::{
    PyBaseObject, PyDict, PyDictRef, PyFloat, PyInt, PyStr, PyStrInterned, PyTypeRef,
};
use rustpython_vm::function::FuncArgs;
use rustpython_vm::{AsObject, PyObject, PyObjectRef, PyPayload, PyRef, PyResult, VirtualMachine};

use crate::host::Granted;
use crate::start::Names;

/// Lists inside each other that are taken apart: no answer that a check reads is as deep.
const DEEPEST: usize = 32;
/// Characters of a text in an answer: none of them counts for a check.
const LONGEST_TEXT: usize = 256;

/// A number, or several.
pub(crate) enum Numbers {
    /// One.
    One(f64),
    /// A list, tuple or array of numbers.
    Several(Vec<f64>),
}

/// The numbers that a value holds, if it holds nothing else.
pub(crate) fn numbers(value: &PyObject, vm: &VirtualMachine) -> Option<Numbers> {
    if let Some(number) = number(value, vm) {
        return Some(Numbers::One(number));
    }
    if let Some(array) = value.downcast_ref::<NdArray>() {
        return Some(Numbers::Several(array.to_f64()));
    }
    let elements = elements(value, vm)?;
    let all: Option<Vec<f64>> = elements.iter().map(|one| number(one, vm)).collect();
    all.map(Numbers::Several)
}

/// An int, a float or a truth value as a number.
pub(crate) fn number(value: &PyObject, vm: &VirtualMachine) -> Option<f64> {
    if let Some(float) = value.downcast_ref::<PyFloat>() {
        return Some(float.to_f64());
    }
    if value.downcast_ref::<PyInt>().is_some() {
        let float = value.try_float(vm).ok()?;
        return Some(float.to_f64());
    }
    None
}

/// The elements of a list, a tuple, or another sequence.
fn elements(value: &PyObject, vm: &VirtualMachine) -> Option<Vec<PyObjectRef>> {
    sequence(value, vm).ok().flatten()
}

/// A value of Python for the grader; none if it has more than `most` values.
pub(crate) fn to_value(value: &PyObject, most: u32, vm: &VirtualMachine) -> Option<Value> {
    let mut left = most as usize + 1;
    converted(value, &mut left, 0, vm)
}

fn converted(
    value: &PyObject,
    left: &mut usize,
    depth: usize,
    vm: &VirtualMachine,
) -> Option<Value> {
    let kind = || Value::Other(value.class().name().to_string());
    if depth > DEEPEST {
        return Some(kind());
    }
    *left = left.checked_sub(1)?;
    if vm.is_none(value) {
        return Some(Value::Nothing);
    }
    if value.class().is(vm.ctx.types.bool_type) {
        return Some(Value::Boolean(value.is(&vm.ctx.true_value)));
    }
    if let Some(number) = number(value, vm) {
        return Some(Value::Number(number));
    }
    if let Some(text) = value.downcast_ref::<PyStr>() {
        return Some(Value::Text(
            text.to_string().chars().take(LONGEST_TEXT).collect(),
        ));
    }
    if let Some(array) = value.downcast_ref::<NdArray>() {
        let shape = array.shape();
        *left = left.checked_sub(shape.iter().product())?;
        let rows = match shape[..] {
            [rows, _] => Some(rows as u32),
            _ => None,
        };
        let values = array.to_f64();
        if array.is_bool() {
            let columns = shape.last().copied().unwrap_or(1).max(1);
            let list = |row: &[f64]| row.iter().map(|x| Value::Boolean(*x != 0.0)).collect();
            return Some(Value::List(match rows {
                None => list(&values),
                Some(_) => values
                    .chunks(columns)
                    .map(|row| Value::List(list(row)))
                    .collect(),
            }));
        }
        return Some(Value::Numbers { rows, values });
    }
    if let Some(elements) = elements(value, vm) {
        let converted: Option<Vec<Value>> = elements
            .iter()
            .map(|one| converted(one, left, depth + 1, vm))
            .collect();
        return converted.map(Value::List);
    }
    if value.is_callable() {
        return Some(kind());
    }
    let fields: Option<PyDictRef> = match value.downcast_ref::<PyDict>() {
        Some(_) => value.to_owned().downcast().ok(),
        None => value.dict(),
    };
    let Some(fields) = fields else {
        return Some(kind());
    };
    let mut map = Vec::new();
    for (key, one) in fields {
        let Some(key) = key.downcast_ref::<PyStr>() else {
            return Some(kind());
        };
        map.push((key.to_string(), converted(&one, left, depth + 1, vm)?));
    }
    // as the maps of scripts are, so that the same answer has the same digest
    map.sort_by(|(a, _), (b, _)| a.cmp(b));
    Some(Value::Map(map))
}

/// A value of the grader for Python.
pub(crate) fn from_value(value: &Value, class: &PyTypeRef, vm: &VirtualMachine) -> PyResult {
    Ok(match value {
        Value::Nothing => vm.ctx.none(),
        Value::Boolean(boolean) => vm.ctx.new_bool(*boolean).into(),
        Value::Number(number) => vm.ctx.new_float(*number).into(),
        Value::Integer(whole) => vm.ctx.new_int(*whole).into(),
        Value::Text(text) | Value::Other(text) => vm.ctx.new_str(text.as_str()).into(),
        Value::List(values) => {
            let values: PyResult<Vec<PyObjectRef>> = values
                .iter()
                .map(|one| from_value(one, class, vm))
                .collect();
            vm.ctx.new_list(values?).into()
        }
        Value::Numbers { rows, values } => array(*rows, values.clone(), vm),
        Value::Map(fields) => {
            let dict = vm.ctx.new_dict();
            for (name, one) in fields {
                dict.set_item(name.as_str(), from_value(one, class, vm)?, vm)?;
            }
            record(class, dict)
        }
    })
}

/// A value of the grader that is given again and again, each time as if it were new.
#[derive(Debug)]
pub(crate) struct Given {
    value: Value,
    class: PyTypeRef,
    /// Of a map: its fields, to be copied. Adding each to a new dict would take ten times as many instructions.
    fields: Option<PyDictRef>,
    /// Those of them that a submission could change.
    changeable: Vec<(&'static PyStrInterned, Value)>,
}

impl Given {
    /// This value, whose maps are of this class.
    pub(crate) fn of(value: Value, class: PyTypeRef, vm: &VirtualMachine) -> PyResult<Self> {
        let mut changeable = Vec::new();
        let mut dict = None;
        if let Value::Map(fields) = &value {
            let made = vm.ctx.new_dict();
            for (name, one) in fields {
                let name = vm.ctx.intern_str(name.as_str());
                made.set_item(name, from_value(one, &class, vm)?, vm)?;
                if matches!(one, Value::List(_) | Value::Numbers { .. } | Value::Map(_)) {
                    changeable.push((name, one.clone()));
                }
            }
            dict = Some(made);
        }
        Ok(Self {
            value,
            class,
            fields: dict,
            changeable,
        })
    }

    /// A new object of it.
    pub(crate) fn made(&self, vm: &VirtualMachine) -> PyResult {
        let Some(fields) = &self.fields else {
            return from_value(&self.value, &self.class, vm);
        };
        let made = fields.copy().into_ref(&vm.ctx);
        for (name, one) in &self.changeable {
            made.set_item(*name, from_value(one, &self.class, vm)?, vm)?;
        }
        Ok(record(&self.class, made))
    }
}

/// A vector, or a matrix of so many rows.
pub(crate) fn array(rows: Option<u32>, values: Vec<f64>, vm: &VirtualMachine) -> PyObjectRef {
    let array = match rows {
        None => NdArray::from_vector(values),
        Some(rows) => {
            let rows = rows as usize;
            NdArray::from_matrix(rows, values.len() / rows.max(1), values)
        }
    };
    array.into_pyobject(vm)
}

/// An object of a class of the prelude, with these fields.
pub(crate) fn record(class: &PyTypeRef, fields: PyDictRef) -> PyObjectRef {
    PyRef::new_ref(PyBaseObject, class.clone(), Some(fields)).into()
}

/// How many joints a robot has that move.
pub(crate) fn joints(robot: &Robot) -> usize {
    let mut fields = robot.fields.iter();
    match fields.find(|(name, _)| name == "joints") {
        Some((_, Value::Integer(n))) => usize::try_from(*n).unwrap_or(0),
        _ => 0,
    }
}

/// The object `robot`.
pub(crate) fn robot(robot: &Robot, names: &Names, vm: &VirtualMachine) -> PyResult {
    let dict = vm.ctx.new_dict();
    for (name, value) in &robot.fields {
        dict.set_item(name.as_str(), from_value(value, &names.given, vm)?, vm)?;
    }
    let n = joints(robot);
    for granted in Granted::ALL {
        if !robot.granted.iter().any(|name| name == granted.name()) {
            continue;
        }
        let call = move |args: FuncArgs, vm: &VirtualMachine| called(granted, n, &args, vm);
        let function = vm.new_function(granted.name(), call);
        dict.set_item(granted.name(), function.into(), vm)?;
    }
    Ok(record(&names.robot, dict))
}

fn called(granted: Granted, n: usize, args: &FuncArgs, vm: &VirtualMachine) -> PyResult {
    let name = granted.name();
    let [q] = &args.args[..] else {
        let given = args.args.len();
        let message =
            format!("robot.{name}() takes 1 argument, the joint positions, but {given} were given");
        return Err(vm.new_type_error(message));
    };
    let q = match numbers(q, vm) {
        Some(Numbers::One(number)) => vec![number],
        Some(Numbers::Several(numbers)) => numbers,
        None => {
            let kind = q.class().name().to_string();
            let message = format!("robot.{name}() takes {n} joint positions, not {kind}");
            return Err(vm.new_type_error(message));
        }
    };
    if q.len() != n {
        let message = format!(
            "robot.{name}() takes {n} joint positions, one per joint, but {} were given",
            q.len()
        );
        return Err(vm.new_value_error(message));
    }
    let rows = granted.rows(n).map(|rows| rows as u32);
    Ok(array(rows, granted.at(&q), vm))
}
