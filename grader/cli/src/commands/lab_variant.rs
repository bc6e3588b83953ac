//! `kinemark lab variant`: a student's variant of a lab, as the file that goes with it.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;

use kinemark_grader::lab::{Lab, Variant};
use kinemark_sim::text::Dimension;
use serde::Serialize;

use crate::error_record::ErrorCode;
use crate::failure::{self, Failure};
use crate::labs_folder::{self, LabsFolderArgs};
use crate::staff_folder::{self, StaffPart};
use crate::{chosen_variant, enclosing_course, output};

/// Generate one student's variant of a lab: for course staff
#[derive(Debug, Clone, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark lab variant 04-knock-with-velocity --student s1234567\n  \
    kinemark lab variant 04-knock-with-velocity --student s1234567 --out s1234567/variant.toml\n\n\
    Needs the course's salt: from the course staff's hidden.toml, or --salt. The same salt, lab and student give the same \
    variant everywhere.\n\
    Exit codes: 0 done, 2 usage, 3 the lab is broken, 4 the file cannot be written."
)]
pub(crate) struct Args {
    /// The lab, as `kinemark` lists it
    pub(crate) lab: String,
    /// The student's id, exactly as the course writes it
    #[arg(long, value_name = "ID")]
    pub(crate) student: String,
    /// File to write [default: standard output]
    #[arg(long, short, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
    /// Print the parameters as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
    #[command(flatten)]
    pub(crate) staff: StaffPart,
}

#[derive(Serialize)]
struct Printed<'a> {
    lab: &'a str,
    student: &'a str,
    parameters: BTreeMap<&'a str, &'a Dimension>,
}

/// Computes, and writes or prints.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let mut args = args.clone();
    let filled = enclosing_course::fill(&args.lab, &mut args.labs_folder, &mut args.staff)?;
    if let Some(filled) = filled {
        failure::note_in_words(&filled.note);
    }
    let args = &args;
    let (files, labs_folder) = labs_folder::open(&args.labs_folder)?;
    let lab = Lab::load(
        files.as_ref(),
        &labs_folder::full_name(files.as_ref(), &args.lab)?,
    )?;
    let help = "give the folder that holds LAB/hidden.toml, or --salt TEXT";
    let reference = staff_folder::part(&args.staff, labs_folder.as_deref(), help)?;
    let variant = chosen_variant::of_student(&lab, reference.as_ref(), &args.staff, &args.student)?;
    // report numbers that make no valid lab now, and not when the student grades
    Lab::load_variant(files.as_ref(), &args.lab, Some(&variant))?;
    if let Some(path) = &args.out {
        if path.exists() && !args.force {
            return Err(Failure::usage(
                format!("`{}` already exists", path.display()),
                "name another file, or replace it with --force",
            )
            .coded(ErrorCode::Exists));
        }
        let help = "choose another path with --out";
        output::write_file(path, variant.text().as_bytes(), help)?;
    }
    match (args.json, &args.out) {
        (true, _) => output::print_formatted(&printed(&args.lab, &args.student, &variant))?,
        (false, None) => output::print(&variant.text())?,
        (false, Some(_)) => {}
    }
    Ok(ExitCode::SUCCESS)
}

fn printed<'a>(lab: &'a str, student: &'a str, variant: &'a Variant) -> Printed<'a> {
    Printed {
        lab,
        student,
        parameters: variant.parameters().collect(),
    }
}
