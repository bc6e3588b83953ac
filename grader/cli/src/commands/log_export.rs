//! `kinemark log export`: a log as tables, in a folder that is complete or absent, or one table on standard output.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs::File;
use std::io::{BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use kinemark_course::device_name::is_device;
use kinemark_report::log::{ReadError, Table, Tables, Wide, tables, write_csv, write_wide};
use kinemark_report::visible::visible;
use serde::{Deserialize, Serialize};

use crate::beneath::{self, Unread};
use crate::disk::{self, plain};
use crate::error_record::ErrorCode;
use crate::failure::{self, Failure};
use crate::fresh_folder::{self, Entry, FreshFolder};
use crate::{output, report_folder};

/// Write a log as tables
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  kinemark log export out/move/run.mcap --csv\n  \
    kinemark log export out/move/run.mcap --csv --topic /signals > signals.csv\n  \
    kinemark log export out/move/run.mcap --csv --wide > run.csv\n\n\
    Writes a CSV file per topic to the folder run-csv beside the log, with export.json, which lists them; an earlier export \
    there is replaced.\n\
    Reads every MCAP log with JSON messages, or with protobuf messages and their schemas. See docs/watch-and-compare.md.\n\
    Exit codes: 0 written, 2 usage, 3 the log is broken, 4 the tables cannot be written."
)]
pub(crate) struct Args {
    /// The log, such as out/move/run.mcap
    pub(crate) log: PathBuf,
    /// Write comma-separated values, which every spreadsheet reads
    #[arg(long, required = true)]
    pub(crate) csv: bool,
    /// Only this topic; without --out it is printed
    #[arg(long, value_name = "TOPIC")]
    pub(crate) topic: Option<String>,
    /// One table of all topics: at each message of --topic what every other topic last said [default: those of /signals]; without --out it is
    /// printed
    #[arg(long)]
    pub(crate) wide: bool,
    /// Folder to write to; an earlier export there is replaced [default: the log's name with -csv, beside it]
    #[arg(long, short, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print what was written as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// A log larger than this is not read.
const MOST_LOG_BYTES: u64 = 512 << 20;
/// The list of what was exported; a folder that has it is an export of ours.
const LIST: &str = "export.json";
/// What the list says it is.
const FORMAT: &str = "kinemark-export/1";

/// What was exported.
#[derive(Debug, Serialize, Deserialize)]
struct Export {
    format: String,
    files: Vec<Exported>,
    /// Topics that are not JSON.
    not_exported: Vec<NotExported>,
    /// Topics with too many columns for one wide table.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    left_out: Vec<String>,
}

/// One table.
#[derive(Debug, Serialize, Deserialize)]
struct Exported {
    file: String,
    topic: String,
    rows: u64,
    columns: usize,
    /// What the log's schema says of columns, most often the unit; `time_s` is in seconds.
    #[serde(default)]
    described: BTreeMap<String, String>,
}

/// One topic that is no table.
#[derive(Debug, Serialize, Deserialize)]
struct NotExported {
    topic: String,
    encoding: String,
}

/// Reads the log and writes its tables.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let log = read(&args.log)?;
    let broken = |error: ReadError| broken(&args.log, &error);
    let found = tables(&log).map_err(broken)?;
    if args.wide {
        return wide(args, &log, &found);
    }
    let wanted = |table: &Table| {
        args.topic
            .as_ref()
            .is_none_or(|topic| *topic == table.topic)
    };
    if let Some(topic) = &args.topic
        && !found.tables.iter().any(wanted)
    {
        return Err(no_topic(&args.log, topic, &found));
    }
    if args.topic.is_some() && args.out.is_none() {
        if args.json {
            return Err(Failure::usage(
                "--json with --topic needs --out: one topic alone is printed".to_owned(),
                "add --out DIR, or leave --json out",
            ));
        }
        print(&log, &found.tables, wanted).or_else(|error| match error {
            // a reader that has gone away is no failure
            ReadError::Write(why) if why.kind() == ErrorKind::BrokenPipe => Ok(()),
            other => Err(broken(other)),
        })?;
        return Ok(ExitCode::SUCCESS);
    }
    let out = match &args.out {
        Some(out) => out.clone(),
        None => {
            let out = beside(&args.log);
            // the tables of a report that somebody handed in go nowhere else
            if out.is_symlink() {
                let shown = output::path(&out);
                let what = format!("`{shown}` is a link, and links in a report are not followed");
                return Err(Failure::usage(what, "choose a folder with --out"));
            }
            out
        }
    };
    refuse_foreign(&out)?;
    let export = write(&log, &found, wanted, &out).map_err(|why| match why {
        Why::Log(error) => broken(error),
        Why::Disk(error) => unwritten(&out, &error),
        Why::Other(failure) => failure,
    })?;
    if args.json {
        output::print_json(&export)?;
    } else {
        output::print(&text(&export, &out))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The topic whose messages are the rows of one wide table.
const CLOCK: &str = "/signals";
/// The file of a wide table in a folder.
const WIDE: &str = "wide.csv";

/// Writes the log as one table: to a folder, or printed.
fn wide(args: &Args, log: &[u8], found: &Tables) -> Result<ExitCode, Failure> {
    let clock = args.topic.as_deref().unwrap_or(CLOCK);
    let Some(wide) = Wide::of(&found.tables, clock) else {
        return Err(no_topic(&args.log, clock, found));
    };
    let broken = |error: ReadError| broken(&args.log, &error);
    let Some(out) = &args.out else {
        if args.json {
            return Err(Failure::usage(
                "--json with --wide needs --out: the table is printed".to_owned(),
                "add --out DIR, or leave --json out",
            ));
        }
        let mut printed = BufWriter::new(std::io::stdout().lock());
        let done = write_wide(log, &wide, &mut printed);
        let done = done.and_then(|()| printed.flush().map_err(ReadError::Write));
        done.or_else(|error| match error {
            // a reader that has gone away is no failure
            ReadError::Write(why) if why.kind() == ErrorKind::BrokenPipe => Ok(()),
            other => Err(broken(other)),
        })?;
        for (topic, columns) in &wide.left_out {
            let topic = visible(topic);
            failure::note_in_words(&format!(
                "`{topic}` has {columns} columns and is left out; `--topic {topic}` without --wide writes it"
            ));
        }
        return Ok(ExitCode::SUCCESS);
    };
    refuse_foreign(out)?;
    let unwritten = |error: std::io::Error| unwritten(out, &error);
    let fresh = FreshFolder::beside(out).map_err(unwritten)?;
    let file = File::create(fresh.path().join(WIDE)).map_err(unwritten)?;
    write_wide(log, &wide, BufWriter::new(file)).map_err(broken)?;
    let described = found.tables.iter().find(|table| table.topic == clock);
    let described = described.into_iter().flat_map(|table| &table.described);
    let foreign = found.foreign.iter().map(|(topic, encoding)| NotExported {
        topic: topic.clone(),
        encoding: encoding.clone(),
    });
    let export = Export {
        format: FORMAT.to_owned(),
        files: vec![Exported {
            file: WIDE.to_owned(),
            topic: clock.to_owned(),
            rows: wide.rows,
            columns: wide.columns.len() + 1,
            described: described
                .map(|(column, what)| (column.to_string(), what.clone()))
                .collect(),
        }],
        not_exported: foreign.collect(),
        left_out: wide
            .left_out
            .iter()
            .map(|(topic, _)| topic.clone())
            .collect(),
    };
    let list = output::json(&export)?;
    fresh.write(LIST, list.as_bytes()).map_err(unwritten)?;
    fresh.put_in_place(&[]).map_err(unwritten)?;
    if args.json {
        output::print_json(&export)?;
    } else {
        output::print(&text(&export, out))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn unwritten(out: &Path, error: &std::io::Error) -> Failure {
    Failure::fault(
        format!(
            "the tables cannot be written to `{}`: {}",
            out.display(),
            plain(error)
        ),
        "free some space or choose another folder with --out; nothing half-written is left",
    )
    .coded(ErrorCode::Unwritten)
}

/// What a log holds, where the path is one.
fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let shown = path.display();
    if path.is_dir() {
        return Err(Failure::usage(
            format!("`{shown}` is a folder, not a log"),
            "name the log itself, such as out/TASK/run.mcap",
        ));
    }
    if !path.is_file() {
        return Err(Failure::usage(
            format!("there is no file `{shown}`"),
            "`kinemark grade` writes one per motion task, such as out/TASK/run.mcap",
        )
        .coded(ErrorCode::NoFile));
    }
    let bytes = match report_folder::enclosing(path) {
        Some((report, inside)) => beneath::bytes(&report, &inside, MOST_LOG_BYTES),
        None => disk::bytes_of(path, MOST_LOG_BYTES).map_err(Unread::Other),
    };
    bytes.map_err(|why| {
        let help = match &why {
            Unread::Absent | Unread::Link(_) => "grade the submission again",
            Unread::Other(_) => {
                "cut out a part of a longer log: `mcap filter LOG -o PART -s 0 -e 10`"
            }
        };
        Failure::broken(format!("`{shown}` cannot be read: {why}"), help)
    })
}

fn broken(log: &Path, error: &ReadError) -> Failure {
    let message = format!("`{}`: {}", log.display(), visible(&error.to_string()));
    match error {
        ReadError::Write(_) => Failure::fault(message, error.way_out()),
        _ => Failure::broken(message, error.way_out()),
    }
}

fn no_topic(log: &Path, topic: &str, found: &Tables) -> Failure {
    let has: Vec<String> = found
        .tables
        .iter()
        .map(|table| visible(&table.topic).into_owned())
        .collect();
    let foreign = found.foreign.iter().find(|(name, _)| name == topic);
    let message = match foreign {
        Some((_, encoding)) => format!(
            "topic `{}` of `{}` is `{}`, not JSON",
            visible(topic),
            log.display(),
            visible(encoding)
        ),
        None => format!("`{}` has no topic `{}`", log.display(), visible(topic)),
    };
    Failure::usage(message, &format!("its topics: {}", has.join(", ")))
}

/// The folder beside a log: `run-csv` for `run.mcap`.
fn beside(log: &Path) -> PathBuf {
    let mut name: OsString = log.file_stem().unwrap_or_default().to_owned();
    name.push("-csv");
    log.with_file_name(name)
}

/// Prints the tables that are wanted.
fn print(log: &[u8], all: &[Table], wanted: impl Fn(&Table) -> bool) -> Result<(), ReadError> {
    let mut out = BufWriter::new(std::io::stdout().lock());
    let mut at = Some(&mut out);
    let writers = all
        .iter()
        .map(|table| wanted(table).then(|| at.take()).flatten());
    let writers = writers.collect();
    write_csv(log, all, writers)?;
    out.flush().map_err(ReadError::Write)
}

/// Why a folder was not written.
enum Why {
    Log(ReadError),
    Disk(std::io::Error),
    Other(Failure),
}

/// Writes the folder under another name, then renames it.
fn write(
    log: &[u8],
    found: &Tables,
    wanted: impl Fn(&Table) -> bool,
    out: &Path,
) -> Result<Export, Why> {
    let fresh = FreshFolder::beside(out).map_err(Why::Disk)?;
    let folder = fresh.path();
    let mut export = Export {
        format: FORMAT.to_owned(),
        files: Vec::new(),
        not_exported: Vec::new(),
        left_out: Vec::new(),
    };
    let mut files = Vec::new();
    for table in &found.tables {
        if !wanted(table) {
            files.push(None);
            continue;
        }
        let name = file_name(&table.topic, &export.files);
        let file = File::create(folder.join(&name)).map_err(Why::Disk)?;
        files.push(Some(BufWriter::new(file)));
        export.files.push(Exported {
            file: name,
            topic: table.topic.clone(),
            rows: table.rows,
            columns: table.columns.len() + 1,
            described: table
                .described
                .iter()
                .map(|(column, what)| (column.to_string(), what.clone()))
                .collect(),
        });
    }
    let foreign = found.foreign.iter().map(|(topic, encoding)| NotExported {
        topic: topic.clone(),
        encoding: encoding.clone(),
    });
    export.not_exported = foreign.collect();
    write_csv(log, &found.tables, files).map_err(Why::Log)?;
    let list = output::json(&export).map_err(Why::Other)?;
    fresh.write(LIST, list.as_bytes()).map_err(Why::Disk)?;
    fresh.put_in_place(&[]).map_err(Why::Disk)?;
    Ok(export)
}

/// Checks that `out` is free, empty, or an earlier export.
fn refuse_foreign(out: &Path) -> Result<(), Failure> {
    let list = disk::bytes_of(&out.join(LIST), 16 << 20).ok();
    let list: Option<Export> = list.and_then(|text| serde_json::from_slice(&text).ok());
    let ours = |name: &str| match &list {
        Some(_) if name == LIST => Entry::Ours,
        Some(list) if list.files.iter().any(|exported| exported.file == name) => Entry::Ours,
        _ => Entry::Foreign,
    };
    fresh_folder::refuse_foreign(out, "an earlier export", ours)?;
    Ok(())
}

/// A file name for a topic that every system takes, and that no topic before has.
fn file_name(topic: &str, before: &[Exported]) -> String {
    let plain: String = topic
        .trim_start_matches('/')
        .chars()
        .take(100)
        .map(|c| match c {
            'a'..='z' | 'A'..='Z' | '0'..='9' | '_' | '-' => c,
            '/' => '.',
            _ => '_',
        })
        .collect();
    // a name with a dot before is hidden, and some systems have devices called con or nul
    let stem = match plain.split('.').next() {
        None | Some("") => format!("topic{plain}"),
        Some(first) if is_device(first) => format!("topic.{plain}"),
        Some(_) => plain,
    };
    let taken = |name: &str| {
        before
            .iter()
            .any(|exported| exported.file.eq_ignore_ascii_case(name))
    };
    let mut name = format!("{stem}.csv");
    let mut number = 2;
    while taken(&name) {
        name = format!("{stem}-{number}.csv");
        number += 1;
    }
    name
}

fn text(export: &Export, out: &Path) -> String {
    let mut text = String::new();
    for exported in &export.files {
        text += &format!(
            "{}: {} rows, {} columns of `{}`\n",
            output::path(&out.join(&exported.file)),
            exported.rows,
            exported.columns,
            visible(&exported.topic)
        );
    }
    for topic in &export.not_exported {
        text += &format!(
            "not exported: `{}` is `{}`, not JSON\n",
            visible(&topic.topic),
            visible(&topic.encoding)
        );
    }
    for topic in &export.left_out {
        let topic = visible(topic);
        text += &format!("left out: `{topic}` has too many columns for one table\n");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_of_a_run_are_where_a_report_keeps_them() {
        let beside = beside(Path::new("out/move/run.mcap"));
        assert_eq!(beside, Path::new("out/move").join(report_folder::TABLES));
    }

    #[test]
    fn every_topic_has_a_file_of_its_own() {
        let mut before = Vec::new();
        for (topic, expected) in [
            ("/joint_states", "joint_states.csv"),
            ("/reference/tf", "reference.tf.csv"),
            ("/../../etc/passwd", "__.__.etc.passwd.csv"),
            ("", "topic.csv"),
            ("/", "topic-2.csv"),
            ("/CON", "topic.CON.csv"),
            ("/com1/x", "topic.com1.x.csv"),
            ("/Joint_States", "Joint_States-2.csv"),
            ("/a b=é", "a_b__.csv"),
        ] {
            let name = file_name(topic, &before);
            assert_eq!(name, expected, "{topic}");
            before.push(Exported {
                file: name,
                topic: topic.to_owned(),
                rows: 0,
                columns: 0,
                described: BTreeMap::new(),
            });
        }
    }
}
