//! Where points went: hidden runs, named mistakes, wrong answers without a name; and what took longest.

use kinemark_grader::record::quantity::points;
use kinemark_report::html::{foreign, prose};
use kinemark_sim::text::number::trimmed;
use maud::{Markup, html};

use super::names::NamedStudent;
use super::shown::{count, or_dash, percent, table};
use crate::clusters::{Cluster, Likeness};
use crate::statistics::{LabStatistics, SlowRun};

/// Checks that lost points where everything visible was full.
pub(super) fn hidden(statistics: &LabStatistics) -> Markup {
    let lost: Vec<_> = statistics
        .checks
        .iter()
        .filter(|check| check.hidden_only.students > 0)
        .collect();
    if lost.is_empty() {
        return html! { p { "No check lost points in hidden cases or runs alone." } };
    }
    let head = [
        ("Check", false),
        ("Students", true),
        ("Points lost", true),
        ("Each", true),
    ];
    let rows: Vec<Vec<Markup>> = lost
        .iter()
        .map(|check| {
            let each = check.hidden_only.points / check.hidden_only.students as f64;
            vec![
                html! { (foreign(&check.task_title)) ": " (foreign(&check.title)) },
                html! { (check.hidden_only.students) },
                html! { (points(check.hidden_only.points)) },
                html! { (trimmed(each, 2)) " of " (points(check.max_points)) },
            ]
        })
        .collect();
    html! {
        p class="lead" {
            "These students could not see a loss at home. Where they are many, a visible case like the hidden ones is missing."
        }
        (table("Points lost in hidden cases and runs alone", "losses", &head, &rows))
    }
}

/// Named mistakes with what they keep.
pub(super) fn mistakes(statistics: &LabStatistics) -> Markup {
    if statistics.mistakes.is_empty() {
        return html! { p { "No answer agrees with a common mistake." } };
    }
    let head = [
        ("Mistake", false),
        ("Task", false),
        ("Students", true),
        ("Of the task", true),
        ("Of the lab", true),
    ];
    let rows: Vec<Vec<Markup>> = statistics
        .mistakes
        .iter()
        .map(|mistake| {
            vec![
                html! { code { (foreign(&mistake.mistake)) } " " small { (prose(&mistake.says)) } },
                html! { (foreign(&mistake.task_title)) },
                html! { (mistake.students) },
                html! { (or_dash(mistake.task_share.map(percent))) },
                html! { (or_dash(mistake.lab_share.map(percent))) },
            ]
        })
        .collect();
    html! {
        p class="lead" { "The last two columns are the points that those who make it keep, on average. A wrong idea that keeps nearly everything is too cheap." }
        (table("Named mistakes", "mistakes", &head, &rows))
    }
}

/// Clusters without ids.
pub(super) fn clusters(clusters: &[Cluster]) -> Markup {
    if clusters.is_empty() {
        return html! { p { "No two files give the same wrong answer without a name." } };
    }
    let head = [
        ("Task", false),
        ("Students", true),
        ("Alike in", false),
        ("Keep", true),
        ("Lost in", false),
    ];
    let rows: Vec<Vec<Markup>> = clusters
        .iter()
        .map(|cluster| {
            vec![
                html! { (foreign(&cluster.task_title)) },
                html! { (cluster.students.len()) },
                html! { (likeness(cluster.likeness)) },
                html! { (or_dash(cluster.keeps.map(percent))) },
                html! { (foreign(&cluster.lost.join("; "))) },
            ]
        })
        .collect();
    html! {
        p class="lead" { "The same wrong answer from different files, which no common mistake explains: worth a word to the class, and next year a mutant. What keeps \
            nothing in every task is often the starter, or an arm that never moves." }
        (table("Equal wrong answers without a name", "clusters", &head, &rows))
    }
}

/// How a cluster is alike, in words.
pub(super) fn likeness(likeness: Likeness) -> &'static str {
    match likeness {
        Likeness::Answers => "every answer",
        Likeness::Losses => "every loss",
    }
}

/// A run is slow from so many times the operations of the class's median.
const SLOW: f64 = 2.0;

/// The slowest runs; with names also whose they are.
pub(super) fn slow_runs(statistics: &LabStatistics, names: Option<&[NamedStudent]>) -> Markup {
    let slow: Vec<(&SlowRun, f64)> = statistics
        .slow_runs
        .iter()
        .filter_map(|run| Some((run, run.times_median?)))
        .filter(|(_, times)| *times >= SLOW)
        .collect();
    if slow.is_empty() {
        return html! { p { "No run took twice the operations of the class's median in its task." } };
    }
    let mut head = vec![
        ("Task", false),
        ("Operations", true),
        ("Of the median", true),
    ];
    if names.is_some() {
        head.push(("Students", false));
    }
    let rows: Vec<Vec<Markup>> = slow
        .into_iter()
        .map(|(run, times)| {
            let mut cells = vec![
                html! { (foreign(&run.task_title)) },
                html! { (grouped(run.operations)) },
                html! { (trimmed(times, 1)) "\u{a0}times" },
            ];
            cells.extend(names.map(|names| html! { (foreign(&whose(run, names))) }));
            cells
        })
        .collect();
    html! {
        p class="lead" {
            "Runs that took twice the operations of the class's median in their task, or more; ten at most. Operations are counted, not \
            timed: they are the same on every machine. Of function tasks they are those of visible cases."
        }
        (table("The slowest runs", "runs", &head, &rows))
    }
}

fn whose(run: &SlowRun, names: &[NamedStudent]) -> String {
    let of = names
        .iter()
        .filter(|student| student.standing.record.as_ref() == Some(&run.record));
    let ids: Vec<&str> = of.map(NamedStudent::id).collect();
    if ids.is_empty() {
        count(run.students, "student", "students")
    } else {
        ids.join(", ")
    }
}

/// An integer in groups of three digits.
fn grouped(value: u64) -> String {
    let digits = value.to_string();
    let mut shown = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            shown.push('\u{202f}');
        }
        shown.push(digit);
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_numbers_are_in_groups() {
        assert_eq!(grouped(7), "7");
        assert_eq!(grouped(1_234_567), "1\u{202f}234\u{202f}567");
        assert_eq!(grouped(123_456), "123\u{202f}456");
    }
}
