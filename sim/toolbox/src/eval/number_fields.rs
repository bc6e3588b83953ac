//! Numbers in requests and answers: one or many, for every axis or for each, and never without a value.

use std::fmt;

use kinemark_sim::kinematics::manipulability::{ANGULAR, LINEAR, TWIST};
use nalgebra::{Dim, Matrix, RawStorage};
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Unexpected, Visitor};

use super::refusal::{Code, Refusal, refuse};

/// A number or a list of numbers.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum Numbers {
    /// A bare number: a list of one, or the same for all axes.
    One(f64),
    /// One per axis or joint.
    List(Vec<f64>),
}

impl Numbers {
    /// The numbers as a list; a bare one is a list of one.
    pub(super) fn as_slice(&self) -> &[f64] {
        match self {
            Self::One(number) => std::slice::from_ref(number),
            Self::List(numbers) => numbers,
        }
    }

    /// One number for each of `n` axes; a bare one is that of all.
    pub(super) fn per_axis(&self, name: &str, n: usize) -> Result<Vec<f64>, Refusal> {
        match self {
            Self::One(number) => Ok(vec![*number; n]),
            Self::List(numbers) if numbers.len() == n => Ok(numbers.clone()),
            Self::List(numbers) => refuse(
                Code::WrongLength,
                format!("`{name}` has {} numbers, expected 1 or {n}", numbers.len()),
            ),
        }
    }
}

impl<'de> Deserialize<'de> for Numbers {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumbersVisitor;

        impl<'de> Visitor<'de> for NumbersVisitor {
            type Value = Numbers;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a list of numbers")
            }

            fn visit_f64<E: Error>(self, number: f64) -> Result<Numbers, E> {
                Ok(Numbers::One(number))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Numbers, A::Error> {
                let mut numbers = Vec::new();
                while let Some(number) = items.next_element()? {
                    numbers.push(number);
                }
                Ok(Numbers::List(numbers))
            }
        }

        deserializer.deserialize_any(NumbersVisitor)
    }
}

/// Rows of a Jacobian, `[linear; angular]`, from zero and none of them twice; three or six of them also have a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TwistRows(pub Vec<usize>);

impl<'de> Deserialize<'de> for TwistRows {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct RowsVisitor;

        impl<'de> Visitor<'de> for RowsVisitor {
            type Value = TwistRows;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("`all`, `linear`, `angular` or a list of different rows 0 to 5")
            }

            fn visit_str<E: Error>(self, name: &str) -> Result<TwistRows, E> {
                let rows = match name {
                    "all" => TWIST,
                    "linear" => LINEAR,
                    "angular" => ANGULAR,
                    other => return Err(E::invalid_value(Unexpected::Str(other), &self)),
                };
                Ok(TwistRows(rows.to_vec()))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<TwistRows, A::Error> {
                let mut rows: Vec<usize> = Vec::new();
                while let Some(row) = items.next_element()? {
                    if row > 5 || rows.contains(&row) {
                        let found = Unexpected::Unsigned(row as u64);
                        return Err(A::Error::invalid_value(found, &self));
                    }
                    rows.push(row);
                }
                if rows.is_empty() {
                    return Err(A::Error::invalid_value(Unexpected::Other("[]"), &self));
                }
                Ok(TwistRows(rows))
            }
        }

        deserializer.deserialize_any(RowsVisitor)
    }
}

/// A number of a request that must be positive.
pub(super) fn positive(name: &str, value: f64) -> Result<f64, Refusal> {
    if value > 0.0 {
        return Ok(value);
    }
    let message = format!("`{name}` must be positive, got {value}");
    refuse(Code::OutOfRange, message)
}

/// Numbers of an answer; JSON has no place for one that is not finite.
pub(super) fn finite(values: &[f64]) -> Result<Vec<f64>, Refusal> {
    if values.iter().all(|value| value.is_finite()) {
        return Ok(values.to_vec());
    }
    refuse(
        Code::NotFinite,
        "the answer is not finite: the numbers given are too large",
    )
}

/// A number of an answer.
pub(super) fn finite_number(value: f64) -> Result<f64, Refusal> {
    finite(&[value]).map(|_| value)
}

/// Lists of numbers of an answer.
pub(super) fn finite_rows<R: AsRef<[f64]>>(
    rows: impl IntoIterator<Item = R>,
) -> Result<Vec<Vec<f64>>, Refusal> {
    rows.into_iter().map(|row| finite(row.as_ref())).collect()
}

/// The rows of a matrix in an answer.
pub(super) fn matrix_rows<R: Dim, C: Dim, S: RawStorage<f64, R, C>>(
    matrix: &Matrix<f64, R, C, S>,
) -> Result<Vec<Vec<f64>>, Refusal> {
    let rows = matrix.row_iter();
    finite_rows(rows.map(|row| row.iter().copied().collect::<Vec<f64>>()))
}
