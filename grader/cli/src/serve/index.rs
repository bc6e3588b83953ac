//! The list of several reports in one folder, with what each earned.

use std::path::Path;

use kinemark_grader::record::grade::{Grade, GradeMode};
use kinemark_grader::record::quantity::points;
use kinemark_grader::record::sums;
use kinemark_report::moment::ADDRESS_PART;
use kinemark_report::output::{PAGE_FILE, RECORD_FILE};
use kinemark_report::visible::visible;
use maud::{DOCTYPE, html};
use percent_encoding::utf8_percent_encode;

use super::files;
use super::token::Token;
use crate::beneath;

/// Pages that are opened at once, where the folder has one.
pub(crate) const FIRST: [&str; 2] = [PAGE_FILE, "compare.html"];

/// No lab has more points: beyond, a record is no work of ours.
const MOST_POINTS: f64 = 1e6;

/// A course has a few hundred.
const MOST_REPORTS: usize = 2_000;

/// One report or comparison below the folder.
struct Entry {
    folder: String,
    page: &'static str,
    grade: Option<Grade>,
}

/// Whether there is anything to look at in `folder`.
pub(crate) fn has_reports(folder: &Path) -> bool {
    let is_page = |page: &&str| files::is_there(folder, page);
    FIRST.iter().any(is_page) || found(folder).next().is_some()
}

/// Folders of `folder` with the page in each that is served, by name.
fn found(folder: &Path) -> impl Iterator<Item = (String, &'static str)> {
    let inside = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = inside
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect();
    names.sort();
    names.into_iter().filter_map(|name| {
        let page = FIRST
            .into_iter()
            .find(|page| files::is_there(folder, &format!("{name}/{page}")))?;
        Some((name, page))
    })
}

fn entry(folder: &Path, name: String, page: &'static str) -> Entry {
    let record = beneath::bytes(folder, &format!("{name}/{RECORD_FILE}"), 64 << 20).ok();
    Entry {
        folder: name,
        page,
        grade: record.and_then(|record| serde_json::from_slice(&record).ok()),
    }
}

/// The list as a page; each report has an address of its own.
pub(super) fn page(folder: &Path, token: &Token) -> String {
    let mut found = found(folder);
    let entries: Vec<Entry> = found
        .by_ref()
        .take(MOST_REPORTS)
        .map(|(name, page)| entry(folder, name, page))
        .collect();
    let more = found.count();
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { "Reports" }
                style {
                    "body{font:1rem/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem}"
                    "table{border-collapse:collapse;width:100%}th,td{text-align:left;padding:.4rem .8rem .4rem 0;border-bottom:1px solid #8886}"
                    ".number{text-align:right;font-variant-numeric:tabular-nums}"
                }
            }
            body {
                main {
                    h1 { "Reports" }
                    @if entries.is_empty() {
                        p { "There is no report here now." }
                    } @else {
                        table {
                            thead {
                                tr {
                                    th scope="col" { "Report" }
                                    th scope="col" { "Lab" }
                                    th scope="col" { "Submission" }
                                    th scope="col" { "Mode" }
                                    th scope="col" { "Verdict" }
                                    th scope="col" class="number" { "Points" }
                                }
                            }
                            tbody {
                                @for entry in &entries { (row(entry, token)) }
                            }
                        }
                        @if more > 0 {
                            p {
                                "and " (more) " more: `kinemark view` lists " (MOST_REPORTS)
                                "; give it the folder of one of them"
                            }
                        }
                    }
                }
            }
        }
    };
    page.into_string()
}

fn row(entry: &Entry, token: &Token) -> maud::Markup {
    let folder = utf8_percent_encode(&entry.folder, ADDRESS_PART);
    let link = format!(
        "/{}/{folder}/{}",
        token.of_folder(&entry.folder),
        entry.page
    );
    html! {
        tr {
            th scope="row" { a href=(link) { bdi { (visible(&entry.folder)) } } }
            @match &entry.grade {
                Some(grade) => {
                    td { bdi { (visible(&grade.lab.name)) } }
                    td { bdi { (visible(&grade.submission.name)) } }
                    @if is_consistent(grade) {
                        td { (mode(grade.mode)) }
                        td { (grade.verdict.name()) }
                        td class="number" { (points(grade.points)) " of " (points(grade.max_points)) }
                    } @else {
                        td colspan="3" { "changed: its points contradict each other" }
                    }
                }
                None if entry.page == "compare.html" => { td colspan="5" { "two runs compared" } }
                None => { td colspan="5" { "its record cannot be read" } }
            }
        }
    }
}

fn mode(mode: GradeMode) -> &'static str {
    match mode {
        GradeMode::Practice => "practice",
        GradeMode::Graded => "graded",
    }
}

/// Whether the points of a record can be those of a grade. That it is the grade of its submission, only `kinemark verify` shows.
fn is_consistent(grade: &Grade) -> bool {
    let is_bounded = (0.0..=MOST_POINTS).contains(&grade.max_points)
        && (0.0..=grade.max_points).contains(&grade.points);
    is_bounded && sums::contradictions(grade).is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_parts_of_addresses_and_text() {
        let encoded = utf8_percent_encode("a b/é\"<.-_~", ADDRESS_PART).to_string();
        assert_eq!(encoded, "a%20b%2F%C3%A9%22%3C.-_~");
        let bed = tempfile::tempdir().unwrap();
        assert!(!has_reports(bed.path()));
        let folder = bed.path().join("<b>x");
        std::fs::create_dir(&folder).unwrap();
        std::fs::write(folder.join("report.html"), "").unwrap();
        assert!(has_reports(bed.path()));
        let token = Token::fresh().unwrap();
        let page = page(bed.path(), &token);
        let link = format!("href=\"/{}/%3Cb%3Ex/report.html\"", token.of_folder("<b>x"));
        assert!(page.contains(&link), "{page}");
        assert!(!page.contains(&token.of_all()), "each report has its own");
        assert!(!page.contains("<b>"), "{page}");
        assert!(page.contains("its record cannot be read"));
    }

    #[test]
    fn what_is_reached_by_a_link_is_not_listed_and_what_is_left_out_is_reported() {
        let bed = tempfile::tempdir().unwrap();
        let folder = bed.path().join("all");
        std::fs::create_dir(&folder).unwrap();
        for name in ["outside", "all/.hidden"] {
            std::fs::create_dir(bed.path().join(name)).unwrap();
            std::fs::write(bed.path().join(name).join("report.html"), "").unwrap();
        }
        #[cfg(unix)]
        {
            use std::os::unix::fs::symlink;
            symlink("../outside", folder.join("link")).unwrap();
            std::fs::create_dir(folder.join("page")).unwrap();
            symlink("../../outside/report.html", folder.join("page/report.html")).unwrap();
            std::fs::create_dir(folder.join("inside")).unwrap();
            std::fs::write(folder.join("inside/page.html"), "").unwrap();
            symlink("page.html", folder.join("inside/report.html")).unwrap();
        }
        assert!(!has_reports(&folder), "none of them is served");
        let token = Token::fresh().unwrap();
        assert!(page(&folder, &token).contains("There is no report here now."));
        for i in 0..=MOST_REPORTS {
            let report = folder.join(format!("{i:04}"));
            std::fs::create_dir(&report).unwrap();
            std::fs::write(report.join("report.html"), "").unwrap();
        }
        let page = page(&folder, &token);
        assert!(page.contains("/1999/report.html") && !page.contains("/2000/report.html"));
        assert!(page.contains("and 1 more"));
    }
}
