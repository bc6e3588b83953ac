//! The table of students, for course staff: sorted by a click on a column's name and filtered by what is typed and chosen, where the
//! browser runs scripts; a plain list where it does not.

use std::collections::BTreeMap;

use kinemark_grader::record::quantity::points;
use kinemark_report::html::{SmallScript, foreign};
use maud::{Markup, html};

use super::shown::or_dash;
use crate::roster::Roster;
use crate::standing::Status;
use crate::standing_rows::StandingRow;

/// Sorts a table with `data-sortable`, and filters that of students.
pub const SORTED_TABLE: SmallScript<'_> = SmallScript {
    code: include_str!("table.js"),
    digest: include_str!("table.js.sha256"),
};

/// A row of the table: a student in a lab.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedStudent {
    /// The full name; empty where the roster has none.
    pub name: String,
    /// The section; empty where there is none.
    pub section: String,
    /// How they stand.
    pub standing: StandingRow,
    /// The address of the report, seen from the page; none where there is none.
    pub report: Option<String>,
}

impl NamedStudent {
    /// The id.
    pub(super) fn id(&self) -> &str {
        self.standing.student.as_str()
    }
}

/// The rows of `standings` with the names of `roster`; `report` gives the address of each report.
pub fn named_students(
    standings: impl IntoIterator<Item = StandingRow>,
    roster: &Roster,
    report: impl Fn(&StandingRow) -> Option<String>,
) -> Vec<NamedStudent> {
    // the roster looks an id up from its beginning, and a book has thousands of rows
    let people: BTreeMap<_, _> = roster
        .people()
        .iter()
        .map(|person| (&person.id, person))
        .collect();
    let students = standings.into_iter().map(|standing| {
        let person = people.get(&standing.student);
        NamedStudent {
            name: person.map(|person| person.name.clone()).unwrap_or_default(),
            section: person
                .map(|person| person.section.clone())
                .unwrap_or_default(),
            report: report(&standing),
            standing,
        }
    });
    students.collect()
}

/// A column: its name, and whether it holds numbers and is sorted by them.
type Column = (&'static str, bool);

const COLUMNS: [Column; 9] = [
    ("Name", false),
    ("Id", false),
    ("Section", false),
    ("Lab", false),
    ("Status", false),
    ("Points", true),
    ("Attempts", true),
    ("Late", true),
    ("Report", false),
];

/// The table with what filters it; with a column of labs where `labs` has any.
pub(super) fn table_of(students: &[NamedStudent], labs: &[&str]) -> Markup {
    let columns = COLUMNS
        .iter()
        .filter(|(name, _)| *name != "Lab" || !labs.is_empty());
    html! {
        (filters(students, labs))
        div class="wide" tabindex="0" role="group" aria-label="Students" {
            table class="students" role="table" data-sortable data-filters="filters" {
                caption class="unseen" { "Students with their points" }
                thead role="rowgroup" {
                    tr role="row" {
                        @for (name, is_number) in columns {
                            th scope="col" role="columnheader" class=[is_number.then_some("number")] data-unsorted[*name == "Report"] { (name) }
                        }
                    }
                }
                tbody role="rowgroup" { @for student in students { (row(student, !labs.is_empty())) } }
            }
        }
    }
}

/// What filters the table: hidden until the script runs, which alone can filter.
fn filters(students: &[NamedStudent], labs: &[&str]) -> Markup {
    let statuses: Vec<Status> = Status::ALL
        .into_iter()
        .filter(|status| students.iter().any(|row| row.standing.status == *status))
        .collect();
    html! {
        div id="filters" class="filters" role="search" hidden {
            label { "Find " input type="search" name="text" placeholder="name, id or section" autocomplete="off" spellcheck="false"; }
            @if !labs.is_empty() {
                label { "Lab " select name="lab" { option value="" { "all" } @for lab in labs { option { (lab) } } } }
            }
            label {
                "Status "
                select name="status" {
                    option value="" { "all" }
                    @for status in statuses { option value=(status.name()) { (status.words()) } }
                }
            }
            span role="status" {}
        }
    }
}

fn row(student: &NamedStudent, with_lab: bool) -> Markup {
    let sort_key =
        |value: Option<f64>| value.map_or_else(|| "-1".to_owned(), |value| value.to_string());
    let standing = &student.standing;
    html! {
        tr role="row" data-lab=(standing.lab) data-status=(standing.status.name()) {
            th scope="row" role="rowheader" { @if student.name.is_empty() { (foreign(student.id())) } @else { (foreign(&student.name)) } }
            td role="cell" data-label="Id" { (foreign(student.id())) }
            td role="cell" data-label="Section" { @if !student.section.is_empty() { (foreign(&student.section)) } }
            @if with_lab { td role="cell" data-label="Lab" { (standing.lab) } }
            td role="cell" data-label="Status" {
                span class={ "pill " (colour(standing.status)) } { (standing.status.words()) }
                @if standing.is_without_sources { " " span class="pill partial" { "no sources" } }
                @if standing.is_under_resolved { " " span class="pill partial" { "simulation not accurate" } }
                @if standing.has_stale_fix { " " span class="pill partial" { "stale points by hand" } }
            }
            td role="cell" class="number" data-label="Points" data-key=(sort_key(standing.points)) {
                @match (standing.points, standing.max_points) {
                    (Some(earned), Some(of)) => { (points(earned)) " of " (points(of)) }
                    (Some(earned), None) => (points(earned)),
                    (None, _) => "–",
                }
            }
            td role="cell" class="number" data-label="Attempts" data-key=(standing.attempts) { (standing.attempts) }
            td role="cell" class="number" data-label="Late" data-key=(sort_key(standing.late_s.map(|late_s| late_s as f64))) {
                (or_dash(standing.late_s.map(late)))
            }
            td role="cell" { @if let Some(report) = &student.report { a href=(report) { "Report" span class="unseen" { " of " (foreign(student.id())) " in " (standing.lab) } } } }
        }
    }
}

/// How a status stands out.
fn colour(status: Status) -> &'static str {
    match status {
        Status::Graded => "full",
        Status::HostLimit | Status::GraderFault | Status::NeedsPerson => "none",
        Status::Pending => "partial",
        Status::Missing | Status::Excused => "unjudged",
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
    use base64::Engine as _;
    use sha2::Digest as _;

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

    /// A browser runs no code but that of the digest; `KINEMARK_BLESS=1` writes it anew.
    #[test]
    fn the_digest_is_that_of_the_script() {
        let digest = sha2::Sha256::digest(SORTED_TABLE.code);
        let digest = base64::engine::general_purpose::STANDARD.encode(digest);
        let is_it = SORTED_TABLE.digest.trim() == digest;
        if !is_it && std::env::var_os("KINEMARK_BLESS").is_some() {
            let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/page/table.js.sha256");
            std::fs::write(path, format!("{digest}\n")).unwrap();
        }
        assert!(
            is_it,
            "not that of the script: KINEMARK_BLESS=1 cargo test writes it (docs/tests.md)"
        );
        assert!(
            !SORTED_TABLE.code.contains("</") && !SORTED_TABLE.code.contains("<!--"),
            "it would end in the middle"
        );
    }
}
