//! A check of a task: what it measured, its evidence, and what to do next.

use kinemark_sim::text::number::seconds;
use maud::{Markup, html};

use super::band::{gauge, measure_text, outcome};
use super::costs::check_anchor;
use super::figure::figure;
use super::head::earned;
use super::task_shown::TaskShown;
use super::{foreign, kept_with_units, prose};
use crate::plot::Plot;
use crate::text::loss_without_evidence;
use crate::visible::visible;
use kinemark_grader::record::grade::{CheckGrade, Evidence, Outcome, TaskKind};
use kinemark_grader::record::hints;
use kinemark_grader::record::quantity::with_unit;

/// A check, with the picture of what it judged beside it.
pub(super) fn checked(
    check: &CheckGrade,
    plot: Option<&Plot>,
    id: &str,
    of: &TaskShown<'_>,
) -> Markup {
    let is_hidden = |fact: &&Evidence| of.kind == TaskKind::Motion && is_of_hidden_run(fact);
    let shown: Vec<&Evidence> = check
        .evidence
        .iter()
        .filter(|fact| !is_hidden(fact))
        .collect();
    let hides = shown.len() < check.evidence.len();
    let has_shown = !shown.is_empty();
    html! {
        article id=(check_anchor(id, check)) class=(if plot.is_some() { "check pictured" } else { "check" }) {
            div class="title" {
                h4 { (foreign(&check.title)) }
                p { (outcome(check)) " " (earned(check.points, check.max_points)) }
            }
            div class="findings" {
                @if let Some(measure) = &check.measure {
                    @let measured = measure_text(measure);
                    div class="measure" {
                        p {
                            (prose(&measure.quantity)) ": " b { (measured.value) }
                            @if let Some(margin) = measured.margin { ", " (margin) }
                            br; small { (measured.band) }
                            @if let Some(beside) = measured.beside { br; small { (beside) } }
                        }
                        (gauge(measure))
                    }
                } @else if check.outcome == Outcome::AtHandIn {
                    p class="quiet" { "Judged with the reference solution, when you hand in. These points are not among those above." }
                } @else if check.outcome == Outcome::NotJudged {
                    p class="quiet" {
                        "Not judged: "
                        @if of.stopped { "the submission was stopped before." }
                        @else if check.next_step.is_some() { "a check that it needs earned nothing." }
                        @else { "nothing is decided." }
                    }
                }
                @if has_shown {
                    ul class="evidence" { @for fact in shown { li { (evidence(fact, of)) } } }
                }
                @if hides { p class="where" { a href={ "#" (id) "-hidden" } { "Points were lost in hidden runs" @if has_shown { ", too" } } } }
                @if let Some(next) = &check.next_step { p class="next" { strong { "Next: " } (prose(next)) } }
                (hints(check, of))
            }
            @if let Some(first) = loss_without_evidence(check) {
                p class="where" { span { "points are lost from " (of.moment(first.time_s, &seconds(first.time_s))) " on" } span { "tick " (first.tick) } }
            }
            @if let Some(plot) = plot { div class="plots" { (figure(plot, of.name)) } }
        }
    }
}

/// The hints behind the next step: the steps themselves where the course staff release them, else the command that unfolds them.
fn hints(check: &CheckGrade, of: &TaskShown<'_>) -> Markup {
    let steps = of.hints.map(|hints| hints.behind_next_step(of.name, check));
    html! {
        @match steps {
            Some([]) => {}
            Some(steps) => ol class="hints" { @for step in steps { li { (prose(step)) } } },
            None => @if check.has_hints {
                p class="where" { "Step by step: " code { "kinemark hint " (hints::name(of.name, &check.name)) } }
            }
        }
    }
}

/// Whether a fact of a motion task is about hidden runs, by their class.
pub(super) fn is_of_hidden_run(fact: &Evidence) -> bool {
    fact.tick.is_none() && fact.case.is_some()
}

fn evidence(fact: &Evidence, of: &TaskShown<'_>) -> Markup {
    html! {
        p { (prose(&kept_with_units(&fact.message))) }
        p class="where" {
            @if let Some(t_s) = fact.time_s { span { "at " (of.moment(t_s, &seconds(t_s))) } }
            @if let Some(tick) = fact.tick { span { "tick " (tick) } }
            @if let Some(run) = &fact.run { span { "run " (foreign(run)) } }
            @if let Some(case) = &fact.case { span { "case " (foreign(case)) } }
            @if fact.tick.is_some() && !fact.signal.is_empty() { span { "signal " code { (foreign(&fact.signal)) } } }
            @if let Some(value) = fact.value { span { "value " (kept_with_units(&visible(&with_unit(value, &fact.unit)))) } }
            @if let Some(limit) = fact.limit { span { "limit " (kept_with_units(&visible(&with_unit(limit, &fact.unit)))) } }
        }
    }
}
