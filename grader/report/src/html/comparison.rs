//! A comparison as a page: the points of both, both arms in one replay, what differs over time.

use kinemark_sim::text::number::seconds;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::figure::figure;
use super::head::verdict;
use super::viewer::{self, ViewerCode, seek};
use super::{foreign, title_of};
use crate::compare_text::{change, together};
use crate::palette::plot_css;
use crate::plot::differences;
use crate::replay::{Overlay, Replay};
use crate::visible::visible;
use kinemark_grader::record::comparison::{
    Comparison, Ended, MotionComparison, Pair, SideRecord, TaskComparison, comparable, runs,
};
use kinemark_grader::record::grade::Outcome;
use kinemark_grader::record::graded::GradedRun;
use kinemark_grader::record::quantity::points;

/// The page of a comparison of `a` and `b`, whose runs were made again; `label` says whose it is. The same two give the same bytes.
pub fn comparison(
    comparison: &Comparison,
    a: &GradedRun,
    b: &GradedRun,
    label: Option<&str>,
) -> String {
    let label = label.filter(|label| !label.trim().is_empty());
    let replays: Vec<(usize, String)> = comparison
        .tasks
        .iter()
        .enumerate()
        .filter_map(|(i, task)| Some((i, replay(task, a, b)?)))
        .collect();
    let shows = !replays.is_empty();
    let title = format!(
        "{}{}: {} and {} compared",
        label.map_or_else(String::new, |label| format!("{}, ", visible(label))),
        visible(&comparison.lab),
        visible(&comparison.a.name),
        visible(&comparison.b.name)
    );
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(viewer::policy(shows, ViewerCode::Inside));
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="referrer" content="no-referrer";
                title { (title) }
                style { (PreEscaped(include_str!("page.css"))) (PreEscaped(include_str!("comparison.css"))) (PreEscaped(plot_css())) (viewer::style(shows)) }
            }
            body {
                a class="skip" href="#scores" { "Skip to the scores" }
                (head(comparison, title_of(a), label))
                main {
                    (scores(comparison))
                    @for (i, task) in comparison.tasks.iter().enumerate() {
                        (section(i, task, a, b))
                    }
                }
                @for (i, json) in &replays { (viewer::data(*i, json)) }
                @if shows { (viewer::script(ViewerCode::Inside)) }
            }
        }
    };
    page.into_string()
}

fn replay(task: &TaskComparison, a: &GradedRun, b: &GradedRun) -> Option<String> {
    let (run_a, run_b) = runs(&task.name, a, b)?;
    comparable(run_a, run_b).ok()?;
    let [of_a, of_b] = [a, b].map(|graded| {
        let mut tasks = graded.grade.tasks.iter();
        tasks.find(|graded| graded.name == task.name)
    });
    let ghost = Overlay {
        robot: &run_b.robot,
        scene: run_b.scene.as_ref().map(|scene| &scene.scene),
        trace: &run_b.trace,
        label: "B",
        run: Some((run_b, of_b)),
    };
    Some(Replay::of(run_a, of_a).beside("A", ghost).json())
}

/// The head: both submissions with what they earned.
fn head(comparison: &Comparison, title: &str, label: Option<&str>) -> Markup {
    html! {
        header class="head" {
            p class="eyebrow" { "Kinemark comparison" }
            h1 { (foreign(title)) }
            @if let Some(label) = label { p class="whose" { (foreign(label)) } }
            p class="by" { (foreign(&comparison.lab)) " · two submissions" }
            div class="first" { (side("A", &comparison.a)) (side("B", &comparison.b)) }
            p class="mode" { "B is shown translucent beside A. A difference is B's points above A's." }
        }
    }
}

/// One of the two, by its letter.
fn side(letter: &str, side: &SideRecord) -> Markup {
    let share = match side.max_points > 0.0 {
        true => (side.points / side.max_points).clamp(0.0, 1.0),
        false => 0.0,
    };
    html! {
        div class="result" role="group" aria-label={ "Submission " (letter) } {
            p { strong { (letter) ": " (foreign(&side.name)) } " · " (foreign(&side.submission)) }
            p class="score" { b { (points(side.points)) } span { "of " (points(side.max_points)) " points" } }
            svg class="meter" viewBox="0 0 100 2" preserveAspectRatio="none" aria-hidden="true" focusable="false" {
                rect class="rest" width="100" height="2" {}
                rect class="part" width=(format!("{:.2}", 100.0 * share)) height="2" {}
            }
            p { (verdict(side.verdict, side.points)) }
        }
    }
}

/// The tasks with the points of both.
fn scores(comparison: &Comparison) -> Markup {
    html! {
        section id="scores" aria-labelledby="scores-title" tabindex="-1" {
            h2 id="scores-title" { "Scores" }
            div class="wide" tabindex="0" role="group" aria-label="Both submissions" {
                table class="compared" {
                    thead { tr {
                        th scope="col" { "Task" }
                        th scope="col" class="number" { "A" } th scope="col" class="number" { "B" }
                        th scope="col" class="number" { "of" } th scope="col" class="number" { "Difference" }
                    } }
                    tbody {
                        @for (i, task) in comparison.tasks.iter().enumerate() {
                            (row_of(&html! { a href=(format!("#task-{}", i + 1)) { (foreign(&task.title)) } }, &task.points, [Outcome::Full; 2]))
                        }
                    }
                }
            }
            @if !comparison.notes.is_empty() {
                ul { @for note in &comparison.notes { li { (foreign(note)) } } }
            }
        }
    }
}

fn section(index: usize, task: &TaskComparison, a: &GradedRun, b: &GradedRun) -> Markup {
    let id = format!("task-{}", index + 1);
    let found = runs(&task.name, a, b).filter(|(a, b)| comparable(a, b).is_ok());
    let first = task
        .motion
        .as_ref()
        .and_then(|motion| motion.first.as_ref());
    let plots = found.map_or_else(Vec::new, |(a, b)| differences(a, b, first));
    html! {
        section class="task" id=(id) data-task=(visible(&task.name)) aria-labelledby={ (id) "-title" } {
            div class="title" {
                h2 id={ (id) "-title" } { (foreign(&task.title)) }
                p { "A: " (verdict(task.verdict_a, task.points.a)) " B: " (verdict(task.verdict_b, task.points.b)) }
            }
            @for (letter, ended) in [("A", &task.ended_a), ("B", &task.ended_b)] {
                @if let Some(ended) = ended { (stopped(&task.name, letter, ended)) }
            }
            @if let Some(motion) = &task.motion { (apart(&task.name, motion)) }
            @if found.is_some() { (viewer::place(index, &task.name)) }
            div class="wide" tabindex="0" role="group" aria-label="Points of both" {
                table class="compared" {
                    thead { tr {
                        th scope="col" { "Check" }
                        th scope="col" class="number" { "A" } th scope="col" class="number" { "B" }
                        th scope="col" class="number" { "of" } th scope="col" class="number" { "Difference" }
                    } }
                    tbody { @for check in &task.checks { (row(&check.title, &check.points, [check.outcome_a, check.outcome_b])) } }
                    tfoot { (row("All", &task.points, [Outcome::Full; 2])) }
                }
            }
            @if !plots.is_empty() {
                h3 { "Both over time" }
                div class="plots" {
                    @for plot in &plots {
                        (figure(plot, &task.name))
                    }
                }
            }
        }
    }
}

fn row(title: &str, pair: &Pair, outcomes: [Outcome; 2]) -> Markup {
    row_of(&foreign(title), pair, outcomes)
}

fn row_of(title: &Markup, pair: &Pair, outcomes: [Outcome; 2]) -> Markup {
    // that it is more or less is said by its sign, too
    let class = match pair.difference {
        more if more > 0.0 => "number full",
        less if less < 0.0 => "number none",
        _ => "number",
    };
    html! {
        tr {
            th scope="row" { (title) }
            @for (earned, outcome) in [pair.a, pair.b].into_iter().zip(outcomes) {
                td class="number" {
                    @match outcome {
                        Outcome::NotJudged => "not judged",
                        Outcome::AtHandIn => "when handed in",
                        Outcome::Full | Outcome::Partial | Outcome::None => (points(earned)),
                    }
                }
            }
            td class="number" { (points(pair.max)) @if let Some(max_b) = pair.max_b { " → " (points(max_b)) } }
            td class=(class) { (change(pair.difference)) }
        }
    }
}

/// When and why one of the two ended early.
fn stopped(task: &str, letter: &str, ended: &Ended) -> Markup {
    html! {
        p {
            (letter) " stopped"
            @if let Some(time_s) = ended.time_s { " at " (seek(task, time_s, &seconds(time_s))) }
            @if let Some(case) = &ended.case { " in case " code { (foreign(case)) } }
            @if let Some(line) = ended.line { ", line " (line) }
            ": " (super::prose(&ended.message))
        }
    }
}

fn apart(task: &str, motion: &MotionComparison) -> Markup {
    let Some(first) = &motion.first else {
        return html! { p { (together(motion)) "." } };
    };
    html! {
        div class="note hint" {
            h3 { "Where they first differ" }
            p { (super::prose(&first.message)) }
            p class="where" {
                span { "at " (seek(task, first.time_s, &seconds(first.time_s))) }
                span { "tick " (first.tick) }
                span { "signal " code { (foreign(&first.signal)) } }
            }
        }
    }
}
