//! The language: an engine with exactly the features that it has.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use rhai::{Dynamic, Engine, Position};

use super::budget::Meter;
use super::granted;
use super::hints::Names;
use super::library::Library;
use super::mistake::{Problem, raise};
use super::weight::charge_for_copy;
use super::{arithmetic, linear, list, math, output};
use crate::submission::controller::{Budgets, Grant};
use crate::submission::robot_model::Model;

/// Values of variables that no function declares.
#[derive(Default)]
pub(super) struct Globals {
    /// Constants, built-in and of the file, filled as its top level runs.
    pub(super) constants: RefCell<BTreeMap<String, Dynamic>>,
    /// Arguments of the next call, each moved out when it is read.
    pub(super) arguments: [Cell<Dynamic>; ARGUMENTS.len()],
    /// How many functions the file has.
    pub(super) functions: Cell<usize>,
}

/// A function is looked at for as long as so many variables.
const FUNCTION: usize = 8;

/// The variables through which a call reads its arguments; a script that uses one finds nothing in it.
pub(super) const ARGUMENTS: [&str; 4] = [
    "argument_0_of_the_call",
    "argument_1_of_the_call",
    "argument_2_of_the_call",
    "argument_3_of_the_call",
];

/// The variable that is `this` in a call: a map that is kept between calls.
pub(super) const MEMORY: &str = "memory";

/// Names that work although nothing registers them.
const DISABLED: [&str; 8] = [
    "eval",
    "Fn",
    "call",
    "curry",
    "is_def_var",
    "is_def_fn",
    "is_shared",
    "type_of",
];

/// Builds an engine for one task, with what that grants, and the names of what is built in.
pub(super) fn build(
    budgets: &Budgets,
    meter: &Rc<Meter>,
    globals: &Rc<Globals>,
    granted: Option<(&Rc<Model>, &[Grant])>,
) -> (Engine, Names) {
    let mut engine = Engine::new_raw();
    let mut library = Library::new(Rc::clone(meter));
    arithmetic::register(&mut library);
    math::register(&mut library);
    linear::register(&mut library);
    list::register(&mut library);
    output::register(&mut library);
    if let Some((model, grants)) = granted {
        granted::register(&mut library, model, grants);
    }
    let (module, built_in) = library.finish();
    engine.register_global_module(module.into());

    for symbol in DISABLED {
        engine.disable_symbol(symbol);
    }
    // the optimiser would compute `1 / 2` and `2.0 ** 0.5` by its own rules
    engine.set_optimization_level(rhai::OptimizationLevel::None);
    // its fast operators compare floats with a tolerance and use the platform's powers
    engine.set_fast_operators(false);
    engine.set_fail_on_invalid_map_property(true);
    engine.set_allow_anonymous_fn(false);
    set_limits(&mut engine, budgets, meter);
    set_callbacks(&mut engine, meter, globals);

    let mut names = Names {
        built_in,
        ..Names::default()
    };
    for (name, value) in math::CONSTANTS {
        names.constants.insert((*name).to_owned());
        globals
            .constants
            .borrow_mut()
            .insert((*name).to_owned(), (*value).into());
    }
    (engine, names)
}

fn set_limits(engine: &mut Engine, budgets: &Budgets, meter: &Rc<Meter>) {
    let size = |budget: u64| usize::try_from(budget).unwrap_or(usize::MAX);
    let depth = size(budgets.expression_depth);
    engine
        .set_max_call_levels(size(budgets.call_depth))
        .set_max_expr_depths(depth, depth)
        .set_max_array_size(size(budgets.list_size))
        .set_max_map_size(size(budgets.map_size))
        .set_max_string_size(size(budgets.text_size));
    let meter = Rc::clone(meter);
    engine.on_progress(move |counted| {
        // called for every operation: no value is made where the script goes on
        if meter.count(counted) {
            None
        } else {
            Some(Dynamic::UNIT)
        }
    });
}

#[expect(
    deprecated,
    reason = "`on_var` is the only way to constants inside functions; the engine's version is pinned by the lock file"
)]
fn set_callbacks(engine: &mut Engine, meter: &Rc<Meter>, globals: &Rc<Globals>) {
    let globals = Rc::clone(globals);
    let reader = Rc::clone(meter);
    engine.on_var(move |name, offset, context| {
        let charged = |charged: Result<(), Problem>| {
            charged.map_err(|problem| raise(problem, Position::NONE))
        };
        // a local variable lies so far from the end of the scope; the engine finds it itself
        if let Some(distance) = offset.checked_sub(1) {
            charged(reader.glance(distance / 2))?;
            if let Some((_, _, value)) = context.scope().iter_raw().nth(distance) {
                // charged as if it were copied, because the engine mostly does and never says when
                charged(charge_for_copy(&reader, value))?;
            }
            return Ok(None);
        }
        if let Some(argument) = ARGUMENTS.iter().position(|known| *known == name) {
            return Ok(Some(globals.arguments[argument].take()));
        }
        if name == MEMORY {
            return Ok(None);
        }
        match globals.constants.borrow().get(name) {
            Some(value) => {
                charged(charge_for_copy(&reader, value))?;
                Ok(Some(value.clone()))
            }
            None => {
                // the engine looks through all variables by their names, then through all functions
                let names = context.scope().len() + FUNCTION * globals.functions.get();
                charged(reader.glance(names))?;
                Ok(None)
            }
        }
    });
    let meter = Rc::clone(meter);
    engine.on_invalid_array_index(move |list, index, _| {
        meter.at(Position::NONE);
        Err(raise(linear::list_index_fault(list, index), Position::NONE))
    });
}
