//! A lab of one task that a test writes beside the course's: graded by the binary, its report verified, its checks looked up.

use serde_json::Value as Json;

use crate::testbed::{Ran, TestBed};

/// A folder with the course's labs and one more.
pub(crate) struct OwnLab {
    bed: TestBed,
    name: &'static str,
    /// Its file as first written.
    text: &'static str,
}

impl OwnLab {
    pub(crate) fn new(name: &'static str, text: &'static str) -> Self {
        let bed = TestBed::new();
        bed.copy_labs();
        let lab = Self { bed, name, text };
        lab.bed.write(&lab.file(), text);
        lab
    }

    fn file(&self) -> String {
        format!("labs/{}/lab.toml", self.name)
    }

    /// Writes another file beside the labs.
    pub(crate) fn write(&self, name: &str, text: &str) {
        self.bed.write(name, text);
    }

    /// Replaces `from` by `to` in the lab's file, once.
    pub(crate) fn edit(&self, from: &str, to: &str) {
        self.bed.edit(&self.file(), from, to);
    }

    fn grade(&self, submission: &str) -> Ran {
        self.bed.write("mine.rhai", submission);
        self.bed
            .run(&["grade", self.name, "mine.rhai", "--practice"])
    }

    /// Grades a submission; its task as the record has it, after the report was verified.
    pub(crate) fn graded(&self, submission: &str, code: i32) -> Json {
        let ran = self.grade(submission);
        assert_eq!(ran.code, Some(code), "{ran:?}");
        let verified = self.bed.run(&["verify", "out"]);
        assert_eq!(verified.code, Some(0), "{verified:?}");
        let record: Json = serde_json::from_str(&self.written("grade.json")).expect("JSON");
        record["tasks"][0].clone()
    }

    /// A text of the report that was written last.
    pub(crate) fn written(&self, name: &str) -> String {
        let text = std::fs::read_to_string(self.bed.path("out").join(name));
        text.unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// With each of these edits, `(from, to, code, words)`, alone the lab is refused: at a place in its file, with the code and the words.
    pub(crate) fn is_refused(&self, submission: &str, edits: &[(&str, &str, &str, &str)]) {
        for (from, to, code, words) in edits {
            self.bed.write(&self.file(), self.text);
            self.edit(from, to);
            let ran = self.grade(submission);
            assert_eq!(ran.code, Some(3), "{to}: {ran:?}");
            // the report may break a line between words
            let plain = ran.stderr.replace("\n  │", "").replace('\n', " ");
            for word in [code, words, "lab.toml:"] {
                assert!(plain.contains(word), "{to}: no {word:?} in\n{}", ran.stderr);
            }
        }
    }
}

/// A check of a task, by its name.
pub(crate) fn check<'a>(task: &'a Json, name: &str) -> &'a Json {
    let checks = task["checks"].as_array().expect("checks");
    let found = checks.iter().find(|check| check["name"] == name);
    found.unwrap_or_else(|| panic!("no check {name}"))
}

/// What a check says first where points are lost.
pub(crate) fn message(check: &Json) -> &str {
    let message = check["evidence"][0]["message"].as_str();
    message.unwrap_or_else(|| panic!("no evidence: {check}"))
}

/// What a check measured.
pub(crate) fn value(task: &Json, name: &str) -> f64 {
    let value = check(task, name)["measure"]["value"].as_f64();
    value.unwrap_or_else(|| panic!("no value of {name}: {task}"))
}
