//! Sections, attempts and lateness, each with the points of its students. On a page without names small groups have no numbers: with
//! four people in a section, everybody could work out a neighbour's points.

use kinemark_report::html::foreign;
use maud::{Markup, html};

use super::shown::{or_dash, section, table, tenths};
use crate::statistics::{GroupPoints, LabStatistics, Spread};

/// Points of fewer students than this are not shown on a page without names.
pub(super) const FEWEST_SHOWN: usize = 5;

/// The three sections, where there is anything to compare.
pub(super) fn groups(statistics: &LabStatistics, with_names: bool) -> Markup {
    let max = statistics.max_points;
    html! {
        @for (id, title, what, groups) in parts(statistics) {
            (section(id, title, &of(what, groups, max, with_names)))
        }
    }
}

/// Links to them.
pub(super) fn links(statistics: &LabStatistics) -> Vec<(&'static str, &'static str)> {
    parts(statistics)
        .into_iter()
        .map(|(id, title, _, _)| (id, title))
        .collect()
}

type Part<'a> = (&'static str, &'static str, &'static str, &'a [GroupPoints]);

fn parts(statistics: &LabStatistics) -> Vec<Part<'_>> {
    let parts: [Part<'_>; 3] = [
        ("sections", "Sections", "Section", &statistics.sections),
        ("attempts", "Attempts", "Attempts", &statistics.attempts),
        ("lateness", "Lateness", "Handed in", &statistics.lateness),
    ];
    // one group alone is the class
    parts.into_iter().filter(|part| part.3.len() > 1).collect()
}

fn of(what: &str, groups: &[GroupPoints], max: f64, with_names: bool) -> Markup {
    let head = [
        (what, false),
        ("Students", true),
        ("Mean", true),
        ("Median", true),
        ("Half between", true),
        ("Points", false),
    ];
    let may_show = |spread: &&Spread| with_names || spread.n >= FEWEST_SHOWN;
    let is_hidden = |group: &GroupPoints| {
        group
            .points
            .as_ref()
            .is_some_and(|spread| !may_show(&spread))
    };
    let rows: Vec<Vec<Markup>> = groups
        .iter()
        .map(|group| {
            let name = html! { (foreign(&group.name)) };
            let shown = group.points.as_ref().filter(may_show);
            let number = |of: fn(&Spread) -> f64| html! { (or_dash(shown.map(|spread| tenths(of(spread))))) };
            let between = shown.map(|spread| {
                format!(
                    "{} and {}",
                    tenths(spread.lower_quartile),
                    tenths(spread.upper_quartile)
                )
            });
            vec![
                name,
                html! { (group.students) },
                number(|spread| spread.mean),
                number(|spread| spread.median),
                html! { (or_dash(between)) },
                html! { @if let Some(spread) = shown { (whiskers(spread, max)) } },
            ]
        })
        .collect();
    html! {
        (table(what, "groups", &head, &rows))
        @if groups.iter().any(is_hidden) { p class="quiet" { "Groups with fewer than " (FEWEST_SHOWN) " grades have no numbers here." } }
    }
}

/// A box from quartile to quartile with the median in it, and lines to the least and the greatest; the numbers stand beside it.
fn whiskers(spread: &Spread, max: f64) -> Markup {
    let top = if max > 0.0 {
        max.max(spread.greatest)
    } else {
        1.0
    };
    let x = |value: f64| 200.0 * (value / top).clamp(0.0, 1.0);
    let number = |x: f64| format!("{x:.1}");
    let (from, to) = (x(spread.lower_quartile), x(spread.upper_quartile));
    html! {
        svg class="whiskers" viewBox="-2 0 204 16" aria-hidden="true" focusable="false" {
            rect class="rest" x="0" y="7" width="200" height="2" {}
            rect class="line" x=(number(x(spread.least))) y="7" width=(number(x(spread.greatest) - x(spread.least))) height="2" {}
            rect class="part" x=(number(from)) y="2" width=(number((to - from).max(1.0))) height="12" rx="2" {}
            rect class="median" x=(number(x(spread.median) - 1.0)) y="0" width="2" height="16" {}
        }
    }
}
