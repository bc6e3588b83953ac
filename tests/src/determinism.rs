//! The same submission gives the same bytes of every file: twice, in a worker or in process, without any optimisation, beside
//! other grades; and the digests that are committed. `wasm` has the same for WebAssembly.
//!
//! The tested binary grades every lab once; all that is compared is compared with that.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use kinemark_grader::lab::load::lab_names;
use kinemark_tests_wasm::CONTACT_DIGEST;

use crate::every_case::every_case;
use crate::exact::is_asked_for;
use crate::golden::are_current;
use crate::testbed::{Folder, TestBed, binary, build, files_below, grade, lab, root, staff};

/// A submission of each lab, by the lab's name.
pub(crate) type Submissions = Vec<(String, PathBuf)>;

/// Every lab with its good submission: a lab without one fails here.
pub(crate) fn good_submissions() -> Submissions {
    let labs = lab_names(&Folder(root().join("labs")));
    assert!(!labs.is_empty());
    let good = labs.into_iter().map(|lab| {
        let path = root().join(format!("tests/submissions/{lab}/good/submission.rhai"));
        assert!(path.is_file(), "lab `{lab}` has no {}", path.display());
        (lab, path)
    });
    good.collect()
}

/// Below its lab's name, each by its path.
pub(crate) type Files = Vec<(String, Vec<u8>)>;

/// The files of every good submission's report.
fn files(binary: &Path, flags: &[&str]) -> Files {
    files_of(&good_submissions(), binary, flags)
}

/// The files of the reports of submissions that have full marks.
pub(crate) fn files_of(submissions: &Submissions, binary: &Path, flags: &[&str]) -> Files {
    let bed = TestBed::new();
    let cases: Vec<_> = submissions
        .iter()
        .map(|(lab, path)| (lab.clone(), (lab, path)))
        .collect();
    every_case(&cases, |(lab, submission)| {
        let output = Command::new(binary)
            .current_dir(root())
            .args(["grade", lab])
            .arg(submission.as_path())
            .arg("--out")
            .arg(bed.path("out").join(lab))
            .args(flags)
            .env_remove("KINEMARK_SALT")
            .output()
            .expect("the binary runs");
        assert_eq!(output.status.code(), Some(0), "{output:?}");
    });
    let files = files_below(&bed.path("out"));
    assert!(files.len() > 10);
    files
}

/// The files of every good submission's report, graded once by the tested binary.
fn tested() -> &'static Files {
    static FILES: OnceLock<Files> = OnceLock::new();
    FILES.get_or_init(|| files(binary(), &[]))
}

/// The record of a lab's good submission, as the tested binary wrote it.
pub(crate) fn tested_record(lab: &str) -> &'static str {
    let record = format!("{lab}/grade.json");
    let found = tested().iter().find(|(name, _)| *name == record);
    std::str::from_utf8(&found.expect("a record").1).expect("UTF-8")
}

pub(crate) fn assert_same(a: &[(String, Vec<u8>)], b: &[(String, Vec<u8>)]) {
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
    assert_same(tested(), &files(binary(), &[]));
    assert_same(tested(), &files(binary(), &["--in-process"]));
}

#[test]
fn a_build_without_optimisation_writes_the_same_bytes() {
    if !is_asked_for("the comparison with a build without optimisation") {
        return;
    }
    assert_same(tested(), &files(&build("unoptimised"), &[]));
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
    let golden = good_submissions().into_iter().map(|(lab, _)| {
        let path = root().join(format!("tests/golden/digests-{lab}.txt"));
        (path, digests(tested_record(&lab)))
    });
    are_current(&golden.collect::<Vec<_>>());
}

/// The record of a lab's good submission as the binary writes it, or the digest of the run with contact.
fn work(good: Option<&(String, PathBuf)>) -> String {
    match good {
        Some((name, submission)) => {
            let lab = lab(name);
            let staff = staff(&lab, None);
            let text = std::fs::read_to_string(submission).expect("submission");
            let graded = grade(&lab, Some(&staff), "submission.rhai", &text);
            serde_json::to_string_pretty(&graded.grade).expect("JSON") + "\n"
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
    let one: Vec<&str> = all()
        .map(|good| good.map_or(CONTACT_DIGEST, |(lab, _)| tested_record(lab)))
        .collect();
    // in opposite orders, so that different work meets; and in the same, so that equal work meets
    let in_one_order = is_asked_for("two threads that grade in the same order");
    let orders: &[bool] = if in_one_order {
        &[true, false]
    } else {
        &[true]
    };
    for &reversed in orders {
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
        for (i, one) in one.iter().enumerate() {
            let what = good.get(i).map_or("contact", |(lab, _)| lab);
            let same = ahead[i] == *one && back[i] == *one;
            assert!(
                same,
                "{what} depends on its neighbour, reversed: {reversed}"
            );
        }
    }
}
