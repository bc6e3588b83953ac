//! The one file that a student uploads: a ZIP with a statement of what was handed in, the submission, and its grade in practice.
//!
//! | entry | holds |
//! |---|---|
//! | `hand-in.json` | the statement ([`Statement`]) |
//! | `submission.rhai`, or `submission.wasm` | the submission's bytes |
//! | `sources/...` | the sources of a module, where there are any |
//! | `practice.json` | the grade record of visible cases, made on the student's machine |
//!
//! Everything in it is what the student's machine says. The course grades the submission again; whose it is, the LMS and the roster
//! decide. The student's id inside is a claim, good for finding a mix-up.

use std::collections::BTreeMap;
use std::io::{Cursor, Read as _};

use kinemark_grader::record::grade::Grade;
use serde::{Deserialize, Serialize};
use zip::ZipArchive;
use zip::result::ZipError;

use crate::fixed_zip::{ArchiveFile, archive};
use crate::journal::MadeWith;
use crate::module_sources::{MOST_BYTES, MOST_FILE_BYTES, MOST_FILES, SourceFile, is_kept_path};
use crate::selection::{MOST_HAND_IN_BYTES, MOST_SUBMISSION_BYTES};
use crate::student::StudentId;

/// How its name ends.
pub const ENDING: &str = ".kinemark";

/// The format that this version writes.
const FORMAT: &str = "kinemark-hand-in/1";
/// How the name of every version's format begins.
const ANY_FORMAT: &str = "kinemark-hand-in/";

const STATEMENT: &str = "hand-in.json";
const PRACTICE: &str = "practice.json";
const SCRIPT: &str = "submission.rhai";
const PYTHON: &str = "submission.py";
const PLUGIN: &str = "submission.wasm";
/// What the names of sources begin with.
const SOURCES: &str = "sources/";

/// A record of every line that a submission may print is smaller.
const MOST_PRACTICE_BYTES: u64 = 16 << 20;
/// A statement is a few lines.
const MOST_STATEMENT_BYTES: u64 = 64 << 10;
/// Names and versions longer than this are something else.
const MOST_CHARACTERS: usize = 255;

/// What a hand-in file says of itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Statement {
    /// Always `kinemark-hand-in/1`.
    format: String,
    /// The lab.
    pub lab: String,
    /// The version of the lab's files ([`crate::staffed_lab::lab_version`]), with the default numbers.
    pub lab_digest: String,
    /// The engine that graded in practice, as `kinemark --version` prints it.
    pub engine: String,
    /// Who hands it in, where they said so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub student: Option<StudentId>,
    /// Whose variant was graded, where there was one that names a student.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variant_of: Option<StudentId>,
    /// The name of the submission's file on the student's machine.
    pub file: String,
    /// BLAKE3 of the submission's bytes, in hexadecimal.
    pub submission: String,
    /// The sources of a module by the digests (BLAKE3) of their texts, by path.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub sources: BTreeMap<String, String>,
    /// Points in practice.
    pub points: f64,
    /// Maximum points.
    pub max_points: f64,
}

/// Who hands in what, for a statement.
#[derive(Debug, Clone)]
pub struct HandedIn<'a> {
    /// The engine and the version of the lab.
    pub made_with: MadeWith,
    /// Who hands it in, where they said so.
    pub student: Option<StudentId>,
    /// The name of the submission's file; folders before it do not count.
    pub file: &'a str,
    /// The submission's bytes.
    pub submission: &'a [u8],
    /// The sources of a module.
    pub sources: &'a [SourceFile],
    /// Its grade in practice.
    pub practice: &'a Grade,
}

/// A hand-in file, read.
#[derive(Debug, Clone, PartialEq)]
pub struct HandInFile {
    /// What it says of itself.
    pub statement: Statement,
    /// The submission's bytes, which are those that the statement names.
    pub submission: Vec<u8>,
    /// The sources of a module, which are those that the statement names.
    pub sources: Vec<SourceFile>,
    practice: Vec<u8>,
}

/// Why a file is no hand-in file that can be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
pub enum HandInFileError {
    /// Something else, or an archive that was cut short.
    #[error("it is no whole hand-in file: {why}")]
    #[diagnostic(
        code(hand_in::damaged),
        help("write it again with `kinemark submit`, and upload that file as it is")
    )]
    Damaged {
        /// What is wrong, in words.
        why: String,
    },
    /// Other files in it than those of a hand-in file.
    #[error("it holds {found}, and not the files of a hand-in file")]
    #[diagnostic(
        code(hand_in::entries),
        help("it was changed after `kinemark submit` wrote it: write it again")
    )]
    Entries {
        /// The names of its entries, in words.
        found: String,
    },
    /// An entry that is larger than it may be.
    #[error("`{entry}` has more than {most} bytes")]
    #[diagnostic(
        code(hand_in::too_large),
        help("a submission is a program of a few kilobytes: is it the right file?")
    )]
    TooLarge {
        /// The entry, or the file as a whole.
        entry: String,
        /// The most that is read.
        most: u64,
    },
    /// A version that is not known.
    #[error("its format is `{found}`, and this version reads `{FORMAT}`")]
    #[diagnostic(
        code(hand_in::unknown_format),
        help("it was written by another version of kinemark: use that one, or a later one")
    )]
    UnknownFormat {
        /// The format found.
        found: String,
    },
    /// A statement that cannot be.
    #[error("`{STATEMENT}`: {why}")]
    #[diagnostic(
        code(hand_in::statement),
        help("it was changed after `kinemark submit` wrote it: write it again")
    )]
    Statement {
        /// What is wrong, in words.
        why: String,
    },
    /// A submission that is not the one of the statement.
    #[error("its submission is not the one that `{STATEMENT}` names")]
    #[diagnostic(
        code(hand_in::other_submission),
        help("it was changed after `kinemark submit` wrote it: write it again")
    )]
    OtherSubmission,
    /// It cannot be written.
    #[error("the hand-in file cannot be made: {why}")]
    #[diagnostic(code(hand_in::unwritten), help("please report this"))]
    Unwritten {
        /// Why, in words.
        why: String,
    },
}

impl HandInFile {
    /// A hand-in file of what was graded in practice.
    ///
    /// # Errors
    /// A submission that is larger than one may be.
    pub fn new(handed_in: HandedIn<'_>) -> Result<Self, HandInFileError> {
        let HandedIn {
            made_with,
            student,
            file,
            submission,
            sources,
            practice,
        } = handed_in;
        if submission.len() as u64 > MOST_SUBMISSION_BYTES {
            return Err(HandInFileError::TooLarge {
                entry: SCRIPT.to_owned(),
                most: MOST_SUBMISSION_BYTES,
            });
        }
        let record = serde_json::to_vec_pretty(practice).map_err(unwritten)?;
        let variant_of = practice.variant.as_ref();
        let variant_of = variant_of.and_then(|variant| variant.student.as_deref());
        let statement = Statement {
            format: FORMAT.to_owned(),
            lab: practice.lab.name.clone(),
            lab_digest: made_with.lab,
            engine: made_with.engine,
            student,
            variant_of: variant_of.and_then(|id| StudentId::new(id).ok()),
            file: shown_name(file),
            submission: digest(submission),
            sources: digests(sources),
            points: practice.points,
            max_points: practice.max_points,
        };
        checked(&statement)?;
        Ok(Self {
            statement,
            submission: submission.to_owned(),
            sources: sources.to_owned(),
            practice: record,
        })
    }

    /// Its bytes: the same for the same content.
    ///
    /// # Errors
    /// A record of practice that is larger than one may be.
    pub fn write(&self) -> Result<Vec<u8>, HandInFileError> {
        if self.practice.len() as u64 > MOST_PRACTICE_BYTES {
            return Err(HandInFileError::TooLarge {
                entry: PRACTICE.to_owned(),
                most: MOST_PRACTICE_BYTES,
            });
        }
        let mut statement = serde_json::to_vec_pretty(&self.statement).map_err(unwritten)?;
        statement.push(b'\n');
        let mut files = vec![
            ArchiveFile::new(STATEMENT, statement),
            ArchiveFile::new(entry_of(&self.statement.file), self.submission.as_slice()),
            ArchiveFile::new(PRACTICE, self.practice.as_slice()),
        ];
        files.extend(self.sources.iter().map(|file| {
            ArchiveFile::new(format!("{SOURCES}{}", file.path), file.bytes.as_slice())
        }));
        archive(&files).map_err(unwritten)
    }

    /// Reads a hand-in file from whoever uploaded it: no size and no name in it is trusted.
    ///
    /// # Errors
    /// [`HandInFileError`] for everything that `kinemark submit` does not write.
    pub fn read(bytes: &[u8]) -> Result<Self, HandInFileError> {
        if bytes.len() as u64 > MOST_HAND_IN_BYTES {
            return Err(HandInFileError::TooLarge {
                entry: "the file".to_owned(),
                most: MOST_HAND_IN_BYTES,
            });
        }
        let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&error))?;
        let (script, sources) = entries(bytes, &archive)?;
        let statement = entry(&mut archive, STATEMENT, MOST_STATEMENT_BYTES)?;
        let statement = statement_of(&statement)?;
        if entry_of(&statement.file) != script {
            return Err(HandInFileError::OtherSubmission);
        }
        let submission = entry(&mut archive, script, MOST_SUBMISSION_BYTES)?;
        let sources = sources_in(&mut archive, sources)?;
        let is_stated =
            digest(&submission) == statement.submission && digests(&sources) == statement.sources;
        if !is_stated {
            return Err(HandInFileError::OtherSubmission);
        }
        let practice = entry(&mut archive, PRACTICE, MOST_PRACTICE_BYTES)?;
        Ok(Self {
            statement,
            submission,
            sources,
            practice,
        })
    }

    /// The grade in practice; none if it is of a version that this one does not read. It is the student's word: nothing follows from
    /// it.
    pub fn practice(&self) -> Option<Grade> {
        serde_json::from_slice(&self.practice).ok()
    }

    /// What it was made with.
    pub fn made_with(&self) -> MadeWith {
        MadeWith {
            engine: self.statement.engine.clone(),
            lab: self.statement.lab_digest.clone(),
        }
    }
}

/// Whether a file claims to be a hand-in file, of whatever version; [`HandInFile::read`] says whether it is one.
pub fn is_hand_in(bytes: &[u8]) -> bool {
    if !bytes.starts_with(b"PK\x03\x04") {
        return false;
    }
    // the name in the first local header: enough for a file that was cut short
    let first = bytes.get(30..).unwrap_or_default();
    first.starts_with(STATEMENT.as_bytes())
        || ZipArchive::new(Cursor::new(bytes))
            .is_ok_and(|archive| archive.index_for_name(STATEMENT).is_some())
}

/// The name of a hand-in file: the lab, and the student whose variant it is.
pub fn file_name(lab: &str, variant_of: Option<&StudentId>) -> String {
    match variant_of {
        Some(student) => format!("{lab}-{}{ENDING}", student.folder()),
        None => format!("{lab}{ENDING}"),
    }
}

/// The name of a file, as a statement may have it: without folders, of one line, not too long.
fn shown_name(path: &str) -> String {
    let plain = plain_name(path).chars();
    let plain: Vec<char> = plain
        .map(|c| if c.is_control() { '_' } else { c })
        .collect();
    // the end says what kind of file it is
    let from = plain.len().saturating_sub(MOST_CHARACTERS);
    plain[from..].iter().collect()
}

/// The submission's entry, by how the name of its file ends: names of students are no paths of ours.
fn entry_of(file: &str) -> &'static str {
    let file = file.to_ascii_lowercase();
    if file.ends_with(".wasm") {
        PLUGIN
    } else if file.ends_with(".py") {
        PYTHON
    } else {
        SCRIPT
    }
}

/// The name of a file without its folders, however they were written.
fn plain_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

fn digest(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().to_string()
}

fn digests(sources: &[SourceFile]) -> BTreeMap<String, String> {
    let named = sources.iter();
    named
        .map(|file| (file.path.clone(), digest(&file.bytes)))
        .collect()
}

/// The sources at these paths, in their order.
fn sources_in(
    archive: &mut ZipArchive<Cursor<&[u8]>>,
    paths: Vec<String>,
) -> Result<Vec<SourceFile>, HandInFileError> {
    let mut left = MOST_BYTES + MOST_FILE_BYTES;
    let mut sources = Vec::new();
    for path in paths {
        let bytes = entry(
            archive,
            &format!("{SOURCES}{path}"),
            left.min(MOST_FILE_BYTES),
        )?;
        left -= bytes.len() as u64;
        sources.push(SourceFile { path, bytes });
    }
    Ok(sources)
}

/// The name of the submission's entry and the paths of the sources, where the archive has these, the statement and the record, and
/// nothing else.
fn entries(
    bytes: &[u8],
    archive: &ZipArchive<Cursor<&[u8]>>,
) -> Result<(&'static str, Vec<String>), HandInFileError> {
    let has = |name: &str| archive.index_for_name(name).is_some();
    let names = archive.file_names_raw().map(String::from_utf8_lossy);
    let sources: Vec<String> = names
        .filter_map(|name| Some(name.strip_prefix(SOURCES)?.to_owned()))
        .filter(|path| is_kept_path(path))
        .collect();
    // a name twice is one entry to the reader, and two to the directory's end
    let count = 3 + sources.len();
    let is_whole = archive.len() == count && listed_entries(bytes).map(usize::from) == Some(count);
    let script = [SCRIPT, PYTHON, PLUGIN].into_iter().find(|name| has(name));
    match script {
        Some(script)
            if is_whole
                && has(STATEMENT)
                && has(PRACTICE)
                && sources.len() <= MOST_FILES + 1
                && (script == PLUGIN || sources.is_empty()) =>
        {
            Ok((script, sources))
        }
        _ => {
            let names = archive.file_names_raw().take(5);
            let names: Vec<String> = names
                .map(|name| format!("{:?}", String::from_utf8_lossy(name)))
                .collect();
            let more = archive.len().saturating_sub(names.len());
            let more = if more > 0 {
                format!(" and {more} more")
            } else {
                String::new()
            };
            Err(HandInFileError::Entries {
                found: format!("{}{more}", names.join(", ")),
            })
        }
    }
}

/// How many entries the end of an archive's directory gives; none where something follows it.
fn listed_entries(bytes: &[u8]) -> Option<u16> {
    // APPNOTE 4.3.16: 22 bytes without a comment, the count at byte 10
    let end = bytes.get(bytes.len().checked_sub(22)?..)?;
    let count = [*end.get(10)?, *end.get(11)?];
    end.starts_with(b"PK\x05\x06")
        .then_some(u16::from_le_bytes(count))
}

/// The bytes of an entry, at most `most` of them whatever its header says.
fn entry(
    archive: &mut ZipArchive<Cursor<&[u8]>>,
    name: &str,
    most: u64,
) -> Result<Vec<u8>, HandInFileError> {
    let file = archive.by_name(name).map_err(|error| damaged(&error))?;
    let mut bytes = Vec::new();
    let read = file.take(most + 1).read_to_end(&mut bytes);
    read.map_err(|error| HandInFileError::Damaged {
        why: format!("`{name}`: {error}"),
    })?;
    if bytes.len() as u64 > most {
        return Err(HandInFileError::TooLarge {
            entry: name.to_owned(),
            most,
        });
    }
    Ok(bytes)
}

/// The statement, of this version.
fn statement_of(bytes: &[u8]) -> Result<Statement, HandInFileError> {
    #[derive(Deserialize)]
    struct Format {
        format: String,
    }
    let refused = |error: serde_json::Error| HandInFileError::Statement {
        why: error.to_string(),
    };
    // the format first: of another version everything else may be another
    let Format { format } = serde_json::from_slice(bytes).map_err(refused)?;
    if format != FORMAT {
        let is_ours = format.starts_with(ANY_FORMAT) && is_plain(&format);
        let found = if is_ours {
            format
        } else {
            "no hand-in format".to_owned()
        };
        return Err(HandInFileError::UnknownFormat { found });
    }
    let statement: Statement = serde_json::from_slice(bytes).map_err(refused)?;
    checked(&statement)?;
    Ok(statement)
}

/// Refuses a statement whose parts cannot be what they say they are.
fn checked(statement: &Statement) -> Result<(), HandInFileError> {
    let refuse = |why: String| Err(HandInFileError::Statement { why });
    let is_folder = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.');
    let is_digest = |text: &str| {
        text.len() == 64
            && text
                .bytes()
                .all(|b| b.is_ascii_digit() || (b'a'..=b'f').contains(&b))
    };
    let lab = &statement.lab;
    if !is_plain(lab) || lab.starts_with('.') || !lab.chars().all(is_folder) {
        return refuse("`lab` is no name of a lab".to_owned());
    }
    for (name, digest) in [
        ("lab_digest", &statement.lab_digest),
        ("submission", &statement.submission),
    ] {
        if !is_digest(digest) {
            return refuse(format!(
                "`{name}` is no digest of 64 lowercase hexadecimal digits"
            ));
        }
    }
    if !is_plain(&statement.engine) {
        return refuse("`engine` is no name of an engine".to_owned());
    }
    let file = &statement.file;
    if !is_plain(file) || plain_name(file) != file || matches!(file.as_str(), "." | "..") {
        return refuse("`file` is no name of a file".to_owned());
    }
    let (points, most) = (statement.points, statement.max_points);
    if !(points.is_finite() && most.is_finite() && 0.0 <= points && points <= most) {
        return refuse(format!("{points} of {most} points cannot be"));
    }
    Ok(())
}

/// Whether a text is short, of one line, and not empty.
fn is_plain(text: &str) -> bool {
    !text.is_empty()
        && text.chars().count() <= MOST_CHARACTERS
        && !text.chars().any(char::is_control)
}

fn damaged(error: &ZipError) -> HandInFileError {
    HandInFileError::Damaged {
        why: error.to_string(),
    }
}

fn unwritten(error: impl std::fmt::Display) -> HandInFileError {
    HandInFileError::Unwritten {
        why: error.to_string(),
    }
}

#[cfg(test)]
mod tests;
