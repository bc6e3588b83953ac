//! `kinemark course check`: what is wrong with a course before anything is graded in it.

use std::fmt::Write as _;
use std::process::ExitCode;

use kinemark_course::course_file::CourseLab;
use kinemark_course::fixes::{Extension, FIXES_FILE, PointsChange};
use kinemark_course::public::public_part;
use kinemark_course::staffed_lab::{StaffedLab, engine_id};
use kinemark_grader::lab::Task;
use kinemark_sim::text::suggest;
use owo_colors::OwoColorize as _;
use serde::Serialize;

use crate::course_folder::{Course, CourseArgs, book_failure};
use crate::failure::{Failure, LOST};
use crate::output;

/// Check a course: its files, its labs and their digests, its salt
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark course check\n  kinemark course check --course robots-1 --json\n\n\
    Reads course.toml, roster.csv, fixes.toml and every lab; grades nothing. See docs/ta-guide.md.\n\
    Exit codes: 0 nothing is wrong, 1 something is, 2 usage, 3 a file cannot be read."
)]
pub(crate) struct Args {
    #[command(flatten)]
    pub(crate) course: CourseArgs,
    /// Print what was checked as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// One thing that was checked.
#[derive(Debug, Serialize)]
pub(crate) struct Row {
    /// What.
    pub(crate) what: String,
    /// What it is.
    pub(crate) found: String,
    /// What is wrong with it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) problem: Option<String>,
    /// What to do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) help: Option<String>,
}

/// A salt shorter than this can be guessed.
const LEAST_SALT: usize = 12;

/// Checks and prints.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let course = Course::open(&args.course)?;
    let mut rows = vec![roster(&course), engine(&course)];
    rows.extend(salt(&course));
    for rules in &course.file.labs {
        let lab = course.lab(rules)?;
        rows.push(lab_row(&course, rules, &lab));
        rows.extend(
            points_by_hand(&course, rules, &lab)
                .into_iter()
                .map(|(_, row)| row),
        );
        rows.extend(extensions(&course, rules));
    }
    if args.json {
        output::print_list("checks", &rows)?;
    } else {
        output::print(&text(&course, &rows))?;
    }
    let bad = rows.iter().any(|row| row.problem.is_some());
    Ok(ExitCode::from(if bad { LOST } else { 0 }))
}

/// A lab with which the course may grade, its files kept in the book.
///
/// # Errors
/// Exit code 3 where this engine or this lab is not the course's.
pub(crate) fn ready(course: &Course, rules: &CourseLab) -> Result<StaffedLab, Failure> {
    let lab = course.lab(rules)?;
    let rows = [engine(course), lab_row(course, rules, &lab)];
    let fixes = points_by_hand(course, rules, &lab);
    // a check that is no more is noted where its points are: the fix stands there as stale
    let too_many = fixes.into_iter().filter(|(is_too_many, _)| *is_too_many);
    for row in rows.into_iter().chain(too_many.map(|(_, row)| row)) {
        if let Some(problem) = row.problem {
            let help = row.help.unwrap_or_default();
            return Err(Failure::broken(format!("{}: {problem}", row.what), &help));
        }
    }
    let book = &course.book;
    book.put_lab(&lab.lab_files()).map_err(book_failure)?;
    book.put_staff(&lab.staff_files()).map_err(book_failure)?;
    Ok(lab)
}

fn roster(course: &Course) -> Row {
    let people = course.roster.people();
    let mut sections: Vec<&str> = people
        .iter()
        .map(|person| person.section.as_str())
        .collect();
    sections.sort_unstable();
    sections.dedup();
    sections.retain(|section| !section.is_empty());
    let of_sections = match sections.len() {
        0 => String::new(),
        1 => ", 1 section".to_owned(),
        count => format!(", {count} sections"),
    };
    let students = match people.len() {
        1 => "1 student".to_owned(),
        count => format!("{count} students"),
    };
    Row {
        what: "roster".to_owned(),
        found: format!("{students}{of_sections}"),
        problem: None,
        help: None,
    }
}

fn engine(course: &Course) -> Row {
    let own = engine_id();
    let problem = match &course.file.engine {
        Some(engine) if *engine != own => Some(format!("the course grades with {engine}")),
        _ => None,
    };
    let help = problem.is_some().then(|| {
        format!("use that version, or write `engine = \"{own}\"` into course.toml and regrade")
    });
    Row {
        what: "engine".to_owned(),
        found: own,
        problem,
        help,
    }
}

fn salt(course: &Course) -> Option<Row> {
    let salt = course.salt.as_ref()?;
    let is_short = salt.chars().count() < LEAST_SALT;
    Some(Row {
        what: "salt".to_owned(),
        found: "of the course".to_owned(),
        problem: is_short
            .then(|| format!("it has fewer than {LEAST_SALT} characters, so it can be guessed")),
        help: is_short.then(|| {
            "write a longer one before the first hand-out: it also draws the variants".to_owned()
        }),
    })
}

fn lab_row(course: &Course, rules: &CourseLab, lab: &StaffedLab) -> Row {
    let version = &lab.lab_version;
    let solution = lab.staff_files();
    let solution = solution
        .iter()
        .find(|(path, _)| path.ends_with("/solution.rhai"))
        .map_or(&[][..], |(_, bytes)| bytes.as_slice());
    let public = public_part(solution, lab.salt());
    let public = public.filter(|_| !course.file.public_solutions);
    let (problem, help) = match (&rules.digest, public) {
        (_, Some(part)) => (
            Some(format!("its {part} is public, in Kinemark's repository")),
            Some(
                "write a solution and a salt of your own, or allow it with `public_solutions = true` in course.toml"
                    .to_owned(),
            ),
        ),
        (None, None) => (
            Some("course.toml has no digest of it".to_owned()),
            Some(format!("write `digest = \"{version}\"` below `name = \"{}\"`", rules.name)),
        ),
        (Some(digest), None) if digest != version => (
            Some("its files are not those that course.toml names".to_owned()),
            Some(format!(
                "restore them, or accept them with `digest = \"{version}\"` and look at `kinemark course regrade {}`",
                rules.name
            )),
        ),
        (Some(_), None) => (None, None),
    };
    let points: f64 = lab.lab.tasks.iter().map(Task::max_points).sum();
    let variants = if lab.has_variants() {
        ", a variant each"
    } else {
        ""
    };
    Row {
        what: rules.name.clone(),
        found: format!("{points} points{variants}"),
        problem,
        help,
    }
}

/// Extensions that give less time than everybody has.
fn extensions(course: &Course, rules: &CourseLab) -> Vec<Row> {
    let of_lab = course.fixes.extensions.iter();
    let of_lab = of_lab.filter(|more| more.lab == rules.name);
    let earlier = of_lab.filter(|more| rules.due.is_some_and(|due| more.due < due));
    let row = |more: &Extension| Row {
        what: FIXES_FILE.to_owned(),
        found: format!("extension of {} in {}", more.student, rules.name),
        problem: Some(format!(
            "it ends {}, before the lab is due for everybody",
            more.due
        )),
        help: Some("look at the year and the month of `due`".to_owned()),
    };
    earlier.map(row).collect()
}

/// Points by hand that cannot be meant: more than there are (true), or of a check that the lab has not.
fn points_by_hand(course: &Course, rules: &CourseLab, lab: &StaffedLab) -> Vec<(bool, Row)> {
    let mut checks: Vec<(String, f64)> = Vec::new();
    for task in &lab.lab.tasks {
        let of_task = task.checks().into_iter();
        checks.extend(of_task.map(|check| (format!("{}/{}", task.name, check.name), check.points)));
    }
    let all: f64 = lab.lab.tasks.iter().map(Task::max_points).sum();
    let mut rows = Vec::new();
    for fix in course
        .fixes
        .points
        .iter()
        .filter(|fix| fix.lab == rules.name)
    {
        let found = match &fix.check {
            Some(name) => checks.iter().find(|(known, _)| known == name),
            None => None,
        };
        let (is_too_many, problem, help) = match (&fix.check, found, fix.change) {
            (Some(name), None, _) => (
                false,
                format!("the lab has no check `{name}`"),
                suggest(name, "checks", checks.iter().map(|(name, _)| name.as_str())),
            ),
            (_, found, PointsChange::Set(points))
                if points > found.map_or(all, |(_, most)| *most) =>
            {
                (
                    true,
                    format!(
                        "{points} points are more than the {} there are",
                        found.map_or(all, |(_, most)| *most)
                    ),
                    "write fewer, or give extra points with `add`".to_owned(),
                )
            }
            _ => continue,
        };
        let row = Row {
            what: FIXES_FILE.to_owned(),
            found: format!("points of {} in {}", fix.student, rules.name),
            problem: Some(problem),
            help: Some(help),
        };
        rows.push((is_too_many, row));
    }
    rows
}

fn text(course: &Course, rows: &[Row]) -> String {
    let mut out = format!("{}\n\n", course.file.title.bold());
    for row in rows {
        let mark = match row.problem {
            Some(_) => "-".red().to_string(),
            None => "+".green().to_string(),
        };
        let _ = writeln!(out, "{mark} {:<28} {}", row.what, row.found);
        if let Some(problem) = &row.problem {
            let _ = writeln!(out, "    {problem}");
        }
        if let Some(help) = &row.help {
            let _ = writeln!(out, "    {} {help}", "next:".cyan());
        }
    }
    let problems = rows.iter().filter(|row| row.problem.is_some()).count();
    let sum = match problems {
        0 => "nothing is wrong".green().to_string(),
        1 => "1 problem".red().to_string(),
        _ => format!("{problems} problems").red().to_string(),
    };
    let _ = writeln!(out, "\n{sum}");
    out
}
