//! From what the LMS exported to hand-ins: each file to its student, or to a person as a question.

use std::collections::BTreeMap;
use std::path::Path;

use kinemark_grader::submission::handed_in::Submission;

use crate::book::{Book, BookError};
use crate::fixes::{FileFix, Fixes};
use crate::journal::HandIn;
use crate::layout::{PersonFiles, arrange};
use crate::matching::{Matched, Matcher, Unmatched};
use crate::question::{Candidate, Question};
use crate::roster::Roster;
use crate::student::StudentId;
use crate::submission_file::{SubmissionFile, submission_of};
use crate::tree::{Limits, Tree, TreeError};

/// What a source held.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Intake {
    /// The name of the layout in which its files are.
    pub layout: String,
    /// Why it is that one, in words.
    pub reason: String,
    /// Attempts whose student is clear.
    pub hand_ins: Vec<HandIn>,
    /// What is not clear.
    pub questions: Vec<Question>,
    /// Paths that count for nobody, because people decided so.
    pub ignored: Vec<String>,
}

/// What a person decided on a question.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Decision {
    /// It belongs to a student.
    HandIn(Box<HandIn>),
    /// It belongs to nobody.
    Ignored,
}

/// The numbers of a student's variant in the course, by name; none where everybody has the same.
pub type NumbersOf<'n> = &'n dyn Fn(&StudentId) -> Option<Vec<(String, Vec<f64>)>>;

/// What `fixes` say of a question; `None` where they say nothing yet, or not which of its files is meant.
pub fn decision(question: &Question, fixes: &Fixes, numbers_of: NumbersOf<'_>) -> Option<Decision> {
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
                question, student, file, numbers_of,
            ))));
        }
    }
    None
}

/// A hand-in that a person assigned: graded with the variant of that student, whatever the file says.
fn decided(
    question: &Question,
    student: &StudentId,
    file: &Candidate,
    numbers_of: NumbersOf<'_>,
) -> HandIn {
    let name = file.file.as_deref();
    HandIn {
        id: String::new(),
        student: student.clone(),
        lab: question.lab.clone(),
        submission: file.submission.clone(),
        file: name
            .unwrap_or_else(|| file.path.rsplit('/').next().unwrap_or(&file.path))
            .to_owned(),
        sources: file.sources.clone(),
        is_without_sources: file.is_without_sources,
        matched_by: "fixes".to_owned(),
        submitted_at: question.submitted_at,
        marked_late: question.marked_late,
        attempt: question.attempt,
        lms_number: question.lms_number.clone(),
        variant_of: None,
        made_with: file.made_with.clone(),
        has_other_numbers: has_other_numbers(&file.numbers, student, numbers_of),
        places: question.places(file),
    }
    .identified()
}

/// Whether numbers that came with a submission are others than the student's; a name that the course does not have is none of them.
fn has_other_numbers(
    given: &[(String, Vec<f64>)],
    student: &StudentId,
    numbers_of: NumbersOf<'_>,
) -> bool {
    if given.is_empty() {
        return false;
    }
    let Some(own) = numbers_of(student) else {
        return false;
    };
    given.iter().any(|(name, values)| {
        let mut own = own.iter();
        own.any(|(known, of_course)| known == name && of_course != values)
    })
}

/// Why a source cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum IntakeError {
    /// The source as a whole.
    #[error(transparent)]
    Tree(#[from] TreeError),
    /// The book, which keeps what is read.
    #[error(transparent)]
    Book(#[from] BookError),
}

/// Reads a source, an archive or a folder, and keeps the submissions in it. Nothing is guessed: whatever is not clear is a question.
///
/// # Errors
/// A source that cannot be read at all, or a book that cannot be written to.
pub fn read(
    source: &Path,
    lab: &str,
    roster: &Roster,
    fixes: &Fixes,
    book: &Book,
    numbers_of: NumbersOf<'_>,
) -> Result<Intake, IntakeError> {
    let tree = Tree::open(source, &Limits::default())?;
    let arrangement = arrange(&tree);
    let matches = Matcher::new(roster).students_of_all(&arrangement.people);
    let reading = Reading {
        tree: &tree,
        lab,
        roster,
        fixes,
        book,
        numbers_of,
    };
    let (mut rows, mut ignored) = (Vec::new(), Vec::new());
    for (person, matched) in arrangement.people.iter().zip(matches) {
        let fix = reading.fix(person);
        if fix.is_some_and(|fix| fix.student.is_none()) {
            ignored.push(person.label.clone());
        } else {
            rows.extend(reading.rows(person, fix, matched)?);
        }
    }
    let mut intake = Intake {
        layout: arrangement.layout.name.to_owned(),
        reason: arrangement.reason,
        ignored,
        ..Intake::default()
    };
    sort_out(rows, &mut intake);
    Ok(intake)
}

/// What a person's files come to.
enum Row {
    /// A hand-in, and the question that it becomes if the student has another one without any order between the two.
    HandIn(Box<(HandIn, Question)>),
    Question(Box<Question>),
}

impl Row {
    fn question(question: Question) -> Self {
        Self::Question(Box::new(question))
    }
}

struct Reading<'r> {
    tree: &'r Tree,
    lab: &'r str,
    roster: &'r Roster,
    fixes: &'r Fixes,
    book: &'r Book,
    numbers_of: NumbersOf<'r>,
}

impl Reading<'_> {
    /// What a person decided on someone's files as a whole.
    fn fix(&self, person: &PersonFiles) -> Option<&FileFix> {
        let mut fixes = self.fixes.files.iter();
        fixes.find(|fix| fix.lab == self.lab && fix.path == person.label)
    }

    /// The rows of a person's files: one a student, or one question.
    fn rows(
        &self,
        person: &PersonFiles,
        fix: Option<&FileFix>,
        matched: Result<Matched, Unmatched>,
    ) -> Result<Vec<Row>, BookError> {
        let matched = match fix.and_then(|fix| fix.student.clone()) {
            Some(student) => Ok(Matched {
                students: vec![student],
                by: "fixes",
            }),
            None => matched,
        };
        let mut question = Question {
            lab: self.lab.to_owned(),
            path: person.label.clone(),
            problem: String::new(),
            help: String::new(),
            student: None,
            near: Vec::new(),
            submitted_at: person.submitted_at,
            marked_late: person.marked_late,
            attempt: person.attempt,
            lms_number: person.lms_number.clone(),
            candidates: Vec::new(),
        };
        if let Ok(matched) = &matched {
            question.student = matched.students.first().cloned();
        }
        if let Some(problem) = person.problems.first() {
            question.problem.clone_from(&problem.what);
            question.help.clone_from(&problem.help);
            return Ok(vec![Row::question(question)]);
        }
        let file = match submission_of(self.tree, person, self.lab) {
            Ok(file) => file,
            Err(unclear) => {
                question.problem = unclear.what;
                question.help = unclear.help;
                for file in &unclear.candidates {
                    question.candidates.push(self.candidate(file)?);
                }
                return Ok(vec![Row::question(question)]);
            }
        };
        let candidate = self.candidate(&file)?;
        question.candidates.push(candidate.clone());
        match matched.or_else(|unmatched| self.by_claim(&file, unmatched)) {
            Ok(matched) => Ok(self.hand_ins(&matched, &file, &candidate, &question)),
            Err(unmatched) => {
                question.problem = unmatched.why;
                question.help = unmatched.help;
                question.near = unmatched.nearest;
                Ok(vec![Row::question(question)])
            }
        }
    }

    /// The student whom a hand-in file names, where the source says nothing that speaks for anybody.
    fn by_claim(&self, file: &SubmissionFile, unmatched: Unmatched) -> Result<Matched, Unmatched> {
        let claimed = file.student.as_ref();
        let people = self.roster.people();
        let claimed = people.iter().find(|person| is_same(claimed, &person.id));
        let claimed = claimed.map(|person| &person.id);
        match claimed {
            Some(student) if unmatched.nearest.is_empty() => Ok(Matched {
                students: vec![student.clone()],
                by: "hand-in file",
            }),
            Some(student) => Err(Unmatched {
                help: format!(
                    "the hand-in file says that it is of `{student}`: name them in fixes.toml if so"
                ),
                nearest: vec![student.clone()],
                ..unmatched
            }),
            None => Err(unmatched),
        }
    }

    fn candidate(&self, file: &SubmissionFile) -> Result<Candidate, BookError> {
        Ok(Candidate {
            path: file.path.clone(),
            submission: self.book.put_submission(&file.bytes)?,
            file: Some(file.name.clone()),
            sources: self.book.put_sources(&file.sources)?,
            is_without_sources: file.sources.is_empty()
                && file.bytes.starts_with(Submission::MODULE_MAGIC),
            made_with: file.made_with.clone(),
            numbers: file.numbers.clone(),
        })
    }

    /// A hand-in for every student of `matched`: one, or the members of a group.
    fn hand_ins(
        &self,
        matched: &Matched,
        file: &SubmissionFile,
        candidate: &Candidate,
        question: &Question,
    ) -> Vec<Row> {
        if let Some(problem) = somebody_else(matched, file) {
            return vec![Row::question(Question {
                problem,
                help: "ask whose work it is; a fix with `student` grades it as that student's"
                    .to_owned(),
                ..question.clone()
            })];
        }
        let rows = matched.students.iter().map(|student| {
            // a group works with the numbers of one of them
            let owner = matched
                .students
                .iter()
                .find(|other| *other != student && is_same(file.variant_of.as_ref(), other));
            let whose = owner.unwrap_or(student);
            let hand_in = HandIn {
                matched_by: matched.by.to_owned(),
                variant_of: owner.cloned(),
                has_other_numbers: has_other_numbers(&file.numbers, whose, self.numbers_of),
                ..decided(question, student, candidate, self.numbers_of)
            };
            let question = Question {
                student: Some(student.clone()),
                ..question.clone()
            };
            Row::HandIn(Box::new((hand_in, question)))
        });
        rows.collect()
    }
}

/// Whether an id that a student's machine says is the one of the roster; how its letters are typed does not count.
fn is_same(said: Option<&StudentId>, student: &StudentId) -> bool {
    said.is_some_and(|said| said.folded() == student.folded())
}

/// What says that the work is of somebody who did not hand it in, in words; nothing where a person has decided.
fn somebody_else(matched: &Matched, file: &SubmissionFile) -> Option<String> {
    let is_other = |id: &&StudentId| {
        let mut students = matched.students.iter();
        matched.by != "fixes" && !students.any(|student| is_same(Some(id), student))
    };
    if let Some(other) = file.variant_of.as_ref().filter(is_other) {
        let what = match file.made_with {
            Some(_) => "the hand-in file was made with the variant",
            None => "the variant.toml beside the submission is that",
        };
        return Some(format!("{what} of `{other}`, who is somebody else"));
    }
    let other = file.student.as_ref().filter(is_other)?;
    Some(format!(
        "the hand-in file says that it is of `{other}`, who is somebody else"
    ))
}

/// Hand-ins and questions; two hand-ins of a student that nothing puts in an order are questions, unless they are the same file.
fn sort_out(rows: Vec<Row>, intake: &mut Intake) {
    let mut of_student: BTreeMap<StudentId, Vec<(HandIn, Question)>> = BTreeMap::new();
    for row in rows {
        match row {
            Row::Question(question) => intake.questions.push(*question),
            Row::HandIn(row) => of_student
                .entry(row.0.student.clone())
                .or_default()
                .push(*row),
        }
    }
    for (student, mut all) in of_student {
        all.dedup_by(|one, other| one.0.id == other.0.id);
        let order = |hand_in: &HandIn| (hand_in.submitted_at, hand_in.attempt);
        let has_twin = |at: usize| {
            let mut others = all.iter().enumerate();
            others.any(|(i, (other, _))| i != at && order(other) == order(&all[at].0))
        };
        let twins: Vec<bool> = (0..all.len()).map(has_twin).collect();
        for ((hand_in, question), is_twin) in all.into_iter().zip(twins) {
            if is_twin && hand_in.matched_by != "fixes" {
                intake.questions.push(Question {
                    problem: format!(
                        "`{student}` has another file, and nothing says which is the later one"
                    ),
                    help: "name the one that counts in fixes.toml, and ignore the other".to_owned(),
                    ..question
                });
            } else {
                intake.hand_ins.push(hand_in);
            }
        }
    }
}
