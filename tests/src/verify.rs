//! `kinemark verify`: a report holds what its submission does, or the first difference is named.

use crate::testbed::{TestBed, root};

fn graded() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    let submission = root().join("tests/submissions/01-kinematics/good/submission.rhai");
    std::fs::copy(submission, bed.path("mine.rhai")).expect("copied");
    let ran = bed.run(&["grade", "01-kinematics", "mine.rhai"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    bed
}

#[test]
fn an_untouched_report_holds() {
    let bed = graded();
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.starts_with("same bits: 3 of 3 tasks"), "{ran:?}");
    // without the course staff's part the motion can still be compared
    let ran = bed.run(&["verify", "out", "--practice"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.contains("not compared: task `fk`"), "{ran:?}");
}

#[test]
fn a_changed_submission_is_found_with_second_and_signal() {
    let bed = graded();
    bed.edit("out/submission.rhai", "time < 2.5", "time < 2.6");
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let verdict =
        "this report does not match: the submission was changed after grading\ndiffers: submission";
    assert!(ran.stdout.starts_with(verdict), "{ran:?}");
    // the second move starts at 2.6 s instead of 2.5 s: the command differs in second 2 (as do q and qd), and q is reported first
    assert!(
        ran.stdout
            .contains("trace of task `move`, first in second 2, signal `q`"),
        "{ran:?}"
    );
    let ran = bed.run(&["verify", "out", "--json"]);
    let comparison: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!(comparison["same"], false);
}

#[test]
fn a_forged_grade_is_found() {
    let bed = graded();
    bed.edit("out/grade.json", "\"points\": 24.0", "\"points\": 25.0");
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout
            .contains("differs: record at `points`\n  recorded 25.0\n  now      24.0"),
        "{ran:?}"
    );
}

#[test]
fn a_grade_that_contradicts_itself_is_found_without_the_staffs_part() {
    for (from, to, differs) in [
        (
            "\"points\": 24.0",
            "\"points\": 25.0",
            "`points`\n  recorded 25\n  now      24",
        ),
        (
            "\"max_points\": 24.0",
            "\"max_points\": 30.0",
            "`max_points`",
        ),
        (
            "\"outcome\": \"full\",\n          \"points\": 5.0",
            "\"outcome\": \"none\",\n          \"points\": 5.0",
            "`tasks[1].checks[0].outcome`",
        ),
        (
            "\"points\": 10.0,\n      \"max_points\": 10.0",
            "\"points\": 9.0,\n      \"max_points\": 10.0",
            "`tasks[2].points`\n  recorded 9\n  now      10",
        ),
        (
            "\"verdict\": \"passed\",\n  \"points\"",
            "\"verdict\": \"missed\",\n  \"points\"",
            "`verdict`\n  recorded missed",
        ),
    ] {
        let bed = graded();
        bed.edit("out/grade.json", from, to);
        let ran = bed.run(&["verify", "out", "--practice"]);
        assert_eq!(ran.code, Some(1), "{to}: {ran:?}");
        assert!(ran.stdout.contains(differs), "{to}: {ran:?}");
    }
}

#[test]
fn a_changed_page_or_plot_is_found() {
    let bed = graded();
    bed.edit("out/report.html", "</body>", "<p>25 points</p></body>");
    std::fs::remove_file(bed.path("out/plots/move-path.svg")).expect("removed");
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains("differs: file `report.html`"),
        "{ran:?}"
    );
    assert!(
        ran.stdout
            .contains("differs: file `plots/move-path.svg`\n  in the folder: missing"),
        "{ran:?}"
    );
}

#[test]
fn a_changed_list_of_files_is_found() {
    let bed = graded();
    let ran = |what: &str| {
        let ran = bed.run(&["verify", "out"]);
        assert_eq!(ran.code, Some(1), "{ran:?}");
        assert!(ran.stdout.contains(what), "{ran:?}");
    };
    bed.edit("out/report.json", "\"png\": false", "\"png\": true");
    ran("file `plots/move-path.png`\n  in the folder: missing\n  now      not listed");
    bed.edit("out/report.json", "\"png\": true", "\"png\": false");
    bed.edit(
        "out/report.json",
        "submission.rhai\": \"",
        "submission.rhai\": \"0",
    );
    ran("digest of `submission.rhai` in `report.json`");
    bed.edit(
        "out/report.json",
        "submission.rhai\": \"0",
        "submission.rhai\": \"",
    );
    bed.edit(
        "out/report.json",
        "\"files\": {",
        "\"files\": { \"notes.txt\": \"\",",
    );
    ran("list of files in `report.json`: `notes.txt`");
    bed.edit("out/report.json", "kinemark-report/1", "kinemark-report/7");
    let other = bed.run(&["verify", "out"]);
    assert_eq!(other.code, Some(3), "{other:?}");
    assert!(other.stderr.contains("kinemark-report/7"), "{other:?}");
}

#[test]
fn what_is_no_report_is_said_so() {
    let bed = TestBed::new();
    assert_eq!(bed.run(&["verify", "nowhere"]).code, Some(2));
    bed.write("folder/file", "");
    assert_eq!(bed.run(&["verify", "folder"]).code, Some(3));
    bed.write("folder/grade.json", "{}");
    let ran = bed.run(&["verify", "folder"]);
    assert_eq!(ran.code, Some(3));
    assert!(ran.stderr.contains("not a grade record"), "{ran:?}");
}
