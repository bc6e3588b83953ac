//! `kinemark version`: what this program was built from.

use std::process::ExitCode;

use crate::build_info::BuildInfo;
use crate::failure::Failure;
use crate::output;

/// Show the version, the engine, the commit and the platform of this program
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  kinemark version --json\n\n\
    The engine is what a grade and a course name: two programs with the same engine give the same grades.")]
pub(crate) struct Args {
    /// Print them as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Prints it.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let info = BuildInfo::of_this();
    match args.json {
        true => output::print_formatted(&info)?,
        false => output::print(&info.text())?,
    }
    Ok(ExitCode::SUCCESS)
}
