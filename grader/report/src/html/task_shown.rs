//! The task that a part of the page is about, and links to its moments.

use maud::{Markup, html};

use super::source::ScriptLines;
use super::viewer::seek;
use kinemark_grader::record::grade::TaskKind;
use kinemark_grader::record::graded::TaskRun;
use kinemark_grader::record::hints::Hints;
use kinemark_grader::record::shown_case::ShownCases;

/// The task that a part of the page is about.
pub(super) struct TaskShown<'a> {
    pub(super) name: &'a str,
    pub(super) kind: TaskKind,
    pub(super) run: Option<&'a TaskRun>,
    pub(super) has_replay: bool,
    /// The cases of a function task that are drawn.
    pub(super) cases: Option<&'a ShownCases>,
    /// Whether something stopped the submission, with nothing left to judge.
    pub(super) stopped: bool,
    /// The hints that the course staff release; without them the page names the command that unfolds them.
    pub(super) hints: Option<&'a Hints>,
    /// The submission, where the page shows it.
    pub(super) script: Option<&'a ScriptLines<'a>>,
}

impl TaskShown<'_> {
    /// Words that lead to a moment, where there is a replay to lead to.
    pub(super) fn moment(&self, time_s: f64, words: &str) -> Markup {
        if self.has_replay {
            seek(self.name, time_s, words)
        } else {
            html! { (words) }
        }
    }

    /// A line of the submission, which leads there where the page shows it.
    pub(super) fn line(&self, number: usize) -> Markup {
        let words = format!("line {number}");
        match self.script {
            Some(script) => script.link(number, &words),
            None => html! { (words) },
        }
    }

    /// A tick as its time, where that is known.
    pub(super) fn tick(&self, tick: u64) -> Markup {
        match self.run {
            Some(run) => {
                let time_s = tick as f64 * run.trace.step_s;
                self.moment(time_s, &format!("{time_s:.3} s"))
            }
            None => html! { "tick " (tick) },
        }
    }
}
