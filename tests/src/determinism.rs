//! The same submission gives the same bytes of every file: twice, in a worker or in process, without any optimisation, beside
//! other grades; and the digests that are committed. `wasm` has the same for WebAssembly.

use std::path::{Path, PathBuf};
use std::process::Command;

use kinemark_grader::lab::load::lab_names;

use crate::testbed::{Folder, TestBed, binary, build, files_below, grade, lab, root, staff};

/// Every lab with its good submission: a lab without one fails here.
pub(crate) fn good_submissions() -> Vec<(String, PathBuf)> {
    let labs = lab_names(&Folder(root().join("labs")));
    assert!(!labs.is_empty());
    let good = labs.into_iter().map(|lab| {
        let path = root().join(format!("tests/submissions/{lab}/good/submission.rhai"));
        assert!(path.is_file(), "lab `{lab}` has no {}", path.display());
        (lab, path)
    });
    good.collect()
}

/// The files of every good submission's report, below its lab's name.
fn files(binary: &Path, bed: &TestBed, out: &str, flags: &[&str]) -> Vec<(String, Vec<u8>)> {
    for (lab, submission) in good_submissions() {
        let status = Command::new(binary)
            .current_dir(root())
            .args(["grade", &lab])
            .arg(submission)
            .arg("--out")
            .arg(bed.path(out).join(lab))
            .args(flags)
            .output()
            .expect("the binary runs");
        assert_eq!(status.status.code(), Some(0), "{status:?}");
    }
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

/// One line per task of a record: its digest.
pub(crate) fn digests(record: &str) -> String {
    let record: serde_json::Value = serde_json::from_str(record).expect("JSON");
    let tasks = record["tasks"].as_array().expect("tasks").iter();
    let line = |task: &serde_json::Value| {
        let digest = task["digests"]["all"].as_str().expect("digest");
        format!("{} {digest}\n", task["name"].as_str().expect("name"))
    };
    tasks.map(line).collect()
}

/// Changing a digest moves grades: it needs a line in the changelog that says why.
#[test]
fn the_digests_of_every_lab_are_those_committed() {
    let bed = TestBed::new();
    let files = files(binary(), &bed, "out", &[]);
    for (lab, _) in good_submissions() {
        let record = format!("{lab}/grade.json");
        let (_, record) = files.iter().find(|(name, _)| *name == record).expect(&lab);
        let digests = digests(std::str::from_utf8(record).expect("UTF-8"));
        let path = root().join(format!("tests/golden/digests-{lab}.txt"));
        if std::env::var_os("KINEMARK_BLESS").is_some() {
            std::fs::write(&path, &digests).expect("written");
        }
        let golden = std::fs::read_to_string(&path).unwrap_or_default();
        assert_eq!(digests, golden, "{}", path.display());
    }
}

/// The record of a lab's good submission, or the digest of the run with contact.
fn work(good: Option<&(String, PathBuf)>) -> String {
    match good {
        Some((name, submission)) => {
            let lab = lab(name);
            let staff = staff(&lab, None);
            let text = std::fs::read_to_string(submission).expect("submission");
            let graded = grade(&lab, Some(&staff), "submission.rhai", &text);
            serde_json::to_string(&graded.grade).expect("JSON")
        }
        None => {
            let robot = root().join("labs/robots/rrbot.toml");
            let robot = std::fs::read_to_string(robot).expect("robot");
            kinemark_tests_wasm::contact_digest(&robot).expect("digest")
        }
    }
}

#[test]
fn two_threads_grade_as_one_does() {
    let good = good_submissions();
    let all = || good.iter().map(Some).chain([None]);
    let one: Vec<String> = all().map(work).collect();
    assert_eq!(
        one.last().map(String::as_str),
        Some(kinemark_tests_wasm::CONTACT_DIGEST)
    );
    // in opposite orders, so that different work meets; and in the same, so that equal work meets
    for reversed in [true, false] {
        let [ahead, back] = std::thread::scope(|scope| {
            let ahead = scope.spawn(|| all().map(work).collect::<Vec<_>>());
            let back = scope.spawn(|| {
                let mut order: Vec<_> = all().collect();
                if reversed {
                    order.reverse();
                }
                let mut done: Vec<String> = order.into_iter().map(work).collect();
                if reversed {
                    done.reverse();
                }
                done
            });
            [ahead, back].map(|thread| thread.join().expect("a thread"))
        });
        assert!(
            ahead == one && back == one,
            "a grade depends on its neighbour"
        );
    }
}
