//! What happened in a course: who handed in what, which record is the grade of which hand-in, and why. Lines of JSON that are only
//! ever appended; each command writes a file of its own, so that two can write at once and two books join by copying.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};

use jiff::Timestamp;
use kinemark_grader::record::verdict::Verdict;
use serde::{Deserialize, Serialize};

use crate::durable;
use crate::private_files::private_folder;
use crate::student::StudentId;

/// A line of the journal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// When it was written.
    pub at: Timestamp,
    /// The login of whoever ran the command.
    pub by: String,
    /// What happened.
    pub event: Event,
}

/// What happened.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Event {
    /// Something was handed in.
    HandIn(Box<HandIn>),
    /// A record became the grade of a hand-in.
    Graded(Graded),
    /// A hand-in could not be graded: this machine or the grader failed, twice. It has no grade, and no points.
    NotGraded {
        /// The hand-in's id.
        hand_in: String,
        /// `host-limit` or `grader-fault`.
        verdict: Verdict,
        /// What happened, in words.
        what: String,
    },
    /// A person decided that files count for nobody.
    Ignored {
        /// The lab.
        lab: String,
        /// Digests of their paths ([`crate::fixes::place`]).
        places: Vec<String>,
    },
    /// Grades went to the LMS.
    Released {
        /// The lab.
        lab: String,
        /// The form, such as `moodle`.
        to: String,
        /// The key of the record of each student whose grade went out.
        records: BTreeMap<StudentId, String>,
    },
}

/// One attempt of one student at one lab.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct HandIn {
    /// Its id: the same attempt read again is the same.
    pub id: String,
    /// The student.
    pub student: StudentId,
    /// The lab.
    pub lab: String,
    /// Digest of the submission.
    pub submission: String,
    /// The name of the submission's file.
    pub file: String,
    /// Digest of the archive of its sources in the book, where it is a module with some.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sources: Option<String>,
    /// Whether it is a module of which no source was handed in.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_without_sources: bool,
    /// How it was found to be theirs: `id`, `lms_id`, `username`, `name`, `email`, `repository`, `group`, `hand-in file`, `fixes`.
    pub matched_by: String,
    /// When it was handed in, where that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub submitted_at: Option<Timestamp>,
    /// Whether the LMS marked it as late, where it marks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marked_late: Option<bool>,
    /// The number of the attempt at the LMS, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub attempt: Option<u32>,
    /// The number by which the LMS knows the student in its files, such as Moodle's participant number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lms_number: Option<String>,
    /// Whose variant is graded, where a group handed in that of another member.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variant_of: Option<StudentId>,
    /// What the hand-in file says of itself, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub made_with: Option<MadeWith>,
    /// Whether the variant that came with it has other numbers than the course's for this student.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub has_other_numbers: bool,
    /// Digests of the paths it was read from, its folder's and its own ([`crate::fixes::place`]): by them a decision finds it later.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub places: Vec<String>,
}

/// What a hand-in file says of how it was made.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct MadeWith {
    /// The engine.
    pub engine: String,
    /// Digest of the lab.
    pub lab: String,
}

impl HandIn {
    /// Its id: a digest of everything in it but the id.
    pub fn identified(mut self) -> Self {
        self.id = String::new();
        // how it was matched may change from one reading to the next, the attempt does not
        let parts = [
            self.student.as_str(),
            &self.lab,
            &self.submission,
            &self
                .submitted_at
                .map(|at| at.to_string())
                .unwrap_or_default(),
            &self.attempt.map(|n| n.to_string()).unwrap_or_default(),
        ];
        let mut hasher = blake3::Hasher::new();
        // a script has the id that it always had
        for part in parts.into_iter().chain(self.sources.as_deref()) {
            hasher.update(&(part.len() as u64).to_le_bytes());
            hasher.update(part.as_bytes());
        }
        self.id = hasher.finalize().to_hex()[..32].to_owned();
        self
    }
}

/// A record became the grade of a hand-in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Graded {
    /// The hand-in's id.
    pub hand_in: String,
    /// The key of the record.
    pub record: String,
    /// Its points, so that they are known even if the record is lost.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<f64>,
    /// Why, where it replaces an earlier grade.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

/// The journal's folder.
#[derive(Debug, Clone)]
pub struct Journal {
    folder: PathBuf,
}

/// A line that cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("`{}`, line {line}: {why}", path.display())]
pub struct JournalError {
    /// The file.
    pub path: PathBuf,
    /// The line, from one.
    pub line: usize,
    /// Why.
    pub why: String,
}

impl Journal {
    /// The journal in `folder`, which need not exist yet.
    pub fn new(folder: PathBuf) -> Self {
        Self { folder }
    }

    /// The files of the journal, by name: the order in which they were begun.
    ///
    /// # Errors
    /// A folder that cannot be listed.
    pub fn files(&self) -> io::Result<Vec<PathBuf>> {
        let entries = match std::fs::read_dir(&self.folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(error),
        };
        let mut files = Vec::new();
        for entry in entries {
            let path = entry?.path();
            if path.extension().is_some_and(|ending| ending == "jsonl") {
                files.push(path);
            }
        }
        files.sort();
        Ok(files)
    }

    /// What changes whenever something is appended: a digest of the names and sizes of its files.
    ///
    /// # Errors
    /// A folder that cannot be listed.
    pub fn state(&self) -> io::Result<String> {
        let mut hasher = blake3::Hasher::new();
        for path in self.files()? {
            let size = match path.metadata() {
                Ok(file) => file.len(),
                // another command removed its empty one
                Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                Err(error) => return Err(error),
            };
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            hasher.update(format!("{name} {size}\n").as_bytes());
        }
        Ok(hasher.finalize().to_hex().to_string())
    }

    /// Everything that happened, in the order of time. What two joined books both have is there once.
    ///
    /// # Errors
    /// A file that cannot be read, or a line that is none of this version. A last line without its end is what a killed process left
    /// and does not count.
    pub fn entries(&self) -> Result<Vec<Entry>, JournalError> {
        let unread = |path: &Path, line: usize, why: String| JournalError {
            path: path.to_owned(),
            line,
            why,
        };
        let files = self
            .files()
            .map_err(|error| unread(&self.folder, 0, error.to_string()))?;
        let mut entries: Vec<Entry> = Vec::new();
        for path in files {
            let bytes = match std::fs::read(&path) {
                Ok(bytes) => bytes,
                // another command removed its empty one
                Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                Err(error) => return Err(unread(&path, 0, error.to_string())),
            };
            // bytes: a line may be torn within a character
            for (i, line) in bytes.split_inclusive(|byte| *byte == b'\n').enumerate() {
                let Some(line) = line.strip_suffix(b"\n") else {
                    continue;
                };
                let entry = serde_json::from_slice(line)
                    .map_err(|error| unread(&path, i + 1, error.to_string()))?;
                entries.push(entry);
            }
        }
        // stable: what has the same time stays in the order of the files
        entries.sort_by_key(|entry| entry.at);
        entries.dedup();
        Ok(entries)
    }

    /// Starts a file of this journal for one command.
    ///
    /// # Errors
    /// A folder that cannot be written to.
    pub fn begin(&self, at: Timestamp, by: &str) -> io::Result<Writer> {
        private_folder(&self.folder)?;
        // a name without `:` and in the order of time
        let prefix = at.strftime("%Y%m%dT%H%M%S%.6fZ-").to_string();
        let file = tempfile::Builder::new()
            .prefix(&prefix)
            .suffix(".jsonl")
            .rand_bytes(10)
            .tempfile_in(&self.folder)?;
        let (file, path) = file.keep().map_err(|error| error.error)?;
        Ok(Writer {
            file,
            path,
            by: by.to_owned(),
            length: 0,
            is_torn: false,
        })
    }
}

/// A file of the journal that is being written.
#[derive(Debug)]
pub struct Writer {
    file: File,
    path: PathBuf,
    by: String,
    /// Bytes of whole lines.
    length: u64,
    /// Whether a part of a line follows them that could not be taken back.
    is_torn: bool,
}

impl Writer {
    /// Appends what happened. When this returns, a process that is killed loses it no more.
    ///
    /// # Errors
    /// A full disk; the line is then not there, or it is the last one, without its end: nothing is ever written behind it.
    pub fn append(&mut self, at: Timestamp, event: Event) -> io::Result<()> {
        let entry = Entry {
            at,
            by: self.by.clone(),
            event,
        };
        let mut line = serde_json::to_string(&entry).map_err(io::Error::other)?;
        line.push('\n');
        if self.is_torn {
            return Err(io::Error::other("an earlier line is torn"));
        }
        if let Err(error) = self.file.write_all(line.as_bytes()) {
            self.is_torn = self.take_back().is_err();
            return Err(error);
        }
        self.length += line.len() as u64;
        Ok(())
    }

    /// Ends the file behind its last whole line.
    fn take_back(&mut self) -> io::Result<()> {
        self.file.set_len(self.length)?;
        self.file.seek(SeekFrom::Start(self.length)).map(drop)
    }

    /// Ends the file: what it holds is on the disk. An empty one is removed.
    ///
    /// # Errors
    /// What the system says.
    pub fn finish(self) -> io::Result<()> {
        if self.length == 0 {
            return std::fs::remove_file(self.path);
        }
        self.file.sync_all()?;
        durable::sync_folder(durable::parent(&self.path))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hand_in(student: &str) -> HandIn {
        HandIn {
            id: String::new(),
            student: StudentId::new(student).unwrap(),
            lab: "01-kinematics".to_owned(),
            submission: "aa".to_owned(),
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

    fn at(second: i64) -> Timestamp {
        Timestamp::from_second(second).unwrap()
    }

    #[test]
    fn what_is_appended_is_read_in_the_order_of_time_and_a_torn_line_is_not() {
        let bed = tempfile::tempdir().unwrap();
        let journal = Journal::new(bed.path().join("journal"));
        assert!(journal.entries().unwrap().is_empty());
        let mut later = journal.begin(at(20), "b").unwrap();
        later
            .append(at(21), Event::HandIn(Box::new(hand_in("s2"))))
            .unwrap();
        let mut sooner = journal.begin(at(10), "a").unwrap();
        sooner
            .append(at(11), Event::HandIn(Box::new(hand_in("s1"))))
            .unwrap();
        sooner.finish().unwrap();
        later
            .file
            .write_all("{\"by\":\"é".as_bytes().split_last().unwrap().1)
            .unwrap();
        let students: Vec<String> = journal
            .entries()
            .unwrap()
            .into_iter()
            .map(|entry| match entry.event {
                Event::HandIn(hand_in) => hand_in.student.to_string(),
                _ => String::new(),
            })
            .collect();
        assert_eq!(students, ["s1", "s2"]);
    }

    /// A disk that is full in the middle of a line: what was written of it goes, and the next line stands by itself.
    #[test]
    fn a_line_that_could_not_be_written_is_taken_back() {
        let bed = tempfile::tempdir().unwrap();
        let journal = Journal::new(bed.path().to_owned());
        let event = |student| Event::HandIn(Box::new(hand_in(student)));
        let mut writer = journal.begin(at(1), "a").unwrap();
        writer.append(at(1), event("s1")).unwrap();
        writer.file.write_all(b"{\"at\":").unwrap();
        writer.take_back().unwrap();
        writer.append(at(2), event("s2")).unwrap();
        assert_eq!(journal.entries().unwrap().len(), 2);
    }

    /// Where it cannot be taken back, nothing is written behind it: a torn line in the middle would make the journal unreadable.
    #[cfg(target_os = "linux")]
    #[test]
    fn nothing_is_written_behind_a_torn_line() {
        let mut writer = Writer {
            file: File::options().write(true).open("/dev/full").unwrap(),
            path: PathBuf::new(),
            by: "a".to_owned(),
            length: 0,
            is_torn: false,
        };
        let event = || Event::HandIn(Box::new(hand_in("s1")));
        assert!(writer.append(at(1), event()).is_err());
        let bed = tempfile::tempdir().unwrap();
        writer.file = File::create(bed.path().join("file")).unwrap();
        let error = writer.append(at(2), event()).unwrap_err();
        assert_eq!(error.to_string(), "an earlier line is torn");
        assert_eq!(bed.path().join("file").metadata().unwrap().len(), 0);
    }

    #[test]
    fn two_copies_of_a_file_are_one_and_an_empty_one_goes() {
        let bed = tempfile::tempdir().unwrap();
        let journal = Journal::new(bed.path().to_owned());
        let mut writer = journal.begin(at(1), "a").unwrap();
        writer
            .append(at(1), Event::HandIn(Box::new(hand_in("s1"))))
            .unwrap();
        let path = writer.path.clone();
        writer.finish().unwrap();
        std::fs::copy(&path, bed.path().join("copy.jsonl")).unwrap();
        assert_eq!(journal.entries().unwrap().len(), 1);
        journal.begin(at(2), "a").unwrap().finish().unwrap();
        assert_eq!(journal.files().unwrap().len(), 2);
    }

    #[test]
    fn the_id_of_a_hand_in_is_that_of_the_attempt() {
        let one = hand_in("s1");
        let again = HandIn {
            sources: None,
            is_without_sources: false,
            matched_by: "name".to_owned(),
            ..one.clone()
        }
        .identified();
        assert_eq!(one.id, again.id);
        let other = HandIn {
            attempt: Some(2),
            ..one.clone()
        }
        .identified();
        assert_ne!(one.id, other.id);
    }
}
