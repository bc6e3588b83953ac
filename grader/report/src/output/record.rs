//! The grade record, `grade.json`; what `kinemark grade --json` prints.

use serde::Serialize;

use super::material::{Material, OutFile, OutputError};
use super::table::{Output, always};

/// Its name in the folder; a folder that has it claims to be a report.
pub const FILE: &str = "grade.json";

pub(super) const OUTPUT: Output = Output {
    name: "grade record",
    is_requested: always,
    files,
};

fn files(material: &Material<'_>) -> Result<Vec<OutFile>, OutputError> {
    Ok(vec![OutFile::new(FILE, material.record.as_bytes())])
}

/// A value as JSON, in lines a person can read, with a line end.
///
/// # Errors
/// [`OutputError::Json`] where the value has no JSON form.
pub fn json(value: &impl Serialize) -> Result<String, OutputError> {
    Ok(serde_json::to_string_pretty(value)? + "\n")
}
