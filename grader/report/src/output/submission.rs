//! The copy of the submission, which is graded again by `kinemark verify` and `kinemark compare`.

use super::material::{Material, OutFile, OutputError};
use super::table::{Output, always};

/// Its name in the folder.
pub const FILE: &str = "submission.rhai";

pub(super) const OUTPUT: Output = Output {
    name: "submission",
    is_requested: always,
    files,
};

fn files(material: &Material<'_>) -> Result<Vec<OutFile>, OutputError> {
    Ok(vec![OutFile::new(FILE, material.sources.submission)])
}
