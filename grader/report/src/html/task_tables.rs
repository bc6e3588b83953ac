//! The tables of a task: cases, hidden ones, events, contacts, and what was printed.

use maud::{Markup, html};

use super::case_columns::CaseColumns;
use super::task_check::is_of_hidden_run;
use super::task_shown::TaskShown;
use super::{foreign, prose};
use crate::initial_contact::begins_initial;
use crate::visible::{shortened, visible};
use kinemark_grader::record::grade::{
    CaseGrade, ContactRecord, EventRecord, HiddenClass, LogEntry, TaskGrade, TaskKind,
};
use kinemark_grader::record::quantity::with_unit;
use kinemark_grader::record::shown_case::ShownCases;

/// Lines of the log that are shown.
const MOST_LINES: usize = 200;
/// Characters of a line that are shown.
const MOST_CHARACTERS: usize = 1000;
/// Cases that are shown.
const MOST_CASES: usize = 200;

/// Visible cases with what was answered; `shown` says which entries of a wrong answer are wrong.
pub(super) fn cases(cases: &[CaseGrade], shown: Option<&ShownCases>) -> Markup {
    let shows_expected = cases.iter().any(|case| case.expected.is_some());
    let given = CaseColumns::of(cases.iter().map(|case| case.given.as_str()));
    let answer = CaseColumns::of(cases.iter().map(|case| case.answer.as_str()));
    let expected = CaseColumns::of(cases.iter().filter_map(|case| case.expected.as_deref()));
    let is_named = [&given, &answer, &expected]
        .iter()
        .any(|part| part.is_named());
    let rows = is_named.then_some("2");
    let plain = |title: &str, class: Option<&str>| html! { th scope="col" class=[class] rowspan=[rows] { (title) } };
    html! {
        div class="wide" tabindex="0" role="group" aria-label="Visible cases" {
            table class="cases" {
                thead {
                    tr {
                        (plain("Case", None))
                        (given.heading("Given", is_named))
                        (answer.heading("Your answer", is_named))
                        @if shows_expected { (expected.heading("Expected", is_named)) }
                        (plain("Error", Some("number")))
                        (plain("Good", None))
                    }
                    @if is_named { tr { (given.named()) (answer.named()) @if shows_expected { (expected.named()) } } }
                }
                tbody {
                    @for case in cases.iter().take(MOST_CASES) {
                        tr {
                            th scope="row" { (foreign(&case.name)) }
                            (given.cells(&case.given, |_| false))
                            (answer.cells(&case.answer, |entry| is_wrong(shown, &case.name, entry)))
                            @if shows_expected { (expected.cells(case.expected.as_deref().unwrap_or_default(), |_| false)) }
                            td class="number" { @match (case.error_m, case.relative_error) { (Some(error_m), _) => (with_unit(error_m, "m")), (_, Some(relative)) => (with_unit(relative, "")), _ => "–" } }
                            td { @if case.good { span class="pill full" { "yes" } } @else { span class="pill none" { "no" } } }
                        }
                    }
                }
            }
        }
        @if cases.len() > MOST_CASES { p class="quiet" { "The first " (MOST_CASES) " of " (cases.len()) " cases." } }
    }
}

/// Whether an entry of the answer to a case is wrong, as far as that is known.
fn is_wrong(shown: Option<&ShownCases>, case: &str, entry: &str) -> bool {
    let mut cases = shown.into_iter().flat_map(|shown| &shown.cases);
    let shown = cases.find(|shown| shown.name == case);
    let mut entries = shown.into_iter().flat_map(|shown| &shown.numbers);
    entries.any(|numbers| {
        numbers.name == entry && numbers.numbers.iter().any(|number| !number.is_right)
    })
}

/// Hidden cases or runs by class: only their number is shown, and of runs the checks that lost points in them.
pub(super) fn hidden(id: &str, task: &TaskGrade) -> Markup {
    let what = match task.kind {
        TaskKind::Function => "Hidden cases",
        TaskKind::Motion => "Hidden runs",
    };
    let lost_in = |class: &HiddenClass| -> Vec<&str> {
        let lost = task.checks.iter().filter(|check| {
            let mut facts = check.evidence.iter();
            facts.any(|fact| is_of_hidden_run(fact) && fact.case.as_ref() == Some(&class.class))
        });
        lost.map(|check| check.title.as_str()).collect()
    };
    let shows_losses =
        task.kind == TaskKind::Motion && task.hidden.iter().any(|class| !lost_in(class).is_empty());
    html! {
        h3 id={ (id) "-hidden" } { (what) }
        div class="wide" tabindex="0" role="group" aria-label=(what) {
            table class="hidden" {
                thead {
                    tr {
                        th scope="col" { "Class" }
                        th scope="col" class="number" { "Good" }
                        @if shows_losses { th scope="col" { "Points lost by" } }
                    }
                }
                tbody {
                    @for class in &task.hidden {
                        tr {
                            th scope="row" { (foreign(&class.class)) }
                            td class="number" { (class.good) " of " (class.total) }
                            @if shows_losses { td { (foreign(&lost_in(class).join("; "))) } }
                        }
                    }
                }
            }
        }
    }
}

/// What happened in the run.
pub(super) fn events(events: &[EventRecord], of: &TaskShown<'_>) -> Markup {
    // that something rested on another before the arm moved is no news; it is listed below
    let resting: Vec<(u64, String)> = of.run.map_or_else(Vec::new, |run| {
        let names = run.names();
        let standing = run
            .trace
            .events
            .iter()
            .filter(|event| begins_initial(&event.kind, event.tick, run));
        standing
            .map(|event| (event.tick, names.event(&event.kind)))
            .collect()
    });
    let rests = |event: &&EventRecord| {
        let mut resting = resting.iter();
        resting.any(|(tick, words)| *tick == event.tick && *words == event.message)
    };
    let (resting, news): (Vec<_>, Vec<_>) = events.iter().partition(rests);
    let before = html! {
        @if !resting.is_empty() {
            p class="quiet" {
                "Before anything moved: "
                @for (i, event) in resting.iter().enumerate() { @if i > 0 { "; " } (prose(&event.message)) }
                "."
            }
        }
    };
    // there is nothing to unfold
    if news.is_empty() {
        return before;
    }
    html! {
        details class="log" {
            summary { "What happened: " (news.len()) @if news.len() == 1 { " event" } @else { " events" } }
            div class="wide" tabindex="0" role="group" aria-label="Events" {
                table {
                    thead { tr { th scope="col" class="number" { "At" } th scope="col" { "Event" } th scope="col" { "What" } } }
                    tbody {
                        @for event in news {
                            tr {
                                td class="number" { (of.moment(event.time_s, &format!("{:.3} s", event.time_s))) }
                                td { (visible(&event.event)) }
                                td { (prose(&event.message)) }
                            }
                        }
                    }
                }
            }
            (before)
        }
    }
}

/// What touched what.
pub(super) fn contacts(contacts: &[ContactRecord], of: &TaskShown<'_>) -> Markup {
    // those of the arm first, each in the order of time
    let is_link = |name: &String| {
        let mut links = of.run.into_iter().flat_map(|run| run.robot.links());
        links.any(|link| link.name == *name)
    };
    let mut contacts: Vec<&ContactRecord> = contacts.iter().collect();
    contacts.sort_by_key(|contact| !contact.parties.iter().any(is_link));
    html! {
        details class="log" {
            summary { "Contact: " (contacts.len()) @if contacts.len() == 1 { " time" } @else { " times" } }
            div class="wide" tabindex="0" role="group" aria-label="Contacts" {
                table {
                    thead {
                        tr {
                            th scope="col" { "Between" }
                            th scope="col" class="number" { "From" }
                            th scope="col" class="number" { "Until" }
                            th scope="col" class="number" { "Peak force" }
                            th scope="col" class="number" { "Impulse" }
                        }
                    }
                    tbody {
                        @for contact in contacts {
                            tr {
                                th scope="row" { (foreign(&contact.parties[0])) " and " (foreign(&contact.parties[1])) }
                                td class="number" { (of.tick(contact.first_tick)) }
                                td class="number" { (of.tick(contact.last_tick)) }
                                td class="number" { (format!("{:.3} N", contact.peak_force_n)) }
                                td class="number" { (format!("{:.4} N s", contact.impulse_n_s)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// What the submission printed.
pub(super) fn log(task: &TaskGrade, of: &TaskShown<'_>) -> Markup {
    let all = of
        .run
        .map_or(0, |run| run.trace.log.len())
        .max(task.log.len());
    let shown = task.log.len().min(MOST_LINES);
    let shows_line = task.log.iter().any(|entry| entry.line.is_some());
    let at = |entry: &LogEntry| match of.kind {
        TaskKind::Motion => of.tick(entry.at),
        TaskKind::Function => html! { "case " (entry.at) },
    };
    html! {
        details class="log" {
            summary {
                "Printed by the submission: " (all) @if all == 1 { " line" } @else { " lines" }
                @if all > shown { ", the first " (shown) " shown" }
            }
            div class="wide" tabindex="0" role="group" aria-label="Printed lines" {
                table {
                    thead { tr { th scope="col" class="number" { "At" } @if shows_line { th scope="col" { "By" } } th scope="col" { "Text" } } }
                    tbody {
                        @for entry in task.log.iter().take(MOST_LINES) {
                            tr {
                                td class="number" { (at(entry)) }
                                @if shows_line { td class="by" { @if let Some(line) = entry.line { (of.line(line)) } } }
                                td { code { (foreign(&shortened(&entry.text, MOST_CHARACTERS))) } }
                            }
                        }
                    }
                }
            }
        }
    }
}
