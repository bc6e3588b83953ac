//! The output folder of `kinemark grade`: written beside its place under another name, then renamed, so that it is whole or not
//! there; and read back by `kinemark verify`.

use std::path::{Path, PathBuf};

use kinemark_grader::lab::files::text;
use kinemark_grader::lab::variant::VARIANT_FILE;
use kinemark_grader::lab::{Files as _, Lab, LoadError, Variant};
use kinemark_grader::record::grade::{self, Grade};
use kinemark_grader::record::graded::{GradedRun, TaskRun};
use kinemark_report::log::{self, Attachment};
use kinemark_report::plot::Plot;
use kinemark_report::visible::visible;
use kinemark_sim::source::Source;

use crate::disk::{self, Folder, plain};
use crate::failure::Failure;
use crate::fresh_folder::{self, Entry, FreshFolder};
use crate::output;

/// The record's file; a folder that has it is a report of ours.
pub(crate) const RECORD: &str = "grade.json";
/// The page.
pub(crate) const PAGE: &str = "report.html";
/// The copy of the submission.
pub(crate) const SUBMISSION: &str = "submission.rhai";
/// The copy of lab and robot, in the shape of a labs folder.
pub(crate) const LABS: &str = "lab";

/// Where the tables of a run go unless a place is named, in the task's folder.
pub(crate) const TABLES: &str = "run-csv";

/// Records and submissions are far smaller.
const MOST_BYTES: u64 = 64 << 20;
/// Pages with the meshes of their robots are smaller.
pub(crate) const MOST_PAGE_BYTES: u64 = 512 << 20;

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
    let kept = refuse_foreign(out)?;
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
    for file in &files {
        fresh.write(&file.path, &file.bytes).map_err(failed)?;
    }
    fresh.put_in_place(&kept).map_err(failed)
}

/// Checks, before anything is graded, that `out` is free, empty, or an earlier report and nothing else; what exports put beside its
/// logs is to be kept.
pub(crate) fn refuse_foreign(out: &Path) -> Result<Vec<String>, Failure> {
    let record = disk::bytes_of(&out.join(RECORD), MOST_BYTES).ok();
    let record: Option<Grade> = record.and_then(|text| serde_json::from_slice(&text).ok());
    let copies = record.as_ref().map(|record| copies_in(out, record));
    fresh_folder::refuse_foreign(out, "a Kinemark report", |path| {
        // without a record of ours nothing in it is ours
        let (Some(record), Some(copies)) = (&record, &copies) else {
            return Entry::Foreign;
        };
        let (first, below) = path.split_once('/').unwrap_or((path, ""));
        let is_task = record.tasks.iter().any(|task| task.name == first);
        let ending = path.rsplit_once('.').map_or("", |(_, ending)| ending);
        match (first, below) {
            (RECORD | PAGE | SUBMISSION, "") => Entry::Ours,
            ("plots" | LABS, "") => Entry::Inside,
            ("plots", _) if ["svg", "png"].contains(&ending) => Entry::Ours,
            (LABS, below) => copies.entry(below),
            (_, "") if is_task => Entry::Inside,
            (_, "run.mcap" | "run.layout.json" | STORYBOARD | "storyboard.svg") if is_task => {
                Entry::Ours
            }
            (_, TABLES) if is_task => Entry::Kept,
            _ => Entry::Foreign,
        }
    })
}

/// The copies of lab and robot that a report holds.
struct CopiesIn {
    /// Their paths; none where the lab is none that this version loads.
    paths: Option<Vec<String>>,
}

impl CopiesIn {
    fn entry(&self, path: &str) -> Entry {
        let Some(paths) = &self.paths else {
            // of an older version, or changed: what a lab is made of
            let ending = path.rsplit_once('.').map_or("", |(_, ending)| ending);
            return match ending {
                "toml" | "json" | "stl" | "obj" => Entry::Ours,
                "" => Entry::Inside,
                _ => Entry::Foreign,
            };
        };
        let is_above = |known: &String| {
            let rest = known.strip_prefix(path);
            rest.is_some_and(|rest| rest.starts_with('/'))
        };
        if paths.iter().any(|known| known == path) {
            Entry::Ours
        } else if paths.iter().any(is_above) {
            Entry::Inside
        } else {
            Entry::Foreign
        }
    }
}

fn copies_in(out: &Path, record: &Grade) -> CopiesIn {
    let lab = load(&Folder::new(out.join(LABS)), &record.lab.name).ok();
    let paths = lab.map(|lab| {
        let copies = lab.copies();
        copies.iter().map(|(path, _)| path.to_owned()).collect()
    });
    CopiesIn { paths }
}

/// Everything the folder holds: a function of lab, submission, graded run and the pictures asked for alone.
pub(crate) fn files(
    lab: &Lab,
    submission: &Source,
    graded: &GradedRun,
    pictures: Pictures,
) -> Result<Vec<OutFile>, Failure> {
    let record = output::json(&graded.grade)?;
    let plots: Vec<Vec<Plot>> = graded
        .runs
        .iter()
        .map(kinemark_report::plot::plots)
        .collect();
    let mut files = vec![
        OutFile::new(RECORD, record.as_bytes()),
        OutFile::new(PAGE, kinemark_report::html::html(graded, &plots)),
        OutFile::new(SUBMISSION, submission.text()),
    ];
    for (path, bytes) in lab.copies().iter() {
        files.push(OutFile::new(format!("{LABS}/{path}"), bytes));
    }
    for (run, plots) in graded.runs.iter().zip(plots) {
        let caption = format!("{} \u{b7} {}", graded.grade.lab.name, run.task);
        for plot in plots {
            let svg = plot.captioned(&caption);
            if pictures.png {
                let path = format!("plots/{}.png", plot.name);
                files.push(OutFile::new(path, png(&svg)?));
            }
            files.push(OutFile::new(format!("plots/{}.svg", plot.name), svg));
        }
        let task = graded.grade.tasks.iter().find(|t| t.name == run.task);
        if let Some(task) = task.filter(|_| pictures.storyboard) {
            let svg = kinemark_report::storyboard::storyboard(run, task);
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
    kinemark_report::png::png(svg)
        .map_err(|error| Failure::fault(error.to_string(), "please report this"))
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
    let shown = folder.display();
    if !folder.is_dir() {
        return Err(Failure::usage(
            format!("there is no folder `{shown}`"),
            "name the folder that `kinemark grade` wrote",
        ));
    }
    let there = |name: &str| match folder.join(name).symlink_metadata() {
        Ok(_) => Ok(()),
        Err(_) => Err(Failure::broken(
            format!("`{shown}` has no {name}: it is not a complete report"),
            "name the folder that `kinemark grade` wrote, or grade the submission again",
        )),
    };
    there(RECORD)?;
    let grade = record(&folder.join(RECORD))?;
    there(SUBMISSION)?;
    there(LABS)?;
    let path = folder.join(SUBMISSION);
    let submission = disk::bytes_of(&path, MOST_BYTES).and_then(text);
    let submission = submission.map_err(|why| {
        Failure::broken(
            format!("`{}` cannot be read: {why}", path.display()),
            "grade the submission again",
        )
    })?;
    // only the writer of replays leaves quotes as they are
    let page = disk::bytes_of(&folder.join(PAGE), MOST_PAGE_BYTES).unwrap_or_default();
    let sign = br#""ghostLabel":"reference""#;
    let shows_reference = page.windows(sign.len()).any(|part| part == sign);
    Ok(Report {
        shows_reference,
        submission: Source::new(grade.submission.name.as_str(), submission),
        labs: folder.join(LABS),
        grade,
    })
}

/// Reads a grade record, if it is of the format that this version writes.
fn record(path: &Path) -> Result<Grade, Failure> {
    #[derive(serde::Deserialize)]
    struct Format {
        format: String,
    }
    let shown = path.display();
    let unread = |why: &str| {
        Failure::broken(
            format!("`{shown}` is not a grade record of this version: {why}"),
            "grade the submission again",
        )
    };
    let bytes = disk::bytes_of(path, MOST_BYTES).map_err(|why| unread(&why))?;
    // the format first: of another version everything else may be another
    let Format { format } =
        serde_json::from_slice(&bytes).map_err(|error| unread(&visible(&error.to_string())))?;
    if format != grade::FORMAT {
        let (format, ours) = (visible(&format), grade::FORMAT);
        return Err(unread(&format!("its format is `{format}`, not `{ours}`")));
    }
    serde_json::from_slice(&bytes).map_err(|error| unread(&visible(&error.to_string())))
}

/// The lab of a report, in its variant, from the copies in its folder; and these.
pub(crate) fn lab_of(report: &Report) -> Result<(Lab, Folder), Failure> {
    let copies = Folder::new(report.labs.clone());
    let lab = load(&copies, &report.grade.lab.name).map_err(|error| match error {
        // nobody named a lab here
        LoadError::UnknownLab { .. } => Failure::broken(
            format!(
                "`{}` has no lab `{}`: the report is not complete",
                report.labs.display(),
                visible(&report.grade.lab.name)
            ),
            "grade the submission again",
        ),
        other => other.into(),
    })?;
    Ok((lab, copies))
}

fn load(copies: &Folder, name: &str) -> Result<Lab, LoadError> {
    let path = format!("{name}/{VARIANT_FILE}");
    let variant = match copies.read(&path) {
        Ok(Some(text)) => Some(Variant::parse(Source::new(VARIANT_FILE, text))?),
        Ok(None) => None,
        Err(why) => return Err(LoadError::Unreadable { path, why }),
    };
    Lab::load_variant(copies, name, variant.as_ref())
}
