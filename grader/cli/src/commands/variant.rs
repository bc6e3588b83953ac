//! `kinemark variant`: the numbers of one student, as the file that goes with the lab.

use std::collections::BTreeMap;
use std::process::ExitCode;

use kinemark_grader::lab::{Lab, Variant};
use kinemark_sim::robot::Dimension;
use serde::Serialize;

use crate::args::VariantCommandArgs;
use crate::disk::plain;
use crate::failure::Failure;
use crate::{output, places, variants};

#[derive(Serialize)]
struct Printed<'a> {
    lab: &'a str,
    student: &'a str,
    parameters: BTreeMap<&'a str, &'a Dimension>,
}

/// Computes, and writes or prints.
pub(crate) fn run(args: &VariantCommandArgs) -> Result<ExitCode, Failure> {
    let (files, labs_folder) = places::labs(&args.places)?;
    let lab = Lab::load(files.as_ref(), &args.lab)?;
    let reference = places::reference(&args.staff, labs_folder.as_deref())?;
    let variant = variants::of_student(&lab, reference.as_ref(), &args.staff, &args.student)?;
    // numbers that make no lab are told now, and not when the student grades
    Lab::load_variant(files.as_ref(), &args.lab, Some(&variant))?;
    if let Some(path) = &args.out {
        if path.exists() && !args.force {
            return Err(Failure::usage(
                format!("`{}` is there already", path.display()),
                "name another file, or replace it with --force",
            ));
        }
        output::write_file(path, variant.text().as_bytes()).map_err(|error| {
            Failure::fault(
                format!("`{}` cannot be written: {}", path.display(), plain(&error)),
                "choose another place",
            )
        })?;
    }
    match (args.json, &args.out) {
        (true, _) => output::print_json(&printed(&args.lab, &args.student, &variant))?,
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
