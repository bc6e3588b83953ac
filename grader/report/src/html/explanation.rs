//! An explanation as pages for the course staff: an overview of every hidden case and run, and for each attempt its page with plots and
//! replay.

use maud::{Markup, html};

use super::head::earned;
use super::{PageExtras, ViewerCode, foreign, page, page_with_notice, prose};
use crate::explain_text::{FOR_STAFF, HOW_RUNS_COUNT, band_of, case_error, scores, value_of};
use crate::plot::plots;
use crate::stop_words::{is_missing_function, message_with_line, stop_of_whole_file};
use crate::student_reply::paragraph;
use crate::text::hidden_word;
use crate::visible::{file_stem, shortened, visible};
use kinemark_grader::record::explanation::{
    DrawCheck, ExplainedAttempt, ExplainedDraw, ExplainedTask, Explanation,
};
use kinemark_grader::record::grade::{TaskGrade, TaskKind};
use kinemark_grader::record::quantity::points;

/// The file name of the overview.
pub const OVERVIEW_FILE: &str = "explained.html";

/// A page for the course staff.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StaffPage {
    /// Its file name; the overview links to the others by it.
    pub file_name: String,
    /// Its text.
    pub html: String,
}

/// The pages of an explanation, the overview first, with the viewer's code where `code` says. The same explanation gives the same bytes.
pub fn explanation(explanation: &Explanation, code: ViewerCode<'_>) -> Vec<StaffPage> {
    let mut pages = vec![StaffPage {
        file_name: OVERVIEW_FILE.to_owned(),
        html: overview(explanation),
    }];
    for task in &explanation.tasks {
        for (i, attempt) in task.attempts.iter().enumerate() {
            pages.push(StaffPage {
                file_name: file_name(task, i),
                html: attempt_page(task, attempt, code),
            });
        }
    }
    pages
}

/// The file name of an attempt's page.
fn file_name(task: &ExplainedTask, attempt: usize) -> String {
    let stem = file_stem(&task.name);
    match task.kind {
        TaskKind::Function => format!("hidden-{stem}.html"),
        TaskKind::Motion => format!("hidden-{stem}-{}.html", attempt + 1),
    }
}

/// The page of an attempt: a report like any other, with a notice above it.
fn attempt_page(task: &ExplainedTask, attempt: &ExplainedAttempt, code: ViewerCode<'_>) -> String {
    let drawn: Vec<_> = attempt.graded.runs.iter().map(plots).collect();
    let what = match (task.kind, attempt.draws.as_slice()) {
        (TaskKind::Motion, [run]) => {
            format!("Hidden {}: {}.", run.draw.name(), run.draw.words)
        }
        _ => "All cases of the task, first those that students see.".to_owned(),
    };
    let how = match task.kind {
        TaskKind::Function => "The points are those of all cases together, as in the grade.",
        TaskKind::Motion => "The points on this page are those of this run alone.",
    };
    let notice = html! {
        aside aria-label="For course staff" {
            (banner())
            p class="by" { (foreign(&what)) " " (how) " " a href=(OVERVIEW_FILE) { "All hidden cases and runs" } }
        }
    };
    page_with_notice(
        &attempt.graded,
        &drawn,
        &PageExtras::default(),
        code,
        &notice,
    )
}

fn banner() -> Markup {
    html! { div class="note bad" role="note" { p { strong { (FOR_STAFF) } } } }
}

fn overview(explanation: &Explanation) -> String {
    let grade = &explanation.graded.grade;
    let title = format!(
        "Hidden cases and runs of {}, for course staff",
        visible(&grade.lab.name)
    );
    let record = |name: &str| grade.tasks.iter().find(|task| task.name == name);
    let whole_file = stop_of_whole_file(grade);
    let body = html! {
        header class="head" {
            (banner())
            h1 { "Hidden cases and runs" }
            p class="by" { (foreign(&grade.lab.name)) " · submission " (foreign(&grade.submission.name)) " · " (points(grade.points)) " of " (points(grade.max_points)) " points" }
            @if let Some(variant) = &grade.variant { p class="by" { (foreign(&variant.words())) } }
        }
        main {
            @if explanation.tasks.is_empty() { section { p { "Nothing is hidden in this lab." } } }
            @if let Some(stopped) = whole_file {
                section { p { strong { "Nothing of it could be run: " } (foreign(&message_with_line(stopped))) } }
            }
            @for task in &explanation.tasks { (section(task, record(&task.name), whole_file.is_some())) }
            (hints(explanation))
            section aria-labelledby="reply" {
                h2 id="reply" { "To send to the student" }
                p class="lead" { "Without hidden numbers:" }
                p { (foreign(&paragraph(explanation))) }
            }
        }
    };
    page(&title, &grade.engine, &body, &[], ViewerCode::Inside)
}

/// All hints of the checks that lost points, which the student's report does not have.
fn hints(explanation: &Explanation) -> Markup {
    let losses = explanation.hints.of_losses(&explanation.graded.grade);
    html! {
        @if !losses.is_empty() {
            section aria-labelledby="hints" {
                h2 id="hints" { "Hints of the checks that lost points" }
                @for check in losses {
                    h3 { (foreign(&check.title)) " " code { (check.name()) } }
                    ol class="hints" { @for hint in &check.hints { li { (prose(hint)) } } }
                }
            }
        }
    }
}

fn section(task: &ExplainedTask, record: Option<&TaskGrade>, is_no_program: bool) -> Markup {
    let id = format!("hidden-{}", file_stem(&task.name));
    let stopped = record.and_then(|record| record.stopped.as_ref());
    let nothing_ran = is_no_program || record.is_some_and(is_missing_function);
    html! {
        section class="task" aria-labelledby=(id) {
            div class="title" {
                h2 id=(id) { (foreign(&task.title)) }
                @if let Some(record) = record { p { (earned(record.points, record.max_points)) } }
            }
            @if let Some(stopped) = stopped.filter(|_| !is_no_program) {
                p { strong { "Stopped: " } (foreign(&message_with_line(stopped))) }
            }
            @match task.kind {
                TaskKind::Function => p class="lead" { a href=(file_name(task, 0)) { "All cases with their checks" } },
                TaskKind::Motion => p class="lead" { (HOW_RUNS_COUNT) },
            }
            @if !task.counts && !nothing_ran {
                p { strong { "Not part of the grade: " } "the visible run did not reach its end." }
            }
            @for (class, draws) in task.classes() {
                h3 { (foreign(class)) ": " (draws.iter().filter(|draw| draw.good).count()) " of " (draws.len()) " hidden " (hidden_word(task.kind)) " good" }
                @match task.kind {
                    // without a call every one of them says the same
                    _ if nothing_ran => {}
                    TaskKind::Function => (cases(&draws)),
                    TaskKind::Motion => @for draw in &draws { (run(task, draw)) },
                }
            }
        }
    }
}

/// The hidden cases of a class.
fn cases(draws: &[&ExplainedDraw]) -> Markup {
    let cell = |text: &str| html! { td { code { (foreign(&shortened(text, 300))) } } };
    html! {
        div class="wide" tabindex="0" role="group" aria-label="Hidden cases" {
            table class="cases" {
                thead {
                    tr {
                        th scope="col" { "Case" }
                        th scope="col" { "Drawn" }
                        th scope="col" { "Answer" }
                        th scope="col" { "Expected" }
                        th scope="col" { "Off" }
                        th scope="col" { "Points lost by" }
                        th scope="col" { "Good" }
                    }
                }
                tbody {
                    @for explained in draws {
                        tr {
                            th scope="row" { (explained.draw.number) }
                            (cell(&explained.draw.words))
                            @if let Some(case) = &explained.case {
                                (cell(&case.answer))
                                (cell(case.expected.as_deref().unwrap_or("–")))
                                td { (case_error(case, &explained.branches_m).unwrap_or_else(|| "–".to_owned())) }
                            } @else { td {} td {} td {} }
                            td { (lost(explained)) }
                            td { (yes_or_no(explained.good)) }
                        }
                    }
                }
            }
        }
    }
}

/// The checks that lost points in a case.
fn lost(explained: &ExplainedDraw) -> Markup {
    let lost = explained.checks.iter().filter(|check| check.is_lost());
    html! {
        @if let Some(stopped) = &explained.stopped { p { "stopped: " (foreign(&stopped.message)) } }
        @for check in lost {
            p { (foreign(&check.title)) ": " (scores(check)) "; " (foreign(&check.words())) " " small { (foreign(&band_of(check))) } }
        }
    }
}

/// One hidden run.
fn run(task: &ExplainedTask, explained: &ExplainedDraw) -> Markup {
    let mut attempts = task.attempts.iter();
    let at = attempts.position(|attempt| attempt.draws.first() == Some(explained));
    let draw = &explained.draw;
    html! {
        p {
            "Run " (draw.number) ": " code { (foreign(&draw.words)) } " "
            (yes_or_no(explained.good)) " "
            @if let Some(at) = at { a href=(file_name(task, at)) { "Replay and plots of run " (draw.number) } }
        }
        @if let Some(stopped) = &explained.stopped { p { strong { "Stopped: " } (foreign(&stopped.message)) } }
        div class="wide" tabindex="0" role="group" aria-label={ "Checks of run " (draw.number) } {
            table {
                thead { tr { th scope="col" { "Check" } th scope="col" { "Score" } th scope="col" { "Measured" } th scope="col" { "Why" } } }
                tbody { @for check in &explained.checks { (check_row(check)) } }
            }
        }
    }
}

fn check_row(check: &DrawCheck) -> Markup {
    html! {
        tr {
            th scope="row" { (foreign(&check.title)) }
            td { (scores(check)) }
            td { (foreign(&value_of(check))) }
            td { @for fact in &check.evidence { p { (foreign(&fact.message)) } } }
        }
    }
}

fn yes_or_no(good: bool) -> Markup {
    html! { @if good { span class="pill full" { "good" } } @else { span class="pill none" { "not good" } } }
}
