//! Which variant of a lab is meant: one of a file, one beside the submission, one computed for a student, or none.

use std::path::{Path, PathBuf};

use kinemark_grader::lab::variant::{VARIANT_FILE, student_id};
use kinemark_grader::lab::{Lab, Staff, Variant};
use kinemark_grader::task::files::Files;
use kinemark_grader::task::problem::{LabError, LoadError};

use crate::disk::{self, Folder};
use crate::failure::{Failure, USAGE};
use crate::labs_folder::{self, LabsFolderArgs};
use crate::staff_folder::{self, STAFF, StaffArgs, StaffPart};
use crate::whose_labs::Found;
use crate::{enclosing_course, failure, output, typed_path};

/// Which variant of the lab: the numbers of one student.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct VariantArgs {
    /// A student's variant: a file that `kinemark lab variant` wrote
    #[arg(long, value_name = "FILE", conflicts_with = "student")]
    pub(crate) variant: Option<PathBuf>,
    /// Generate this student's variant from the course's salt: for course staff
    #[arg(
        long,
        value_name = "ID",
        conflicts_with = "practice",
        help_heading = STAFF
    )]
    pub(crate) student: Option<String>,
}

/// Where a lab comes from: its folder, its variant, and the course staff's part.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct LabArgs {
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
    #[command(flatten)]
    pub(crate) variant: VariantArgs,
    #[command(flatten)]
    pub(crate) staff: StaffArgs,
}

/// A variant is a few lines.
const MOST_BYTES: u64 = 1 << 20;

/// The lab that is meant, with what it was read from.
pub(crate) struct Chosen {
    pub(crate) lab: Lab,
    pub(crate) files: Box<dyn Files>,
    /// The course staff's part.
    pub(crate) reference: Option<Folder>,
    /// What was asked for about it, with the salt of the course in whose folder this runs.
    pub(crate) staff: StaffArgs,
    /// Which variant is used where the command named none.
    pub(crate) note: Option<String>,
    /// Whose labs are used, in a line; nothing where it is clear: the labs built in, in practice.
    pub(crate) labs: Option<String>,
}

/// Loads the lab `name` in the variant that is asked for. `beside` is the submission: in practice a file next to it is taken unasked,
/// and nothing that may have been handed in with it says how it is graded.
///
/// # Errors
/// Exit code 2 for what cannot be asked for, for labs that may be a student's, and for a variant of other numbers than the salt or
/// the lab gives.
pub(crate) fn choose(name: &str, args: &LabArgs, beside: Option<&Path>) -> Result<Chosen, Failure> {
    let mut args = args.clone();
    let (files, _) = labs_folder::open(&args.labs_folder)?;
    let name = &labs_folder::full_name(files.as_ref(), name)?;
    let mut found = Found::default();
    if !args.staff.practice {
        let filled = enclosing_course::fill(name, &mut args.labs_folder, &mut args.staff.part)?;
        if let Some(filled) = filled {
            failure::note_in_words(&filled.note);
            found.course = Some(filled.root);
        }
    }
    let (files, labs_folder) = labs_folder::open(&args.labs_folder)?;
    let reference = staff_folder::open(&args.staff, labs_folder.as_deref())?;
    let staffed = reference.as_ref();
    let staffed = staffed.filter(|reference| staff_folder::has_solution(*reference, name));
    if args.labs_folder.labs.is_none() {
        found.labs.clone_from(&labs_folder);
        let is_beside = args.staff.part.reference.is_none();
        let beside = staffed.filter(|_| is_beside && labs_folder.is_some());
        found.reference = beside.map(|reference| reference.path().to_owned());
    }
    found.used = labs_folder;
    if let (Some(submission), Some(_)) = (beside, staffed) {
        found.refuse_handed_in(submission)?;
    }
    let labs = labs_in_words(files.as_ref(), found.used.is_some(), staffed);
    let part = (reference.as_ref(), staffed.is_some());
    let (lab, note) = variant_of(name, files.as_ref(), part, &args, beside)?;
    Ok(Chosen {
        lab,
        files,
        reference,
        staff: args.staff,
        note,
        labs,
    })
}

/// Whose labs are used; nothing where it is clear.
fn labs_in_words(files: &dyn Files, is_folder: bool, staffed: Option<&Folder>) -> Option<String> {
    let labs = match is_folder {
        true => format!("the labs in `{}`", files.name()),
        false => files.name(),
    };
    match staffed {
        Some(reference) => {
            let reference = reference.name();
            Some(format!(
                "using {labs} and the course staff's part in `{reference}`"
            ))
        }
        None => is_folder.then(|| format!("using {labs}")),
    }
}

/// The lab in its variant, and which that is where the command named none. With the course staff's folder comes whether it has a part
/// of this lab: then the run is graded.
fn variant_of(
    name: &str,
    files: &dyn Files,
    (reference, is_graded): (Option<&Folder>, bool),
    LabArgs { variant, staff, .. }: &LabArgs,
    beside: Option<&Path>,
) -> Result<(Lab, Option<String>), Failure> {
    let lab = Lab::load(files, name)?;
    let found = beside.map(|submission| submission.with_file_name(VARIANT_FILE));
    // whatever it is: what is no file is refused below, and not passed over
    let found = found.filter(|path| path.symlink_metadata().is_ok());
    if let Some(student) = &variant.student {
        let own = of_student(&lab, reference, &staff.part, student)?;
        let unused = found.map(|found| {
            let found = output::path(&found);
            format!("using the variant of student {student}; {found} is not used")
        });
        return Ok((Lab::load_variant(files, name, Some(&own))?, unused));
    }
    let (path, note) = match (&variant.variant, &found, is_graded) {
        (Some(given), _, _) => (given, None),
        // it is a student's file, and says which numbers are graded
        (None, Some(found), true) => {
            let found = output::path(found);
            let unused = format!(
                "using the default parameters of lab.toml; {found} is not used, because it may be the student's own: give \
                 --student ID, or --variant FILE"
            );
            return Ok((lab, Some(unused)));
        }
        (None, Some(found), false) => {
            let note = format!("using the variant in {}", output::path(found));
            (found, Some(note))
        }
        (None, None, _) => return Ok((lab, None)),
    };
    // a file that a person names may be a link of theirs
    let text = match note {
        Some(_) => typed_path::read(path, "a variant", MOST_BYTES)?,
        None => disk::read(path, "a variant", MOST_BYTES)?,
    };
    let usage = |error: LabError| Failure::diagnostic(USAGE, error);
    let variant = Variant::parse(text).map_err(usage)?;
    variant.check_fits(&lab).map_err(usage)?;
    let loaded = Lab::load_variant(files, name, Some(&variant));
    let chosen = loaded.map_err(|error| match variant.blamed(&lab, &error) {
        Some(error) => usage(error),
        None => error.into(),
    })?;
    if let Some(reference) = reference {
        let shown = path.display().to_string();
        refuse_forged(&chosen, files, reference, &staff.part, &shown)?;
    }
    // numbers of nobody in particular are those of anybody
    if is_graded {
        variant.check_drawn(&lab).map_err(usage)?;
    }
    Ok((chosen, note))
}

/// Refuses a variant that names a student and holds other numbers than the salt gives; `shown` is its file for people.
///
/// # Errors
/// Exit code 2 with the way out.
pub(crate) fn refuse_forged(
    lab: &Lab,
    files: &dyn Files,
    reference: &dyn Files,
    staff: &StaffPart,
    shown: &str,
) -> Result<(), Failure> {
    let name = &lab.name;
    let Some(student) = lab.variant.as_ref().and_then(Variant::student) else {
        return Ok(());
    };
    let Some(salt) = salt(Some(reference), name, staff)? else {
        return Ok(());
    };
    let own = lab.variant_of(&salt, student).map_err(LoadError::from)?;
    // what a file leaves out stands as in lab.toml, so whole labs are compared
    if Lab::load_variant(files, name, Some(&own))?.parameters == lab.parameters {
        return Ok(());
    }
    Err(Failure::usage(
        format!(
            "`{shown}` is not the variant of student `{student}`: the course's salt gives other parameters"
        ),
        &format!(
            "grade with `--student {student}`, or write the file again: \
             `kinemark lab variant {name} --student {student} --out FILE`"
        ),
    ))
}

/// The course's salt for a lab: that of `--salt`, else that of the course staff's part; none where there is neither.
///
/// # Errors
/// A staff part that is broken.
pub(crate) fn salt(
    reference: Option<&dyn Files>,
    lab: &str,
    staff: &StaffPart,
) -> Result<Option<String>, Failure> {
    let given = staff.salt();
    Ok(match reference {
        Some(reference) => Staff::salt(reference, lab, given)?,
        None => given.map(str::to_owned),
    })
}

/// The variant of a student, computed from the course's salt.
///
/// # Errors
/// Exit code 2 without a salt, for a lab without variants, and for what is no id.
pub(crate) fn of_student(
    lab: &Lab,
    reference: Option<&Folder>,
    staff: &StaffPart,
    student: &str,
) -> Result<Variant, Failure> {
    if let Err(why) = student_id(student) {
        return Err(Failure::usage(why, "write the id as the course writes it"));
    }
    if lab.variants.is_empty() {
        return Err(Failure::usage(
            format!(
                "lab `{}` has no variants: all students have the same parameters",
                lab.name
            ),
            "leave --student out, or add [variants] to its lab.toml",
        ));
    }
    let reference = reference.map(|reference| reference as &dyn Files);
    let Some(salt) = salt(reference, &lab.name, staff)? else {
        return Err(Failure::usage(
            "--student needs the course's salt, which is in the course staff's hidden.toml"
                .to_owned(),
            "give --reference DIR or --salt TEXT; students use the variant.toml they were given",
        ));
    };
    let variant = lab.variant_of(&salt, student);
    Ok(variant.map_err(LoadError::from)?)
}
