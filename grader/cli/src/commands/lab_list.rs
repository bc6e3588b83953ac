//! `kinemark` without a command: which labs there are, and what to do next.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use kinemark_course::working_folder::{FOLDER_FILE, FolderFile, SUBMISSION_FILE};
use kinemark_grader::lab::{Lab, load::lab_names};
use kinemark_grader::record::quantity::points;
use kinemark_sim::text::Source;
use serde::Serialize;

use crate::error_record::ErrorRecord;
use crate::failure::Failure;
use crate::history::History;
use crate::labs_folder::{self, LabsFolderArgs};
use crate::{disk, output};

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
    /// The folder here in which this lab is worked on.
    #[serde(skip_serializing_if = "Option::is_none")]
    folder: Option<PathBuf>,
    /// The best points in that folder so far.
    #[serde(skip_serializing_if = "Option::is_none")]
    best: Option<f64>,
}

/// The list for programs.
#[derive(Serialize)]
struct Listed<'a> {
    labs: &'a [Row],
    /// What is wrong with labs that cannot be read.
    broken: Vec<ErrorRecord>,
}

/// Such a file has two lines.
const MOST_FOLDER_FILE_BYTES: u64 = 1 << 16;

/// Folders here that `kinemark new` has made, by lab.
fn working_folders() -> BTreeMap<String, PathBuf> {
    let mut found = BTreeMap::new();
    let Ok(entries) = std::fs::read_dir(".") else {
        return found;
    };
    let mut folders: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    folders.sort();
    for folder in folders {
        let bytes = disk::bytes_of(&folder.join(FOLDER_FILE), MOST_FOLDER_FILE_BYTES);
        let text = bytes.ok().and_then(|bytes| String::from_utf8(bytes).ok());
        if let Some(Ok(file)) = text.map(|text| FolderFile::parse(&Source::new(FOLDER_FILE, text)))
        {
            let shown = folder.strip_prefix(".").unwrap_or(&folder).to_owned();
            found.entry(file.lab).or_insert(shown);
        }
    }
    found
}

/// The best points in a folder so far.
fn best_in(folder: &Path, lab: &str) -> Option<f64> {
    let (history, _) = History::beside(&folder.join(SUBMISSION_FILE))?;
    history.best(lab)
}

impl Row {
    /// How far the lab is, where it is worked on here.
    fn progress(&self) -> Option<String> {
        let folder = self.folder.as_ref()?;
        let shown = output::path(folder);
        Some(match self.best {
            None => format!("begun in {shown}"),
            Some(best) if best >= self.points => format!("done in {shown}: all points"),
            Some(best) => format!(
                "best in {shown}: {} of {}",
                points(best),
                points(self.points)
            ),
        })
    }

    fn is_done(&self) -> bool {
        self.best.is_some_and(|best| best >= self.points)
    }
}

/// What to do next: a lab that is begun and not done, else the first in order that is not.
fn next(rows: &[Row]) -> String {
    let is_begun = rows.iter().any(|row| row.folder.is_some());
    let mut open = rows.iter().filter(|row| !row.is_done());
    let first = open.clone().next();
    match open.find(|row| row.folder.is_some()).or(first) {
        Some(row) if is_begun => match &row.folder {
            Some(folder) => format!(
                "\nNext: go on with {}: `cd {}`, then `kinemark grade`.\n",
                row.name,
                output::path(folder)
            ),
            None => format!("\nNext: `kinemark new {}`.\n", row.name),
        },
        Some(row) => format!(
            "\nWork through them in this order. Start with `kinemark new {}`.\n",
            row.name
        ),
        None => "\nAll labs have all their points.\n".to_owned(),
    }
}

/// Lists the labs; each broken one is reported after them, with its position.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let (files, _) = labs_folder::open(&args.labs_folder)?;
    let mut folders = working_folders();
    let mut rows = Vec::new();
    let mut broken = Vec::new();
    for name in lab_names(files.as_ref()) {
        let lab = match Lab::load(files.as_ref(), &name) {
            Ok(lab) => lab,
            Err(error) => {
                broken.push(Failure::from(error));
                continue;
            }
        };
        let folder = folders.remove(&name);
        rows.push(Row {
            best: folder.as_ref().and_then(|folder| best_in(folder, &name)),
            folder,
            points: lab.tasks.iter().map(|task| task.max_points()).sum(),
            tasks: lab.tasks.iter().map(|task| task.name.clone()).collect(),
            title: lab.title,
            summary: lab.summary,
            name,
        });
    }
    if args.json {
        output::print_formatted(&Listed {
            labs: &rows,
            broken: broken.iter().map(Failure::record).collect(),
        })?;
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
            if let Some(progress) = row.progress() {
                text += &format!("{:<width$} {progress}\n", "");
            }
        }
        if rows.is_empty() && broken.is_empty() {
            text = format!(
                "no folder in {} has a lab.toml\n  help: give the folder that holds the labs\n",
                files.name()
            );
        } else if !rows.is_empty() {
            text += &next(&rows);
        }
        output::print_lines(&text)?;
    }
    // list the labs that load first: a broken one hides no other
    let mut code = ExitCode::SUCCESS;
    for error in broken {
        code = error.report_for_people();
    }
    Ok(code)
}
