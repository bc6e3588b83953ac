//! Makes two modules of one: what typical submissions call, which every start reads, and the rest, which is read when something in it is
//! called first.
//!
//! In the first module a function of the rest has the body of a link: it calls the import `kinemark_python.rest`, which sees to it that the
//! rest is there, and then the function itself by the table. The rest imports memory, table and globals of the first, writes its functions
//! into the table when it starts, and calls those of the first by the table too. So a call costs the same whether the rest was there or not.
//!
//! The last functions of the table are those that every submission calls soon, so that they can be translated before that.

use std::error::Error;

use wasm_encoder::{
    ConstExpr, ElementSection, Elements, Encode as _, EntityType, ImportSection, Instruction,
    MemoryType, Module, RawSection, RefType,
};
use wasmparser::{BinaryReader, FunctionBody, Operator};

use crate::parts::{
    CODE, ELEMENTS, EXPORTS, GLOBALS, IMPORTS, Parts, TABLES, TYPES, behind_number, code, contents,
    with_more,
};
use crate::seen::Seen;

/// The module whose imports are the first module's exports.
const FIRST: &str = "kinemark_python_first";
/// The import that sees to it that the rest is there.
const REST: (&str, &str) = ("kinemark_python", "rest");
/// The memory, with what is in it after the start.
const MEMORY: (&str, &str) = ("kinemark_python", "memory");
/// The first module's export: from which place of the table on there are functions that are called soon.
const SOON: &str = "km_soon";
/// A function that is not longer stays where it is: what submissions use differs most in short ones, and all of them are small.
const SHORT: usize = 300;

/// The two modules.
pub(crate) struct Split {
    pub(crate) first: Vec<u8>,
    pub(crate) rest: Vec<u8>,
    /// How many functions each has.
    pub(crate) functions: (usize, usize),
}

/// Where a function is called.
#[derive(Clone, Copy)]
enum Place {
    /// In the first module, or imported by it; with its place in the table, if the rest calls it.
    First(Option<u32>),
    /// In the rest: its number there.
    Rest(u32),
}

/// Splits `module`, of whose functions typical submissions call those of `seen`.
pub(crate) fn split(module: &[u8], seen: &Seen) -> Result<Split, Box<dyn Error>> {
    let parts = Parts::of(module)?;
    let first = parts.first() as usize;
    let mut places: Vec<Place> = vec![Place::First(None); first];
    let mut of_rest = Vec::new();
    for (i, range) in parts.bodies.iter().enumerate() {
        places.push(match seen.is_called[i] || range.len() <= SHORT {
            true => Place::First(None),
            false => {
                of_rest.push(i);
                Place::Rest(of_rest.len() as u32 - 1)
            }
        });
    }
    // behind what the table has: the rest, then what the rest calls of the first
    let begin = u32::try_from(parts.table.initial)?;
    let mut next = begin + of_rest.len() as u32;
    let mut called = Vec::new();
    let mut bodies = Vec::new();
    for i in &of_rest {
        let range = parts.bodies[*i].clone();
        let body = FunctionBody::new(BinaryReader::new(&module[range.clone()], range.start));
        let mut operators = body.get_operators_reader()?;
        let mut out = module[range.start..operators.original_position()].to_vec();
        while !operators.eof() {
            let from = operators.original_position();
            let operator = operators.read()?;
            match operator {
                Operator::Call { function_index } => match &mut places[function_index as usize] {
                    Place::Rest(number) => Instruction::Call(*number).encode(&mut out),
                    Place::First(slot) => {
                        let slot = *slot.get_or_insert_with(|| {
                            called.push(function_index);
                            next += 1;
                            next - 1
                        });
                        by_table(&mut out, slot, parts.type_of[function_index as usize]);
                    }
                },
                Operator::RefFunc { .. } | Operator::ReturnCall { .. } => {
                    return Err("a function is named where no call is".into());
                }
                _ => out.extend_from_slice(&module[from..operators.original_position()]),
            }
        }
        bodies.push(out);
    }
    let soon: Vec<u32> = seen.soon.iter().map(|i| (first + i) as u32).collect();
    Ok(Split {
        first: first_module(module, &parts, &places, (begin, next), (&called, &soon))?,
        rest: rest_module(&parts, &of_rest, begin, &bodies)?,
        functions: (parts.bodies.len() - of_rest.len(), of_rest.len()),
    })
}

fn by_table(out: &mut Vec<u8>, slot: u32, type_index: u32) {
    Instruction::I32Const(slot as i32).encode(out);
    Instruction::CallIndirect {
        type_index,
        table_index: 0,
    }
    .encode(out);
}

fn first_module(
    module: &[u8],
    parts: &Parts<'_>,
    places: &[Place],
    (begin, end): (u32, u32),
    (called, soon): (&[u32], &[u32]),
) -> Result<Vec<u8>, Box<dyn Error>> {
    let import = parts.imports.iter().position(|import| *import == REST);
    let import = import.ok_or("the module does not import what brings the rest")?;
    let mut bodies = Vec::new();
    for (i, range) in parts.bodies.iter().enumerate() {
        let function = parts.first() as usize + i;
        bodies.push(match places[function] {
            Place::First(_) => module[range.clone()].to_vec(),
            Place::Rest(number) => {
                let of = parts.type_of[function];
                // no locals
                let mut link = vec![0];
                Instruction::Call(import as u32).encode(&mut link);
                for parameter in 0..parts.types[of as usize].params().len() {
                    Instruction::LocalGet(parameter as u32).encode(&mut link);
                }
                by_table(&mut link, begin + number, of);
                Instruction::End.encode(&mut link);
                link
            }
        });
    }
    let mut table = wasm_encoder::TableSection::new();
    table.table(wasm_encoder::TableType {
        element_type: RefType::FUNCREF,
        minimum: u64::from(end) + soon.len() as u64,
        maximum: Some(u64::from(end) + soon.len() as u64),
        table64: false,
        shared: false,
    });
    let mut elements = ElementSection::new();
    elements.active(
        None,
        &ConstExpr::i32_const((end - called.len() as u32) as i32),
        Elements::Functions(called.iter().chain(soon).copied().collect()),
    );
    let elements = contents(&elements)?;
    let mut exports = Vec::new();
    let mut count = 2;
    "table".encode(&mut exports);
    exports.extend([0x01, 0x00]);
    // a constant i32
    let mut globals = vec![0x7f, 0x00];
    ConstExpr::i32_const(end as i32).encode(&mut globals);
    SOON.encode(&mut exports);
    exports.push(0x03);
    (parts.globals.len() as u32).encode(&mut exports);
    for global in 0..parts.globals.len() as u32 {
        count += 1;
        of_global(global).as_str().encode(&mut exports);
        exports.push(0x03);
        global.encode(&mut exports);
    }
    // a memory of any size: the grader's
    let mut memory = Vec::new();
    MEMORY.0.encode(&mut memory);
    MEMORY.1.encode(&mut memory);
    memory.extend([0x02, 0x00, 0x00]);
    Ok(parts.with(vec![
        (
            IMPORTS,
            Some(with_more(parts.section(IMPORTS)?, 1, &memory)?),
        ),
        (TABLES, Some(contents(&table)?)),
        (
            GLOBALS,
            Some(with_more(parts.section(GLOBALS)?, 1, &globals)?),
        ),
        (
            EXPORTS,
            Some(with_more(parts.section(EXPORTS)?, count, &exports)?),
        ),
        (
            ELEMENTS,
            Some(with_more(
                parts.section(ELEMENTS)?,
                1,
                behind_number(&elements)?,
            )?),
        ),
        (CODE, Some(code(&bodies))),
    ]))
}

/// The name under which a global of the first module is the rest's.
fn of_global(global: u32) -> String {
    format!("global {global}")
}

fn rest_module(
    parts: &Parts<'_>,
    of_rest: &[usize],
    begin: u32,
    bodies: &[Vec<u8>],
) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut imports = ImportSection::new();
    let memory = MemoryType {
        minimum: 0,
        maximum: None,
        memory64: false,
        shared: false,
        page_size_log2: None,
    };
    imports.import(FIRST, "memory", EntityType::Memory(memory));
    let table = wasm_encoder::TableType {
        element_type: RefType::FUNCREF,
        minimum: 0,
        maximum: None,
        table64: false,
        shared: false,
    };
    imports.import(FIRST, "table", EntityType::Table(table));
    for (global, of) in parts.globals.iter().enumerate() {
        let of = wasm_encoder::GlobalType {
            val_type: match of.content_type {
                wasmparser::ValType::I32 => wasm_encoder::ValType::I32,
                other => return Err(format!("a global is of the type {other}").into()),
            },
            mutable: of.mutable,
            shared: false,
        };
        imports.import(FIRST, &of_global(global as u32), EntityType::Global(of));
    }
    let mut functions = wasm_encoder::FunctionSection::new();
    for i in of_rest {
        functions.function(parts.type_of[parts.first() as usize + i]);
    }
    let mut elements = ElementSection::new();
    let all: Vec<u32> = (0..of_rest.len() as u32).collect();
    elements.active(
        None,
        &ConstExpr::i32_const(begin as i32),
        Elements::Functions(all.into()),
    );
    let mut module = Module::new();
    module
        .section(&RawSection {
            id: TYPES,
            data: parts.section(TYPES)?,
        })
        .section(&imports)
        .section(&functions)
        .section(&elements)
        .section(&RawSection {
            id: CODE,
            data: &code(bodies),
        });
    Ok(module.finish())
}
