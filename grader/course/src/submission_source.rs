//! A submission as it was handed in: a script, a compiled module, or bytes that are neither, which do not build.

use kinemark_grader::judge::{self, Interrupted};
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::explanation::Explanation;
use kinemark_grader::record::graded::GradedRun;
use kinemark_grader::submission::handed_in::Submission;
use kinemark_grader::submission::host::Host;
use kinemark_grader::submission::not_text::NotText;
use kinemark_sim::text::Source;

use crate::module_sources::SourceFile;

/// A submission to grade.
#[derive(Debug, Clone)]
pub struct SubmissionSource {
    /// What is graded, with the name of its file alone; bytes that are no text are U+FFFD.
    pub submission: Submission,
    /// Its bytes as they are.
    pub bytes: Vec<u8>,
    /// The sources beside a module, for people to read.
    pub sources: Vec<SourceFile>,
    not_text: Option<NotText>,
}

impl SubmissionSource {
    /// The submission of these bytes; folders before the name of its file do not count, however they were written.
    pub fn new(file: &str, bytes: &[u8]) -> Self {
        let file = file_name(file);
        let is_module = bytes.starts_with(Submission::MODULE_MAGIC);
        let not_text = NotText::of(bytes).filter(|_| !is_module);
        let submission = match &not_text {
            _ if is_module => Submission::module(file, bytes),
            Some(not_text) => Source::new(file, not_text.shown.as_str()).into(),
            None => Source::new(file, String::from_utf8_lossy(bytes).into_owned()).into(),
        };
        Self {
            submission,
            bytes: bytes.to_owned(),
            sources: Vec::new(),
            not_text,
        }
    }

    /// The same with the sources that were handed in beside it, where it is a module.
    #[must_use]
    pub fn with_sources(self, sources: Vec<SourceFile>) -> Self {
        if self.submission.sources().is_none() {
            return self;
        }
        let named = sources.iter();
        let named = named.map(|file| (file.path.as_str(), file.bytes.as_slice()));
        Self {
            submission: self.submission.with_sources(named),
            sources,
            ..self
        }
    }

    /// A submission that is text.
    pub fn of_text(source: Source) -> Self {
        Self {
            bytes: source.text().as_bytes().to_owned(),
            submission: source.into(),
            sources: Vec::new(),
            not_text: None,
        }
    }

    /// Grades it; `host` runs it where it is a program.
    ///
    /// # Errors
    /// [`Interrupted`] if the host says so.
    pub fn grade(
        &self,
        lab: &Lab,
        staff: Option<&Staff>,
        host: &mut dyn Host,
    ) -> Result<GradedRun, Interrupted> {
        match &self.not_text {
            Some(not_text) => judge::grade(lab, staff, &self.submission, &mut not_text.clone()),
            None => judge::grade(lab, staff, &self.submission, host),
        }
    }

    /// Explains its grade; `host` runs it where it is a program.
    ///
    /// # Errors
    /// [`Interrupted`] if the host says so.
    pub fn explain(
        &self,
        lab: &Lab,
        staff: &Staff,
        host: &mut dyn Host,
    ) -> Result<Explanation, Interrupted> {
        match &self.not_text {
            Some(not_text) => judge::explain(lab, staff, &self.submission, &mut not_text.clone()),
            None => judge::explain(lab, staff, &self.submission, host),
        }
    }
}

fn file_name(path: &str) -> &str {
    match path.rsplit(['/', '\\']).next() {
        Some("" | "." | "..") | None => "submission.rhai",
        Some(name) => name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_that_of_the_file_alone() {
        for (path, name) in [
            ("a.rhai", "a.rhai"),
            ("x/y/a.rhai", "a.rhai"),
            ("C:\\x\\a.rhai", "a.rhai"),
            ("x/", "submission.rhai"),
            ("..", "submission.rhai"),
        ] {
            assert_eq!(SubmissionSource::new(path, b"").submission.name(), name);
        }
    }
}
