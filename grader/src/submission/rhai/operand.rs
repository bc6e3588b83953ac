//! Values of the language as operands: a list of numbers is a vector, a list of rows is a matrix.

use rhai::{Array, Dynamic, INT};

use super::mistake::{Problem, fault, fault_with_help};
use super::vector::{Matrix, Vector};
use super::words::describe;

/// A value as an operand of arithmetic.
#[derive(Debug, Clone)]
pub(super) enum Operand {
    Int(INT),
    Float(f64),
    Vector(Vector),
    Matrix(Matrix),
    Other,
}

impl Operand {
    pub(super) fn of(value: &Dynamic) -> Self {
        if let Ok(number) = value.as_float() {
            return Self::Float(number);
        }
        if let Ok(number) = value.as_int() {
            return Self::Int(number);
        }
        if let Some(vector) = value.read_lock::<Vector>() {
            return Self::Vector(vector.clone());
        }
        if let Some(matrix) = value.read_lock::<Matrix>() {
            return Self::Matrix(matrix.clone());
        }
        if let Ok(list) = value.as_array_ref() {
            return Self::of_list(&list);
        }
        Self::Other
    }

    fn of_list(list: &Array) -> Self {
        if let Some(vector) = vector_of(list) {
            return Self::Vector(vector);
        }
        let rows: Option<Vec<Vector>> = list
            .iter()
            .map(|row| match row.read_lock::<Vector>() {
                Some(vector) => Some(vector.clone()),
                None => {
                    let row = row.as_array_ref().ok()?;
                    vector_of(&row)
                }
            })
            .collect();
        rows.and_then(|rows| Matrix::from_rows(&rows))
            .map_or(Self::Other, Self::Matrix)
    }

    /// The number, if it is one.
    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Self::Int(number) => Some(*number as f64),
            Self::Float(number) => Some(*number),
            _ => None,
        }
    }

    /// The number of elements that arithmetic processes.
    pub(super) fn elements(&self) -> usize {
        match self {
            Self::Int(_) | Self::Float(_) | Self::Other => 1,
            Self::Vector(vector) => vector.len(),
            Self::Matrix(matrix) => matrix.rows() * matrix.columns(),
        }
    }
}

/// A list of numbers as a vector.
fn vector_of(list: &Array) -> Option<Vector> {
    list.iter().map(as_number).collect()
}

/// A value as a number, integer or not.
pub(super) fn as_number(value: &Dynamic) -> Option<f64> {
    value
        .as_float()
        .ok()
        .or_else(|| value.as_int().ok().map(|whole| whole as f64))
}

/// The number a built-in needs.
pub(super) fn number(function: &str, value: &Dynamic) -> Result<f64, Problem> {
    as_number(value).ok_or_else(|| {
        fault(format!(
            "`{function}` takes a number, got {}",
            describe(value)
        ))
    })
}

/// The vector a built-in needs.
pub(super) fn vector(function: &str, value: &Dynamic) -> Result<Vector, Problem> {
    match Operand::of(value) {
        Operand::Vector(vector) => Ok(vector),
        _ => Err(fault(format!(
            "`{function}` takes a vector, got {}",
            describe(value)
        ))),
    }
}

/// The matrix a built-in needs.
pub(super) fn matrix(function: &str, value: &Dynamic) -> Result<Matrix, Problem> {
    match Operand::of(value) {
        Operand::Matrix(matrix) => Ok(matrix),
        _ if let Some((first, other)) = uneven_rows(value) => Err(fault(format!(
            "the rows have {first} and {other} numbers: a matrix has rows of equal length"
        ))),
        _ => Err(fault_with_help(
            format!("`{function}` takes a matrix, got {}", describe(value)),
            "a matrix is a list of rows of equal length: [[1, 0], [0, 1]]",
        )),
    }
}

/// The lengths of the first row of a list and of the first that differs.
fn uneven_rows(value: &Dynamic) -> Option<(usize, usize)> {
    let list = value.as_array_ref().ok()?;
    let lengths: Option<Vec<usize>> = list
        .iter()
        .map(|row| match Operand::of(row) {
            Operand::Vector(vector) => Some(vector.len()),
            _ => None,
        })
        .collect();
    let lengths = lengths?;
    let first = *lengths.first()?;
    let other = lengths.into_iter().find(|length| *length != first)?;
    Some((first, other))
}

/// A value in words, a list of rows as the matrix that arithmetic takes it for.
pub(super) fn describe_operand(value: &Dynamic) -> String {
    match Operand::of(value) {
        Operand::Matrix(matrix) => format!("a {}x{} matrix", matrix.rows(), matrix.columns()),
        _ => describe(value),
    }
}

/// A value as an integer: `2` and `2.0`, not `2.5`.
pub(super) fn as_whole(value: &Dynamic) -> Option<INT> {
    if let Ok(whole) = value.as_int() {
        return Some(whole);
    }
    let number = value.as_float().ok()?;
    // beyond 2^53 not every integer is a float
    (number.fract().abs() == 0.0 && number.abs() <= 9_007_199_254_740_992.0)
        .then_some(number as INT)
}

/// A count, such as a number of rows.
pub(super) fn count(function: &str, value: &Dynamic) -> Result<usize, Problem> {
    as_whole(value)
        .and_then(|whole| usize::try_from(whole).ok())
        .ok_or_else(|| {
            fault(format!(
                "`{function}` takes an integer from 0, got {}",
                describe(value)
            ))
        })
}
