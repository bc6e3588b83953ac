//! Compiled submissions: runs a WebAssembly module as a [`Controller`](crate::submission::controller::Controller).
//!
//! The module is interpreted, so that its instructions are counted alike on every machine and in every build. It sees no file, clock,
//! network or randomness: only what `grader/plugin/c/kinemark.h` describes, version 1. `docs/plugin.md` is the reference.

mod controller;
mod imports;
mod instance;
mod layout;
mod marks;
mod module;
mod names;
#[cfg(test)]
mod tests;

pub use controller::PluginController;
// the runtime of Python has the same imports
#[cfg(feature = "python")]
pub(super) use imports::{Ended, State, linker, text};
