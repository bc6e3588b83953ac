//! The commands as one tree, in the order in which help lists them, and which function runs each.

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::commands::{
    compare, completions, convert, eval, export, grade, lab_check, labs, new, scene_check, show,
    variant, verify, view, watch,
};
use crate::failure::Failure;
use crate::worker;

/// Grades robotics coursework: the same bits everywhere, every lost point explained.
#[derive(Debug, Parser)]
#[command(
    name = "kinemark",
    version,
    arg_required_else_help = true,
    max_term_width = 100
)]
#[command(
    after_help = "Start with `kinemark labs`, then `kinemark new 01-kinematics`.\n\
    Exit codes: 0 full marks or done, 1 points lost or answers with errors, 2 usage, 3 the lab, robot or scene is broken, \
    4 the grader or this machine failed."
)]
pub(crate) struct CommandLine {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Grade(grade::Args),
    Verify(verify::Args),
    View(view::Args),
    Watch(watch::Args),
    Compare(compare::Args),
    Export(export::Args),
    Labs(labs::Args),
    New(new::Args),
    Variant(variant::Args),
    /// Show, convert or ask a robot: kinematics, dynamics, simulation
    #[command(subcommand)]
    Robot(RobotCommand),
    /// Check a scene
    #[command(subcommand)]
    Scene(SceneCommand),
    /// Check a lab
    #[command(subcommand)]
    Lab(LabCommand),
    Completions(completions::Args),
    /// Runs a submission for another process; not for people
    #[command(hide = true)]
    Worker,
}

#[derive(Debug, Subcommand)]
pub(crate) enum RobotCommand {
    Show(show::Args),
    Convert(convert::Args),
    Eval(eval::Args),
}

#[derive(Debug, Subcommand)]
pub(crate) enum SceneCommand {
    Check(scene_check::Args),
}

#[derive(Debug, Subcommand)]
pub(crate) enum LabCommand {
    Check(lab_check::Args),
}

impl CommandLine {
    /// Runs what was typed.
    pub(crate) fn run(self) -> Result<ExitCode, Failure> {
        match self.command {
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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_commands_are_consistent() {
        use clap::CommandFactory as _;
        CommandLine::command().debug_assert();
    }

    /// The reference of the command line is that of the code; `KINEMARK_BLESS=1` writes it anew.
    #[test]
    fn the_published_reference_is_current() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/cli.md");
        let options = clap_markdown::MarkdownOptions::new()
            .title("The command line".to_owned())
            .show_footer(false);
        let text = clap_markdown::help_markdown_custom::<CommandLine>(&options);
        let text = text.trim_end().to_owned() + "\n";
        let published = std::fs::read_to_string(path).unwrap_or_default();
        if published != text && std::env::var_os("KINEMARK_BLESS").is_some() {
            std::fs::write(path, &text).unwrap();
        }
        assert!(
            published == text,
            "docs/cli.md was not that of the code: KINEMARK_BLESS=1 cargo test writes it (docs/tests.md)"
        );
    }
}
