//! `kinemark log export`: logs as tables, through the binary.

use crate::testbed::{TestBed, files_below, root};

/// A bed with a report of lab 1 in `out`, graded as a student does.
fn graded() -> TestBed {
    let bed = TestBed::new();
    let submission = root().join("tests/submissions/01-kinematics/good/submission.rhai");
    std::fs::copy(submission, bed.path("mine.rhai")).expect("copied");
    let ran = bed.run(&["grade", "01-kinematics", "mine.rhai"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    bed
}

#[test]
fn a_log_becomes_a_folder_of_tables_and_one_topic_a_stream() {
    let bed = graded();
    let ran = bed.run(&["log", "export", "out/move/run.mcap", "--csv"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let signals =
        std::fs::read_to_string(bed.path("out/move/run-csv/signals.csv")).expect("a table");
    assert!(
        signals.starts_with("\"time_s\",\"q_shoulder\",\"q_elbow\",\"qd_shoulder\""),
        "{}",
        &signals[..100]
    );
    // a topic alone is printed, the same bytes
    let ran = bed.run(&[
        "log",
        "export",
        "out/move/run.mcap",
        "--csv",
        "--topic",
        "/signals",
    ]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout == signals);

    // again: the earlier export is replaced, with the same bytes
    let before = files_below(&bed.path("out/move/run-csv"));
    let ran = bed.run(&["log", "export", "out/move/run.mcap", "--csv", "--json"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(before == files_below(&bed.path("out/move/run-csv")));
    let list: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!(list["format"], "kinemark-export/1");
    for exported in list["files"].as_array().expect("files") {
        let file = exported["file"].as_str().expect("a name");
        let text =
            std::fs::read_to_string(bed.path("out/move/run-csv").join(file)).expect("a table");
        let rows = text.lines().count() as u64 - 1;
        assert_eq!(exported["rows"].as_u64(), Some(rows), "{file}");
    }

    // a folder with something of somebody's own stays as it is
    bed.write("out/move/run-csv/notes.txt", "mine");
    let ran = bed.run(&["log", "export", "out/move/run.mcap", "--csv"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("contains `notes.txt`"), "{ran:?}");
    assert!(bed.path("out/move/run-csv/notes.txt").is_file());
}

/// What people keep in a report's folder is never lost, on whatever level.
#[test]
fn one_wide_table_has_all_topics_at_the_times_of_one() {
    let bed = graded();
    let export = ["log", "export", "out/move/run.mcap", "--csv"];
    let with = |more: &[&str]| bed.run(&[&export[..], more].concat());
    let printed = with(&["--wide"]);
    assert_eq!(printed.code, Some(0), "{}", printed.stderr);
    assert!(
        printed.stderr.contains("`/scene` has"),
        "{}",
        printed.stderr
    );
    let narrow = with(&["--topic", "/signals"]).stdout;
    let (head, rest) = printed.stdout.split_once('\n').expect("a head");
    let (narrow_head, narrow_rest) = narrow.split_once('\n').expect("a head");
    // the clock's own columns come first, with its rows
    assert!(head.starts_with(narrow_head), "{head}");
    assert!(
        head.contains("\"joint_states.joints.shoulder.position\""),
        "{head}"
    );
    assert_eq!(rest.lines().count(), narrow_rest.lines().count());
    for (wide, narrow) in rest.lines().zip(narrow_rest.lines()) {
        assert!(wide.starts_with(narrow), "{wide}");
    }
    let written = with(&["--wide", "--out", "table"]);
    assert_eq!(written.code, Some(0), "{written:?}");
    let file = std::fs::read_to_string(bed.path("table/wide.csv")).expect("a table");
    assert!(file == printed.stdout);
    let refused = with(&["--wide", "--topic", "/sginals"]);
    assert_eq!(refused.code, Some(2), "{refused:?}");
    assert!(
        refused.stderr.contains("no topic `/sginals`"),
        "{refused:?}"
    );
}

#[test]
fn grading_again_keeps_exports_and_refuses_what_is_somebodys_own() {
    let bed = graded();
    let export = ["log", "export", "out/move/run.mcap", "--csv"];
    assert_eq!(bed.run(&export).code, Some(0));
    bed.write("out/move/run-csv/notes.txt", "mine");
    let before = files_below(&bed.path("out/move/run-csv"));
    let grade = [
        "grade",
        "01-kinematics",
        "mine.rhai",
        "--storyboard",
        "--png",
    ];
    for _ in 0..2 {
        let ran = bed.run(&grade);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        assert!(before == files_below(&bed.path("out/move/run-csv")));
    }
    assert!(bed.path("out/move/storyboard.png").is_file());
    // What follows needs no pictures: they cost most of a grade here.
    let grade = &grade[..3];
    let entries = std::fs::read_dir(bed.path("")).expect("the bed");
    let names: Vec<_> = entries.flatten().map(|entry| entry.file_name()).collect();
    assert_eq!(names.len(), 2, "nothing is left over: {names:?}");
    for name in [
        "out/plots/notes.txt",
        "out/move/notes.txt",
        "out/move/deep/notes.txt",
        "out/lab/01-kinematics/notes.md",
        "out/lab/notes.toml",
        "out/notes.txt",
    ] {
        bed.write(name, "mine");
        let report = files_below(&bed.path("out"));
        let ran = bed.run(grade);
        assert_eq!(ran.code, Some(2), "{name}: {ran:?}");
        assert!(ran.stderr.contains("which is not part of"), "{ran:?}");
        assert!(report == files_below(&bed.path("out")), "{name}");
        std::fs::remove_file(bed.path(name)).expect("removed");
        let _ = std::fs::remove_dir(bed.path("out/move/deep"));
    }
    assert_eq!(bed.run(grade).code, Some(0));
}

/// A link to a folder stays one, and files are as open as the umask says.
#[cfg(unix)]
#[test]
fn a_report_is_written_where_a_link_leads_and_as_the_umask_says() {
    use std::os::unix::fs::PermissionsExt as _;
    let bed = graded();
    std::fs::create_dir(bed.path("disk")).expect("a folder");
    std::os::unix::fs::symlink("disk", bed.path("link")).expect("a link");
    let binary = crate::testbed::binary().display();
    let script = format!("umask 077; exec '{binary}' grade 01-kinematics mine.rhai --out link");
    for _ in 0..2 {
        let ran = std::process::Command::new("sh")
            .args(["-c", &script])
            .current_dir(bed.path(""))
            .output()
            .expect("a shell");
        assert_eq!(ran.status.code(), Some(0), "{ran:?}");
        let link = bed.path("link").symlink_metadata().expect("it is there");
        assert!(link.is_symlink());
    }
    for (name, expected) in [
        ("disk", 0o700),
        ("disk/plots", 0o700),
        ("disk/report.html", 0o600),
        ("disk/move/run.mcap", 0o600),
    ] {
        let there = bed.path(name).metadata().expect("it is there");
        assert_eq!(there.permissions().mode() & 0o777, expected, "{name}");
    }
    assert_eq!(bed.run(&["verify", "link", "--practice"]).code, Some(0));
    // the folder one is in cannot be another
    let ran = bed
        .command(&["grade", "01-kinematics", "../mine.rhai", "--out", "."])
        .current_dir(bed.path("disk"))
        .output()
        .expect("the binary runs");
    assert_eq!(ran.status.code(), Some(2), "{ran:?}");
}

#[test]
fn what_is_no_log_is_reported_with_its_code() {
    let bed = TestBed::new();
    bed.write("empty.mcap", "");
    bed.write("text.mcap", "time,q\n0,1\n");
    bed.write("cut.mcap", b"\x89MCAP0\r\n\x01");
    for (name, code, words) in [
        ("nowhere.mcap", 2, "there is no file"),
        (".", 2, "is a folder"),
        ("empty.mcap", 3, "it is empty"),
        ("text.mcap", 3, "it is not an MCAP log"),
        (
            "cut.mcap",
            3,
            "the file is incomplete (cut off after 0 messages)",
        ),
    ] {
        let ran = bed.run(&["log", "export", name, "--csv"]);
        assert_eq!(ran.code, Some(code), "{ran:?}");
        assert!(ran.stderr.contains(words), "{ran:?}");
        assert!(ran.stderr.contains("help:"), "{ran:?}");
    }
    assert_eq!(bed.run(&["log", "export", "text.mcap"]).code, Some(2));
    assert!(!bed.path("text-csv").exists());
}

#[test]
fn a_topic_that_is_not_there_is_reported_with_those_that_are() {
    let bed = graded();
    let ran = bed.run(&[
        "log",
        "export",
        "out/move/run.mcap",
        "--csv",
        "--topic",
        "/signal",
    ]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("has no topic `/signal`"), "{ran:?}");
    assert!(ran.stderr.contains("/joint_states"), "{ran:?}");
}
