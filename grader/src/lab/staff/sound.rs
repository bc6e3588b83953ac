//! The staff's own submissions, solution and mutants: one that is no program, or that stops in a run, is an error at its line. It
//! would else be noticed by nobody: what it tells of a student's work would only be missing.

use std::ops::Range;

use kinemark_sim::source::Source;

use super::Mutant;
use crate::attempt::stopped;
use crate::judge::opening;
use crate::lab::model::{Lab, Task};
use crate::lab::problem::{LabError, LabProblem};
use crate::submission::controller::Stop;
use crate::submission::rhai::ScriptController;

/// What a submission of the staff is for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Whose<'m> {
    /// The reference solution.
    Solution,
    /// A known mistake.
    Mutant(&'m Mutant),
}

impl Whose<'_> {
    fn code(self) -> &'static str {
        match self {
            Self::Solution => "staff::solution",
            Self::Mutant(_) => "staff::mutant",
        }
    }

    fn words(self) -> String {
        match self {
            Self::Solution => "the reference solution".to_owned(),
            Self::Mutant(mutant) => format!("mutant `{}`", mutant.name),
        }
    }
}

/// Refuses a submission that is no program.
pub(super) fn refuse_unbuilt(
    lab: &Lab,
    task: Option<&str>,
    whose: Whose<'_>,
    source: &Source,
) -> Result<(), LabError> {
    let mut tasks = lab.tasks.iter();
    let Some(task) = tasks.find(|known| task.is_none_or(|name| known.name == name)) else {
        return Ok(());
    };
    match ScriptController::open(&opening(lab, task, source)) {
        Ok(_) => Ok(()),
        Err(stop) => fault(whose, None, source, &stop).map_or(Ok(()), Err),
    }
}

/// `stop` as an error at its line of `source`; none where the submission is not at fault.
pub(crate) fn fault(
    whose: Whose<'_>,
    task: Option<&Task>,
    source: &Source,
    stop: &Stop,
) -> Option<LabError> {
    match stop {
        Stop::HostLimit(_) | Stop::GraderFault(_) | Stop::Interrupted => return None,
        Stop::DidNotBuild(_) | Stop::Missing { .. } | Stop::Crashed(_) => {}
        Stop::OverBudget { .. } => {}
    }
    let record = stopped::record(stop, source.text());
    let what = match task {
        Some(task) => format!("{} stops in task `{}`", whose.words(), task.name),
        None => format!("{} is no program", whose.words()),
    };
    let problem = LabProblem {
        message: format!("{what}: {}", record.message),
        code: whose.code(),
        label: "here".to_owned(),
        help: record.help,
    };
    let at = record.line.map_or(0..0, |line| {
        word_at(source.text(), line, record.column.unwrap_or(1))
    });
    Some(LabError::new(problem, source, at))
}

/// The bytes of the word at a line and a column, both from one.
fn word_at(text: &str, line: usize, column: usize) -> Range<usize> {
    // an editor's mark of the encoding is not counted by who reads scripts
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
        // beyond the last line and the last column there is nothing
        assert_eq!(&text[word_at(text, 9, 9)], "");
        assert_eq!(&text[word_at(text, 3, 2)], "");
        assert_eq!(word_at("", 1, 1), 0..0);
        let marked = "\u{feff}fnn a";
        assert_eq!(&marked[word_at(marked, 1, 1)], "fnn");
    }
}
