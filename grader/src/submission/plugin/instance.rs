//! One instance of a module: its memory and globals, the block that it gave for what it is called with, and its calls.

use wasmi::errors::{ErrorKind, InstantiationError};
use wasmi::{Error, Global, Memory, Store, TrapCode, Val};

use super::imports::{Ended, State};
use super::marks::MARK;
use super::module::{Compiled, MEMORY, MOST_TABLES, VERSION, refused};
use crate::submission::controller::Stop;

/// An instance.
pub(super) struct Instance {
    store: Store<State>,
    instance: wasmi::Instance,
    memory: Memory,
    mark: Option<Global>,
}

/// Why a call has no result.
pub(super) enum Trouble {
    /// A trap, or an import that ended the call.
    Ended {
        /// What the interpreter says.
        error: Error,
        /// The index of the function that ran.
        function: Option<u32>,
    },
    /// A stop that is known already.
    Stop(Stop),
}

/// The most of a module's memory that a block for one call may take.
const MOST_BLOCK_BYTES: usize = 1 << 20;

impl Instance {
    /// Instantiates the module, runs its start function and checks its version.
    pub(super) fn start(compiled: &Compiled, state: State, fuel: u64) -> Result<Self, Trouble> {
        let mut store = Store::new(&compiled.engine, state);
        store.limiter(|state| &mut state.limits);
        let unmarked = |error| Trouble::Ended {
            error,
            function: None,
        };
        store.set_fuel(fuel).map_err(unmarked)?;
        let instance = compiled
            .linker
            .instantiate_and_start(&mut store, &compiled.module)
            .map_err(|error| match too_large(&error, compiled) {
                Some(stop) => Trouble::Stop(stop),
                None => unmarked(error),
            })?;
        let Some(memory) = instance.get_memory(&store, MEMORY) else {
            return Err(Trouble::Stop(refused(
                format!("the module exports no memory named `{MEMORY}`"),
                "export it",
            )));
        };
        store.data_mut().memory = Some(memory);
        let mark = instance.get_global(&store, MARK);
        let mut started = Self {
            store,
            instance,
            memory,
            mark,
        };
        // what languages with constructors do before anything else
        if started.has("_initialize") {
            started.call("_initialize", &[])?;
        }
        let version = started.call("km_version", &[])?;
        if version != Some(VERSION.cast_unsigned()) {
            return Err(Trouble::Stop(refused(
                format!(
                    "the module is made for version {} of the interface, this is version {VERSION}",
                    version.unwrap_or(0)
                ),
                "build it again with the kinemark.h, or the crate kinemark-plugin, of this Kinemark",
            )));
        }
        Ok(started)
    }

    fn has(&self, function: &str) -> bool {
        self.instance.get_func(&self.store, function).is_some()
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

    /// The address of the module's own block of so many bytes.
    pub(super) fn block(&mut self, bytes: usize) -> Result<u32, Trouble> {
        let refuse = |why: String| {
            Trouble::Stop(refused(
                why,
                "in C raise KM_BUFFER_BYTES before you include kinemark.h; in another language give so many bytes at an address that is a multiple of 8",
            ))
        };
        if bytes > MOST_BLOCK_BYTES {
            return Err(refuse(format!(
                "a call needs {bytes} bytes, more than {MOST_BLOCK_BYTES}"
            )));
        }
        let words = [u32::try_from(bytes).unwrap_or(u32::MAX)];
        let at = self.call("km_buffer", &words)?.unwrap_or(0);
        let size = self.memory.data_size(&self.store);
        let is_inside = (at as usize)
            .checked_add(bytes)
            .is_some_and(|end| end <= size);
        if at == 0 {
            return Err(refuse(format!(
                "`km_buffer` gives no room for the {bytes} bytes that a call needs"
            )));
        }
        if !at.is_multiple_of(8) || !is_inside {
            return Err(refuse(format!(
                "`km_buffer` gives the address {at} for {bytes} bytes, which is outside of the memory or no multiple of 8"
            )));
        }
        Ok(at)
    }

    /// Writes to the memory; the place was checked when the block was given.
    pub(super) fn write(&mut self, at: u32, bytes: &[u8]) -> Result<(), Trouble> {
        let written = self.memory.write(&mut self.store, at as usize, bytes);
        written.map_err(|_| Trouble::Ended {
            error: TrapCode::MemoryOutOfBounds.into(),
            function: None,
        })
    }

    /// The memory from `at` on; `None` beyond its end.
    pub(super) fn bytes(&self, at: u32, count: usize) -> Option<&[u8]> {
        let end = (at as usize).checked_add(count)?;
        self.memory.data(&self.store).get(at as usize..end)
    }

    /// Calls an exported function, whose type was checked when the module was loaded.
    pub(super) fn call(&mut self, function: &str, words: &[u32]) -> Result<Option<u32>, Trouble> {
        let Some(function) = self.instance.get_func(&self.store, function) else {
            return Err(Trouble::Stop(Stop::GraderFault(format!(
                "no function `{function}` in a module"
            ))));
        };
        let words: Vec<Val> = words
            .iter()
            .map(|word| Val::I32(word.cast_signed()))
            .collect();
        let mut results = [Val::I32(0)];
        let wanted = function.ty(&self.store).results().len();
        let results = results.get_mut(..wanted).unwrap_or_default();
        match function.call(&mut self.store, &words, results) {
            Ok(()) => Ok(results.first().and_then(Val::i32).map(i32::cast_unsigned)),
            Err(error) => Err(Trouble::Ended {
                error,
                function: self.running(),
            }),
        }
    }

    /// The index of the function that ran last.
    fn running(&self) -> Option<u32> {
        let mark = self.mark?.get(&self.store);
        mark.i32().map(i32::cast_unsigned)
    }
}

/// The refusal of a module whose memory or tables are too large from the beginning.
fn too_large(error: &Error, compiled: &Compiled) -> Option<Stop> {
    let limits = compiled.limits;
    let (what, most) = match error.kind() {
        ErrorKind::Memory(_)
        | ErrorKind::Instantiation(InstantiationError::FailedToInstantiateMemory(_)) => {
            ("memory", format!("{} MiB", limits.memory_bytes >> 20))
        }
        ErrorKind::Table(_)
        | ErrorKind::Instantiation(InstantiationError::FailedToInstantiateTable(_)) => {
            ("tables", format!("{} elements each", limits.table_elements))
        }
        ErrorKind::Instantiation(InstantiationError::TooManyTables) => {
            ("tables", format!("{MOST_TABLES}"))
        }
        ErrorKind::Instantiation(InstantiationError::ElementSegmentDoesNotFit { .. }) => {
            return Some(refused(
                "the module fills a table beyond its end".to_owned(),
                "build it again: the file may have been changed after it was built",
            ));
        }
        _ => return None,
    };
    Some(refused(
        format!("the module begins with more {what} than it may have: {most}"),
        "make its arrays and its stack smaller",
    ))
}

/// The words of an import that ended a call.
pub(super) fn ended(error: &Error) -> Option<&Ended> {
    error.downcast_ref::<Ended>()
}
