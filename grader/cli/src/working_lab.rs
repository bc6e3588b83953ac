//! Which submission and which lab are meant where a command in a student's folder names neither.

use std::path::{Path, PathBuf};

use kinemark_course::selection::MOST_SUBMISSION_BYTES;
use kinemark_course::working_folder::SUBMISSION_FILE;
use kinemark_grader::lab::Variant;
use kinemark_grader::lab::variant::VARIANT_FILE;
use kinemark_grader::task::files::Files;

use crate::failure::{self, Failure};
use crate::labs_folder::{self, LabsFolderArgs};
use crate::{disk, last_report};

/// The submission where none is named: here, or in the folder that `kinemark new` has made for the lab.
pub(crate) fn submission(lab: Option<&str>) -> PathBuf {
    let here = PathBuf::from(SUBMISSION_FILE);
    // `kinemark new` has made a folder of the lab's name
    let below = lab.map(|lab| Path::new(lab).join(&here));
    below
        .filter(|below| !here.exists() && below.is_file())
        .unwrap_or(here)
}

/// The lab of a submission where none is named: that of its variant (`variant`, else the one beside it), of its folder, or of the last
/// report.
///
/// # Errors
/// Exit code 2 where none of them says, with `help`; exit code 3 for a variant that cannot be read.
pub(crate) fn lab_of(
    file: &Path,
    variant: Option<&Path>,
    labs_folder: &LabsFolderArgs,
    help: &str,
) -> Result<String, Failure> {
    let beside = file.with_file_name(VARIANT_FILE);
    let variant = variant.unwrap_or(&beside);
    if variant.is_file() {
        disk::refuse_link(variant)?;
        let text = disk::read(variant, "a variant", MOST_SUBMISSION_BYTES)?;
        let variant =
            Variant::parse(text).map_err(|error| Failure::diagnostic(failure::BROKEN, error))?;
        return Ok(variant.lab().to_owned());
    }
    let (labs, _) = labs_folder::open(labs_folder)?;
    let folder = disk::real(file).parent().map(Path::to_owned);
    let folder = folder.as_deref().and_then(Path::file_name);
    let folder = folder.and_then(|name| name.to_str());
    if let Some(name) = folder.filter(|name| is_lab(labs.as_ref(), name)) {
        return Ok(name.to_owned());
    }
    last_report::last_lab()
        .filter(|name| is_lab(labs.as_ref(), name))
        .ok_or_else(|| {
            Failure::usage(
                "it is not clear which lab this is: there is no variant.toml, no report in `out`, and the folder is not \
                 called like a lab"
                    .to_owned(),
                help,
            )
        })
}

fn is_lab(labs: &dyn Files, name: &str) -> bool {
    labs.bytes(&format!("{name}/lab.toml"))
        .is_ok_and(|file| file.is_some())
}
