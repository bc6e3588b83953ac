//! `kinemark compare`: compares two reports of a lab.

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
fn motions_with_the_same_bits_are_said_to_be_the_same() {
    let bed = TestBed::new();
    let good = root().join("tests/submissions/03-knock-with-position/good/submission.rhai");
    let good = std::fs::read_to_string(good).expect("a submission");
    bed.write("a.rhai", &good);
    bed.write(
        "b.rhai",
        good.replace("== \"hold\"", "== \"hold\" || false"),
    );
    for name in ["a", "b"] {
        let file = format!("{name}.rhai");
        let ran = bed.run(&["grade", "03-knock-with-position", &file, "--out", name]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
    }
    let ran = bed.run(&["compare", "a", "b"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let said = ran
        .stdout
        .matches("the motions are the same, bit for bit")
        .count();
    assert_eq!(said, 2, "{ran:?}");
    for task in record(&bed)["tasks"].as_array().expect("tasks") {
        assert_eq!(task["motion"]["same_bits"], true, "{task}");
    }
}

#[test]
fn compare_takes_the_options_of_grade() {
    let bed = graded();
    let full = bed.run(&["compare", "a", "b", "-v", "--label", "Ada <1>"]);
    assert_eq!(full.code, Some(0), "{full:?}");
    let page = std::fs::read_to_string(bed.path("kinemark-compare/compare.html")).expect("a page");
    assert!(page.contains("<title>Ada &lt;1&gt;, 01-kinematics: "));
    assert!(page.contains("<p class=\"whose\"><bdi>Ada &lt;1&gt;</bdi></p>"));
    let folded = bed.run(&["compare", "a", "b", "--in-process"]);
    let lines = |ran: &crate::testbed::CommandResult| ran.stdout.lines().count();
    assert!(
        folded
            .stdout
            .contains("checks have all their points in both"),
        "{folded:?}"
    );
    assert!(!full.stdout.contains("in both"), "{full:?}");
    assert!(lines(&full) > lines(&folded), "{full:?} {folded:?}");
    let total = bed.run(&["compare", "a", "b", "-q"]);
    assert_eq!(lines(&total), 1, "{total:?}");
    assert!(full.stdout.contains(total.stdout.trim_end()), "{total:?}");
    for refused in [
        &["-q", "-v"][..],
        &["--json", "-q"],
        &["--in-process", "--require-sandbox"],
    ] {
        let ran = bed.run(&[&["compare", "a", "b"], refused].concat());
        assert_eq!(ran.code, Some(2), "{refused:?} {ran:?}");
    }
}

#[test]
fn a_comparison_names_where_two_attempts_first_differ() {
    let bed = graded();
    let ran = bed.run(&["compare", "a", "b"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout.contains("A  a: a.rhai, 24 of 24 points, passed"),
        "{ran:?}"
    );
    let line = ran
        .stdout
        .lines()
        .find(|line| line.contains("first differ at"));
    let line = line.expect("a difference");
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
        line.contains(first["message"].as_str().expect("words")),
        "{line}"
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
    assert!(ran.stderr.contains("contains `notes.txt`"), "{ran:?}");
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
    let noted = |words: &str| {
        notes
            .iter()
            .any(|note| note.as_str().is_some_and(|note| note.contains(words)))
    };
    assert!(noted("anna") && noted("bert"), "{notes:?}");
    // other goals, so the arms part; both stand in one page, each with its own shelf and can
    assert!(moved(&record)["first"]["time_s"].is_number(), "{record}");
    let page = std::fs::read_to_string(bed.path("kinemark-compare/compare.html")).expect("a page");
    assert!(page.contains("\"name\":\"B/can\"") && page.contains("anna"));
    // the shelf, which never moves, and where the TCP of B went, in a lab without a reference path
    assert!(page.contains("\"name\":\"B/shelf\",\"kind\":\"ghost\""));
    assert!(page.contains("\"reference\":{\"periodS\":0.01,"));
}

#[test]
fn a_run_that_stopped_is_reported_with_when_and_why() {
    let bed = TestBed::new();
    let lab = "04-knock-with-velocity";
    for (out, case) in [("a", "good"), ("b", "nan-at-the-corner")] {
        let file = format!("tests/submissions/{lab}/{case}/submission.rhai");
        std::fs::copy(root().join(file), bed.path(&format!("{out}.rhai"))).expect("copied");
        let file = format!("{out}.rhai");
        let ran = bed.run(&["grade", lab, &file, "--out", out]);
        assert!(matches!(ran.code, Some(0 | 1)), "{ran:?}");
    }
    let ran = bed.run(&["compare", "a", "b"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let graded = std::fs::read_to_string(bed.path("b/grade.json")).expect("a record");
    let graded: Value = serde_json::from_str(&graded).expect("JSON");
    let tasks = graded["tasks"].as_array().expect("tasks");
    let task = tasks.iter().find(|task| task["stopped"].is_object());
    let stopped = &task.expect("a task that stopped")["stopped"];
    let time_s = stopped["time_s"].as_f64().expect("a time");
    let message = stopped["message"].as_str().expect("words");
    let line = ran
        .stdout
        .lines()
        .find(|line| line.contains("B stopped at"));
    let line = line.expect("when it stopped");
    assert!(line.contains(&format!("{time_s:.2} s")), "{line} {time_s}");
    assert!(line.contains(message), "{line}");
    assert!(!ran.stdout.contains("A stopped"), "{ran:?}");
    // a check that was not judged shows a dash and not zero
    assert!(ran.stdout.contains(" \u{2013}/"), "{ran:?}");
    let record = record(&bed);
    let tasks = record["tasks"].as_array().expect("tasks");
    let task = tasks.iter().find(|task| task["ended_b"].is_object());
    let task = task.expect("a task that B ended early");
    assert_eq!(task["ended_b"]["message"], stopped["message"]);
    assert_eq!(task["ended_b"]["tick"], stopped["tick"]);
    assert!(task["ended_a"].is_null());
    let checks = task["checks"].as_array().expect("checks");
    assert!(
        checks
            .iter()
            .any(|check| check["outcome_b"] == "not-judged")
    );
    let page = std::fs::read_to_string(bed.path("kinemark-compare/compare.html")).expect("a page");
    assert!(page.contains("B stopped at <a class=\"seek\""), "no moment");
    assert!(page.contains("not judged"));
}

/// A failure of the machine is not a result.
#[cfg(target_os = "linux")]
#[test]
fn a_machine_that_cannot_run_them_again_is_reported_and_nothing_is_written() {
    let bed = graded();
    let binary = crate::testbed::binary();
    // no process gets the pipes to a worker
    let script = format!("ulimit -n 7; exec '{}' compare a b", binary.display());
    let ran = std::process::Command::new("bash")
        .args(["-c", &script])
        .current_dir(bed.path(""))
        .output()
        .expect("a shell");
    let stderr = String::from_utf8_lossy(&ran.stderr);
    assert_eq!(ran.status.code(), Some(4), "{stderr}");
    assert!(stderr.contains("could not be run again"), "{stderr}");
    assert!(ran.stdout.is_empty());
    assert!(!bed.path("kinemark-compare").exists());
}

#[test]
fn what_is_no_whole_report_of_this_version_is_refused() {
    let bed = graded();
    let broken = |words: &str| {
        for args in [&["compare", "a", "b"][..], &["verify", "b", "--practice"]] {
            let ran = bed.run(args);
            assert_eq!(ran.code, Some(3), "{args:?} {ran:?}");
            let stderr = ran.stderr.replace("\n  \u{2502} ", " ");
            assert!(
                stderr.contains(words) && stderr.contains("help:"),
                "{ran:?}"
            );
        }
    };
    bed.edit("b/grade.json", "kinemark-grade/1", "kinemark-grade/7");
    broken("kinemark-grade/7");
    bed.edit("b/grade.json", "kinemark-grade/7", "kinemark-grade/1");
    for name in ["report.json", "submission.rhai", "lab"] {
        let away = bed.path("away");
        std::fs::rename(bed.path(&format!("b/{name}")), &away).expect("moved");
        broken(&format!("`b` has no {name}"));
        std::fs::rename(&away, bed.path(&format!("b/{name}"))).expect("moved");
    }
    std::fs::rename(bed.path("b/lab/01-kinematics"), bed.path("away")).expect("moved");
    let ran = bed.run(&["compare", "a", "b"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    let stderr = ran.stderr.replace("\n  \u{2502} ", " ");
    assert!(stderr.contains("has no lab `01-kinematics`"), "{ran:?}");
    // where the course has the lab, its copies are files like others
    let ran = bed.run(&["verify", "b", "--practice"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let missing = "file `lab/01-kinematics/lab.toml`\n  in the folder: missing";
    assert!(ran.stdout.contains(missing), "{ran:?}");
}

/// Names in a record that somebody sent must not steer a terminal.
#[test]
fn foreign_names_are_shown_harmlessly() {
    let bed = graded();
    let escape = "\\u001b]0;owned\\u0007\\u202e";
    let path = bed.path("b/grade.json");
    let text = std::fs::read_to_string(&path).expect("a record");
    let mut record: Value = serde_json::from_str(&text).expect("JSON");
    let mut spoil = |pointer: &str| {
        let text = record.pointer(pointer).and_then(Value::as_str);
        let spoilt = format!("{}{escape}", text.expect("a text"));
        let spoilt: Value = serde_json::from_str(&format!("\"{spoilt}\"")).expect("a text");
        *record.pointer_mut(pointer).expect("a place") = spoilt;
        let bytes = serde_json::to_vec(&record).expect("JSON");
        // both, so that they are still of one lab
        for out in ["a", "b"] {
            bed.write(&format!("{out}/grade.json"), &bytes);
        }
    };
    for pointer in [
        "/tasks/0/title",
        "/tasks/0/checks/0/title",
        "/tasks/0/checks/0/name",
    ] {
        spoil(pointer);
    }
    let harmless = |ran: &crate::testbed::CommandResult| {
        for text in [&ran.stdout, &ran.stderr] {
            assert!(!text.contains(['\u{1b}', '\u{7}', '\u{202e}']), "{text:?}");
        }
    };
    let ran = bed.run(&["compare", "a", "b"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.contains("\u{27e8}U+001B\u{27e9}"), "{ran:?}");
    harmless(&ran);
    spoil("/tasks/1/name");
    harmless(&bed.run(&["compare", "a", "b"]));
    spoil("/lab/name");
    harmless(&bed.run(&["compare", "a", "b"]));
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
fn a_report_that_was_changed_is_noticed() {
    let bed = graded();
    bed.edit("a/submission.rhai", "time < 2.5", "time < 2.6");
    let ran = bed.run(&["compare", "a", "b"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    for words in [
        "the submission in A has changed since it was graded",
        "the repeated motion of task `move` of A differs from the recorded one from second 2 on",
    ] {
        assert!(ran.stdout.contains(words), "{words}: {ran:?}");
    }
}

#[test]
fn what_has_nothing_in_common_is_refused_with_the_way_out() {
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
