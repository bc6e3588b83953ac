//! The log of each motion task as MCAP, and a layout to open it with.

use super::material::{Material, OutFile, OutputError};
use super::table::{Output, RECORD_FILE, always};
use crate::log::{Attachment, layout, mcap};

/// The log, in the task's folder.
pub const FILE: &str = "run.mcap";
/// The layout, in the task's folder.
const LAYOUT: &str = "run.layout.json";

pub(super) const OUTPUT: Output = Output {
    name: "log",
    is_requested: always,
    files,
};

fn files(material: &Material<'_>) -> Result<Vec<OutFile>, OutputError> {
    let sources = &material.sources;
    let mut files = Vec::new();
    for run in &material.graded.runs {
        let layout = layout(run);
        let mut own = sources.own_robots.iter();
        let own = own.find(|(task, _)| *task == run.task);
        let robot = own.map_or(sources.robot, |(_, robot)| *robot);
        let attachments = [
            ("robot.toml", "application/toml", robot),
            ("lab.toml", "application/toml", sources.lab),
            (RECORD_FILE, "application/json", material.record.as_str()),
            (LAYOUT, "application/json", layout.as_str()),
        ]
        .map(|(name, media_type, text)| Attachment {
            name,
            media_type,
            bytes: text.as_bytes(),
        });
        let log = mcap(
            run,
            &material.graded.grade,
            &attachments,
            material.request.log,
        );
        let log = log.map_err(|error| OutputError::Log {
            task: run.task.clone(),
            error,
        })?;
        files.push(OutFile::new(format!("{}/{FILE}", run.task), log));
        files.push(OutFile::new(format!("{}/{LAYOUT}", run.task), layout));
    }
    Ok(files)
}
