//! The list of several reports in one folder, with what each earned.

use std::path::Path;

use kinemark_grader::grade::Grade;
use kinemark_grader::quantity::points;
use kinemark_grader::report::visible::visible;
use maud::{DOCTYPE, html};

use crate::disk;
use crate::report_folder::RECORD;

/// Pages that are opened at once, where the folder has one.
pub(crate) const FIRST: [&str; 2] = ["report.html", "compare.html"];

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
    let has_page = |folder: &Path| FIRST.iter().any(|page| folder.join(page).is_file());
    let inside = std::fs::read_dir(folder).into_iter().flatten().flatten();
    has_page(folder) || inside.map(|entry| entry.path()).any(|path| has_page(&path))
}

fn entries(folder: &Path) -> Vec<Entry> {
    let inside = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = inside
        .filter_map(|entry| entry.file_name().into_string().ok())
        .filter(|name| !name.starts_with('.'))
        .collect();
    names.sort();
    let found = names.into_iter().filter_map(|name| {
        let below = folder.join(&name);
        let page = FIRST.into_iter().find(|page| below.join(page).is_file())?;
        let record = disk::bytes_of(&below.join(RECORD), 64 << 20).ok();
        Some(Entry {
            folder: name,
            page,
            grade: record.and_then(|record| serde_json::from_slice(&record).ok()),
        })
    });
    found.take(MOST_REPORTS).collect()
}

/// The list as a page.
pub(super) fn page(folder: &Path) -> String {
    let entries = entries(folder);
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
                                    th scope="col" { "Verdict" }
                                    th scope="col" class="number" { "Points" }
                                }
                            }
                            tbody {
                                @for entry in &entries { (row(entry)) }
                            }
                        }
                    }
                }
            }
        }
    };
    page.into_string()
}

fn row(entry: &Entry) -> maud::Markup {
    let link = format!("/{}/{}", encoded(&entry.folder), entry.page);
    html! {
        tr {
            th scope="row" { a href=(link) { bdi { (visible(&entry.folder)) } } }
            @match &entry.grade {
                Some(grade) => {
                    td { bdi { (visible(&grade.lab.name)) } }
                    td { bdi { (visible(&grade.submission.name)) } }
                    td { (grade.verdict.name()) }
                    td class="number" { (points(grade.points)) " of " (points(grade.max_points)) }
                }
                None if entry.page == "compare.html" => { td colspan="4" { "two runs compared" } }
                None => { td colspan="4" { "its record cannot be read" } }
            }
        }
    }
}

/// A name as a part of an address.
fn encoded(name: &str) -> String {
    let mut text = String::new();
    for byte in name.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b'~' => {
                text.push(byte as char);
            }
            other => text += &format!("%{other:02X}"),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_parts_of_addresses_and_text() {
        assert_eq!(encoded("a b/é\"<"), "a%20b%2F%C3%A9%22%3C");
        let bed = tempfile::tempdir().unwrap();
        assert!(!has_reports(bed.path()));
        let folder = bed.path().join("<b>x");
        std::fs::create_dir(&folder).unwrap();
        std::fs::write(folder.join("report.html"), "").unwrap();
        assert!(has_reports(bed.path()));
        let page = page(bed.path());
        assert!(page.contains("href=\"/%3Cb%3Ex/report.html\""), "{page}");
        assert!(!page.contains("<b>"), "{page}");
        assert!(page.contains("its record cannot be read"));
    }
}
