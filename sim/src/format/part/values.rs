//! From what is typed to numbers: expressions over the dimensions, each held to its range.

use std::ops::Range;

use nalgebra::Vector3;

use super::mesh_files::Meshes;
use super::part_problem::{PartError, PartProblem};
use super::part_tables::{Number, NumberAt, TripleAt};
use crate::spatial::direction;
use crate::text::{Dimension, Dimensions, Located, Source, expression, suggest};

/// Reads the values of one file.
#[derive(Clone, Copy)]
pub(crate) struct Values<'a> {
    pub(crate) source: &'a Source,
    /// The word for the file in messages: `robot` or `scene`.
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

impl Values<'_> {
    pub(crate) fn err<T>(&self, at: Range<usize>, problem: PartProblem) -> Result<T, PartError> {
        Err(Located::new(problem, self.source, at))
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
            Number::Expression(text) => match expression::evaluate(text, self.dimensions) {
                Ok(value) => value,
                Err(problem) => {
                    // inside the quotes, where the text stands as typed
                    let inside = span.start + 1;
                    let typed = self.source.text().get(inside..inside + text.len());
                    let at = if typed == Some(text.as_str()) {
                        inside + problem.at.start..inside + problem.at.end
                    } else {
                        span
                    };
                    let (message, help) = (problem.message, problem.help);
                    return self.err(at, PartProblem::Expression { message, help });
                }
            },
        };
        let expected = match allowed {
            Allowed::Positive if value <= 0.0 => "positive",
            Allowed::NotNegative if value < 0.0 => "zero or more",
            Allowed::Fraction if !(0.0..=1.0).contains(&value) => "from 0 to 1",
            _ => return Ok(value),
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
