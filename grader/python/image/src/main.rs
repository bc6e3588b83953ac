//! Makes the runtime that the grader starts: runs the start of the module that the compiler wrote, and writes a module whose memory begins as
//! it is after that, so that nobody waits for it again. `kinemark-python-image IN OUT`.

mod metering;

use std::error::Error;
use std::path::Path;

use wasm_encoder::{
    CodeSection, ConstExpr, DataSection, MemorySection, MemoryType, Module, RawSection,
};
use wasmi::{Config, Engine, ExternType, Linker, Store, Val};
use wasmparser::{Parser, Payload};

/// Zero bytes between two pieces of memory that are worth a segment of their own.
const GAP: usize = 64;
const PAGE: usize = 65_536;
const STACK_POINTER: &str = "__stack_pointer";
/// The best that compresses in seconds; what unpacks it does not mind.
const LEVEL: i32 = 19;

fn main() -> Result<(), Box<dyn Error>> {
    let paths: Vec<String> = std::env::args().skip(1).collect();
    let [from, to] = paths.as_slice() else {
        return Err("usage: kinemark-python-image IN OUT".into());
    };
    let module = std::fs::read(from)?;
    let module = with_metering(&module)?;
    let memory = memory_after_start(&module)?;
    let image = with_memory(&module, &memory)?;
    let compressed = zstd::bulk::compress(&image, LEVEL)?;
    let beside = Path::new(to).with_extension("new");
    std::fs::write(&beside, &compressed)?;
    std::fs::rename(&beside, to)?;
    println!(
        "{} bytes from the compiler, {} with {} bytes of memory, {} compressed",
        module.len(),
        image.len(),
        memory.len(),
        compressed.len()
    );
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

/// The module with metered functions.
fn with_metering(module: &[u8]) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut code = CodeSection::new();
    for body in metering::metered(module)? {
        code.raw(&body);
    }
    let mut metered = Module::new();
    for payload in Parser::new(0).parse_all(module) {
        let payload = payload?;
        if matches!(payload, Payload::CodeSectionStart { .. }) {
            metered.section(&code);
            continue;
        }
        if let Some((id, range)) = payload.as_section()
            && id != 0
        {
            metered.section(&RawSection {
                id,
                data: &module[range],
            });
        }
    }
    Ok(metered.finish())
}

/// The module with this memory from the beginning.
fn with_memory(module: &[u8], memory: &[u8]) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut image = Module::new();
    let mut data = DataSection::new();
    for (at, bytes) in pieces(memory) {
        data.active(
            0,
            &ConstExpr::i32_const(i32::try_from(at)?),
            bytes.iter().copied(),
        );
    }
    let mut is_written = false;
    for payload in Parser::new(0).parse_all(module) {
        let payload = payload?;
        match &payload {
            Payload::MemorySection(memories) => {
                let declared = memories.clone().into_iter().next().ok_or("no memory")??;
                let mut section = MemorySection::new();
                section.memory(MemoryType {
                    minimum: (memory.len() / PAGE) as u64,
                    maximum: declared.maximum,
                    memory64: false,
                    shared: false,
                    page_size_log2: None,
                });
                image.section(&section);
                continue;
            }
            Payload::DataSection(_) => {
                image.section(&data);
                is_written = true;
                continue;
            }
            Payload::DataCountSection { .. } => {
                return Err(
                    "the module copies its own data: its memory is not all there is".into(),
                );
            }
            Payload::StartSection { .. } => return Err("the module starts by itself".into()),
            _ => {}
        }
        if let Some((id, range)) = payload.as_section()
            && id != 0
        {
            image.section(&RawSection {
                id,
                data: &module[range],
            });
        }
    }
    if !is_written {
        return Err("the module has no data".into());
    }
    Ok(image.finish())
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
