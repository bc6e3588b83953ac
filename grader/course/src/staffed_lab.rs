//! A lab of the course with the staff part, held in memory and ready for every student: their variant, their hidden cases, and the key
//! of their grade.

use kinemark_grader::audit;
use kinemark_grader::judge::{engine, engine_digest, parts};
use kinemark_grader::lab::copies::Copies;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::submission::handed_in::Submission;
use kinemark_grader::task::files::Files;
use kinemark_grader::task::problem::LoadError;

use crate::book::{Inputs, version_of};
use crate::journal::HandIn;
use crate::student::StudentId;
use crate::submission_file::numbers;

/// The file of a staff part's version that holds the course's salt.
pub const SALT_FILE: &str = "salt";

/// The engine that grades: its version and the digest of its sources, as `kinemark --version` prints it.
pub fn engine_id() -> String {
    format!("{} (engine {})", engine(), engine_digest())
}

/// The version of a lab's files, as [`StaffedLab::lab_version`] has it; `lab` has the default numbers.
pub fn lab_version(lab: &Lab) -> String {
    version_of(&owned(&lab.copies()))
}

/// A lab with the staff part.
#[derive(Debug)]
pub struct StaffedLab {
    /// The lab with the default numbers.
    pub lab: Lab,
    staff: Option<Staff>,
    copies: Copies,
    staff_copies: Copies,
    salt: Option<String>,
    has_variants: bool,
    /// The version of its files ([`crate::book::Book::put_lab`]).
    pub lab_version: String,
    /// The version of the staff part's files.
    pub staff_version: Option<String>,
}

/// A student's lab: their numbers, their hidden cases.
#[derive(Debug)]
pub enum StudentLab<'a> {
    /// Everybody has the same.
    Default(&'a Lab, Option<&'a Staff>),
    /// A variant.
    Variant(Box<Lab>, Option<Box<Staff>>),
}

impl StudentLab<'_> {
    /// The lab.
    pub fn lab(&self) -> &Lab {
        match self {
            Self::Default(lab, _) => lab,
            Self::Variant(lab, _) => lab,
        }
    }

    /// The staff part.
    pub fn staff(&self) -> Option<&Staff> {
        match self {
            Self::Default(_, staff) => *staff,
            Self::Variant(_, staff) => staff.as_deref(),
        }
    }
}

impl StaffedLab {
    /// Loads a lab with its staff part, whose code is tried. `salt` replaces that of `hidden.toml`; without `variants` everybody has the
    /// default numbers.
    ///
    /// # Errors
    /// [`LoadError`] if something in the files is wrong.
    pub fn load(
        files: &dyn Files,
        reference: Option<&dyn Files>,
        name: &str,
        salt: Option<&str>,
        variants: bool,
    ) -> Result<Self, LoadError> {
        let lab = Lab::load(files, name)?;
        let copies = lab.copies();
        let staff_copies = match reference {
            Some(reference) => staff_copies(reference, name, salt)?,
            None => Copies::default(),
        };
        let staff = match reference {
            Some(reference) => Staff::load(reference, &lab, salt)?,
            None => None,
        };
        if let Some(staff) = &staff {
            audit::staff_code(&lab, staff)?;
        }
        let own_salt = match reference {
            Some(reference) => Staff::salt(reference, name, salt)?,
            None => salt.map(str::to_owned),
        };
        Ok(Self {
            has_variants: variants && !lab.variants.is_empty() && own_salt.is_some(),
            salt: own_salt,
            lab_version: version_of(&owned(&copies)),
            staff_version: staff.is_some().then(|| version_of(&owned(&staff_copies))),
            lab,
            staff,
            copies,
            staff_copies,
        })
    }

    /// Whether the course staff's part takes part: without it only visible cases are judged.
    pub fn has_staff(&self) -> bool {
        self.staff.is_some()
    }

    /// The salt that draws hidden cases and variants, where there is one.
    pub fn salt(&self) -> Option<&str> {
        self.salt.as_deref()
    }

    /// Whether each student has numbers of their own.
    pub fn has_variants(&self) -> bool {
        self.has_variants
    }

    /// The numbers of a student's variant, by name; none where everybody has the same, and for an id that can have no variant.
    pub fn numbers_of(&self, student: &StudentId) -> Option<Vec<(String, Vec<f64>)>> {
        let salt = self.salt.as_deref().filter(|_| self.has_variants)?;
        let variant = self.lab.variant_of(salt, student.as_str()).ok()?;
        Some(numbers(variant.parameters()))
    }

    /// The files of the lab, to keep in the book.
    pub fn lab_files(&self) -> Vec<(String, Vec<u8>)> {
        owned(&self.copies)
    }

    /// The files of the staff part and the salt, to keep in the book.
    pub fn staff_files(&self) -> Vec<(String, Vec<u8>)> {
        owned(&self.staff_copies)
    }

    /// The lab of a student.
    ///
    /// # Errors
    /// [`LoadError`] where their numbers make no lab.
    pub fn for_student(&self, student: &StudentId) -> Result<StudentLab<'_>, LoadError> {
        let Some(salt) = self.salt.as_deref().filter(|_| self.has_variants) else {
            return Ok(StudentLab::Default(&self.lab, self.staff.as_ref()));
        };
        let variant = self.lab.variant_of(salt, student.as_str())?;
        let lab = Lab::load_variant(&self.copies, &self.lab.name, Some(&variant))?;
        let staff = match self.staff {
            Some(_) => Staff::load_for_student(&self.staff_copies, &lab, Some(salt))?,
            None => None,
        };
        Ok(StudentLab::Variant(Box::new(lab), staff.map(Box::new)))
    }

    /// What the grade of a submission in a student's lab follows from.
    pub fn inputs(
        &self,
        student_lab: &StudentLab<'_>,
        submission: &Submission,
        hand_in: &HandIn,
    ) -> Inputs {
        let (lab, staff) = (student_lab.lab(), student_lab.staff());
        let parts = parts(lab, staff, submission);
        let variant = lab.variant.as_ref();
        Inputs {
            engine: engine_id(),
            lab_name: lab.name.clone(),
            lab: parts.lab.digest,
            robot: parts.robot.digest,
            scenes: parts.scenes.into_iter().map(|scene| scene.digest).collect(),
            staff: parts.reference.map(|staff| staff.digest),
            variant_of: variant.and_then(|variant| variant.student().map(str::to_owned)),
            file: submission.name().to_owned(),
            submission: hand_in.submission.clone(),
            sources: hand_in.sources.clone(),
            lab_version: self.lab_version.clone(),
            staff_version: self.staff_version.clone(),
        }
    }
}

fn owned(copies: &Copies) -> Vec<(String, Vec<u8>)> {
    let files = copies.iter();
    files
        .map(|(path, bytes)| (path.to_owned(), bytes.to_owned()))
        .collect()
}

/// Copies of the staff part of a lab, with the salt where the course has one of its own.
fn staff_copies(reference: &dyn Files, lab: &str, salt: Option<&str>) -> Result<Copies, LoadError> {
    let mut copies = Copies::default();
    let mut paths: Vec<String> = ["solution.rhai", "hidden.toml", "mutants.toml"]
        .map(|name| format!("{lab}/{name}"))
        .to_vec();
    let mutants = reference.list(&format!("{lab}/mutants"));
    paths.extend(mutants.iter().map(|name| format!("{lab}/mutants/{name}")));
    for path in paths {
        let bytes = reference
            .bytes(&path)
            .map_err(|why| LoadError::Unreadable {
                path: format!("{}/{path}", reference.name()),
                why,
            })?;
        if let Some(bytes) = bytes {
            copies.add(path, bytes);
        }
    }
    if let Some(salt) = salt {
        copies.add(format!("{lab}/{SALT_FILE}"), salt);
    }
    Ok(copies)
}
