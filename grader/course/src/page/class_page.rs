//! The page of a class: numbers and pictures of a lab without names, so that it can be projected; with names only on request.

use kinemark_report::html::{StaticPage, foreign};
use maud::{Markup, html};

use super::checks::checks;
use super::groups;
use super::head::{PageHead, head};
use super::losses::{clusters, hidden, mistakes, slow_runs};
use super::names::{NamedStudent, SORTED_TABLE, table_of};
use super::points::distribution;
use super::shown::{CSS, all, section};
use crate::clusters::Cluster;
use crate::statistics::LabStatistics;

/// With fewer grades than this, everybody could work out whose points are whose.
const FEWEST_PROJECTED: usize = groups::FEWEST_SHOWN;

/// The page of a class, one file that asks nothing of the network. Without `names` it has no name and no id, and no points of groups of
/// fewer than five; with them a table of students, which only course staff may see. The same class gives the same bytes.
pub fn class_page(
    statistics: &LabStatistics,
    clusters: &[Cluster],
    page_head: &PageHead,
    names: Option<&[NamedStudent]>,
) -> String {
    let parts = parts(statistics, clusters, names);
    let mut links: Vec<(&str, &str)> = parts.iter().map(|(id, title, _)| (*id, *title)).collect();
    let at = links
        .len()
        .saturating_sub(if names.is_some() { 2 } else { 1 });
    links.splice(at..at, groups::links(statistics));
    let (last, first): (Vec<_>, Vec<_>) = parts
        .iter()
        .partition(|(id, _, _)| matches!(*id, "runs" | "students"));
    let shown = |parts: Vec<&(&str, &str, Markup)>| {
        all(parts
            .into_iter()
            .map(|(id, title, body)| section(id, title, body)))
    };
    let body = html! {
        a class="skip" href="#points" { "Skip to the points" }
        (head(page_head, statistics, "Kinemark class", &notice(statistics, names.is_some()), &links))
        main {
            (shown(first))
            (groups::groups(statistics, names.is_some()))
            (shown(last))
        }
        (footer(page_head))
    };
    let title = format!("{}: the class", page_head.title(&statistics.lab));
    let page = StaticPage {
        title: &title,
        engine: &page_head.engine,
        css: CSS,
        script: names.map(|_| SORTED_TABLE),
    };
    page.around(&body)
}

/// The sections but for those of groups: anchor, title, body.
fn parts(
    statistics: &LabStatistics,
    all_clusters: &[Cluster],
    named: Option<&[NamedStudent]>,
) -> Vec<(&'static str, &'static str, Markup)> {
    let mut parts = vec![("points", "Points", distribution(statistics))];
    if !statistics.checks.is_empty() {
        parts.push(("checks", "Checks", checks(statistics)));
        parts.push(("hidden", "Lost in hidden runs alone", hidden(statistics)));
        parts.push(("mistakes", "Common mistakes", mistakes(statistics)));
        parts.push((
            "clusters",
            "Equal wrong answers without a name",
            clusters(all_clusters),
        ));
        parts.push(("runs", "The slowest runs", slow_runs(statistics, named)));
    }
    if let Some(named) = named {
        parts.push(("students", "Students", table_of(named, &[])));
    }
    parts
}

fn notice(statistics: &LabStatistics, has_names: bool) -> Markup {
    let grades = statistics.points.as_ref().map_or(0, |spread| spread.n);
    html! {
        @if has_names { p class="note bad" { strong { "For course staff. " } "This page has names and points of students: do not project it, and do not send it on." } }
        @else if (1..FEWEST_PROJECTED).contains(&grades) {
            p class="note bad" { strong { "Do not project this page yet. " } "It has no names, but with so few grades everybody could work out whose points are whose." }
        }
        @else { p class="mode" { strong { "No names, no ids. " } "This page can be projected." } }
    }
}

fn footer(page_head: &PageHead) -> Markup {
    html! {
        footer {
            h2 { "How these numbers are made" }
            p { "Of each student the attempt counts that the course counts. Who has no grade, or is excused, is in no mean. A check that was not judged earns nothing, because one that it needs earned nothing or the submission stopped before." }
            p { "Quartiles are interpolated between neighbours. A value is near an edge of a band within 5 % of its width, but not on it. A pile is at least five values and 15 % of all." }
            p { "Wrong answers are equal to the bit; where each student has a variant, they are also grouped by equal losses in the same checks, of which at least one earns a part." }
            p class="quiet" { (foreign(&page_head.engine)) }
        }
    }
}
