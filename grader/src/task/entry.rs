//! What functions of a lab's own are given and answer: numbers, lists and matrices of numbers by name.

use kinemark_sim::text::Dimension;
use schemars::JsonSchema;
use serde::Deserialize;

use super::value::Value;

/// A number, a list of numbers, or a matrix.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "a number, a list of numbers, or a list of rows of equal length"
)]
pub enum Entry {
    /// One number.
    Number(f64),
    /// A list, indexed from zero.
    List(Vec<f64>),
    /// A matrix, row by row; every row has the same length, at least 1.
    Matrix(Vec<Vec<f64>>),
}

impl Entry {
    /// Its numbers, those of a matrix row by row.
    pub fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Number(number) => vec![*number],
            Self::List(list) => list.clone(),
            Self::Matrix(rows) => rows.concat(),
        }
    }

    /// What it is, in words: `a list of 3 numbers`.
    pub fn shape(&self) -> String {
        match self {
            Self::Number(_) => "a number".to_owned(),
            Self::List(list) => format!("a list of {} numbers", list.len()),
            Self::Matrix(rows) => {
                let columns = rows.first().map_or(0, Vec::len);
                format!("{} x {columns} numbers (rows x columns)", rows.len())
            }
        }
    }

    /// Whether it is a matrix whose rows differ in length, or that has none.
    pub fn is_uneven(&self) -> bool {
        let Self::Matrix(rows) = self else {
            return false;
        };
        let columns = rows.first().map_or(0, Vec::len);
        columns == 0 || rows.iter().any(|row| row.len() != columns)
    }

    /// This shape with `numbers` in it, those of a matrix row by row, as many as it has.
    pub fn with(&self, numbers: &[f64]) -> Self {
        match self {
            Self::Number(_) => Self::Number(numbers[0]),
            Self::List(_) => Self::List(numbers.to_vec()),
            Self::Matrix(rows) => {
                let columns = rows.first().map_or(1, Vec::len).max(1);
                Self::Matrix(numbers.chunks_exact(columns).map(<[f64]>::to_vec).collect())
            }
        }
    }

    /// It as a submission is given it.
    pub fn value(&self) -> Value {
        let list =
            |numbers: &Vec<f64>| Value::List(numbers.iter().copied().map(Value::Number).collect());
        match self {
            Self::Number(number) => Value::Number(*number),
            Self::List(numbers) => list(numbers),
            Self::Matrix(rows) => Value::List(rows.iter().map(list).collect()),
        }
    }
}

impl From<Dimension> for Entry {
    fn from(dimension: Dimension) -> Self {
        match dimension {
            Dimension::Number(number) => Self::Number(number),
            Dimension::List(list) => Self::List(list),
            // no robot has one, and nothing is drawn as one
            Dimension::Text(_) => Self::List(Vec::new()),
        }
    }
}
