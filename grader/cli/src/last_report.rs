//! The report that `kinemark grade` wrote last, where it writes unless it is given another folder.

use std::path::{Path, PathBuf};

use kinemark_grader::record::grade::Grade;
use kinemark_report::output::RECORD_FILE;

use crate::beneath;
use crate::working_lab::REPORT_FOLDER;

/// Records are far smaller.
const MOST_RECORD_BYTES: u64 = 64 << 20;

/// The last report of the lab, in the working folder or beside the submission.
pub(crate) fn last_report(submission: &Path, lab: &str) -> Option<(PathBuf, Grade)> {
    let folders = [
        PathBuf::from(REPORT_FOLDER),
        submission.with_file_name(REPORT_FOLDER),
    ];
    folders.into_iter().find_map(|folder| {
        let grade = last_grade(&folder)?;
        (grade.lab.name == lab).then_some((folder, grade))
    })
}

/// The record of the report in a folder, if there is one that this version reads.
fn last_grade(folder: &Path) -> Option<Grade> {
    let bytes = beneath::bytes(folder, RECORD_FILE, MOST_RECORD_BYTES).ok()?;
    serde_json::from_slice(&bytes).ok()
}

/// The lab of the last report in the working folder.
pub(crate) fn last_lab() -> Option<String> {
    Some(last_grade(Path::new(REPORT_FOLDER))?.lab.name)
}
