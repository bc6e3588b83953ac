//! From what is typed to numbers: expressions over the dimensions, each held to its range.

use std::collections::BTreeSet;
use std::ops::Range;

use nalgebra::Vector3;

use super::mesh_files::Meshes;
use super::part_problem::{PartError, PartProblem};
use super::part_tables::{Number, NumberAt, TripleAt};
use crate::spatial::direction;
use crate::text::expression::evaluate_in;
use crate::text::{Dimension, Dimensions, Located, Source, Spanned, suggest};

/// No number that [`Values::bounded`] or [`Values::within`] reads is beyond this, in SI units: far beyond any lab, and its powers
/// stay finite.
const MOST: f64 = 1e6;

/// Reads the values of one file.
#[derive(Clone, Copy)]
pub(crate) struct Values<'a> {
    pub(crate) source: &'a Source,
    /// The word for the file in messages: `robot`, `scene` or `lab`.
    pub(crate) kind: &'static str,
    pub(crate) dimensions: &'a Dimensions,
    pub(crate) meshes: &'a Meshes,
}

/// What a number may be.
#[derive(Clone, Copy)]
pub(crate) enum Allowed {
    Any,
    Positive,
    NotNegative,
    /// From zero to one.
    Fraction,
}

impl Allowed {
    /// What a number should have been instead of `value`, if it may not be that.
    pub(crate) fn instead_of(self, value: f64) -> Option<&'static str> {
        match self {
            Self::Positive if value <= 0.0 => Some("positive"),
            Self::NotNegative if value < 0.0 => Some("zero or more"),
            Self::Fraction if !(0.0..=1.0).contains(&value) => Some("from 0 to 1"),
            _ => None,
        }
    }
}

impl Values<'_> {
    pub(crate) fn located(&self, at: Range<usize>, problem: PartProblem) -> PartError {
        Located::new(problem, self.source, at)
    }

    pub(crate) fn err<T>(&self, at: Range<usize>, problem: PartProblem) -> Result<T, PartError> {
        Err(self.located(at, problem))
    }

    pub(crate) fn number(
        &self,
        number: &NumberAt,
        what: &str,
        allowed: Allowed,
    ) -> Result<f64, PartError> {
        let span = number.span();
        let value = match number.get_ref() {
            Number::Literal(value) => *value,
            Number::Expression(text) => {
                let value = evaluate_in(self.source, &span, text, self.dimensions, "dimension");
                value.or_else(|problem| {
                    let (message, help) = (problem.message, problem.help);
                    self.err(problem.at, PartProblem::Expression { message, help })
                })?
            }
        };
        let Some(expected) = allowed.instead_of(value) else {
            return Ok(value);
        };
        self.err(
            span,
            PartProblem::OutOfRange {
                what: what.to_owned(),
                expected,
                found: value.to_string(),
            },
        )
    }

    /// One number of a size that keeps every power of it finite.
    pub(crate) fn bounded(
        &self,
        number: &NumberAt,
        what: &str,
        allowed: Allowed,
    ) -> Result<f64, PartError> {
        let value = self.number(number, what, allowed)?;
        self.within(number.span(), what, &[value])?;
        Ok(value)
    }

    /// Three numbers of a size that keeps every power of them finite.
    pub(crate) fn vector(
        &self,
        numbers: &[NumberAt; 3],
        what: &str,
    ) -> Result<Vector3<f64>, PartError> {
        let vector = self.triple(numbers, what)?;
        let at = numbers[0].span().start..numbers[2].span().end;
        self.within(at, what, vector.as_slice())?;
        Ok(vector)
    }

    /// Checks that no power of `values` is beyond what a number can hold.
    pub(crate) fn within(
        &self,
        at: Range<usize>,
        what: &str,
        values: &[f64],
    ) -> Result<(), PartError> {
        match values
            .iter()
            .find(|value| value.abs() > MOST || value.is_nan())
        {
            None => Ok(()),
            Some(value) => {
                let expected = match *value < 0.0 {
                    true => "at least -1e6",
                    false => "at most 1e6",
                };
                let (what, found) = (what.to_owned(), format!("{value:?}"));
                let problem = PartProblem::OutOfRange {
                    what,
                    expected,
                    found,
                };
                self.err(at, problem)
            }
        }
    }

    /// The index of `given` among the `names` of all joints, links or frames (`what`).
    pub(crate) fn index<'n>(
        &self,
        what: &'static str,
        given: &Spanned<String>,
        names: impl Iterator<Item = &'n str> + Clone,
    ) -> Result<usize, PartError> {
        let name = given.get_ref();
        let index = names.clone().position(|known| known == name);
        index.ok_or_else(|| self.located(given.span(), PartProblem::unknown(what, name, names)))
    }

    /// Checks that names of `what` are not empty, not `taken` and all different.
    pub(crate) fn check_names<'n>(
        &self,
        what: &'static str,
        names: impl IntoIterator<Item = &'n Spanned<String>>,
        taken: &[&str],
        help: &'static str,
    ) -> Result<(), PartError> {
        let mut seen = BTreeSet::new();
        for given in names {
            let name = given.get_ref();
            if name.trim().is_empty() || taken.contains(&name.as_str()) {
                let name = name.clone();
                return self.err(given.span(), PartProblem::BadName { what, name, help });
            }
            if !seen.insert(name) {
                let name = name.clone();
                return self.err(given.span(), PartProblem::Duplicate { what, name });
            }
        }
        Ok(())
    }

    pub(crate) fn number_or(
        &self,
        number: Option<&NumberAt>,
        what: &str,
        allowed: Allowed,
        absent: f64,
    ) -> Result<f64, PartError> {
        number.map_or(Ok(absent), |number| self.number(number, what, allowed))
    }

    pub(crate) fn triple(
        &self,
        numbers: &[NumberAt; 3],
        what: &str,
    ) -> Result<Vector3<f64>, PartError> {
        let [x, y, z] = numbers;
        Ok(Vector3::new(
            self.number(x, what, Allowed::Any)?,
            self.number(y, what, Allowed::Any)?,
            self.number(z, what, Allowed::Any)?,
        ))
    }

    pub(crate) fn unit(&self, numbers: &TripleAt, what: &str) -> Result<Vector3<f64>, PartError> {
        let axis = self.triple(numbers.get_ref(), what)?;
        if let Some(unit) = direction(axis) {
            return Ok(unit);
        }
        self.err(
            numbers.span(),
            PartProblem::Axis {
                message: format!("{what} is zero"),
            },
        )
    }
}

/// The dimensions of a file with those of a variant or a hidden case instead, each of the same shape as before.
pub(crate) fn changed_dimensions(
    source: &Source,
    kind: &'static str,
    dimensions: &Dimensions,
    changed: &[(String, Dimension)],
) -> Result<Dimensions, PartError> {
    let mut dimensions = dimensions.clone();
    for (name, value) in changed {
        let problem = match dimensions.get(name) {
            None => PartProblem::UnknownDimension {
                kind,
                name: name.clone(),
                help: suggest(name, "dimensions", dimensions.names()),
            },
            Some(old) if old.to_string() != value.to_string() => PartProblem::DimensionShape {
                kind,
                name: name.clone(),
                expected: old.to_string(),
                found: value.to_string(),
            },
            Some(_) => {
                dimensions.set(name.clone(), value.clone());
                continue;
            }
        };
        let at = source
            .text()
            .find("[dimensions]")
            .map_or(0..0, |start| start..start + "[dimensions]".len());
        return Err(Located::new(problem, source, at));
    }
    Ok(dimensions)
}
