//! The commands as one tree, in the order in which help lists them, and which function runs each.

use std::ffi::OsStr;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::build_info;
use crate::commands::{
    autograder, compare, completions, course_check, course_explain, course_forget, course_grade,
    course_page, course_regrade, course_release, course_status, doctor, grade, hint, lab_check,
    lab_draws, lab_fill, lab_list, lab_new, lab_pack, lab_schema, lab_variant, log_export, man,
    new, robot_convert, robot_eval, robot_response, robot_show, scene_check, submit, verify,
    version, view, watch,
};
use crate::failure::Failure;
use crate::typed_words::ColorArgs;
use crate::worker;

/// Grades robotics coursework: the same bits everywhere, every lost point explained. Without a command it lists the labs.
#[derive(Debug, Parser)]
#[command(name = "kinemark", version = build_info::version(), max_term_width = 100)]
#[command(args_conflicts_with_subcommands = true)]
#[command(after_help = "Start with `kinemark new 00-step-response`.\n\
    Exit codes: 0 full marks or done, 1 points lost or answers with errors, 2 usage, 3 the lab, robot or scene is broken, \
    4 the grader or this machine failed, 5 verified only in part.")]
pub(crate) struct CommandLine {
    #[command(flatten)]
    lab_list: lab_list::Args,
    #[command(flatten)]
    color: ColorArgs,
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    New(new::Args),
    Grade(grade::Args),
    Hint(hint::Args),
    Watch(watch::Args),
    View(view::Args),
    Compare(compare::Args),
    Submit(submit::Args),
    Verify(verify::Args),
    /// Show, convert or query a robot: kinematics, dynamics, simulation, step responses
    #[command(subcommand)]
    Robot(RobotCommand),
    /// Check a scene
    #[command(subcommand)]
    Scene(SceneCommand),
    /// Read the log of a run
    #[command(subcommand)]
    Log(LogCommand),
    /// Start a lab, check it, list what is hidden in it, generate a student's variant of it, or pack it to hand out: for course staff
    #[command(subcommand)]
    Lab(LabCommand),
    /// Grade a class: from what the LMS exported to what it takes back: for course staff
    #[command(subcommand)]
    Course(CourseCommand),
    Doctor(doctor::Args),
    Completions(completions::Args),
    Man(man::Args),
    Version(version::Args),
    /// Runs a submission for another process; not for people
    #[command(hide = true)]
    Worker(worker::Args),
    /// Grades an upload for Gradescope; not for people
    #[command(hide = true)]
    Autograder(autograder::Args),
}

#[derive(Debug, Subcommand)]
pub(crate) enum RobotCommand {
    Show(robot_show::Args),
    Convert(robot_convert::Args),
    Eval(robot_eval::Args),
    // much larger than the others
    Response(Box<robot_response::Args>),
}

#[derive(Debug, Subcommand)]
pub(crate) enum SceneCommand {
    Check(scene_check::Args),
}

#[derive(Debug, Subcommand)]
pub(crate) enum LogCommand {
    Export(log_export::Args),
}

#[derive(Debug, Subcommand)]
pub(crate) enum LabCommand {
    New(lab_new::Args),
    Check(lab_check::Args),
    Draws(lab_draws::Args),
    Fill(lab_fill::Args),
    Variant(lab_variant::Args),
    Schema(lab_schema::Args),
    Pack(lab_pack::Args),
}

#[derive(Debug, Subcommand)]
pub(crate) enum CourseCommand {
    Check(course_check::Args),
    Grade(course_grade::Args),
    Status(course_status::Args),
    Explain(course_explain::Args),
    Page(course_page::Args),
    Regrade(course_regrade::Args),
    Release(course_release::Args),
    Forget(course_forget::Args),
}

impl CommandLine {
    /// Runs what was typed.
    pub(crate) fn run(self) -> Result<ExitCode, Failure> {
        let Some(command) = self.command else {
            return lab_list::run(&self.lab_list);
        };
        match command {
            Command::New(args) => new::run(&args),
            Command::Grade(args) => grade::run(&args),
            Command::Hint(args) => hint::run(&args),
            Command::Watch(args) => watch::run(&args),
            Command::View(args) => view::run(&args),
            Command::Compare(args) => compare::run(&args),
            Command::Submit(args) => submit::run(&args),
            Command::Verify(args) => verify::run(&args),
            Command::Robot(RobotCommand::Show(args)) => robot_show::run(&args),
            Command::Robot(RobotCommand::Convert(args)) => robot_convert::run(&args),
            Command::Robot(RobotCommand::Eval(args)) => robot_eval::run(&args),
            Command::Robot(RobotCommand::Response(args)) => robot_response::run(&args),
            Command::Scene(SceneCommand::Check(args)) => scene_check::run(&args),
            Command::Log(LogCommand::Export(args)) => log_export::run(&args),
            Command::Lab(LabCommand::New(args)) => lab_new::run(&args),
            Command::Lab(LabCommand::Check(args)) => lab_check::run(&args),
            Command::Lab(LabCommand::Draws(args)) => lab_draws::run(&args),
            Command::Lab(LabCommand::Fill(args)) => lab_fill::run(&args),
            Command::Lab(LabCommand::Variant(args)) => lab_variant::run(&args),
            Command::Lab(LabCommand::Schema(args)) => lab_schema::run(&args),
            Command::Lab(LabCommand::Pack(args)) => lab_pack::run(&args),
            Command::Course(CourseCommand::Check(args)) => course_check::run(&args),
            Command::Course(CourseCommand::Grade(args)) => course_grade::run(&args),
            Command::Course(CourseCommand::Explain(args)) => course_explain::run(&args),
            Command::Course(CourseCommand::Page(args)) => course_page::run(&args),
            Command::Course(CourseCommand::Release(args)) => course_release::run(&args),
            Command::Course(CourseCommand::Forget(args)) => course_forget::run(&args),
            Command::Course(CourseCommand::Regrade(args)) => course_regrade::run(&args),
            Command::Course(CourseCommand::Status(args)) => course_status::run(&args),
            Command::Doctor(args) => doctor::run(&args),
            Command::Completions(args) => completions::run(&args),
            Command::Man(args) => man::run(&args),
            Command::Version(args) => version::run(&args),
            // it never comes here: `main` starts it before any thread
            Command::Worker(args) => Ok(worker::serve(&args)),
            Command::Autograder(args) => autograder::run(&args),
        }
    }
}

/// Commands that have another name now.
const RENAMED: [(&str, &str); 3] = [
    ("export", "kinemark log export"),
    ("labs", "kinemark"),
    ("variant", "kinemark lab variant"),
];

/// Refuses the first word typed if a command once had that name, and says its name of today.
///
/// # Errors
/// Exit code 2 with the new name.
pub(crate) fn refuse_renamed(first: Option<&OsStr>) -> Result<(), Failure> {
    let renamed = RENAMED
        .iter()
        .find(|(old, _)| first == Some(OsStr::new(old)));
    let Some((old, new)) = renamed else {
        return Ok(());
    };
    Err(Failure::usage(
        format!("`kinemark {old}` is now `{new}`"),
        &format!("`{new} --help` shows its options"),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_commands_are_consistent() {
        use clap::CommandFactory as _;
        CommandLine::command().debug_assert();
    }

    #[test]
    fn a_renamed_command_says_its_new_name() {
        for (old, new) in RENAMED {
            let words = new.split_whitespace().chain(["--help"]);
            let help = CommandLine::try_parse_from(words).unwrap_err();
            assert_eq!(help.kind(), clap::error::ErrorKind::DisplayHelp, "{new}");
            assert!(refuse_renamed(Some(OsStr::new(old))).is_err());
        }
        assert!(refuse_renamed(Some(OsStr::new("grade"))).is_ok());
        assert!(refuse_renamed(None).is_ok());
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
