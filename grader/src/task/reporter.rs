//! Where problems of one text of a lab are reported: every one with its place in that text.

use std::ops::Range;

use kinemark_sim::text::number::trimmed;
use kinemark_sim::text::{Problem, Source, Spanned};
use kinemark_sim::ticks::{Periods, whole_ratio};
use nalgebra::Vector3;

use super::model::Band;
use super::problem::{LabError, problems};

/// Physics steps of a task: a quarter of an hour at 1 ms. More would not fit in the memory of a grade.
const MOST_TICKS: u64 = 900_000;
/// No number of a vector is beyond this, in SI units: far beyond any lab, and its powers stay finite.
const MOST: f64 = 1e6;

/// Reports problems of one text.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reporter<'a> {
    /// The text.
    pub(crate) source: &'a Source,
}

problems! {
    /// Numbers and names that a lab file gives wrongly, whatever they are for.
    enum ValueProblem {
        NotPositive { what: String, value: f64 }:
            "lab::out_of_range", "{what} must be positive and finite, got {value}", "out of range";
        Band { full: f64, zero: f64 }:
            "lab::band", "a band needs `full` at or below `zero`, got {full} and {zero}", "this band",
            "`full` is the value that earns all points, `zero` the one that earns none";
        BadName { what: &'static str, name: String }:
            "lab::bad_name", "{what} name {name:?} cannot be used", "this name",
            "use lower-case letters, digits and `-`";
        Duplicate { what: &'static str, name: String }:
            "lab::duplicate", "{what} `{name}` is defined twice", "the second one", "give each its own name";
        NotWholeSteps { what: &'static str, time_s: f64, step_s: f64 }:
            "lab::periods", "{what} of {time_s} s is not an integer multiple of the physics step of {step_s} s", "does not divide",
            format!("write a multiple of {step_s} s");
        TooLong { what: &'static str, time_s: f64, step_s: f64 }:
            "lab::periods", "{what} of {time_s} s has more than {MOST_TICKS} physics steps of {step_s} s", "too long",
            format!("write {} s at most: a run is kept whole in memory", trimmed(MOST_TICKS as f64 * step_s, 3));
        TooLarge { what: &'static str }:
            "lab::out_of_range", "{what} is beyond 1e6", "out of range";
    }
}

impl Reporter<'_> {
    /// The error of `problem` at `at`.
    pub(crate) fn refuse<T>(&self, at: Range<usize>, problem: impl Problem) -> Result<T, LabError> {
        Err(LabError::new(Box::new(problem), self.source, at))
    }

    /// The error of `problem` at what was `typed`.
    pub(crate) fn refuse_at<T, V>(
        &self,
        typed: &Spanned<V>,
        problem: impl Problem,
    ) -> Result<T, LabError> {
        self.refuse(typed.span(), problem)
    }

    /// A number above zero; `what` names it in the message.
    pub(crate) fn positive(&self, number: &Spanned<f64>, what: &str) -> Result<f64, LabError> {
        let value = *number.get_ref();
        if value > 0.0 && value.is_finite() {
            return Ok(value);
        }
        let what = what.to_owned();
        self.refuse_at(number, ValueProblem::NotPositive { what, value })
    }

    /// `time_s`, typed `at`, in physics steps.
    pub(crate) fn whole_ticks(
        &self,
        periods: &Periods,
        time_s: f64,
        at: &Spanned<f64>,
        what: &'static str,
    ) -> Result<u64, LabError> {
        let step_s = periods.step_s;
        let problem = match whole_ratio(time_s, step_s) {
            Some(ticks) if ticks <= MOST_TICKS => return Ok(ticks),
            None if time_s / step_s <= MOST_TICKS as f64 => ValueProblem::NotWholeSteps {
                what,
                time_s,
                step_s,
            },
            _ => ValueProblem::TooLong {
                what,
                time_s,
                step_s,
            },
        };
        self.refuse_at(at, problem)
    }

    /// A vector of numbers that are not beyond [`MOST`].
    pub(crate) fn vector(
        &self,
        typed: &Spanned<[f64; 3]>,
        what: &'static str,
    ) -> Result<Vector3<f64>, LabError> {
        let vector = Vector3::from(*typed.get_ref());
        if vector.amax() > MOST {
            return self.refuse_at(typed, ValueProblem::TooLarge { what });
        }
        Ok(vector)
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
                return self.refuse_at(at, ValueProblem::BadName { what, name });
            }
            if known.contains(&name) {
                let name = name.to_owned();
                return self.refuse_at(at, ValueProblem::Duplicate { what, name });
            }
            known.push(name);
        }
        Ok(())
    }
}
