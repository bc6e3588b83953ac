//! A report folder that somebody changed: whatever is edited, removed, added or exchanged in it, `verify` does not say that it is the
//! same, and says what is wrong in place of failing.

use std::path::Path;

use kinemark_report::output::{Manifest, digest};
use serde_json::{Value as Json, json};

use crate::testbed::{CommandResult, TestBed, copy};

/// A bed with a practice report in `out`, and the same in `whole`.
fn bed() -> TestBed {
    let bed = TestBed::a_little_off();
    let ran = bed.run(&["grade", "01-kinematics", "submission.rhai", "--practice"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    copy(&bed.path("out"), &bed.path("whole"));
    bed
}

/// Puts the untouched report back.
fn restored(bed: &TestBed) {
    std::fs::remove_dir_all(bed.path("out")).expect("removed");
    copy(&bed.path("whole"), &bed.path("out"));
}

/// Verifies `out`, which ends with a code and these words, and never by a panic.
fn verified(bed: &TestBed, args: &[&str], code: i32, words: &str) -> CommandResult {
    let ran = bed.run(&[&["verify", "out"], args].concat());
    assert_eq!(ran.code, Some(code), "{args:?}: {ran:?}");
    let all = format!("{}{}", ran.stdout, ran.stderr);
    assert!(all.contains(words), "no {words:?} in {ran:?}");
    assert!(!all.contains("panicked"), "{ran:?}");
    ran
}

/// Writes a file of `out` and its digest into the list, as somebody would who knows both.
fn forge(bed: &TestBed, path: &str, bytes: &[u8]) {
    let list = std::fs::read(bed.path("out/report.json")).expect("a list");
    let mut list = Manifest::parse(&list).expect("a list");
    list.files.insert(path.to_owned(), digest(bytes));
    let list = kinemark_report::output::json(&list).expect("JSON");
    bed.write("out/report.json", list);
    bed.write(&format!("out/{path}"), bytes);
}

#[test]
fn what_lies_in_a_report_and_is_no_part_of_it_is_named() {
    let bed = bed();
    for (path, named) in [
        ("report2.html", "`report2.html`"),
        (".hidden", "`.hidden`"),
        ("plots/move-joints-true.svg", "`plots/move-joints-true.svg`"),
        (
            "lab/01-kinematics/variant.txt",
            "`lab/01-kinematics/variant.txt`",
        ),
        ("notes/why.txt", "`notes`"),
    ] {
        bed.write(&format!("out/{path}"), "24 of 24 points");
        let what = format!("differs: {named}\n  recorded in the folder\n");
        verified(&bed, &[], 1, &what);
        restored(&bed);
    }
    std::fs::create_dir(bed.path("out/empty")).expect("a folder");
    verified(&bed, &[], 1, "differs: `empty`\n");
    restored(&bed);
    // listed it is no part of the report either, and named once
    forge(&bed, "report2.html", b"24 of 24 points");
    let ran = verified(
        &bed,
        &[],
        1,
        "list of files in `report.json`: `report2.html`",
    );
    assert_eq!(ran.stdout.matches("differs: ").count(), 1, "{ran:?}");
    restored(&bed);
    for i in 0..300 {
        bed.write(&format!("out/{i}.txt"), "x");
    }
    let ran = verified(&bed, &[], 1, "200 more paths");
    assert_eq!(ran.stdout.matches("differs: ").count(), 101, "{ran:?}");
    restored(&bed);
    // the tables of an export prove nothing, and are to be there
    let ran = bed.run(&["log", "export", "out/move/run.mcap", "--csv"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    verified(&bed, &[], 5, "not compared: tables `move/run-csv`: ");
}

#[test]
fn what_is_missing_or_no_file_is_named() {
    let bed = bed();
    let files = [
        ("report.html", 1),
        ("plots/move-path.svg", 1),
        ("move/run.mcap", 1),
        ("lab/01-kinematics/lab.toml", 1),
        ("lab/01-kinematics/practice.json", 1),
        ("lab/robots/rrbot.toml", 1),
        ("grade.json", 3),
        ("report.json", 3),
        ("submission.rhai", 3),
    ];
    for (path, code) in files {
        std::fs::remove_file(bed.path("out").join(path)).expect(path);
        verified(&bed, &[], code, path);
        // a folder of the name
        std::fs::create_dir(bed.path("out").join(path)).expect("a folder");
        verified(&bed, &[], code, path);
        restored(&bed);
    }
    for folder in ["plots", "move", "lab/robots"] {
        std::fs::remove_dir_all(bed.path("out").join(folder)).expect("removed");
        verified(&bed, &[], 1, "in the folder: missing");
        bed.write(&format!("out/{folder}"), "a file");
        verified(&bed, &[], 1, "in the folder: missing");
        restored(&bed);
    }
    std::fs::remove_dir_all(bed.path("out/lab")).expect("removed");
    verified(&bed, &[], 3, "`out` has no lab");
}

/// Nothing is waited for, and nothing larger is read than a report has.
#[cfg(unix)]
#[test]
fn pipes_and_files_without_end_are_named() {
    let bed = bed();
    for (path, code) in [
        ("report.html", 1),
        ("lab/01-kinematics/lab.toml", 1),
        ("plots/move-path.svg", 1),
        ("grade.json", 3),
        ("submission.rhai", 3),
    ] {
        let place = bed.path("out").join(path);
        std::fs::remove_file(&place).expect("removed");
        let made = std::process::Command::new("mkfifo").arg(&place).status();
        assert!(made.expect("mkfifo").success());
        verified(&bed, &[], code, "it is no plain file");
        std::fs::remove_file(&place).expect("removed");
        let endless = std::fs::File::create(&place).expect("a file");
        endless.set_len(1 << 40).expect("as long as that");
        verified(&bed, &[], code, "more than ");
        restored(&bed);
    }
    // two names of one file are that file
    std::fs::remove_file(bed.path("out/report.html")).expect("removed");
    std::fs::hard_link(bed.path("whole/report.html"), bed.path("out/report.html")).expect("linked");
    verified(&bed, &[], 0, "same bits");
    std::fs::remove_file(bed.path("out/report.html")).expect("removed");
    std::fs::hard_link(bed.path("submission.rhai"), bed.path("out/report.html")).expect("linked");
    verified(&bed, &[], 1, "differs: file `report.html`");
}

#[test]
fn the_files_of_another_run_are_named() {
    let bed = bed();
    let other = "submission.rhai";
    bed.edit(other, "time < 2.5", "time < 2.6");
    let grade = [
        "grade",
        "01-kinematics",
        other,
        "--practice",
        "--out",
        "other",
    ];
    let ran = bed.run(&grade);
    assert!(matches!(ran.code, Some(0 | 1)), "{ran:?}");
    for path in ["move/run.mcap", "report.html", "plots/move-path.svg"] {
        let exchanged = std::fs::read(bed.path("other").join(path)).expect(path);
        forge(&bed, path, &exchanged);
        let ran = verified(&bed, &[], 1, &format!("differs: file `{path}`"));
        assert_eq!(ran.stdout.matches("differs: file").count(), 1, "{ran:?}");
        restored(&bed);
    }
    // the whole record of a better run, with its files and not its submission
    let submission = std::fs::read(bed.path("out/submission.rhai")).expect("a submission");
    std::fs::remove_dir_all(bed.path("out")).expect("removed");
    copy(&bed.path("other"), &bed.path("out"));
    forge(&bed, "submission.rhai", &submission);
    verified(&bed, &[], 1, "the submission was changed after grading");
}

#[test]
fn copies_that_were_changed_are_named_and_grade_nothing() {
    let bed = bed();
    for (path, from, to) in [
        ("lab/robots/rrbot.toml", "damping = 0.7", "damping = 0.1"),
        (
            "lab/01-kinematics/lab.toml",
            "points = 6.0",
            "points = 60.0",
        ),
        ("lab/01-kinematics/practice.json", "\"time\":", "\"time\":9"),
    ] {
        let text = std::fs::read_to_string(bed.path("out").join(path)).expect(path);
        assert!(text.contains(from), "{path}");
        forge(&bed, path, text.replace(from, to).as_bytes());
        let ran = verified(&bed, &[], 1, &format!("differs: file `{path}`"));
        assert!(
            ran.stdout.contains("its files were changed after grading"),
            "{ran:?}"
        );
        // broken beyond reading, too
        forge(&bed, path, b"\xff[[[[");
        verified(&bed, &[], 1, &format!("differs: file `{path}`"));
        restored(&bed);
    }
    // a variant that is none of this lab, and one that is no variant
    bed.write("out/lab/01-kinematics/variant.toml", "[[ x");
    verified(&bed, &[], 3, "variant.toml");
    bed.write(
        "out/lab/01-kinematics/variant.toml",
        "format = 1\nlab = \"01-kinematics\"\nstudent = \"s1\"\n[parameters]\nlink_lengths = [0.1, 0.1]\n",
    );
    verified(&bed, &[], 1, "variant");
}

/// Each is a mistake of the report, with its file; none of them is taken for less than that.
#[test]
fn broken_records_and_lists_are_refused() {
    let bed = bed();
    let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    for path in ["grade.json", "report.json"] {
        let whole = std::fs::read_to_string(bed.path("out").join(path)).expect(path);
        let half = whole[..whole.len() / 2].to_owned();
        let twice = whole.replacen('{', "{\"format\": \"x\",", 1);
        let broken = ["", "null", "[]", "{}", "\u{0}", &deep, &half, &twice];
        for text in broken {
            bed.write(&format!("out/{path}"), text);
            verified(&bed, &[], 3, path);
        }
        restored(&bed);
        // the same in other letters is no file that a report has
        bed.write(&format!("out/{path}"), whole.replacen('{', "{ ", 1));
        verified(&bed, &[], 1, &format!("differs: file `{path}`"));
        restored(&bed);
    }
}

/// Numbers that no grade has, one at a time: each is found, and none breaks what compares it.
#[test]
fn a_number_that_was_changed_is_found_wherever_it_is() {
    let bed = bed();
    let record = std::fs::read(bed.path("out/grade.json")).expect("a record");
    let record: Json = serde_json::from_slice(&record).expect("JSON");
    for (pointer, value) in [
        ("/points", json!(-1.0)),
        ("/points", json!(1e308)),
        ("/max_points", json!(-1e308)),
        ("/tasks/0/points", json!(1e-300)),
        ("/tasks/0/checks/0/max_points", json!(-5.0)),
        ("/tasks/2/operations", json!(u64::MAX)),
        ("/tasks/2/checks/0/points", json!(1e308)),
        ("/tasks/2/checks/0/evidence/0/tick", json!(u64::MAX)),
        ("/tasks/2/digests/seconds", json!([])),
        ("/tasks", json!([])),
        ("/lab/name", json!("../../secret")),
        ("/lab/name", json!("")),
        ("/submission/name", json!("../../x")),
        ("/verdict", json!("passed")),
    ] {
        let mut forged = record.clone();
        *forged.pointer_mut(pointer).expect(pointer) = value.clone();
        let text = kinemark_report::output::json(&forged).expect("JSON");
        forge(&bed, "grade.json", text.as_bytes());
        for args in [&[][..], &["--practice"], &["--json"]] {
            let ran = bed.run(&[&["verify", "out"], args].concat());
            let what = format!("{pointer} = {value} {args:?}");
            assert!(matches!(ran.code, Some(1 | 3)), "{what}: {ran:?}");
            assert!(!ran.stderr.contains("panicked"), "{what}: {ran:?}");
        }
        restored(&bed);
    }
}

/// Labs, staff part and course that a student handed in beside the report.
#[test]
fn labs_that_may_have_been_handed_in_prove_nothing_to_course_staff() {
    let bed = TestBed::a_little_off();
    let ran = bed.run(&["grade", "01-kinematics", "submission.rhai"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let handed_in = bed.path("inbox/s1");
    for folder in ["labs", "reference", "out"] {
        copy(&bed.path(folder), &handed_in.join(folder));
    }
    let course: Vec<String> = ["labs", "reference"]
        .iter()
        .map(|folder| bed.path(folder).display().to_string())
        .collect();
    let run = |from: &Path, args: &[&str]| bed.run_in(from, &[&["verify"], args].concat());
    // labs of the course lie above
    let ran = run(&handed_in, &["out"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("may be part of what was handed in"),
        "{ran:?}"
    );
    let named = [
        "out",
        "--graded",
        "--labs",
        &course[0],
        "--reference",
        &course[1],
    ];
    assert_eq!(run(&handed_in, &named).code, Some(0));
    assert_eq!(
        run(bed.path("").as_path(), &["inbox/s1/out", "--graded"]).code,
        Some(0)
    );
    // and where nothing is above, --graded takes none beside the report
    for folder in ["labs", "reference"] {
        std::fs::rename(
            bed.path(folder),
            bed.path("inbox").join(format!("{folder}-away")),
        )
        .expect("moved");
    }
    let ran = run(&handed_in, &["out", "--graded"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("it lies in the folder of the report"),
        "{ran:?}"
    );
    let ran = run(&handed_in.join("out"), &[".", "--graded"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    // whoever is no course staff has the labs beside the own report
    assert_eq!(run(&handed_in, &["out"]).code, Some(0));
}

#[test]
fn a_machine_without_a_sealed_worker_verifies_nothing_where_one_is_asked_for() {
    let bed = bed();
    let sealed = bed.run(&["doctor", "--json"]);
    let doctor: Json = serde_json::from_str(&sealed.stdout).unwrap_or_default();
    let ran = bed.run(&["verify", "out", "--require-sandbox"]);
    match doctor["sealed"].as_bool() {
        Some(true) => assert_eq!(ran.code, Some(0), "{ran:?}"),
        _ => assert_eq!(ran.code, Some(2), "{ran:?} {doctor}"),
    }
}
