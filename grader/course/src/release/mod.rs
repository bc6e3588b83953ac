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
mod shell_word;

use crate::book::Record;
use crate::roster::Person;
use crate::standing::Standing;
use crate::student::StudentId;
use kinemark_grader::record::hints::Hints;

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
    /// The hints of the lab as it is today: whoever has the feedback has all of them.
    pub hints: &'a Hints,
    /// Whether the record was made with another lab, staff part or engine than those of today.
    pub is_of_earlier_lab: bool,
}

/// Files of the lab that wait for a person: a grade may follow from each.
#[derive(Debug, Clone, Copy, Default)]
pub struct OpenFiles<'a> {
    /// Whose they are, where that is certain.
    pub students: &'a [StudentId],
    /// Of each of the others, the students that come near.
    pub unclaimed: &'a [Vec<StudentId>],
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

/// A column of an export that a person can name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// Whose row it is.
    Id,
    /// Where the points go.
    Points,
    /// Where the comment goes.
    Comment,
}

impl Column {
    /// The option of the command line that names it.
    pub fn option(self) -> &'static str {
        match self {
            Self::Id => "--id-column",
            Self::Points => "--column",
            Self::Comment => "--comment-column",
        }
    }
}

impl Columns<'_> {
    /// Those that were named.
    fn named(&self) -> impl Iterator<Item = Column> {
        let all = [
            (Column::Points, self.points),
            (Column::Id, self.id),
            (Column::Comment, self.comment),
        ];
        let named = all.into_iter().filter(|(_, name)| name.is_some());
        named.map(|(column, _)| column)
    }
}

/// What a form is made from.
#[derive(Debug, Clone, Copy)]
pub struct Material<'a> {
    /// The lab's name.
    pub lab: &'a str,
    /// The lab's title.
    pub title: &'a str,
    /// The maximum of the lab as it is today.
    pub max_points: f64,
    /// Everybody of the roster, in its order.
    pub rows: &'a [Row<'a>],
    /// The file that is to be filled in.
    pub export: Option<Export<'a>>,
    /// The columns of it that were named.
    pub columns: Columns<'a>,
    /// Files that wait for a person.
    pub open: OpenFiles<'a>,
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
    /// The columns of that file that a person can name.
    pub columns: &'static [Column],
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

/// The names of the forms that are as `is` says.
fn forms(is: impl Fn(&Form) -> bool) -> String {
    let forms = FORMS.iter().filter(|form| is(form)).map(|form| form.name);
    forms.collect::<Vec<_>>().join(", ")
}

impl Form {
    /// The form of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        FORMS.iter().find(|form| form.name == name)
    }

    /// Makes the form, and reports what needs a person whatever the form: grades that are not decided, and points by hand that are
    /// stale.
    ///
    /// # Errors
    /// A file that is missing or cannot be filled in, and a file or column that this form does not use.
    pub fn release(&self, material: &Material<'_>) -> Result<Made, ReleaseError> {
        if let (ExportUse::Required(what), None) = (self.export, material.export) {
            return Err(ReleaseError::NoExport {
                form: self.name,
                what,
            });
        }
        self.check_options(material)?;
        let mut made = (self.make)(material)?;
        made.notes.splice(0..0, note::of_every_form(material));
        Ok(made)
    }

    /// Refuses what was named and would have no effect.
    fn check_options(&self, material: &Material<'_>) -> Result<(), ReleaseError> {
        let unused = |option, forms| ReleaseError::UnusedOption {
            form: self.name,
            option,
            forms,
        };
        if self.export == ExportUse::Unused && material.export.is_some() {
            let forms = forms(|form| form.export != ExportUse::Unused);
            return Err(unused("--export", forms));
        }
        for column in material.columns.named() {
            let option = column.option();
            if !self.columns.contains(&column) {
                let forms = forms(|form| form.columns.contains(&column));
                return Err(unused(option, forms));
            }
            if let (ExportUse::Optional(what), None) = (self.export, material.export) {
                return Err(ReleaseError::ColumnOfNoFile { option, what });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
