//! The module that runs Python, made ready once a process: it is kept compressed, with the memory that it has after its start, so that a
//! start is a copy.

use std::sync::OnceLock;

use wasmi::{CompilationMode, Config, CustomFuelCosts, Engine, Module};

/// The module as `grader/python/build` makes it.
static COMPRESSED: &[u8] = include_bytes!("../../../python/runtime.wasm.zst");

/// Calls of the module inside each other, and bytes of their values: a Python function that calls itself takes a dozen.
const MOST_CALLS: usize = 20_000;
const MOST_STACK_BYTES: usize = 32 << 20;

/// The module, and the interpreter that it is made for.
pub(super) struct Runtime {
    pub(super) engine: Engine,
    pub(super) module: Module,
}

/// The module, ready to start.
///
/// # Errors
/// Why it cannot be had: the build is wrong.
pub(super) fn runtime() -> Result<&'static Runtime, String> {
    static RUNTIME: OnceLock<Result<Runtime, String>> = OnceLock::new();
    RUNTIME.get_or_init(made).as_ref().map_err(Clone::clone)
}

fn made() -> Result<Runtime, String> {
    let wrong = |error: &dyn std::fmt::Display| format!("the runtime of Python: {error}");
    // no more room than it takes: a worker has little address space
    let size = zstd::zstd_safe::get_frame_content_size(COMPRESSED);
    let size = size
        .ok()
        .flatten()
        .and_then(|size| usize::try_from(size).ok());
    let size = size.ok_or_else(|| wrong(&"its size is not known"))?;
    let bytes = zstd::bulk::decompress(COMPRESSED, size).map_err(|error| wrong(&error))?;
    let engine = Engine::new(&config());
    let module = Module::new(&engine, &bytes).map_err(|error| wrong(&error))?;
    Ok(Runtime { engine, module })
}

/// The digest of the module: part of the engine's, since grades follow from it.
pub fn digest() -> blake3::Hash {
    blake3::hash(COMPRESSED)
}

fn config() -> Config {
    let mut config = Config::default();
    config
        .consume_fuel(true)
        // what a process translates first must not be paid by the submission that comes first
        .fuel_cost(CustomFuelCosts {
            bytes_copied_per_fuel: 64,
            fuel_per_bytes_translated: 0,
            fuel_per_bytes_validated: 0,
        })
        // the module is Kinemark's own: its functions are translated when they are first called
        .compilation_mode(CompilationMode::Lazy)
        .set_max_recursion_depth(MOST_CALLS)
        .set_max_stack_height(MOST_STACK_BYTES)
        .wasm_multi_memory(false)
        .wasm_tail_call(false)
        .ignore_custom_sections(true);
    config
}
