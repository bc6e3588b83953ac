//! The distribution of points: a picture, and its numbers.

use kinemark_grader::record::quantity::points;
use kinemark_report::html::still_figure;
use kinemark_report::plot::{Histogram, histogram};
use maud::{Markup, html};

use super::shown::{table, tenths};
use crate::statistics::{LabStatistics, Spread};

/// The section's body.
pub(super) fn distribution(statistics: &LabStatistics) -> Markup {
    let Some(spread) = &statistics.points else {
        return html! { p { "Nobody has a grade yet." } };
    };
    let bins: Vec<(f64, f64, usize)> = statistics
        .histogram
        .iter()
        .map(|bin| (bin.from, bin.to, bin.students))
        .collect();
    let picture = histogram(&Histogram {
        title: "How many students have how many points",
        quantity: "points",
        counted: "students",
        bins: &bins,
        quartiles: Some([spread.lower_quartile, spread.median, spread.upper_quartile]),
    });
    html! {
        @if let Some(picture) = &picture { div class="plots alone" { (still_figure(picture)) } }
        (words(spread, statistics))
        details class="more" {
            summary { "The same as a table" }
            (table("Students by points", "bins", &[("Points", false), ("Students", true)], &rows(&bins)))
        }
    }
}

fn words(spread: &Spread, statistics: &LabStatistics) -> Markup {
    html! {
        p {
            "Half of the " (spread.n) " grades lie between " (tenths(spread.lower_quartile)) " and " (tenths(spread.upper_quartile))
            " points, all of them between " (points(spread.least)) " and " (points(spread.greatest)) ". "
            @if statistics.full_marks > 0 { (statistics.full_marks) @if statistics.full_marks == 1 { " has" } @else { " have" } " all points. " }
            "Points by hand count here and in no other section."
        }
    }
}

fn rows(bins: &[(f64, f64, usize)]) -> Vec<Vec<Markup>> {
    let rows = bins.iter().enumerate().map(|(i, (from, to, students))| {
        let below = if i + 1 == bins.len() { "" } else { "below " };
        let range = html! { (points(*from)) " to " (below) (points(*to)) };
        vec![range, html! { (students) }]
    });
    rows.collect()
}
