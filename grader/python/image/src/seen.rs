//! Which functions of the runtime typical submissions call: each function of a copy of the module marks a global of its own.

use std::error::Error;

use kinemark_python_wire::{Reply, from_bytes, to_bytes};
use wasm_encoder::Encode as _;
use wasmi::{Config, Engine, Linker, Store};

use crate::parts::{CODE, EXPORTS, GLOBALS, Parts, code, with_more};
use crate::typical;

/// Whether each function that is not imported is called.
pub(crate) fn seen(module: &[u8]) -> Result<Vec<bool>, Box<dyn Error>> {
    let parts = Parts::of(module)?;
    let marking = with_marks(module, &parts)?;
    let mut config = Config::default();
    config
        .set_max_recursion_depth(20_000)
        .set_max_stack_height(32 << 20);
    let engine = Engine::new(&config);
    let marking = wasmi::Module::new(&engine, &marking)?;
    let mut seen = vec![false; parts.bodies.len()];
    for typical in typical::all() {
        let mut store = Store::new(&engine, ());
        let mut linker = Linker::new(&engine);
        for import in marking.imports() {
            if let wasmi::ExternType::Func(of) = import.ty() {
                let nothing =
                    |_: wasmi::Caller<'_, ()>, _: &[wasmi::Val], _: &mut [wasmi::Val]| Ok(());
                linker.func_new(import.module(), import.name(), of.clone(), nothing)?;
            }
        }
        let instance = linker.instantiate_and_start(&mut store, &marking)?;
        let room = instance.get_typed_func::<u32, u32>(&store, "km_room")?;
        let load = instance.get_typed_func::<(), u32>(&store, "km_load")?;
        let call = instance.get_typed_func::<(), u32>(&store, "km_call")?;
        let reply = instance.get_typed_func::<(), u32>(&store, "km_reply")?;
        let memory = instance.get_memory(&store, "memory").ok_or("no memory")?;
        let ask = |store: &mut Store<()>, request: &[u8], function: &wasmi::TypedFunc<(), u32>| {
            let at = room.call(&mut *store, request.len() as u32)? as usize;
            memory.write(&mut *store, at, request)?;
            let count = function.call(&mut *store, ())? as usize;
            let at = reply.call(&mut *store, ())? as usize;
            let bytes = memory.data(&*store).get(at..at + count).ok_or("no reply")?;
            Ok::<Reply, Box<dyn Error>>(from_bytes(bytes)?)
        };
        let loaded = ask(&mut store, &to_bytes(&typical.load)?, &load)?;
        if matches!(loaded, Reply::Loaded(_)) != typical.is_loaded {
            return Err(format!("a typical submission is loaded or not: {loaded:?}").into());
        }
        let mut raised = Vec::new();
        for one in &typical.calls {
            let replied = ask(&mut store, &to_bytes(one)?, &call)?;
            if !matches!(replied, Reply::Returned(_)) {
                raised.push(replied);
            }
        }
        // one that ends early would show less than it is meant to
        if raised.len() != typical.raised {
            return Err(format!("a typical submission ends with {raised:?}").into());
        }
        for (i, seen) in seen.iter_mut().enumerate() {
            let mark = instance.get_global(&store, &mark(i)).ok_or("no mark")?;
            *seen |= mark.get(&store).i32() == Some(1);
        }
    }
    Ok(seen)
}

/// The name of a function's mark.
fn mark(function: usize) -> String {
    format!("seen {function}")
}

fn with_marks(module: &[u8], parts: &Parts<'_>) -> Result<Vec<u8>, Box<dyn Error>> {
    let count = parts.bodies.len() as u32;
    let first = parts.globals.len() as u32;
    let (mut globals, mut exports) = (Vec::new(), Vec::new());
    let mut bodies = Vec::new();
    for (i, range) in parts.bodies.iter().enumerate() {
        let global = first + i as u32;
        // a mutable i32 that begins as 0
        globals.extend([0x7f, 0x01, 0x41, 0x00, 0x0b]);
        mark(i).as_str().encode(&mut exports);
        exports.push(0x03);
        global.encode(&mut exports);
        let body = wasmparser::FunctionBody::new(wasmparser::BinaryReader::new(
            &module[range.clone()],
            range.start,
        ));
        let locals = body.get_operators_reader()?.original_position();
        let mut marked = module[range.start..locals].to_vec();
        // i32.const 1, global.set
        marked.extend([0x41, 0x01, 0x24]);
        global.encode(&mut marked);
        marked.extend_from_slice(&module[locals..range.end]);
        bodies.push(marked);
    }
    Ok(parts.with(vec![
        (
            GLOBALS,
            Some(with_more(parts.section(GLOBALS)?, count, &globals)?),
        ),
        (
            EXPORTS,
            Some(with_more(parts.section(EXPORTS)?, count, &exports)?),
        ),
        (CODE, Some(code(&bodies))),
    ]))
}
