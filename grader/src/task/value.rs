//! Values that go to a submission and come back from it.

use serde::{Deserialize, Serialize};

/// A value as it crosses the boundary to a submission.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Value {
    /// The unit value.
    Nothing,
    /// A truth value.
    Boolean(bool),
    /// A number; whole numbers too.
    Number(f64),
    /// A text.
    Text(String),
    /// A list, a vector, or a matrix as a list of rows.
    List(Vec<Value>),
    /// A map in the order of its keys.
    Map(Vec<(String, Value)>),
    /// Something that cannot cross; its type's name.
    Other(String),
}
