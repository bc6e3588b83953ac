//! The output folder of `kinemark grade`: written beside its place under another name, then renamed, so that it is whole or not
//! there; and read back by `kinemark verify`.

use std::path::{Path, PathBuf};

use kinemark_grader::grade::Grade;
use kinemark_grader::graded::{GradedRun, TaskRun};
use kinemark_grader::lab::variant::VARIANT_FILE;
use kinemark_grader::lab::{Files as _, Lab, LoadError, Variant};
use kinemark_grader::log::{self, Attachment};
use kinemark_grader::report::{self, plot::Plot};
use kinemark_sim::source::Source;

use crate::disk::{self, Folder, plain};
use crate::failure::Failure;
use crate::fresh_folder::{self, FreshFolder};
use crate::output;

/// The record's file; a folder that has it is a report of ours.
pub(crate) const RECORD: &str = "grade.json";
/// The page.
pub(crate) const PAGE: &str = "report.html";
/// The copy of the submission.
pub(crate) const SUBMISSION: &str = "submission.rhai";
/// The copy of lab and robot, in the shape of a labs folder.
pub(crate) const LABS: &str = "lab";

/// The storyboard of a motion task, in the task's folder.
pub(crate) const STORYBOARD: &str = "storyboard.png";

/// Which pictures the folder holds besides the plots.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Pictures {
    /// Each plot as PNG, beside the SVG.
    pub(crate) png: bool,
    /// The storyboard of each motion task, as SVG and PNG.
    pub(crate) storyboard: bool,
}

impl Pictures {
    /// Those that a folder was written with.
    pub(crate) fn of(folder: &Path, record: &Grade) -> Self {
        let png = |entry: &std::fs::DirEntry| {
            let path = entry.path();
            path.extension().is_some_and(|extension| extension == "png")
        };
        let plots = std::fs::read_dir(folder.join("plots"));
        let of_task = |task: &str| folder.join(task).join(STORYBOARD);
        Self {
            png: plots.into_iter().flatten().flatten().any(|e| png(&e)),
            storyboard: record.tasks.iter().any(|task| {
                let png = of_task(&task.name);
                png.exists() || png.with_extension("svg").exists()
            }),
        }
    }
}

/// One file of the folder.
pub(crate) struct OutFile {
    /// Its path inside the folder.
    pub(crate) path: String,
    /// Its content.
    pub(crate) bytes: Vec<u8>,
}

impl OutFile {
    fn new(path: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self {
            path: path.into(),
            bytes: bytes.into(),
        }
    }
}

/// Writes the folder `out`. An earlier report there is replaced; anything else there is not touched.
pub(crate) fn write(
    out: &Path,
    lab: &Lab,
    submission: &Source,
    graded: &GradedRun,
    pictures: Pictures,
) -> Result<(), Failure> {
    refuse_foreign(out)?;
    let files = files(lab, submission, graded, pictures)?;
    let failed = |error: std::io::Error| {
        Failure::fault(
            format!(
                "the report cannot be written to `{}`: {}",
                out.display(),
                plain(&error)
            ),
            "free some space or choose another folder with --out; the grade above stands, and nothing half-written is left",
        )
    };
    let fresh = FreshFolder::beside(out).map_err(failed)?;
    let folder = fresh.path();
    for file in &files {
        let path = folder.join(&file.path);
        std::fs::create_dir_all(path.parent().unwrap_or(&folder)).map_err(failed)?;
        output::write_file(&path, &file.bytes).map_err(failed)?;
    }
    fresh.put_in_place().map_err(failed)
}

/// Checks, before anything is graded, that `out` is free, empty, or an earlier report.
pub(crate) fn refuse_foreign(out: &Path) -> Result<(), Failure> {
    let mut ours = vec![RECORD, PAGE, SUBMISSION, LABS, "plots"];
    let record = std::fs::read(out.join(RECORD)).ok();
    let record: Option<Grade> = record.and_then(|text| serde_json::from_slice(&text).ok());
    match &record {
        Some(record) => ours.extend(record.tasks.iter().map(|task| task.name.as_str())),
        // without a record of ours nothing in it is ours
        None => ours.clear(),
    }
    fresh_folder::refuse_foreign(out, "a Kinemark report", |name| ours.contains(&name))
}

/// Everything the folder holds: a function of lab, submission, graded run and the pictures asked for alone.
pub(crate) fn files(
    lab: &Lab,
    submission: &Source,
    graded: &GradedRun,
    pictures: Pictures,
) -> Result<Vec<OutFile>, Failure> {
    let record = output::json(&graded.grade)?;
    let plots: Vec<Vec<Plot>> = graded.runs.iter().map(report::plot::plots).collect();
    let mut files = vec![
        OutFile::new(RECORD, record.as_bytes()),
        OutFile::new(PAGE, report::html::html(graded, &plots)),
        OutFile::new(SUBMISSION, submission.text()),
    ];
    for (path, bytes) in lab.copies().iter() {
        files.push(OutFile::new(format!("{LABS}/{path}"), bytes));
    }
    for (run, plots) in graded.runs.iter().zip(plots) {
        for plot in plots {
            if pictures.png {
                let path = format!("plots/{}.png", plot.name);
                files.push(OutFile::new(path, png(&plot.svg)?));
            }
            files.push(OutFile::new(format!("plots/{}.svg", plot.name), plot.svg));
        }
        let task = graded.grade.tasks.iter().find(|t| t.name == run.task);
        if let Some(task) = task.filter(|_| pictures.storyboard) {
            let svg = report::storyboard::storyboard(run, task);
            let path = format!("{}/{STORYBOARD}", run.task);
            files.push(OutFile::new(path, png(&svg)?));
            files.push(OutFile::new(format!("{}/storyboard.svg", run.task), svg));
        }
        let log = log_of(run, lab, &graded.grade, &record)?;
        files.push(OutFile::new(format!("{}/run.mcap", run.task), log));
        let layout = log::layout(run);
        files.push(OutFile::new(
            format!("{}/run.layout.json", run.task),
            layout,
        ));
    }
    Ok(files)
}

fn png(svg: &str) -> Result<Vec<u8>, Failure> {
    report::png::png(svg).map_err(|error| Failure::fault(error.to_string(), "please report this"))
}

fn log_of(run: &TaskRun, lab: &Lab, grade: &Grade, record: &str) -> Result<Vec<u8>, Failure> {
    let layout = log::layout(run);
    let attachments = [
        (
            "robot.toml",
            "application/toml",
            lab.robot_file.source().text(),
        ),
        ("lab.toml", "application/toml", lab.source.text()),
        ("grade.json", "application/json", record),
        ("run.layout.json", "application/json", layout.as_str()),
    ]
    .map(|(name, media_type, text)| Attachment {
        name,
        media_type,
        bytes: text.as_bytes(),
    });
    log::mcap(run, grade, &attachments).map_err(|error| {
        Failure::fault(
            format!("the log of task `{}` failed: {error}", run.task),
            "please report this",
        )
    })
}

/// A report read back.
pub(crate) struct Report {
    pub(crate) grade: Grade,
    pub(crate) submission: Source,
    pub(crate) labs: PathBuf,
    /// Whether the reference solution's motion stands in it.
    pub(crate) shows_reference: bool,
}

/// Reads the folder of an earlier report.
pub(crate) fn read(folder: &Path) -> Result<Report, Failure> {
    if !folder.is_dir() {
        return Err(Failure::usage(
            format!("there is no folder `{}`", folder.display()),
            "name the folder that `kinemark grade` wrote",
        ));
    }
    let record_path = folder.join(RECORD);
    if !record_path.is_file() {
        return Err(Failure::broken(
            format!("`{}` has no {RECORD}: it is no report", folder.display()),
            "name the folder that `kinemark grade` wrote",
        ));
    }
    let record = disk::read(&record_path, "a grade record", 64 << 20)?;
    let grade: Grade = serde_json::from_str(record.text()).map_err(|error| {
        Failure::broken(
            format!(
                "`{}` is no grade record this version reads: {error}",
                record_path.display()
            ),
            "grade the submission again",
        )
    })?;
    let text = disk::read(&folder.join(SUBMISSION), "the submission", 64 << 20)?;
    // only the writer of replays leaves quotes as they are
    let page = std::fs::read(folder.join(PAGE)).unwrap_or_default();
    let sign = br#""ghostLabel":"reference""#;
    let shows_reference = page.windows(sign.len()).any(|part| part == sign);
    Ok(Report {
        shows_reference,
        submission: Source::new(grade.submission.name.as_str(), text.text()),
        labs: folder.join(LABS),
        grade,
    })
}

/// The lab of a report, in its variant, from the copies in its folder; and these.
pub(crate) fn lab_of(report: &Report) -> Result<(Lab, Folder), Failure> {
    let name = &report.grade.lab.name;
    let copies = Folder::new(report.labs.clone());
    let variant = match copies.read(&format!("{name}/{VARIANT_FILE}")) {
        Ok(Some(text)) => {
            let variant = Variant::parse(Source::new(VARIANT_FILE, text));
            Some(variant.map_err(LoadError::from)?)
        }
        Ok(None) => None,
        Err(why) => {
            return Err(Failure::broken(
                format!("{VARIANT_FILE}: {why}"),
                "grade the submission again",
            ));
        }
    };
    let lab = Lab::load_variant(&copies, name, variant.as_ref())?;
    Ok((lab, copies))
}
