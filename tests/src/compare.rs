//! `kinemark compare`: two reports of a lab beside each other.

use serde_json::Value;

use crate::testbed::{TestBed, files_below, root};

/// A bed with the good submission of lab 1 graded into `a`, and one that starts its second move late into `b`.
fn graded() -> TestBed {
    let bed = TestBed::new();
    let good = root().join("tests/submissions/01-kinematics/good/submission.rhai");
    let good = std::fs::read_to_string(good).expect("a submission");
    bed.write("a.rhai", &good);
    bed.write("b.rhai", good.replace("time < 2.5", "time < 2.6"));
    for (name, code) in [("a", Some(0)), ("b", None)] {
        let ran = bed.run(&[
            "grade",
            "01-kinematics",
            &format!("{name}.rhai"),
            "--out",
            name,
        ]);
        assert!(code.is_none() || ran.code == code, "{ran:?}");
    }
    bed
}

fn record(bed: &TestBed) -> Value {
    let text =
        std::fs::read_to_string(bed.path("kinemark-compare/compare.json")).expect("a record");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn two_attempts_are_told_apart_where_they_part() {
    let bed = graded();
    let ran = bed.run(&["compare", "a", "b"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout.contains("A  a: a.rhai, 24 of 24 points, passed"),
        "{ran:?}"
    );
    let told = ran
        .stdout
        .lines()
        .find(|line| line.contains("first differ at"));
    let told = told.expect("a difference");
    // the command of the second move comes at 2.6 s, not 2.5 s; the joints part by 0.02 rad soon after
    let record = record(&bed);
    assert_eq!(record["format"], "kinemark-comparison/1");
    let tasks = record["tasks"].as_array().expect("tasks");
    let of = |name: &str| {
        tasks
            .iter()
            .find(|task| task["name"] == name)
            .expect("the task")
    };
    let first = &of("move")["motion"]["first"];
    let time_s = first["time_s"].as_f64().expect("a time");
    assert!((2.5..2.6).contains(&time_s), "{first}");
    assert!(
        told.contains(first["message"].as_str().expect("words")),
        "{told}"
    );
    // what both do the same is said so
    assert_eq!(of("warm-up")["motion"]["same_bits"], true);
    assert!(
        ran.stdout.contains("the motions are the same, bit for bit"),
        "{ran:?}"
    );

    let page = std::fs::read_to_string(bed.path("kinemark-compare/compare.html")).expect("a page");
    assert!(page.contains("class=\"replay\"") && page.contains("\"ghostLabel\":\"B\""));
    assert!(
        page.contains("href=\"#task=move&amp;t=2.5"),
        "no link to the moment"
    );
    assert!(page.contains("How far the TCPs are apart"));
    // again: the same bytes; and what is somebody's own stays
    let before = files_below(&bed.path("kinemark-compare"));
    let ran = bed.run(&["compare", "a", "b", "--json"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(before == files_below(&bed.path("kinemark-compare")));
    assert!(
        ran.stdout.as_bytes() == before[1].1,
        "what is printed is the record"
    );
    bed.write("kinemark-compare/notes.txt", "mine");
    let ran = bed.run(&["compare", "a", "b"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("holds `notes.txt`"), "{ran:?}");
}

#[test]
fn a_report_that_was_changed_is_told() {
    let bed = graded();
    bed.edit("a/submission.rhai", "time < 2.5", "time < 2.6");
    let ran = bed.run(&["compare", "a", "b"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    for words in [
        "the submission in A is not the one that was graded",
        "the motion of task `move` made again from A is not the recorded one, from second 2 on",
    ] {
        assert!(ran.stdout.contains(words), "{words}: {ran:?}");
    }
}

#[test]
fn what_has_nothing_in_common_is_told_with_the_way_out() {
    let bed = graded();
    assert_eq!(bed.run(&["new", "00-step-response", "step"]).code, Some(0));
    let ran = bed.run(&[
        "grade",
        "00-step-response",
        "step/submission.rhai",
        "--out",
        "other",
    ]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let ran = bed.run(&["compare", "a", "other"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("00-step-response") && ran.stderr.contains("help:"),
        "{ran:?}"
    );
    assert_eq!(bed.run(&["compare", "a", "nowhere"]).code, Some(2));
    bed.write("folder/file", "");
    assert_eq!(bed.run(&["compare", "folder", "a"]).code, Some(3));
    assert!(!bed.path("kinemark-compare").exists());
}
