//! Makes the count of instructions follow the work. The interpreter of WebAssembly pays for a function, or for the body of a loop, when it is
//! entered: all of it, whatever is left out by a jump. RustPython's loop over its own instructions is one body with a branch for each of
//! them, so that each would pay for all.
//!
//! What stands behind a block, to where the jumps out of that block lead, is a branch of its own. Here it becomes the body of a `loop` that
//! nothing jumps back to: it does the same, and is paid for when it is entered.

use std::error::Error;

use wasmparser::{
    BlockType, FrameKind, FuncValidatorAllocations, FunctionBody, Operator, Parser, Payload,
    ValidPayload, Validator,
};

/// Bytes of a function from which on it matters.
const LARGE: usize = 2_000;

const LOOP: u8 = 0x03;
const EMPTY: u8 = 0x40;
const END: u8 = 0x0b;
const BR: u8 = 0x0c;
const BR_IF: u8 = 0x0d;
const BR_TABLE: u8 = 0x0e;

/// The bodies of all functions, metered, in their order.
pub(crate) fn metered(module: &[u8]) -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
    let mut validator = Validator::new();
    let mut allocations = FuncValidatorAllocations::default();
    let mut bodies = Vec::new();
    for payload in Parser::new(0).parse_all(module) {
        let payload: Payload<'_> = payload?;
        if let ValidPayload::Func(function, body) = validator.payload(&payload)? {
            let bytes = &module[body.range()];
            if bytes.len() < LARGE {
                bodies.push(bytes.to_vec());
                continue;
            }
            let mut checked = function.into_validator(allocations);
            bodies.push(with_branches(module, &body, &mut checked)?);
            allocations = checked.into_allocations();
        }
    }
    Ok(bodies)
}

fn with_branches<R: wasmparser::WasmModuleResources>(
    module: &[u8],
    body: &FunctionBody<'_>,
    checked: &mut wasmparser::FuncValidator<R>,
) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut locals = body.get_binary_reader();
    checked.read_locals(&mut locals)?;
    let mut operators = body.get_operators_reader()?;
    let mut out = module[body.range().start..operators.original_position()].to_vec();
    // how many loops were added inside each construct that is open, the function itself first
    let mut added = vec![0_u32];
    while !operators.eof() {
        let from = operators.original_position();
        let operator = operators.read()?;
        let bytes = &module[from..operators.original_position()];
        let ends = matches!(operator, Operator::End | Operator::Else);
        let ended = checked.get_control_frame(0).map(|frame| frame.kind);
        if ends {
            let inside = added.last_mut().ok_or("an end too many")?;
            out.extend(std::iter::repeat_n(END, *inside as usize));
            *inside = 0;
        }
        match &operator {
            Operator::Br { relative_depth } => {
                out.push(BR);
                number(&mut out, depth(&added, *relative_depth)?);
            }
            Operator::BrIf { relative_depth } => {
                out.push(BR_IF);
                number(&mut out, depth(&added, *relative_depth)?);
            }
            Operator::BrTable { targets } => {
                out.push(BR_TABLE);
                number(&mut out, targets.len());
                for target in targets.targets() {
                    number(&mut out, depth(&added, target?)?);
                }
                number(&mut out, depth(&added, targets.default())?);
            }
            _ => out.extend_from_slice(bytes),
        }
        match &operator {
            Operator::Block { .. } | Operator::Loop { .. } | Operator::If { .. } => added.push(0),
            Operator::End => {
                added.pop();
            }
            _ => {}
        }
        checked.op(from, &operator)?;
        let is_behind_a_block =
            matches!(operator, Operator::End) && ended == Some(FrameKind::Block);
        if let (true, Some(frame), Some(inside)) =
            (is_behind_a_block, checked.get_control_frame(0), added.last_mut())
            && frame.block_type == BlockType::Empty
            && !frame.unreachable
            && checked.operand_stack_height() as usize == frame.height
            // the function itself may have results
            && checked.control_stack_height() > 1
        {
            out.extend([LOOP, EMPTY]);
            *inside += 1;
        }
    }
    Ok(out)
}

/// The depth of a branch over what was added.
fn depth(added: &[u32], relative: u32) -> Result<u32, Box<dyn Error>> {
    let crossed = added.iter().rev().take(relative as usize + 1).sum::<u32>();
    Ok(relative
        .checked_add(crossed)
        .ok_or("a branch that is too deep")?)
}

/// A number in LEB128.
fn number(out: &mut Vec<u8>, mut number: u32) {
    loop {
        let low = (number & 0x7f) as u8;
        number >>= 7;
        if number == 0 {
            out.push(low);
            return;
        }
        out.push(low | 0x80);
    }
}
