//! What a submission printed, at the line of its source that printed it.

use std::collections::BTreeMap;

use maud::{Markup, html};

use super::foreign;
use super::viewer::seek;
use crate::visible::shortened;
use kinemark_grader::record::grade::{TaskGrade, TaskKind};
use kinemark_grader::record::graded::{GradedRun, TaskRun};

/// Printed lines that are shown open at a line of the source; more are folded.
const MOST_OPEN: usize = 2;
/// Printed lines that are shown at a line of the source.
const MOST_OF_A_LINE: usize = 8;
/// Printed lines that are shown in all, so that a page stays small.
const MOST: usize = 300;
/// Characters of a printed line that are shown.
const MOST_CHARACTERS: usize = 200;

/// The printed lines of a grade, by the line of the source.
#[derive(Debug, Default)]
pub(super) struct Printed<'a> {
    by_line: BTreeMap<usize, OfLine<'a>>,
}

/// What one line of the source printed.
#[derive(Debug, Default)]
struct OfLine<'a> {
    /// All of it, counted.
    count: usize,
    /// The first of it: when, and the text.
    first: Vec<(Markup, &'a str)>,
}

impl<'a> Printed<'a> {
    /// The printed lines of all tasks, in their order; `has_replay` says of a task whether its page can lead to a moment.
    pub(super) fn of(graded: &'a GradedRun, has_replay: impl Fn(usize) -> bool) -> Self {
        let mut printed = Self::default();
        let mut shown = 0;
        for (i, task) in graded.grade.tasks.iter().enumerate() {
            let run = graded.runs.iter().find(|run| run.task == task.name);
            for (at, line, text) in lines(task, run) {
                let Some(line) = line else { continue };
                let here = printed.by_line.entry(line).or_default();
                here.count += 1;
                if here.first.len() < MOST_OF_A_LINE && shown < MOST {
                    shown += 1;
                    here.first.push((when(task, run, has_replay(i), at), text));
                }
            }
        }
        printed
    }

    /// What a line of the source printed, below it.
    pub(super) fn at(&self, line: usize) -> Markup {
        let Some(OfLine { count, first }) = self.by_line.get(&line) else {
            return html! {};
        };
        let one = |(when, text): &(Markup, &str)| {
            html! { (when) ": " code { (foreign(&shortened(text, MOST_CHARACTERS))) } }
        };
        html! {
            @if *count <= MOST_OPEN && first.len() == *count {
                @for printed in first { p class="printed" { "printed " (one(printed)) } }
            } @else {
                details class="printed" {
                    summary { "printed " (count) " lines" }
                    ul { @for printed in first { li { (one(printed)) } } }
                    @if first.len() < *count { p { "The first " (first.len()) " of " (count) "." } }
                }
            }
        }
    }
}

/// The printed lines of a task that are kept: of a run more than its record has.
fn lines<'a>(task: &'a TaskGrade, run: Option<&'a TaskRun>) -> Vec<(u64, Option<usize>, &'a str)> {
    match run {
        Some(run) if run.trace.log.len() > task.log.len() => {
            let lines = run.trace.log.iter();
            lines
                .map(|line| (line.tick, line.line, line.text.as_str()))
                .collect()
        }
        _ => {
            let entries = task.log.iter();
            entries
                .map(|entry| (entry.at, entry.line, entry.text.as_str()))
                .collect()
        }
    }
}

/// When it was printed: the task, and the moment or the case.
fn when(task: &TaskGrade, run: Option<&TaskRun>, has_replay: bool, at: u64) -> Markup {
    let time = |run: &TaskRun| {
        let time_s = at as f64 * run.trace.step_s;
        let words = format!("{time_s:.3} s");
        match has_replay {
            true => seek(&task.name, time_s, &words),
            false => html! { (words) },
        }
    };
    html! {
        "in " (foreign(&task.name))
        @match (task.kind, run) {
            (TaskKind::Motion, Some(run)) => { " at " (time(run)) }
            (TaskKind::Motion, None) => { " at tick " (at) }
            (TaskKind::Function, _) => { ", case " (at) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::grade::LogEntry;
    use kinemark_grader::record::sample;

    fn entry(at: u64, text: &str, line: Option<usize>) -> LogEntry {
        LogEntry {
            at,
            text: text.to_owned(),
            line,
        }
    }

    /// The sample, of whose tasks one function alone prints.
    fn printing(log: Vec<LogEntry>) -> GradedRun {
        let mut graded = sample::graded();
        graded.runs.clear();
        for task in &mut graded.grade.tasks {
            task.log.clear();
        }
        let mut tasks = graded.grade.tasks.iter_mut();
        let function = tasks.find(|task| task.kind == TaskKind::Function);
        function.expect("a function task").log = log;
        graded
    }

    #[test]
    fn a_few_lines_stand_open_below_the_line_that_printed_them() {
        let graded = printing(vec![
            entry(0, "q = <1>", Some(4)),
            entry(1, "other", Some(9)),
            entry(1, "q = 2", Some(4)),
            entry(1, "a note of the grader", None),
        ]);
        let printed = Printed::of(&graded, |_| false);
        let at = printed.at(4).into_string();
        assert_eq!(at.matches("<p class=\"printed\">").count(), 2, "{at}");
        assert!(at.find("q = &lt;1&gt;") < at.find("q = 2"), "{at}");
        assert!(
            at.contains("</bdi>, case 0") && at.contains("</bdi>, case 1"),
            "{at}"
        );
        assert!(!at.contains("other") && !at.contains("details"), "{at}");
        assert!(printed.at(9).into_string().contains("other"));
        assert!(printed.at(5).into_string().is_empty());
    }

    #[test]
    fn many_lines_are_counted_and_folded() {
        let many = (0..120).map(|i| entry(i, &format!("text {i}."), Some(2)));
        let graded = printing(many.collect());
        let at = Printed::of(&graded, |_| false).at(2).into_string();
        assert!(at.contains("<summary>printed 120 lines</summary>"), "{at}");
        assert_eq!(at.matches("<li>").count(), MOST_OF_A_LINE);
        assert!(at.contains("The first 8 of 120."), "{at}");
        assert!(at.contains("text 7.") && !at.contains("text 8."), "{at}");
    }

    #[test]
    fn a_moment_of_a_run_is_led_to_and_lines_beyond_the_record_count() {
        let graded = sample::graded();
        let run = &graded.runs[0];
        let task = graded
            .grade
            .tasks
            .iter()
            .position(|task| task.name == run.task);
        let at = Printed::of(&graded, |i| Some(i) == task)
            .at(2)
            .into_string();
        // the run has three lines, its record two
        assert!(at.contains("printed 3 lines"), "{at}");
        assert!(at.contains("class=\"seek\""), "{at}");
        let without = Printed::of(&graded, |_| false).at(2).into_string();
        assert!(without.contains("at 0.000 s") && !without.contains("href"));
    }

    #[test]
    fn what_is_shown_on_a_page_is_bounded() {
        let many = (0..2_000).map(|i| entry(i, &"\u{202E}".repeat(5_000), Some(i as usize % 500)));
        let graded = printing(many.collect());
        let printed = Printed::of(&graded, |_| false);
        let bytes: usize = (0..500)
            .map(|line| printed.at(line).into_string().len())
            .sum();
        assert!(bytes < 700_000, "{bytes}");
    }
}
