//! The course in whose folder a command runs: its labs, its staff part and its salt, where the command names none of its own.

use std::path::PathBuf;

use kinemark_course::course_file::{COURSE_FILE, CourseFile};

use crate::course_folder::{enclosing_root, salt, text};
use crate::failure::{BROKEN, Failure};
use crate::labs_folder::LabsFolderArgs;
use crate::output;
use crate::staff_folder::StaffPart;

/// What was filled in from a course.
pub(crate) struct FilledIn {
    /// What it was, in a line.
    pub(crate) note: String,
    /// The folder of the course.
    pub(crate) root: PathBuf,
}

/// Fills in what a command of course staff left open about `lab` from the `course.toml` here or above that names it. Variants and hidden
/// cases are drawn from the salt, so with any other one students would work with numbers that the course does not grade. Gives what it
/// was.
///
/// # Errors
/// A `course.toml` or a salt that cannot be read.
pub(crate) fn fill(
    lab: &str,
    labs: &mut LabsFolderArgs,
    part: &mut StaffPart,
) -> Result<Option<FilledIn>, Failure> {
    let Some(root) = enclosing_root() else {
        return Ok(None);
    };
    let file = CourseFile::parse(text(&root.join(COURSE_FILE))?)
        .map_err(|error| Failure::diagnostic(BROKEN, error))?;
    if file.lab(lab).is_none() {
        return Ok(None);
    }
    let mut filled = Vec::new();
    if labs.labs.is_none()
        && let Some(folder) = &file.labs_folder
    {
        labs.labs = Some(root.join(folder));
        filled.push("labs");
    }
    if part.reference.is_none()
        && let Some(folder) = &file.reference
    {
        part.reference = Some(root.join(folder));
        filled.push("staff part");
    }
    if part.salt().is_none() {
        part.set_salt(salt(&root, &file)?);
        if part.salt().is_some() {
            filled.push("salt");
        }
    }
    Ok((!filled.is_empty()).then(|| {
        let path = root.join(COURSE_FILE);
        let path = output::path(path.strip_prefix(".").unwrap_or(&path));
        let note = format!("the {} are those of {path}", filled.join(", "));
        FilledIn { note, root }
    }))
}
