//! The page for course staff alone: what is worth a conversation, with its base rate, and clusters of wrong answers with ids.

use kinemark_report::html::{StaticPage, foreign};
use kinemark_report::visible::visible;
use maud::{Markup, html};

use super::head::PageHead;
use super::losses::likeness;
use super::names::NamedStudent;
use super::shown::{CSS, count, or_dash, percent, section, table};
use crate::clusters::Cluster;
use crate::similarity::{Finding, Found, Whose};
use crate::student::StudentId;

/// Findings that are shown.
const MOST_FINDINGS: usize = 200;

/// What the page of course staff shows.
#[derive(Debug, Clone, Copy)]
pub struct StaffPage<'a> {
    /// The lab's name.
    pub lab: &'a str,
    /// What is worth a conversation.
    pub findings: &'a [Finding],
    /// Equal wrong answers.
    pub clusters: &'a [Cluster],
    /// Everybody in the lab, with the addresses of the reports.
    pub students: &'a [NamedStudent],
    /// What the files were compared with besides each other, in words.
    pub compared_with: &'a str,
}

impl StaffPage<'_> {
    /// An id, as a link to the report where there is one.
    fn linked(&self, id: &str) -> Markup {
        let mut students = self.students.iter();
        let report = students
            .find(|student| student.id() == id)
            .and_then(|student| student.report.as_ref());
        html! { @if let Some(report) = report { a href=(report) { (foreign(id)) } } @else { (foreign(id)) } }
    }

    fn linked_all<'s>(&self, ids: impl Iterator<Item = &'s StudentId>) -> Markup {
        html! { @for (i, id) in ids.enumerate() { @if i > 0 { ", " } (self.linked(id.as_str())) } }
    }
}

/// The page of a lab for course staff alone. It has ids and no names. The same findings give the same bytes.
pub fn staff_page(shown: &StaffPage<'_>, page_head: &PageHead) -> String {
    let lab = shown.lab;
    let title = page_head.title(lab);
    let body = html! {
        a class="skip" href="#similarity" { "Skip to the findings" }
        header class="head" {
            p class="eyebrow" { "Kinemark class, for course staff" }
            h1 { (foreign(title)) }
            p class="by" { (foreign(&page_head.course)) " · " (foreign(lab)) }
            p class="note bad" { strong { "For course staff. " } "This page has ids: do not project it, and do not send it on. Nothing on it is in a gradebook or in feedback." }
            nav aria-label="Parts of this page" { ul {
                li { a href="#similarity" { "Worth a conversation" } }
                li { a href="#clusters" { "Equal wrong answers" } }
            } }
        }
        main {
            (section("similarity", "Worth a conversation", &similarity(shown)))
            (section("clusters", "Equal wrong answers without a name", &with_ids(shown)))
        }
        (footer(shown, page_head))
    };
    let title = format!("{title}: for course staff");
    let page = StaticPage {
        title: &title,
        engine: &page_head.engine,
        css: CSS,
        script: None,
    };
    page.around(&body)
}

fn similarity(shown: &StaffPage<'_>) -> Markup {
    let findings = shown.findings;
    html! {
        p class="lead" {
            "Files that share what is hard to come by independently. It is a reason to talk, and no verdict: two people who learned together, \
            a common book or a helpful forum look the same. The base rate says how many of the class share it."
        }
        @if findings.is_empty() { p { "Nothing was found." } }
        ol class="findings" { @for (i, found) in findings.iter().take(MOST_FINDINGS).enumerate() { li { (finding(shown, i, found)) } } }
        @if findings.len() > MOST_FINDINGS { p class="quiet" { "The first " (MOST_FINDINGS) " of " (findings.len()) " findings." } }
    }
}

fn finding(shown: &StaffPage<'_>, index: usize, finding: &Finding) -> Markup {
    let id = format!("finding-{}", index + 1);
    html! {
        article aria-labelledby=(id) {
            h3 id=(id) { (shown.linked_all(finding.students())) }
            p { span class="pill unjudged" { (finding.kind.words()) } " " (foreign(&finding.says)) }
            p { "Base rate: " strong { (finding.base_rate()) } " of the class." }
            ul class="where-found" { @for found in &finding.files { li { (place(found)) } } }
            @if !finding.excerpt.is_empty() {
                pre class="code" tabindex="0" aria-label={ "A piece of it, finding " (index + 1) } {
                    code { @for line in finding.excerpt.lines() { (visible(line)) "\n" } }
                }
            }
        }
    }
}

/// A file and its lines.
fn place(found: &Found) -> Markup {
    let lines: Vec<String> = found
        .lines
        .iter()
        .map(|(from, to)| {
            if from == to {
                from.to_string()
            } else {
                format!("{from}–{to}")
            }
        })
        .collect();
    html! {
        @match &found.whose {
            Whose::Student(student) => { (foreign(student.as_str())) @if !found.file.is_empty() { ", " code { (foreign(&found.file)) } } }
            Whose::Earlier(path) => { "earlier or public: " code { (foreign(path)) } }
        }
        @match lines.as_slice() {
            [] => {}
            [one] if !one.contains('–') => { ", line " (one) }
            many => { ", lines " (many.join(", ")) }
        }
    }
}

fn with_ids(shown: &StaffPage<'_>) -> Markup {
    let clusters = shown.clusters;
    if clusters.is_empty() {
        return html! { p { "No two files give the same wrong answer without a name." } };
    }
    let head = [
        ("Task", false),
        ("Students", false),
        ("Files", true),
        ("Alike in", false),
        ("Keep", true),
        ("Lost in", false),
    ];
    let rows: Vec<Vec<Markup>> = clusters
        .iter()
        .map(|cluster| {
            let students = count(cluster.students.len(), "student", "students");
            vec![
                html! { (foreign(&cluster.task_title)) },
                html! { (students) ": " (shown.linked_all(cluster.students.iter())) },
                html! { (cluster.submissions) },
                html! { (likeness(cluster.likeness)) },
                html! { (or_dash(cluster.keeps.map(percent))) },
                html! { (foreign(&cluster.lost.join("; "))) },
            ]
        })
        .collect();
    html! {
        p class="lead" { "Different files with the same wrong answer, which no common mistake explains. Each id leads to its report." }
        (table("Clusters with ids", "clusters", &head, &rows))
    }
}

fn footer(shown: &StaffPage<'_>, page_head: &PageHead) -> Markup {
    html! {
        footer {
            h2 { "What was looked for" }
            p { "The files were compared with each other" @if !shown.compared_with.is_empty() { ", and with " (foreign(shown.compared_with)) } "." }
            ul class="where-found" {
                li { "Whole files that are equal but for white space." }
                li { "Numbers of another student's variant." }
                li { "Passages of at least 60 tokens, or of 40 with at least ten words of comments, that at most one in twenty of the class share (three in a small class); with such comments, also those that up to half of the class share." }
                li { "The same with earlier and public files, whatever their base rate." }
            }
            p { "What everybody was given is taken out first, and within the class the reference solution. Members of a group share files by right and are not compared. Renamed variables and numbers that were worked out from a variant are not seen: the folders for JPlag and Dolos beside this page are for those who look for them." }
            p class="quiet" { (foreign(&page_head.engine)) }
        }
    }
}
