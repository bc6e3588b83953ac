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

/// A lab's first motion task in the record.
fn moved(record: &Value) -> &Value {
    let tasks = record["tasks"].as_array().expect("tasks");
    let motion = tasks.iter().find(|task| task["motion"].is_object());
    &motion.expect("a motion")["motion"]
}

#[test]
fn students_with_other_numbers_are_compared_and_the_page_says_so() {
    let bed = TestBed::new();
    let lab = "03-knock-with-position";
    let good = root().join(format!("tests/submissions/{lab}/good/submission.rhai"));
    let good = std::fs::read_to_string(good).expect("a submission");
    bed.write("good.rhai", good);
    for student in ["anna", "bert"] {
        let args = [
            "grade",
            lab,
            "good.rhai",
            "--student",
            student,
            "--salt",
            "s",
        ];
        let ran = bed.run(&[&args[..], &["--out", student]].concat());
        assert_eq!(ran.code, Some(0), "{ran:?}");
    }
    let ran = bed.run(&["compare", "anna", "bert", "--json"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let record: Value = serde_json::from_str(&ran.stdout).expect("JSON");
    let notes = record["notes"].as_array().expect("notes");
    let told = |words: &str| {
        notes
            .iter()
            .any(|note| note.as_str().is_some_and(|note| note.contains(words)))
    };
    assert!(told("anna") && told("bert"), "{notes:?}");
    // other goals, so the arms part; both stand in one page, each with its own shelf and can
    assert!(moved(&record)["first"]["time_s"].is_number(), "{record}");
    let page = std::fs::read_to_string(bed.path("kinemark-compare/compare.html")).expect("a page");
    assert!(page.contains("\"name\":\"B/can\"") && page.contains("anna"));
}

#[test]
fn a_lab_whose_robot_has_changed_since_is_compared_with_its_two_robots() {
    let bed = TestBed::new();
    bed.copy_labs();
    let good = root().join("tests/submissions/01-kinematics/good/submission.rhai");
    bed.write(
        "good.rhai",
        std::fs::read_to_string(good).expect("a submission"),
    );
    let grade = |out: &str| bed.run(&["grade", "01-kinematics", "good.rhai", "--out", out]);
    assert_eq!(grade("a").code, Some(0));
    let robot = "labs/robots/rrbot.toml";
    let text = std::fs::read_to_string(bed.path(robot)).expect("a robot");
    assert_eq!(text.matches("damping = 0.7").count(), 2, "{text}");
    bed.write(robot, text.replace("damping = 0.7", "damping = 2.5"));
    let ran = grade("b");
    assert!(matches!(ran.code, Some(0 | 1)), "{ran:?}");
    let ran = bed.run(&["compare", "a", "b", "--json"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let record: Value = serde_json::from_str(&ran.stdout).expect("JSON");
    let notes = record["notes"].to_string();
    assert!(
        notes.contains("robot `rrbot` was changed between the two"),
        "{notes}"
    );
    let motion = moved(&record);
    assert_eq!(motion["same_bits"], false, "{motion}");
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
