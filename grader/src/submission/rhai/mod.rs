//! The script language: runs a student's code as a [`Controller`](crate::submission::controller::Controller).
//!
//! The language is Rhai without clocks, files, modules, randomness, closures and `eval`, with vectors and matrices as types
//! and every transcendental function from `libm`. `docs/script-language.md` is its reference. What the code may use up is
//! counted, never timed.

mod arithmetic;
mod budget;
mod code_parts;
mod convert;
mod copies;
mod engine;
mod foreign;
mod further;
mod granted;
mod habits;
mod hints;
mod library;
mod linear;
mod list;
mod math;
mod metered;
mod mistake;
mod operand;
mod output;
mod parsing;
mod places;
mod program_tree;
mod range;
mod recovery;
mod script;
mod signs;
mod slips;
#[cfg(test)]
mod tests;
mod tokens;
mod unknown;
mod vector;
mod weight;
mod words;

/// Every function that a submission can call, with its arguments and what it does, as language servers of Rhai read it (`.d.rhai`).
pub const DEFINITIONS: &str = include_str!("kinemark.d.rhai");

pub use code_parts::{CodePart, code_parts};
pub use program_tree::{Bytes, FunctionPart, Part, ProgramTree};
pub use script::{STACK_BYTES, ScriptController, refused_name};
