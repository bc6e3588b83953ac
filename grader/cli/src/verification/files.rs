//! The files of a report: made again and compared, byte by byte, and pictures by what they show.

use kinemark_grader::lab::Lab;
use kinemark_grader::record::grade::GradeMode;
use kinemark_grader::record::graded::GradedRun;
use kinemark_report::output::{
    self, LAB_FOLDER, MANIFEST_FILE, MODULE_FILE, Manifest, OutFile, PYTHON_FILE, Pixels,
    RECORD_FILE, SUBMISSION_FILE, digest,
};
use kinemark_report::visible::shortened;

use super::findings::{Findings, Subject};
use crate::beneath::Unread;
use crate::disk;
use crate::failure::Failure;
use crate::fresh_folder::{self, Entry};
use crate::report_folder::{self, Report};

/// In place of the digest of a file that is not there.
pub(super) const MISSING: &str = "missing";

/// Of more files than a report has the rest are counted.
const MOST_NAMED: usize = 100;

/// Whether a page, a plot or a log of the report shows more of the reference solution than students have.
pub(super) fn show_the_reference(report: &Report, lab: &Lab) -> bool {
    report.manifest.request.reference_overlay || lab.tasks.iter().any(|task| task.needs_reference())
}

/// Compares the copies of the lab in a report with the files of `lab`.
pub(super) fn compare_copies(report: &Report, lab: &Lab, findings: &mut Findings) {
    for (path, bytes) in lab.graded_copies().iter() {
        let path = format!("{LAB_FOLDER}/{path}");
        let what = format!("file `{path}`");
        findings.compare(
            Subject::File,
            &what,
            &digest_there(report, &path),
            &digest(bytes),
        );
    }
}

/// Compares every file of a report with what it is made of now, and gives how many are the same. If not `is_certain`, what the reference
/// solution does is unknown, and with it what is right of a file that shows it.
pub(super) fn compare(
    report: &Report,
    lab: &Lab,
    shown: &GradedRun,
    is_certain: bool,
    findings: &mut Findings,
) -> Result<usize, Failure> {
    let request = &report.manifest.request;
    let submission = (report.right_copy(), &report.submission);
    let files = report_folder::files(lab, submission, shown, request, Pixels::Undrawn)?;
    let mut uncertain = Vec::new();
    let mut undrawn = Vec::new();
    let mut same = 0;
    for file in &files {
        let is_known = is_certain || is_of_no_run(&file.path);
        let found = match compared(report, file)? {
            Found::Same => {
                same += 1;
                continue;
            }
            Found::NoPixels => {
                undrawn.push(file.path.clone());
                continue;
            }
            Found::Differs(found) => found,
        };
        if !is_known {
            uncertain.push(file.path.clone());
            continue;
        }
        for (what, recorded, now) in found {
            findings.compare(Subject::File, &what, &recorded, &now);
        }
    }
    let now = Manifest::of(request, &files);
    let listed = &report.manifest;
    let listed_paths = listed.files.keys().chain(listed.pixels.keys());
    let of_no_report: Vec<&String> = listed_paths.filter(|path| !now.lists(path)).collect();
    if is_certain {
        for path in some(&of_no_report, findings) {
            let what = format!("list of files in `report.json`: `{path}`");
            findings.compare(Subject::File, &what, "listed", NO_FILE);
        }
    } else {
        uncertain.extend(of_no_report.into_iter().cloned());
    }
    compare_list(report, findings)?;
    let tables = compare_others(report, &now, findings)?;
    let mut leave_out = |what: &str, paths: &[String], why: &str| {
        if !paths.is_empty() {
            let named = paths.iter().take(MOST_NAMED);
            let mut named: Vec<String> = named
                .map(|path| format!("`{}`", shortened(path, 200)))
                .collect();
            let more = paths.len().saturating_sub(MOST_NAMED);
            named.extend((more > 0).then(|| format!("{more} more")));
            findings.leave_out(&format!("{what} {}", named.join(", ")), why);
        }
    };
    let why = "they show the reference solution, which needs the course staff's part";
    leave_out("files", &uncertain, why);
    let why = "this build has no feature `png`, with which they are drawn again";
    leave_out("pictures", &undrawn, why);
    let why = "they are no part of a report; `kinemark log export` writes them again";
    leave_out("tables", &tables, why);
    Ok(same)
}

/// In place of what a file should be that no report of this submission has.
const NO_FILE: &str = "no file of this report";

/// As many paths as are named; the others are counted.
fn some<'p, T>(paths: &'p [T], findings: &mut Findings) -> &'p [T] {
    let (named, more) = paths.split_at(paths.len().min(MOST_NAMED));
    if !more.is_empty() {
        let what = format!("{} more paths", more.len());
        findings.compare(Subject::File, &what, "files", NO_FILE);
    }
    named
}

/// Compares `report.json` itself: it is written as a report is, and says nothing that no report says.
fn compare_list(report: &Report, findings: &mut Findings) -> Result<(), Failure> {
    let what = format!("file `{MANIFEST_FILE}`");
    let list = output::json(&report.manifest).map_err(report_folder::fault)?;
    let now = digest(list.as_bytes());
    findings.compare(
        Subject::File,
        &what,
        &digest_there(report, MANIFEST_FILE),
        &now,
    );
    let request = &report.manifest.request;
    if request.reference_overlay && report.grade.mode == GradeMode::Practice {
        let what = format!("`reference_overlay` in `{MANIFEST_FILE}`");
        findings.compare(
            Subject::File,
            &what,
            "true",
            "false, as in every practice report",
        );
    }
    Ok(())
}

/// Names what lies in the folder and is no file of the report; gives the folders of tables, which commands put there and which prove nothing.
fn compare_others(
    report: &Report,
    now: &Manifest,
    findings: &mut Findings,
) -> Result<Vec<String>, Failure> {
    // what is listed and no file of the report is named already
    let ours = |path: &str| match report_folder::entry(now, path) {
        Entry::Foreign => report_folder::entry(&report.manifest, path),
        entry => entry,
    };
    let others = fresh_folder::others(&disk::real(&report.folder), ours);
    let others =
        others.map_err(|why| Failure::broken(why, "check the permissions of the folder"))?;
    let (tables, foreign): (Vec<_>, Vec<_>) = others
        .into_iter()
        .partition(|(_, entry)| *entry == Entry::Kept);
    // what should be a file and is none is named among the files
    let is_named = |path: &str| now.lists(path) || report.manifest.lists(path);
    let foreign: Vec<_> = foreign
        .into_iter()
        .filter(|(path, _)| !is_named(path))
        .collect();
    for (path, _) in some(&foreign, findings) {
        findings.compare(
            Subject::File,
            &format!("`{path}`"),
            "in the folder",
            NO_FILE,
        );
    }
    Ok(tables.into_iter().map(|(path, _)| path).collect())
}

/// Whether a file follows from what was handed in and from the record alone.
fn is_of_no_run(path: &str) -> bool {
    let is_copy = path.strip_prefix(LAB_FOLDER);
    is_copy.is_some_and(|rest| rest.starts_with('/'))
        || [RECORD_FILE, SUBMISSION_FILE, PYTHON_FILE, MODULE_FILE].contains(&path)
}

/// What a file of a report is beside the same file made now.
enum Found {
    Same,
    /// A picture that this build cannot draw.
    NoPixels,
    /// What differs, as it is recorded, and now.
    Differs(Vec<(String, String, String)>),
}

fn compared(report: &Report, file: &OutFile) -> Result<Found, Failure> {
    let (path, manifest) = (&file.path, &report.manifest);
    let what = format!("file `{path}`");
    let not_listed = || "not listed in report.json".to_owned();
    let in_list = || format!("digest of `{path}` in `report.json`");
    if file.is_pixels {
        let differs = |recorded: String, now: &str| {
            let found = (what.clone(), recorded, now.to_owned());
            Ok(Found::Differs(vec![found]))
        };
        let Ok(bytes) = report.picture(path) else {
            return differs(digest_there(report, path), "a picture");
        };
        let there = digest(&bytes);
        let shows = output::shows(&bytes, &file.bytes).map_err(report_folder::fault)?;
        if shows == Some(false) {
            return differs(there, "a picture that shows something else");
        }
        // of its bytes the report itself knows alone what they were
        let listed = manifest.pixels.get(path).cloned();
        let listed = listed.unwrap_or_else(not_listed);
        if listed != there {
            return Ok(Found::Differs(vec![(in_list(), listed, there)]));
        }
        return Ok(shows.map_or(Found::NoPixels, |_| Found::Same));
    }
    let now = digest(&file.bytes);
    let listed = manifest.files.get(path).cloned().unwrap_or_else(not_listed);
    let both = [(what, digest_there(report, path)), (in_list(), listed)];
    let differs = both.into_iter().filter(|(_, recorded)| *recorded != now);
    let differs: Vec<_> = differs
        .map(|(what, recorded)| (what, recorded, now.clone()))
        .collect();
    Ok(match differs.is_empty() {
        true => Found::Same,
        false => Found::Differs(differs),
    })
}

/// The digest of a file in the folder; why there is none, in words.
fn digest_there(report: &Report, path: &str) -> String {
    match report.digest(path) {
        Ok(digest) => digest,
        Err(Unread::Absent) => MISSING.to_owned(),
        Err(why) => why.to_string(),
    }
}
