//! The language: what is in it and, by leaving it out, what is not.

use std::collections::BTreeMap;
use std::rc::Rc;

use rhai::{Dynamic, Engine, Position};

use super::budget::Meter;
use super::hints::Names;
use super::library::Library;
use super::mistake::raise;
use super::{arithmetic, linear, list, math, output};
use crate::controller::Budgets;

/// Constants that functions see, filled as the top level of the file runs.
pub(super) type Constants = Rc<std::cell::RefCell<BTreeMap<String, Dynamic>>>;

/// What can be reached by name although nothing registers it.
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

/// Builds an engine for one task, and the names of what is built in.
pub(super) fn build(
    budgets: &Budgets,
    meter: &Rc<Meter>,
    constants: &Constants,
) -> (Engine, Names) {
    let mut engine = Engine::new_raw();
    let mut library = Library::new(Rc::clone(meter));
    arithmetic::register(&mut library);
    math::register(&mut library);
    linear::register(&mut library);
    list::register(&mut library);
    output::register(&mut library);
    let (module, built_in) = library.finish();
    engine.register_global_module(module.into());

    for symbol in DISABLED {
        engine.disable_symbol(symbol);
    }
    // the optimiser would calculate `1 / 2` and `2.0 ** 0.5` by rules of its own
    engine.set_optimization_level(rhai::OptimizationLevel::None);
    // these rules of its own compare floats with a tolerance and take powers from the platform
    engine.set_fast_operators(false);
    engine.set_fail_on_invalid_map_property(true);
    engine.set_allow_anonymous_fn(false);
    set_limits(&mut engine, budgets, meter);
    set_callbacks(&mut engine, meter, constants);

    let mut names = Names {
        built_in,
        ..Names::default()
    };
    for (name, value) in math::CONSTANTS {
        names.constants.insert((*name).to_owned());
        constants
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
    engine.on_progress(move |counted| (!meter.count(counted)).then_some(Dynamic::UNIT));
}

#[expect(
    deprecated,
    reason = "`on_var` is the only way to constants inside functions; the engine's version is pinned by the lock file"
)]
fn set_callbacks(engine: &mut Engine, meter: &Rc<Meter>, constants: &Constants) {
    let constants = Rc::clone(constants);
    engine.on_var(move |name, offset, _| {
        // an offset is that of a local variable, which the engine finds itself
        if offset > 0 {
            return Ok(None);
        }
        Ok(constants.borrow().get(name).cloned())
    });
    let meter = Rc::clone(meter);
    engine.on_invalid_array_index(move |list, index, _| {
        meter.at(Position::NONE);
        Err(raise(linear::list_index_fault(list, index), Position::NONE))
    });
}
