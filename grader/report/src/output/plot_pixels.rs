//! The plots of each motion task as PNG, beside the SVG.

use super::material::{Material, OutFile, OutputError};
use super::plots::FOLDER;
use super::table::Output;

pub(super) const OUTPUT: Output = Output {
    name: "plots in pixels",
    is_requested: |request| request.png,
    files,
};

fn files(material: &Material<'_>) -> Result<Vec<OutFile>, OutputError> {
    let drawn = |(name, svg): (&str, String)| {
        let pixels = material.pixels_of(&svg)?;
        Ok(OutFile::pixels(format!("{FOLDER}/{name}.png"), pixels))
    };
    material.captioned_plots().map(drawn).collect()
}
