//! The list of several reports in one folder, with what each earned.

use std::path::Path;

use kinemark_course::page::SORTED_TABLE;
use kinemark_course::staffed_lab::engine_id;
use kinemark_grader::record::grade::{Grade, GradeMode, TaskGrade, TaskKind};
use kinemark_grader::record::quantity::points;
use kinemark_grader::record::sums;
use kinemark_grader::record::verdict::Verdict;
use kinemark_report::html::{StaticPage, verdict_words};
use kinemark_report::moment::ADDRESS_PART;
use kinemark_report::output::{PAGE_FILE, PLOT_FOLDER, RECORD_FILE};
use kinemark_report::plot::path_file;
use kinemark_report::visible::visible;
use maud::{Markup, html};
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
    /// The picture beside it, in its folder.
    picture: Option<String>,
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
    let grade: Option<Grade> = record.and_then(|record| serde_json::from_slice(&record).ok());
    let picture = grade
        .as_ref()
        .and_then(|grade| picture(folder, &name, grade));
    Entry {
        folder: name,
        page,
        grade,
        picture,
    }
}

/// The picture of the path of a motion task. Of several tasks it is that of the one that lost most, else of the last.
fn picture(folder: &Path, name: &str, grade: &Grade) -> Option<String> {
    let lost = |task: &TaskGrade| task.max_points - task.points;
    let mut tasks: Vec<&TaskGrade> = grade
        .tasks
        .iter()
        .filter(|task| task.kind == TaskKind::Motion)
        .collect();
    tasks.reverse();
    tasks.sort_by(|a, b| lost(b).total_cmp(&lost(a)));
    let files = tasks
        .iter()
        .map(|task| format!("{PLOT_FOLDER}/{}", path_file(&task.name)));
    let mut there = files.filter(|file| files::is_there(folder, &format!("{name}/{file}")));
    there.next()
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
    let body = html! {
        header class="head" {
            p class="eyebrow" { "Kinemark" }
            h1 { "Reports" }
            @if let Some(sum) = sum(&entries) { p class="by" { (sum) } }
        }
        main {
            section aria-label="Reports of this folder" {
                @if entries.is_empty() {
                    p { "There is no report here now." }
                } @else {
                    (table(&entries, token))
                    @if more > 0 {
                        p class="quiet" {
                            "and " (more) " more: `kinemark view` lists " (MOST_REPORTS)
                            "; give it the folder of one of them"
                        }
                    }
                }
            }
        }
    };
    let page = StaticPage {
        title: "Reports",
        engine: &engine_id(),
        css: include_str!("index.css"),
        script: Some(SORTED_TABLE),
    };
    page.around_with_pictures(&body)
}

/// How many reports there are, and how many of them have full marks.
fn sum(entries: &[Entry]) -> Option<String> {
    let grades = entries.iter().filter_map(|entry| entry.grade.as_ref());
    let grades: Vec<&Grade> = grades.filter(|grade| is_consistent(grade)).collect();
    let full = grades
        .iter()
        .filter(|grade| grade.verdict == Verdict::Passed)
        .count();
    let noun = if grades.len() == 1 {
        "report"
    } else {
        "reports"
    };
    (!grades.is_empty()).then(|| format!("{} {noun}, {full} with full marks", grades.len()))
}

/// The table, which a browser that runs scripts sorts by a click on the name of a column.
fn table(entries: &[Entry], token: &Token) -> Markup {
    let shows_pictures = entries.iter().any(|entry| entry.picture.is_some());
    html! {
        div class="wide" tabindex="0" role="group" aria-label="Reports" {
            table data-sortable {
                caption class="unseen" { "Reports with what each earned" }
                thead {
                    tr {
                        @if shows_pictures { th scope="col" class="still" data-unsorted { span class="unseen" { "Picture" } } }
                        th scope="col" { "Report" }
                        th scope="col" { "Lab" }
                        th scope="col" { "Submission" }
                        th scope="col" { "Mode" }
                        th scope="col" { "Outcome" }
                        th scope="col" class="number" { "Points" }
                        th scope="col" class="number" { "Share" }
                    }
                }
                tbody { @for entry in entries { (row(entry, token, shows_pictures)) } }
            }
        }
    }
}

fn row(entry: &Entry, token: &Token, shows_pictures: bool) -> Markup {
    let folder = utf8_percent_encode(&entry.folder, ADDRESS_PART);
    let address = format!("/{}/{folder}", token.of_folder(&entry.folder));
    let link = format!("{address}/{}", entry.page);
    html! {
        tr {
            @if shows_pictures {
                td class="still" {
                    @if let Some(file) = &entry.picture {
                        // the same link as the name beside it
                        a href=(link) tabindex="-1" aria-hidden="true" {
                            img src={ (address) "/" (file) } alt="" loading="lazy";
                        }
                    }
                }
            }
            th scope="row" { a href=(link) { bdi { (visible(&entry.folder)) } } }
            @match &entry.grade {
                Some(grade) => {
                    td { bdi { (visible(&grade.lab.name)) } }
                    td { bdi { (visible(&grade.submission.name)) } }
                    @if is_consistent(grade) {
                        @let share = if grade.max_points > 0.0 { 100.0 * grade.points / grade.max_points } else { 0.0 };
                        td { (mode(grade.mode)) }
                        td { span class={ "pill " (colour(grade)) } { (verdict_words(grade.verdict)) } }
                        td class="number" data-key=(grade.points) { (points(grade.points)) " of " (points(grade.max_points)) }
                        td class="number" data-key=(share) {
                            meter min="0" max="100" value=(share) aria-hidden="true" {} " " (format!("{share:.0}")) "\u{a0}%"
                        }
                    } @else {
                        (nothing("changed: its points contradict each other", 2))
                    }
                }
                None if entry.page == "compare.html" => { (nothing("two runs compared", 4)) }
                None => { (nothing("its record cannot be read", 4)) }
            }
        }
    }
}

/// Words in place of a grade, after the report's name or after the submission's; the columns of numbers are sorted before any grade.
fn nothing(words: &str, of: usize) -> Markup {
    html! {
        td { (words) }
        @for _ in 1..of { td {} }
        td class="number" data-key="-1" { "–" }
        td class="number" data-key="-1" { "–" }
    }
}

fn colour(grade: &Grade) -> &'static str {
    match grade.verdict {
        Verdict::Passed => "full",
        Verdict::HostLimit | Verdict::GraderFault => "unjudged",
        Verdict::Missed if grade.points > 0.0 => "partial",
        _ => "none",
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
    use kinemark_grader::record::sample;

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
        assert!(page.contains("data-sortable") && page.contains("script-src 'sha256-"));
        assert!(page.contains("its record cannot be read"));
    }

    #[test]
    fn a_report_has_the_picture_of_the_task_that_lost_most() {
        let bed = tempfile::tempdir().unwrap();
        let report = bed.path().join("mine");
        std::fs::create_dir_all(report.join("plots")).unwrap();
        std::fs::write(report.join("report.html"), "").unwrap();
        let mut grade = sample::graded().grade;
        grade.tasks.retain(|task| task.kind == TaskKind::Motion);
        for (name, points) in [("lost", 1.0), ("full", 4.0)] {
            let mut task = grade.tasks[0].clone();
            (task.name, task.points, task.max_points) = (name.to_owned(), points, 4.0);
            grade.tasks.push(task);
        }
        grade
            .tasks
            .retain(|task| ["lost", "full"].contains(&task.name.as_str()));
        let lost = "lost";
        let record = serde_json::to_string(&grade).unwrap();
        std::fs::write(report.join("grade.json"), record).unwrap();
        let token = Token::fresh().unwrap();
        let of_mine = format!("<img src=\"/{}/mine/", token.of_folder("mine"));
        let listed = || page(bed.path(), &token);
        assert!(!listed().contains("<img"), "there is no picture");
        std::fs::write(report.join("plots/full-path.svg"), "").unwrap();
        assert!(listed().contains(&format!("{of_mine}plots/full-path.svg\"")));
        std::fs::write(report.join(format!("plots/{lost}-path.svg")), "").unwrap();
        assert!(listed().contains(&format!("{of_mine}plots/{lost}-path.svg\"")));
        assert!(listed().contains("img-src 'self'"));
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
