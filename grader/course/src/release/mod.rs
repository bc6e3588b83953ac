//! What goes back: grades and feedback in the forms that learning management systems (LMS) and other programs read. A form is one file
//! here and one line in [`FORMS`].
//!
//! A form is made from [`Material`] alone: nothing here reads or writes a file. The same material gives the same bytes, and filling a
//! file that is already filled changes none of them.

mod annotations;
mod any_csv;
mod canvas;
mod check_text;
mod decided;
mod directory;
mod encoding;
mod error;
mod feedback;
mod feedback_files;
mod fill;
mod formula;
mod gradescope;
mod json_lines;
mod junit;
mod machine_path;
mod moodle;
mod note;
mod number;
#[cfg(test)]
mod sample;
mod sheet;

use crate::book::Record;
use crate::roster::Person;
use crate::standing::Standing;

pub use error::ReleaseError;
pub use note::Note;

/// How a student stands in the lab that is released, with what is shown of it.
#[derive(Debug, Clone, Copy)]
pub struct Row<'a> {
    /// Who.
    pub person: &'a Person,
    /// How they stand.
    pub standing: &'a Standing,
    /// The record that counts; none where points were given without a file, or where there is no grade.
    pub record: Option<&'a Record>,
    /// The page of the whole report, where it was made.
    pub report: Option<&'a str>,
}

/// A file of the LMS that is to be filled in.
#[derive(Debug, Clone, Copy)]
pub struct Export<'a> {
    /// Its name, which the filled file has too.
    pub name: &'a str,
    /// Its bytes.
    pub bytes: &'a [u8],
}

/// The columns of an export that a person has named, by their headers. Those not named are looked for.
#[derive(Debug, Clone, Copy, Default)]
pub struct Columns<'a> {
    /// Whose row it is.
    pub id: Option<&'a str>,
    /// Where the points go.
    pub points: Option<&'a str>,
    /// Where the comment goes.
    pub comment: Option<&'a str>,
}

/// What a form is made from.
#[derive(Debug, Clone, Copy)]
pub struct Material<'a> {
    /// The lab's name.
    pub lab: &'a str,
    /// The lab's title.
    pub title: &'a str,
    /// Everybody of the roster, in its order.
    pub rows: &'a [Row<'a>],
    /// The file that is to be filled in.
    pub export: Option<Export<'a>>,
    /// The columns of it that were named.
    pub columns: Columns<'a>,
}

/// A file that goes back.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutFile {
    /// Where it goes in the folder of its form, with `/` between folders.
    pub path: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// What was made of a form: files, and what a person should know before they upload them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Made {
    /// The files.
    pub files: Vec<OutFile>,
    /// What is not in them, and why.
    pub notes: Vec<Note>,
}

/// What a form does with a file of the LMS.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExportUse {
    /// It needs none.
    Unused,
    /// It fills this one where it is given.
    Optional(&'static str),
    /// It fills this one.
    Required(&'static str),
}

/// A form in which grades go back.
#[derive(Debug)]
pub struct Form {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it makes.
    pub title: &'static str,
    /// Which file of the LMS it fills in.
    pub export: ExportUse,
    make: fn(&Material<'_>) -> Result<Made, ReleaseError>,
}

/// Every form, in the order in which they are shown.
pub const FORMS: &[Form] = &[
    moodle::FORM,
    canvas::FORM,
    gradescope::FORM,
    any_csv::FORM,
    feedback_files::FORM,
    junit::FORM,
    annotations::FORM,
    json_lines::FORM,
];

impl Form {
    /// The form of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        FORMS.iter().find(|form| form.name == name)
    }

    /// Makes the form, and reports what needs a person whatever the form: grades that are not decided, and points by hand that are
    /// stale.
    ///
    /// # Errors
    /// A file that is missing or cannot be filled in.
    pub fn release(&self, material: &Material<'_>) -> Result<Made, ReleaseError> {
        if let (ExportUse::Required(what), None) = (self.export, material.export) {
            return Err(ReleaseError::NoExport {
                form: self.name,
                what,
            });
        }
        let mut made = (self.make)(material)?;
        made.notes.splice(0..0, note::of_rows(material.rows));
        Ok(made)
    }
}

#[cfg(test)]
mod tests;
