//! Copies of lab, robot and scenes, in the shape of a folder of labs.

use super::material::{Material, OutFile, OutputError};
use super::table::{Output, always};

/// The folder they are in.
pub const FOLDER: &str = "lab";

pub(super) const OUTPUT: Output = Output {
    name: "lab",
    is_requested: always,
    files,
};

fn files(material: &Material<'_>) -> Result<Vec<OutFile>, OutputError> {
    let copies = material.sources.lab_files.iter();
    Ok(copies
        .map(|(path, bytes)| OutFile::new(format!("{FOLDER}/{path}"), bytes.as_slice()))
        .collect())
}
