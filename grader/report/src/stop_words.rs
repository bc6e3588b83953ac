//! What stopped a submission, in words: where it happened, whether anything of it could be run at all, and sentences that end.

use kinemark_sim::text::number::seconds;

use super::visible::{shortened, visible};
use kinemark_grader::record::grade::{Grade, Stopped, TaskGrade};
use kinemark_grader::record::verdict::Verdict;

/// The most characters of a message or a line that a paragraph has.
const MOST_CHARACTERS: usize = 300;

/// What kept the whole file from being run: it does not build, or is larger than a submission may be. It is the same in all tasks.
pub(crate) fn stop_of_whole_file(grade: &Grade) -> Option<&Stopped> {
    let first = grade.tasks.first()?;
    let stopped = first.stopped.as_ref()?;
    let concerns_file = matches!(first.verdict, Verdict::DidNotBuild | Verdict::OverBudget)
        && stopped.case.is_none()
        && stopped.tick.is_none();
    let is_equal = |task: &TaskGrade| task.stopped.as_ref() == Some(stopped);
    (concerns_file && grade.tasks.iter().all(is_equal)).then_some(stopped)
}

/// Whether the function of the task is missing, or has other parameters than the lab calls it with: nothing of the task was run.
pub(crate) fn is_missing_function(task: &TaskGrade) -> bool {
    let is_of_no_call = |stopped: &Stopped| stopped.case.is_none() && stopped.tick.is_none();
    task.verdict == Verdict::Missed && task.stopped.as_ref().is_some_and(is_of_no_call)
}

/// Whether nothing of a task was run, because of the submission: its function is missing, or the file is no program.
pub(crate) fn is_never_run(task: &TaskGrade) -> bool {
    let is_of_no_call = |stopped: &Stopped| stopped.case.is_none() && stopped.tick.is_none();
    let is_of_submission = matches!(
        task.verdict,
        Verdict::Missed | Verdict::DidNotBuild | Verdict::OverBudget
    );
    is_of_submission && task.stopped.as_ref().is_some_and(is_of_no_call)
}

/// What stopped it, with the line where that is known: `a bracket is missing (line 3: "}")`.
pub(crate) fn message_with_line(stopped: &Stopped) -> String {
    let message = shortened(&stopped.message, MOST_CHARACTERS);
    let message = message.trim_end_matches('.');
    match (stopped.line, &stopped.source_line) {
        (Some(line), Some(source)) => {
            format!(
                "{message} (line {line}: \"{}\")",
                shortened(source.trim(), MOST_CHARACTERS)
            )
        }
        (Some(line), None) => format!("{message} (line {line})"),
        (None, _) => message.to_owned(),
    }
}

/// When and in which case of `task` it happened: ` at 0.5 s`, ` in the case "straight up"`, ` in a hidden case of the class "out of reach"`.
pub(crate) fn moment_of_stop(task: &TaskGrade, stopped: &Stopped) -> String {
    let mut words = String::new();
    if let Some(time_s) = stopped.time_s {
        words += &format!(" at {}", seconds(time_s));
    }
    if let Some(case) = &stopped.case {
        let is_visible = task.cases.iter().any(|known| known.name == *case);
        let kind = if is_visible {
            "the case"
        } else {
            "the hidden class"
        };
        words += &format!(" in {kind} \"{}\"", visible(case));
    }
    words
}

/// Text as a sentence: with a full stop, unless it ends already.
pub(crate) fn sentence(text: &str) -> String {
    let text = text.trim_end();
    if text.ends_with(['.', '!', '?', '…']) {
        text.to_owned()
    } else {
        format!("{text}.")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_ends_once() {
        assert_eq!(
            sentence("from a division by zero"),
            "from a division by zero."
        );
        assert_eq!(sentence("Add damping. "), "Add damping.");
        assert_eq!(sentence("Does it end?"), "Does it end?");
    }

    #[test]
    fn a_stop_has_its_line_where_there_is_one() {
        let mut stopped = Stopped {
            message: "a `]` is missing before this".to_owned(),
            line: Some(3),
            source_line: Some("  }\u{202E}".to_owned()),
            ..Stopped::default()
        };
        assert_eq!(
            message_with_line(&stopped),
            "a `]` is missing before this (line 3: \"}⟨U+202E⟩\")"
        );
        stopped.source_line = None;
        stopped.line = None;
        assert_eq!(message_with_line(&stopped), "a `]` is missing before this");
    }
}
