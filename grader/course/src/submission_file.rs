//! The submission among a person's files: as it is, or in a hand-in file, with what stands beside it about whose it is.

use std::cell::RefCell;
use std::collections::BTreeSet;

use kinemark_grader::lab::Variant;
use kinemark_grader::lab::variant::VARIANT_FILE;
use kinemark_grader::record::grade::{Grade, ParameterValue};
use kinemark_sim::text::{Dimension, Source};

use crate::hand_in_file::{HandInFile, HandInFileError};
use crate::journal::MadeWith;
use crate::layout::PersonFiles;
use crate::module_sources::SourceFile;
use crate::selection::{Found, Unselected, select};
use crate::student::StudentId;
use crate::tree::Tree;

/// A submission, however it was handed in. Whose it is, is what the student's machine says: good for finding a mix-up.
#[derive(Debug, Clone, PartialEq)]
pub struct SubmissionFile {
    /// The path in the source of the file that was handed in.
    pub path: String,
    /// The name of the submission's file.
    pub name: String,
    /// The submission's bytes.
    pub bytes: Vec<u8>,
    /// The sources beside it, where it is a module.
    pub sources: Vec<SourceFile>,
    /// Who handed it in, where a hand-in file says so.
    pub student: Option<StudentId>,
    /// Whose variant it was made with: as the hand-in file says, or a `variant.toml` in the folder of the submission.
    pub variant_of: Option<StudentId>,
    /// The numbers of that variant, by name; empty where nothing says them.
    pub numbers: Vec<(String, Vec<f64>)>,
    /// The engine and the lab of practice; none where it is no hand-in file.
    pub made_with: Option<MadeWith>,
}

/// Why nobody but a person can say which file it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Unclear {
    /// What is not clear, in words.
    pub what: String,
    /// What to do.
    pub help: String,
    /// The files that a person can choose from.
    pub candidates: Vec<SubmissionFile>,
}

/// Finds the submission for `lab` among a person's files.
///
/// # Errors
/// What only a person can decide.
pub fn submission_of(
    tree: &Tree,
    person: &PersonFiles,
    lab: &str,
) -> Result<SubmissionFile, Unclear> {
    let of_lab = OfLab::new(lab);
    let found = select(tree, person, &|bytes| of_lab.has(bytes));
    let found = found.map_err(|unselected| unclear(&unselected, of_lab))?;
    SubmissionFile::of(&found).map_err(|error| Unclear {
        what: format!(
            "`{}`: {error}",
            kinemark_report::visible::visible(&found.path)
        ),
        help: "run `kinemark submit` again, and upload that file as it is".to_owned(),
        candidates: Vec::new(),
    })
}

impl SubmissionFile {
    fn of(found: &Found) -> Result<Self, HandInFileError> {
        if !found.is_hand_in {
            let variant = found.variant.as_deref().and_then(variant);
            return Ok(Self {
                path: found.path.clone(),
                name: found.name.clone(),
                bytes: found.bytes.clone(),
                sources: found.sources.clone(),
                student: None,
                variant_of: variant.as_ref().and_then(owner),
                numbers: variant
                    .as_ref()
                    .map(|variant| numbers(variant.parameters()))
                    .unwrap_or_default(),
                made_with: None,
            });
        }
        let file = HandInFile::read(&found.bytes)?;
        Ok(Self {
            path: found.path.clone(),
            numbers: file.practice().map(practised).unwrap_or_default(),
            made_with: Some(file.made_with()),
            name: file.statement.file,
            bytes: file.submission,
            sources: file.sources,
            student: file.statement.student,
            variant_of: file.statement.variant_of,
        })
    }
}

/// A `variant.toml`, if it can be read.
fn variant(bytes: &[u8]) -> Option<Variant> {
    let text = String::from_utf8(bytes.to_owned()).ok()?;
    Variant::parse(Source::new(VARIANT_FILE, text)).ok()
}

/// The student whom a variant names.
fn owner(variant: &Variant) -> Option<StudentId> {
    StudentId::new(variant.student()?).ok()
}

/// Named numbers, one or a list of each name: those of a variant, or of a lab.
pub(crate) fn numbers<'n>(
    named: impl Iterator<Item = (&'n str, &'n Dimension)>,
) -> Vec<(String, Vec<f64>)> {
    let numbers = named.map(|(name, value)| {
        let values = match value {
            Dimension::Number(number) => vec![*number],
            Dimension::List(numbers) => numbers.clone(),
            // what is no number is the same in no two ways
            Dimension::Text(_) => Vec::new(),
        };
        (name.to_owned(), values)
    });
    numbers.collect()
}

/// The numbers of the variant that was practised with, if it was one.
fn practised(grade: Grade) -> Vec<(String, Vec<f64>)> {
    let parameters = grade.variant.map(|variant| variant.parameters);
    let named = parameters.into_iter().flatten();
    named
        .map(|(name, value)| match value {
            ParameterValue::Number(number) => (name, vec![number]),
            ParameterValue::List(numbers) => (name, numbers),
            ParameterValue::Text(_) => (name, Vec::new()),
        })
        .collect()
}

fn unclear(unselected: &Unselected, of_lab: OfLab<'_>) -> Unclear {
    let other_labs = match unselected {
        Unselected::NothingFound { .. } => of_lab.others(),
        _ => None,
    };
    let files = unselected.candidates().iter();
    let candidates = files
        // one that is damaged is named in the problem, and cannot be chosen
        .filter_map(|found| SubmissionFile::of(found).ok())
        .collect();
    match other_labs {
        Some(labs) => Unclear {
            what: format!("the hand-in file in it is of another lab: {labs}"),
            help: "it belongs to that lab: ask for the hand-in file of this one".to_owned(),
            candidates,
        },
        None => Unclear {
            what: unselected.what(),
            help: unselected.help(),
            candidates,
        },
    }
}

/// Sorts hand-in files of a lab from those of others, whose labs it notes.
struct OfLab<'l> {
    lab: &'l str,
    others: RefCell<BTreeSet<String>>,
}

impl<'l> OfLab<'l> {
    fn new(lab: &'l str) -> Self {
        Self {
            lab,
            others: RefCell::default(),
        }
    }

    /// Whether it is a hand-in file of the lab, or one that cannot be read: nobody can say of which lab, and it is not passed over.
    fn has(&self, bytes: &[u8]) -> bool {
        match HandInFile::read(bytes) {
            Ok(file) if file.statement.lab == self.lab => true,
            Ok(file) => {
                self.others.borrow_mut().insert(file.statement.lab);
                false
            }
            Err(_) => true,
        }
    }

    /// The labs of the other hand-in files, in words; none where there was none.
    fn others(self) -> Option<String> {
        let others = self.others.into_inner();
        let names: Vec<String> = others.iter().map(|lab| format!("`{lab}`")).collect();
        (!names.is_empty()).then(|| names.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use kinemark_grader::record::grade::VariantRecord;
    use kinemark_grader::record::sample;

    use super::*;
    use crate::hand_in_file::HandedIn;
    use crate::tree::sample::{tree, zip};

    fn hand_in(lab: &str, variant_of: Option<&str>, submission: &[u8]) -> Vec<u8> {
        let mut practice = sample::graded().grade;
        lab.clone_into(&mut practice.lab.name);
        practice.variant = variant_of.map(|student| VariantRecord {
            student: Some(student.to_owned()),
            parameters: std::collections::BTreeMap::new(),
        });
        let file = HandInFile::new(HandedIn {
            made_with: MadeWith {
                engine: "kinemark 0.1.0".to_owned(),
                lab: "0".repeat(64),
            },
            student: None,
            file: "work.rhai",
            submission,
            sources: &[],
            practice: &practice,
        });
        file.and_then(|file| file.write()).unwrap()
    }

    fn of(files: &[(&str, &[u8])]) -> Result<SubmissionFile, Unclear> {
        let tree = tree(files);
        submission_of(&tree, &PersonFiles::of_all(&tree), "01")
    }

    #[test]
    fn a_hand_in_file_says_what_it_holds() {
        let file = hand_in("01", Some("s7"), b"let a = 1;");
        let found = of(&[("a.kinemark", &file), ("submission.rhai", b"other")]).unwrap();
        assert_eq!(found.path, "a.kinemark");
        assert_eq!(found.name, "work.rhai");
        assert_eq!(found.bytes, b"let a = 1;");
        assert_eq!(found.variant_of, StudentId::new("s7").ok());
        assert_eq!(found.made_with.unwrap().lab, "0".repeat(64));
    }

    #[test]
    fn a_hand_in_file_of_another_lab_is_not_graded() {
        let other = hand_in("02", None, b"x");
        let unclear = of(&[("a.kinemark", &other)]).unwrap_err();
        assert_eq!(
            unclear.what,
            "the hand-in file in it is of another lab: `02`"
        );
        // beside the right one it does not matter
        let right = hand_in("01", None, b"y");
        let found = of(&[("a.kinemark", &other), ("b.kinemark", &right)]).unwrap();
        assert_eq!(found.bytes, b"y");
    }

    #[test]
    fn a_damaged_hand_in_file_is_not_passed_over() {
        let mut file = hand_in("01", None, b"x");
        file.truncate(file.len() / 2);
        let unclear = of(&[("a.kinemark", &file), ("submission.rhai", b"old")]).unwrap_err();
        assert!(
            unclear
                .what
                .starts_with("`a.kinemark`: it is no whole hand-in file")
        );
        assert!(unclear.help.contains("kinemark submit"));
    }

    #[test]
    fn the_variant_beside_a_submission_is_seen_in_a_zipped_working_folder() {
        let variant: &[u8] =
            b"format = 1\nlab = \"01\"\nstudent = \"s9\"\n[parameters]\nline_x = 1.0\n";
        let folder = zip(&[
            ("01/submission.rhai", &b"a"[..]),
            ("01/variant.toml", variant),
        ]);
        let found = of(&[("01.zip", &folder)]).unwrap();
        assert_eq!(found.variant_of, StudentId::new("s9").ok());
        let found = of(&[("x/variant.toml", variant), ("submission.rhai", b"a")]).unwrap();
        assert_eq!(found.variant_of, None);
    }
}
