//! Translates functions of the runtime before a submission calls them, for a thread that has nothing else to do.

use wasmi::{Error, ExternType, Linker, Memory, MemoryType, Ref, Store, TrapCode, Val};

use super::instance::OWN;
use super::runtime::{engine, first};

/// The export that says from which place of the table on there are the functions that every submission calls.
const SOON: &str = "km_soon";

/// Makes ready what every submission in Python needs, and says how many functions those are. The interpreter translates a function once in a
/// process, when it is called first, and in whatever store; nobody pays for that, so that a submission uses as many instructions as without it.
///
/// # Errors
/// Why it cannot be done: the build is wrong.
pub fn translate_ahead() -> Result<usize, String> {
    let module = first()?;
    let wrong = |error: Error| format!("the runtime of Python: {error}");
    let mut store = Store::new(engine(), ());
    store.set_fuel(u64::MAX).map_err(wrong)?;
    let mut linker: Linker<()> = Linker::new(engine());
    let memory = Memory::new(&mut store, MemoryType::new(0, None)).map_err(wrong)?;
    let mut defined = linker.define(OWN, "memory", memory).map(|_| ());
    for import in module.imports() {
        if let ExternType::Func(of) = import.ty() {
            let never =
                |_: wasmi::Caller<'_, ()>, _: &[Val], _: &mut [Val]| Err(Error::new("called"));
            let more = linker.func_new(import.module(), import.name(), of.clone(), never);
            defined = defined.and(more.map(|_| ()));
        }
    }
    defined.map_err(|error| format!("the runtime of Python: {error}"))?;
    let instance = linker
        .instantiate_and_start(&mut store, module)
        .map_err(wrong)?;
    let begin = instance.get_global(&store, SOON);
    let begin = begin.and_then(|begin| begin.get(&store).i32());
    let (Some(begin), Some(table)) = (begin, instance.get_table(&store, "table")) else {
        return Err("the runtime of Python lacks an export".to_owned());
    };
    // no function runs: that there is no fuel for it is seen when it has been translated
    store.set_fuel(0).map_err(wrong)?;
    let mut count = 0;
    let soon = u64::from(begin.unsigned_abs())..table.size(&store);
    // the submission begins with the first: from both ends, neither thread waits for what the other is at
    for place in soon.rev() {
        let Some(Ref::Func(function)) = table.get(&store, place) else {
            return Err("the table of the runtime of Python is not full".to_owned());
        };
        let Some(function) = function.val().copied() else {
            return Err("the table of the runtime of Python is not full".to_owned());
        };
        let of = function.ty(&store);
        let zero = |of: &[wasmi::ValType]| -> Vec<Val> {
            of.iter().map(|of| Val::default_for_ty(*of)).collect()
        };
        let called = function.call(&mut store, &zero(of.params()), &mut zero(of.results()));
        match called.map_err(|error| error.as_trap_code()) {
            Err(Some(TrapCode::OutOfFuel)) => count += 1,
            _ => return Err("a function of the runtime of Python runs without fuel".to_owned()),
        }
    }
    Ok(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_every_submission_calls_can_be_translated_ahead() {
        let count = translate_ahead().expect("translated");
        assert!(count > 500, "{count}");
        // once more, when all of it is there
        assert_eq!(translate_ahead(), Ok(count));
    }
}
