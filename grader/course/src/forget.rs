//! Removing a person from a book: what they handed in, their grades, and whatever nobody else needs.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::book::{Book, BookError};
use crate::index::INDEX_FILE;
use crate::journal::{Entry, Event};
use crate::private_files::{replace, sweep};
use crate::reports::{page_path, sources_path};
use crate::student::StudentId;

/// What was removed.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Forgotten {
    /// Lines of the journal.
    pub lines: usize,
    /// Records.
    pub records: usize,
    /// Submissions.
    pub submissions: usize,
    /// Open questions.
    pub questions: usize,
    /// Labs whose pages of the class went, because they had the person in them.
    pub pages: usize,
    /// Records of others that name the person because a group was graded with their variant; they stay.
    pub left: usize,
}

impl Book {
    /// Removes a student. A mark without their id stays, so that joining a book that still has them does not bring them back.
    ///
    /// # Errors
    /// What the system says; the same call again goes on where it stopped.
    pub fn forget(&self, student: &StudentId) -> Result<Forgotten, BookError> {
        let mark = self.mark_of(student);
        replace(&mark, b"").map_err(|error| failed(&mark, &error))?;
        let mut forgotten = Forgotten::default();
        let all = self.lines()?;
        let theirs: BTreeSet<String> = all
            .iter()
            .filter_map(|(_, entry)| match &entry.event {
                Event::HandIn(hand_in) if hand_in.student == *student => Some(hand_in.id.clone()),
                _ => None,
            })
            .collect();
        let (mut records, mut submissions) = (Needed::default(), Needed::default());
        for (_, entry) in &all {
            match &entry.event {
                Event::HandIn(hand_in) => {
                    let is_theirs = hand_in.student == *student;
                    submissions.add(&hand_in.submission, is_theirs);
                    if let Some(sources) = &hand_in.sources {
                        submissions.add(sources, is_theirs);
                    }
                    let is_left =
                        hand_in.student != *student && hand_in.variant_of.as_ref() == Some(student);
                    forgotten.left += usize::from(is_left);
                }
                Event::Graded(graded) => {
                    records.add(&graded.record, theirs.contains(&graded.hand_in));
                }
                Event::NotGraded { .. } | Event::Ignored { .. } | Event::Released { .. } => {}
            }
        }
        for question in self.questions()? {
            if question.student.as_ref() == Some(student) {
                self.remove_question(&question)?;
                forgotten.questions += 1;
            } else {
                for candidate in &question.candidates {
                    submissions.add(&candidate.submission, false);
                    if let Some(sources) = &candidate.sources {
                        submissions.add(sources, false);
                    }
                }
            }
        }
        forgotten.pages = self.remove_class_pages()?;
        // the journal last: until then another call finds what is left
        let keys = self.record_keys();
        for key in keys.map_err(|error| failed(&self.root().join("records"), &error))? {
            if records.others.contains(&key) {
                continue;
            }
            let is_graded = records.theirs.contains(&key);
            let Some(record) = self.record(&key)? else {
                // damaged: it can name anybody
                if is_graded {
                    forgotten.records += removed(&self.record_path(&key))?;
                }
                continue;
            };
            let inputs = &record.inputs;
            // also what was graded again to look at, and never became a grade
            let is_theirs = is_graded
                || inputs.variant_of.as_deref() == Some(student.as_str())
                || submissions.has_alone(&inputs.submission);
            if is_theirs {
                removed(&self.root().join(page_path(&inputs.lab_name, &key)))?;
                removed_folder(&self.root().join(sources_path(&inputs.lab_name, &key)))?;
                forgotten.records += removed(&self.record_path(&key))?;
            }
        }
        for digest in submissions.theirs.difference(&submissions.others) {
            forgotten.submissions += removed(&self.submission_path(digest))?;
        }
        // what killed processes left unfinished may be the person's
        sweep(self.root(), None).map_err(|error| failed(self.root(), &error))?;
        // deleted rows stay readable in a database until it is made anew
        removed(&self.root().join(INDEX_FILE))?;
        forgotten.lines = self.rewrite(&theirs, student)?;
        Ok(forgotten)
    }

    /// Whether a student was removed from this book.
    pub fn has_forgotten(&self, student: &StudentId) -> bool {
        self.mark_of(student).is_file()
    }

    fn mark_of(&self, student: &StudentId) -> PathBuf {
        let context = "kinemark 2026 a student who was removed from a book v1";
        let mark = blake3::derive_key(context, student.as_str().as_bytes());
        let name = blake3::Hash::from_bytes(mark).to_hex();
        self.root().join("forgotten").join(name.as_str())
    }

    /// Every entry of the journal with its file.
    fn lines(&self) -> Result<Vec<(PathBuf, Entry)>, BookError> {
        let mut lines = Vec::new();
        for path in self.journal_files()? {
            let bytes = std::fs::read(&path).map_err(|error| failed(&path, &error))?;
            for line in bytes.split(|byte| *byte == b'\n') {
                // the torn line of a killed process
                if let Ok(entry) = serde_json::from_slice(line) {
                    lines.push((path.clone(), entry));
                }
            }
        }
        Ok(lines)
    }

    fn journal_files(&self) -> Result<Vec<PathBuf>, BookError> {
        let files = self.journal().files();
        files.map_err(|error| failed(&self.root().join("journal"), &error))
    }

    /// Writes the journal without the person, file by file; gives the number of lines that went.
    fn rewrite(&self, theirs: &BTreeSet<String>, student: &StudentId) -> Result<usize, BookError> {
        let mut gone = 0;
        for path in self.journal_files()? {
            let bytes = std::fs::read(&path).map_err(|error| failed(&path, &error))?;
            let mut kept = Vec::new();
            let mut has_changed = false;
            for line in bytes.split_inclusive(|byte| *byte == b'\n') {
                let Ok(mut entry) = serde_json::from_slice::<Entry>(line) else {
                    if line.ends_with(b"\n") {
                        kept.extend_from_slice(line);
                    } else {
                        // torn, and perhaps the person's
                        has_changed = true;
                    }
                    continue;
                };
                if names(&entry.event, theirs) {
                    gone += 1;
                    has_changed = true;
                } else if takes_out(&mut entry.event, student) {
                    let line = serde_json::to_string(&entry).map_err(|error| BookError {
                        path: path.clone(),
                        why: error.to_string(),
                    })?;
                    kept.extend_from_slice(line.as_bytes());
                    kept.push(b'\n');
                    has_changed = true;
                } else {
                    kept.extend_from_slice(line);
                }
            }
            if has_changed {
                rewritten(&path, &kept).map_err(|error| failed(&path, &error))?;
            }
        }
        Ok(gone)
    }
}

/// Whether an event is about one of these hand-ins.
fn names(event: &Event, theirs: &BTreeSet<String>) -> bool {
    match event {
        Event::HandIn(hand_in) => theirs.contains(&hand_in.id),
        Event::Graded(graded) => theirs.contains(&graded.hand_in),
        Event::NotGraded { hand_in, .. } => theirs.contains(hand_in),
        Event::Ignored { .. } | Event::Released { .. } => false,
    }
}

/// Takes a person out of an event about many; whether they were in it.
fn takes_out(event: &mut Event, student: &StudentId) -> bool {
    match event {
        Event::Released { records, .. } => records.remove(student).is_some(),
        Event::HandIn(_) | Event::Graded(_) | Event::NotGraded { .. } | Event::Ignored { .. } => {
            false
        }
    }
}

/// What one person uses, and what others use.
#[derive(Default)]
struct Needed {
    theirs: BTreeSet<String>,
    others: BTreeSet<String>,
}

impl Needed {
    fn add(&mut self, name: &str, is_theirs: bool) {
        let of = if is_theirs {
            &mut self.theirs
        } else {
            &mut self.others
        };
        of.insert(name.to_owned());
    }

    /// What they alone use.
    fn has_alone(&self, name: &str) -> bool {
        self.theirs.contains(name) && !self.others.contains(name)
    }
}

/// Removes a file; 1 if it was there.
fn removed(path: &Path) -> Result<usize, BookError> {
    match std::fs::remove_file(path) {
        Ok(()) => Ok(1),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(0),
        Err(error) => Err(failed(path, &error)),
    }
}

/// Removes a folder with everything in it, if it is there; a link is not followed.
fn removed_folder(path: &Path) -> Result<(), BookError> {
    match std::fs::remove_dir_all(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(failed(path, &error)),
        _ => Ok(()),
    }
}

/// Writes a file again, whole; an empty one is removed.
fn rewritten(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if bytes.is_empty() {
        return std::fs::remove_file(path);
    }
    replace(path, bytes)
}

fn failed(path: &Path, error: &io::Error) -> BookError {
    BookError {
        path: path.to_owned(),
        why: error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use jiff::Timestamp;

    use super::*;
    use crate::book::{Inputs, Record};
    use crate::history::History;
    use crate::journal::{Graded, HandIn};

    fn record(submission: &str) -> Record {
        let text = str::to_owned;
        let inputs = Inputs {
            engine: text("kinemark 0.1.0"),
            lab_name: text("01"),
            lab: text("l"),
            robot: text("r"),
            scenes: Vec::new(),
            staff: None,
            variant_of: None,
            file: text("submission.rhai"),
            submission: text(submission),
            sources: None,
            lab_version: text("v"),
            staff_version: None,
        };
        Record::new(inputs, kinemark_grader::record::sample::graded().grade)
    }

    fn hand_in(student: &str, submission: &str) -> HandIn {
        HandIn {
            id: String::new(),
            student: StudentId::new(student).unwrap(),
            lab: "01".to_owned(),
            submission: submission.to_owned(),
            file: "submission.rhai".to_owned(),
            sources: None,
            is_without_sources: false,
            matched_by: "id".to_owned(),
            submitted_at: None,
            marked_late: None,
            attempt: None,
            lms_number: None,
            variant_of: None,
            made_with: None,
            has_other_numbers: false,
            places: Vec::new(),
        }
        .identified()
    }

    /// Two people hand in the same file, one of them another one as well.
    #[test]
    fn what_others_need_stays_and_nothing_names_the_person() {
        let bed = tempfile::tempdir().unwrap();
        let book = Book::new(bed.path());
        let at = Timestamp::from_second(1).unwrap();
        let mut log = book.journal().begin(at, "ta").unwrap();
        let shared = book.put_submission(b"shared").unwrap();
        let own = book.put_submission(b"own").unwrap();
        let mut records = BTreeMap::new();
        for (student, digest) in [("s1", &shared), ("s2", &shared), ("s1", &own)] {
            let hand_in = hand_in(student, digest);
            let record = record(digest);
            book.put_record(&record).unwrap();
            records.insert(hand_in.student.clone(), record.key.clone());
            let graded = Graded {
                hand_in: hand_in.id.clone(),
                record: record.key.clone(),
                points: None,
                why: None,
            };
            log.append(at, Event::HandIn(Box::new(hand_in))).unwrap();
            log.append(at, Event::Graded(graded)).unwrap();
        }
        let released = Event::Released {
            lab: "01".to_owned(),
            to: "csv".to_owned(),
            records,
        };
        log.append(at, released).unwrap();
        log.finish().unwrap();
        let (first, second) = (StudentId::new("s1").unwrap(), StudentId::new("s2").unwrap());
        let gone = book.forget(&first).unwrap();
        assert_eq!((gone.lines, gone.records, gone.submissions), (4, 1, 1));
        assert!(book.has_forgotten(&first) && !book.has_forgotten(&second));
        let history = History::of(book.journal().entries().unwrap());
        assert!(history.attempts("01", &first).is_empty());
        let left = history.attempts("01", &second);
        assert!(book.has_record(left[0].record().unwrap()));
        assert!(book.submission(&shared).is_ok() && book.submission(&own).is_err());
        for path in book.journal().files().unwrap() {
            assert!(!std::fs::read_to_string(path).unwrap().contains("s1"));
        }
        for left in [".new-a", "submissions/.new-b", "staff/.new-c/01/salt"] {
            let path = book.root().join(left);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, "s1").unwrap();
        }
        let again = book.forget(&first).unwrap();
        assert_eq!(again, Forgotten::default());
        for left in [".new-a", "submissions/.new-b", "staff/.new-c"] {
            assert!(!book.root().join(left).exists(), "{left}");
        }
    }
}
