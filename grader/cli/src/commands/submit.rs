//! `kinemark submit`: the one file to upload, with the submission and its grade in practice.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use kinemark_course::hand_in_file::{HandInFile, HandedIn, Statement, file_name, is_hand_in};
use kinemark_course::journal::MadeWith;
use kinemark_course::selection::{MOST_HAND_IN_BYTES, MOST_SUBMISSION_BYTES};
use kinemark_course::staffed_lab::{engine_id, lab_version};
use kinemark_course::student::StudentId;
use kinemark_course::submission_source::SubmissionSource;
use kinemark_grader::lab::{Lab, Variant};
use kinemark_grader::record::quantity::points;
use kinemark_grader::record::verdict::Verdict;
use kinemark_report::visible::visible;
use serde::Serialize;

use super::grade::progress;
use crate::chosen_variant::{self, Chosen, LabArgs, VariantArgs};
use crate::failure::{self, FAULT, Failure};
use crate::hand_in_warnings::BeforeUpload;
use crate::handed_out_lab::Warning;
use crate::labs_folder::LabsFolderArgs;
use crate::project::Project;
use crate::staff_folder::{StaffArgs, StaffPart};
use crate::worker::WorkerHost;
use crate::{disk, interrupt, output, typed_path, working_lab};

/// Write the one file to upload
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark submit\n  kinemark submit 01-kinematics submission.rhai\n  \
    kinemark submit 01-kinematics submission.rhai --student s1234567\n\n\
    Grades in practice, writes LAB.kinemark (with the id of your variant in its name), and warns of what looks like a slip; \
    a warning stops nothing.\n\
    Without LAB it is the lab of kinemark.toml, of variant.toml, of the folder, or of the last report; without FILE it is submission.rhai.\n\
    Exit codes: 0 written, 2 usage, 3 the lab is broken, 4 it cannot be written, or this machine could not grade it."
)]
pub(crate) struct Args {
    /// The lab, as `kinemark` lists it
    pub(crate) lab: Option<String>,
    /// The submission: a script, a file in Python, a module, or the folder of a project [default: submission.rhai or submission.py, or the project's module]
    #[arg(value_name = "FILE")]
    pub(crate) submission: Option<PathBuf>,
    /// File or folder to write to [default: LAB.kinemark]; an earlier hand-in file there is replaced
    #[arg(long, short, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Your id, as the course writes it: warns if the variant is somebody else's
    #[arg(long, value_name = "ID")]
    pub(crate) student: Option<String>,
    /// Your variant [default: variant.toml beside the submission]
    #[arg(long, value_name = "FILE")]
    pub(crate) variant: Option<PathBuf>,
    /// Print what was written as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
}

/// What was written, for programs.
#[derive(Serialize)]
struct Written<'a> {
    written: &'a Path,
    #[serde(flatten)]
    statement: &'a Statement,
    verdict: Verdict,
    warnings: &'a [Warning],
}

/// Grades, writes the file, prints what is in it.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let student = args.student.as_deref().map(StudentId::new).transpose();
    let student =
        student.map_err(|why| Failure::usage(why, "write the id as the course writes it"))?;
    let meant = working_lab::lab_and_submission(
        (args.lab.as_deref(), args.submission.as_deref()),
        args.variant.as_deref(),
        &args.labs_folder,
        "name the lab, such as `kinemark submit 01-kinematics submission.rhai`",
    )?;
    let (lab, path) = (meant.lab, meant.submission);
    let bytes = submission(&path, meant.is_named)?;
    let Chosen { lab, files, .. } = chosen_variant::choose(&lab, &practice(args), Some(&path))?;
    let default = Lab::load(files.as_ref(), &lab.name)?;
    let variant_of = lab.variant.as_ref().and_then(Variant::student);
    let variant_of = variant_of.and_then(|id| StudentId::new(id).ok());
    let out = out_path(args, &lab.name, variant_of.as_ref());
    refuse_foreign(&out)?;

    let shown = path.file_name().unwrap_or(path.as_os_str());
    let sources = Project::of(&path).map(|project| project.sources());
    let source = SubmissionSource::new(&shown.to_string_lossy(), &bytes);
    let source = source.with_sources(sources.unwrap_or_default());
    let mut workers = WorkerHost::new(Some(progress(lab.tasks.len())));
    let graded = source.grade(&lab, None, &mut workers);
    workers.finish();
    let grade = graded.map_err(|_| Failure::interrupted())?.grade;
    let warnings = BeforeUpload {
        files: files.as_ref(),
        lab: &default,
        variant: lab.variant.as_ref(),
        student: student.as_ref(),
        submission: (&path, &bytes),
        practice: &grade,
    }
    .warnings();
    let handed_in = HandedIn {
        made_with: MadeWith {
            engine: engine_id(),
            lab: lab_version(&default),
        },
        student,
        file: source.submission.name(),
        submission: &bytes,
        sources: &source.sources,
        practice: &grade,
    };
    let hand_in = HandInFile::new(handed_in)
        .and_then(|hand_in| hand_in.write().map(|bytes| (hand_in.statement, bytes)));
    let (statement, bytes) = hand_in.map_err(|error| Failure::diagnostic(FAULT, error))?;
    let help = "free some space, or name another place with --out";
    output::write_file(&out, &bytes, help)?;
    print(args, &out, &statement, grade.verdict, &warnings)?;
    Ok(if grade.verdict.is_decided() {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(FAULT)
    })
}

/// The bytes of the submission, text or not.
fn submission(path: &Path, is_named: bool) -> Result<Vec<u8>, Failure> {
    if let Some(project) = Project::of(path) {
        if !is_named {
            project.refuse_several()?;
        }
        let module = project.module(path)?;
        let module = module.map_err(|none| Failure::usage(none.what, &none.help))?;
        project.warn_if_stale(&module);
        return Ok(module.bytes);
    }
    disk::refuse_toml(path)?;
    let bytes = typed_path::bytes(path, "a submission", MOST_SUBMISSION_BYTES)?;
    if is_hand_in(&bytes) {
        return Err(Failure::usage(
            format!("`{}` is a hand-in file already", path.display()),
            "upload it as it is, or name the program, such as submission.rhai",
        ));
    }
    Ok(bytes)
}

/// The lab as a student grades it, wherever this runs.
fn practice(args: &Args) -> LabArgs {
    LabArgs {
        labs_folder: args.labs_folder.clone(),
        variant: VariantArgs {
            variant: args.variant.clone(),
            student: None,
        },
        staff: StaffArgs {
            part: StaffPart::in_folder(None),
            practice: true,
        },
    }
}

fn out_path(args: &Args, lab: &str, variant_of: Option<&StudentId>) -> PathBuf {
    let name = file_name(lab, variant_of);
    match &args.out {
        Some(folder) if folder.is_dir() => folder.join(name),
        Some(file) => file.clone(),
        None => PathBuf::from(name),
    }
}

/// Refuses to replace anything but an earlier hand-in file.
fn refuse_foreign(out: &Path) -> Result<(), Failure> {
    if out.symlink_metadata().is_err() {
        return Ok(());
    }
    let is_ours = disk::bytes_of(out, MOST_HAND_IN_BYTES).is_ok_and(|bytes| is_hand_in(&bytes));
    if is_ours {
        return Ok(());
    }
    Err(Failure::usage(
        format!("`{}` exists and is not a hand-in file", out.display()),
        "name another file with --out",
    ))
}

fn print(
    args: &Args,
    out: &Path,
    statement: &Statement,
    verdict: Verdict,
    warnings: &[Warning],
) -> Result<(), Failure> {
    if args.json {
        return output::print_json(&Written {
            written: out,
            statement,
            verdict,
            warnings,
        });
    }
    for warning in warnings {
        failure::warn_in_words(&warning.message, &warning.help);
    }
    output::print_lines(&text(out, statement))
}

/// What is in the file, and what to do with it.
fn text(out: &Path, statement: &Statement) -> String {
    let id = |id: &Option<StudentId>| {
        let id = id.as_ref()?;
        Some(visible(id.as_str()).into_owned())
    };
    let mut rows = vec![
        (
            "lab",
            format!("{} (digest {})", statement.lab, &statement.lab_digest[..12]),
        ),
        ("submission", visible(&statement.file).into_owned()),
        (
            "practice",
            format!(
                "{} of {} points: visible cases only",
                points(statement.points),
                points(statement.max_points)
            ),
        ),
    ];
    if statement.file.ends_with(".wasm") {
        let count = match statement.sources.len() {
            0 => "none beside this module: course staff cannot read it".to_owned(),
            1 => "1 file".to_owned(),
            count => format!("{count} files"),
        };
        rows.push(("sources", count));
    }
    rows.extend(id(&statement.student).map(|id| ("student", id)));
    rows.extend(id(&statement.variant_of).map(|id| ("variant", format!("of {id}"))));
    rows.push(("made with", statement.engine.clone()));
    let mut text = format!("wrote {}\n", output::path(out));
    for (name, value) in rows {
        text += &format!("  {name:<10}  {value}\n");
    }
    text + "\nUpload this one file, as it is, where your course collects hand-ins. The course grades it again, with hidden cases.\n\
        After a change to the submission, run this command again.\n"
}
