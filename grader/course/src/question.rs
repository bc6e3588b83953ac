//! What waits for a person: a file that nobody could be sure about, with the lines that would decide it. Kept until it is decided,
//! because its path may hold a name.

use std::io;
use std::path::PathBuf;

use jiff::Timestamp;
use kinemark_report::visible::visible;
use serde::{Deserialize, Serialize};

use crate::book::{Book, BookError, is_digest};
use crate::fixes::place;
use crate::journal::MadeWith;
use crate::student::StudentId;

/// A file or folder that a person has to decide on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// The lab.
    pub lab: String,
    /// The file or folder of the person, as the LMS named it.
    pub path: String,
    /// What is not clear, in words.
    pub problem: String,
    /// What to do, in words.
    pub help: String,
    /// Whose it is, where that is clear and something else is not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub student: Option<StudentId>,
    /// Ids that come near to what was found.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub near: Vec<StudentId>,
    /// When it was handed in, where that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub submitted_at: Option<Timestamp>,
    /// Whether the LMS marked it as late, where it marks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub marked_late: Option<bool>,
    /// The number of the attempt at the LMS, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub attempt: Option<u32>,
    /// The number by which the LMS knows the student in its files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lms_number: Option<String>,
    /// The submissions in it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub candidates: Vec<Candidate>,
}

/// A submission that may be meant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Candidate {
    /// Its path, as the LMS named it.
    pub path: String,
    /// Its digest in the book.
    pub submission: String,
    /// The name of the submission's file, where it is in a hand-in file or an archive.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Digest of the archive of its sources in the book, where it is a module with some.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sources: Option<String>,
    /// Whether it is a module of which no source was handed in.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_without_sources: bool,
    /// What the hand-in file says of itself, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub made_with: Option<MadeWith>,
    /// The numbers of the variant that came with it, by name; empty where none did.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub numbers: Vec<(String, Vec<f64>)>,
}

/// So many students are offered to choose from.
const MOST_NEAR: usize = 4;

/// A text as TOML has it; what cannot be seen is escaped, so that a copy of what is shown means the same.
fn quoted(text: &str) -> String {
    let mut quoted = "\"".to_owned();
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if visible(c.encode_utf8(&mut [0; 4])).chars().ne([c]) => {
                quoted += &match u32::from(c) {
                    code @ ..=0xffff => format!("\\u{code:04X}"),
                    code => format!("\\U{code:08X}"),
                };
            }
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

/// Digits of a question's name in the book.
const ID_DIGITS: usize = 32;

impl Question {
    /// Digests of the paths of one of its files ([`crate::fixes::place`]).
    pub fn places(&self, file: &Candidate) -> Vec<String> {
        let mut places = vec![place(&self.lab, &self.path)];
        if file.path != self.path {
            places.push(place(&self.lab, &file.path));
        }
        places
    }

    /// Its name in the book: the same question asked again is the same.
    fn id(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        hasher.update(self.lab.as_bytes());
        hasher.update(b"\n");
        hasher.update(self.path.as_bytes());
        for candidate in &self.candidates {
            hasher.update(b"\n");
            hasher.update(candidate.submission.as_bytes());
        }
        hasher.finalize().to_hex()[..ID_DIGITS].to_owned()
    }

    /// The tables for `fixes.toml` that decide it, to choose one from and to write the reason into: one a candidate, and one that
    /// ignores it.
    pub fn fixes(&self, by: &str) -> Vec<String> {
        let table = |path: &str, whose: &str| {
            format!(
                "[[files]]\nlab = {}\npath = {}\n{whose}\nwhy = \"\"\nby = {}\n",
                quoted(&self.lab),
                quoted(path),
                quoted(by)
            )
        };
        let students: Vec<&str> = match &self.student {
            Some(student) => vec![student.as_str()],
            None if self.near.is_empty() => vec!["ID"],
            None => {
                let near = self.near.iter().take(MOST_NEAR);
                near.map(StudentId::as_str).collect()
            }
        };
        let mut tables = Vec::new();
        for student in students {
            let whose = format!("student = {}", quoted(student));
            match self.candidates.as_slice() {
                [_] => tables.push(table(&self.path, &whose)),
                several => {
                    tables.extend(several.iter().map(|file| table(&file.path, &whose)));
                }
            }
        }
        tables.push(table(&self.path, "ignore = true"));
        tables
    }
}

impl Book {
    fn question_path(&self, id: &str) -> PathBuf {
        self.root().join("questions").join(format!("{id}.json"))
    }

    /// Keeps a question.
    ///
    /// # Errors
    /// A full disk.
    pub fn put_question(&self, question: &Question) -> Result<(), BookError> {
        let path = self.question_path(&question.id());
        let json = serde_json::to_vec(question);
        let written = json
            .map_err(io::Error::other)
            .and_then(|json| self.put(&path, &json));
        written.map_err(|error| BookError {
            path,
            why: error.to_string(),
        })
    }

    /// Forgets a question that was decided.
    ///
    /// # Errors
    /// What the system says.
    pub fn remove_question(&self, question: &Question) -> Result<(), BookError> {
        let path = self.question_path(&question.id());
        match std::fs::remove_file(&path) {
            Ok(()) => Ok(()),
            // another command was first
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
            Err(error) => Err(BookError {
                path,
                why: error.to_string(),
            }),
        }
    }

    /// All open questions, by lab and path.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn questions(&self) -> Result<Vec<Question>, BookError> {
        let folder = self.root().join("questions");
        let unread = |path: PathBuf, why: String| BookError { path, why };
        let entries = match std::fs::read_dir(&folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(unread(folder, error.to_string())),
        };
        let mut questions = Vec::new();
        for entry in entries {
            let path = entry
                .map_err(|error| unread(folder.clone(), error.to_string()))?
                .path();
            let name = path.file_name().and_then(|name| name.to_str());
            let id = name.and_then(|name| name.strip_suffix(".json"));
            // a copy that a synchronised folder made of a conflict is no question of its own
            if !id.is_some_and(|id| is_digest(id, ID_DIGITS)) {
                continue;
            }
            let bytes = match std::fs::read(&path) {
                Ok(bytes) => bytes,
                // another command decided it meanwhile
                Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                Err(error) => return Err(unread(path, error.to_string())),
            };
            let question: Question = serde_json::from_slice(&bytes)
                .map_err(|error| unread(path.clone(), error.to_string()))?;
            questions.push(question);
        }
        questions.sort_by(|one, other| (&one.lab, &one.path).cmp(&(&other.lab, &other.path)));
        Ok(questions)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn question() -> Question {
        let file = |name: &str| Candidate {
            path: format!("Müller \"x\"/{name}"),
            submission: name.to_owned(),
            file: None,
            sources: None,
            is_without_sources: false,
            made_with: None,
            numbers: Vec::new(),
        };
        Question {
            lab: "01".to_owned(),
            path: "Müller \"x\"".to_owned(),
            problem: "two scripts".to_owned(),
            help: "say which".to_owned(),
            student: None,
            near: vec![StudentId::new("s1").unwrap()],
            submitted_at: None,
            marked_late: None,
            attempt: None,
            lms_number: None,
            candidates: vec![file("a.rhai"), file("b.rhai")],
        }
    }

    #[test]
    fn a_question_is_kept_once_and_removed_when_decided() {
        let bed = tempfile::tempdir().unwrap();
        let book = Book::new(bed.path());
        assert!(book.questions().unwrap().is_empty());
        book.put_question(&question()).unwrap();
        book.put_question(&question()).unwrap();
        assert_eq!(book.questions().unwrap(), [question()]);
        book.remove_question(&question()).unwrap();
        book.remove_question(&question()).unwrap();
        assert!(book.questions().unwrap().is_empty());
    }

    #[test]
    fn its_lines_are_fixes() {
        let lines = question().fixes("ta");
        assert_eq!(lines.len(), 3);
        let reason = |table: &str| table.replace("why = \"\"", "why = \"asked them\"");
        let text = format!("format = 1\n{}\n{}", reason(&lines[0]), reason(&lines[2]));
        let source = kinemark_sim::text::Source::new("fixes.toml", text);
        let fixes = crate::fixes::Fixes::parse(&source).unwrap();
        assert_eq!(fixes.files[0].path, "Müller \"x\"/a.rhai");
        assert_eq!(fixes.files[1].student, None);
    }

    #[test]
    fn every_student_who_comes_near_has_a_table() {
        let mut question = question();
        question.candidates.truncate(1);
        question.near.push(StudentId::new("s2").unwrap());
        let tables = question.fixes("ta");
        assert_eq!(tables.len(), 3);
        assert!(tables[0].contains("student = \"s1\"") && tables[1].contains("student = \"s2\""));
    }

    #[test]
    fn what_cannot_be_seen_survives_a_copy() {
        for path in [
            "می\u{200c}خواهم",
            "\u{1f468}\u{200d}\u{1f469}",
            "a\tb \"c\" \\ \u{202e}x",
            "é",
        ] {
            let text = quoted(path);
            assert_eq!(visible(&text), text, "as shown");
            let table: toml::Table = format!("path = {text}").parse().unwrap();
            assert_eq!(table["path"].as_str(), Some(path));
        }
    }
}
