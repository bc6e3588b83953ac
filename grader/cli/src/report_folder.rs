//! The output folder of `kinemark grade`: written beside its place under another name, then renamed, so that it is whole or not
//! there; and read back by `kinemark verify`. What is in it is the table of outputs ([`kinemark_report::output`]).

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use kinemark_course::module_sources::{MOST_FILE_BYTES, MOST_FILES, SourceFile, is_kept_path};
use kinemark_course::submission_source::SubmissionSource;
use kinemark_grader::lab::variant::VARIANT_FILE;
use kinemark_grader::lab::{Lab, Variant};
use kinemark_grader::record::grade::{self, Grade};
use kinemark_grader::record::graded::GradedRun;
use kinemark_grader::submission::handed_in::Program;
use kinemark_grader::task::files::Files as _;
use kinemark_grader::task::problem::LoadError;
use kinemark_report::output::{
    self, LAB_FOLDER, LOG_FILE, MANIFEST_FILE, MODULE_FILE, Manifest, Material, OutFile,
    OutputError, PYTHON_FILE, Pixels, RECORD_FILE, ReportRequest, SOURCES_FOLDER, SUBMISSION_FILE,
    Sources,
};
use kinemark_report::visible::visible;
use kinemark_sim::text::Source;

use crate::beneath::{self, FolderBeneath, Unread};
use crate::disk::plain;
use crate::error_record::ErrorCode;
use crate::failure::Failure;
use crate::fresh_folder::{self, Entry, FreshFolder};
use crate::unfinished::is_there_or_restored;

/// Where the tables of a run go unless a place is named, in the task's folder.
pub(crate) const TABLES: &str = "run-csv";

/// Records and submissions are far smaller.
const MOST_BYTES: u64 = 64 << 20;
/// Pages with the meshes of their robots are smaller.
pub(crate) const MOST_PAGE_BYTES: u64 = 512 << 20;

/// Writes the folder `out`. An earlier report there is replaced; anything else there is not touched.
pub(crate) fn write(
    out: &Path,
    lab: &Lab,
    submission: &SubmissionSource,
    graded: &GradedRun,
    request: &ReportRequest,
) -> Result<(), Failure> {
    let kept = refuse_foreign(out)?;
    let copy = copy_name(submission);
    let files = files(lab, (copy, submission), graded, request, Pixels::Drawn)?;
    let manifest = output::json(&Manifest::of(request, &files)).map_err(fault)?;
    let failed = |error: std::io::Error| {
        Failure::fault(
            format!(
                "the report cannot be written to `{}`: {}",
                out.display(),
                plain(&error)
            ),
            match error.kind() {
                ErrorKind::PermissionDenied if cfg!(windows) => {
                    "close what has a file of that folder open, or choose another with --out; the grade above stands"
                }
                _ => {
                    "free some space or choose another folder with --out; the grade above stands, and nothing half-written is left"
                }
            },
        ).coded(ErrorCode::Unwritten)
    };
    let fresh = FreshFolder::beside(out).map_err(failed)?;
    for file in &files {
        fresh.write(&file.path, &file.bytes).map_err(failed)?;
    }
    fresh
        .write(MANIFEST_FILE, manifest.as_bytes())
        .map_err(failed)?;
    fresh.put_in_place(&kept).map_err(failed)
}

/// Checks, before anything is graded, that `out` is free, empty, or an earlier report and nothing else; what exports put beside its
/// logs is to be kept.
pub(crate) fn refuse_foreign(out: &Path) -> Result<Vec<String>, Failure> {
    let manifest = beneath::bytes(out, MANIFEST_FILE, MOST_BYTES).ok();
    let manifest = manifest.and_then(|text| Manifest::parse(&text).ok());
    if manifest.is_none() && out.join(RECORD_FILE).is_file() {
        return Err(Failure::usage(
            format!(
                "`{}` has a {RECORD_FILE} and no {MANIFEST_FILE} of this version that lists its files: it cannot be replaced",
                out.display()
            ),
            "move or delete the folder, or choose another with --out",
        ).coded(ErrorCode::Exists));
    }
    fresh_folder::refuse_foreign(out, "a Kinemark report", |path| {
        // without a list of ours nothing in it is ours
        let manifest = manifest.as_ref();
        manifest.map_or(Entry::Foreign, |manifest| entry(manifest, path))
    })
}

/// What an entry of the folder is to a report of these files.
pub(crate) fn entry(manifest: &Manifest, path: &str) -> Entry {
    let is_tables = path
        .strip_suffix(TABLES)
        .is_some_and(|task| task.ends_with('/') && manifest.lists(&format!("{task}{LOG_FILE}")));
    match path {
        path if manifest.lists(path) => Entry::Ours,
        path if manifest.lists_below(path) => Entry::Inside,
        _ if is_tables => Entry::Kept,
        _ => Entry::Foreign,
    }
}

/// The name of the copy of a submission, by what it is.
pub(crate) fn copy_name(submission: &SubmissionSource) -> &'static str {
    match submission.submission.program() {
        Program::Module(_) => MODULE_FILE,
        Program::Script(_) => SUBMISSION_FILE,
        Program::Python(_) => PYTHON_FILE,
    }
}

/// Every file of the folder but `report.json`: a function of lab, submission with the name of its copy, graded run and request alone.
pub(crate) fn files(
    lab: &Lab,
    (copy, submission): (&str, &SubmissionSource),
    graded: &GradedRun,
    request: &ReportRequest,
    pixels: Pixels,
) -> Result<Vec<OutFile>, Failure> {
    let copies = lab.graded_copies();
    let copies = copies.iter();
    let lab_files: Vec<(String, Vec<u8>)> = copies
        .map(|(path, bytes)| (path.to_owned(), bytes.to_owned()))
        .collect();
    let mut module_sources: Vec<(String, Vec<u8>)> = submission
        .sources
        .iter()
        .map(|file| (file.path.clone(), file.bytes.clone()))
        .collect();
    // in the order in which a report lists them, whichever way they were handed in
    module_sources.sort();
    let own_robots = lab.tasks.iter().filter_map(|task| {
        let own = task.own.as_ref()?;
        Some((task.name.as_str(), own.robot_file.source().text()))
    });
    let own_robots: Vec<(&str, &str)> = own_robots.collect();
    let sources = Sources {
        submission_file: copy,
        submission: &submission.bytes,
        module_sources: &module_sources,
        lab: &lab.graded_text,
        robot: lab.robot_file.source().text(),
        own_robots: &own_robots,
        lab_files: &lab_files,
    };
    let material = Material::new(graded, sources, request, pixels).map_err(fault)?;
    output::files(&material).map_err(fault)
}

#[expect(
    clippy::needless_pass_by_value,
    reason = "it is what `map_err` hands on"
)]
pub(crate) fn fault(error: OutputError) -> Failure {
    Failure::fault(error.to_string(), "please report this")
}

/// A report read back.
pub(crate) struct Report {
    /// Where it is.
    pub(crate) folder: PathBuf,
    pub(crate) grade: Grade,
    pub(crate) submission: SubmissionSource,
    /// The name of the submission's copy in the folder.
    pub(crate) copy: &'static str,
    /// What was requested, and the digests of its files.
    pub(crate) manifest: Manifest,
}

/// Reads the folder of an earlier report.
pub(crate) fn read(folder: &Path) -> Result<Report, Failure> {
    let shown = folder.display();
    if !is_there_or_restored(folder) {
        return Err(Failure::usage(
            format!("there is no folder `{shown}`"),
            "name the folder that `kinemark grade` wrote",
        )
        .coded(ErrorCode::NoFile));
    }
    let there = |name: &str| match folder.join(name).symlink_metadata() {
        Ok(_) => Ok(()),
        Err(_) => Err(Failure::broken(
            format!("`{shown}` has no {name}: it is not a complete report"),
            "name the folder that `kinemark grade` wrote, or grade the submission again",
        )
        .coded(ErrorCode::NoReport)),
    };
    there(RECORD_FILE)?;
    let grade = record(folder)?;
    there(MANIFEST_FILE)?;
    let manifest = manifest(folder)?;
    let mut copies = [MODULE_FILE, PYTHON_FILE].into_iter();
    let copy = copies.find(|copy| manifest.lists(copy));
    let copy = copy.unwrap_or(SUBMISSION_FILE);
    there(copy)?;
    there(LAB_FOLDER)?;
    let submission = beneath::bytes(folder, copy, MOST_BYTES);
    let submission = submission.map_err(|why| {
        let path = folder.join(copy);
        Failure::broken(
            format!("`{}` cannot be read: {why}", path.display()),
            "grade the submission again",
        )
        .coded(ErrorCode::NoReport)
    })?;
    let sources = sources(folder, &manifest);
    Ok(Report {
        folder: folder.to_owned(),
        manifest,
        copy,
        submission: SubmissionSource::new(&grade.submission.name, &submission)
            .with_sources(sources),
        grade,
    })
}

/// The report in which a file lies, and the file's path in it with `/` between names: the outermost folder above the file that has a
/// record, so that none inside passes for the report itself.
pub(crate) fn enclosing(file: &Path) -> Option<(PathBuf, String)> {
    // from the root on: the folder one stands in may be inside a report
    let file = std::path::absolute(file).ok()?;
    let is_report = |folder: &&Path| folder.join(RECORD_FILE).symlink_metadata().is_ok();
    let folder = file.ancestors().skip(1).filter(is_report).last()?;
    let inside = file.strip_prefix(folder).ok()?;
    let names: Vec<_> = inside.iter().map(|name| name.to_string_lossy()).collect();
    Some((folder.to_owned(), names.join("/")))
}

impl Report {
    /// Its copies of the lab's files.
    pub(crate) fn copies(&self) -> FolderBeneath {
        FolderBeneath::new(self.folder.clone(), LAB_FOLDER)
    }

    /// The name that the copy of its submission should have: by what it is, and earlier reports have modules under the name of a script.
    pub(crate) fn right_copy(&self) -> &'static str {
        match copy_name(&self.submission) {
            MODULE_FILE => self.copy,
            name => name,
        }
    }

    /// A picture of the report.
    pub(crate) fn picture(&self, path: &str) -> Result<Vec<u8>, Unread> {
        beneath::bytes(&self.folder, path, MOST_BYTES)
    }

    /// The digest of a file of the report, which is not held in memory.
    pub(crate) fn digest(&self, path: &str) -> Result<String, Unread> {
        beneath::digest(&self.folder, path, MOST_PAGE_BYTES)
    }
}

/// The sources of a module that a report lists. What cannot be read is left out: a comparison finds that it is missing.
fn sources(folder: &Path, manifest: &Manifest) -> Vec<SourceFile> {
    let below = manifest.files.keys().filter_map(|path| {
        let path = path.strip_prefix(SOURCES_FOLDER)?.strip_prefix('/')?;
        is_kept_path(path).then(|| path.to_owned())
    });
    let read = |path: String| {
        let in_report = format!("{SOURCES_FOLDER}/{path}");
        let bytes = beneath::bytes(folder, &in_report, MOST_FILE_BYTES).ok()?;
        Some(SourceFile { path, bytes })
    };
    below.take(MOST_FILES + 1).filter_map(read).collect()
}

/// Reads a grade record, if it is of the format that this version writes.
pub(crate) fn record(folder: &Path) -> Result<Grade, Failure> {
    #[derive(serde::Deserialize)]
    struct Format {
        format: String,
    }
    let path = folder.join(RECORD_FILE);
    let shown = path.display();
    let unread = |why: &str| {
        Failure::broken(
            format!("`{shown}` is not a grade record of this version: {why}"),
            "grade the submission again",
        )
        .coded(ErrorCode::NoReport)
    };
    let bytes = beneath::bytes(folder, RECORD_FILE, MOST_BYTES);
    let bytes = bytes.map_err(|why| unread(&why.to_string()))?;
    // the format first: of another version everything else may be another
    let Format { format } =
        serde_json::from_slice(&bytes).map_err(|error| unread(&visible(&error.to_string())))?;
    if format != grade::FORMAT {
        let (format, ours) = (visible(&format), grade::FORMAT);
        return Err(unread(&format!("its format is `{format}`, not `{ours}`")));
    }
    serde_json::from_slice(&bytes).map_err(|error| unread(&visible(&error.to_string())))
}

/// Reads a list of a report's files, if it is of the format that this version writes.
fn manifest(folder: &Path) -> Result<Manifest, Failure> {
    let path = folder.join(MANIFEST_FILE);
    let bytes = beneath::bytes(folder, MANIFEST_FILE, MOST_BYTES);
    let read = bytes.map_err(|why| why.to_string()).and_then(|bytes| {
        Manifest::parse(&bytes).map_err(|error| visible(&error.to_string()).into_owned())
    });
    read.map_err(|why| {
        Failure::broken(
            format!(
                "`{}` is no list of a report's files that this version reads: {why}",
                path.display()
            ),
            "grade the submission again",
        )
        .coded(ErrorCode::NoReport)
    })
}

/// The lab of a report, in its variant, from the copies in its folder.
pub(crate) fn lab_of(report: &Report) -> Result<Lab, Failure> {
    let copies = report.copies();
    load(&copies, &report.grade.lab.name).map_err(|error| match error {
        // nobody named a lab here
        LoadError::UnknownLab { .. } => Failure::broken(
            format!(
                "`{}` has no lab `{}`: the report is not complete",
                copies.name(),
                visible(&report.grade.lab.name)
            ),
            "grade the submission again",
        )
        .coded(ErrorCode::NoReport),
        other => other.into(),
    })
}

fn load(copies: &FolderBeneath, name: &str) -> Result<Lab, LoadError> {
    Lab::load_variant(copies, name, variant(copies, name)?.as_ref())
}

/// The variant of which the copies of a lab are, if they are of one.
pub(crate) fn variant(copies: &FolderBeneath, name: &str) -> Result<Option<Variant>, LoadError> {
    let path = format!("{name}/{VARIANT_FILE}");
    match copies.read(&path) {
        Ok(Some(text)) => Ok(Some(Variant::parse(Source::new(VARIANT_FILE, text))?)),
        Ok(None) => Ok(None),
        Err(why) => Err(LoadError::Unreadable { path, why }),
    }
}
