//! A log as one table, as plots and statistics want it: at each message of one topic what all the others last said.

use std::cell::Cell;
use std::io::Write;

use super::columns::TIME;
use super::csv::{
    Fields, Form, MOST_TABLES_BYTES, Table, harmless, time_s, unfit, unwritten, writer,
};
use super::read::{ReadError, messages, most_of};

/// Topics with more columns are no part of a wide table: scenes have hundreds.
const MOST_OF_A_TOPIC: usize = 64;

/// A log as one table: at each message of one topic, its clock, what every other topic last said.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Wide {
    /// The clock's topic.
    pub clock: String,
    /// Its messages.
    pub rows: u64,
    /// Columns after the first, which is `time_s`: those of the clock, then those of the others as `TOPIC.COLUMN`.
    pub columns: Vec<String>,
    /// Topics that have too many columns, with how many.
    pub left_out: Vec<(String, usize)>,
    /// The tables that are in it, the clock's first.
    tables: Vec<Table>,
}

impl Wide {
    /// The wide table of a log with these `tables`, at the messages of `clock`; none without that topic.
    pub fn of(tables: &[Table], clock: &str) -> Option<Self> {
        let first = tables.iter().find(|table| table.topic == clock)?;
        let others = tables.iter().filter(|table| table.topic != clock);
        let (narrow, broad): (Vec<_>, Vec<_>) =
            others.partition(|table| table.columns.len() <= MOST_OF_A_TOPIC);
        let named = narrow.iter().flat_map(|table| {
            let names = table.columns.iter();
            names.map(|name| format!("{}.{name}", table.topic.trim_start_matches('/')))
        });
        let own = first.columns.iter().map(|name| name.to_string());
        Some(Self {
            clock: clock.to_owned(),
            rows: first.rows,
            columns: own.chain(named).collect(),
            left_out: broad
                .iter()
                .map(|table| (table.topic.clone(), table.columns.len()))
                .collect(),
            tables: std::iter::once(first)
                .chain(narrow.iter().copied())
                .cloned()
                .collect(),
        })
    }
}

/// Writes a log as one table. The first column is `time_s`, the time of the clock's message; messages of other topics at that same time are
/// in its row, wherever they are in the log. What a topic has not said yet is an empty field.
///
/// # Errors
/// [`ReadError`] as for [`super::tables`], and where the output does not take it.
pub fn write_wide<W: Write>(log: &[u8], wide: &Wide, out: W) -> Result<(), ReadError> {
    let left = Cell::new(most_of(log, MOST_TABLES_BYTES));
    let mut writer = writer(out, &left);
    let names = wide.columns.iter().map(|name| harmless(name));
    let head = std::iter::once(TIME.to_owned()).chain(names);
    writer.write_record(head).map_err(unwritten)?;
    let mut all: Vec<Fields<'_>> = wide.tables.iter().map(Fields::of).collect();
    let mut row = vec![String::new(); wide.columns.len() + 1];
    // a row waits until the time goes on
    let mut waits: Option<u64> = None;
    messages(log, &mut |message| {
        if waits.is_some_and(|time_ns| message.log_time_ns > time_ns) {
            waits = None;
            writer.write_record(&row).map_err(unwritten)?;
        }
        let topic = message.channel.topic.as_str();
        let mut begins = 1;
        for (i, fields) in all.iter_mut().enumerate() {
            let ends = begins + fields.table.columns.len();
            if fields.table.topic == topic && Form::is_read(message.channel) {
                if i == 0 {
                    if waits.take().is_some() {
                        // two messages of the clock at one time are two rows
                        writer.write_record(&row).map_err(unwritten)?;
                    }
                    waits = Some(message.log_time_ns);
                    row[0] = time_s(message.log_time_ns);
                }
                return fields.fill(&message, &mut row[begins..ends]);
            }
            begins = ends;
        }
        Ok(())
    })?;
    if waits.is_some() {
        writer.write_record(&row).map_err(unwritten)?;
    }
    writer.flush().map_err(unfit)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::log::mcap;
    use crate::log::tables;
    use crate::log_request::LogRequest;
    use kinemark_grader::record::sample;

    fn wide_of(log: &[u8], clock: &str) -> (Wide, String) {
        let found = tables(log).unwrap();
        let wide = Wide::of(&found.tables, clock).unwrap();
        let mut bytes = Vec::new();
        write_wide(log, &wide, &mut bytes).unwrap();
        (wide, String::from_utf8(bytes).unwrap())
    }

    #[test]
    fn a_row_has_the_clock_and_what_others_last_said() {
        let run = sample::task_run();
        let log = mcap(&run, &sample::graded().grade, &[], LogRequest::default()).unwrap();
        let (wide, text) = wide_of(&log, "/signals");
        let mut reader = ::csv::Reader::from_reader(text.as_bytes());
        let head = reader.headers().unwrap().clone();
        assert_eq!(head.len(), wide.columns.len() + 1);
        let at = |name: &str| head.iter().position(|column| column == name).unwrap();
        let (of_clock, of_other) = (at("q_shoulder"), at("tcp.pose.position.x"));
        let mut rows = 0;
        for row in reader.records() {
            let row = row.unwrap();
            let number = |i: usize| row[i].parse::<f64>().unwrap();
            let tick = (number(0) / run.trace.step_s).round() as usize;
            assert_eq!(number(of_clock), run.trace.q.at(tick)[0]);
            // the TCP is logged at its own rate: what it last said is no later than the row
            // poses are logged sixty times a second, to nine decimals
            let mut said = tick.saturating_sub(17)..=tick;
            let last = number(of_other);
            assert!(
                said.any(|tick| (run.trace.tcp.at(tick)[0] - last).abs() < 1e-9),
                "row {rows}: {last}"
            );
            rows += 1;
        }
        assert_eq!(rows, wide.rows);
    }

    #[test]
    fn a_topic_of_a_thousand_columns_is_left_out_and_named() {
        let table = |topic: &str, columns: usize| Table {
            topic: topic.to_owned(),
            rows: 1,
            columns: (0..columns).map(|i| Arc::from(i.to_string())).collect(),
            described: std::collections::BTreeMap::new(),
        };
        let all = [table("/a", 1), table("/scene", 1000), table("/clock", 2)];
        let wide = Wide::of(&all, "/clock").unwrap();
        assert_eq!(wide.columns, ["0", "1", "a.0"]);
        assert_eq!(wide.left_out, [("/scene".to_owned(), 1000)]);
        assert_eq!(Wide::of(&all, "/none"), None);
    }
}
