//! The module that runs Python, made ready once a process. It is kept compressed, in three parts: what most submissions use of it; the rest,
//! which is made ready when something in it is called; and the memory after its start, with which every instance begins.

use std::sync::OnceLock;

use wasmi::{CompilationMode, Config, CustomFuelCosts, Engine, Module};

/// What `grader/python/build` makes.
static FIRST: &[u8] = include_bytes!("../../../python/runtime.wasm.zst");
static REST: &[u8] = include_bytes!("../../../python/rest.wasm.zst");
static MEMORY: &[u8] = include_bytes!("../../../python/memory.zst");

/// Calls of the module inside each other, and bytes of their values: a Python function that calls itself takes a dozen.
const MOST_CALLS: usize = 20_000;
const MOST_STACK_BYTES: usize = 32 << 20;
/// Bytes of a page of WebAssembly's memory.
const PAGE: usize = 64 << 10;

/// The interpreter for which the modules are made.
pub(super) fn engine() -> &'static Engine {
    static ENGINE: OnceLock<Engine> = OnceLock::new();
    ENGINE.get_or_init(|| Engine::new(&config()))
}

/// The first part of the module, ready to start.
///
/// # Errors
/// Why it cannot be had: the build is wrong.
pub(super) fn first() -> Result<&'static Module, String> {
    static MODULE: OnceLock<Result<Module, String>> = OnceLock::new();
    let made = MODULE.get_or_init(|| unpacked(FIRST));
    made.as_ref().map_err(Clone::clone)
}

/// The rest of the module: functions that most submissions do not use. It imports memory, table and globals of the first part.
///
/// # Errors
/// Why it cannot be had: the build is wrong.
pub(super) fn rest() -> Result<&'static Module, String> {
    static MODULE: OnceLock<Result<Module, String>> = OnceLock::new();
    let made = MODULE.get_or_init(|| unpacked(REST));
    made.as_ref().map_err(Clone::clone)
}

/// Pages of the memory after the start.
///
/// # Errors
/// Why it cannot be had: the build is wrong.
pub(super) fn pages() -> Result<u32, String> {
    let pages = size(MEMORY)? / PAGE;
    u32::try_from(pages).map_err(|error| wrong(&error))
}

/// Makes a memory that of the module after its start.
///
/// # Errors
/// Why it cannot be had: the build is wrong.
pub(super) fn begin(memory: &mut [u8]) -> Result<(), String> {
    let size = zstd::bulk::decompress_to_buffer(MEMORY, memory);
    match size.map_err(|error| wrong(&error))? == memory.len() {
        true => Ok(()),
        false => Err(wrong(&"its memory is of another size")),
    }
}

fn bytes(compressed: &[u8]) -> Result<Vec<u8>, String> {
    // no more room than it takes: a worker has little address space
    zstd::bulk::decompress(compressed, size(compressed)?).map_err(|error| wrong(&error))
}

fn size(compressed: &[u8]) -> Result<usize, String> {
    let size = zstd::zstd_safe::get_frame_content_size(compressed);
    let size = size
        .ok()
        .flatten()
        .and_then(|size| usize::try_from(size).ok());
    size.ok_or_else(|| wrong(&"its size is not known"))
}

#[expect(unsafe_code, reason = "validating takes a tenth of a start")]
fn unpacked(compressed: &[u8]) -> Result<Module, String> {
    let bytes = bytes(compressed)?;
    // SAFETY: the bytes are in this program, and valid: a test below holds them against the validator
    unsafe { Module::new_unchecked(engine(), &bytes) }.map_err(|error| wrong(&error))
}

fn wrong(error: &dyn std::fmt::Display) -> String {
    format!("the runtime of Python: {error}")
}

/// The digest of the module: part of the engine's, since grades follow from it.
pub fn digest() -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    hasher.update(FIRST).update(REST).update(MEMORY);
    hasher.finalize()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_modules_are_valid() {
        for compressed in [FIRST, REST] {
            let bytes = bytes(compressed).expect("unpacked");
            Module::validate(engine(), &bytes).expect("valid");
        }
    }
}
