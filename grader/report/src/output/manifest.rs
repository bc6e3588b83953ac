//! `report.json`: what a report was requested to show, and the digests of its files.

use std::collections::BTreeMap;
use std::io::Read;

use serde::{Deserialize, Serialize};

use super::OutFile;
use crate::html::Earlier;
use crate::log_request::LogRequest;

/// Its name in the folder.
pub const FILE: &str = "report.json";
/// The format and its version.
const FORMAT: &str = "kinemark-report/1";

/// What a report shows besides the grade, its plots and its logs.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReportRequest {
    /// The reference solution's motion beside each run.
    pub reference_overlay: bool,
    /// Each plot as PNG, beside the SVG.
    pub png: bool,
    /// The storyboard of each motion task, as SVG and PNG.
    pub storyboard: bool,
    /// How the log of each motion task is written.
    #[serde(default)]
    pub log: LogRequest,
    /// Whose report it is, in the words of whoever asked for it: it is on the page, and no digest of the grade has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// The earlier report with which the page compares this one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub since: Option<Earlier>,
}

/// What `report.json` holds.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    format: String,
    /// What was requested.
    pub request: ReportRequest,
    /// Digests (BLAKE3) of the files that are the same bytes wherever the report is made, by path.
    pub files: BTreeMap<String, String>,
    /// Digests of the pictures in pixels, whose bytes may differ between processors.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub pixels: BTreeMap<String, String>,
}

/// Why a text is no `report.json` of this version.
#[derive(Debug, thiserror::Error)]
pub enum ManifestError {
    /// It is no such JSON.
    #[error("{0}")]
    Json(#[from] serde_json::Error),
    /// It is of another format.
    #[error("its format is `{0}`, not `{FORMAT}`")]
    Format(String),
}

impl Manifest {
    /// Lists the files of a report.
    pub fn of(request: &ReportRequest, files: &[OutFile]) -> Self {
        let digests = |is_pixels: bool| {
            let files = files.iter().filter(|file| file.is_pixels == is_pixels);
            files
                .map(|file| (file.path.clone(), digest(&file.bytes)))
                .collect()
        };
        Self {
            format: FORMAT.to_owned(),
            request: request.clone(),
            files: digests(false),
            pixels: digests(true),
        }
    }

    /// Reads one.
    ///
    /// # Errors
    /// [`ManifestError`], where it is not of the format that this version writes.
    pub fn parse(text: &[u8]) -> Result<Self, ManifestError> {
        #[derive(Deserialize)]
        struct Format {
            format: String,
        }
        // the format first: of another version everything else may be another
        let Format { format } = serde_json::from_slice(text)?;
        if format != FORMAT {
            return Err(ManifestError::Format(format));
        }
        Ok(serde_json::from_slice(text)?)
    }

    /// Whether a path is that of a file of the report, `report.json` among them.
    pub fn lists(&self, path: &str) -> bool {
        path == FILE || self.files.contains_key(path) || self.pixels.contains_key(path)
    }

    /// Whether a path is that of a folder with files of the report.
    pub fn lists_below(&self, folder: &str) -> bool {
        let is_below = |path: &String| {
            let rest = path.strip_prefix(folder);
            rest.is_some_and(|rest| rest.starts_with('/'))
        };
        self.files.keys().chain(self.pixels.keys()).any(is_below)
    }
}

/// The digest of a file, as `report.json` has it.
pub fn digest(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().to_string()
}

/// The same of what is read piece by piece.
///
/// # Errors
/// Where it cannot be read to its end.
pub fn digest_of(file: impl Read) -> std::io::Result<String> {
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(file)?;
    Ok(hasher.finalize().to_hex().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn manifest() -> Manifest {
        let files = [
            OutFile::new("grade.json", "{}"),
            OutFile::new("move/run.mcap", "log"),
            OutFile::pixels("plots/move-path.png", b"png".to_vec()),
        ];
        Manifest::of(&ReportRequest::default(), &files)
    }

    #[test]
    fn what_is_written_is_read_and_nothing_else() {
        let manifest = manifest();
        let text = super::super::json(&manifest).unwrap();
        assert_eq!(Manifest::parse(text.as_bytes()).unwrap(), manifest);
        let other = text.replace("kinemark-report/1", "kinemark-report/2");
        let error = Manifest::parse(other.as_bytes()).unwrap_err();
        assert!(error.to_string().contains("kinemark-report/2"), "{error}");
        let other = text.replace("\"png\"", "\"gif\"");
        assert!(Manifest::parse(other.as_bytes()).is_err());
    }

    #[test]
    fn a_label_is_kept_and_without_one_nothing_is_said_of_it() {
        let plain = super::super::json(&manifest()).unwrap();
        assert!(!plain.contains("label"), "{plain}");
        let labelled = plain.replace("\"png\"", "\"label\": \"Ana B.\", \"png\"");
        let read = Manifest::parse(labelled.as_bytes()).unwrap();
        assert_eq!(read.request.label.as_deref(), Some("Ana B."));
    }

    #[test]
    fn files_are_listed_with_the_folders_above_them() {
        let manifest = manifest();
        for path in ["grade.json", "report.json", "plots/move-path.png"] {
            assert!(manifest.lists(path), "{path}");
        }
        assert!(!manifest.lists("move") && manifest.lists_below("move"));
        assert!(!manifest.lists_below("mov") && !manifest.lists("plots/stale.svg"));
        assert_eq!(manifest.pixels.len(), 1);
    }
}
