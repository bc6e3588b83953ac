//! What is compared: the file of each student that counts, and the numbers of variants.

use std::collections::BTreeMap;

use jiff::Timestamp;
use kinemark_grader::task::problem::LabError;

use crate::book::{Book, BookError};
use crate::history::History;
use crate::roster::Roster;
use crate::staffed_lab::StaffedLab;
use crate::standing::Standing;
use crate::student::StudentId;
use crate::submission_file::numbers;

/// Named numbers of a variant, one or a list of each name.
pub(super) type Numbers = Vec<(String, Vec<f64>)>;

/// The file of a student.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClassFile {
    /// Whose.
    pub student: StudentId,
    /// The group that hands in together; empty where there is none. Members of a group share files by right.
    pub group: String,
    /// Its name.
    pub file: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// When it was handed in, where that is known.
    pub submitted_at: Option<Timestamp>,
}

impl ClassFile {
    /// Its text; none of a compiled submission.
    pub(super) fn text(&self) -> Option<&str> {
        text(&self.bytes)
    }
}

/// A file as text, if it is one.
pub(super) fn text(bytes: &[u8]) -> Option<&str> {
    let text = std::str::from_utf8(bytes).ok()?;
    (!text.contains('\0')).then_some(text)
}

/// The files that count in `lab`, in the roster's order; who handed in nothing has none.
///
/// # Errors
/// A submission that the book does not have any more.
pub fn class_files(
    book: &Book,
    history: &History,
    roster: &Roster,
    lab: &str,
    standings: &[Standing],
) -> Result<Vec<ClassFile>, BookError> {
    let mut files = Vec::new();
    for standing in standings.iter().filter(|standing| standing.lab == lab) {
        let student = &standing.student;
        let mut attempts = history.attempts(lab, student).iter();
        let counts =
            attempts.find(|attempt| Some(&attempt.hand_in.id) == standing.hand_in.as_ref());
        let Some(attempt) = counts else { continue };
        let group = roster.get(student).map(|person| person.group.clone());
        files.push(ClassFile {
            student: student.clone(),
            group: group.unwrap_or_default(),
            file: attempt.hand_in.file.clone(),
            bytes: book.submission(&attempt.hand_in.submission)?,
            submitted_at: attempt.hand_in.submitted_at,
        });
    }
    Ok(files)
}

/// The parameters of each student's variant, by name.
pub type VariantNumbers = BTreeMap<StudentId, Vec<(String, Vec<f64>)>>;

/// The numbers of everybody's variant; empty where the lab has none.
///
/// # Errors
/// An id that cannot have one.
pub fn variants_of(lab: &StaffedLab, roster: &Roster) -> Result<VariantNumbers, LabError> {
    let Some(salt) = lab.salt().filter(|_| lab.has_variants()) else {
        return Ok(BTreeMap::new());
    };
    let mut variants = BTreeMap::new();
    for person in roster.people() {
        let variant = lab.lab.variant_of(salt, person.id.as_str())?;
        variants.insert(person.id.clone(), numbers(variant.parameters()));
    }
    Ok(variants)
}

/// The numbers that the lab itself has.
pub fn default_numbers(lab: &StaffedLab) -> Vec<(String, Vec<f64>)> {
    numbers(lab.lab.parameters.iter())
}
