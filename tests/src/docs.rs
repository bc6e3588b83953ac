//! The pages and the help keep to what there is: every code of an error is in a table, every example names what is there.

use std::path::Path;

use kinemark_grader::lab::load::lab_names;

use crate::golden::is_current;
use crate::testbed::{Folder, TestBed, root};

/// Texts of all files with this ending below a folder.
fn texts(folder: &Path, ending: &str, into: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).expect("folder") {
        let path = entry.expect("entry").path();
        if path.is_dir() {
            texts(&path, ending, into);
        } else if path.extension().is_some_and(|found| found == ending) {
            into.push(std::fs::read_to_string(path).expect("text"));
        }
    }
}

/// Codes such as `lab::band` in the strings of a source.
fn codes(source: &str) -> Vec<&str> {
    let is_code = |text: &&str| {
        let parts = text.split_once("::");
        parts.is_some_and(|(head, tail)| {
            ["lab", "staff", "variant"].contains(&head)
                && !tail.is_empty()
                && tail.bytes().all(|b| b.is_ascii_lowercase() || b == b'_')
        })
    };
    source.split('"').filter(is_code).collect()
}

#[test]
fn every_code_of_a_lab_is_in_the_table_of_codes() {
    let page = std::fs::read_to_string(root().join("docs/lab-format.md")).expect("page");
    let mut sources = Vec::new();
    texts(&root().join("grader/src/lab"), "rs", &mut sources);
    let mut seen = 0;
    for source in &sources {
        for code in codes(source) {
            seen += 1;
            assert!(page.contains(&format!("`{code}`")), "{code} is in no table");
        }
    }
    assert!(seen > 40, "{seen}");
}

#[test]
fn every_example_of_the_help_names_what_is_there() {
    let bed = TestBed::new();
    let page = std::fs::read_to_string(root().join("docs/cli.md")).expect("page");
    let examples = page
        .lines()
        .filter(|line| line.starts_with("  kinemark "))
        .flat_map(str::split_whitespace);
    let mut labs = 0;
    for word in examples {
        let numbered = word.len() > 3
            && word.as_bytes()[..2].iter().all(u8::is_ascii_digit)
            && word.as_bytes()[2] == b'-';
        if numbered {
            labs += 1;
            assert!(
                root().join("labs").join(word).is_dir(),
                "{word} is not a lab"
            );
        }
        if word.starts_with("labs/") {
            assert!(root().join(word).exists(), "{word} is not there");
        }
    }
    assert!(labs > 3);
    // the variable is documented with the option
    assert!(page.contains("[env: KINEMARK_SALT]"));
    let help = bed.run(&["grade", "--help"]).stdout;
    assert_eq!(help.matches("KINEMARK_SALT").count(), 1, "{help}");
}

#[test]
fn every_command_is_in_the_table_of_the_readme() {
    let cli = std::fs::read_to_string(root().join("docs/cli.md")).expect("page");
    let readme = std::fs::read_to_string(root().join("README.md")).expect("page");
    let commands = cli
        .lines()
        .filter_map(|line| line.strip_prefix("## `kinemark "));
    let mut seen = 0;
    for command in commands.map(|rest| rest.trim_end_matches('`')) {
        // a group of commands is documented by its members
        if ["robot", "scene", "log", "lab", "course"].contains(&command) {
            continue;
        }
        seen += 1;
        assert!(
            readme.contains(&format!("| `kinemark {command}")),
            "{command}"
        );
    }
    assert!(seen > 10, "{seen}");
}

#[test]
fn every_page_is_in_the_summary_of_the_book_under_its_title() {
    let summary = std::fs::read_to_string(root().join("docs/SUMMARY.md")).expect("summary");
    let mut seen = 0;
    for folder in ["", "decisions/", "examples/", "gallery/"] {
        for entry in std::fs::read_dir(root().join("docs").join(folder)).expect("docs") {
            let path = entry.expect("entry").path();
            let name = path.file_name().expect("a name").to_string_lossy();
            if path.extension().is_none_or(|ending| ending != "md") || name == "SUMMARY.md" {
                continue;
            }
            let page = std::fs::read_to_string(&path).expect("page");
            let title = page.lines().next().unwrap_or_default();
            let title = title.trim_start_matches("# ");
            let line = match folder {
                "gallery/" => format!("({folder}{name})"),
                _ => format!("[{title}]({folder}{name})"),
            };
            assert!(summary.contains(&line), "docs/SUMMARY.md has no {line}");
            seen += 1;
        }
    }
    assert!(seen > 40, "{seen}");
    assert_eq!(
        summary.matches("](").count(),
        seen,
        "a page that is not there"
    );
}

/// A table that is made again: docs/labs.md from its first row to the end of the table.
const FIRST_ROW: &str =
    "| lab | task | check | least margin | greatest margin |\n|---|---|---|---:|---:|\n";

/// What `kinemark lab check LAB --variants 200 --json` prints about every lab, in the folder that `.ci/full all-mutants` names.
#[test]
fn margins_of_the_reference_solutions_are_those_on_the_page() {
    let page = std::fs::read_to_string(root().join("docs/labs.md")).expect("page");
    let (before, rest) = page.split_once(FIRST_ROW).expect("the table");
    let (table, after) = rest.split_at(rest.find("\n\n").map_or(rest.len(), |end| end + 1));
    let labs = lab_names(&Folder(root().join("labs")));
    let Some(checked) = std::env::var_os("KINEMARK_CHECKED") else {
        for lab in &labs {
            let rows = table
                .lines()
                .filter(|row| row.starts_with(&format!("| {lab} |")));
            assert!(rows.count() > 1, "docs/labs.md has no margins of {lab}");
        }
        return;
    };
    let fresh: String = labs
        .iter()
        .map(|lab| margins(Path::new(&checked), lab))
        .collect();
    is_current("docs/labs.md", format!("{before}{FIRST_ROW}{fresh}{after}"));
}

/// The rows of one lab: least and greatest margin in the variants.
fn margins(checked: &Path, lab: &str) -> String {
    let audit = std::fs::read_to_string(checked.join(format!("{lab}.json"))).expect("an audit");
    let audit: serde_json::Value = serde_json::from_str(&audit).expect("JSON");
    let bands = audit["bands"].as_array().expect("bands").iter();
    let row = |band: &serde_json::Value| {
        let reached = band["reference"].as_array().expect("values").iter();
        let in_variants = reached.filter(|reached| reached["of"] != "");
        let margins = in_variants.map(|reached| reached["margin"].as_f64().expect("a margin"));
        let [least, greatest] = margins
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], it| {
                [low.min(it), high.max(it)]
            });
        let [task, check] = [&band["task"], &band["check"]].map(|it| it.as_str().expect("a name"));
        // a small one is not none
        let percent = |margin: f64| match 100.0 * margin {
            small if small.abs() < 0.95 => format!("{small:.1} %"),
            margin => format!("{margin:.0} %"),
        };
        let [least, greatest] = [least, greatest].map(percent);
        format!("| {lab} | {task} | {check} | {least} | {greatest} |\n")
    };
    // what is right or wrong has no margin
    let has_margin = |band: &&serde_json::Value| {
        let mut reached = band["reference"].as_array().expect("values").iter();
        reached.any(|reached| {
            reached["margin"]
                .as_f64()
                .is_some_and(|margin| margin.abs() > 0.0)
        })
    };
    bands.filter(has_margin).map(row).collect()
}

#[test]
fn every_lab_has_its_pictures_in_the_gallery() {
    let page = std::fs::read_to_string(root().join("docs/gallery/README.md")).expect("page");
    for lab in lab_names(&Folder(root().join("labs"))) {
        assert!(page.contains(&format!("\n## {lab}\n")), "no {lab}");
        for shown in ["brief-1000", "report-1440", "report-390"] {
            for look in ["light", "dark"] {
                let picture = format!("{lab}-{shown}-{look}.webp");
                assert!(page.contains(&picture), "{picture} is not shown");
                let path = root().join("docs/gallery").join(&picture);
                assert!(path.is_file(), "there is no {picture}");
            }
        }
    }
}
