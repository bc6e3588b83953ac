//! One task: what stopped it, what the mistake may be, every check with its evidence, cases, plots, and what was printed.

use kinemark_sim::text::number::seconds;
use maud::{Markup, html};

use super::chapters::chapters;
use super::figure::figure;
use super::head::{anchor, earned, meaning, verdict};
use super::shown_cases::drawn_cases;
use super::source::{ScriptLines, pointed, prose_with_lines};
use super::task_check::checked;
use super::task_shown::TaskShown;
use super::task_tables::{cases, contacts, events, hidden, log};
use super::viewer::place;
use super::{foreign, prose};
use crate::moment::{FirstLoss, first_loss_of, last_before};
use crate::plot::Plot;
use crate::stop_words::is_never_run;
use crate::text::{kept_words, unresolved, unresolved_hidden};
use crate::visible::{file_stem, visible};
use kinemark_grader::record::grade::{
    CheckGrade, Diagnosis, Divergence, FurtherMistake, Outcome, Stopped, TaskGrade, TaskKind,
};
use kinemark_grader::record::graded::TaskRun;
use kinemark_grader::record::quantity::with_unit;
use kinemark_grader::record::shown_case::ShownCases;
use kinemark_grader::record::verdict::Verdict;

/// The section of a task.
pub(super) fn section(
    index: usize,
    task: &TaskGrade,
    run: Option<(&TaskRun, &[Plot])>,
    shown_cases: Option<&ShownCases>,
    has_replay: bool,
    script: Option<&ScriptLines<'_>>,
    has_all_chapters: bool,
) -> Markup {
    let id = anchor(index);
    let plots = run.map_or(&[][..], |(_, plots)| plots);
    let of = TaskShown {
        name: &task.name,
        kind: task.kind,
        run: run.map(|(run, _)| run),
        has_replay,
        cases: shown_cases,
        stopped: task
            .stopped
            .as_ref()
            .is_some_and(|stop| stop.kept.is_none()),
        hints: None,
        script,
    };
    let passed = task.verdict == Verdict::Passed;
    if let Some(stop) = task.stopped.as_ref().filter(|_| is_never_run(task)) {
        return section_never_run(&id, task, stop, &of);
    }
    html! {
        section class={ "task" @if passed { " passed" } } id=(id) data-task=(visible(&task.name)) aria-labelledby={ (id) "-title" } {
            (title(&id, task))
            p class="lead" { (meaning(task.verdict, task.checks.iter())) }
            @if let Some(loss) = first_loss_of(task) { (first_lost(&loss, &of)) }
            @if let Some(stop) = &task.stopped { (stopped(stop, &of)) }
            @for diagnosis in &task.diagnoses { (diagnosed(diagnosis, task.kind)) }
            @if let Some((run, _)) = run.filter(|_| has_all_chapters || !passed) { (chapters(index, run, task)) }
            @if has_replay { (place(index, &task.name)) }
            // a task without a mistake is read by who wants to know more
            @if passed {
                details class="more" { summary { (contents(task, plots)) } (details_of(&id, task, plots, &of)) }
            } @else {
                (details_of(&id, task, plots, &of))
            }
        }
    }
}

/// The section of a task of which nothing was run, such as one whose function is missing: it says so once.
fn section_never_run(id: &str, task: &TaskGrade, stop: &Stopped, of: &TaskShown<'_>) -> Markup {
    html! {
        section class="task" id=(id) data-task=(visible(&task.name)) aria-labelledby={ (id) "-title" } {
            (title(id, task))
            (stopped(stop, of))
            p class="lead" {
                "Nothing of this task was run, so "
                @match task.checks.len() { 1 => "its check was not judged.", many => { "none of its " (many) " checks was judged." } }
            }
        }
    }
}

/// The title of a task's section, with its points; a link to the task leads to it.
fn title(id: &str, task: &TaskGrade) -> Markup {
    html! {
        div class="title" id={ "task=" (visible(&task.name)) } {
            h2 id={ (id) "-title" } { (foreign(&task.title)) }
            p { (verdict(task.verdict, task.points)) " " (earned(task.points, task.max_points)) }
        }
    }
}

/// The anchor of what kept the whole file from being run.
const NOT_RUN: &str = "not-run";

/// What kept the whole file from being run: said once, for all tasks.
pub(super) fn not_run(stop: &Stopped, script: Option<&ScriptLines<'_>>) -> Markup {
    let of = TaskShown {
        name: "",
        kind: TaskKind::Function,
        run: None,
        has_replay: false,
        cases: None,
        stopped: true,
        hints: None,
        script,
    };
    html! {
        section class="task" id=(NOT_RUN) aria-labelledby={ (NOT_RUN) "-title" } {
            h2 id={ (NOT_RUN) "-title" } { "Nothing of it could be run" }
            (stopped(stop, &of))
            p class="lead" { "No check was judged. Fix this first; then the report shows every task." }
        }
    }
}

/// What is folded away of a task without a mistake.
fn contents(task: &TaskGrade, plots: &[Plot]) -> String {
    let all = [
        (!task.checks.is_empty(), "checks"),
        (!task.cases.is_empty(), "cases"),
        (!plots.is_empty(), "plots"),
        (
            !(task.events.is_empty() && task.contacts.is_empty()),
            "what happened",
        ),
        (!task.log.is_empty(), "printed lines"),
    ];
    let parts: Vec<&str> = all
        .into_iter()
        .filter_map(|(is_there, part)| is_there.then_some(part))
        .collect();
    let text = match parts.as_slice() {
        [parts @ .., last] if !parts.is_empty() => format!("{} and {last}", parts.join(", ")),
        parts => parts.concat(),
    };
    let mut letters = text.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => "More".to_owned(),
    }
}

/// What a task shows below its replay: checks, those that lost points first and each with the picture of what it judged; then
/// cases, hidden ones, the other pictures, and what happened.
fn details_of(id: &str, task: &TaskGrade, plots: &[Plot], of: &TaskShown<'_>) -> Markup {
    let (full, lost): (Vec<&CheckGrade>, Vec<&CheckGrade>) = task
        .checks
        .iter()
        .partition(|check| check.outcome == Outcome::Full);
    let judged = |check: &CheckGrade| {
        let name = format!("{}-check-{}", file_stem(&task.name), file_stem(&check.name));
        plots.iter().find(|plot| plot.name == name)
    };
    let beside: Vec<&Plot> = lost.iter().filter_map(|check| judged(check)).collect();
    let others = || plots.iter().filter(|plot| !beside.contains(plot));
    let has_others = others().next().is_some();
    html! {
        @if let Some(event) = task.first_unresolved() { p class="lead" { "Note: " (prose(&unresolved(event))) "." } }
        @if task.unresolved_hidden() > 0 { p class="lead" { "Note: " (unresolved_hidden(task)) "." } }
        @if let Some(differs) = &task.divergence { (differing(differs, of)) }
        @if !task.checks.is_empty() { h3 { "Checks" } }
        @if !lost.is_empty() {
            ul class="checks" { @for check in &lost { li { (checked(check, judged(check), id, of)) } } }
        }
        @if !full.is_empty() {
            @let list = html! { ul class="checks" { @for check in &full { li { (checked(check, None, id, of)) } } } };
            @if lost.is_empty() {
                (list)
            } @else {
                details class="more" {
                    summary { @if full.len() == 1 { "1 check" } @else { (full.len()) " checks" } " with all points" }
                    (list)
                }
            }
        }
        @if !task.cases.is_empty() {
            h3 { "Visible cases" }
            @if let Some(shown) = of.cases { (drawn_cases(shown, &task.cases)) }
            (cases(&task.cases, of.cases))
        }
        @if !task.hidden.is_empty() { (hidden(id, task)) }
        @if has_others {
            h3 { "Plots" }
            div class="plots" { @for plot in others() { (figure(plot, &task.name)) } }
        }
        @if !task.events.is_empty() { (events(&task.events, of)) }
        @if !task.contacts.is_empty() { (contacts(&task.contacts, of)) }
        @if !task.log.is_empty() { (log(task, of)) }
    }
}

/// The moment at which the first points were lost, and the check; a stop has a note of its own.
fn first_lost(loss: &FirstLoss<'_>, of: &TaskShown<'_>) -> Markup {
    html! {
        @if let (Some(at), Some(check)) = (loss.at, loss.check) {
            p class="quiet" { "Points were lost at " (of.moment(at.time_s, &seconds(at.time_s))) ", " (foreign(&check.title)) "." }
        }
    }
}

/// What stopped the submission, with the line it happened in.
pub(super) fn stopped(stop: &Stopped, of: &TaskShown<'_>) -> Markup {
    html! {
        div class="note bad" {
            h3 { "What stopped it" }
            p { (prose_with_lines(&stop.message, of.script)) }
            p class="where" {
                @if let Some(line) = stop.line {
                    span { (of.line(line)) @if let Some(column) = stop.column { ", column " (column) } }
                }
                @if let Some(t_s) = stop.time_s {
                    // what is shown ends with the tick before
                    span { "at " @match last_before(stop) { Some(last) => (of.moment(last.time_s, &seconds(t_s))), None => (seconds(t_s)) } }
                }
                @if let Some(tick) = stop.tick { span { "tick " (tick) } }
                @if let Some(case) = &stop.case { span { "case " (foreign(case)) } }
            }
            (pointed(stop, of.script))
            @if let Some(kept) = stop.kept { p { (kept_words(stop, kept)) } }
            @if let Some(help) = &stop.help { p class="next" { strong { "Next: " } (prose_with_lines(help, of.script)) } }
            @if !stop.further.is_empty() {
                p { "Also:" }
                ul { @for further in &stop.further { li { (also(further, of)) } } }
            }
        }
    }
}

/// What else is wrong, with its lines.
fn also(further: &FurtherMistake, of: &TaskShown<'_>) -> Markup {
    html! {
        @for (i, line) in further.lines.iter().enumerate() { @if i > 0 { ", " } (of.line(*line)) }
        ": " (prose_with_lines(&further.help, of.script))
    }
}

pub(super) fn diagnosed(diagnosis: &Diagnosis, kind: TaskKind) -> Markup {
    let noun = match kind {
        TaskKind::Function => "answers in",
        TaskKind::Motion => "moments at",
    };
    html! {
        div class="note hint" {
            h3 { "It looks like this" }
            p { (prose(&diagnosis.says)) }
            p class="where" {
                span { (diagnosis.agreeing) " of the " (diagnosis.telling) " " (noun) " which this mistake would show agree with it" }
            }
        }
    }
}

/// Where to look first; no statement that anything is wrong there.
fn differing(differs: &Divergence, of: &TaskShown<'_>) -> Markup {
    html! {
        div class="note hint" {
            h3 { "Compared with the reference solution" }
            p { "It differs from here on: " (prose(&differs.message)) }
            p class="where" {
                span { "at " (of.moment(differs.time_s, &seconds(differs.time_s))) }
                span { "tick " (differs.tick) }
                span { "signal " code { (foreign(&differs.signal)) } }
                span { "less than " (visible(&with_unit(differs.tolerance, &differs.unit))) " apart counts as the same" }
            }
            p { "It is not a mistake by itself: another path, or another time, may be as right." }
        }
    }
}
