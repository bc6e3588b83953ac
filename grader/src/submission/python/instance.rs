//! One instance of the runtime: its memory, its requests, and where it was when it was stopped.

use kinemark_python_wire::{Call, Load, Reply, Stopped, from_bytes, to_bytes};
use wasmi::{Caller, Error, Linker, Memory, Store, StoreLimitsBuilder, TypedFunc};

use super::runtime::runtime;
use crate::submission::plugin::{State, linker, text};

/// Bytes of memory that a submission may have, with the interpreter's own.
pub(super) const MEMORY_BYTES: usize = 64 << 20;
/// Elements of the table of functions.
const TABLE_ELEMENTS: usize = 100_000;
/// Instructions for saying where it was.
const TO_SAY_WHERE: u64 = 10_000_000;

/// The module name of what only the runtime imports.
const OWN: &str = "kinemark_python";

/// Adds a line to the log, with the line of the file that printed it; 0 if that is not known.
fn logged(mut caller: Caller<'_, State>, at: u32, bytes: u32, line: u32) -> Result<(), Error> {
    let printed = text(&mut caller, at, bytes)?;
    let line = (line > 0).then_some(line as usize);
    caller.data().output.borrow_mut().print(printed, line);
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
    pub(super) fn new(mut state: State) -> Result<Self, String> {
        let runtime = runtime()?;
        let wrong = |error: Error| format!("the runtime of Python: {error}");
        state.limits = StoreLimitsBuilder::new()
            .memory_size(MEMORY_BYTES)
            .table_elements(TABLE_ELEMENTS)
            .instances(1)
            .memories(1)
            .tables(1)
            .trap_on_grow_failure(true)
            .build();
        let mut store = Store::new(&runtime.engine, state);
        store.limiter(|state| &mut state.limits);
        // filling the memory is not the submission's doing
        store.set_fuel(u64::MAX).map_err(wrong)?;
        let mut linker: Linker<State> = linker(&runtime.engine).map_err(wrong)?;
        linker
            .func_wrap(OWN, "log", logged)
            .map_err(|error| format!("the runtime of Python: {error}"))?;
        let instance = linker
            .instantiate_and_start(&mut store, &runtime.module)
            .map_err(wrong)?;
        let (Some(memory), Some(stack_pointer)) = (
            instance.get_memory(&store, "memory"),
            instance.get_global(&store, "__stack_pointer"),
        ) else {
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
