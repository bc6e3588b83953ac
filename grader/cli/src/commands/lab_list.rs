//! `kinemark` without a command: which labs there are, and what to do next.

use std::process::ExitCode;

use kinemark_grader::lab::{Lab, load::lab_names};
use kinemark_grader::record::quantity::points;
use serde::Serialize;

use crate::failure::Failure;
use crate::labs_folder::{self, LabsFolderArgs};
use crate::output;

/// What the list of labs can be asked for.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Print the list as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
}

#[derive(Serialize)]
struct Row {
    name: String,
    title: String,
    summary: String,
    tasks: Vec<String>,
    points: f64,
}

/// Lists the labs; each broken one is reported after them, with its position.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let (files, _) = labs_folder::open(&args.labs_folder)?;
    let mut rows = Vec::new();
    let mut broken = Vec::new();
    for name in lab_names(files.as_ref()) {
        let lab = match Lab::load(files.as_ref(), &name) {
            Ok(lab) => lab,
            Err(error) => {
                broken.push(error);
                continue;
            }
        };
        rows.push(Row {
            points: lab.tasks.iter().map(|task| task.max_points()).sum(),
            tasks: lab.tasks.iter().map(|task| task.name.clone()).collect(),
            title: lab.title,
            summary: lab.summary,
            name,
        });
    }
    if args.json {
        output::print_json(&rows)?;
    } else {
        let mut text = String::new();
        // one that is short leaves the titles where they always were
        let names = rows.iter().map(|row| row.name.chars().count());
        let width = names.max().unwrap_or(0).max(16);
        for row in &rows {
            text += &format!(
                "{:<width$} {}\n{:<width$} {}\n{:<width$} {} points: {}\n",
                row.name,
                row.title,
                "",
                row.summary,
                "",
                points(row.points),
                row.tasks.join(", ")
            );
        }
        if rows.is_empty() && broken.is_empty() {
            text = format!(
                "no folder in {} has a lab.toml\n  help: give the folder that holds the labs\n",
                files.name()
            );
        } else if !rows.is_empty() {
            text += "\nStart one with `kinemark new NAME`.\n";
        }
        output::print(&text)?;
    }
    // list the labs that load first: a broken one hides no other
    let mut code = ExitCode::SUCCESS;
    for error in broken {
        code = Failure::from(error).report();
    }
    Ok(code)
}
