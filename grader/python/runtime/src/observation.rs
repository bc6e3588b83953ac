//! What `control` is given. Its fields are made when they are read: most programs read few of them, and read them often.

use std::cell::RefCell;
use std::rc::Rc;

use kinemark_python_wire::Reads;
use rustpython_vm::builtins::{PyDictRef, PyStr, PyType, PyTypeRef};
use rustpython_vm::class::PyClassImpl as _;
use rustpython_vm::function::{OptionalArg, PySetterValue};
use rustpython_vm::protocol::{PyMappingMethods, PySequenceMethods};
use rustpython_vm::types::{AsMapping, AsSequence, GetAttr, Iterable, Representable, SetAttr};
use rustpython_vm::{
    AsObject as _, Py, PyObject, PyObjectRef, PyPayload, PyRef, PyResult, VirtualMachine,
    atomic_func, pyclass,
};

use crate::convert::{Given, array, record};

/// The fields, in the order in which they are listed.
const FIELDS: [&str; 11] = [
    "task",
    "tick",
    "time",
    "dt",
    "q",
    "qd",
    "effort",
    "tcp",
    "tcp_rotation",
    "target",
    "sensors",
];

/// What is the same in each call of a run.
#[derive(Debug)]
pub(crate) struct Setting {
    pub(crate) task: PyObjectRef,
    /// Made anew in each call: what a submission does to it is gone with the observation.
    pub(crate) target: Given,
    /// The sensors by name, in the order of their readings.
    pub(crate) sensors: Vec<(String, Reads)>,
    /// Joints that move.
    pub(crate) joints: usize,
    pub(crate) sensors_class: PyTypeRef,
    /// Says that a record has no such field: a function of its kind, its fields and the name.
    pub(crate) no_field: PyObjectRef,
}

/// What the simulator observed before a call.
#[derive(Debug, Clone)]
pub(crate) struct Moment {
    pub(crate) tick: u64,
    pub(crate) time_s: f64,
    pub(crate) dt_s: f64,
    /// q, qd, effort, tcp (3), rotation (9), sensors.
    pub(crate) numbers: Vec<f64>,
}

/// The object `observation`.
#[pyclass(module = "kinemark", name = "Observation")]
#[derive(Debug, PyPayload)]
pub(crate) struct Observation {
    setting: Rc<Setting>,
    moment: Moment,
    made: RefCell<[Option<PyObjectRef>; FIELDS.len()]>,
}

impl Observation {
    pub(crate) fn new(setting: Rc<Setting>, moment: Moment) -> Self {
        Self {
            setting,
            moment,
            made: RefCell::default(),
        }
    }

    pub(crate) fn make_type() -> PyRef<PyType> {
        Self::make_static_type()
    }

    /// The value of the field at this place, the same object each time.
    fn field(&self, place: usize, vm: &VirtualMachine) -> PyResult {
        if let Some(made) = &self.made.borrow()[place] {
            return Ok(made.clone());
        }
        let made = self.make(FIELDS[place], vm)?;
        self.made.borrow_mut()[place] = Some(made.clone());
        Ok(made)
    }

    fn make(&self, name: &str, vm: &VirtualMachine) -> PyResult {
        let Setting {
            task,
            target,
            joints,
            ..
        } = &*self.setting;
        let n = *joints;
        let vector = |from: usize, count| array(None, self.numbers(from, count), vm);
        Ok(match name {
            "task" => task.clone(),
            "tick" => vm.ctx.new_int(self.moment.tick).into(),
            "time" => vm.ctx.new_float(self.moment.time_s).into(),
            "dt" => vm.ctx.new_float(self.moment.dt_s).into(),
            "q" => vector(0, n),
            "qd" => vector(n, n),
            "effort" => vector(2 * n, n),
            "tcp" => vector(3 * n, 3),
            "tcp_rotation" => array(Some(3), self.numbers(3 * n + 3, 9), vm),
            "target" => target.made(vm)?,
            _ => self.sensors(3 * n + 12, vm)?,
        })
    }

    fn numbers(&self, from: usize, count: usize) -> Vec<f64> {
        let numbers = &self.moment.numbers;
        let from = from.min(numbers.len());
        numbers[from..numbers.len().min(from + count)].to_vec()
    }

    fn sensors(&self, mut from: usize, vm: &VirtualMachine) -> PyResult {
        let readings = vm.ctx.new_dict();
        for (name, reads) in &self.setting.sensors {
            let count = match reads {
                Reads::Truth | Reads::Number => 1,
                Reads::Vector(count) => *count as usize,
            };
            let numbers = self.numbers(from, count);
            from += count;
            let first = numbers.first().copied();
            let value = match reads {
                Reads::Truth => vm.ctx.new_bool(first.is_some_and(|x| x != 0.0)).into(),
                Reads::Number => vm.ctx.new_float(first.unwrap_or(f64::NAN)).into(),
                Reads::Vector(_) => array(None, numbers, vm),
            };
            readings.set_item(name.as_str(), value, vm)?;
        }
        Ok(record(&self.setting.sensors_class, readings))
    }

    /// All fields, as a dict of their own.
    fn fields(&self, vm: &VirtualMachine) -> PyResult<PyDictRef> {
        let fields = vm.ctx.new_dict();
        for (place, name) in FIELDS.iter().enumerate() {
            fields.set_item(*name, self.field(place, vm)?, vm)?;
        }
        Ok(fields)
    }

    fn place_of(name: &PyObject) -> Option<usize> {
        let name = name.downcast_ref::<PyStr>()?.to_str()?;
        FIELDS.iter().position(|known| *known == name)
    }

    fn has_not(zelf: &Py<Self>, name: &PyObject, vm: &VirtualMachine) -> PyResult<String> {
        let fields = vm
            .ctx
            .new_list(FIELDS.map(|name| vm.ctx.new_str(name).into()).to_vec());
        let kind = vm.ctx.new_str("observation");
        let words = zelf
            .setting
            .no_field
            .call((kind, fields, name.to_owned()), vm)?;
        Ok(words.str(vm)?.to_string())
    }

    fn item(zelf: &Py<Self>, key: &PyObject, vm: &VirtualMachine) -> PyResult {
        match Self::place_of(key) {
            Some(place) => zelf.field(place, vm),
            None => {
                let words = Self::has_not(zelf, key, vm)?;
                Err(vm.new_key_error(vm.ctx.new_str(words).into()))
            }
        }
    }

    /// Puts another value in place of a field.
    fn put(
        zelf: &Py<Self>,
        name: &PyObject,
        value: PyObjectRef,
        vm: &VirtualMachine,
    ) -> PyResult<()> {
        let Some(place) = Self::place_of(name) else {
            let name = name.repr(vm)?;
            let words = format!(
                "observation has no {name}, and keeps nothing: each call is given another one; keep it in a global or in an object of your own"
            );
            return Err(vm.new_attribute_error(words));
        };
        // its end can run code of the submission, which may read this observation
        let replaced = zelf.made.borrow_mut()[place].replace(value);
        drop(replaced);
        Ok(())
    }
}

#[pyclass(with(GetAttr, SetAttr, AsMapping, AsSequence, Iterable, Representable))]
impl Observation {
    #[pygetset]
    fn __dict__(zelf: &Py<Self>, vm: &VirtualMachine) -> PyResult<PyDictRef> {
        zelf.fields(vm)
    }

    #[pymethod]
    fn keys(zelf: &Py<Self>, vm: &VirtualMachine) -> PyResult {
        vm.call_method(zelf.fields(vm)?.as_object(), "keys", ())
    }

    #[pymethod]
    fn values(zelf: &Py<Self>, vm: &VirtualMachine) -> PyResult {
        vm.call_method(zelf.fields(vm)?.as_object(), "values", ())
    }

    #[pymethod]
    fn items(zelf: &Py<Self>, vm: &VirtualMachine) -> PyResult {
        vm.call_method(zelf.fields(vm)?.as_object(), "items", ())
    }

    #[pymethod]
    fn get(
        zelf: &Py<Self>,
        name: PyObjectRef,
        default: OptionalArg,
        vm: &VirtualMachine,
    ) -> PyResult {
        match Self::place_of(&name) {
            Some(place) => zelf.field(place, vm),
            None => Ok(default.unwrap_or_none(vm)),
        }
    }

    /// Another one of the same moment, whose arrays are its own.
    #[pymethod]
    fn copy(zelf: &Py<Self>) -> Self {
        Self::new(Rc::clone(&zelf.setting), zelf.moment.clone())
    }

    #[pymethod]
    fn __copy__(zelf: &Py<Self>) -> Self {
        Self::copy(zelf)
    }

    #[pymethod]
    fn __deepcopy__(zelf: &Py<Self>, _memo: PyObjectRef) -> Self {
        Self::copy(zelf)
    }
}

impl GetAttr for Observation {
    fn getattro(zelf: &Py<Self>, name: &Py<PyStr>, vm: &VirtualMachine) -> PyResult {
        if let Some(place) = Self::place_of(name.as_object()) {
            return zelf.field(place, vm);
        }
        if let Some(value) = zelf.as_object().generic_getattr_opt(name, None, vm)? {
            return Ok(value);
        }
        let error = vm.new_no_attribute_error(zelf.to_owned().into(), name.to_owned());
        let words = Self::has_not(zelf, name.as_object(), vm)?;
        error.as_object().set_attr(
            "args",
            vm.ctx.new_tuple(vec![vm.ctx.new_str(words).into()]),
            vm,
        )?;
        Err(error)
    }
}

impl SetAttr for Observation {
    fn setattro(
        zelf: &Py<Self>,
        name: &Py<PyStr>,
        value: PySetterValue,
        vm: &VirtualMachine,
    ) -> PyResult<()> {
        match value {
            PySetterValue::Assign(value) => Self::put(zelf, name.as_object(), value, vm),
            PySetterValue::Delete => {
                Err(vm.new_attribute_error("the fields of observation cannot be deleted"))
            }
        }
    }
}

impl AsMapping for Observation {
    fn as_mapping() -> &'static PyMappingMethods {
        static METHODS: PyMappingMethods = PyMappingMethods {
            length: atomic_func!(|_, _vm| Ok(FIELDS.len())),
            subscript: atomic_func!(|mapping, key, vm| Observation::item(
                Observation::mapping_downcast(mapping),
                key,
                vm
            )),
            ass_subscript: atomic_func!(|mapping, key, value, vm| match value {
                Some(value) =>
                    Observation::put(Observation::mapping_downcast(mapping), key, value, vm),
                None => Err(vm.new_type_error("the fields of observation cannot be deleted")),
            }),
        };
        &METHODS
    }
}

impl AsSequence for Observation {
    fn as_sequence() -> &'static PySequenceMethods {
        static METHODS: PySequenceMethods = PySequenceMethods {
            contains: atomic_func!(|_, name, _vm| Ok(Observation::place_of(name).is_some())),
            ..PySequenceMethods::NOT_IMPLEMENTED
        };
        &METHODS
    }
}

impl Iterable for Observation {
    fn iter(zelf: PyRef<Self>, vm: &VirtualMachine) -> PyResult {
        Ok(zelf.fields(vm)?.as_object().get_iter(vm)?.into())
    }
}

impl Representable for Observation {
    fn repr_str(zelf: &Py<Self>, vm: &VirtualMachine) -> PyResult<String> {
        let mut fields = Vec::new();
        for (place, name) in FIELDS.iter().enumerate() {
            fields.push(format!("{name}={}", zelf.field(place, vm)?.repr(vm)?));
        }
        Ok(format!("Observation({})", fields.join(", ")))
    }
}
