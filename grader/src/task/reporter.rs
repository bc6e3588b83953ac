//! Where problems of one text of a lab are reported: every one with its place in that text.

use std::ops::Range;

use kinemark_sim::text::{Problem, Source};
use toml::Spanned;

use super::model::Band;
use super::problem::{LabError, LabProblem};

/// Reports problems of one text.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reporter<'a> {
    /// The text.
    pub(crate) source: &'a Source,
}

/// Numbers and names that a lab file gives wrongly, whatever they are for.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(crate) enum ValueProblem {
    /// A number that must be above zero.
    #[error("{what} must be positive and finite, got {value}")]
    NotPositive {
        /// What it is, such as `` `hold_s` ``.
        what: String,
        /// The number as typed.
        value: f64,
    },
    /// A band whose ends are the wrong way round.
    #[error("a band needs `full` at or below `zero`, got {full} and {zero}")]
    Band {
        /// The value that earns all points, as typed.
        full: f64,
        /// The value that earns none, as typed.
        zero: f64,
    },
    /// A name that no file name or link could hold.
    #[error("{what} name {name:?} cannot be used")]
    BadName {
        /// What is called so, such as `task`.
        what: &'static str,
        /// The name as typed.
        name: String,
    },
    /// A name that something of the same kind already has.
    #[error("{what} `{name}` is there twice")]
    Duplicate {
        /// What is called so, such as `task`.
        what: &'static str,
        /// The name as typed.
        name: String,
    },
}

impl Problem for ValueProblem {
    fn code(&self) -> &'static str {
        match self {
            Self::NotPositive { .. } => "lab::out_of_range",
            Self::Band { .. } => "lab::band",
            Self::BadName { .. } => "lab::bad_name",
            Self::Duplicate { .. } => "lab::duplicate",
        }
    }

    fn label(&self) -> String {
        match self {
            Self::NotPositive { .. } => "out of range",
            Self::Band { .. } => "this band",
            Self::BadName { .. } => "this name",
            Self::Duplicate { .. } => "the second one",
        }
        .to_owned()
    }

    fn help(&self) -> Option<String> {
        let help = match self {
            Self::NotPositive { .. } => return None,
            Self::Band { .. } => {
                "`full` is the value that earns all points, `zero` the one that earns none"
            }
            Self::BadName { .. } => "use lower-case letters, digits and `-`",
            Self::Duplicate { .. } => "give each its own name",
        };
        Some(help.to_owned())
    }
}

impl Reporter<'_> {
    /// The error of `problem` at `at`.
    pub(crate) fn refuse<T>(&self, at: Range<usize>, problem: impl Problem) -> Result<T, LabError> {
        Err(LabError::new(LabProblem::of(problem), self.source, at))
    }

    /// An error put together where it is found.
    pub(crate) fn err<T>(
        &self,
        at: Range<usize>,
        code: &'static str,
        message: String,
        label: &str,
        help: Option<String>,
    ) -> Result<T, LabError> {
        let problem = LabProblem {
            message,
            code,
            label: label.to_owned(),
            help,
        };
        Err(LabError::new(problem, self.source, at))
    }

    /// A number above zero; `what` names it in the message.
    pub(crate) fn positive(&self, number: &Spanned<f64>, what: &str) -> Result<f64, LabError> {
        let value = *number.get_ref();
        if value > 0.0 && value.is_finite() {
            return Ok(value);
        }
        let what = what.to_owned();
        self.refuse(number.span(), ValueProblem::NotPositive { what, value })
    }

    /// A band of a measured value that is better when it is smaller.
    pub(crate) fn band(&self, full: f64, zero: f64, at: Range<usize>) -> Result<Band, LabError> {
        if full.is_finite() && zero.is_finite() && full <= zero {
            return Ok(Band { full, zero });
        }
        self.refuse(at, ValueProblem::Band { full, zero })
    }

    /// Names are used in file names and links: letters, digits, `-`, and each once.
    pub(crate) fn unique<'n>(
        &self,
        what: &'static str,
        names: impl Iterator<Item = &'n Spanned<String>>,
    ) -> Result<(), LabError> {
        let mut known: Vec<&str> = Vec::new();
        for at in names {
            let name = at.get_ref().as_str();
            let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
            if name.is_empty() || !name.chars().all(plain) {
                let name = name.to_owned();
                return self.refuse(at.span(), ValueProblem::BadName { what, name });
            }
            if known.contains(&name) {
                let name = name.to_owned();
                return self.refuse(at.span(), ValueProblem::Duplicate { what, name });
            }
            known.push(name);
        }
        Ok(())
    }
}
