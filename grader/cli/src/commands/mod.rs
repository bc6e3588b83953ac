//! One file per subcommand.

mod compare;
mod completions;
mod convert;
mod eval;
mod export;
mod grade;
mod lab_check;
mod labs;
mod new;
mod scene_check;
mod show;
mod variant;
mod verify;
mod view;
mod watch;

use std::process::ExitCode;

use crate::args::{Args, Command, LabCommand, RobotCommand, SceneCommand};
use crate::failure::Failure;
use crate::worker;

/// Runs what was typed.
pub(crate) fn run(args: Args) -> Result<ExitCode, Failure> {
    match args.command {
        Command::Grade(args) => grade::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::View(args) => view::run(&args),
        Command::Watch(args) => watch::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Export(args) => export::run(&args),
        Command::Labs(args) => labs::run(&args),
        Command::New(args) => new::run(&args),
        Command::Variant(args) => variant::run(&args),
        Command::Robot(RobotCommand::Show(args)) => show::run(&args),
        Command::Robot(RobotCommand::Convert(args)) => convert::run(&args),
        Command::Robot(RobotCommand::Eval(args)) => eval::run(&args),
        Command::Scene(SceneCommand::Check(args)) => scene_check::run(&args),
        Command::Lab(LabCommand::Check(args)) => lab_check::run(&args),
        Command::Completions(args) => completions::run(&args),
        Command::Worker => Ok(worker::serve()),
    }
}
