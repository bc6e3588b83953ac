//! A submission as it was handed in: a script, or bytes that are no text, which do not build.

use kinemark_grader::judge::{self, Interrupted};
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::explanation::Explanation;
use kinemark_grader::record::graded::GradedRun;
use kinemark_grader::submission::host::Host;
use kinemark_grader::submission::not_text::NotText;
use kinemark_sim::text::Source;

/// A submission to grade.
#[derive(Debug, Clone)]
pub struct SubmissionSource {
    /// Its text, with the name of its file alone; bytes that are no text are U+FFFD.
    pub source: Source,
    /// Its bytes as they are.
    pub bytes: Vec<u8>,
    not_text: Option<NotText>,
}

impl SubmissionSource {
    /// The submission of these bytes; folders before the name of its file do not count, however they were written.
    pub fn new(file: &str, bytes: &[u8]) -> Self {
        let not_text = NotText::of(bytes);
        let text = match &not_text {
            Some(not_text) => not_text.shown.clone(),
            None => String::from_utf8_lossy(bytes).into_owned(),
        };
        Self {
            source: Source::new(file_name(file), text),
            bytes: bytes.to_owned(),
            not_text,
        }
    }

    /// A submission that is text.
    pub fn of_text(source: Source) -> Self {
        Self {
            bytes: source.text().as_bytes().to_owned(),
            source,
            not_text: None,
        }
    }

    /// Grades it; `host` runs it where it is text.
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
            Some(not_text) => judge::grade(lab, staff, &self.source, &mut not_text.clone()),
            None => judge::grade(lab, staff, &self.source, host),
        }
    }

    /// Explains its grade; `host` runs it where it is text.
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
            Some(not_text) => judge::explain(lab, staff, &self.source, &mut not_text.clone()),
            None => judge::explain(lab, staff, &self.source, host),
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
            assert_eq!(SubmissionSource::new(path, b"").source.name(), name);
        }
    }
}
