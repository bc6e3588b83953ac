//! `kinemark lab fill`: what a lab's files take from its reference solution, written anew: what visible cases expect, `practice.json`, the
//! table of points and the numbers in the brief, and the plots that it shows.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use indicatif::ProgressBar;
use kinemark_grader::audit::{PracticeError, practice_forms};
use kinemark_grader::lab::brief::{with_grading, with_numbers};
use kinemark_grader::lab::practice::{PRACTICE_FILE, PRACTICE_VARIANTS, file_text};
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::task::files::{Files, UNREAD_HELP};
use serde::Serialize;

use crate::brief_plots::brief_plots;
use crate::disk::Folder;
use crate::failure::Failure;
use crate::labs_folder::{self, LabsFolderArgs};
use crate::output;
use crate::staff_folder::{self, StaffPart};
use crate::visible_expected::Waiting;

/// Write what a lab's files take from its reference solution: expected answers, practice.json, the brief's table, numbers and plots
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Example:\n  kinemark lab fill 01-kinematics\n\n\
    A visible case of a function of the lab's own that does not say what is `expected` gets what the solution answers; --expected writes \
    all of them anew.\n\n\
    practice.json is what students get of the reference solution: the values that it reaches in checks that compare with it, and \
    the path of its TCP where the lab says where the TCP should go; in the default variant and in 20 practice variants. It holds no \
    code and no command.\n\n\
    In the brief it writes the table of points and the numbers, and it draws the plots that the brief shows: plot-PLOT.svg of the \
    solution's run, plot-PLOT-by-MUTANT.svg of a mutant's, where PLOT is the name of a file in plots/ of a report.\n\n\
    Run this after every change of the lab or of the solution; `kinemark lab check` says when it is needed. \
    The solution runs in this process: only fill labs of people you trust.\n\
    Exit codes: 0 done, 2 usage, 3 the lab or its solution is broken, 4 a file cannot be written.")]
pub(crate) struct Args {
    /// The lab, as `kinemark` lists it
    pub(crate) lab: String,
    /// Write what is expected in all visible cases of functions of the lab's own anew, not only where it is missing
    #[arg(long)]
    pub(crate) expected: bool,
    /// Print what was written as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Folder of the course staff's part [default: `reference` beside the labs folder] [env: KINEMARK_REFERENCE]
    #[arg(
        long,
        value_name = "DIR",
        default_value = crate::environment::reference(),
        hide_default_value = true
    )]
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
    let name = labs_folder::full_name(files.as_ref(), &args.lab)?;
    let Some(labs_folder) = labs_folder else {
        return Err(Failure::usage(
            "the labs that are built into kinemark cannot be written to".to_owned(),
            "run this where the folder `labs` is, or name it with --labs DIR",
        ));
    };
    let mut filled = Filled {
        lab: &name,
        written: Vec::new(),
        removed: Vec::new(),
        current: Vec::new(),
    };
    let done = fill(args, files.as_ref(), &labs_folder, &mut filled);
    if done.is_err() && !args.json {
        // what was written before stays
        output::print(&lines(&[
            ("wrote", &filled.written),
            ("removed", &filled.removed),
        ]))?;
    }
    done?;
    if args.json {
        output::print_formatted(&filled)?;
    } else {
        output::print(&lines(&[
            ("wrote", &filled.written),
            ("removed", &filled.removed),
            ("as it should be:", &filled.current),
        ]))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// A line for each path, each with the word of its list.
fn lines(all: &[(&str, &Vec<PathBuf>)]) -> String {
    let lines = all.iter().flat_map(|(word, paths)| {
        let line = move |path: &PathBuf| format!("{word} {}\n", output::path(path));
        paths.iter().map(line)
    });
    lines.collect()
}

/// Writes one file after the other, each from what the ones before say.
fn fill(
    args: &Args,
    files: &dyn Files,
    labs_folder: &Path,
    filled: &mut Filled<'_>,
) -> Result<(), Failure> {
    let name = filled.lab;
    let folder = labs_folder.join(name);
    if let Some(text) = expected(args, files, name, labs_folder)? {
        put(filled, &folder.join("lab.toml"), &text)?;
    }
    let lab = Lab::load(files, name)?;
    let staff = staff(args, &lab, labs_folder)?;
    let practice = practice_text(files, &lab, &staff)?;
    put(filled, &folder.join(PRACTICE_FILE), &practice)?;
    // the table names what the reference reaches, so it follows what was just written
    let lab = Lab::load(files, name)?;
    let path = format!("{name}/brief.md");
    if let Some(brief) = text_at(files, &path)? {
        let brief = with_numbers(&with_grading(&brief, &lab), &lab)
            .map_err(|why| Failure::broken(format!("{path}: {why}"), "correct the brief"))?;
        put(filled, &folder.join("brief.md"), &brief)?;
        let plots = brief_plots(&brief, &lab, &staff)
            .map_err(|none| Failure::broken(format!("{path}: {none}"), &none.help))?;
        for (picture, svg) in plots {
            put(filled, &folder.join(picture), &svg)?;
        }
    }
    Ok(())
}

/// The text at a path of the labs folder.
fn text_at(files: &dyn Files, path: &str) -> Result<Option<String>, Failure> {
    files
        .read(path)
        .map_err(|why| Failure::broken(format!("{path}: {why}"), UNREAD_HELP))
}

/// The text of lab.toml with what the solution answers in visible cases, where it says so for none of them yet.
fn expected(
    args: &Args,
    files: &dyn Files,
    name: &str,
    labs_folder: &Path,
) -> Result<Option<String>, Failure> {
    let path = format!("{name}/lab.toml");
    let text = text_at(files, &path)?.unwrap_or_default();
    let Some(waiting) = Waiting::find(&path, &text, args.expected) else {
        return Ok(None);
    };
    let lab = waiting.lab(files, name)?;
    // what it answers says in which shape, so that nothing else of the course staff's part can be tried before
    let solution = untried(args, &lab, labs_folder)?.solution;
    let text = waiting.filled(&lab, &solution);
    let help = "correct `solution.rhai`, or write `expected` yourself";
    text.map(Some)
        .map_err(|unfilled| Failure::broken(unfilled.to_string(), help))
}

/// The course staff's part of the lab, whose code was not tried yet.
fn untried(args: &Args, lab: &Lab, labs_folder: &Path) -> Result<Staff, Failure> {
    let reference = folder_of_staff(args, labs_folder)?;
    Staff::load(&reference, lab, None)?.ok_or_else(|| no_solution(&reference, lab))
}

/// The course staff's part of the lab.
fn staff(args: &Args, lab: &Lab, labs_folder: &Path) -> Result<Staff, Failure> {
    let reference = folder_of_staff(args, labs_folder)?;
    staff_folder::staff(&reference, lab, None)?.ok_or_else(|| no_solution(&reference, lab))
}

fn folder_of_staff(args: &Args, labs_folder: &Path) -> Result<Folder, Failure> {
    let from = StaffPart::in_folder(args.reference.clone());
    let help = "give the course staff's folder";
    staff_folder::part(&from, Some(labs_folder), help)?.ok_or_else(|| {
        Failure::usage(
            "there is no folder `reference` beside the labs".to_owned(),
            "a lab is filled from its reference solution: give its folder with --reference DIR",
        )
    })
}

fn no_solution(reference: &Folder, lab: &Lab) -> Failure {
    Failure::usage(
        staff_folder::no_solution(reference, lab),
        "write it, or give another folder with --reference DIR",
    )
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
