//! What a student should look at before they upload a hand-in: none of it stops them.

use std::path::Path;

use kinemark_course::student::StudentId;
use kinemark_course::working_folder::STARTER_FILE;
use kinemark_grader::lab::{Lab, Variant};
use kinemark_grader::record::grade::Grade;
use kinemark_grader::record::verdict::Verdict;
use kinemark_grader::task::files::Files;
use kinemark_report::visible::visible;

use crate::handed_out_lab::{self, Warning};
use crate::last_report::last_report;
use crate::output;

/// What is about to be handed in.
pub(crate) struct BeforeUpload<'a> {
    /// The folder of labs.
    pub(crate) files: &'a dyn Files,
    /// The lab with the default numbers.
    pub(crate) lab: &'a Lab,
    /// The variant that was graded, if it was one.
    pub(crate) variant: Option<&'a Variant>,
    /// Who hands it in, where they said so.
    pub(crate) student: Option<&'a StudentId>,
    /// The submission's file, and its bytes.
    pub(crate) submission: (&'a Path, &'a [u8]),
    /// Its grade in practice.
    pub(crate) practice: &'a Grade,
}

impl BeforeUpload<'_> {
    /// All warnings, those first that cost most.
    pub(crate) fn warnings(&self) -> Vec<Warning> {
        let last = last_report(self.submission.0, &self.lab.name);
        let mut warnings = Vec::new();
        warnings.extend(self.did_not_build());
        warnings.extend(self.is_not_decided());
        warnings.extend(self.is_starter());
        warnings.extend(self.of_variant());
        warnings.extend(handed_out_lab::warnings(self.files, self.lab, true));
        warnings.extend(last.and_then(|(folder, grade)| self.of_last(&folder, &grade)));
        warnings
    }

    fn did_not_build(&self) -> Option<Warning> {
        let mut tasks = self.practice.tasks.iter();
        let stopped = tasks.find_map(|task| {
            let is_unbuilt = task.verdict == Verdict::DidNotBuild;
            task.stopped.as_ref().filter(|_| is_unbuilt)
        })?;
        let place = stopped.line.map(|line| format!(" in line {line}"));
        let message = format!(
            "the submission does not build{}: {}",
            place.unwrap_or_default(),
            visible(&stopped.message)
        );
        let help = stopped
            .help
            .as_deref()
            .map(|help| visible(help).into_owned());
        let help =
            help.unwrap_or_else(|| "it earns no points like this: correct it first".to_owned());
        Some(Warning::new("did-not-build", message, help))
    }

    fn is_not_decided(&self) -> Option<Warning> {
        (!self.practice.verdict.is_decided()).then(|| {
            Warning::new(
                "not-decided",
                "this machine could not grade all of it, so the points in the file mean little",
                "you can upload it: the course grades it again. `kinemark grade` shows what failed here",
            )
        })
    }

    fn is_starter(&self) -> Option<Warning> {
        let path = format!("{}/{STARTER_FILE}", self.lab.name);
        let starter = self.files.read(&path).ok()??;
        let submission = std::str::from_utf8(self.submission.1).ok()?;
        (without_line_ends(&starter) == without_line_ends(submission)).then(|| {
            Warning::new(
                "starter",
                "the submission is the starter, unchanged",
                "name the file that you worked in, or save it in your editor first",
            )
        })
    }

    fn of_variant(&self) -> Option<Warning> {
        let Some(variant) = self.variant else {
            return (!self.lab.variants.is_empty()).then(|| {
                Warning::new(
                    "no-variant",
                    format!(
                        "lab `{}` can have other numbers for each student, and there is no variant.toml beside the submission",
                        self.lab.name
                    ),
                    "if your course gave you a variant.toml, put it there and run this again; if not, all is well",
                )
            });
        };
        let (own, named) = (self.student?, StudentId::new(variant.student()?).ok()?);
        (named != *own).then(|| {
            Warning::new(
                "other-variant",
                format!(
                    "the variant is that of `{}`, and you are `{}`",
                    visible(named.as_str()),
                    visible(own.as_str())
                ),
                "use the variant.toml that your course gave you: your work is graded with your own numbers",
            )
        })
    }

    fn of_last(&self, folder: &Path, last: &Grade) -> Option<Warning> {
        let now = self.practice;
        let report = output::path(folder);
        if last.submission.digest != now.submission.digest {
            return Some(Warning::new(
                "not-graded-last",
                format!(
                    "this is not the file that you graded last: the report in `{report}` is of `{}`, when it was another",
                    visible(&last.submission.name)
                ),
                "if it is the file that you mean, all is well; `kinemark grade` shows its report",
            ));
        }
        let lab_changed = last.variant == now.variant && last.lab.digest != now.lab.digest;
        lab_changed.then(|| {
            Warning::new(
                "lab-since-graded",
                format!("lab `{}` has changed since you graded last", self.lab.name),
                format!("compare the points below with those of the report in `{report}`"),
            )
        })
    }
}

/// Text without what an editor changes by itself: line ends, and spaces and lines at the end.
fn without_line_ends(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    lines.join("\n").trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_an_editor_changes_is_no_change() {
        let starter = "fn control() {\n    [0.0]\n}\n";
        let saved = "fn control() {  \r\n    [0.0]\r\n}\r\n\r\n";
        assert_eq!(without_line_ends(starter), without_line_ends(saved));
        assert_ne!(
            without_line_ends(starter),
            without_line_ends("fn control() {}")
        );
    }
}
