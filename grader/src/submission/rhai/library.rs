//! Registration of built-ins; each gets the meter, and its arguments by reference.

use std::any::TypeId;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use rhai::{Dynamic, FuncRegistration, Module, NativeCallContext, RhaiFunc};

use super::budget::Meter;
use super::mistake::{Problem, raise};
use super::weight::parts;

/// A built-in's arguments; the first may be a variable of the script.
pub(super) type Arguments<'a, 'b> = &'a mut [&'b mut Dynamic];

/// The built-ins of one engine.
pub(super) struct Library {
    module: Module,
    meter: Rc<Meter>,
    names: BTreeMap<String, BTreeSet<usize>>,
}

impl Library {
    pub(super) fn new(meter: Rc<Meter>) -> Self {
        Self {
            module: Module::new(),
            meter,
            names: BTreeMap::new(),
        }
    }

    /// Adds a function of any arguments.
    pub(super) fn function<F>(&mut self, name: &str, parameters: usize, function: F)
    where
        F: Fn(&Meter, Arguments<'_, '_>) -> Result<Dynamic, Problem> + 'static,
    {
        self.names
            .entry(name.to_owned())
            .or_default()
            .insert(parameters);
        self.internal(name, &vec![TypeId::of::<Dynamic>(); parameters], function);
    }

    /// Adds a function again for the arguments it is mostly called with, which the engine then finds at once.
    ///
    /// Without it the engine tries every combination of "this type" and "any type" first.
    pub(super) fn shortcut<F>(&mut self, name: &str, types: &[TypeId], function: F)
    where
        F: Fn(&Meter, Arguments<'_, '_>) -> Result<Dynamic, Problem> + 'static,
    {
        self.internal(name, types, function);
    }

    /// Adds an operator or accessor, which students do not call by name.
    pub(super) fn internal<F>(&mut self, name: &str, types: &[TypeId], function: F)
    where
        F: Fn(&Meter, Arguments<'_, '_>) -> Result<Dynamic, Problem> + 'static,
    {
        let meter = Rc::clone(&self.meter);
        let call = move |context: Option<NativeCallContext<'_>>, arguments: &mut [&mut Dynamic]| {
            let position = context.map_or(rhai::Position::NONE, |context| context.call_position());
            meter.at(position);
            // the engine looks through the first argument afterwards, which may have been changed
            let looked_through = arguments.first().map_or(0, |first| parts(first));
            meter
                .glance(looked_through)
                .and_then(|()| function(&meter, arguments))
                .map_err(|problem| raise(problem, position))
        };
        FuncRegistration::new(name)
            .in_global_namespace()
            .set_into_module_raw(
                &mut self.module,
                types,
                // a method, because the first argument is then lent and not copied; pure, because reading a constant is fine
                RhaiFunc::Method {
                    func: Rc::new(call),
                    has_context: true,
                    is_pure: true,
                    is_volatile: true,
                },
            );
    }

    pub(super) fn module_mut(&mut self) -> &mut Module {
        &mut self.module
    }

    /// The finished module and the functions in it with their numbers of parameters.
    pub(super) fn finish(self) -> (Module, BTreeMap<String, BTreeSet<usize>>) {
        (self.module, self.names)
    }
}
