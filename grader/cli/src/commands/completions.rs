//! `kinemark completions`: what a shell needs to complete the command.

use std::process::ExitCode;

use clap::CommandFactory as _;

use crate::command_line::CommandLine;
use crate::failure::Failure;
use crate::output;

/// Print shell completions
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example:\n  kinemark completions bash > ~/.local/share/bash-completion/completions/kinemark"
)]
pub(crate) struct Args {
    /// The shell
    pub(crate) shell: clap_complete::Shell,
}

/// Prints the completions.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(
        args.shell,
        &mut CommandLine::command(),
        "kinemark",
        &mut script,
    );
    output::print(&String::from_utf8_lossy(&script))?;
    Ok(ExitCode::SUCCESS)
}
