//! Marks in a module's code: which function runs, so that a trap can name it.
//!
//! The interpreter says how a module failed, and not where. So every function writes its index to a global when it begins, and again
//! after each call that comes back to it. That is two instructions for each, counted like the module's own.

use std::collections::BTreeMap;

use wasm_encoder::{Encode as _, ExportKind, Instruction, Module, RawSection, ValType};
use wasmparser::{BinaryReaderError, FunctionBody, Operator, Parser, Payload, TypeRef};

/// The export under which the global is found; a module that has this name itself is refused.
pub(super) const MARK: &str = "kinemark: the function that runs";

const GLOBALS: u8 = 6;
const EXPORTS: u8 = 7;
const CODE: u8 = 10;
const DATA_COUNT: u8 = 12;

/// The module with marks, and without custom sections: names are read from the module as it is.
///
/// # Errors
/// What the parser says; never for a module that is valid.
pub(super) fn marked(module: &[u8]) -> Result<Vec<u8>, BinaryReaderError> {
    let (mut functions, mut globals) = (0, 0);
    let mut sections: BTreeMap<u8, Vec<u8>> = BTreeMap::new();
    let mut bodies = Vec::new();
    for payload in Parser::new(0).parse_all(module) {
        let payload = payload?;
        match &payload {
            Payload::ImportSection(imports) => {
                for import in imports.clone() {
                    match import?.ty {
                        TypeRef::Func(_) => functions += 1,
                        TypeRef::Global(_) => globals += 1,
                        _ => {}
                    }
                }
            }
            Payload::GlobalSection(own) => globals += own.count(),
            Payload::CodeSectionEntry(body) => bodies.push(body.clone()),
            _ => {}
        }
        if let Some((number, range)) = payload.as_section()
            && number != 0
            && number != CODE
        {
            sections.insert(number, module[range].to_vec());
        }
    }
    let mark = globals;
    extend(sections.entry(GLOBALS).or_insert_with(|| vec![0]), |end| {
        // a variable i32 that begins as zero
        ValType::I32.encode(end);
        end.push(1);
        Instruction::I32Const(0).encode(end);
        Instruction::End.encode(end);
    });
    extend(sections.entry(EXPORTS).or_insert_with(|| vec![0]), |end| {
        MARK.encode(end);
        ExportKind::Global.encode(end);
        mark.encode(end);
    });
    if !bodies.is_empty() {
        let mut code = Vec::new();
        bodies.len().encode(&mut code);
        for (body, function) in bodies.iter().zip(functions..) {
            marked_body(module, body, function, mark)?.encode(&mut code);
        }
        sections.insert(CODE, code);
    }
    let mut out = Module::new();
    let mut sections: Vec<(u8, Vec<u8>)> = sections.into_iter().collect();
    // the only section whose number is not its place: before the code
    sections.sort_by_key(|(number, _)| match *number {
        DATA_COUNT => (CODE - 1, true),
        number => (number, false),
    });
    for (id, data) in &sections {
        out.section(&RawSection { id: *id, data });
    }
    Ok(out.finish())
}

/// Adds an entry to a section that begins with the count of its entries.
fn extend(section: &mut Vec<u8>, entry: impl FnOnce(&mut Vec<u8>)) {
    let digits = section
        .iter()
        .position(|byte| byte & 0x80 == 0)
        .map_or(section.len(), |last| last + 1);
    let count = section[..digits]
        .iter()
        .rev()
        .fold(0u32, |count, byte| count << 7 | u32::from(byte & 0x7f));
    let mut longer = Vec::with_capacity(section.len() + 64);
    count.saturating_add(1).encode(&mut longer);
    longer.extend_from_slice(&section[digits..]);
    entry(&mut longer);
    *section = longer;
}

/// The body of the function with this index, with its marks.
fn marked_body(
    module: &[u8],
    body: &FunctionBody<'_>,
    function: u32,
    mark: u32,
) -> Result<Vec<u8>, BinaryReaderError> {
    let sign = |out: &mut Vec<u8>| {
        Instruction::I32Const(function.cast_signed()).encode(out);
        Instruction::GlobalSet(mark).encode(out);
    };
    let mut operators = body.get_operators_reader()?;
    let mut copied = operators.original_position();
    let mut out = module[body.range().start..copied].to_vec();
    sign(&mut out);
    while !operators.eof() {
        let is_call = matches!(
            operators.read()?,
            Operator::Call { .. } | Operator::CallIndirect { .. }
        );
        if is_call {
            let here = operators.original_position();
            out.extend_from_slice(&module[copied..here]);
            copied = here;
            sign(&mut out);
        }
    }
    out.extend_from_slice(&module[copied..body.range().end]);
    Ok(out)
}
