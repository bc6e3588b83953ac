//! `kinemark autograder`: what `run_autograder` in the archive for Gradescope calls, once an upload. Not for people.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use kinemark_course::gradescope_results::{FAILED, GradescopeResults, Upload};
use kinemark_course::layout::PersonFiles;
use kinemark_course::pack::{ROSTER_FILE, SALT_FILE};
use kinemark_course::roster::{Person, Roster};
use kinemark_course::staffed_lab::{StaffedLab, StudentLab, engine_id};
use kinemark_course::student::{StudentId, folded};
use kinemark_course::submission_file::submission_of;
use kinemark_course::submission_source::SubmissionSource;
use kinemark_course::tree::{Limits, Tree};
use kinemark_course::working_folder::STARTER_FILE;
use kinemark_grader::judge;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::grade::Grade;
use kinemark_grader::task::files::Files as _;
use kinemark_report::visible::visible;
use serde::Deserialize;

use crate::disk::{self, Folder};
use crate::error_record::ErrorCode;
use crate::failure::{BROKEN, Failure, LOST};
use crate::sandbox::SandboxArgs;
use crate::worker::WorkerHost;
use crate::{interrupt, output};

/// Grade one upload to Gradescope
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The lab
    pub(crate) lab: String,
    /// The unpacked archive, with `labs` and `reference`
    #[arg(long, value_name = "DIR")]
    pub(crate) source: PathBuf,
    /// Grade the starter and write nothing: is everything there?
    #[arg(long)]
    pub(crate) check: bool,
    /// The folder with what was uploaded
    #[arg(long, value_name = "DIR", required_unless_present = "check")]
    pub(crate) submission: Option<PathBuf>,
    /// What Gradescope knows of the upload
    #[arg(long, value_name = "FILE")]
    pub(crate) metadata: Option<PathBuf>,
    /// The file to write
    #[arg(long, value_name = "FILE", required_unless_present = "check")]
    pub(crate) results: Option<PathBuf>,
    /// Show the points of hidden cases at once
    #[arg(long)]
    pub(crate) hidden_at_upload: bool,
    #[command(flatten)]
    pub(crate) sandbox: SandboxArgs,
}

/// What somebody reads who is not in the roster.
const UNKNOWN: &str = "Nothing was graded: you are not on your course's list of students. Write to your course staff; after they have \
    added you, they run the autograder again.";

/// A roster or a salt is smaller.
const MOST_BYTES: u64 = 16 << 20;
/// Metadata holds the results of earlier uploads.
const MOST_METADATA_BYTES: u64 = 64 << 20;

/// Why an upload has no points.
enum NotGraded {
    /// Something that the student can see and change.
    Upload(String),
    /// Something for course staff that no other upload changes, and what the student reads.
    Setup(&'static str, Failure),
    /// The grader or its machine failed.
    Failed(Failure),
}

impl From<Failure> for NotGraded {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}

/// What was uploaded, with what is to be said about it.
struct Uploaded {
    source: SubmissionSource,
    /// Whose variant a hand-in file names.
    variant_of: Option<StudentId>,
    notes: Vec<String>,
}

/// Grades an upload and writes the results, whatever happens; or checks that it could.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    interrupt::listen();
    args.sandbox.demand()?;
    let (Some(submission), Some(results)) = (&args.submission, &args.results) else {
        return check(args);
    };
    let (content, ended) = match upload(args, submission) {
        Ok(content) => (content, Ok(ExitCode::SUCCESS)),
        Err(NotGraded::Upload(why)) => {
            let printed = output::print(&format!("not graded: {why}\n"));
            let ended = printed.map(|()| ExitCode::from(LOST));
            (GradescopeResults::none(&why), ended)
        }
        Err(NotGraded::Setup(why, failure)) => (GradescopeResults::none(why), Err(failure)),
        Err(NotGraded::Failed(failure)) => (GradescopeResults::none(FAILED), Err(failure)),
    };
    let json = output::json(&content)?;
    output::write_file(results, json.as_bytes(), "check the folder `results`")?;
    ended
}

/// Grades the starter with everything that an upload needs.
fn check(args: &Args) -> Result<ExitCode, Failure> {
    let (lab, _) = staffed(args)?;
    let labs = Folder::new(args.source.join("labs"));
    let starter = labs.bytes(&format!("{}/{STARTER_FILE}", args.lab));
    let starter = starter.ok().flatten().ok_or_else(|| {
        Failure::broken(
            format!("lab `{}` has no {STARTER_FILE}", args.lab),
            "pack the lab again with `kinemark lab pack`",
        )
    })?;
    let starter = SubmissionSource::new(STARTER_FILE, &starter);
    let grade = graded(&starter, &lab.lab, None)?;
    if !grade.verdict.is_decided() {
        return Err(Failure::fault(
            format!(
                "the starter could not be graded here: {}",
                grade.verdict.name()
            ),
            "give the autograder more memory and processor time in the assignment's settings",
        )
        .coded(ErrorCode::Undecided));
    }
    output::print(&format!("ready to grade {}\n", args.lab))?;
    Ok(ExitCode::SUCCESS)
}

/// The lab with the course staff's part, and who takes the course if each student has their own variant.
fn staffed(args: &Args) -> Result<(StaffedLab, Option<Roster>), Failure> {
    let source = |name: &str| args.source.join(name);
    let there = |name: &str| {
        let path = source(name);
        path.is_file()
            .then(|| disk::read_bytes(&path, "a file of the autograder", MOST_BYTES))
            .transpose()
    };
    let salt = there(SALT_FILE)?.map(|salt| String::from_utf8_lossy(&salt).trim().to_owned());
    let roster = there(ROSTER_FILE)?
        .map(|bytes| Roster::parse(ROSTER_FILE, &bytes))
        .transpose()
        .map_err(|error| Failure::diagnostic(BROKEN, error))?;
    let (labs, reference) = (
        Folder::new(source("labs")),
        Folder::new(source("reference")),
    );
    let lab = StaffedLab::load(
        &labs,
        Some(&reference),
        &args.lab,
        salt.as_deref(),
        roster.is_some(),
    )?;
    if !lab.has_staff() {
        return Err(Failure::broken(
            format!("there is no solution of lab `{}`", args.lab),
            "pack the lab again with `kinemark lab pack`",
        ));
    }
    Ok((lab, roster))
}

/// The results of an upload.
fn upload(args: &Args, submission: &Path) -> Result<GradescopeResults, NotGraded> {
    let (lab, roster) = staffed(args)?;
    let uploaded = uploaded(submission, &lab)?;
    let mut uploaded = uploaded;
    let student = match (&roster, &uploaded.variant_of) {
        (Some(roster), variant_of) => Some(student(args, roster, variant_of.as_ref())?),
        (None, Some(_)) if !lab.lab.variants.is_empty() => {
            let note = "You worked with numbers of your own, and this assignment grades everybody with the same ones.";
            uploaded.notes.push(note.to_owned());
            None
        }
        (None, _) => None,
    };
    // without variants every id has the same lab
    let anybody =
        StudentId::new("anybody").map_err(|why| Failure::fault(why, "please report this"))?;
    let of_student = lab
        .for_student(student.as_ref().unwrap_or(&anybody))
        .map_err(Failure::from)?;
    let practice = graded(&uploaded.source, &with_own_practice(&of_student)?, None)?;
    let full = graded(&uploaded.source, of_student.lab(), of_student.staff())?;
    for grade in [&practice, &full] {
        if !grade.verdict.is_decided() {
            let mut stops = grade.tasks.iter().filter_map(|task| task.stopped.as_ref());
            let what = stops.next().map(|stop| stop.message.as_str());
            let what = format!("{}: {}", grade.verdict.name(), what.unwrap_or_default());
            return Err(NotGraded::Failed(Failure::fault(
                what,
                "run the autograder again; if it stays, give it more memory and processor time in the assignment's settings",
            ).coded(ErrorCode::Undecided)));
        }
    }
    Ok(GradescopeResults::of(Upload {
        practice: &practice,
        graded: &full,
        hidden_at_upload: args.hidden_at_upload,
        notes: &uploaded.notes,
    }))
}

/// The lab of a student with what the reference solution reaches in it: at the upload they see points of checks that compare with it.
fn with_own_practice(of_student: &StudentLab<'_>) -> Result<Lab, Failure> {
    let mut lab = of_student.lab().clone();
    if let Some(staff) = of_student.staff() {
        lab.practice = judge::practice(&lab, staff)
            .map_err(|why| Failure::broken(why.to_string(), "correct `solution.rhai`"))?;
    }
    Ok(lab)
}

/// A grade; what this machine failed at is tried once more.
fn graded(source: &SubmissionSource, lab: &Lab, staff: Option<&Staff>) -> Result<Grade, Failure> {
    let once = || {
        let graded = source.grade(lab, staff, &mut WorkerHost::new(None));
        graded.map_err(|_| Failure::interrupted())
    };
    let first = once()?.grade;
    if first.verdict.is_decided() {
        return Ok(first);
    }
    Ok(once()?.grade)
}

/// Finds the submission in the folder of an upload; links are never followed, for they may lead to the solution.
fn uploaded(folder: &Path, lab: &StaffedLab) -> Result<Uploaded, NotGraded> {
    let refused = |what: &str| {
        let what = visible(what);
        NotGraded::Upload(format!(
            "Nothing was graded: {what}. Upload the one file that `kinemark submit` writes."
        ))
    };
    let tree = Tree::open(folder, &Limits::default());
    let tree = tree.map_err(|error| refused(&error.what))?;
    let file = submission_of(&tree, &PersonFiles::of_all(&tree), &lab.lab.name);
    let file = file.map_err(|unclear| refused(&unclear.what))?;
    let mut notes = Vec::new();
    if let Some(made_with) = &file.made_with {
        if made_with.lab != lab.lab_version {
            notes.push(
                "Your lab is another version than the course's, so the points at home may be others: get the lab again."
                    .to_owned(),
            );
        }
        if made_with.engine != engine_id() {
            notes.push(format!(
                "You grade with {}, and the course with {}: points may differ.",
                made_with.engine,
                engine_id()
            ));
        }
    }
    Ok(Uploaded {
        source: SubmissionSource::new(&file.name, &file.bytes).with_sources(file.sources),
        variant_of: file.variant_of,
        notes,
    })
}

/// Who uploaded it, by what Gradescope knows of them. Of a group, whoever's variant the hand-in file names, else the first.
fn student(
    args: &Args,
    roster: &Roster,
    variant_of: Option<&StudentId>,
) -> Result<StudentId, NotGraded> {
    let metadata = metadata(args)?;
    let people: Vec<&Person> = metadata
        .users
        .iter()
        .filter_map(|user| roster.people().iter().find(|person| user.is(person)))
        .collect();
    let is_owner =
        |person: &&&Person| variant_of.is_some_and(|id| id.folded() == person.id.folded());
    let named = people.iter().find(is_owner);
    if named.is_none() && !people.is_empty() && variant_of.is_some() {
        return Err(NotGraded::Upload(
            "Nothing was graded: the file was made with the variant of somebody else. Put your own variant.toml beside your \
             submission, run `kinemark submit` again, and upload the file that it writes."
                .to_owned(),
        ));
    }
    let person = named.or(people.first());
    person.map(|person| person.id.clone()).ok_or_else(|| {
        let who: Vec<&str> = metadata.users.iter().map(|user| user.email.as_str()).collect();
        NotGraded::Setup(UNKNOWN, Failure::broken(
            format!("{} is not in the roster of the autograder", visible(&who.join(", "))),
            "write the e-mail address of Gradescope into roster.csv, pack the lab again and upload the autograder anew",
        ))
    })
}

/// What Gradescope knows of an upload; of all else in the file nothing is needed.
#[derive(Deserialize)]
struct Metadata {
    #[serde(default)]
    users: Vec<User>,
}

/// Somebody who uploaded it.
#[derive(Deserialize)]
struct User {
    #[serde(default)]
    email: String,
    #[serde(default)]
    sid: Option<String>,
}

impl User {
    fn is(&self, person: &Person) -> bool {
        let same = |one: &str, other: &str| !one.is_empty() && folded(one) == folded(other);
        let sid = self.sid.as_deref().unwrap_or_default();
        same(&self.email, &person.email)
            || same(sid, person.id.as_str())
            || same(sid, &person.lms_id)
            || same(sid, &person.username)
    }
}

fn metadata(args: &Args) -> Result<Metadata, Failure> {
    let unread = |why: String| {
        Failure::broken(
            format!("the metadata of the upload cannot be read: {why}"),
            "run the autograder again",
        )
    };
    let path = args.metadata.as_deref();
    let path = path.ok_or_else(|| unread("no file was given".to_owned()))?;
    let bytes = disk::bytes_of(path, MOST_METADATA_BYTES).map_err(unread)?;
    serde_json::from_slice(&bytes).map_err(|error| unread(error.to_string()))
}
