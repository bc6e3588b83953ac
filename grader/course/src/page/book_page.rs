//! The book as a page for course staff: everybody in every lab, and the pages of the class.

use std::collections::BTreeSet;

use kinemark_report::html::{StaticPage, foreign};
use maud::{Markup, html};

use super::names::{NamedStudent, SORTED_TABLE, table_of};
use super::shown::{CSS, count, section};

/// What the page shows.
#[derive(Debug, Clone, PartialEq)]
pub struct BookList {
    /// The course's title; empty where the course was not found.
    pub course: String,
    /// The engine that makes the page.
    pub engine: String,
    /// Everybody in every lab.
    pub students: Vec<NamedStudent>,
    /// The labs, in the course's order, with their pages.
    pub labs: Vec<LabPages>,
    /// What whoever reads it should know, such as why there are no names.
    pub notes: Vec<String>,
}

/// The pages of a lab.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LabPages {
    /// The lab's name.
    pub lab: String,
    /// What each page is, in words, and its address.
    pub pages: Vec<(&'static str, String)>,
}

/// The page. The same book gives the same bytes.
pub fn book_page(list: &BookList) -> String {
    let labs: Vec<&str> = list.labs.iter().map(|lab| lab.lab.as_str()).collect();
    let students: BTreeSet<&str> = list.students.iter().map(NamedStudent::id).collect();
    let title = if list.course.trim().is_empty() {
        "The book"
    } else {
        &list.course
    };
    let body = html! {
        a class="skip" href="#students" { "Skip to the students" }
        header class="head" {
            p class="eyebrow" { "Kinemark book, for course staff" }
            h1 { (foreign(title)) }
            p class="by" { (count(students.len(), "student", "students")) " in " (count(labs.len(), "lab", "labs")) }
            @for note in &list.notes { p class="note hint" { (foreign(note)) } }
        }
        main {
            @if !list.labs.is_empty() { (section("classes", "The class in each lab", &classes(&list.labs))) }
            (section("students", "Students", &of_students(list, &labs)))
        }
    };
    let page = StaticPage {
        title,
        engine: &list.engine,
        css: CSS,
        script: Some(SORTED_TABLE),
    };
    page.around(&body)
}

fn classes(labs: &[LabPages]) -> Markup {
    html! {
        ul class="class-pages" {
            @for lab in labs {
                li {
                    strong { (lab.lab) } " "
                    @if lab.pages.is_empty() { span class="quiet" { "no page yet: " code { "kinemark course page " (lab.lab) } } }
                    @for (i, (words, address)) in lab.pages.iter().enumerate() { @if i > 0 { " · " } a href=(address) { (words) span class="unseen" { ", " (lab.lab) } } }
                }
            }
        }
    }
}

fn of_students(list: &BookList, labs: &[&str]) -> Markup {
    if list.students.is_empty() {
        return html! { p { "Nobody is listed yet: " code { "kinemark course status" } " writes how everybody stands." } };
    }
    table_of(&list.students, labs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::standing::Status;
    use crate::standing_rows::StandingRow;
    use crate::student::StudentId;

    #[test]
    fn a_row_says_who_where_and_how_many_points() {
        let row = NamedStudent {
            name: "<b>Ann\u{202e}".to_owned(),
            section: "A".to_owned(),
            standing: StandingRow {
                student: StudentId::new("s1").unwrap(),
                lab: "01-kinematics".to_owned(),
                status: Status::Graded,
                attempts: 2,
                record: Some("ab".to_owned()),
                points: Some(17.5),
                max_points: Some(24.0),
                late_s: Some(60),
                has_stale_fix: true,
                is_without_sources: true,
                is_under_resolved: true,
            },
            report: Some("reports/01-kinematics/ab.html".to_owned()),
        };
        let mut list = BookList {
            course: "Robots".to_owned(),
            engine: "kinemark".to_owned(),
            students: vec![row],
            labs: vec![LabPages {
                lab: "01-kinematics".to_owned(),
                pages: vec![("the class", "pages/01-kinematics/class.html".to_owned())],
            }],
            notes: Vec::new(),
        };
        let page = book_page(&list);
        for part in [
            "<h1><bdi>Robots</bdi></h1>",
            "&lt;b&gt;Ann⟨U+202E⟩",
            "17.5 of 24",
            "stale points by hand",
            "simulation not accurate",
            "href=\"reports/01-kinematics/ab.html\"",
            "href=\"pages/01-kinematics/class.html\"",
        ] {
            assert!(page.contains(part), "{part}: {page}");
        }
        assert!(!page.contains("<b>"));
        list.students.clear();
        list.labs[0].pages.clear();
        let page = book_page(&list);
        assert!(page.contains("kinemark course status") && page.contains("no page yet"));
    }
}
