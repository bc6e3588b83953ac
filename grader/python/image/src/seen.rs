//! Which functions of the runtime typical submissions call, and in which order: each function of a copy of the module has a global, in which it
//! leaves its number when it is called first.

use std::error::Error;

use kinemark_python_wire::{Call, Reply, from_bytes, to_bytes};
use wasm_encoder::{BlockType, Encode as _, Instruction};
use wasmi::{Config, Engine, Linker, Store};

use crate::parts::{CODE, EXPORTS, GLOBALS, Parts, code, with_more};
use crate::typical;

/// The name of the global that counts the functions called so far.
const COUNT: &str = "seen";

/// What typical submissions call, of the functions that are not imported.
pub(crate) struct Seen {
    /// Whether each is called.
    pub(crate) is_called: Vec<bool>,
    /// What every submission calls until its first command, in the order of the first of them.
    pub(crate) soon: Vec<usize>,
}

/// Runs the typical submissions.
pub(crate) fn seen(module: &[u8]) -> Result<Seen, Box<dyn Error>> {
    let parts = Parts::of(module)?;
    let marking = with_marks(module, &parts)?;
    let mut config = Config::default();
    config
        .set_max_recursion_depth(20_000)
        .set_max_stack_height(32 << 20);
    let engine = Engine::new(&config);
    let marking = wasmi::Module::new(&engine, &marking)?;
    let mut is_called = vec![false; parts.bodies.len()];
    let mut soon: Option<Vec<(i32, usize)>> = None;
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
        let number = |store: &Store<()>, name: &str| {
            let mark = instance.get_global(store, name).ok_or("no mark")?;
            mark.get(store).i32().ok_or("a mark that is no number")
        };
        let mut raised = Vec::new();
        let mut until_command = None;
        for one in &typical.calls {
            let replied = ask(&mut store, &to_bytes(one)?, &call)?;
            if !matches!(replied, Reply::Returned(_)) {
                raised.push(replied);
            }
            if until_command.is_none() && matches!(one, Call::Control { .. }) {
                until_command = Some(number(&store, COUNT)?);
            }
        }
        // one that ends early would show less than it is meant to
        if raised.len() != typical.raised {
            return Err(format!("a typical submission ends with {raised:?}").into());
        }
        let numbers = (0..is_called.len()).map(|i| number(&store, &mark(i)));
        let numbers = numbers.collect::<Result<Vec<i32>, _>>()?;
        for (is_called, number) in is_called.iter_mut().zip(&numbers) {
            *is_called |= *number > 0;
        }
        if let Some(last) = until_command {
            let is_soon = |i: usize| (1..=last).contains(&numbers[i]);
            match &mut soon {
                Some(soon) => soon.retain(|(_, i)| is_soon(*i)),
                None => {
                    let functions = (0..numbers.len()).filter(|i| is_soon(*i));
                    soon = Some(functions.map(|i| (numbers[i], i)).collect());
                }
            }
        }
    }
    let mut soon = soon.ok_or("no typical submission commands anything")?;
    soon.sort_unstable();
    Ok(Seen {
        is_called,
        soon: soon.into_iter().map(|(_, i)| i).collect(),
    })
}

/// The name of a function's mark.
fn mark(function: usize) -> String {
    format!("seen {function}")
}

fn with_marks(module: &[u8], parts: &Parts<'_>) -> Result<Vec<u8>, Box<dyn Error>> {
    let count = parts.bodies.len() as u32;
    let first = parts.globals.len() as u32;
    let last = first + count;
    // a mutable i32 that begins as 0
    let zero = [0x7f, 0x01, 0x41, 0x00, 0x0b];
    let mut globals = Vec::from(zero);
    let mut exports = Vec::new();
    let export = |exports: &mut Vec<u8>, name: &str, global: u32| {
        name.encode(exports);
        exports.push(0x03);
        global.encode(exports);
    };
    export(&mut exports, COUNT, last);
    let mut bodies = Vec::new();
    for (i, range) in parts.bodies.iter().enumerate() {
        let global = first + i as u32;
        globals.extend(zero);
        export(&mut exports, &mark(i), global);
        let body = wasmparser::FunctionBody::new(wasmparser::BinaryReader::new(
            &module[range.clone()],
            range.start,
        ));
        let locals = body.get_operators_reader()?.original_position();
        let mut marked = module[range.start..locals].to_vec();
        for instruction in [
            Instruction::GlobalGet(global),
            Instruction::I32Eqz,
            Instruction::If(BlockType::Empty),
            Instruction::GlobalGet(last),
            Instruction::I32Const(1),
            Instruction::I32Add,
            Instruction::GlobalSet(last),
            Instruction::GlobalGet(last),
            Instruction::GlobalSet(global),
            Instruction::End,
        ] {
            instruction.encode(&mut marked);
        }
        marked.extend_from_slice(&module[locals..range.end]);
        bodies.push(marked);
    }
    Ok(parts.with(vec![
        (
            GLOBALS,
            Some(with_more(parts.section(GLOBALS)?, count + 1, &globals)?),
        ),
        (
            EXPORTS,
            Some(with_more(parts.section(EXPORTS)?, count + 1, &exports)?),
        ),
        (CODE, Some(code(&bodies))),
    ]))
}
