//! `kinemark verify`: a report's submission graded again, and every digest compared.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use kinemark_grader::judge::reference_run;
use kinemark_grader::lab::Lab;
use kinemark_grader::lab::variant::VARIANT_FILE;
use kinemark_grader::record::grade::{CheckGrade, Grade, GradeMode, Outcome, TaskGrade, TaskKind};
use kinemark_grader::record::graded::GradedRun;
use kinemark_grader::record::quantity::points;
use kinemark_grader::record::sums::{self, Contradiction};
use kinemark_report::output::{Manifest, Pixels, digest};
use kinemark_report::visible::visible;
use serde::Serialize;
use serde_json::Value;

use crate::chosen_variant;
use crate::failure::{Failure, LOST};
use crate::labs_folder::{self, LabsFolderArgs};
use crate::report_folder::Report;
use crate::staff_folder::{self, StaffArgs};
use crate::worker::WorkerHost;
use crate::{disk, interrupt, output, report_folder};

/// Grade a report's submission again and compare every digest
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  kinemark verify out\n\n\
    Uses the copies of lab, robot and submission inside the folder.\n\
    Without the course staff's part, what is hidden is not graded again; sums and verdicts of the record are checked all the same.\n\
    Exit codes: 0 same bits, 1 something differs, 2 usage, 3 the folder is not a report, 4 the grader or this machine failed.")]
pub(crate) struct Args {
    /// The output folder of `kinemark grade`
    #[arg(default_value = "out")]
    pub(crate) folder: PathBuf,
    /// Print the comparison as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
    #[command(flatten)]
    pub(crate) staff: StaffArgs,
}

/// The beginning of what names a place in the record.
const RECORD: &str = "record at ";

/// In place of the digest of a file that is not there.
const MISSING: &str = "missing";

/// What the comparison found.
#[derive(Serialize)]
struct Comparison {
    same: bool,
    differences: Vec<Difference>,
    not_compared: Vec<String>,
}

/// One thing that is not as recorded.
#[derive(Serialize)]
struct Difference {
    what: String,
    task: Option<String>,
    /// The first simulated second that differs.
    second: Option<usize>,
    /// The first signal of that second that differs.
    signal: Option<&'static str>,
    recorded: String,
    now: String,
}

impl Difference {
    /// One that has no moment.
    fn of(what: &str, recorded: String, now: String) -> Self {
        Self {
            what: what.to_owned(),
            task: None,
            second: None,
            signal: None,
            recorded,
            now,
        }
    }
}

/// Grades again and compares.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let report = report_folder::read(&args.folder)?;
    let (lab, copies) = report_folder::lab_of(&report)?;
    let staff = match report.grade.mode {
        GradeMode::Practice => None,
        GradeMode::Graded => {
            let (_, labs_folder) = labs_folder::open(&args.labs_folder)?;
            match staff_folder::open(&args.staff, labs_folder.as_deref())? {
                Some(reference) => {
                    chosen_variant::refuse_forged(
                        &lab,
                        &copies,
                        &reference,
                        &args.staff.part,
                        VARIANT_FILE,
                    )?;
                    staff_folder::staff(&reference, &lab, args.staff.part.salt.as_deref())?
                }
                None => None,
            }
        }
    };
    let mut host = WorkerHost::new(None);
    let graded = report.submission.grade(&lab, staff.as_ref(), &mut host);
    let mut graded = graded.map_err(|_| Failure::interrupted())?;
    if let Some(staff) = staff
        .as_ref()
        .filter(|_| report.manifest.request.reference_overlay)
    {
        reference_run::show_reference(&lab, staff, &mut graded);
    }
    let mut comparison = compare(&report.grade, &graded.grade)?;
    if comparison.differences.is_empty() && comparison.not_compared.is_empty() {
        let differences = file_differences(&args.folder, &report, &lab, &graded)?;
        comparison.differences.extend(differences);
        comparison.same = comparison.differences.is_empty();
    }
    if args.json {
        output::print_json(&comparison)?;
    } else {
        output::print(&text(&comparison, &report.grade))?;
    }
    Ok(if comparison.same {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(LOST)
    })
}

/// The parts that a grade follows from and that are others now.
fn changed_parts(recorded: &Grade, now: &Grade) -> Vec<Difference> {
    let mut parts = vec![
        ("engine", &recorded.engine, &now.engine),
        ("lab", &recorded.lab.digest, &now.lab.digest),
        ("robot", &recorded.robot.digest, &now.robot.digest),
        (
            "submission",
            &recorded.submission.digest,
            &now.submission.digest,
        ),
    ];
    if let (Some(before), Some(after)) = (&recorded.reference, &now.reference) {
        parts.push(("reference", &before.digest, &after.digest));
    }
    let changed = parts
        .into_iter()
        .filter(|(_, before, after)| before != after);
    changed
        .map(|(what, before, after)| Difference::of(what, before.clone(), after.clone()))
        .collect()
}

fn compare(recorded: &Grade, now: &Grade) -> Result<Comparison, Failure> {
    let mut differences = changed_parts(recorded, now);
    let mut not_compared = Vec::new();
    let hidden_too = recorded.mode == now.mode;
    for before in &recorded.tasks {
        let Some(after) = now.tasks.iter().find(|task| task.name == before.name) else {
            continue;
        };
        if before.kind == TaskKind::Function && !hidden_too {
            not_compared.push(format!(
                "task `{}`: its hidden cases need the course staff's part; give --reference DIR",
                before.name
            ));
            continue;
        }
        if !before.hidden.is_empty() && !hidden_too {
            not_compared.push(format!(
                "task `{}`: its hidden runs need the course staff's part; give --reference DIR",
                before.name
            ));
            continue;
        }
        differences.extend(task_difference(before, after));
    }
    // points, evidence and words too, where everything took part again
    if differences.is_empty() && hidden_too {
        let value = |grade: &Grade| {
            serde_json::to_value(grade).map_err(|error| {
                Failure::fault(
                    format!("a record is no JSON: {error}"),
                    "please report this",
                )
            })
        };
        if let Some((path, recorded, now)) = first_difference(&value(recorded)?, &value(now)?) {
            differences.push(Difference::of(&format!("{RECORD}`{path}`"), recorded, now));
        }
    }
    if differences.is_empty() {
        let contradictions = sums::contradictions(recorded).into_iter();
        let visible = visible_differences(recorded, now).into_iter();
        differences.extend(contradictions.chain(visible).map(|found| {
            let place = format!("{RECORD}`{}`", found.place);
            Difference::of(&place, found.recorded, found.follows)
        }));
    }
    Ok(Comparison {
        same: differences.is_empty(),
        differences,
        not_compared,
    })
}

/// Points that are not as recorded, of checks that nothing hidden and no reference takes part in.
fn visible_differences(recorded: &Grade, now: &Grade) -> Vec<Contradiction> {
    let mut differences = Vec::new();
    for (i, before) in recorded.tasks.iter().enumerate() {
        let has_hidden = before.kind == TaskKind::Function || !before.hidden.is_empty();
        let after = now.tasks.iter().find(|task| task.name == before.name);
        let Some(after) = after.filter(|_| !has_hidden) else {
            continue;
        };
        for (j, (before, after)) in before.checks.iter().zip(&after.checks).enumerate() {
            let reference = |check: &CheckGrade| {
                check.outcome == Outcome::AtHandIn
                    || check
                        .measure
                        .as_ref()
                        .is_some_and(|measure| measure.reference.is_some())
            };
            let [recorded, follows] = [before, after].map(|check| points(check.points));
            if recorded != follows && !reference(before) && !reference(after) {
                differences.push(Contradiction {
                    place: format!("tasks[{i}].checks[{j}].points"),
                    recorded,
                    follows,
                });
            }
        }
    }
    differences
}

/// Where two records first differ, as a path such as `tasks[3].points`, with both values.
fn first_difference(recorded: &Value, now: &Value) -> Option<(String, String, String)> {
    let below = |key: String, found: Option<(String, String, String)>| {
        found.map(|(path, recorded, now)| {
            let dot = if path.is_empty() || path.starts_with('[') {
                ""
            } else {
                "."
            };
            (format!("{key}{dot}{path}"), recorded, now)
        })
    };
    match (recorded, now) {
        (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => a
            .iter()
            .zip(b.values())
            .find_map(|((key, a), b)| below(key.clone(), first_difference(a, b))),
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => a
            .iter()
            .zip(b)
            .enumerate()
            .find_map(|(i, (a, b))| below(format!("[{i}]"), first_difference(a, b))),
        (a, b) if a == b => None,
        (a, b) => Some((String::new(), a.to_string(), b.to_string())),
    }
}

fn task_difference(before: &TaskGrade, after: &TaskGrade) -> Option<Difference> {
    if before.digests == after.digests {
        return None;
    }
    let mut difference = Difference {
        what: match before.kind {
            TaskKind::Function => "answers".to_owned(),
            TaskKind::Motion => "trace".to_owned(),
        },
        task: Some(before.name.clone()),
        second: None,
        signal: None,
        recorded: before.digests.all.clone(),
        now: after.digests.all.clone(),
    };
    let seconds = before.digests.seconds.iter().zip(&after.digests.seconds);
    for (second, (old, new)) in seconds.enumerate() {
        // a signal that is not there has no digest
        let some = |digest: &Option<String>| digest.clone().unwrap_or_default();
        let signals = [
            ("q", &old.q, &new.q),
            ("qd", &old.qd, &new.qd),
            ("command", &old.command, &new.command),
            ("effort", &old.effort, &new.effort),
            ("tcp", &old.tcp, &new.tcp),
            ("bodies", &some(&old.bodies), &some(&new.bodies)),
            ("sensors", &some(&old.sensors), &some(&new.sensors)),
        ];
        if let Some((signal, old, new)) = signals.into_iter().find(|(_, old, new)| old != new) {
            difference.second = Some(second);
            difference.signal = Some(signal);
            difference.recorded.clone_from(old);
            difference.now.clone_from(new);
            break;
        }
    }
    if difference.recorded == difference.now {
        let rungs = before.digests.rungs.iter().zip(&after.digests.rungs);
        if let Some((old, new)) = rungs.into_iter().find(|(old, new)| old != new) {
            difference.what = format!("run of level `{}` of check `{}`", old.rung, old.check);
            difference.recorded.clone_from(&old.digest);
            difference.now.clone_from(&new.digest);
        }
    }
    Some(difference)
}

/// Files of the folder that are not as they are made now. Pictures in pixels are not drawn again, for their bytes may differ between
/// processors: what they show is compared as SVG, and that they are those of the report by the digest in `report.json`.
fn file_differences(
    folder: &Path,
    report: &Report,
    lab: &Lab,
    graded: &GradedRun,
) -> Result<Vec<Difference>, Failure> {
    let recorded = &report.manifest;
    let request = recorded.request;
    let files = report_folder::files(lab, &report.submission, graded, request, Pixels::Undrawn)?;
    let digest_there = |path: &str| {
        let there = disk::bytes_of(&folder.join(path), report_folder::MOST_PAGE_BYTES);
        there.map_or(MISSING.to_owned(), |bytes| digest(&bytes))
    };
    let now = Manifest::of(request, &files);
    let not_listed = || "not listed in report.json".to_owned();
    let mut differences = Vec::new();
    let mut differs = |what: String, recorded: String, now: String| {
        if recorded != now {
            differences.push(Difference {
                what,
                task: None,
                second: None,
                signal: None,
                recorded,
                now,
            });
        }
    };
    for (path, digest) in &now.files {
        differs(format!("file `{path}`"), digest_there(path), digest.clone());
        let listed = recorded.files.get(path).cloned();
        differs(
            format!("digest of `{path}` in `report.json`"),
            listed.unwrap_or_else(not_listed),
            digest.clone(),
        );
    }
    for path in now.pixels.keys() {
        let listed = recorded.pixels.get(path).cloned();
        let listed = listed.unwrap_or_else(not_listed);
        differs(format!("file `{path}`"), digest_there(path), listed);
    }
    for path in recorded.files.keys().chain(recorded.pixels.keys()) {
        if !now.lists(path) {
            let what = format!("list of files in `report.json`: `{}`", visible(path));
            differs(
                what,
                "listed".to_owned(),
                "no file of this report".to_owned(),
            );
        }
    }
    Ok(differences)
}

/// What the differences come to, in a line: a change of what was graded explains all that follows from it.
fn verdict(differences: &[Difference]) -> Option<String> {
    let first = differences.first()?;
    let differs = |part: &str| differences.iter().any(|it| it.what == part);
    let why = if differs("engine") {
        "it was made by another version of kinemark"
    } else if differs("lab") || differs("robot") {
        "the lab was changed after grading"
    } else if differs("submission") {
        "the submission was changed after grading"
    } else if differs("reference") {
        "the course staff's part was changed after grading"
    } else if first.task.is_some() {
        "a task does not go as recorded"
    } else if differences.iter().any(|it| it.what.starts_with(RECORD)) {
        "its grade was changed after grading"
    } else {
        "its files were changed after grading"
    };
    Some(format!("this report does not match: {why}\n"))
}

fn text(comparison: &Comparison, recorded: &Grade) -> String {
    let mut text = verdict(&comparison.differences).unwrap_or_default();
    for difference in &comparison.differences {
        let mut place = difference.what.clone();
        if let Some(task) = &difference.task {
            place = format!("{place} of task `{task}`");
        }
        if let (Some(second), Some(signal)) = (difference.second, difference.signal) {
            place = format!("{place}, first in second {second}, signal `{signal}`");
        }
        let recorded = match difference.recorded.as_str() {
            MISSING => "in the folder: missing".to_owned(),
            there => format!("recorded {there}"),
        };
        text += &format!(
            "differs: {place}\n  {recorded}\n  now      {}\n",
            difference.now
        );
    }
    for what in &comparison.not_compared {
        text += &format!("not compared: {what}\n");
    }
    if comparison.same {
        let all = recorded.tasks.len();
        text += &format!(
            "same bits: {} of {all} tasks compared, {}, {}\n",
            all - comparison.not_compared.len(),
            recorded.lab.name,
            recorded.submission.name
        );
    }
    text
}
