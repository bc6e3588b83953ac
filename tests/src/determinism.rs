//! The same submission gives the same bytes of every file: twice, in a worker or in process, and without any optimisation.

use std::path::Path;
use std::process::Command;

use crate::testbed::{TestBed, binary, build, files_below, root};

const SUBMISSION: &str = "tests/submissions/01-kinematics/good/submission.rhai";

fn files(binary: &Path, bed: &TestBed, out: &str, flags: &[&str]) -> Vec<(String, Vec<u8>)> {
    let status = Command::new(binary)
        .current_dir(root())
        .args(["grade", "01-kinematics", SUBMISSION, "--out"])
        .arg(bed.path(out))
        .args(flags)
        .output()
        .expect("the binary runs");
    assert_eq!(status.status.code(), Some(0), "{status:?}");
    let files = files_below(&bed.path(out));
    assert!(files.len() > 10);
    files
}

fn assert_same(a: &[(String, Vec<u8>)], b: &[(String, Vec<u8>)]) {
    let names = |files: &[(String, Vec<u8>)]| -> Vec<String> {
        files.iter().map(|(name, _)| name.clone()).collect()
    };
    assert_eq!(names(a), names(b));
    for ((name, a), (_, b)) in a.iter().zip(b) {
        assert!(a == b, "{name} differs");
    }
}

#[test]
fn two_runs_and_both_transports_write_the_same_bytes() {
    let bed = TestBed::new();
    let first = files(binary(), &bed, "first", &[]);
    assert_same(&first, &files(binary(), &bed, "second", &[]));
    assert_same(
        &first,
        &files(binary(), &bed, "in-process", &["--in-process"]),
    );
}

#[test]
fn a_build_without_optimisation_writes_the_same_bytes() {
    let bed = TestBed::new();
    let unoptimised = build("unoptimised");
    let debug = files(&unoptimised, &bed, "debug", &[]);
    assert_same(&files(binary(), &bed, "tested", &[]), &debug);
}

/// Changing a digest moves grades: it needs a line in the changelog that says why.
#[test]
fn the_digest_of_the_example_is_the_one_committed() {
    let bed = TestBed::new();
    let files = files(binary(), &bed, "out", &[]);
    let (_, record) = files
        .iter()
        .find(|(name, _)| name == "grade.json")
        .expect("record");
    let record: serde_json::Value = serde_json::from_slice(record).expect("JSON");
    let digests: String = record["tasks"]
        .as_array()
        .expect("tasks")
        .iter()
        .map(|task| {
            let digest = task["digests"]["all"].as_str().expect("digest");
            format!("{} {digest}\n", task["name"].as_str().expect("name"))
        })
        .collect();
    let path = root().join("tests/golden/digests-01-kinematics.txt");
    if std::env::var_os("KINEMARK_BLESS").is_some() {
        std::fs::write(&path, &digests).expect("written");
    }
    let golden = std::fs::read_to_string(&path).unwrap_or_default();
    assert_eq!(digests, golden, "{}", path.display());
}
