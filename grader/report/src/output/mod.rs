//! What a report folder holds: a table with one row, and one file of this folder, per output.

mod lab_copies;
mod manifest;
mod material;
mod page;
mod plot_pixels;
mod plots;
mod record;
#[cfg(feature = "log")]
mod run_log;
mod storyboards;
mod submission;
mod table;

pub use lab_copies::FOLDER as LAB_FOLDER;
pub use manifest::{FILE as MANIFEST_FILE, Manifest, ManifestError, ReportRequest, digest};
pub use material::{Material, OutFile, OutputError, Pixels, Sources};
pub use page::FILE as PAGE_FILE;
pub use record::{FILE as RECORD_FILE, json};
#[cfg(feature = "log")]
pub use run_log::FILE as LOG_FILE;
pub use storyboards::FILE as STORYBOARD_FILE;
pub use submission::FILE as SUBMISSION_FILE;
pub use table::{OUTPUTS, Output, files};
