//! The page for people, `report.html`, with replay and plots inside.

use super::material::{Material, OutFile, OutputError};
use super::table::{Output, always};

/// Its name in the folder.
pub const FILE: &str = "report.html";

pub(super) const OUTPUT: Output = Output {
    name: "page",
    is_requested: always,
    files,
};

fn files(material: &Material<'_>) -> Result<Vec<OutFile>, OutputError> {
    let page = crate::html::html(material.graded, material.plots());
    Ok(vec![OutFile::new(FILE, page)])
}
