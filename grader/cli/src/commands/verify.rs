//! `kinemark verify`: a report's submission graded again in the course's lab, and everything in the report compared.

use std::path::PathBuf;
use std::process::ExitCode;

use crate::failure::{Failure, LOST, PARTLY_COMPARED};
use crate::labs_folder::LabsFolderArgs;
use crate::sandbox::SandboxArgs;
use crate::staff_folder::{STAFF, StaffArgs};
use crate::verification::{Course, Outcome, Verification, Wanted};
use crate::{interrupt, output, report_folder};

/// Grade a report's submission again in the course's lab, and compare everything in the report
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark verify out\n  kinemark verify handed-in/out --labs labs --reference reference --graded\n\n\
    Lab, robot, scenes and variant are compared with the course's: those of --labs, else of the course.toml or the labs folder here or \
    above, else those built in. The own copies of a report prove nothing about them. \
    Without the course staff's part, what is hidden is not graded again; what is visible, sums, verdicts and files are compared all the \
    same, and what could not be compared is named. A link in a report is never followed.\n\
    Exit codes: 0 everything was compared and is the same, 1 something differs, 2 usage, 3 the folder is not a report or the lab is \
    broken, 4 the grader or this machine failed, 5 the same as far as it could be compared."
)]
pub(crate) struct Args {
    /// The output folder of `kinemark grade`
    #[arg(default_value = "out")]
    pub(crate) folder: PathBuf,
    /// Print the comparison as JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Refuse a practice report: for course staff
    #[arg(long, conflicts_with = "practice", help_heading = STAFF)]
    pub(crate) graded: bool,
    /// Compare the variant with that of this student, whoever the report says it is: for course staff
    #[arg(
        long,
        value_name = "ID",
        conflicts_with = "practice",
        help_heading = STAFF
    )]
    pub(crate) student: Option<String>,
    #[command(flatten)]
    pub(crate) sandbox: SandboxArgs,
    #[command(flatten)]
    pub(crate) labs_folder: LabsFolderArgs,
    #[command(flatten)]
    pub(crate) staff: StaffArgs,
}

/// Grades again and compares.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    interrupt::listen();
    args.sandbox.demand()?;
    let report = report_folder::read(&args.folder)?;
    let wanted = Wanted {
        graded: args.graded,
        student: args.student.as_deref(),
    };
    let course = Course::find(&report, &args.labs_folder, &args.staff, wanted)?;
    let verification = Verification::of(&report, &course, wanted)?;
    if args.json {
        output::print_formatted(&verification.summary(&report.grade, &course))?;
    } else {
        output::print_lines(&verification.text(&report.grade, &course))?;
    }
    Ok(match verification.outcome() {
        Outcome::Same => ExitCode::SUCCESS,
        Outcome::Differs => ExitCode::from(LOST),
        Outcome::PartlyCompared => ExitCode::from(PARTLY_COMPARED),
    })
}
