//! Submissions in Python: runs `submission.py` as a [`Controller`](crate::submission::controller::Controller), in RustPython's virtual machine,
//! which is itself a WebAssembly module in the interpreter of compiled submissions.
//!
//! The module is Kinemark's own (`grader/python`), the file is data to it: what the file can reach is what the module has, and every
//! instruction is counted, so that a run ends at the same line on every machine. `docs/python.md` is the reference.

mod ahead;
mod controller;
mod convert;
mod hints;
mod instance;
mod region;
mod runtime;
#[cfg(test)]
mod tests;

pub use ahead::translate_ahead;
pub use controller::PythonController;
pub use runtime::digest;
