//! What a report folder holds: a table with one row per output. Logs and storyboards have files of this folder to themselves.

mod manifest;
mod material;
#[cfg(feature = "log")]
mod run_log;
mod storyboards;
mod table;

pub use manifest::{
    FILE as MANIFEST_FILE, Manifest, ManifestError, ReportRequest, digest, digest_of,
};
pub use material::{Material, OutFile, OutputError, Pixels, Sources, shows};
#[cfg(feature = "log")]
pub use run_log::FILE as LOG_FILE;
pub use storyboards::FILE as STORYBOARD_FILE;
pub use table::{
    LAB_FOLDER, MODULE_FILE, OUTPUTS, Output, PAGE_FILE, PLOT_FOLDER, PYTHON_FILE, RECORD_FILE,
    SOURCES_FOLDER, SUBMISSION_FILE, files, json,
};
