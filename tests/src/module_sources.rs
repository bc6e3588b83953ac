//! The sources of a compiled submission: kept with its report for a person to read, named in its record, and missed where there are none.

use serde_json::Value as Json;

use crate::course_class::{LAB, course};
use crate::module_reports::module;
use crate::named_submissions::zip_of;
use crate::testbed::{CommandResult, TestBed, files_below};

/// A module, its sources, what a compiler left, and what is nobody's business.
fn project() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("submission.wasm", module("")),
        ("submission.c", b"#include \"arm.h\"\n".to_vec()),
        ("include/arm.h", b"// <script>alert(1)</script>\n".to_vec()),
        ("target/debug/generated.c", b"int x;\n".to_vec()),
        (".env", b"TOKEN=1\n".to_vec()),
    ]
}

const KEPT: [&str; 2] = ["include/arm.h", "submission.c"];

fn bed() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    for (name, bytes) in project() {
        bed.write(&format!("mine/{name}"), bytes);
    }
    bed
}

fn zipped() -> Vec<u8> {
    let files = project();
    let files: Vec<(&str, &[u8])> = files
        .iter()
        .map(|(name, bytes)| (*name, bytes.as_slice()))
        .collect();
    zip_of(&files)
}

fn record(bed: &TestBed) -> Json {
    let bytes = std::fs::read(bed.path("out/grade.json")).expect("a record");
    serde_json::from_slice(&bytes).expect("JSON")
}

fn names(bed: &TestBed, folder: &str) -> Vec<String> {
    let files = files_below(&bed.path(folder));
    files.into_iter().map(|(name, _)| name).collect()
}

fn graded(bed: &TestBed, submission: &str, args: &[&str]) -> CommandResult {
    let ran = bed.run(&[&["grade", LAB, submission, "--practice"], args].concat());
    assert_eq!(ran.code, Some(1), "{submission}: {ran:?}");
    ran
}

/// The paths of the sources in the record.
fn recorded(bed: &TestBed) -> Vec<String> {
    let record = record(bed);
    let sources = record["sources"].as_array().expect("sources").iter();
    sources
        .map(|source| source["name"].as_str().expect("a name").to_owned())
        .collect()
}

#[test]
fn the_sources_of_a_module_are_kept_however_it_is_handed_in() {
    let bed = bed();
    bed.write("mine.zip", zipped());
    let ran = bed.run(&["submit", LAB, "mine", "--out", "arm.kinemark"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.contains("2 files"), "{ran:?}");
    for submission in ["mine", "mine/submission.wasm", "mine.zip", "arm.kinemark"] {
        let ran = graded(&bed, submission, &[]);
        assert!(!ran.stdout.contains("sources: none"), "{ran:?}");
        assert_eq!(names(&bed, "out/sources"), KEPT, "{submission}");
        assert_eq!(recorded(&bed), KEPT, "{submission}");
        let kept = std::fs::read(bed.path("out/sources/submission.c")).expect("a source");
        assert_eq!(kept, b"#include \"arm.h\"\n", "{submission}");
        let digest = blake3::hash(&kept).to_hex().to_string();
        let record = record(&bed);
        let sources = record["sources"].as_array().expect("sources");
        assert!(
            sources
                .iter()
                .any(|source| source["digest"] == digest.as_str()),
            "{record}"
        );
        let ran = bed.run(&["verify", "out"]);
        assert_eq!(ran.code, Some(0), "{submission}: {ran:?}");
    }
    // a report over it takes them away again
    bed.write("still.rhai", "fn control(o) { [0.0, 0.0] }\n");
    graded(&bed, "still.rhai", &[]);
    assert!(!bed.path("out/sources").exists());
    assert!(record(&bed)["sources"].is_null());
}

#[test]
fn a_source_that_was_changed_is_found() {
    let bed = bed();
    graded(&bed, "mine", &[]);
    let changed = |bed: &TestBed, words: &str| {
        let ran = bed.run(&["verify", "out"]);
        assert_eq!(ran.code, Some(1), "{ran:?}");
        assert!(ran.stdout.contains(words), "no {words} in {ran:?}");
        assert!(ran.stdout.contains("changed after grading"), "{ran:?}");
    };
    bed.write("out/sources/submission.c", "// all my own work\n");
    changed(&bed, "sources/submission.c");
    std::fs::remove_file(bed.path("out/sources/submission.c")).expect("removed");
    changed(&bed, "sources/submission.c");
    bed.write("out/sources/submission.c", "#include \"arm.h\"\n");
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    bed.write("out/sources/more.c", "// I wrote this, too\n");
    changed(&bed, "sources/more.c");
}

#[test]
fn a_module_without_sources_is_marked() {
    let bed = bed();
    bed.write("alone/submission.wasm", module(""));
    bed.write("alone.wasm", module(""));
    bed.write("notes.zip", {
        let module = module("");
        zip_of(&[("submission.wasm", &module), ("README.md", b"my arm")])
    });
    for submission in ["alone", "alone/submission.wasm", "alone.wasm", "notes.zip"] {
        let ran = graded(&bed, submission, &[]);
        assert!(
            ran.stdout.contains("sources: none beside this module"),
            "{ran:?}"
        );
        assert_eq!(recorded(&bed), [""; 0], "{submission}");
        assert!(!bed.path("out/sources").exists(), "{submission}");
        let page = std::fs::read_to_string(bed.path("out/report.html")).expect("a page");
        assert!(
            page.contains("no sources beside this module"),
            "{submission}"
        );
    }
}

#[test]
fn course_staff_see_sources_and_who_has_none() {
    let bed = TestBed::new();
    course(&bed, "id,name\ns1,Ann\ns2,Ben\ns3,Cleo\n");
    bed.write("in/s1.zip", zipped());
    bed.write("in/s2.wasm", module(""));
    bed.write("in/s3.rhai", "fn control(o) { [0.0, 0.0] }\n");
    let ran = bed.run(&["course", "grade", "in", LAB]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let words = "1 handed in a module without its sources: s2\n";
    assert!(ran.stdout.contains(words), "{ran:?}");
    let kept: Vec<String> = names(&bed, "book/reports")
        .into_iter()
        .filter(|name| name.contains("-sources/"))
        .collect();
    assert_eq!(kept.len(), 2, "{kept:?}");
    assert!(
        kept.iter()
            .any(|name| name.ends_with("-sources/include/arm.h")),
        "{kept:?}"
    );
    let ran = bed.run(&["course", "grade", LAB, "--json"]);
    let rows: Json = serde_json::from_str(&ran.stdout).expect("JSON");
    let marked: Vec<(&str, bool)> = rows["standings"]
        .as_array()
        .expect("rows")
        .iter()
        .filter_map(|row| {
            Some((
                row["student"].as_str()?,
                row["is_without_sources"].as_bool()?,
            ))
        })
        .collect();
    assert_eq!(marked, [("s1", false), ("s2", true), ("s3", false)]);
    let ran = bed.run(&["course", "page", LAB, "--names"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let pages = files_below(&bed.path("book/pages"));
    let marks = pages
        .iter()
        .map(|(_, page)| String::from_utf8_lossy(page).matches("no sources<").count());
    assert_eq!(marks.sum::<usize>(), 1, "on the page with names");
    // what is kept of a person goes with the person
    bed.write("roster.csv", "id,name\ns2,Ben\ns3,Cleo\n");
    let ran = bed.run(&["course", "forget", "s1"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let left: Vec<String> = names(&bed, "book")
        .into_iter()
        .filter(|name| name.contains("-sources/"))
        .collect();
    assert_eq!(left, [""; 0]);
}
