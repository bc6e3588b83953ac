//! What the LMS exported, and what people decided since, written into the journal of the course.

use std::collections::BTreeSet;
use std::path::Path;

use kinemark_course::course_file::CourseLab;
use kinemark_course::fixes::{FIXES_FILE, place};
use kinemark_course::history::History;
use kinemark_course::intake::{self, Decision, Intake, NumbersOf};
use kinemark_course::journal::{Event, HandIn};
use kinemark_course::question::Question;
use kinemark_course::staffed_lab::StaffedLab;
use kinemark_course::student::StudentId;
use kinemark_report::visible::visible;

use crate::course_folder::{Course, book_failure, intake_failure};
use crate::course_log::CourseLog;
use crate::failure::Failure;

/// What was read, as far as people want to know it.
#[derive(Debug, Default)]
pub(crate) struct TakenIn {
    /// How the files are arranged, and why it is that.
    layout: Option<(String, String)>,
    /// Students whose earlier file is the latest again.
    again: BTreeSet<StudentId>,
    /// Paths of `fixes.toml` of which nothing was read.
    unread: Vec<String>,
}

impl TakenIn {
    /// It in lines.
    pub(crate) fn text(&self) -> String {
        let mut out = String::new();
        if let Some((layout, reason)) = &self.layout {
            out += &format!("read as {layout}: {}\n", visible(reason));
        }
        if !self.again.is_empty() {
            let students: Vec<&str> = self.again.iter().map(StudentId::as_str).collect();
            out += &format!(
                "handed in before, and the latest again: {}\n",
                students.join(", ")
            );
        }
        for path in &self.unread {
            out += &format!(
                "{FIXES_FILE}: nothing was read of `{}`: check the path, or give the source again\n",
                visible(path)
            );
        }
        out
    }
}

/// Reads the source, if there is one, and what people decided since.
pub(crate) fn take_in(
    course: &Course,
    rules: &CourseLab,
    lab: &StaffedLab,
    source: Option<&Path>,
    log: &mut CourseLog<'_>,
) -> Result<TakenIn, Failure> {
    let mut taking = Taking {
        course,
        lab: &rules.name,
        history: course.history()?,
        seen: BTreeSet::new(),
        places: BTreeSet::new(),
        log,
        taken: TakenIn::default(),
    };
    let numbers_of = |student: &StudentId| lab.numbers_of(student);
    if let Some(source) = source {
        taking.source(source, &numbers_of)?;
    }
    taking.decisions(&numbers_of)?;
    Ok(taking.taken)
}

struct Taking<'t, 'c> {
    course: &'t Course,
    lab: &'t str,
    history: History,
    /// Hand-ins that were written just now.
    seen: BTreeSet<String>,
    /// Digests of the paths of everything that was read or decided on just now.
    places: BTreeSet<String>,
    log: &'t mut CourseLog<'c>,
    taken: TakenIn,
}

impl Taking<'_, '_> {
    fn source(&mut self, source: &Path, numbers_of: NumbersOf<'_>) -> Result<(), Failure> {
        let course = self.course;
        let found = intake::read(
            source,
            self.lab,
            &course.roster,
            &course.fixes,
            &course.book,
            numbers_of,
        )
        .map_err(intake_failure)?;
        self.close_answered(&found)?;
        for path in &found.ignored {
            self.ignored(path)?;
        }
        self.taken.layout = Some((found.layout, found.reason));
        for hand_in in found.hand_ins {
            if self.history.is_anew(&hand_in) && self.seen.insert(hand_in.id.clone()) {
                self.taken.again.insert(hand_in.student.clone());
                self.log.append(Event::HandIn(Box::new(hand_in)))?;
            } else {
                self.hand_in(hand_in)?;
            }
        }
        for question in found.questions {
            self.places.insert(place(self.lab, &question.path));
            course.book.put_question(&question).map_err(book_failure)?;
        }
        Ok(())
    }

    fn hand_in(&mut self, hand_in: HandIn) -> Result<(), Failure> {
        self.places.extend(hand_in.places.iter().cloned());
        if self.history.knows(&hand_in.id) || !self.seen.insert(hand_in.id.clone()) {
            return Ok(());
        }
        self.log.append(Event::HandIn(Box::new(hand_in)))
    }

    /// Notes a file that counts for nobody, once.
    fn ignored(&mut self, path: &str) -> Result<(), Failure> {
        let place = place(self.lab, path);
        if self.history.has_ignored(&place) || !self.places.insert(place.clone()) {
            return Ok(());
        }
        self.log.append(Event::Ignored {
            lab: self.lab.to_owned(),
            places: vec![place],
        })
    }

    /// Removes questions about students of whom this source has a file that is clear and not the earlier one, and asks nothing.
    fn close_answered(&self, found: &Intake) -> Result<(), Failure> {
        let is_answered = |question: &Question| {
            let mut hand_ins = found.hand_ins.iter();
            hand_ins.any(|new| {
                let times = new.submitted_at.zip(question.submitted_at);
                Some(&new.student) == question.student.as_ref()
                    && times.is_none_or(|(new, asked)| new >= asked)
            })
        };
        for question in self.course.book.questions().map_err(book_failure)? {
            let is_asked = found.questions.iter().any(|new| new.path == question.path);
            if question.lab == self.lab && !is_asked && is_answered(&question) {
                let removed = self.course.book.remove_question(&question);
                removed.map_err(book_failure)?;
            }
        }
        Ok(())
    }

    /// What `fixes.toml` says of open questions, and of files that were read as somebody else's.
    fn decisions(&mut self, numbers_of: NumbersOf<'_>) -> Result<(), Failure> {
        let course = self.course;
        for question in course.book.questions().map_err(book_failure)? {
            if question.lab != self.lab {
                continue;
            }
            match intake::decision(&question, &course.fixes, numbers_of) {
                None => continue,
                Some(Decision::Ignored) => self.ignored(&question.path)?,
                Some(Decision::HandIn(hand_in)) => self.hand_in(*hand_in)?,
            }
            let removed = course.book.remove_question(&question);
            removed.map_err(book_failure)?;
        }
        let lab = self.lab;
        for fix in course.fixes.files.iter().filter(|fix| fix.lab == lab) {
            for hand_in in self.history.reassigned(fix) {
                self.hand_in(hand_in)?;
            }
            if !self.history.has_read(fix) && !self.places.contains(&fix.place()) {
                self.taken.unread.push(fix.path.clone());
            }
        }
        Ok(())
    }
}
