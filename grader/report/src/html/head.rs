//! The head of the page, the table of scores, and what the grade rests on.

use maud::{Markup, html};

use super::band::{measure_text, outcome};
use super::beyond::has_full_marks;
use super::costs::costs;
use super::foreign;
use crate::stop_words::stop_of_whole_file;
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
            let (mut lost, mut unjudged, mut all) = (0, 0, 0);
            for check in checks.filter(|check| check.outcome != Outcome::AtHandIn) {
                let is_unjudged = check.outcome == Outcome::NotJudged;
                unjudged += usize::from(is_unjudged);
                lost += usize::from(!is_unjudged && check.outcome != Outcome::Full);
                all += 1;
            }
            return match (lost, unjudged) {
                (lost, 0) => format!("{lost} of {all} checks lost points."),
                (0, unjudged) => format!("{unjudged} of {all} checks were not judged."),
                (lost, 1) => format!("{lost} of {all} checks lost points, and 1 was not judged."),
                (lost, many) => {
                    format!("{lost} of {all} checks lost points, and {many} were not judged.")
                }
            };
        }
        Verdict::Passed => "Every check earned all its points.",
    };
    sentence.to_owned()
}

/// A verdict over so many points as a chip, with a colour that its words do not need.
pub(super) fn verdict(verdict: Verdict, earned: f64) -> Markup {
    let class = match verdict {
        Verdict::Passed => "full",
        Verdict::Missed if earned > 0.0 => "partial",
        Verdict::Missed => "none",
        Verdict::GraderFault | Verdict::HostLimit => "unjudged",
        Verdict::DidNotBuild | Verdict::Crashed | Verdict::OverBudget | Verdict::InvalidOutput => {
            "none"
        }
    };
    html! { span class={ "pill " (class) } { (verdict_words(verdict)) } }
}

/// A verdict in words; its name in the record is a code.
pub fn verdict_words(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Passed => "full marks",
        Verdict::Missed => "points lost",
        Verdict::InvalidOutput => "invalid answer",
        Verdict::OverBudget => "over budget",
        Verdict::Crashed => "crashed",
        Verdict::DidNotBuild => "does not build",
        Verdict::HostLimit => "not graded: machine limit",
        Verdict::GraderFault => "not graded: grader failed",
    }
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
/// `label` says whose it is.
pub(super) fn head(grade: &Grade, title: &str, label: Option<&str>, look: &Markup) -> Markup {
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
            @if let Some(label) = label { p class="whose" { (foreign(label)) } }
            p class="by" {
                (foreign(&grade.lab.name)) " · robot " (foreign(&grade.robot.name)) " · " (foreign(&grade.submission.name))
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
                    p { (verdict(grade.verdict, grade.points)) " " (meaning(grade.verdict, checks())) }
                    (costs(grade))
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
            @if grade.tasks.len() > 1 && stop_of_whole_file(grade).is_none() {
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
    let has_sections = stop_of_whole_file(grade).is_none();
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
                            (task_row(i, task, has_sections))
                            @for check in &task.checks { (check_row(check)) }
                        }
                    }
                    tfoot role="rowgroup" {
                        tr role="row" {
                            th scope="row" role="rowheader" colspan="2" { "All tasks" }
                            td role="cell" class="number" { (earned(grade.points, grade.max_points)) }
                            td role="cell" { (verdict(grade.verdict, grade.points)) }
                        }
                    }
                }
            }
        }
    }
}

/// The row of a task; where the page has no section of it, links to the task lead here.
fn task_row(index: usize, task: &TaskGrade, has_section: bool) -> Markup {
    let id = (!has_section).then(|| format!("task={}", visible(&task.name)));
    html! {
        tr class="task" role="row" id=[id] {
            th scope="rowgroup" role="rowheader" colspan="2" {
                @if has_section { a href={ "#" (anchor(index)) } { (foreign(&task.title)) } } @else { (foreign(&task.title)) }
            }
            td role="cell" class="number" { (earned(task.points, task.max_points)) }
            td role="cell" { (verdict(task.verdict, task.points)) }
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
