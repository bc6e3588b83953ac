//! A log as tables for spreadsheets: a CSV file per topic, a row per message, numbers with all their digits. Messages may be JSON, or
//! protobuf with its descriptors.

use std::cell::Cell;
use std::collections::{BTreeMap, HashMap};
use std::io::Write;
use std::sync::Arc;

use ::mcap::{Channel, Schema};
use prost_reflect::MessageDescriptor;

use super::columns::{Budget, Columns, MOST_COLUMNS, MOST_NAME, TIME, TooWide, parts, walk};
use super::json::Json;
use super::protobuf;
use super::read::{LogMessage, ReadError, messages, most_of};
use super::schema::well_known;

/// Tables that are larger, all together, open nowhere.
pub(super) const MOST_TABLES_BYTES: u64 = 2 << 30;
/// Characters of what a schema says of a column.
const MOST_OF_A_DESCRIPTION: usize = 200;
/// Topics of a log, each of which becomes a file.
const MOST_TOPICS: usize = 1_000;

/// The table of one topic.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// The topic, as the log names it.
    pub topic: String,
    /// Its messages.
    pub rows: u64,
    /// Its columns after the first, which is `time_s`: the way to each value, with dots between.
    pub columns: Vec<Arc<str>>,
    /// What the log's schema says of columns, most often the unit, such as `rad`.
    pub described: BTreeMap<Arc<str>, String>,
}

/// What a log holds.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Tables {
    /// Topics whose messages are read, in the order of their first messages.
    pub tables: Vec<Table>,
    /// Topics whose messages are not read, each with its encoding.
    pub foreign: Vec<(String, String)>,
}

/// A table while the log is read.
struct Found {
    table: Table,
    columns: Columns,
    form: Form,
    schema: Option<Arc<Schema<'static>>>,
}

/// Reads a log through: which tables it makes, each with its rows and columns.
///
/// # Errors
/// [`ReadError`] for a log that is damaged, cut off, no log, too large, or without a message that is read.
pub fn tables(log: &[u8]) -> Result<Tables, ReadError> {
    let mut found: Vec<Found> = Vec::new();
    let mut foreign: Vec<(String, String)> = Vec::new();
    let mut left = Budget::default();
    messages(log, &mut |message| {
        let topic = message.channel.topic.as_str();
        let at = found.iter().position(|found| found.table.topic == topic);
        if !Form::is_read(message.channel) {
            let encoding = message.channel.message_encoding.as_str();
            if !foreign
                .iter()
                .any(|(known, with)| known == topic && with == encoding)
            {
                bounded(found.len() + foreign.len())?;
                foreign.push((topic.to_owned(), encoding.to_owned()));
            }
            return Ok(());
        }
        let at = match at {
            Some(at) => at,
            None => {
                bounded(found.len() + foreign.len())?;
                let table = Table {
                    topic: topic.to_owned(),
                    rows: 0,
                    columns: Vec::new(),
                    described: BTreeMap::new(),
                };
                found.push(Found {
                    table,
                    columns: Columns::default(),
                    form: Form::of(message.channel)?,
                    schema: message.channel.schema.clone(),
                });
                found.len() - 1
            }
        };
        let Found {
            table,
            columns,
            form,
            ..
        } = &mut found[at];
        table.rows += 1;
        let value = form.parse(&message, table.rows)?;
        let learnt = columns.learn(&value, &mut left);
        learnt.map_err(|why| too_wide(topic, why))
    })?;
    if found.is_empty() {
        let topics = foreign
            .iter()
            .map(|(topic, encoding)| format!("`{topic}` is `{encoding}`"));
        let topics: Vec<String> = topics.collect();
        return Err(if topics.is_empty() {
            ReadError::NoMessages
        } else {
            ReadError::Unread { topics }
        });
    }
    let tables = found.into_iter().map(|found| {
        let mut table = found.table;
        table.columns = found.columns.names();
        if let Some(schema) = &found.schema {
            table.described = described(schema, &table.columns);
        }
        table
    });
    Ok(Tables {
        tables: tables.collect(),
        foreign,
    })
}

/// Writes the tables of a log for which there is something to write to: `out` goes with `tables`, the log's own.
///
/// The first column is `time_s`, the message's time. What a message does not have is an empty field. Text that a spreadsheet would
/// take for a formula begins with an apostrophe, and every text stands in quotes.
///
/// # Errors
/// [`ReadError`] as for [`tables`], and where the output does not take it.
pub fn write_csv<W: Write>(
    log: &[u8],
    tables: &[Table],
    out: Vec<Option<W>>,
) -> Result<(), ReadError> {
    let left = Cell::new(most_of(log, MOST_TABLES_BYTES));
    let mut writers = Vec::new();
    for (table, out) in tables.iter().zip(out) {
        let Some(out) = out else { continue };
        let mut writer = Rows {
            writer: writer(out, &left),
            fields: Fields::of(table),
            row: vec![String::new(); table.columns.len() + 1],
        };
        writer.head()?;
        writers.push(writer);
    }
    messages(log, &mut |message| {
        let topic = message.channel.topic.as_str();
        match writers
            .iter_mut()
            .find(|rows| rows.fields.table.topic == topic)
        {
            Some(rows) if Form::is_read(message.channel) => rows.row(&message),
            _ => Ok(()),
        }
    })?;
    writers.iter_mut().try_for_each(|rows| {
        let flushed = rows.writer.flush();
        flushed.map_err(unfit)
    })
}

/// A writer of tables that all spreadsheets read.
pub(super) fn writer<W: Write>(out: W, left: &Cell<u64>) -> csv::Writer<Bounded<'_, W>> {
    // a text with `;` or a tab in it would be two fields where these stand between fields
    csv::WriterBuilder::new()
        .quote_style(csv::QuoteStyle::NonNumeric)
        .from_writer(Bounded { out, left })
}

/// The messages of one topic as fields of a row.
pub(super) struct Fields<'a> {
    pub(super) table: &'a Table,
    /// Where each column is among them.
    at: HashMap<&'a str, usize>,
    /// How its messages are written, once one has come.
    form: Option<Form>,
    read: u64,
}

impl<'a> Fields<'a> {
    pub(super) fn of(table: &'a Table) -> Self {
        Self {
            table,
            at: table.columns.iter().map(AsRef::as_ref).zip(0..).collect(),
            form: None,
            read: 0,
        }
    }

    /// Writes the next message into `row`, a field a column.
    pub(super) fn fill(
        &mut self,
        message: &LogMessage<'_>,
        row: &mut [String],
    ) -> Result<(), ReadError> {
        self.read += 1;
        let form = match self.form.take() {
            Some(form) => form,
            None => Form::of(message.channel)?,
        };
        let value = form.parse(message, self.read)?;
        self.form = Some(form);
        row.iter_mut().for_each(String::clear);
        let placed = walk(&value, &mut |name, leaf| {
            if let Some(field) = self.at.get(name).and_then(|at| row.get_mut(*at)) {
                *field = written(leaf);
            }
            Ok(())
        });
        placed.map_err(|why| too_wide(&self.table.topic, why))
    }
}

/// One table being written.
struct Rows<'a, W: Write> {
    writer: csv::Writer<Bounded<'a, W>>,
    fields: Fields<'a>,
    /// The row being written, used again for the next: the time, then a field a column.
    row: Vec<String>,
}

impl<W: Write> Rows<'_, W> {
    fn head(&mut self) -> Result<(), ReadError> {
        let names = self.fields.table.columns.iter().map(|name| harmless(name));
        let head = std::iter::once(TIME.to_owned()).chain(names);
        self.writer.write_record(head).map_err(unwritten)
    }

    fn row(&mut self, message: &LogMessage<'_>) -> Result<(), ReadError> {
        self.row[0] = time_s(message.log_time_ns);
        self.fields.fill(message, &mut self.row[1..])?;
        self.writer.write_record(&self.row).map_err(unwritten)
    }
}

/// The bytes that tables may have are spent; the system has an error of its own for a file that it lets grow no further.
#[derive(Debug, thiserror::Error)]
#[error("the tables are too large")]
struct Spent;

/// A writer that has an end, the same for all tables of a log.
pub(super) struct Bounded<'a, W> {
    out: W,
    left: &'a Cell<u64>,
}

impl<W: Write> Write for Bounded<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let left = self.left.get().checked_sub(bytes.len() as u64);
        self.left
            .set(left.ok_or_else(|| std::io::Error::other(Spent))?);
        self.out.write_all(bytes)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.out.flush()
    }
}

/// What a JSON schema says of columns, or that of Foxglove's messages by their name; none of one that is not read.
fn described(schema: &Schema<'_>, columns: &[Arc<str>]) -> BTreeMap<Arc<str>, String> {
    let root: serde_json::Value = match schema.encoding.as_str() {
        "jsonschema" => serde_json::from_slice(&schema.data).unwrap_or_default(),
        "protobuf" => well_known(&schema.name),
        _ => return BTreeMap::new(),
    };
    let described = columns.iter().filter_map(|column| {
        let mut at = &root;
        for part in parts(column) {
            at = match at.get("properties") {
                Some(properties) => properties.get(part)?,
                // the items of a list are identified by name or index
                None => at.get("items")?,
            };
        }
        let text = at.get("description")?.as_str()?;
        let text: String = text.chars().take(MOST_OF_A_DESCRIPTION).collect();
        Some((Arc::clone(column), text))
    });
    described.collect()
}

/// How the messages of a topic are written.
#[derive(Debug, Clone)]
pub(super) enum Form {
    Json,
    Protobuf(MessageDescriptor),
}

impl Form {
    pub(super) fn is_read(channel: &Channel<'_>) -> bool {
        let schema = channel.schema.as_ref();
        match channel.message_encoding.as_str() {
            "json" => true,
            "protobuf" => schema.is_some_and(|schema| schema.encoding == "protobuf"),
            _ => false,
        }
    }

    /// That of a channel that is read.
    fn of(channel: &Channel<'_>) -> Result<Self, ReadError> {
        match &channel.schema {
            Some(schema) if channel.message_encoding == "protobuf" => {
                let described = protobuf::described(&schema.name, &schema.data);
                described
                    .map(Self::Protobuf)
                    .map_err(|why| ReadError::Schema {
                        topic: channel.topic.clone(),
                        why,
                    })
            }
            _ => Ok(Self::Json),
        }
    }

    fn parse(&self, message: &LogMessage<'_>, number: u64) -> Result<Json, ReadError> {
        let (parsed, form) = match self {
            Self::Json => {
                let parsed = Json::parse(message.data);
                (parsed.map_err(|error| error.to_string()), "JSON".to_owned())
            }
            Self::Protobuf(described) => {
                let parsed = protobuf::parse(described, message.data);
                (parsed, format!("`{}` in protobuf", described.full_name()))
            }
        };
        parsed.map_err(|why| ReadError::Message {
            topic: message.channel.topic.clone(),
            number,
            form,
            why,
        })
    }
}

fn bounded(topics: usize) -> Result<(), ReadError> {
    if topics < MOST_TOPICS {
        return Ok(());
    }
    Err(ReadError::TooLarge {
        what: format!("it has more than {MOST_TOPICS} topics"),
    })
}

fn too_wide(topic: &str, why: TooWide) -> ReadError {
    ReadError::TooLarge {
        what: match why {
            TooWide::Columns => {
                format!(
                    "topic `{topic}` has more than {MOST_COLUMNS} columns, the most a spreadsheet has"
                )
            }
            TooWide::All => "its tables have too many columns together".to_owned(),
            TooWide::Name => {
                format!(
                    "a column of topic `{topic}` has a name of more than {MOST_NAME} characters"
                )
            }
        },
    }
}

pub(super) fn unwritten(error: csv::Error) -> ReadError {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => unfit(error),
        // rows have as many fields as the head, and nothing is read
        other => ReadError::Write(std::io::Error::other(format!("{other:?}"))),
    }
}

pub(super) fn unfit(error: std::io::Error) -> ReadError {
    if error.get_ref().is_some_and(|inner| inner.is::<Spent>()) {
        return ReadError::TooLarge {
            what: "its tables take many times its own room".to_owned(),
        };
    }
    ReadError::Write(error)
}

/// A time in seconds, to the nanosecond, without zeros at its end.
pub(super) fn time_s(ns: u64) -> String {
    let text = format!("{}.{:09}", ns / 1_000_000_000, ns % 1_000_000_000);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The text of a field. Numbers have as many digits as distinguish them from every other.
fn written(value: &Json) -> String {
    match value {
        Json::Null => String::new(),
        Json::Bool(value) => value.to_string(),
        Json::Number(value) => value.to_string(),
        Json::Text(text) => harmless(text),
        // only what holds nothing is a field
        Json::List(_) => "[]".to_owned(),
        Json::Object(_) => "{}".to_owned(),
    }
}

/// Text that a spreadsheet does not take for a formula.
///
/// Source: OWASP, *CSV Injection*: fields that begin with `=`, `+`, `-`, `@`, a tab, a carriage return, a line feed, or the
/// full-width forms of the signs begin with an apostrophe instead.
pub(super) fn harmless(text: &str) -> String {
    let is_formula = |c: char| {
        matches!(
            c,
            '=' | '+' | '-' | '@' | '\t' | '\r' | '\n' | '＝' | '＋' | '－' | '＠'
        )
    };
    if text.starts_with(is_formula) {
        format!("'{text}")
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests;
