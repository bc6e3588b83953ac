//! A stop of the course staff's own code as an error at its line; nobody would notice it otherwise.

use std::ops::Range;

use kinemark_sim::text::Source;

use crate::attempt::ended::record_of;
use crate::lab::Task;
use crate::record::staff_fault::{StaffFault, StaffProblem, StaffSubmission};
use crate::submission::controller::Stop;

/// `stop` as a fault at its line of `source`, in `task` or before any; `None` if the submission is not at fault.
pub(crate) fn staff_fault(
    submission: StaffSubmission,
    task: Option<&Task>,
    source: &Source,
    stop: &Stop,
) -> Option<StaffFault> {
    match stop {
        Stop::HostLimit(_) | Stop::GraderFault(_) | Stop::Interrupted => return None,
        Stop::DidNotBuild(_) | Stop::Missing { .. } | Stop::Crashed(_) => {}
        Stop::OverBudget { .. } => {}
    }
    let record = record_of(stop, source.text());
    let problem = StaffProblem {
        submission,
        task: task.map(|task| task.name.clone()),
        message: record.message,
        help: record.help,
    };
    let at = record.line.map_or(0..0, |line| {
        word_at(source.text(), line, record.column.unwrap_or(1))
    });
    Some(StaffFault::new(problem, source, at))
}

/// The bytes of the word at a line and a column, both from one.
fn word_at(text: &str, line: usize, column: usize) -> Range<usize> {
    // the script reader does not count a byte order mark
    let mark = text.len() - text.trim_start_matches('\u{feff}').len();
    let lines = text[mark..].split_inclusive('\n');
    let start = mark
        + lines
            .take(line.saturating_sub(1))
            .map(str::len)
            .sum::<usize>();
    let rest = &text[start..];
    let before = rest
        .char_indices()
        .nth(column.saturating_sub(1))
        .map_or(rest.len(), |(at, _)| at);
    let word = rest[before..]
        .find(|c: char| !(c.is_alphanumeric() || c == '_'))
        .unwrap_or(rest.len() - before);
    let begin = start + before;
    begin..(begin + word.max(1)).min(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_the_word_that_begins_there() {
        let text = "fn a() {\n    ü + länge(1)\n}";
        assert_eq!(&text[word_at(text, 2, 9)], "länge");
        assert_eq!(&text[word_at(text, 1, 1)], "fn");
        assert_eq!(&text[word_at(text, 2, 7)], "+");
        // empty beyond the last line and the last column
        assert_eq!(&text[word_at(text, 9, 9)], "");
        assert_eq!(&text[word_at(text, 3, 2)], "");
        assert_eq!(word_at("", 1, 1), 0..0);
        let marked = "\u{feff}fnn a";
        assert_eq!(&marked[word_at(marked, 1, 1)], "fnn");
    }
}
