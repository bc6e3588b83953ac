//! `kinemark course status`: how far each lab is, and what needs a person, with what to write into fixes.toml.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::process::ExitCode;

use kinemark_course::fixes::FIXES_FILE;
use kinemark_course::question::Question;
use kinemark_course::staffed_lab::engine_id;
use kinemark_course::standing::{Standing, Status, Summary};
use kinemark_report::visible::visible;
use owo_colors::OwoColorize as _;
use serde::Serialize;

use crate::course_folder::{Course, CourseArgs, book_failure, index_failure};
use crate::failure::Failure;
use crate::lab_counts::lab_counts;
use crate::operator::operator;
use crate::output;

/// Show how far each lab is graded, and what needs a person
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark course status\n  kinemark course status 01-kinematics --json\n\n\
    Whatever needs a person is listed with the tables to choose from for fixes.toml. `kinemark course grade LAB` reads it then.\n\
    Exit codes: 0 done, 2 usage, 3 a file of the course cannot be read, 4 the book cannot be read."
)]
pub(crate) struct Args {
    /// A lab of the course; all of them where none is named
    pub(crate) lab: Option<String>,
    #[command(flatten)]
    pub(crate) course: CourseArgs,
    /// Print it as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// How far one lab is.
#[derive(Debug, Serialize)]
struct LabStatus {
    lab: String,
    /// Students by status.
    counts: BTreeMap<&'static str, usize>,
    /// Grades that were made with another lab, staff part or engine than those of today.
    out_of_date: usize,
    /// Points by hand that were decided on another record.
    stale_fixes: usize,
    questions: Vec<Question>,
    standings: Vec<Standing>,
}

/// Reads everything and prints.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let course = Course::open(&args.course)?;
    let labs = match &args.lab {
        Some(lab) => vec![course.rules(lab)?.clone()],
        None => course.file.labs.clone(),
    };
    let history = course.history()?;
    let mut index = course.index(&history)?;
    let questions = course.book.questions().map_err(book_failure)?;
    let mut all = Vec::new();
    for rules in &labs {
        let of_lab: Vec<Question> = questions
            .iter()
            .filter(|question| question.lab == rules.name)
            .cloned()
            .collect();
        let open: Vec<_> = of_lab
            .iter()
            .filter_map(|question| question.student.clone())
            .collect();
        let standings = course.standings(rules, &history, &index, &open)?;
        let lab = course.lab(rules)?;
        let summaries = index.summaries(&rules.name).map_err(index_failure)?;
        let is_of_today = |summary: &Summary| {
            summary.engine == engine_id()
                && summary.lab_version == lab.lab_version
                && summary.staff_version == lab.staff_version
        };
        let old = |standing: &&Standing| {
            let record = standing
                .record
                .as_ref()
                .and_then(|record| summaries.get(record));
            record.is_some_and(|summary| !is_of_today(summary))
        };
        let mut counts = BTreeMap::new();
        for standing in &standings {
            *counts.entry(standing.status.words()).or_default() += 1;
        }
        all.push(LabStatus {
            lab: rules.name.clone(),
            counts,
            out_of_date: standings.iter().filter(old).count(),
            stale_fixes: standings
                .iter()
                .filter(|standing| standing.by_hand.iter().any(|fix| fix.is_stale))
                .count(),
            questions: of_lab,
            standings,
        });
    }
    if args.lab.is_none() {
        let standings: Vec<Standing> = all.iter().flat_map(|lab| lab.standings.clone()).collect();
        index.put_standings(&standings).map_err(index_failure)?;
    }
    if args.json {
        output::print_list("labs", &all)?;
    } else {
        output::print(&text(&course, &all))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn text(course: &Course, all: &[LabStatus]) -> String {
    let mut out = format!("{}\n", course.file.title.bold());
    for lab in all {
        let _ = writeln!(out, "\n{}  {}", lab.lab.bold(), counts(lab));
        let failed = [Status::HostLimit, Status::GraderFault];
        for standing in lab
            .standings
            .iter()
            .filter(|standing| failed.contains(&standing.status))
        {
            let what = standing.failure.as_deref().unwrap_or_default();
            let _ = writeln!(out, "  {}: {}", standing.student, visible(what));
        }
        for (number, question) in lab.questions.iter().enumerate() {
            push_question(&mut out, number + 1, question);
        }
    }
    let questions: usize = all.iter().map(|lab| lab.questions.len()).sum();
    if questions > 0 {
        let _ = writeln!(
            out,
            "\n{} choose one of the tables of each into {FIXES_FILE}, write why, then `kinemark course grade LAB`",
            "next:".cyan()
        );
    }
    out
}

/// The counts of a lab in a line: `287 graded, 9 missing, 4 need you`.
fn counts(lab: &LabStatus) -> String {
    let mut parts = lab_counts(&lab.standings, &lab.questions);
    if lab.out_of_date > 0 {
        parts.push(format!("{} of an earlier lab or engine", lab.out_of_date));
    }
    if lab.stale_fixes > 0 {
        parts.push(format!("{} with stale points by hand", lab.stale_fixes));
    }
    parts.join(", ")
}

fn push_question(out: &mut String, number: usize, question: &Question) {
    let _ = writeln!(
        out,
        "\n  {number}. {}\n     {}\n     {}",
        visible(&question.path),
        visible(&question.problem),
        visible(&question.help)
    );
    for table in question.fixes(&operator()) {
        out.push('\n');
        for line in table.lines() {
            let _ = writeln!(out, "       {}", visible(line));
        }
    }
}
