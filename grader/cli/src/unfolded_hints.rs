//! How many hints of each check a student has unfolded: a small file beside the submission, which no report and no hand-in has.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use kinemark_report::visible::visible;
use serde::{Deserialize, Serialize};

use crate::failure::Failure;
use crate::{beneath, output};

/// The name of the file.
const HINTS_FILE: &str = ".kinemark-hints.json";

/// The format that this version reads and writes.
const FORMAT: &str = "kinemark-hints/1";

/// A count for each check of each lab is far smaller.
const MOST_BYTES: u64 = 1 << 20;

/// How many hints of each check are unfolded.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UnfoldedHints {
    format: String,
    /// By lab, then by `TASK/CHECK`.
    unfolded: BTreeMap<String, BTreeMap<String, usize>>,
    #[serde(skip)]
    path: PathBuf,
}

impl UnfoldedHints {
    /// Reads the file beside `submission`; where it cannot be read, all hints are folded, and the second value says so.
    pub(crate) fn beside(submission: &Path) -> (Self, Option<String>) {
        let path = submission.with_file_name(HINTS_FILE);
        let read = match path.symlink_metadata() {
            Ok(_) => read(&path).map(Some),
            Err(_) => Ok(None),
        };
        let (unfolded, note) = match read {
            Ok(unfolded) => (unfolded.unwrap_or_default(), None),
            Err(why) => {
                let shown = output::path(&path);
                let note = format!("`{shown}` cannot be read, so the hints begin again: {why}");
                (BTreeMap::new(), Some(note))
            }
        };
        let format = FORMAT.to_owned();
        let own = Self {
            format,
            unfolded,
            path,
        };
        (own, note)
    }

    /// How many hints of the check `TASK/CHECK` of `lab` are unfolded.
    pub(crate) fn of(&self, lab: &str, check: &str) -> usize {
        let of_lab = self.unfolded.get(lab);
        of_lab
            .and_then(|of_lab| of_lab.get(check))
            .copied()
            .unwrap_or(0)
    }

    /// Unfolds `count` hints of the check `TASK/CHECK` of `lab`, and folds those after them.
    pub(crate) fn set(&mut self, lab: &str, check: &str, count: usize) {
        let of_lab = self.unfolded.entry(lab.to_owned()).or_default();
        of_lab.insert(check.to_owned(), count);
        of_lab.retain(|_, count| *count > 0);
    }

    /// Writes the file.
    ///
    /// # Errors
    /// Exit code 4 where it cannot be written.
    pub(crate) fn write(&self) -> Result<(), Failure> {
        let text = output::json(self)?;
        let help = "the hints are shown all the same: `--all` shows those of a check at once";
        output::write_file(&self.path, text.as_bytes(), help)
    }
}

fn read(path: &Path) -> Result<BTreeMap<String, BTreeMap<String, usize>>, String> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let bytes = beneath::bytes(folder, HINTS_FILE, MOST_BYTES).map_err(|why| why.to_string())?;
    let read: serde_json::Result<UnfoldedHints> = serde_json::from_slice(&bytes);
    let read = read.map_err(|error| visible(&error.to_string()).into_owned())?;
    if read.format == FORMAT {
        Ok(read.unfolded)
    } else {
        let format = visible(&read.format);
        Err(format!("its format is `{format}`, not `{FORMAT}`"))
    }
}
