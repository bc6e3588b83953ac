//! `kinemark completions`: what a shell needs to complete the command.

use std::process::ExitCode;

use clap::builder::PossibleValuesParser;
use clap::{Command, CommandFactory as _};
use kinemark_grader::lab::load::lab_names;
use kinemark_grader::task::files::Files;
use kinemark_grader::task::robot::robot_names;

use crate::command_line::CommandLine;
use crate::failure::Failure;
use crate::labs_folder::{self, LabsFolderArgs};
use crate::output;

/// Print shell completions, with the names of labs, robots and scenes
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example:\n  kinemark completions bash > ~/.local/share/bash-completion/completions/kinemark\n\n\
    Labs, robots and scenes are those of --labs: run it again when the course has a new one."
)]
pub(crate) struct Args {
    /// The shell
    pub(crate) shell: clap_complete::Shell,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
}

/// The names that are completed.
struct Names {
    labs: Vec<&'static str>,
    robots: Vec<&'static str>,
    scenes: Vec<&'static str>,
}

impl Names {
    fn of(files: &dyn Files) -> Self {
        // a command line keeps the names of values as long as the program runs
        let kept = |names: Vec<String>| names.into_iter().map(|name| &*name.leak()).collect();
        let scenes = files.list("scenes").into_iter();
        let scenes = scenes.filter_map(|file| Some(file.strip_suffix(".toml")?.to_owned()));
        Self {
            labs: kept(lab_names(files)),
            robots: kept(robot_names(files)),
            scenes: kept(scenes.collect()),
        }
    }

    /// What the argument `name` can be, if that is known.
    fn of_argument(&self, name: &str) -> Option<&[&'static str]> {
        let names = match name {
            "lab" => &self.labs,
            "robot" => &self.robots,
            "scene" => &self.scenes,
            _ => return None,
        };
        (!names.is_empty()).then_some(names)
    }

    /// The command with these names in it, and in what is below it.
    fn put_into(&self, command: Command) -> Command {
        let command = command.mut_args(|arg| match self.of_argument(arg.get_id().as_str()) {
            Some(names) => arg.value_parser(PossibleValuesParser::new(names)),
            None => arg,
        });
        let below = command
            .get_subcommands()
            .map(|below| below.get_name().to_owned());
        let below: Vec<String> = below.collect();
        below.into_iter().fold(command, |command, name| {
            command.mut_subcommand(name, |below| self.put_into(below))
        })
    }
}

/// Prints the completions.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let (files, _) = labs_folder::open(&args.labs_folder)?;
    output::print(&script(args.shell, files.as_ref()))?;
    Ok(ExitCode::SUCCESS)
}

fn script(shell: clap_complete::Shell, files: &dyn Files) -> String {
    let mut command = Names::of(files).put_into(CommandLine::command());
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut command, "kinemark", &mut script);
    String::from_utf8_lossy(&script).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::ValueEnum as _;

    #[test]
    fn every_shell_knows_the_labs_the_robots_and_the_scenes() {
        let files = labs_folder::built_in();
        let names = Names::of(&files);
        for shell in clap_complete::Shell::value_variants() {
            let script = script(*shell, &files);
            for list in [&names.labs, &names.robots, &names.scenes] {
                assert!(!list.is_empty());
                // PowerShell's and Elvish's scripts have no values of arguments
                let has_values = !matches!(
                    shell,
                    clap_complete::Shell::PowerShell | clap_complete::Shell::Elvish
                );
                for name in list.iter().filter(|_| has_values) {
                    assert!(script.contains(name), "{shell}: {name}");
                }
            }
        }
    }
}
