//! What can be typed.

use std::path::PathBuf;

use clap::{Args as ClapArgs, Parser, Subcommand};

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
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// Where labs and the staff's part come from.
#[derive(Debug, Clone, ClapArgs)]
pub(crate) struct PlaceArgs {
    /// Folder of the labs [default: a `labs` folder here or above, else the labs built in]
    #[arg(long, value_name = "DIR", global = true)]
    pub(crate) labs: Option<PathBuf>,
}

/// Where the staff's part comes from.
#[derive(Debug, Clone, ClapArgs)]
pub(crate) struct StaffArgs {
    /// Folder of the staff's reference [default: `reference` beside the labs folder]
    #[arg(long, value_name = "DIR")]
    pub(crate) reference: Option<PathBuf>,
    /// Grade on visible cases only, as students do
    #[arg(long, conflicts_with = "reference")]
    pub(crate) practice: bool,
    /// Salt that hidden cases are drawn with, in place of the one in hidden.toml
    #[arg(
        long,
        value_name = "TEXT",
        env = "KINEMARK_SALT",
        hide_env_values = true
    )]
    pub(crate) salt: Option<String>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Grade(GradeArgs),
    Verify(VerifyArgs),
    Labs(LabsArgs),
    New(NewArgs),
    /// Ask a robot: kinematics, dynamics, simulation
    #[command(subcommand)]
    Robot(RobotCommand),
    Completions(CompletionsArgs),
    /// Runs a submission for another process; not for people
    #[command(hide = true)]
    Worker,
}

/// Grade a submission
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Examples:\n  kinemark grade 01-kinematics submission.rhai\n  \
    kinemark grade 01-kinematics submission.rhai --out feedback --json\n\n\
    Writes grade.json, report.html, plots, a log per motion task and a copy of the submission and the lab to the output folder.\n\
    Exit codes: 0 every check full, 1 points lost, 2 usage, 3 the lab is broken, 4 the grader or this machine failed."
)]
pub(crate) struct GradeArgs {
    /// The lab, as `kinemark labs` names it
    pub(crate) lab: String,
    /// The submission
    pub(crate) submission: PathBuf,
    /// Folder to write to; an earlier report there is replaced
    #[arg(long, short, value_name = "DIR", default_value = "out")]
    pub(crate) out: PathBuf,
    /// Print the grade record as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Run the submission in this process: for profiling trusted code
    #[arg(long)]
    pub(crate) in_process: bool,
    #[command(flatten)]
    pub(crate) places: PlaceArgs,
    #[command(flatten)]
    pub(crate) staff: StaffArgs,
}

/// Grade a report's submission again and compare every digest
#[derive(Debug, ClapArgs)]
#[command(after_help = "Example:\n  kinemark verify out\n\n\
    Uses the copies of lab, robot and submission inside the folder.\n\
    Exit codes: 0 same bits, 1 something differs, 2 usage, 3 the folder is no report, 4 the grader or this machine failed.")]
pub(crate) struct VerifyArgs {
    /// The output folder of `kinemark grade`
    #[arg(default_value = "out")]
    pub(crate) folder: PathBuf,
    /// Print the comparison as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) places: PlaceArgs,
    #[command(flatten)]
    pub(crate) staff: StaffArgs,
}

/// List the labs
#[derive(Debug, ClapArgs)]
pub(crate) struct LabsArgs {
    /// Print the list as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) places: PlaceArgs,
}

/// Start a lab: writes its starter and its brief into a folder
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Example:\n  kinemark new 01-kinematics\n  cd 01-kinematics\n  kinemark grade 01-kinematics submission.rhai"
)]
pub(crate) struct NewArgs {
    /// The lab, as `kinemark labs` names it
    pub(crate) lab: String,
    /// Folder to write to [default: the lab's name]
    pub(crate) dir: Option<PathBuf>,
    /// Print what was written as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) places: PlaceArgs,
}

#[derive(Debug, Subcommand)]
pub(crate) enum RobotCommand {
    Eval(EvalArgs),
}

/// Answer requests about a robot: one JSON object per line in, one per line out
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Example:\n  echo '{\"id\": 1, \"op\": \"fk\", \"q\": [0.3, -1.2]}' | kinemark robot eval labs/robots/rrbot.toml\n\n\
    Operations: info, fk, jacobian, rnea, bias, crba, aba, energy, simulate. See docs/robot-eval.md.\n\
    Exit codes: 0 every request answered, 1 some answered with an error, 2 usage, 3 the robot is broken."
)]
pub(crate) struct EvalArgs {
    /// A robot file, or the name of a robot of the labs
    pub(crate) robot: PathBuf,
    #[command(flatten)]
    pub(crate) places: PlaceArgs,
}

/// Print shell completions
#[derive(Debug, ClapArgs)]
#[command(
    after_help = "Example:\n  kinemark completions bash > ~/.local/share/bash-completion/completions/kinemark"
)]
pub(crate) struct CompletionsArgs {
    /// The shell
    pub(crate) shell: clap_complete::Shell,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_commands_are_consistent() {
        use clap::CommandFactory as _;
        Args::command().debug_assert();
    }

    /// The reference of the command line is that of the code; `KINEMARK_BLESS=1` writes it anew.
    #[test]
    fn the_published_reference_is_current() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/cli.md");
        let options = clap_markdown::MarkdownOptions::new()
            .title("The command line".to_owned())
            .show_footer(false);
        let text = clap_markdown::help_markdown_custom::<Args>(&options);
        let text = text.trim_end().to_owned() + "\n";
        if std::env::var_os("KINEMARK_BLESS").is_some() {
            std::fs::write(path, &text).unwrap();
        }
        let published = std::fs::read_to_string(path).unwrap_or_default();
        assert!(
            published == text,
            "docs/cli.md: run KINEMARK_BLESS=1 cargo test"
        );
    }
}
