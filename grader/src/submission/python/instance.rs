//! One instance of the runtime: its memory, its requests, and where it was when it was stopped.

use kinemark_python_wire::{Call, Load, Reply, Stopped, from_bytes, to_bytes};
use wasmi::{Caller, Error, Linker, Memory, MemoryType, Store, StoreLimitsBuilder, TypedFunc};

use super::region::Region;
use super::runtime::{begin, engine, first, pages, rest};
use crate::submission::plugin::{State, linker, text};

/// Bytes of memory that a submission may have, with the interpreter's own.
pub(super) const MEMORY_BYTES: usize = 64 << 20;
/// Elements of the table of functions.
const TABLE_ELEMENTS: usize = 100_000;
/// Instructions for saying where it was.
const TO_SAY_WHERE: u64 = 10_000_000;

/// The module name of what only the runtime imports.
pub(super) const OWN: &str = "kinemark_python";

/// Adds a line to the log, with the line of the file that printed it; 0 if that is not known.
fn logged(mut caller: Caller<'_, State>, at: u32, bytes: u32, line: u32) -> Result<(), Error> {
    let printed = text(&mut caller, at, bytes)?;
    let line = (line > 0).then_some(line as usize);
    caller.data().output.borrow_mut().print(printed, line);
    Ok(())
}

/// Sees to it that the rest of the module is there. The submission pays nothing for it, whether it is the first that needs it or not.
fn bring_rest(mut caller: Caller<'_, State>) -> Result<(), Error> {
    if caller.data().has_rest {
        return Ok(());
    }
    let fuel = caller.get_fuel()?;
    let rest = rest().map_err(Error::new)?;
    let mut linker: Linker<State> = Linker::new(engine());
    for import in rest.imports() {
        let given = caller
            .get_export(import.name())
            .ok_or_else(|| Error::new(format!("{} is not exported", import.name())))?;
        linker
            .define(import.module(), import.name(), given)
            .map_err(|error| Error::new(error.to_string()))?;
    }
    caller.set_fuel(u64::MAX)?;
    linker.instantiate_and_start(&mut caller, rest)?;
    caller.set_fuel(fuel)?;
    caller.data_mut().has_rest = true;
    Ok(())
}

/// An instance.
pub(super) struct Instance {
    store: Store<State>,
    memory: Memory,
    room: TypedFunc<u32, u32>,
    load: TypedFunc<(), u32>,
    call: TypedFunc<(), u32>,
    reply: TypedFunc<(), u32>,
    stopped: TypedFunc<(), u32>,
    stack_pointer: wasmi::Global,
    /// The bytes of the memory; behind the store, which is dropped before them.
    region: Region,
}

impl Drop for Instance {
    fn drop(&mut self) {
        let size = self.memory.size(&self.store);
        self.region.is_kept = pages().is_ok_and(|pages| size == u64::from(pages));
    }
}

/// Why a request has no reply.
pub(super) enum Trouble {
    /// A trap, or an import that ended it.
    Ended(Error),
    /// What only a fault of the grader brings about.
    Fault(String),
}

impl From<Error> for Trouble {
    fn from(error: Error) -> Self {
        Self::Ended(error)
    }
}

impl Instance {
    /// A fresh instance, whose interpreter is started.
    pub(super) fn started(state: State) -> Result<Self, String> {
        Self::with(state, begin)
    }

    /// An instance whose memory is to become that of another.
    pub(super) fn empty(state: State) -> Result<Self, String> {
        Self::with(state, |_| Ok(()))
    }

    /// An instance whose memory is what `fill` makes of it.
    #[expect(
        unsafe_code,
        reason = "the interpreter asks for bytes that last for ever"
    )]
    fn with(
        mut state: State,
        fill: impl FnOnce(&mut [u8]) -> Result<(), String>,
    ) -> Result<Self, String> {
        let wrong = |error: Error| format!("the runtime of Python: {error}");
        let mut region = Region::new().map_err(|error| format!("memory for Python: {error}"))?;
        state.limits = StoreLimitsBuilder::new()
            .memory_size(MEMORY_BYTES)
            .table_elements(TABLE_ELEMENTS)
            // the rest of the module is an instance too, and memory and table that it imports count again
            .instances(2)
            .memories(3)
            .tables(2)
            .trap_on_grow_failure(true)
            .build();
        let mut store = Store::new(engine(), state);
        store.limiter(|state| &mut state.limits);
        // filling the memory is not the submission's doing
        store.set_fuel(u64::MAX).map_err(wrong)?;
        let mut linker: Linker<State> = linker(engine()).map_err(wrong)?;
        linker
            .func_wrap(OWN, "log", logged)
            .and_then(|linker| linker.func_wrap(OWN, "rest", bring_rest))
            .map_err(|error| format!("the runtime of Python: {error}"))?;
        // SAFETY: it is lent to the store, which does not outlive the region
        let bytes = unsafe { region.lend() };
        // without a bound of its own: where it may not grow, the limits end the call
        let of = MemoryType::new(pages()?, None);
        let memory = Memory::new_static(&mut store, of, bytes).map_err(wrong)?;
        // before the module is needed, which another thread may be about to make ready
        fill(memory.data_mut(&mut store))?;
        linker
            .define(OWN, "memory", memory)
            .map_err(|error| format!("the runtime of Python: {error}"))?;
        let instance = linker
            .instantiate_and_start(&mut store, first()?)
            .map_err(wrong)?;
        let Some(stack_pointer) = instance.get_global(&store, "__stack_pointer") else {
            return Err("the runtime of Python lacks an export".to_owned());
        };
        store.data_mut().memory = Some(memory);
        Ok(Self {
            room: instance.get_typed_func(&store, "km_room").map_err(wrong)?,
            load: instance.get_typed_func(&store, "km_load").map_err(wrong)?,
            call: instance.get_typed_func(&store, "km_call").map_err(wrong)?,
            reply: instance.get_typed_func(&store, "km_reply").map_err(wrong)?,
            stopped: instance
                .get_typed_func(&store, "km_stopped")
                .map_err(wrong)?,
            store,
            memory,
            stack_pointer,
            region,
        })
    }

    /// Makes the memory that of `other`, so that it is what `other` is; false if it is larger already, and cannot be.
    pub(super) fn become_like(&mut self, other: &Self) -> Result<bool, String> {
        let wrong = |error: &dyn std::fmt::Display| format!("the runtime of Python: {error}");
        let theirs = other.memory.size(&other.store);
        let own = self.memory.size(&self.store);
        let Some(missing) = theirs.checked_sub(own) else {
            return Ok(false);
        };
        if missing > 0 {
            self.memory
                .grow(&mut self.store, missing)
                .map_err(|error| wrong(&error))?;
        }
        let bytes = other.memory.data(&other.store);
        self.memory.data_mut(&mut self.store).copy_from_slice(bytes);
        let top = other.stack_pointer.get(&other.store);
        self.stack_pointer
            .set(&mut self.store, top)
            .map_err(|error| wrong(&error))?;
        Ok(true)
    }

    /// Sets how many instructions it may use from now on.
    pub(super) fn refuel(&mut self, fuel: u64) {
        // never fails where fuel is counted at all
        let _ = self.store.set_fuel(fuel);
    }

    /// How many are left.
    pub(super) fn fuel(&self) -> u64 {
        self.store.get_fuel().unwrap_or(0)
    }

    /// Loads a submission.
    pub(super) fn load(&mut self, load: &Load) -> Result<Reply, Trouble> {
        self.put(&to_bytes(load).map_err(Trouble::Fault)?)?;
        let bytes = self.load.call(&mut self.store, ())?;
        self.reply(bytes)
    }

    /// Calls a function of the submission.
    pub(super) fn call(&mut self, call: &Call) -> Result<Reply, Trouble> {
        self.put(&to_bytes(call).map_err(Trouble::Fault)?)?;
        let bytes = self.call.call(&mut self.store, ())?;
        self.reply(bytes)
    }

    /// Where the submission was when it was stopped; nothing if even that cannot be said.
    pub(super) fn stopped(&mut self) -> Option<Stopped> {
        self.refuel(TO_SAY_WHERE);
        let bytes = self.stopped.call(&mut self.store, ()).ok()?;
        from_bytes(self.replied(bytes).ok()?).ok()
    }

    fn put(&mut self, bytes: &[u8]) -> Result<(), Trouble> {
        let count = u32::try_from(bytes.len()).unwrap_or(u32::MAX);
        let at = self.room.call(&mut self.store, count)?;
        self.memory
            .write(&mut self.store, at as usize, bytes)
            .map_err(|error| Trouble::Fault(format!("room for a request: {error}")))
    }

    fn reply(&mut self, bytes: u32) -> Result<Reply, Trouble> {
        from_bytes(self.replied(bytes)?).map_err(Trouble::Fault)
    }

    fn replied(&mut self, bytes: u32) -> Result<&[u8], Trouble> {
        let at = self.reply.call(&mut self.store, ())? as usize;
        let memory = self.memory.data(&self.store);
        memory
            .get(at..at + bytes as usize)
            .ok_or_else(|| Trouble::Fault("a reply outside of the memory".to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::rc::Rc;

    use kinemark_python_wire::{Robot, Value};

    use super::*;
    use crate::submission::controller::Budgets;
    use crate::submission::output::Output;

    const FUEL: u64 = 1_000_000_000;

    /// An instance that has loaded `source`.
    fn loaded(source: &str) -> Instance {
        let budgets = Budgets::default();
        let state = State {
            limits: wasmi::StoreLimits::default(),
            memory: None,
            has_rest: false,
            output: Rc::new(RefCell::new(Output::new(&budgets))),
            model: None,
            grants: Vec::new(),
            text_size: budgets.text_size,
        };
        let mut instance = Instance::started(state).expect("started");
        instance.refuel(FUEL);
        let load = Load {
            file: "submission.py".to_owned(),
            source: source.to_owned(),
            robot: Robot {
                fields: Vec::new(),
                granted: Vec::new(),
            },
            task: "move".to_owned(),
            target: Value::Nothing,
            sensors: Vec::new(),
            most_values: 10,
            text_size: 100,
        };
        let loaded = instance.load(&load);
        assert!(matches!(loaded, Ok(Reply::Loaded(_))), "{source}");
        instance
    }

    /// Whether the rest was there after the file was loaded and after a function was called, and what both cost.
    fn run(source: &str) -> (bool, bool, u64) {
        let mut instance = loaded(source);
        let before = instance.store.data().has_rest;
        let call = Call::Function {
            name: "f".to_owned(),
            robot: None,
            arguments: Vec::new(),
        };
        let Ok(Reply::Returned(Value::Number(five))) = instance.call(&call) else {
            panic!("no number");
        };
        assert!((five - 5.0).abs() < 1e-12);
        (
            before,
            instance.store.data().has_rest,
            FUEL - instance.fuel(),
        )
    }

    /// What students begin with, and what they come to.
    #[test]
    fn the_files_of_the_labs_are_loaded_without_the_rest() {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let mut count = 0;
        for (folder, file) in [("labs", "starter.py"), ("reference", "solution.py")] {
            for lab in std::fs::read_dir(root.join(folder)).expect("a folder") {
                let path = lab.expect("a lab").path().join(file);
                if let Ok(source) = std::fs::read_to_string(&path) {
                    let has_rest = loaded(&source).store.data().has_rest;
                    assert!(!has_rest, "{}", path.display());
                    count += 1;
                }
            }
        }
        assert!(count >= 14, "{count}: seven labs have both");
    }

    /// Complex numbers are seldom used.
    #[test]
    fn the_rest_comes_when_something_in_it_is_called_and_costs_nothing() {
        let seldom = "def f():\n    return abs(complex(3, 4))\n";
        let (before, after, first) = run(seldom);
        assert!(!before && after);
        assert_eq!(
            run(seldom),
            (before, after, first),
            "the second has it sooner"
        );
        let often = "import math\n\n\ndef f():\n    return math.hypot(3, 4)\n";
        let (before, after, _) = run(often);
        assert!(!before && !after);
    }
}
