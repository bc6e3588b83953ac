//! The pages of a class: one that can be projected, those for course staff, and the book opened with `kinemark view`.

use std::path::Path;

use serde_json::Value;

use crate::course_class::{CLASS, LAB, class, grade, hand_in};
use crate::testbed::{Serving, TestBed, files_below, root};

/// The class graded: `s104` handed in what `s100` did, `s106` a solution that is public.
fn graded() -> TestBed {
    let bed = class();
    hand_in(&bed, "in/s104.rhai", "good");
    let solution = root().join(format!("reference/{LAB}/solution.rhai"));
    bed.write("in/s106.rhai", std::fs::read(solution).expect("a solution"));
    // last year's file of somebody
    hand_in(&bed, "2025/smith/submission.rhai", "elbow-flips");
    let ran = grade(&bed, &[]);
    assert!(ran.stdout.contains("7 graded, 1 needs you"), "{ran:?}");
    bed
}

fn page(bed: &TestBed, more: &[&str]) -> Value {
    let ran = bed.run(&[&["course", "page", LAB, "--json"], more].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    serde_json::from_str(&ran.stdout).expect("JSON")
}

fn read(bed: &TestBed, name: &str) -> String {
    let path = bed.path(&format!("book/pages/{LAB}/{name}"));
    std::fs::read_to_string(path).expect("a page")
}

/// The addresses that a page links.
fn links(page: &str) -> Vec<&str> {
    let parts = page.split("href=\"").skip(1);
    parts
        .filter_map(|rest| rest.split('"').next())
        .filter(|address| !address.starts_with('#'))
        .collect()
}

/// Everything below the pages' folder is its owner's alone.
#[cfg(unix)]
fn assert_private(folder: &Path) {
    use std::os::unix::fs::PermissionsExt as _;
    for (path, _) in files_below(folder) {
        for path in folder
            .join(path)
            .ancestors()
            .take_while(|at| at.starts_with(folder))
        {
            let mode = path.metadata().expect("there").permissions().mode();
            assert_eq!(mode & 0o077, 0, "{}", path.display());
        }
    }
}

#[test]
fn a_page_to_project_has_nobody_in_it_and_the_others_have_everybody() {
    let bed = graded();
    let all = ["--names", "--similar", "--earlier", "2025"];
    page(&bed, &all);
    let projected = read(&bed, "class.html");
    let (students, similar) = (read(&bed, "students.html"), read(&bed, "similar.html"));
    for (id, name, _) in CLASS {
        assert!(!projected.contains(id), "{id} is on the page to project");
        assert!(
            !projected.contains(name) && !similar.contains(name),
            "{name} is on a page without names"
        );
        assert!(students.contains(id) && students.contains(name), "{name}");
    }
    assert!(!projected.contains("reports/") && links(&projected).is_empty());
    assert!(projected.contains("7</b> of 8"), "graded of all");
    // every link leads to a page
    let folder = bed.path(&format!("book/pages/{LAB}"));
    for page in [&students, &similar] {
        let found = links(page);
        assert!(found.len() >= 4, "{found:?}");
        for link in found {
            assert!(folder.join(link).is_file(), "{link}");
        }
    }
    #[cfg(unix)]
    assert_private(&folder);

    // the same class gives the same bytes
    let before = files_below(&folder);
    page(&bed, &all);
    assert_eq!(files_below(&folder), before);
    // what is not wanted any more is not left behind
    let ran = bed.run(&["course", "page", LAB]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.contains("class.html: the class, without names"));
    assert!(
        ran.stdout
            .contains("dolos, jplag, similar.html, students.html of an earlier time removed"),
        "{ran:?}"
    );
    let left: Vec<String> = files_below(&folder)
        .into_iter()
        .map(|file| file.0)
        .collect();
    assert_eq!(left, ["class.html"]);
}

#[test]
fn similar_files_are_worth_a_conversation_with_their_base_rate() {
    let bed = graded();
    let written = page(&bed, &["--similar", "--earlier", "2025"]);
    let findings = written["findings"].as_array().expect("findings");
    let of = |kind: &str| -> Vec<&Value> {
        findings
            .iter()
            .filter(|found| found["kind"] == kind)
            .collect()
    };
    let [same] = of("same-file")[..] else {
        panic!("{findings:?}")
    };
    assert_eq!((&same["shared_by"], &same["of"]), (&2.into(), &7.into()));
    let whole: Vec<String> = of("earlier-file")
        .iter()
        .map(|found| found["files"].to_string())
        .collect();
    let has = |one: &str, other: &str| {
        whole
            .iter()
            .any(|files| files.contains(one) && files.contains(other))
    };
    assert!(has("s105", "2025/smith/submission.rhai"), "{whole:?}");
    assert!(has("s106", "Kinemark's repository"), "{whole:?}");
    let similar = read(&bed, "similar.html");
    assert!(
        similar.contains("<strong>2 of 7</strong> of the class"),
        "{similar}"
    );
    assert!(similar.contains("Worth a conversation"));
    // neither gradebook nor feedback knows of it
    let ran = bed.run(&["course", "release", LAB, "--to", "feedback"]);
    assert!(matches!(ran.code, Some(0 | 1)), "{ran:?}");
    for (path, bytes) in files_below(&bed.path("release")) {
        let text = String::from_utf8_lossy(&bytes);
        assert!(!text.contains("conversation"), "{path}");
    }

    let folder = bed.path(&format!("book/pages/{LAB}"));
    let jplag: Vec<String> = files_below(&folder.join("jplag"))
        .into_iter()
        .map(|file| file.0)
        .collect();
    assert_eq!(jplag.len(), 7 + 2, "{jplag:?}");
    assert!(jplag.contains(&"submissions/s102/submission.rhai.txt".to_owned()));
    assert!(jplag.contains(&"base/starter.rhai.txt".to_owned()));
    let table = std::fs::read_to_string(folder.join("dolos/info.csv")).expect("a table");
    assert_eq!(table.lines().count(), 1 + 7);
    for line in table.lines().skip(1) {
        let name = line.split(',').next().expect("a name");
        assert!(folder.join("dolos").join(name).is_file(), "{line}");
    }

    for args in [
        &["course", "page", "01-kinematic"][..],
        &["course", "page", LAB, "--earlier", "2025"],
        &["course", "page", LAB, "--similar", "--earlier", "nowhere"],
        &[
            "course",
            "page",
            LAB,
            "--similar",
            "--earlier",
            "labs/robots",
        ],
    ] {
        let ran = bed.run(args);
        assert_eq!(ran.code, Some(2), "{args:?} {ran:?}");
    }
    // who is removed is on no page
    bed.edit("roster.csv", "s103,\"Ann Lee\"\n", "");
    let ran = bed.run(&["course", "forget", "s103"]);
    assert!(
        ran.stdout.contains("the pages of the class are removed"),
        "{ran:?}"
    );
    assert!(!folder.exists());
}

#[test]
fn a_book_is_listed_with_names_and_serves_its_pages_alone() {
    let bed = graded();
    page(&bed, &["--names", "--similar"]);
    for folder in ["book", "."] {
        let (serving, _) = Serving::start(&bed, &["view", folder, "--no-open"]);
        let list = serving.get("/");
        assert_eq!(list.code, 200, "{list:?}");
        assert!(
            list.head
                .contains("content-security-policy: default-src 'none'; script-src")
        );
        for (id, name, _) in CLASS {
            assert!(list.body.contains(id) && list.body.contains(name), "{name}");
        }
        assert!(list.body.contains("24 of 24") && list.body.contains("needs you"));
        // every link leads to a page that needs nothing else
        let found = links(&list.body);
        assert!(found.len() >= 3 + 7, "{found:?}");
        for link in found {
            let answer = serving.get(&format!("/{link}"));
            assert_eq!(answer.code, 200, "{link}");
            assert!(!answer.body.contains("<script src="), "{link}");
            assert!(
                answer.head.contains("content-security-policy: sandbox"),
                "{link}"
            );
        }
        // the salt, the journal and the records stay where they are
        for (path, _) in files_below(&bed.path("book")) {
            if !path.ends_with(".html") {
                assert_eq!(serving.get(&format!("/{path}")).code, 404, "{path}");
            }
        }
        for path in [
            "/roster.csv",
            "/../roster.csv",
            "/salt.txt",
            "/%2e%2e/salt.txt",
        ] {
            assert_eq!(serving.get(path).code, 404, "{path}");
        }
    }
    // a copy without its course has ids
    for (path, bytes) in files_below(&bed.path("book")) {
        bed.write(&format!("copy/book/{path}"), bytes);
    }
    let (serving, _) = Serving::start(&bed, &["view", "copy/book", "--no-open"]);
    let list = serving.get("/");
    assert!(
        list.body.contains("s103") && !list.body.contains("Ann Lee"),
        "{list:?}"
    );
    assert!(list.body.contains("There are no names"), "{list:?}");
    std::fs::remove_dir_all(bed.path("book")).expect("removed");
    let ran = bed.run(&["view", ".", "--no-open"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(ran.stderr.contains("has no book yet"), "{ran:?}");
}
