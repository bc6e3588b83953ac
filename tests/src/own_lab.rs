//! A lab that a test writes beside the course's: loaded and graded in this process, or graded by the binary, its report verified, its
//! checks looked up.

use std::cell::OnceCell;

use kinemark_grader::lab::load::lab_names;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::task::files::Files;
use kinemark_grader::task::problem::LoadError;
use serde_json::Value as Json;

use crate::schemas;
use crate::testbed::{CommandResult, Folder, TestBed, root};

/// The files of one lab, and of the course staff's part if it has one, next to the checkout's robots and scenes.
pub(crate) struct OwnLab {
    name: &'static str,
    /// By their paths in the folder of the lab.
    files: Vec<(&'static str, String)>,
    /// Where the binary finds them, beside the course's labs.
    bed: OnceCell<TestBed>,
}

impl OwnLab {
    pub(crate) fn new(name: &'static str, lab_toml: impl Into<String>) -> Self {
        Self {
            name,
            files: vec![("lab.toml", lab_toml.into())],
            bed: OnceCell::new(),
        }
    }

    /// The lab with a file of the course staff's part: `hidden.toml`, `solution.rhai` and so on.
    pub(crate) fn and(mut self, name: &'static str, text: impl Into<String>) -> Self {
        self.files.push((name, text.into()));
        self
    }

    /// The same lab with `from` replaced by `to` in one of its files.
    pub(crate) fn with(&self, name: &str, from: &str, to: &str) -> Self {
        let mut files = self.files.clone();
        let file = files.iter_mut().find(|(known, _)| *known == name);
        let (_, text) = file.unwrap_or_else(|| panic!("no {name}"));
        assert!(text.contains(from), "{name} has no {from:?}");
        *text = text.replacen(from, to, 1);
        Self {
            name: self.name,
            files,
            bed: OnceCell::new(),
        }
    }

    /// Loads the lab.
    pub(crate) fn load(&self) -> Result<Lab, LoadError> {
        assert_eq!(lab_names(self), [self.name]);
        let lab = Lab::load(self, self.name)?;
        self.is_valid_in_an_editor(&["lab"]);
        Ok(lab)
    }

    /// The lab, which nothing is wrong with.
    pub(crate) fn lab(&self) -> Lab {
        self.load().unwrap_or_else(|error| panic!("{error:?}"))
    }

    /// The course staff's part of the lab, which has no errors.
    pub(crate) fn staff(&self, lab: &Lab) -> Option<Staff> {
        let staff = Staff::load(self, lab, None).unwrap_or_else(|error| panic!("{error:?}"));
        self.is_valid_in_an_editor(&["hidden", "mutants"]);
        staff
    }

    /// What Kinemark reads, the published schemas allow.
    fn is_valid_in_an_editor(&self, kinds: &[&str]) {
        for (name, text) in &self.files {
            if let Some(kind) = kinds
                .iter()
                .find(|kind| name.strip_suffix(".toml") == Some(kind))
            {
                schemas::is_valid(kind, &format!("{}/{name}", self.name), text);
            }
        }
    }

    /// The folder of the binary, with this lab in it.
    pub(crate) fn bed(&self) -> &TestBed {
        self.bed.get_or_init(|| {
            let bed = TestBed::new();
            bed.copy_labs();
            for (name, text) in &self.files {
                let top = if *name == "lab.toml" {
                    "labs"
                } else {
                    "reference"
                };
                bed.write(&format!("{top}/{}/{name}", self.name), text);
            }
            bed
        })
    }

    fn lab_toml(&self) -> String {
        format!("labs/{}/lab.toml", self.name)
    }

    /// Writes another file beside the labs.
    pub(crate) fn write(&self, name: &str, text: &str) {
        self.bed().write(name, text);
    }

    /// Replaces `from` by `to` in the lab's file, once, where the binary finds it.
    pub(crate) fn edit(&self, from: &str, to: &str) {
        self.bed().edit(&self.lab_toml(), from, to);
    }

    pub(crate) fn grade(&self, submission: &str) -> CommandResult {
        self.bed().write("mine.rhai", submission);
        let mut args = vec!["grade", self.name, "mine.rhai"];
        // without a reference the grade is of the visible cases alone
        args.extend((self.files.len() == 1).then_some("--practice"));
        self.bed().run(&args)
    }

    /// The record of a submission that the binary grades with this exit code, after the report was verified.
    pub(crate) fn record(&self, submission: &str, code: i32) -> Json {
        let ran = self.grade(submission);
        assert_eq!(ran.code, Some(code), "{ran:?}");
        let verified = self.bed().run(&["verify", "out"]);
        assert_eq!(verified.code, Some(0), "{verified:?}");
        serde_json::from_str(&self.written("grade.json")).expect("JSON")
    }

    /// The only task of such a record.
    pub(crate) fn graded(&self, submission: &str, code: i32) -> Json {
        self.record(submission, code)["tasks"][0].clone()
    }

    /// A text of the report that was written last.
    pub(crate) fn written(&self, name: &str) -> String {
        let text = std::fs::read_to_string(self.bed().path("out").join(name));
        text.unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// With each of these edits, `(from, to, code, words)`, alone the lab is refused: at a place in its file, with the code and the words.
    pub(crate) fn is_refused(&self, submission: &str, edits: &[(&str, &str, &str, &str)]) {
        let (_, text) = &self.files[0];
        for (from, to, code, words) in edits {
            self.bed().write(&self.lab_toml(), text);
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

impl Files for OwnLab {
    fn name(&self) -> String {
        "a lab of a test".to_owned()
    }

    fn bytes(&self, path: &str) -> Result<Option<Vec<u8>>, String> {
        let own = path
            .strip_prefix(self.name)
            .and_then(|rest| rest.strip_prefix('/'));
        let found = own.and_then(|own| self.files.iter().find(|(name, _)| *name == own));
        match found {
            Some((_, text)) => Ok(Some(text.as_bytes().to_vec())),
            None => Folder(root().join("labs")).bytes(path),
        }
    }

    fn list(&self, folder: &str) -> Vec<String> {
        match folder {
            "" => vec![self.name.to_owned()],
            folder => Folder(root().join("labs")).list(folder),
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
