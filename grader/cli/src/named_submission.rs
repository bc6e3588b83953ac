//! The submission that a person names: a script, a module, or a folder, a project, an archive or a hand-in file with one in it. What is none of them gets a
//! grade all the same, `did-not-build` with what to do: a report of an earlier file must not stand in for it.

use std::io::Read;
use std::path::Path;

use kinemark_course::hand_in_file::HandInFile;
use kinemark_course::language::{Language, MODULE_FILE};
use kinemark_course::layout::PersonFiles;
use kinemark_course::selection::{MOST_HAND_IN_BYTES, MOST_SUBMISSION_BYTES};
use kinemark_course::submission_file::{Unclear, submission_of};
use kinemark_course::submission_source::SubmissionSource;
use kinemark_course::tree::{Limits, Tree};
use kinemark_course::working_folder::SUBMISSION_FILE;
use kinemark_grader::submission::handed_in::reads_as_python;
use kinemark_grader::submission::not_text::absent;

use crate::failure::Failure;
use crate::project::Project;
use crate::{disk, typed_path};

/// Reads what lies at `path` as a submission for `lab`.
///
/// # Errors
/// Exit code 2 for a path at which nothing is or in which a folder is a link, or for what can be no submission: a pipe, a TOML file, a
/// file of more than a megabyte.
pub(crate) fn read(path: &Path, lab: &str) -> Result<SubmissionSource, Failure> {
    if is_input(path) {
        return of_input(std::io::stdin().lock());
    }
    let name = path.file_name().unwrap_or(path.as_os_str());
    let name = name.to_string_lossy();
    let missing = |what: &str, help: &str| SubmissionSource::new(&name, &absent(what, help));
    if typed_path::link_in(path).is_some_and(|link| is_last(&link, path)) && !path.is_dir() {
        // what it points to could be a secret of whoever grades
        let what = format!("`{name}` is a link to another file");
        return Ok(missing(
            &what,
            "hand in the file itself: copy it to this place",
        ));
    }
    typed_path::refuse_links(path)?;
    if let Some(project) = Project::of(path) {
        return Ok(match project.module(path)? {
            Ok(module) => {
                project.warn_if_stale(&module);
                SubmissionSource::new(&module.name(), &module.bytes).with_sources(project.sources())
            }
            Err(none) => missing(&none.what, &none.help),
        });
    }
    let opened = if path.is_dir() {
        Some(Tree::open(path, &Limits::default()))
    } else if has_ending(path, &["zip", "tar", "gz", "tgz"]) {
        let file = typed_path::open(path, "a submission")?;
        Some(Tree::of_file(file, path, &Limits::default()))
    } else {
        None
    };
    if let Some(opened) = opened {
        let found = match &opened {
            Ok(tree) => submission_of(tree, &PersonFiles::of_all(tree), lab),
            Err(error) => {
                return Ok(missing(
                    &format!("`{name}` cannot be opened: {}", error.what),
                    "hand in the script itself, saved as UTF-8 text",
                ));
            }
        };
        return Ok(match found {
            Ok(file) => SubmissionSource::new(&file.name, &file.bytes).with_sources(file.sources),
            Err(Unclear { what, .. }) => missing(
                &format!("`{name}`: {what}"),
                "name the script itself, such as submission.rhai",
            ),
        });
    }
    if has_ending(path, &["kinemark"]) {
        let bytes = typed_path::bytes(path, "a hand-in file", MOST_HAND_IN_BYTES)?;
        return Ok(match HandInFile::read(&bytes) {
            Ok(file) => SubmissionSource::new(&file.statement.file, &file.submission)
                .with_sources(file.sources),
            Err(error) => missing(
                &format!("`{name}`: {error}"),
                "run `kinemark submit` again, and name that file as it is",
            ),
        });
    }
    disk::refuse_toml(path)?;
    let bytes = typed_path::bytes(path, "a submission", MOST_SUBMISSION_BYTES)?;
    Ok(SubmissionSource::new(&name, &bytes))
}

/// Whether a path stands for standard input.
pub(crate) fn is_input(path: &Path) -> bool {
    path == Path::new("-")
}

/// The submission that `input` holds: a module if it begins as one, else a script.
fn of_input(input: impl Read) -> Result<SubmissionSource, Failure> {
    let mut bytes = Vec::new();
    let read = input
        .take(MOST_SUBMISSION_BYTES + 1)
        .read_to_end(&mut bytes);
    read.map_err(|error| {
        Failure::usage(
            format!("standard input cannot be read: {}", disk::plain(&error)),
            "name the file of the submission",
        )
    })?;
    if bytes.len() as u64 > MOST_SUBMISSION_BYTES {
        return Err(Failure::usage(
            format!("standard input has more than {MOST_SUBMISSION_BYTES} bytes"),
            "send the submission alone: a script, a file in Python, or a module",
        ));
    }
    let name = match std::str::from_utf8(&bytes) {
        _ if bytes.starts_with(b"\0asm") => MODULE_FILE,
        Ok(text) if reads_as_python(text) => Language::Python.source(),
        _ => SUBMISSION_FILE,
    };
    Ok(SubmissionSource::new(name, &bytes))
}

/// Whether a part of a path is all of it.
fn is_last(part: &Path, path: &Path) -> bool {
    part.components().count() >= path.components().count()
}

/// Whether a file's name ends in one of `endings`.
fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let is_one = |ending: &std::ffi::OsStr| {
        let mut known = endings.iter();
        known.any(|known| ending.eq_ignore_ascii_case(known))
    };
    path.is_file() && path.extension().is_some_and(is_one)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn standard_input_is_a_script_or_a_module_of_a_limited_size() {
        let read = |bytes: &[u8]| {
            of_input(bytes).map(|submission| submission.submission.name().to_owned())
        };
        assert_eq!(read(b"fn control() {}").expect("read"), SUBMISSION_FILE);
        assert_eq!(read(b"\0asm\x01\0\0\0").expect("read"), MODULE_FILE);
        let most = usize::try_from(MOST_SUBMISSION_BYTES).expect("a size");
        assert!(read(&vec![b' '; most]).is_ok());
        assert!(read(&vec![b' '; most + 1]).is_err());
    }
}
