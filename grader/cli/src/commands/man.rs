//! `kinemark man`: the manual pages, one a command.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Command, CommandFactory as _};
use clap_mangen::Man;

use crate::command_line::CommandLine;
use crate::failure::Failure;
use crate::output;

/// Write the manual pages, one a command
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example:\n  kinemark man --out ~/.local/share/man/man1\n  man kinemark-grade"
)]
pub(crate) struct Args {
    /// Folder to write to; pages there are replaced
    #[arg(long, short, value_name = "DIR")]
    pub(crate) out: PathBuf,
}

/// Writes them.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let help = "choose another folder with --out";
    std::fs::create_dir_all(&args.out)
        .map_err(|error| output::unwritten(&args.out, &error, help))?;
    let pages = pages();
    for (name, page) in &pages {
        output::write_file(&args.out.join(name), page, help)?;
    }
    let folder = output::path(&args.out);
    output::print(&format!("wrote {} pages to {folder}\n", pages.len()))?;
    Ok(ExitCode::SUCCESS)
}

/// The pages by the names of their files.
fn pages() -> Vec<(String, Vec<u8>)> {
    // a page is the same in every checkout
    let mut command = CommandLine::command()
        .version(env!("CARGO_PKG_VERSION"))
        .disable_help_subcommand(true);
    command.build();
    let mut pages = Vec::new();
    push(&command, &mut pages);
    pages
}

fn push(command: &Command, pages: &mut Vec<(String, Vec<u8>)>) {
    let page = Man::new(command.clone()).manual("Kinemark");
    let mut text = Vec::new();
    // a vector takes everything
    let _ = page.render(&mut text);
    pages.push((page.get_filename(), text));
    let shown = command
        .get_subcommands()
        .filter(|inner| !inner.is_hide_set());
    for inner in shown {
        push(inner, pages);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_has_a_page_and_those_not_for_people_have_none() {
        let pages = pages();
        let has = |name: &str| pages.iter().any(|(page, _)| page == name);
        for name in ["kinemark.1", "kinemark-grade.1", "kinemark-lab-check.1"] {
            assert!(has(name), "{name}");
        }
        assert!(!has("kinemark-worker.1"));
        for (name, page) in &pages {
            let text = String::from_utf8_lossy(page);
            assert!(text.contains(".SH SYNOPSIS"), "{name}: {text}");
        }
    }
}
