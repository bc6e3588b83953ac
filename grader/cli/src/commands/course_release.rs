//! `kinemark course release`: grades and feedback in the form that the LMS takes.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;

use kinemark_course::book::Record;
use kinemark_course::course_file::CourseLab;
use kinemark_course::course_text::read;
use kinemark_course::journal::Event;
use kinemark_course::release::{Columns, Export, FORMS, Form, Made, Material, Row};
use kinemark_course::standing::Standing;
use owo_colors::OwoColorize as _;

use super::course_check;
use crate::course_folder::{Course, CourseArgs, book_failure};
use crate::course_log::CourseLog;
use crate::failure::{Failure, LOST, USAGE};
use crate::output;

/// Write grades and feedback as the LMS takes them
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark course release 01-kinematics --to moodle --export Grades-Robots-Lab1.csv\n  \
    kinemark course release 01-kinematics --to canvas --export gradebook.csv --column \"Lab 1 (4314282)\"\n  \
    kinemark course release 01-kinematics --to csv\n\n\
    Forms: moodle, canvas, gradescope, csv, feedback, junit, github, jsonl; docs/exports.md describes each. --export is the LMS's own \
    file, which is filled in and otherwise left as it is. Running it twice changes nothing.\n\
    Exit codes: 0 done, 1 done, and something needs a person, 2 usage, 3 the course or the lab is broken, 4 a file cannot be written."
)]
pub(crate) struct Args {
    /// A lab of the course
    pub(crate) lab: String,
    /// The form
    #[arg(long, value_name = "FORM")]
    pub(crate) to: String,
    /// The LMS's own file, to be filled in
    #[arg(long, value_name = "FILE")]
    pub(crate) export: Option<PathBuf>,
    /// The column of that file that takes the points
    #[arg(long, value_name = "HEADER")]
    pub(crate) column: Option<String>,
    /// The column of that file that has the ids
    #[arg(long, value_name = "HEADER")]
    pub(crate) id_column: Option<String>,
    /// The column of that file that takes the comment
    #[arg(long, value_name = "HEADER")]
    pub(crate) comment_column: Option<String>,
    #[command(flatten)]
    pub(crate) course: CourseArgs,
    /// Folder to write to [default: release/LAB/FORM in the course's folder]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

/// Makes the files and writes them.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let form = Form::named(&args.to).ok_or_else(|| {
        let known = FORMS.iter().map(|form| form.name);
        Failure::usage(
            format!("no form is called `{}`", args.to),
            &kinemark_sim::text::suggest(&args.to, "forms", known),
        )
    })?;
    let course = Course::open(&args.course)?;
    let rules = course.rules(&args.lab)?;
    let lab = course_check::ready(&course, rules)?;
    let history = course.history()?;
    let index = course.index(&history)?;
    let standings = course.standings(rules, &history, &index, &[])?;
    let records = records(&course, rules, &standings)?;
    let people = course.roster.people().iter();
    let rows: Vec<Row<'_>> = people
        .zip(&standings)
        .map(|(person, standing)| {
            let known = standing.record.as_deref().and_then(|key| records.get(key));
            Row {
                person,
                standing,
                record: known.map(|(record, _)| record),
                report: known.and_then(|(_, page)| page.as_deref()),
            }
        })
        .collect();
    let export = args
        .export
        .as_ref()
        .map(|path| exported(path))
        .transpose()?;
    let made = form
        .release(&Material {
            lab: &rules.name,
            title: &lab.lab.title,
            rows: &rows,
            export: export.as_ref().map(|(name, bytes)| Export { name, bytes }),
            columns: Columns {
                id: args.id_column.as_deref(),
                points: args.column.as_deref(),
                comment: args.comment_column.as_deref(),
            },
        })
        .map_err(|error| Failure::diagnostic(USAGE, error))?;
    let out = match &args.out {
        Some(out) => out.clone(),
        None => course
            .root()
            .join("release")
            .join(&rules.name)
            .join(form.name),
    };
    write(&out, &made)?;
    note_release(&course, rules, form, &rows)?;
    for note in &made.notes {
        output::print(&format!("{} {note}\n", "note:".yellow()))?;
    }
    output::print(&format!(
        "{}: {} files in {}\n",
        form.title,
        made.files.len(),
        output::path(&out)
    ))?;
    Ok(ExitCode::from(if made.notes.is_empty() { 0 } else { LOST }))
}

/// Records that count, with their whole pages, by key.
fn records<'s>(
    course: &Course,
    rules: &CourseLab,
    standings: &'s [Standing],
) -> Result<BTreeMap<&'s str, (Record, Option<String>)>, Failure> {
    let mut records = BTreeMap::new();
    for key in standings
        .iter()
        .filter_map(|standing| standing.record.as_deref())
    {
        if let Some(record) = course.book.record(key).map_err(book_failure)? {
            let page = course.book.whole_page(&rules.name, key);
            records.insert(key, (record, page.map_err(book_failure)?));
        }
    }
    Ok(records)
}

/// Writes into the journal whose grades went out.
fn note_release(
    course: &Course,
    rules: &CourseLab,
    form: &Form,
    rows: &[Row<'_>],
) -> Result<(), Failure> {
    let sent = rows.iter().filter(|row| row.standing.points.is_some());
    let sent = sent.filter_map(|row| Some((row.person.id.clone(), row.standing.record.clone()?)));
    let mut log = CourseLog::new(course);
    log.append(Event::Released {
        lab: rules.name.clone(),
        to: form.name.to_owned(),
        records: sent.collect(),
    })?;
    log.finish()
}

/// The LMS's file: its name and bytes.
fn exported(path: &std::path::Path) -> Result<(String, Vec<u8>), Failure> {
    let bytes = read(path).map_err(|why| {
        Failure::usage(
            format!("`{}` cannot be read: {why}", path.display()),
            "name the file that was downloaded from the LMS",
        )
    })?;
    let name = path.file_name().unwrap_or(path.as_os_str());
    Ok((name.to_string_lossy().into_owned(), bytes))
}

fn write(out: &std::path::Path, made: &Made) -> Result<(), Failure> {
    let help = "free some space, or choose another folder with --out";
    for file in &made.files {
        let path = out.join(&file.path);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)
                .map_err(|error| output::unwritten(folder, &error, help))?;
        }
        output::write_file(&path, &file.bytes, help)?;
    }
    Ok(())
}
