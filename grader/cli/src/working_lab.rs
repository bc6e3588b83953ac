//! Which submission and which lab are meant where a command in a student's folder names neither, and where its report goes.

use std::path::{Path, PathBuf};

use kinemark_course::selection::MOST_SUBMISSION_BYTES;
use kinemark_course::working_folder::{FOLDER_FILE, FolderFile, PYTHON_FILE, SUBMISSION_FILE};
use kinemark_grader::lab::Variant;
use kinemark_grader::lab::variant::VARIANT_FILE;
use kinemark_grader::task::files::Files;

use crate::failure::{self, Failure};
use crate::labs_folder::{self, LabsFolderArgs};
use crate::project::{self, Project};
use crate::{disk, last_report, output, typed_path};

/// Where reports go unless another folder is named.
pub(crate) const REPORT_FOLDER: &str = "out";

/// What is graded, as far as words on the command line and the folder say.
pub(crate) struct Meant {
    /// The lab, or the beginning of its name.
    pub(crate) lab: String,
    /// The submission. That of a project need not be there: it is `submission.wasm` in its folder.
    pub(crate) submission: PathBuf,
    /// Whether its file was named, and not found in a folder.
    pub(crate) is_named: bool,
}

/// The lab and the submission that are meant by up to two words; `help` names both for `variant` and everything beside it.
///
/// # Errors
/// As [`lab_of`], and where a folder has a script and a module.
pub(crate) fn lab_and_submission(
    words: (Option<&str>, Option<&Path>),
    variant: Option<&Path>,
    labs_folder: &LabsFolderArgs,
    help: &str,
) -> Result<Meant, Failure> {
    let (lab, file) = match words {
        // one word that can only be a file
        (Some(word), None) if is_program(word) => (None, Some(PathBuf::from(word))),
        (lab, file) => (lab, file.map(Path::to_owned)),
    };
    let named = file.map(|file| typed_path::plain(&file));
    let of_folder = named.as_deref().and_then(Project::submission_in);
    let is_named = named.is_some() && of_folder.is_none();
    let submission = match of_folder.or(named) {
        Some(file) => file,
        None => submission(lab)?,
    };
    let lab = match lab {
        Some(lab) => lab.to_owned(),
        None => lab_of(&submission, variant, labs_folder, help)?,
    };
    Ok(Meant {
        lab,
        submission,
        is_named,
    })
}

fn is_program(word: &str) -> bool {
    let endings = [".rhai", ".py", ".wasm", ".txt"];
    word == "-" || endings.iter().any(|ending| word.ends_with(ending))
}

/// Where the report on a submission goes unless another folder is named: beside it where `kinemark new` has made its folder, so that
/// every lab has its own, else in the working folder.
pub(crate) fn report_folder(submission: &Path) -> PathBuf {
    let beside = submission.with_file_name(FOLDER_FILE);
    if beside.is_file() {
        submission.with_file_name(REPORT_FOLDER)
    } else {
        PathBuf::from(REPORT_FOLDER)
    }
}

/// What the file beside the submission says about its folder, if there is one.
///
/// # Errors
/// Exit code 2 for a file that cannot be read, and where the variant that it names is gone.
fn folder_file(submission: &Path) -> Result<Option<FolderFile>, Failure> {
    let path = submission.with_file_name(FOLDER_FILE);
    if !path.is_file() {
        return Ok(None);
    }
    let text = typed_path::read(&path, "a note of the lab", MOST_SUBMISSION_BYTES)?;
    let folder = FolderFile::parse(&text);
    let folder = folder.map_err(|error| Failure::diagnostic(failure::USAGE, error))?;
    let variant = submission.with_file_name(VARIANT_FILE);
    if folder.variant.is_some() && !variant.exists() {
        return Err(Failure::usage(
            format!(
                "{} says that this folder has a variant, and there is no {VARIANT_FILE}",
                output::path(&path)
            ),
            "put your variant.toml back, or name the lab to work with its default numbers",
        ));
    }
    Ok(Some(folder))
}

/// The submission where none is named: here, or in the folder that `kinemark new` has made for the lab.
///
/// # Errors
/// Exit code 2 where a folder has a script and a module: nobody can say which one counts.
pub(crate) fn submission(lab: Option<&str>) -> Result<PathBuf, Failure> {
    let here = project::submission_of_folder(Path::new(""))?;
    let script = Path::new(SUBMISSION_FILE);
    let texts = [script, Path::new(PYTHON_FILE)];
    // any folder may have a Cargo.toml, and only that of a lab is one of ours
    let is_ours =
        |path: &PathBuf| texts.contains(&path.as_path()) || Path::new(FOLDER_FILE).is_file();
    if let Some(here) = here.as_ref().filter(|path| is_ours(path)) {
        return Ok(here.clone());
    }
    // `kinemark new` has made a folder of the lab's name
    let below = match lab {
        Some(lab) => project::submission_of_folder(Path::new(lab))?,
        None => None,
    };
    Ok(below.or(here).unwrap_or_else(|| script.to_owned()))
}

/// The lab of a submission where none is named: that of the kinemark.toml beside it, of its variant (`variant`, else the one beside it), of
/// its folder, or of the last report.
///
/// # Errors
/// Exit code 2 where none of them says, with `help`, and for a variant that cannot be read.
pub(crate) fn lab_of(
    file: &Path,
    variant: Option<&Path>,
    labs_folder: &LabsFolderArgs,
    help: &str,
) -> Result<String, Failure> {
    if let Some(folder) = folder_file(file)? {
        return Ok(folder.lab);
    }
    let beside = file.with_file_name(VARIANT_FILE);
    let text = match variant {
        Some(named) => named
            .is_file()
            .then(|| disk::read(named, "a variant", MOST_SUBMISSION_BYTES)),
        None => beside
            .is_file()
            .then(|| typed_path::read(&beside, "a variant", MOST_SUBMISSION_BYTES)),
    };
    if let Some(text) = text.transpose()? {
        let variant =
            Variant::parse(text).map_err(|error| Failure::diagnostic(failure::USAGE, error))?;
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
                "it is not clear which lab this is: there is no kinemark.toml, no variant.toml, no report in `out`, and the \
                 folder is not called like a lab"
                    .to_owned(),
                help,
            )
        })
}

fn is_lab(labs: &dyn Files, name: &str) -> bool {
    labs.bytes(&format!("{name}/lab.toml"))
        .is_ok_and(|file| file.is_some())
}
