//! `cargo fuzz-all [SECONDS] [TARGET...]`: runs the fuzz targets of `tests/fuzz` by its script, which needs a nightly compiler.

use std::process::{Command, ExitCode};

fn main() -> std::io::Result<ExitCode> {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/fuzz/run.sh");
    let status = Command::new("sh")
        .arg(script)
        .args(std::env::args_os().skip(1))
        .status()?;
    Ok(if status.success() {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}
