//! The head of the page, the table of scores, and what the grade rests on.

use maud::{Markup, html};

use super::band::{measure_text, outcome};
use super::beyond::has_full_marks;
use super::foreign;
use crate::text::points_at_hand_in;
use crate::visible::visible;
use kinemark_grader::record::grade::{CheckGrade, Grade, GradeMode, Outcome, Part, TaskGrade};
use kinemark_grader::record::quantity::points;
use kinemark_grader::record::verdict::Verdict;

/// What a verdict over `checks` means, in a sentence.
pub(super) fn meaning<'a>(
    verdict: Verdict,
    checks: impl Iterator<Item = &'a CheckGrade>,
) -> String {
    let sentence = match verdict {
        Verdict::GraderFault => {
            "The grader failed. This is not your fault, and no grade was assigned."
        }
        Verdict::HostLimit => {
            "This machine ran out of time or memory. It says nothing about the work; run it again. No grade was assigned."
        }
        Verdict::DidNotBuild => "The submission cannot be read as a program.",
        Verdict::Crashed => "The submission failed while running.",
        Verdict::OverBudget => "The submission exceeded its operation budget.",
        Verdict::InvalidOutput => {
            "The submission returned something of the wrong shape, or a number that is not finite."
        }
        Verdict::Missed => {
            let (mut lost, mut all) = (0, 0);
            for check in checks {
                if check.outcome == Outcome::AtHandIn {
                    continue;
                }
                lost += usize::from(check.outcome != Outcome::Full);
                all += 1;
            }
            return format!("{lost} of {all} checks lost points.");
        }
        Verdict::Passed => "Every check earned all its points.",
    };
    sentence.to_owned()
}

/// A verdict as a chip, with a colour that its word does not need.
pub(super) fn verdict(verdict: Verdict) -> Markup {
    let class = match verdict {
        Verdict::Passed => "full",
        Verdict::Missed => "partial",
        Verdict::GraderFault | Verdict::HostLimit => "unjudged",
        Verdict::DidNotBuild | Verdict::Crashed | Verdict::OverBudget | Verdict::InvalidOutput => {
            "none"
        }
    };
    html! { span class={ "pill " (class) } { (verdict.name()) } }
}

/// The anchor of a task's section.
pub(super) fn anchor(index: usize) -> String {
    format!("task-{}", index + 1)
}

/// Points earned of points there are.
pub(super) fn earned(earned: f64, of: f64) -> Markup {
    html! { span class="points" { b { (points(earned)) } " of " (points(of)) } }
}

/// The head: how it went, at a glance, and where to look first.
pub(super) fn head(grade: &Grade, title: &str, look: &Markup) -> Markup {
    let checks = || grade.tasks.iter().flat_map(|task| &task.checks);
    let share = if grade.max_points > 0.0 {
        (grade.points / grade.max_points).clamp(0.0, 1.0)
    } else {
        0.0
    };
    html! {
        header class={ "head" @if has_full_marks(grade) { " won" } } {
            p class="eyebrow" { "Kinemark report" }
            h1 { (foreign(title)) }
            p class="by" {
                (foreign(&grade.lab.name)) " · robot " (foreign(&grade.robot.name)) " · submission " (foreign(&grade.submission.name))
                @if grade.is_without_sources() { " · no sources beside this module" }
            }
            @if let Some(variant) = &grade.variant { p class="by" { (foreign(&variant.words())) } }
            div class="first" {
                div class="result" {
                    p class="score" {
                        @if grade.verdict.is_decided() {
                            b { (points(grade.points)) } span { "of " (points(grade.max_points)) " points" }
                            @if let Some(later) = points_at_hand_in(grade) { span { "; " (later) } }
                        } @else {
                            b { "–" } span { "of " (points(grade.max_points)) " points, not decided" }
                        }
                    }
                    svg class="meter" viewBox="0 0 100 2" preserveAspectRatio="none" aria-hidden="true" focusable="false" {
                        rect class="rest" width="100" height="2" {}
                        rect class="part" width=(format!("{:.2}", 100.0 * share)) height="2" {}
                    }
                    p { (verdict(grade.verdict)) " " (meaning(grade.verdict, checks())) }
                }
                (look)
            }
            p class="mode" {
                @match grade.mode {
                    GradeMode::Practice => {
                        strong { "Practice. " }
                        "Visible cases only: this run had neither the reference solution nor the hidden cases, so the points may differ when it is graded."
                    }
                    GradeMode::Graded => {
                        strong { "Graded. " }
                        "The reference solution and the hidden cases were used."
                    }
                }
            }
            @if grade.tasks.len() > 1 {
                nav aria-label="Tasks" {
                    ul {
                        @for (i, task) in grade.tasks.iter().enumerate() {
                            li { a href={ "#" (anchor(i)) } { (foreign(&task.title)) " " (earned(task.points, task.max_points)) } }
                        }
                    }
                }
            }
        }
    }
}

/// The table of scores: every task, every check. On a narrow screen its rows are laid out as blocks, which would cost a screen
/// reader the table; hence the roles.
pub(super) fn scores(grade: &Grade) -> Markup {
    html! {
        section id="scores" aria-labelledby="scores-title" tabindex="-1" {
            h2 id="scores-title" { "Scores" }
            div class="wide" tabindex="0" role="group" aria-label="Points of every check" {
                table class="scores" role="table" {
                    caption class="unseen" { "Points of every check, with the value measured and the band it was judged by" }
                    thead role="rowgroup" {
                        tr role="row" {
                            th scope="col" role="columnheader" { "Check" }
                            th scope="col" role="columnheader" { "Measured" }
                            th scope="col" role="columnheader" class="number" { "Points" }
                            th scope="col" role="columnheader" { "Outcome" }
                        }
                    }
                    @for (i, task) in grade.tasks.iter().enumerate() {
                        tbody role="rowgroup" {
                            (task_row(i, task))
                            @for check in &task.checks { (check_row(check)) }
                        }
                    }
                    tfoot role="rowgroup" {
                        tr role="row" {
                            th scope="row" role="rowheader" colspan="2" { "All tasks" }
                            td role="cell" class="number" { (earned(grade.points, grade.max_points)) }
                            td role="cell" { (verdict(grade.verdict)) }
                        }
                    }
                }
            }
        }
    }
}

fn task_row(index: usize, task: &TaskGrade) -> Markup {
    html! {
        tr class="task" role="row" {
            th scope="rowgroup" role="rowheader" colspan="2" { a href={ "#" (anchor(index)) } { (foreign(&task.title)) } }
            td role="cell" class="number" { (earned(task.points, task.max_points)) }
            td role="cell" { (verdict(task.verdict)) }
        }
    }
}

fn check_row(check: &CheckGrade) -> Markup {
    html! {
        tr role="row" {
            th scope="row" role="rowheader" { (foreign(&check.title)) }
            td role="cell" {
                @if let Some(measure) = &check.measure {
                    @let text = measure_text(measure);
                    span class="value" { (text.value) } " "
                    small { (text.band) }
                } @else { span class="quiet" { "–" } }
            }
            td role="cell" class="number" { (earned(check.points, check.max_points)) }
            td role="cell" { (outcome(check)) }
        }
    }
}

/// What the grade rests on: names and digests.
pub(super) fn facts(grade: &Grade) -> Markup {
    let part = |what: &str, part: &Part| {
        html! {
            tr { th scope="row" { (what) } td { (foreign(&part.name)) } td class="digest" { code { (visible(&part.digest)) } } }
        }
    };
    html! {
        footer {
            h2 { "What this grade rests on" }
            p { "The same submission gives the same bits on every machine. " code { "kinemark verify" } " runs it again and compares these digests (BLAKE3)." }
            div class="wide" tabindex="0" role="group" aria-label="What took part" {
                table class="facts" {
                    caption class="unseen" { "Names and digests of all that took part" }
                    thead { tr { th scope="col" { "What" } th scope="col" { "Name" } th scope="col" { "Digest" } } }
                    tbody {
                        (part("Lab", &grade.lab))
                        (part("Robot", &grade.robot))
                        (part("Submission", &grade.submission))
                        @for source in grade.sources.iter().flatten() { (part("Source", source)) }
                        @if grade.is_without_sources() {
                            tr { th scope="row" { "Sources" } td colspan="2" { "none beside this module" } }
                        }
                        @if let Some(reference) = &grade.reference { (part("Reference", reference)) }
                        @for task in &grade.tasks {
                            tr {
                                th scope="row" { "Task" }
                                td { (foreign(&task.name)) }
                                td class="digest" { code { (visible(&task.digests.all)) } }
                            }
                        }
                    }
                }
            }
            p class="quiet" { (foreign(&grade.engine)) " · record " (foreign(&grade.format)) }
        }
    }
}
