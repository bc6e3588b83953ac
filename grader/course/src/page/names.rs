//! The table of students, for course staff: sorted by a click on a column's name where the browser runs scripts.

use kinemark_grader::record::quantity::points;
use kinemark_report::html::foreign;
use maud::{Markup, html};

use super::shown::or_dash;
use crate::roster::Roster;
use crate::standing::{Standing, Status};
use crate::student::StudentId;

/// A student in the table.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedStudent {
    /// The id.
    pub id: StudentId,
    /// The full name; empty where the roster has none.
    pub name: String,
    /// The section; empty where there is none.
    pub section: String,
    /// Where the grade is.
    pub status: Status,
    /// Points, those by hand included.
    pub points: Option<f64>,
    /// The maximum.
    pub max_points: Option<f64>,
    /// How often they handed in.
    pub attempts: usize,
    /// How late the attempt is that counts \[s\].
    pub late_s: Option<i64>,
    /// The key of the record that counts.
    pub record: Option<String>,
    /// The address of the report, seen from the page; none where there is none.
    pub report: Option<String>,
}

/// The students of `standings` with the names of `roster`; `report` gives the address of each report.
pub fn named_students(
    standings: &[Standing],
    roster: &Roster,
    report: impl Fn(&Standing) -> Option<String>,
) -> Vec<NamedStudent> {
    let students = standings.iter().map(|standing| {
        let person = roster.get(&standing.student);
        NamedStudent {
            id: standing.student.clone(),
            name: person.map(|person| person.name.clone()).unwrap_or_default(),
            section: person
                .map(|person| person.section.clone())
                .unwrap_or_default(),
            status: standing.status,
            points: standing.points,
            max_points: standing.max_points,
            attempts: standing.attempts,
            late_s: standing.late_s,
            record: standing.record.clone(),
            report: report(standing),
        }
    });
    students.collect()
}

/// The columns; those with numbers are sorted by them.
const COLUMNS: [(&str, bool); 8] = [
    ("Name", false),
    ("Id", false),
    ("Section", false),
    ("Status", false),
    ("Points", true),
    ("Attempts", true),
    ("Late", true),
    ("Report", false),
];

/// The section's body.
pub(super) fn names(students: &[NamedStudent]) -> Markup {
    html! {
        div class="wide" tabindex="0" role="group" aria-label="Students" {
            table class="students" data-sortable {
                caption class="unseen" { "Students with their points" }
                thead { tr { @for (name, is_number) in COLUMNS { th scope="col" class=[is_number.then_some("number")] { (name) } } } }
                tbody { @for student in students { (row(student)) } }
            }
        }
    }
}

fn row(student: &NamedStudent) -> Markup {
    let sort_key =
        |value: Option<f64>| value.map_or_else(|| "-1".to_owned(), |value| value.to_string());
    html! {
        tr {
            th scope="row" { @if student.name.is_empty() { (foreign(student.id.as_str())) } @else { (foreign(&student.name)) } }
            td { (foreign(student.id.as_str())) }
            td { (foreign(&student.section)) }
            td { (student.status.words()) }
            td class="number" data-key=(sort_key(student.points)) {
                @match (student.points, student.max_points) {
                    (Some(earned), Some(of)) => { (points(earned)) " of " (points(of)) }
                    (Some(earned), None) => (points(earned)),
                    (None, _) => "–",
                }
            }
            td class="number" data-key=(student.attempts) { (student.attempts) }
            td class="number" data-key=(sort_key(student.late_s.map(|late_s| late_s as f64))) { (or_dash(student.late_s.map(late))) }
            td { @if let Some(report) = &student.report { a href=(report) { "Report" span class="unseen" { " of " (foreign(student.id.as_str())) } } } }
        }
    }
}

/// How late, as a person says it.
fn late(late_s: i64) -> String {
    let (minutes, hours) = ((late_s + 59) / 60, late_s / 3600);
    match late_s {
        late_s if late_s <= 0 => "in time".to_owned(),
        _ if hours == 0 => format!("{minutes}\u{a0}min"),
        _ if hours < 48 => format!("{hours}\u{a0}h"),
        _ => format!("{}\u{a0}days", hours / 24),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lateness_reads_as_people_say_it() {
        let cases = [
            (0, "in time"),
            (1, "1 min"),
            (61, "2 min"),
            (3600, "1 h"),
            (47 * 3600, "47 h"),
            (3 * 86_400, "3 days"),
        ];
        for (late_s, words) in cases {
            assert_eq!(late(late_s).replace('\u{a0}', " "), words);
        }
    }
}
