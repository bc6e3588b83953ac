//! The plots of each motion task as SVG.

use super::material::{Material, OutFile, OutputError};
use super::table::{Output, always};

/// The folder they are in.
pub(super) const FOLDER: &str = "plots";

pub(super) const OUTPUT: Output = Output {
    name: "plots",
    is_requested: always,
    files,
};

fn files(material: &Material<'_>) -> Result<Vec<OutFile>, OutputError> {
    let plots = material.captioned_plots();
    Ok(plots
        .map(|(name, svg)| OutFile::new(format!("{FOLDER}/{name}.svg"), svg))
        .collect())
}
