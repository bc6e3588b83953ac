//! What students download is called the same where it is made, where it is published and where it is offered.

use std::collections::BTreeSet;

use crate::testbed::root;

fn text(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The targets of a list of `.ci/release`, such as `linux=(one two)`.
fn targets(script: &str, list: &str) -> Vec<String> {
    let head = format!("{list}=(");
    let line = script.lines().find_map(|line| line.strip_prefix(&head));
    let line = line.and_then(|rest| rest.strip_suffix(')'));
    let words = line.unwrap_or_else(|| panic!(".ci/release has no list {list}"));
    words.split_whitespace().map(str::to_owned).collect()
}

/// The names of archives in a page, such as `kinemark-VERSION-x86_64-apple-darwin.tar.gz`.
fn archives(page: &str) -> BTreeSet<&str> {
    let quoted = page.split('`').skip(1).step_by(2);
    quoted
        .filter(|name| name.starts_with("kinemark-VERSION-"))
        .collect()
}

#[test]
fn the_pages_offer_the_archives_that_are_made() {
    let script = text(".ci/release");
    let made: BTreeSet<String> = ["linux", "apple"]
        .iter()
        .flat_map(|list| targets(&script, list))
        .map(|target| {
            let ending = if target.contains("windows") {
                "zip"
            } else {
                "tar.gz"
            };
            format!("kinemark-VERSION-{target}.{ending}")
        })
        .collect();
    assert!(made.len() > 4, "{made:?}");
    let made: BTreeSet<&str> = made.iter().map(String::as_str).collect();
    for page in ["README.md", "docs/install.md"] {
        assert_eq!(archives(&text(page)), made, "{page}");
    }
}

#[test]
fn the_workflow_builds_every_archive() {
    let script = text(".ci/release");
    let workflow = text(".github/workflows/release.yml");
    for list in ["linux", "apple"] {
        let command = format!("- run: .ci/release {}\n", targets(&script, list).join(" "));
        assert!(workflow.contains(&command), "no line `{command}`");
    }
}

/// A tag of an action can be moved to other code; a commit cannot.
#[test]
fn workflows_name_actions_by_commit() {
    let mut seen = 0;
    for name in ["gate", "release"] {
        let workflow = text(&format!(".github/workflows/{name}.yml"));
        for line in workflow.lines().filter(|line| line.contains("uses:")) {
            seen += 1;
            let commit = line.split_once('@').and_then(|(_, rest)| rest.get(..40));
            let is_commit = |commit: &str| commit.bytes().all(|b| b.is_ascii_hexdigit());
            assert!(commit.is_some_and(is_commit), "{line}");
        }
    }
    assert!(seen > 3, "{seen}");
}

/// The page in an archive is made from these sections of docs/install.md.
#[test]
fn every_system_has_its_section() {
    let page = text("docs/install.md");
    let script = text(".ci/archive");
    for heading in ["Windows", "Linux", "macOS", "First commands"] {
        assert!(page.contains(&format!("\n## {heading}\n")), "{heading}");
        assert!(script.contains(&format!("\"{heading}\"")), "{heading}");
    }
}
