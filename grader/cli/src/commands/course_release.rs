//! `kinemark course release`: grades and feedback in the form that the LMS takes.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use kinemark_course::book::Record;
use kinemark_course::course_file::CourseLab;
use kinemark_course::course_text::read;
use kinemark_course::history::History;
use kinemark_course::index::Index;
use kinemark_course::journal::Event;
use kinemark_course::release::{
    Columns, Export, FORMS, Form, Made, Material, Note, OpenFiles, Row,
};
use kinemark_course::staffed_lab::{StaffedLab, engine_id};
use kinemark_course::standing::Standing;
use kinemark_course::student::StudentId;
use kinemark_grader::lab::Task;
use kinemark_grader::record::hints::Hints;
use owo_colors::OwoColorize as _;
use serde::Serialize;

use super::course_check;
use crate::course_folder::{Course, CourseArgs, book_failure, index_failure};
use crate::course_log::CourseLog;
use crate::failure::{Failure, LOST, USAGE};
use crate::{listed_folder, output};

/// Write grades and feedback as the LMS takes them
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark course release 01-kinematics --to moodle --export Grades-Robots-Lab1.csv\n  \
    kinemark course release 01-kinematics --to canvas --export gradebook.csv --column \"Lab 1 (4314282)\"\n  \
    kinemark course release 01-kinematics --to csv\n\n\
    Forms: moodle, canvas, gradescope, csv, feedback, junit, github, jsonl; docs/exports.md describes each. --export is the LMS's own \
    file, which is filled in and otherwise left as it is. Running it twice changes nothing, and what an earlier run wrote and is not \
    true any more goes. With --out it is a trial: the journal has no line that grades went out.\n\
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
    /// Folder to write to, as a trial [default: release/LAB/FORM in the course's folder]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print what was written, and the notes, as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// What was written.
#[derive(Serialize)]
struct Released<'a> {
    lab: &'a str,
    form: &'a str,
    folder: String,
    files: Vec<&'a str>,
    /// Whether the journal says that these grades went out.
    is_in_journal: bool,
    notes: Vec<ShownNote<'a>>,
}

/// A note with its words.
#[derive(Serialize)]
struct ShownNote<'a> {
    #[serde(flatten)]
    note: &'a Note,
    words: String,
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
    let open = course.open_files(rules)?;
    let standings = course.standings(rules, &history, &index, &open.students)?;
    let records = records(&course, rules, &standings)?;
    let hints = lab.lab.hints();
    let earlier = earlier(rules, &index, &lab)?;
    let rows = rows(&course, &standings, &records, &earlier, &hints);
    let export = args
        .export
        .as_ref()
        .map(|path| exported(path))
        .transpose()?;
    let made = form
        .release(&Material {
            lab: &rules.name,
            title: &lab.lab.title,
            max_points: lab.lab.tasks.iter().map(Task::max_points).sum(),
            rows: &rows,
            export: export.as_ref().map(|(name, bytes)| Export { name, bytes }),
            columns: Columns {
                id: args.id_column.as_deref(),
                points: args.column.as_deref(),
                comment: args.comment_column.as_deref(),
            },
            open: OpenFiles {
                students: &open.students,
                unclaimed: &open.unclaimed,
            },
        })
        .map_err(|error| Failure::diagnostic(USAGE, error))?;
    let usual = course.root().join("release").join(&rules.name);
    let out = args.out.clone().unwrap_or_else(|| usual.join(form.name));
    let files: Vec<(&str, &[u8])> = made
        .files
        .iter()
        .map(|file| (file.path.as_str(), file.bytes.as_slice()))
        .collect();
    listed_folder::write(&out, &files)?;
    if args.out.is_none() {
        note_release(&course, rules, form, &history, sent(&rows, &made))?;
    }
    print(args, form, &made, &out)?;
    Ok(ExitCode::from(if made.notes.is_empty() { 0 } else { LOST }))
}

/// How everybody stands, with the record that counts.
fn rows<'a>(
    course: &'a Course,
    standings: &'a [Standing],
    records: &'a BTreeMap<&str, (Record, Option<String>)>,
    earlier: &BTreeSet<String>,
    hints: &'a Hints,
) -> Vec<Row<'a>> {
    let people = course.roster.people().iter();
    people
        .zip(standings)
        .map(|(person, standing)| {
            let key = standing.record.as_deref();
            let known = key.and_then(|key| records.get(key));
            Row {
                person,
                standing,
                record: known.map(|(record, _)| record),
                report: known.and_then(|(_, page)| page.as_deref()),
                hints,
                is_of_earlier_lab: standing
                    .record
                    .as_ref()
                    .is_some_and(|key| earlier.contains(key)),
            }
        })
        .collect()
}

/// Keys of the records that were made with another lab, staff part or engine than those of today.
fn earlier(
    rules: &CourseLab,
    index: &Index,
    lab: &StaffedLab,
) -> Result<BTreeSet<String>, Failure> {
    let summaries = index.summaries(&rules.name).map_err(index_failure)?;
    let earlier = summaries.into_iter().filter(|(_, summary)| {
        summary.engine != engine_id()
            || summary.lab_version != lab.lab_version
            || summary.staff_version != lab.staff_version
    });
    Ok(earlier.map(|(key, _)| key).collect())
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

/// The record of each student whose grade is in the files.
fn sent(rows: &[Row<'_>], made: &Made) -> BTreeMap<StudentId, String> {
    let left_out: Vec<&StudentId> = made.notes.iter().filter_map(Note::is_left_out).collect();
    let sent = rows
        .iter()
        .filter(|row| row.standing.points.is_some() && !left_out.contains(&&row.person.id));
    sent.filter_map(|row| Some((row.person.id.clone(), row.standing.record.clone()?)))
        .collect()
}

/// Writes into the journal whose grades went out, unless its last line of this form says the same.
fn note_release(
    course: &Course,
    rules: &CourseLab,
    form: &Form,
    history: &History,
    records: BTreeMap<StudentId, String>,
) -> Result<(), Failure> {
    let mut releases = history.releases.iter().rev();
    let last = releases.find(|release| release.lab == rules.name && release.to == form.name);
    if last.is_some_and(|last| last.records == records) {
        return Ok(());
    }
    let mut log = CourseLog::new(course);
    log.append(Event::Released {
        lab: rules.name.clone(),
        to: form.name.to_owned(),
        records,
    })?;
    log.finish()
}

/// The LMS's file: its name and bytes.
fn exported(path: &Path) -> Result<(String, Vec<u8>), Failure> {
    let bytes = read(path).map_err(|why| {
        Failure::usage(
            format!("`{}` cannot be read: {why}", path.display()),
            "name the file that was downloaded from the LMS",
        )
    })?;
    let name = path.file_name().unwrap_or(path.as_os_str());
    Ok((name.to_string_lossy().into_owned(), bytes))
}

fn print(args: &Args, form: &Form, made: &Made, out: &Path) -> Result<(), Failure> {
    let shown = output::path(out);
    if args.json {
        let notes = made.notes.iter().map(|note| ShownNote {
            note,
            words: note.to_string(),
        });
        return output::print_formatted(&Released {
            lab: &args.lab,
            form: form.name,
            folder: shown,
            files: made.files.iter().map(|file| file.path.as_str()).collect(),
            is_in_journal: args.out.is_none(),
            notes: notes.collect(),
        });
    }
    for note in &made.notes {
        output::print(&format!("{} {note}\n", "note:".yellow()))?;
    }
    let files = match made.files.len() {
        1 => "1 file".to_owned(),
        count => format!("{count} files"),
    };
    output::print(&format!("{}: {files} in {shown}\n", form.title))?;
    if args.out.is_some() {
        output::print("a trial: the journal has no line that these grades went out\n")?;
    }
    Ok(())
}
