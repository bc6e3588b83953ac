//! The page for course staff alone: what is worth a conversation, with its base rate, and clusters of wrong answers with ids.

use kinemark_report::html::{StaticPage, foreign};
use kinemark_report::visible::visible;
use maud::{Markup, html};

use super::head::PageHead;
use super::losses::likeness;
use super::shown::{CSS, count, or_dash, percent, section, table};
use crate::clusters::Cluster;
use crate::similarity::{Finding, Found, Whose};

/// Findings that are shown.
const MOST_FINDINGS: usize = 200;

/// The page of a lab for course staff alone. It has ids and no names. The same findings give the same bytes.
pub fn staff_page(
    lab: &str,
    findings: &[Finding],
    clusters: &[Cluster],
    page_head: &PageHead,
) -> String {
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
            (section("similarity", "Worth a conversation", &similarity(findings)))
            (section("clusters", "Equal wrong answers without a name", &with_ids(clusters)))
        }
        (footer(page_head))
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

fn similarity(findings: &[Finding]) -> Markup {
    html! {
        p class="lead" {
            "Files that share what is hard to come by independently. It is a reason to talk, and no verdict: two people who learned together, \
            a common book or a helpful forum look the same. The base rate says how many of the class share it."
        }
        @if findings.is_empty() { p { "Nothing was found." } }
        ol class="findings" { @for (i, found) in findings.iter().take(MOST_FINDINGS).enumerate() { li { (finding(i, found)) } } }
        @if findings.len() > MOST_FINDINGS { p class="quiet" { "The first " (MOST_FINDINGS) " of " (findings.len()) " findings." } }
    }
}

fn finding(index: usize, finding: &Finding) -> Markup {
    let id = format!("finding-{}", index + 1);
    let students: Vec<&str> = finding.students().map(|student| student.as_str()).collect();
    html! {
        article aria-labelledby=(id) {
            h3 id=(id) { @for (i, student) in students.iter().enumerate() { @if i > 0 { ", " } (foreign(student)) } }
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

fn with_ids(clusters: &[Cluster]) -> Markup {
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
        ("Example", false),
    ];
    let rows = html! {
        @for cluster in clusters {
            @let ids: Vec<&str> = cluster.students.iter().map(|student| student.as_str()).collect();
            tr {
                th scope="row" { (foreign(&cluster.task_title)) }
                td { (count(ids.len(), "student", "students")) ": " @for (i, id) in ids.iter().enumerate() { @if i > 0 { ", " } (foreign(id)) } }
                td class="number" { (cluster.submissions) }
                td { (likeness(cluster.likeness)) }
                td class="number" { (or_dash(cluster.keeps.map(percent))) }
                td { (foreign(&cluster.lost.join("; "))) }
                td class="digest" { code { (foreign(&cluster.example.chars().take(12).collect::<String>())) } }
            }
        }
    };
    html! {
        p class="lead" { "Different files with the same wrong answer, which no common mistake explains. The example is the beginning of a record's key." }
        (table("Clusters with ids", "clusters", &head, &rows))
    }
}

fn footer(page_head: &PageHead) -> Markup {
    html! {
        footer {
            h2 { "What was looked for" }
            p { "Whole files that are equal but for white space; numbers of another student's variant; passages of at least 60 tokens, or 40 with at least ten words of comments, that at most one in twenty of the class share; the same with earlier and public files, whatever their base rate." }
            p { "What everybody was given is taken out first, and within the class the reference solution. Members of a group share files by right and are not compared. Renamed variables and numbers that were worked out from a variant are not seen." }
            p class="quiet" { (foreign(&page_head.engine)) }
        }
    }
}
