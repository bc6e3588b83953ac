//! The table of checks: what each earned over the class, whether it goes with the rest, and its values over the band.

use kinemark_grader::record::quantity::points;
use kinemark_report::html::foreign;
use kinemark_sim::text::number::typeset;
use maud::{Markup, html};

use super::shown::{or_dash, percent};
use super::strip::strip;
use crate::statistics::{CheckStatistics, LabStatistics};

/// Below this a check says little about the rest of the lab.
const WEAK: f64 = 0.2;

/// The section's body.
pub(super) fn checks(statistics: &LabStatistics) -> Markup {
    let mut tasks: Vec<(&str, Vec<&CheckStatistics>)> = Vec::new();
    for check in &statistics.checks {
        match tasks.last_mut() {
            Some((task, checks)) if *task == check.task => checks.push(check),
            _ => tasks.push((&check.task, vec![check])),
        }
    }
    html! {
        p class="lead" {
            "Bars are shares of the class. " strong { "Passed" } " is who earned all points, of everybody with a grade. " strong { "Discrimination" }
            " is the correlation with the points of the other checks, over those of whom the check was judged: near 0 the check says nothing \
            about the rest of the lab, below 0 it goes against it. Values are drawn over the band: left what earns all points, in the middle a \
            part, right none."
        }
        div class="wide" tabindex="0" role="group" aria-label="Checks" {
            table class="per-check" role="table" {
                caption class="unseen" { "What each check earned over the class" }
                thead role="rowgroup" {
                    tr role="row" {
                        th scope="col" role="columnheader" { "Check" }
                        th scope="col" role="columnheader" { "Students" }
                        th scope="col" role="columnheader" class="number" { "Passed" }
                        th scope="col" role="columnheader" class="number" { "Mean" }
                        th scope="col" role="columnheader" class="number" { "Discrimination" }
                        th scope="col" role="columnheader" { "Values over the band" }
                    }
                }
                @for (_, checks) in &tasks {
                    tbody role="rowgroup" {
                        tr class="task" role="row" {
                            th scope="rowgroup" role="rowheader" colspan="6" { (foreign(checks.first().map_or("", |check| &check.task_title))) }
                        }
                        @for check in checks { (row(check)) }
                    }
                }
            }
        }
    }
}

fn row(check: &CheckStatistics) -> Markup {
    let discrimination = check.discrimination;
    let is_weak = discrimination.is_some_and(|r| r < WEAK);
    html! {
        tr role="row" {
            th scope="row" role="rowheader" {
                (foreign(&check.title)) " " small { (points(check.max_points)) (if points(check.max_points) == "1" { " point" } else { " points" }) }
                @for pile in check.values.iter().flat_map(|values| &values.piles) { p class="pile" { (pile.says) } }
            }
            td role="cell" { (stack(check)) }
            td role="cell" class="number" data-label="passed" { (percent(check.full as f64 / check.students.max(1) as f64)) }
            td role="cell" class="number" data-label="mean" { (or_dash(check.mean_share.map(percent))) }
            td role="cell" class="number" data-label="discrimination" {
                @if is_weak { strong { (or_dash(discrimination.map(|r| typeset(r, 2)))) } " " span class="pill partial" { "weak" } }
                @else { (or_dash(discrimination.map(|r| typeset(r, 2)))) }
            }
            td role="cell" class="over" {
                @if let Some(values) = &check.values { (strip(values)) } @else { span class="quiet" { "–" } }
            }
        }
    }
}

/// A bar of the class by outcome, and its numbers.
fn stack(check: &CheckStatistics) -> Markup {
    let parts = [
        ("full", check.full, "full"),
        ("partial", check.partial, "part"),
        ("none", check.none, "none"),
        ("unjudged", check.not_judged, "not judged"),
    ];
    let all = check.students.max(1) as f64;
    let mut begin = 0.0;
    let bars: Vec<(&str, f64, f64)> = parts
        .iter()
        .map(|(class, count, _)| {
            let (from, width) = (begin, 100.0 * *count as f64 / all);
            begin += width;
            (*class, from, width)
        })
        .collect();
    let shown: Vec<String> = parts
        .iter()
        .filter(|(_, count, _)| *count > 0)
        .map(|(_, count, words)| format!("{count}\u{a0}{}", words.replace(' ', "\u{a0}")))
        .collect();
    html! {
        svg class="stack" viewBox="0 0 100 6" preserveAspectRatio="none" aria-hidden="true" focusable="false" {
            @for (class, from, width) in bars {
                @if width > 0.0 { rect class=(class) x=(format!("{from:.2}")) y="0" width=(format!("{width:.2}")) height="6" {} }
            }
        }
        small { (shown.join(" · ")) }
    }
}
