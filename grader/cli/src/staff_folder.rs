//! Where the course staff's part of the labs is found: in the folder given, or in a `reference` folder beside the labs.

use std::path::{Path, PathBuf};

use kinemark_grader::audit;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::task::files::Files;

use crate::disk::{self, Folder};
use crate::environment;
use crate::failure::Failure;

/// Which part of the course staff takes part in grading.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct StaffArgs {
    #[command(flatten)]
    pub(crate) part: StaffPart,
    /// Do not use the course staff's files, as for students
    #[arg(long, conflicts_with = "reference", help_heading = STAFF)]
    pub(crate) practice: bool,
}

/// Where the course staff's part is, and its salt.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct StaffPart {
    /// Folder of the course staff's part [default: `reference` beside the labs folder] [env: KINEMARK_REFERENCE]
    #[arg(
        long,
        value_name = "DIR",
        default_value = environment::reference(),
        hide_default_value = true,
        help_heading = STAFF
    )]
    pub(crate) reference: Option<PathBuf>,
    /// The course's salt, for hidden cases and variants, instead of the one in hidden.toml [env: KINEMARK_SALT]
    #[arg(
        long = "salt",
        value_name = "TEXT",
        env = SALT,
        hide_env = true,
        value_parser = salt,
        help_heading = STAFF
    )]
    typed_salt: Option<String>,
    /// A file with the salt in its one line, which no list of processes shows; it counts before --salt
    #[arg(
        long,
        value_name = "FILE",
        value_parser = salt_of_file,
        help_heading = STAFF
    )]
    salt_file: Option<String>,
}

impl StaffPart {
    /// The part in a folder, without a salt of its own.
    pub(crate) fn in_folder(reference: Option<PathBuf>) -> Self {
        Self {
            reference,
            typed_salt: None,
            salt_file: None,
        }
    }

    /// The salt, if one is given.
    pub(crate) fn salt(&self) -> Option<&str> {
        self.salt_file.as_deref().or(self.typed_salt.as_deref())
    }

    /// Gives the part a salt.
    pub(crate) fn set_salt(&mut self, salt: Option<String>) {
        self.salt_file = salt;
    }
}

/// Above this a file is no line.
const MOST_SALT_BYTES: u64 = 1 << 16;

/// The salt in the file at `path`.
fn salt_of_file(path: &str) -> Result<String, String> {
    let bytes = disk::bytes_of(Path::new(path), MOST_SALT_BYTES)
        .map_err(|why| format!("the file cannot be read: {why}"))?;
    let text = String::from_utf8(bytes).map_err(|_| "the file is not UTF-8 text".to_owned())?;
    match text.trim() {
        "" => Err("the file is empty: write the salt into it".to_owned()),
        line if line.lines().count() > 1 => {
            Err("the file has several lines, and a salt is one".to_owned())
        }
        line => Ok(line.to_owned()),
    }
}

/// What the help calls the options of course staff.
pub(crate) const STAFF: &str = "Options for course staff";

/// The variable that holds a salt.
const SALT: &str = "KINEMARK_SALT";

/// Refuses a salt that everyone knows: that of a secret that is not set.
fn salt(text: &str) -> Result<String, String> {
    if text.trim().is_empty() {
        let is_of_environment = std::env::var(SALT).is_ok_and(|salt| salt == text);
        return Err(if is_of_environment {
            format!("the salt is empty: unset {SALT} in the environment to use hidden.toml's")
        } else {
            "the salt is empty: leave --salt out to use hidden.toml's".to_owned()
        });
    }
    Ok(text.to_owned())
}

/// The staff's part: that of `--reference`, else a `reference` folder beside the labs folder; `None` in practice.
pub(crate) fn open(args: &StaffArgs, labs: Option<&Path>) -> Result<Option<Folder>, Failure> {
    if args.practice {
        return Ok(None);
    }
    let help = "give the course staff's folder, or use --practice to grade visible cases only";
    part(&args.part, labs, help)
}

/// The staff's part: that of `--reference`, else a `reference` folder beside the labs folder; `help` is what to do where the former is
/// no folder.
pub(crate) fn part(
    args: &StaffPart,
    labs: Option<&Path>,
    help: &str,
) -> Result<Option<Folder>, Failure> {
    if let Some(given) = &args.reference {
        if !given.is_dir() {
            return Err(Failure::usage(
                format!("`{}` is not a directory", given.display()),
                help,
            ));
        }
        return Ok(Some(Folder::new(given.clone())));
    }
    let beside = labs.map(|labs| match (labs.file_name(), labs.parent()) {
        (Some(_), Some(parent)) => parent.join("reference"),
        // such as `..`, of which the path does not say where it lies
        _ => labs.join("../reference"),
    });
    let beside = beside.filter(|folder| folder.is_dir());
    Ok(beside.map(|folder| {
        let plain = folder.strip_prefix(".").map(Path::to_owned);
        Folder::new(plain.unwrap_or(folder))
    }))
}

/// Whether a folder has the course staff's part of a lab: with it a submission is graded, and not in practice.
pub(crate) fn has_solution(reference: &dyn Files, lab: &str) -> bool {
    // what cannot be read is reported by whoever reads it
    !matches!(reference.bytes(&format!("{lab}/solution.rhai")), Ok(None))
}

/// Which file is missing where a folder has no solution of a lab.
pub(crate) fn no_solution(reference: &dyn Files, lab: &Lab) -> String {
    let path = Path::new(&reference.name())
        .join(&lab.name)
        .join("solution.rhai");
    format!("there is no file `{}`", path.display())
}

/// The staff's part of a lab, whose code works; none where there is no reference solution.
pub(crate) fn staff(
    reference: &dyn Files,
    lab: &Lab,
    salt: Option<&str>,
) -> Result<Option<Staff>, Failure> {
    let staff = Staff::load(reference, lab, salt)?;
    if let Some(staff) = &staff {
        audit::staff_code(lab, staff)?;
    }
    Ok(staff)
}
