//! The storyboard of each motion task that ran, as SVG and PNG; an arm that never moved has none.

use super::material::{Material, OutFile, OutputError};
use super::table::Output;
use crate::storyboard::{has_storyboard, storyboard};

/// The picture in pixels, in the task's folder.
pub const FILE: &str = "storyboard.png";
/// The drawing, in the task's folder.
const DRAWING: &str = "storyboard.svg";

pub(super) const OUTPUT: Output = Output {
    name: "storyboard",
    is_requested: |request| request.storyboard,
    files,
};

fn files(material: &Material<'_>) -> Result<Vec<OutFile>, OutputError> {
    let mut files = Vec::new();
    let graded = material.graded;
    for run in graded.runs.iter().filter(|run| has_storyboard(run)) {
        let mut tasks = graded.grade.tasks.iter();
        let Some(task) = tasks.find(|task| task.name == run.task) else {
            continue;
        };
        let svg = storyboard(run, task);
        let pixels = material.pixels_of(&svg)?;
        files.push(OutFile::pixels(format!("{}/{FILE}", run.task), pixels));
        files.push(OutFile::new(format!("{}/{DRAWING}", run.task), svg));
    }
    Ok(files)
}
