//! The head of the class's page: which lab, how many students, how it went, and what graded.

use kinemark_grader::record::quantity::points;
use kinemark_report::html::foreign;
use maud::{Markup, html};

use super::shown::{count, tenths};
use crate::standing::Status;
use crate::statistics::{LabStatistics, Version};

/// What the statistics do not know.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PageHead {
    /// The course's title.
    pub course: String,
    /// The lab's title; its name is shown where this is empty.
    pub lab_title: String,
    /// The engine that makes the page.
    pub engine: String,
}

impl PageHead {
    /// What the lab is called.
    pub(super) fn title<'a>(&'a self, lab: &'a str) -> &'a str {
        match self.lab_title.trim() {
            "" => lab,
            title => title,
        }
    }
}

/// The head of a page of the class: `eyebrow` says which page, `notice` who may see it.
pub(super) fn head(
    head: &PageHead,
    statistics: &LabStatistics,
    eyebrow: &str,
    notice: &Markup,
    links: &[(&str, &str)],
) -> Markup {
    html! {
        header class="head" {
            p class="eyebrow" { (eyebrow) }
            h1 { (foreign(head.title(&statistics.lab))) }
            p class="by" { (foreign(&head.course)) " · " (foreign(&statistics.lab)) " · " (count(statistics.students, "student", "students")) }
            @for version in &statistics.versions { (graded_by(version)) }
            @if statistics.versions.len() > 1 {
                p class="note bad" { "Grades of different versions are compared on this page. " code { "kinemark course regrade" } " makes them equal." }
            }
            (notice)
            (tiles(statistics))
            nav aria-label="Parts of this page" { ul { @for (id, title) in links { li { a href={ "#" (id) } { (title) } } } } }
        }
    }
}

fn graded_by(version: &Version) -> Markup {
    // as many digits as anybody compares by eye
    let lab = version.lab_version.chars().take(12).collect::<String>();
    html! {
        p class="by" {
            (count(version.students, "grade", "grades")) " by " (foreign(&version.engine)) ", lab version "
            code { (foreign(&lab)) }
        }
    }
}

/// The numbers that one looks for first.
fn tiles(statistics: &LabStatistics) -> Markup {
    let of = points(statistics.max_points);
    html! {
        dl class="tiles" {
            @if let Some(spread) = &statistics.points {
                div { dt { "Mean" } dd { b { (tenths(spread.mean)) } " of " (of) } }
                div { dt { "Median" } dd { b { (tenths(spread.median)) } " of " (of) } }
                div { dt { "Full marks" } dd { b { (statistics.full_marks) } " of " (spread.n) } }
            }
            div { dt { "Graded" } dd { b { (statistics.at(Status::Graded)) } " of " (statistics.students) } }
            @for count in statistics.statuses.iter().filter(|count| count.status != Status::Graded) {
                div { dt { (capital(count.status.words())) } dd { b { (count.students) } } }
            }
            @if statistics.by_hand > 0 { div { dt { "With points by hand" } dd { b { (statistics.by_hand) } } } }
        }
    }
}

/// Words with a capital at their beginning.
fn capital(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(char::to_uppercase);
    first.into_iter().flatten().chain(letters).collect()
}
