//! One hand-in to its record: from the book if the same was graded before, else graded now and kept.

use kinemark_grader::judge::Interrupted;
use kinemark_grader::record::verdict::Verdict;
use kinemark_grader::submission::handed_in::Program;
use kinemark_grader::submission::host::Host;
use kinemark_grader::task::files::Files;
use kinemark_grader::task::problem::LoadError;

use crate::book::{Book, BookError, Record};
use crate::journal::HandIn;
use crate::staffed_lab::{SALT_FILE, StaffedLab};
use crate::submission_source::SubmissionSource;

/// A hand-in, graded.
#[derive(Debug)]
pub enum Outcome {
    /// Its record is in the book.
    Recorded {
        /// The key of the record.
        record: String,
        /// Its points.
        points: f64,
        /// The maximum.
        max_points: f64,
        /// Whether the record was there before.
        was_known: bool,
    },
    /// This machine or the grader failed: no grade, and nothing is kept.
    NotGraded {
        /// `host-limit` or `grader-fault`.
        verdict: Verdict,
        /// What happened, in words.
        what: String,
    },
}

/// Why a hand-in was not graded at all.
#[derive(Debug, thiserror::Error)]
pub enum GradingError {
    /// The user interrupted it.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
    /// The lab, with the numbers of this student.
    #[error(transparent)]
    Lab(Box<LoadError>),
    /// The book.
    #[error(transparent)]
    Book(#[from] BookError),
}

impl From<LoadError> for GradingError {
    fn from(error: LoadError) -> Self {
        Self::Lab(Box::new(error))
    }
}

/// Grades `hand_in` in `lab`, unless the book has its record; with `pages`, a run that is graded now leaves its page in the book.
///
/// # Errors
/// [`GradingError`].
pub fn grade(
    lab: &StaffedLab,
    book: &Book,
    hand_in: &HandIn,
    host: &mut dyn Host,
    pages: bool,
) -> Result<Outcome, GradingError> {
    let bytes = book.submission(&hand_in.submission)?;
    let sources = book.sources(hand_in.sources.as_deref())?;
    let submission = SubmissionSource::new(&hand_in.file, &bytes).with_sources(sources);
    let source = &submission.submission;
    let whose = hand_in.variant_of.as_ref().unwrap_or(&hand_in.student);
    let student_lab = lab.for_student(whose)?;
    let inputs = lab.inputs(&student_lab, source, hand_in);
    let key = inputs.key();
    if let Some(record) = book.record(&key)? {
        return Ok(recorded(&record, true));
    }
    let (lab, staff) = (student_lab.lab(), student_lab.staff());
    let graded = submission.grade(lab, staff, host)?;
    let verdict = graded.grade.verdict;
    if !verdict.is_decided() {
        let mut stops = graded.grade.tasks.iter();
        let stop =
            stops.find_map(|task| (task.verdict == verdict).then(|| task.stopped.clone())?);
        return Ok(Outcome::NotGraded {
            verdict,
            what: stop.map_or_else(|| verdict.name().to_owned(), |stop| stop.message),
        });
    }
    if pages {
        // before the record: a record that is there has its page
        let is_module = matches!(source.program(), Program::Module(_));
        let script = (!is_module).then_some(submission.bytes.as_slice());
        book.put_page(&key, &graded, script)?;
        book.put_page_sources(&graded.grade.lab.name, &key, &submission.sources)?;
    }
    let record = Record::new(inputs, graded.grade);
    book.put_record(&record)?;
    Ok(recorded(&record, false))
}

/// The key that the record of `hand_in` would have in `lab`; nothing is run.
///
/// # Errors
/// A submission that the book has lost, or a lab with the student's numbers that cannot be loaded.
pub fn key(lab: &StaffedLab, book: &Book, hand_in: &HandIn) -> Result<String, GradingError> {
    let bytes = book.submission(&hand_in.submission)?;
    let sources = book.sources(hand_in.sources.as_deref())?;
    let submission = SubmissionSource::new(&hand_in.file, &bytes).with_sources(sources);
    let whose = hand_in.variant_of.as_ref().unwrap_or(&hand_in.student);
    let student_lab = lab.for_student(whose)?;
    let inputs = lab.inputs(&student_lab, &submission.submission, hand_in);
    Ok(inputs.key())
}

/// What a grade was made from, as the book kept it.
#[derive(Debug)]
pub struct Reopened {
    /// The lab with its staff part, of that day.
    pub lab: StaffedLab,
    /// The submission.
    pub submission: SubmissionSource,
}

/// The lab and the submission of a record, whatever has become of the lab since.
///
/// # Errors
/// A version that the book has lost, or a lab that this engine refuses.
pub fn reopen(book: &Book, record: &Record) -> Result<Reopened, GradingError> {
    let inputs = &record.inputs;
    let files = book.lab(&inputs.lab_version);
    let staff = inputs
        .staff_version
        .as_ref()
        .map(|version| book.staff(version));
    let staff = staff.as_ref().map(|staff| staff as &dyn Files);
    let name = &inputs.lab_name;
    // the salt of the course is kept with its staff part
    let salt = staff.and_then(|staff| staff.read(&format!("{name}/{SALT_FILE}")).ok().flatten());
    let has_variant = inputs.variant_of.is_some();
    let bytes = book.submission(&inputs.submission)?;
    let sources = book.sources(inputs.sources.as_deref())?;
    Ok(Reopened {
        lab: StaffedLab::load(&files, staff, name, salt.as_deref(), has_variant)?,
        submission: SubmissionSource::new(&inputs.file, &bytes).with_sources(sources),
    })
}

fn recorded(record: &Record, was_known: bool) -> Outcome {
    Outcome::Recorded {
        record: record.key.clone(),
        points: record.grade.points,
        max_points: record.grade.max_points,
        was_known,
    }
}
