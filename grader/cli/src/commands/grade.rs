//! `kinemark grade`: one submission, graded and reported.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use kinemark_course::language::MODULE_FILE;
use kinemark_course::submission_source::SubmissionSource;
use kinemark_grader::judge::reference_run;
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::record::grade::{Grade, GradeMode};
use kinemark_grader::record::graded::GradedRun;
use kinemark_grader::record::verdict::Verdict;
use kinemark_grader::submission::host::{Host, InProcess};
use kinemark_grader::submission::not_text::absent;
use kinemark_grader::task::files::Files;

use kinemark_report::html::Earlier;
use kinemark_report::log_request::{Encoding, LogRequest, MOST_SIGNAL_RATE_HZ};
use kinemark_report::output::{PAGE_FILE, RECORD_FILE, ReportRequest, STORYBOARD_FILE};
use kinemark_report::short_text::short_text;
use kinemark_report::storyboard::has_storyboard;
use kinemark_report::text::{Detail, detailed};
use kinemark_report::visible::visible;
use serde::Serialize;

use crate::chosen_variant::{self, LabArgs};
use crate::course_folder::enclosing_root;
use crate::failure::{self, FAULT, Failure, LOST};
use crate::history::History;
use crate::practice_variants::{PracticeVariants, try_variants};
use crate::project::{Built, NoModule, Project};
use crate::sandbox::RunArgs;
use crate::staff_folder::{self, STAFF, StaffArgs};
use crate::worker::WorkerHost;
use crate::{
    handed_out_lab, interrupt, labs_folder, named_submission, output, report_folder, working_lab,
};

/// Grade a submission
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark grade\n  kinemark grade 01-kinematics submission.rhai\n  \
    kinemark grade 01-kinematics submission.rhai --out feedback --json\n  \
    kinemark grade 01-kinematics submission.rhai --png --storyboard\n  \
    kinemark grade 01-kinematics submission.rhai --variants 5\n  \
    kinemark grade --since out --out better\n  \
    kinemark grade -v\n  \
    kinemark grade --format short\n  \
    kinemark grade --build\n  \
    kinemark grade 01-kinematics - < submission.rhai\n\n\
    In a folder of `kinemark new`, kinemark.toml names the lab. In practice a file variant.toml beside the submission is used unless --variant is given.\n\
    With the course staff's part only --variant and --student give a variant, and labs that may have been handed in are refused: docs/ta-guide.md.\n\
    --build runs what the project's author wrote, so it is refused with the course staff's part, and in the folder of a course. A build that \
    fails is graded as `did-not-build`, with the compiler's errors; see docs/plugin.md.\n\
    What is no script is graded as `did-not-build`, with what to do; no link in the path of a submission is followed.\n\
    Writes grade.json, report.html, plots, a log per motion task and a copy of the submission and the lab to the output folder.\n\
    Exit codes: 0 every check full, 1 points lost, 2 usage, 3 the lab is broken, 4 the grader or this machine failed, a compiler \
    is missing, or the grade cannot be printed or written."
)]
pub(crate) struct Args {
    /// The lab, as `kinemark` lists it, or the beginning of its name [default: that of the folder]
    pub(crate) lab: Option<String>,
    /// The submission: a script, a file in Python, a module, or a folder, a ZIP archive or a hand-in file with one in it; `-` reads one of the first three from standard input [default: submission.rhai or submission.py, or the module of the project here]
    pub(crate) submission: Option<PathBuf>,
    /// Build the project of the submission first: runs the compiler, and a build script if the project has one
    #[arg(long)]
    pub(crate) build: bool,
    /// Folder to write to; an earlier report there is replaced [default: `out`; in practice beside the submission, where `kinemark new` has made its folder]
    #[arg(long, short, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print the grade record as JSON
    #[arg(long, conflicts_with_all = ["verbose", "quiet"])]
    pub(crate) json: bool,
    /// What to print: the grade for people, or a line for each thing that went wrong, as editors read it
    #[arg(long, value_enum, default_value = "full", conflicts_with_all = ["json", "verbose", "quiet"])]
    pub(crate) format: Format,
    #[command(flatten)]
    pub(crate) detail: DetailArgs,
    /// Write each plot as a PNG beside the SVG
    #[arg(long)]
    pub(crate) png: bool,
    /// Write a storyboard of each motion task: six moments of the run in one picture, TASK/storyboard.png and .svg
    #[arg(long)]
    pub(crate) storyboard: bool,
    /// How messages that viewers know are written in logs: protobuf, which all of them read, or JSON, for programs of your own
    #[arg(long, value_enum, value_name = "ENCODING", default_value = "protobuf")]
    pub(crate) log: LogEncoding,
    /// Signals a second in logs; there are no more than physics steps [default: 100]
    #[arg(long, value_name = "HZ", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_SIGNAL_RATE_HZ)))]
    pub(crate) log_rate: Option<u32>,
    /// Whose report it is: a name or an id for the page's head and title. Neither the grade nor its digests have it
    #[arg(long, value_name = "TEXT")]
    pub(crate) label: Option<String>,
    /// An earlier report of the same lab: the page shows which checks earn more and which earn less since then
    #[arg(long, value_name = "DIR")]
    pub(crate) since: Option<PathBuf>,
    /// Grade on so many other variants as well, in practice: a number that is typed in shows there
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=20))]
    pub(crate) variants: Option<u32>,
    #[command(flatten)]
    pub(crate) run: RunArgs,
    /// Overlay the reference solution's motion on the run, in the report and its logs: for course staff. Its joint motion is the
    /// answer; do not give such a report to students
    #[arg(long, conflicts_with = "practice", help_heading = STAFF)]
    pub(crate) reference_overlay: bool,
    #[command(flatten)]
    pub(crate) from: LabArgs,
}

/// How much of a grade is printed for people.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(crate) struct DetailArgs {
    /// Print every check in full, and not only the first of each task that lost points
    #[arg(long, short)]
    verbose: bool,
    /// Print only the line of the points
    #[arg(long, short, conflicts_with = "verbose")]
    quiet: bool,
}

impl DetailArgs {
    /// What is asked for.
    pub(crate) fn detail(self) -> Detail {
        match (self.verbose, self.quiet) {
            (true, _) => Detail::Everything,
            (false, true) => Detail::Total,
            (false, false) => Detail::Folded,
        }
    }
}

/// How a grade is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Format {
    /// Lines for people; see --verbose and --quiet.
    Full,
    /// `FILE:LINE:COLUMN: KIND: WORDS`, a line each.
    Short,
}

/// How messages that viewers know are written in logs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum LogEncoding {
    Protobuf,
    Json,
}

/// What was typed, with what was left out filled in.
pub(crate) struct Request<'a> {
    /// The rest of what was typed.
    pub(crate) args: &'a Args,
    /// The lab.
    pub(crate) lab: String,
    /// The submission.
    pub(crate) submission: PathBuf,
    /// Whether its file was named, and not found in a folder.
    is_named: bool,
    /// Whether a project is built before it is graded.
    pub(crate) build: Build,
    /// Folder to write to.
    pub(crate) out: PathBuf,
}

/// When a project is built before it is graded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Build {
    /// Never.
    No,
    /// Wherever it is the work of whoever runs this: in practice.
    InPractice,
    /// Always, or it is an error.
    Asked,
}

impl Request<'_> {
    /// The project that is built before each grade, as far as can be seen before the lab is read.
    ///
    /// # Errors
    /// Exit code 2 for a folder of the course staff's part that is none.
    pub(crate) fn built(&self) -> Result<Option<Project>, Failure> {
        let project = Project::of(&self.submission).filter(Project::can_be_built);
        if self.build == Build::No || project.is_none() || enclosing_root().is_some() {
            return Ok(None);
        }
        let from = &self.args.from;
        let (_, labs) = labs_folder::open(&from.labs_folder)?;
        let reference = staff_folder::open(&from.staff, labs.as_deref())?;
        let is_graded = reference.is_some_and(|part| staff_folder::has_solution(&part, &self.lab));
        Ok(project.filter(|_| !is_graded))
    }
}

impl Args {
    /// Fills in what was left out from the folder of the submission.
    ///
    /// # Errors
    /// Exit code 2 where nothing says which lab is meant.
    pub(crate) fn filled(&self) -> Result<Request<'_>, Failure> {
        let working_lab::Meant {
            lab,
            submission,
            is_named,
        } = working_lab::lab_and_submission(
            (self.lab.as_deref(), self.submission.as_deref()),
            self.from.variant.variant.as_deref(),
            &self.from.labs_folder,
            "name both, such as `kinemark grade 01-kinematics submission.rhai`",
        )?;
        let (files, labs) = labs_folder::open(&self.from.labs_folder)?;
        let out = match &self.out {
            Some(out) => out.clone(),
            // what course staff grade goes where they are, and not into the folder of a student
            None if staff_folder::open(&self.from.staff, labs.as_deref())?.is_some() => {
                PathBuf::from(working_lab::REPORT_FOLDER)
            }
            None => working_lab::report_folder(&submission),
        };
        Ok(Request {
            args: self,
            lab: labs_folder::full_name(files.as_ref(), &lab)?,
            submission,
            is_named,
            build: match self.build {
                true => Build::Asked,
                false => Build::No,
            },
            out,
        })
    }
}

/// A submission, graded.
pub(crate) struct Work {
    lab: Lab,
    submission: SubmissionSource,
    pub(crate) graded: GradedRun,
    /// Which variant is used where the command named none.
    pub(crate) note: Option<String>,
    /// Whose labs are used, in a line.
    pub(crate) labs: Option<String>,
    /// The same submission on other variants, where that was asked for.
    variants: Option<PracticeVariants>,
    /// The earlier report with which this one is compared.
    since: Option<Earlier>,
}

/// A grade with those on other variants.
#[derive(Serialize)]
struct WithVariants<'a> {
    grade: &'a Grade,
    #[serde(flatten)]
    variants: &'a PracticeVariants,
}

/// Grades, writes the folder, prints.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let request = args.filled()?;
    let work = work(&request)?;
    let grade = &work.graded.grade;
    // beside the record, which is the same wherever the labs lie
    let is_quiet = args.detail.detail() == Detail::Total;
    if let Some(labs) = work.labs.as_ref().filter(|_| !is_quiet) {
        failure::note_in_words(labs);
    }
    let is_read = args.format == Format::Full && !args.json;
    if let Some(note) = work.note.as_ref().filter(|_| !is_read) {
        failure::note_in_words(note);
    }
    // neither loses the other: a full disk the grade on the terminal, an output that cannot be written the report
    let printed = print(&request, &work);
    if let Err(unwritten) = write(&request, &work) {
        if let Err(unprinted) = printed {
            unprinted.report_for_people();
        }
        return Err(unwritten);
    }
    let is_practice =
        grade.mode == GradeMode::Practice && !named_submission::is_input(&request.submission);
    let history = is_practice.then(|| History::beside(&request.submission));
    let history = history.flatten();
    let printed = printed.and_then(|()| {
        let known = history.as_ref().map(|(known, _)| known);
        print_what_is_next(&request, &work, known)
    });
    remember(history, grade)?;
    printed?;
    Ok(exit_code(grade.verdict))
}

/// Prints the grade.
fn print(request: &Request<'_>, work: &Work) -> Result<(), Failure> {
    let (args, grade) = (request.args, &work.graded.grade);
    if args.format == Format::Short {
        let file = output::path(&request.submission);
        return output::print(&short_text(grade, &file));
    }
    if args.json {
        return match &work.variants {
            Some(variants) => output::print_formatted(&WithVariants { grade, variants }),
            None => output::print_json(grade),
        };
    }
    let detail = args.detail.detail();
    if let Some(note) = work.note.as_ref().filter(|_| detail != Detail::Total) {
        output::print_lines(&format!("{note}\n"))?;
    }
    output::print_lines(&detailed(grade, detail))?;
    match &work.variants {
        Some(variants) if detail != Detail::Total => output::print_lines(&variants.text(grade)),
        _ => Ok(()),
    }
}

/// Prints what is new since the last grade, and where the report is, for people.
fn print_what_is_next(
    request: &Request<'_>,
    work: &Work,
    history: Option<&History>,
) -> Result<(), Failure> {
    let (args, grade) = (request.args, &work.graded.grade);
    let is_quiet = args.detail.detail() == Detail::Total;
    if args.json || args.format == Format::Short || is_quiet {
        return Ok(());
    }
    let change = history.and_then(|known| known.change(grade));
    output::print_lines(&change.unwrap_or_default())?;
    let beyond = history.and_then(|known| known.beyond(grade));
    output::print_lines(&beyond.unwrap_or_default())?;
    let report = output::path(&request.out.join(PAGE_FILE));
    output::print(&format!("report: {report}\n"))?;
    if let Some(place) = kinemark_report::moment::place_to_look(grade) {
        output::print(&format!("look here first: {report}{place}\n"))?;
    }
    if args.storyboard {
        output::print(&storyboards(&request.out, &work.graded))?;
    }
    Ok(())
}

/// Adds a grade to the history of its folder.
fn remember(history: Option<(History, Option<String>)>, grade: &Grade) -> Result<(), Failure> {
    let Some((mut history, note)) = history else {
        return Ok(());
    };
    if let Some(note) = note {
        failure::note_in_words(&note);
    }
    history.add(grade);
    history.write()
}

/// Writes the folder.
pub(crate) fn write(request: &Request<'_>, work: &Work) -> Result<(), Failure> {
    let args = request.args;
    let drawn = ReportRequest {
        reference_overlay: args.reference_overlay,
        png: args.png,
        storyboard: args.storyboard,
        log: LogRequest {
            encoding: match args.log {
                LogEncoding::Protobuf => Encoding::Protobuf,
                LogEncoding::Json => Encoding::Json,
            },
            rate_hz: args.log_rate,
        },
        label: args.label.clone(),
        since: work.since.clone(),
    };
    report_folder::write(
        &request.out,
        &work.lab,
        &work.submission,
        &work.graded,
        &drawn,
    )
}

/// Reads what was named, and grades.
pub(crate) fn work(request: &Request<'_>) -> Result<Work, Failure> {
    let args = request.args;
    args.run.sandbox.demand()?;
    refuse_pixels_without_png(args)?;
    // nothing lies beside what is read from standard input
    let beside = (!named_submission::is_input(&request.submission)).then_some(&*request.submission);
    let chosen = chosen_variant::choose(&request.lab, &args.from, beside)?;
    let (lab, mut note) = (chosen.lab, chosen.note);
    let default = Lab::load(chosen.files.as_ref(), &lab.name)?;
    for warning in handed_out_lab::warnings(chosen.files.as_ref(), &default, false) {
        failure::warn_in_words(&warning.message, &warning.help);
    }
    let staff = match &chosen.reference {
        Some(reference) => staff_of(reference, &lab, &chosen.staff)?,
        None => None,
    };
    if args.reference_overlay && staff.is_none() {
        return Err(Failure::usage(
            format!(
                "--reference-overlay needs the reference solution of lab `{}`, which was not found",
                lab.name
            ),
            "give the course staff's folder with --reference DIR, or leave --reference-overlay out",
        ));
    }
    if staff.is_some() && lab.variant.is_none() && !lab.variants.is_empty() && note.is_none() {
        note = Some("no variant given: using the default parameters of lab.toml".to_owned());
    }
    report_folder::refuse_foreign(&request.out)?;
    let since = args.since.as_deref();
    let since = since.map(|folder| earlier(folder, &lab.name)).transpose()?;
    let submission = submission(request, &lab, staff.is_some())?;

    let mut in_process = InProcess;
    let mut workers = WorkerHost::new((!args.run.in_process).then(|| progress(lab.tasks.len())));
    let host: &mut dyn Host = if args.run.in_process {
        &mut in_process
    } else {
        &mut workers
    };
    let graded = submission.grade(&lab, staff.as_ref(), host);
    workers.finish();
    // a worker's processor is for workers alone
    drop(workers);
    let mut graded = graded.map_err(|_| Failure::interrupted())?;
    for fault in &graded.staff_faults {
        let what = if graded.grade.verdict.is_decided() {
            "the grade is valid, but a file of the course staff failed, so some feedback is missing"
        } else {
            "nothing is decided in some task, because a file of the course staff failed"
        };
        failure::warn(what, fault.as_ref());
    }
    if let Some(staff) = staff.as_ref().filter(|_| args.reference_overlay) {
        reference_run::show_reference(&lab, staff, &mut graded);
    }
    let variants = match args.variants {
        Some(count) => {
            let files = chosen.files.as_ref();
            let own = &graded.grade;
            Some(try_variants(count, &lab, files, &submission, own)?)
        }
        None => None,
    };
    Ok(Work {
        lab,
        submission,
        graded,
        note,
        labs: chosen.labs,
        variants,
        since,
    })
}

/// What an earlier report of the lab earned.
fn earlier(folder: &Path, lab: &str) -> Result<Earlier, Failure> {
    let shown = output::path(folder);
    if !folder.join(RECORD_FILE).is_file() {
        return Err(Failure::usage(
            format!("`{shown}` is no folder of a report"),
            "name a folder that `kinemark grade` wrote, or leave --since out",
        ));
    }
    let grade = report_folder::record(folder)?;
    if grade.lab.name != lab {
        return Err(Failure::usage(
            format!(
                "`{shown}` is a report of lab `{}`, not of `{lab}`",
                visible(&grade.lab.name)
            ),
            "name an earlier report of the same lab, or leave --since out",
        ));
    }
    let name = folder
        .file_name()
        .map_or(shown.clone(), |name| name.to_string_lossy().into_owned());
    Ok(Earlier::of(&name, &grade))
}

/// The submission, built where that is asked for; a build that fails is a submission that is not there.
fn submission(
    request: &Request<'_>,
    lab: &Lab,
    is_graded: bool,
) -> Result<SubmissionSource, Failure> {
    let project = Project::of(&request.submission);
    let is_of_staff = is_graded || enclosing_root().is_some();
    let built = match (request.build, &project) {
        (Build::No, _) | (Build::InPractice, None) => Built::Yes,
        (Build::InPractice, Some(project)) if is_of_staff || !project.can_be_built() => Built::Yes,
        (Build::Asked, _) if is_of_staff => {
            return Err(Failure::usage(
                "--build runs what the author of the project wrote, and here it could read the course staff's files".to_owned(),
                "grade the module that was handed in; if the project is your own, build it yourself, or use --practice outside of a course",
            ));
        }
        (Build::Asked, None) => {
            return Err(Failure::usage(
                format!(
                    "`{}` is no project that can be built",
                    output::path(&request.submission)
                ),
                "leave --build out; `kinemark new LAB --lang rust` or `--lang c` makes a project",
            ));
        }
        (Build::InPractice | Build::Asked, Some(project)) => project.build()?,
    };
    if let Built::Refused(NoModule { what, help }) = built {
        return Ok(SubmissionSource::new(MODULE_FILE, &absent(&what, &help)));
    }
    if let Some(project) = project.filter(|_| !request.is_named) {
        project.refuse_several()?;
    }
    named_submission::read(&request.submission, &lab.name)
}

/// Refuses pictures in pixels where this build draws none.
fn refuse_pixels_without_png(args: &Args) -> Result<(), Failure> {
    let asked = match (args.png, args.storyboard) {
        _ if cfg!(feature = "png") => None,
        (true, _) => Some("--png"),
        (false, true) => Some("--storyboard"),
        (false, false) => None,
    };
    asked.map_or(Ok(()), |option| {
        Err(Failure::usage(
            format!("{option} needs a build with the feature `png`"),
            &format!("leave {option} out, or build with `--features png`"),
        ))
    })
}

/// Where the storyboards are, a line each.
fn storyboards(out: &Path, graded: &GradedRun) -> String {
    let mut ran = graded
        .runs
        .iter()
        .filter(|run| has_storyboard(run))
        .peekable();
    if ran.peek().is_none() {
        return "storyboard: none, because the arm moves in no task\n".to_owned();
    }
    let lines = ran.map(|run| {
        let path = out.join(&run.task).join(STORYBOARD_FILE);
        format!("storyboard: {}\n", output::path(&path))
    });
    lines.collect()
}

fn staff_of(reference: &dyn Files, lab: &Lab, args: &StaffArgs) -> Result<Option<Staff>, Failure> {
    let staff = staff_folder::staff(reference, lab, args.part.salt())?;
    if staff.is_none() && args.part.reference.is_some() {
        return Err(Failure::usage(
            staff_folder::no_solution(reference, lab),
            "check the folder, or use --practice to grade visible cases only",
        ));
    }
    Ok(staff)
}

/// The tasks of a lab that are done so far.
pub(crate) fn progress(tasks: usize) -> indicatif::ProgressBar {
    let bar = indicatif::ProgressBar::new(tasks as u64);
    if let Ok(style) = indicatif::ProgressStyle::with_template("{pos}/{len} {msg}") {
        bar.set_style(style);
    }
    bar
}

fn exit_code(verdict: Verdict) -> ExitCode {
    match verdict {
        Verdict::Passed => ExitCode::SUCCESS,
        Verdict::GraderFault | Verdict::HostLimit => ExitCode::from(FAULT),
        Verdict::DidNotBuild
        | Verdict::Crashed
        | Verdict::OverBudget
        | Verdict::InvalidOutput
        | Verdict::Missed => ExitCode::from(LOST),
    }
}
