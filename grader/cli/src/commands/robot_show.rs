//! `kinemark robot show`: a robot for people, as a tree with totals, and for machines, as JSON.

use std::process::ExitCode;

use kinemark_toolbox::robot_show::{robot_record, robot_text};

use crate::failure::Failure;
use crate::output;
use crate::robot_source::{self, RobotArgs};

/// Show a robot: its links and joints as a tree, totals, loops, frames and warnings
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  kinemark robot show rrbot\n  \
    kinemark robot show panda.urdf --package franka_description=../franka\n  \
    kinemark robot show RzRyRz --base 2 --links \"0,0,4; 3,0,0; 1,0,0\"\n\n\
    Exit codes: 0 shown, 2 usage, 3 the robot is broken.")]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) robot: RobotArgs,
    /// Print all of it as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Shows the robot.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let loaded = robot_source::load(&args.robot)?;
    if args.json {
        output::print_formatted(&robot_record(&loaded.robot))?;
    } else {
        output::print_styled(&robot_text(&loaded.robot))?;
    }
    Ok(ExitCode::SUCCESS)
}
