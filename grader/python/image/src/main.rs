//! Makes the runtime that the grader starts: runs the start of the module that the compiler wrote, keeps the memory after it, so that nobody
//! waits for it again, and writes the module in two parts: what typical submissions use, and the rest.
//! `kinemark-python-image IN FOLDER` writes `memory.zst`, `runtime.wasm.zst` and `rest.wasm.zst`.

mod metering;
mod parts;
mod seen;
mod split;
mod typical;

use std::error::Error;
use std::path::Path;

use parts::{CODE, DATA, MEMORIES, Parts};
use wasm_encoder::{ConstExpr, DataSection, MemorySection, MemoryType};
use wasmi::{Config, Engine, ExternType, Linker, Store, Val};

/// Zero bytes between two pieces of memory that are worth a segment of their own.
const GAP: usize = 64;
const PAGE: usize = 65_536;
const STACK_POINTER: &str = "__stack_pointer";
/// Unpacked at every start, which takes half as long as from the highest level; and the smallest for what is seldom unpacked.
const QUICK: i32 = 12;
const SMALL: i32 = 19;

fn main() -> Result<(), Box<dyn Error>> {
    let paths: Vec<String> = std::env::args().skip(1).collect();
    let [from, folder] = paths.as_slice() else {
        return Err("usage: kinemark-python-image IN FOLDER".into());
    };
    let module = std::fs::read(from)?;
    let module = with_metering(&module)?;
    let memory = memory_after_start(&module)?;
    let seen = seen::seen(&with_memory(&module, &memory)?)?;
    let split = split::split(&without_memory(&module)?, &seen)?;
    println!(
        "{} bytes from the compiler, {} with metering",
        std::fs::metadata(from)?.len(),
        module.len(),
    );
    let bodies = Parts::of(&module)?.bodies;
    let (in_first, in_rest) = split.functions;
    println!("{in_first} functions at hand, {in_rest} in the rest");
    let bytes = seen.soon.iter().map(|i| bodies[*i].len()).sum::<usize>();
    println!("{} functions soon, {bytes} bytes", seen.soon.len());
    for (name, bytes, level) in [
        ("memory.zst", &memory, QUICK),
        ("runtime.wasm.zst", &split.first, QUICK),
        ("rest.wasm.zst", &split.rest, SMALL),
    ] {
        if name.contains(".wasm") {
            wasmparser::Validator::new().validate_all(bytes)?;
        }
        let compressed = zstd::bulk::compress(bytes, level)?;
        let to = Path::new(folder).join(name);
        let beside = to.with_extension("new");
        std::fs::write(&beside, &compressed)?;
        std::fs::rename(&beside, &to)?;
        println!(
            "{name}: {} bytes, {} compressed",
            bytes.len(),
            compressed.len()
        );
    }
    Ok(())
}

/// The memory after `km_start`.
fn memory_after_start(module: &[u8]) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut config = Config::default();
    config
        .set_max_recursion_depth(20_000)
        .set_max_stack_height(32 << 20);
    let engine = Engine::new(&config);
    let module = wasmi::Module::new(&engine, module)?;
    let mut store = Store::new(&engine, ());
    let mut linker = Linker::new(&engine);
    for import in module.imports() {
        let ExternType::Func(of) = import.ty() else {
            return Err(format!("{} is imported, which is no function", import.name()).into());
        };
        let name = format!("{}.{}", import.module(), import.name());
        println!("imports {name}");
        let refuse = move |_: wasmi::Caller<'_, ()>, _: &[Val], _: &mut [Val]| {
            Err(wasmi::Error::new(format!(
                "{name} is called before there is a submission"
            )))
        };
        linker.func_new(import.module(), import.name(), of.clone(), refuse)?;
    }
    let instance = linker.instantiate_and_start(&mut store, &module)?;
    let stack = instance
        .get_global(&store, STACK_POINTER)
        .ok_or("the stack pointer is not exported")?;
    let top = stack.get(&store).i32();
    let start = instance.get_typed_func::<(), ()>(&store, "km_start")?;
    start.call(&mut store, ())?;
    if stack.get(&store).i32() != top {
        return Err("the stack is not as it was".into());
    }
    let memory = instance
        .get_memory(&store, "memory")
        .ok_or("there is no memory")?;
    Ok(memory.data(&store).to_vec())
}

/// The module with metered functions, and nothing but what it runs with.
fn with_metering(module: &[u8]) -> Result<Vec<u8>, Box<dyn Error>> {
    let code = parts::code(&metering::metered(module)?);
    Ok(Parts::of(module)?.with(vec![(CODE, Some(code))]))
}

/// The module with this memory from the beginning.
fn with_memory(module: &[u8], memory: &[u8]) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut data = DataSection::new();
    for (at, bytes) in pieces(memory) {
        data.active(
            0,
            &ConstExpr::i32_const(i32::try_from(at)?),
            bytes.iter().copied(),
        );
    }
    let mut memories = MemorySection::new();
    memories.memory(MemoryType {
        minimum: (memory.len() / PAGE) as u64,
        maximum: None,
        memory64: false,
        shared: false,
        page_size_log2: None,
    });
    Ok(Parts::of(module)?.with(vec![
        (MEMORIES, Some(parts::contents(&memories)?)),
        (DATA, Some(parts::contents(&data)?)),
    ]))
}

/// The module without a memory of its own.
fn without_memory(module: &[u8]) -> Result<Vec<u8>, Box<dyn Error>> {
    Ok(Parts::of(module)?.with(vec![(MEMORIES, None), (DATA, None)]))
}

/// The pieces of memory that are not zero.
fn pieces(memory: &[u8]) -> Vec<(usize, &[u8])> {
    let mut pieces = Vec::new();
    let mut at = 0;
    while let Some(begin) = memory[at..].iter().position(|byte| *byte != 0) {
        let begin = at + begin;
        let mut end = begin;
        let mut zeros = 0;
        for (i, byte) in memory[begin..].iter().enumerate() {
            if *byte == 0 {
                zeros += 1;
                if zeros > GAP {
                    break;
                }
            } else {
                zeros = 0;
                end = begin + i + 1;
            }
        }
        pieces.push((begin, &memory[begin..end]));
        at = end;
    }
    pieces
}
