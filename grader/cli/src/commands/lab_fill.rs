//! `kinemark lab fill`: what a lab's files take from its reference solution, written anew: `practice.json`, and the table of points and
//! the numbers in the brief.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use indicatif::ProgressBar;
use kinemark_grader::audit::{PracticeError, practice_forms};
use kinemark_grader::lab::brief::{with_grading, with_numbers};
use kinemark_grader::lab::practice::{PRACTICE_FILE, PRACTICE_VARIANTS, file_text};
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::task::files::{Files, UNREAD_HELP};
use serde::Serialize;

use crate::failure::Failure;
use crate::labs_folder::{self, LabsFolderArgs};
use crate::output;
use crate::staff_folder::{self, StaffPart};

/// Write what a lab's files take from its reference solution: practice.json, and the table and numbers of the brief
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Example:\n  kinemark lab fill 01-kinematics\n\n\
    practice.json is what students get of the reference solution: the values that it reaches in checks that compare with it, and \
    the path of its TCP where the lab says where the TCP should go; in the default variant and in 20 practice variants. It holds no \
    code and no command. Run this after every change of the lab or of the solution; `kinemark lab check` says when it is needed. \
    The solution runs in this process: only fill labs of people you trust.\n\
    Exit codes: 0 done, 2 usage, 3 the lab or its solution is broken, 4 a file cannot be written.")]
pub(crate) struct Args {
    /// The lab, as `kinemark` lists it
    pub(crate) lab: String,
    /// Print what was written as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Folder of the course staff's part [default: `reference` beside the labs folder]
    #[arg(long, value_name = "DIR")]
    pub(crate) reference: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
}

#[derive(Serialize)]
struct Filled<'a> {
    lab: &'a str,
    /// Files that were written.
    written: Vec<PathBuf>,
    /// Files that had nothing to say any more.
    removed: Vec<PathBuf>,
    /// Files that were as they should be.
    current: Vec<PathBuf>,
}

/// Runs the solution and writes.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let (files, labs_folder) = labs_folder::open(&args.labs_folder)?;
    let lab = Lab::load(
        files.as_ref(),
        &labs_folder::full_name(files.as_ref(), &args.lab)?,
    )?;
    let Some(labs_folder) = labs_folder else {
        return Err(Failure::usage(
            "the labs that are built into kinemark cannot be written to".to_owned(),
            "run this where the folder `labs` is, or name it with --labs DIR",
        ));
    };
    let staff = staff(args, &lab, &labs_folder)?;
    let practice = practice_text(files.as_ref(), &lab, &staff)?;
    let folder = labs_folder.join(&lab.name);
    let mut filled = Filled {
        lab: &lab.name,
        written: Vec::new(),
        removed: Vec::new(),
        current: Vec::new(),
    };
    put(&mut filled, &folder.join(PRACTICE_FILE), &practice)?;
    // the table names what the reference reaches, so it follows what was just written
    let lab = Lab::load(
        files.as_ref(),
        &labs_folder::full_name(files.as_ref(), &args.lab)?,
    )?;
    let path = format!("{}/brief.md", lab.name);
    let brief = files
        .read(&path)
        .map_err(|why| Failure::broken(format!("{path}: {why}"), UNREAD_HELP))?;
    if let Some(brief) = brief {
        let brief = with_numbers(&with_grading(&brief, &lab), &lab)
            .map_err(|why| Failure::broken(format!("{path}: {why}"), "correct the brief"))?;
        put(&mut filled, &folder.join("brief.md"), &brief)?;
    }
    if args.json {
        output::print_json(&filled)?;
    } else {
        let all = [
            ("wrote", &filled.written),
            ("removed", &filled.removed),
            ("as it should be:", &filled.current),
        ];
        let lines = all.into_iter().flat_map(|(word, paths)| {
            paths
                .iter()
                .map(move |path| format!("{word} {}\n", output::path(path)))
        });
        output::print(&lines.collect::<String>())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The course staff's part of the lab.
fn staff(args: &Args, lab: &Lab, labs_folder: &Path) -> Result<Staff, Failure> {
    let from = StaffPart {
        reference: args.reference.clone(),
        salt: None,
    };
    let help = "give the course staff's folder";
    let reference = staff_folder::part(&from, Some(labs_folder), help)?.ok_or_else(|| {
        Failure::usage(
            "there is no folder `reference` beside the labs".to_owned(),
            "a lab is filled from its reference solution: give its folder with --reference DIR",
        )
    })?;
    staff_folder::staff(&reference, lab, None)?.ok_or_else(|| {
        Failure::usage(
            staff_folder::no_solution(&reference, lab),
            "write it, or give another folder with --reference DIR",
        )
    })
}

/// The text of `practice.json`; nothing where it has nothing to say.
fn practice_text(files: &dyn Files, lab: &Lab, staff: &Staff) -> Result<String, Failure> {
    let count = if lab.variants.is_empty() {
        1
    } else {
        1 + PRACTICE_VARIANTS
    };
    let progress = ProgressBar::new(count.into());
    let forms = practice_forms(files, lab, staff, &|| progress.inc(1));
    progress.finish_and_clear();
    let forms = forms.map_err(|error| match error {
        PracticeError::Load(error) => (*error).into(),
        solution @ PracticeError::Solution { .. } => {
            Failure::broken(solution.to_string(), "correct `solution.rhai`")
        }
    })?;
    file_text(&forms).map_err(|error| {
        Failure::broken(
            format!("{PRACTICE_FILE}: {error}"),
            "correct `solution.rhai`",
        )
    })
}

/// Writes `text` where it differs; an empty one removes the file.
fn put(filled: &mut Filled<'_>, path: &Path, text: &str) -> Result<(), Failure> {
    let help = "free some space, or make the folder writable";
    match std::fs::read_to_string(path) {
        Ok(present) if present == text => filled.current.push(path.to_owned()),
        Ok(_) if text.is_empty() => {
            std::fs::remove_file(path).map_err(|error| output::unwritten(path, &error, help))?;
            filled.removed.push(path.to_owned());
        }
        Err(_) if text.is_empty() => {}
        _ => {
            output::write_file(path, text.as_bytes(), help)?;
            filled.written.push(path.to_owned());
        }
    }
    Ok(())
}
