//! `kinemark grade` as a user sees it: text, files, exit codes.

use crate::golden::reads;
use crate::testbed::{OWN_LABS, TestBed, files_below, root};

fn good(bed: &TestBed) {
    let submission = root().join("tests/submissions/01-kinematics/good/submission.rhai");
    std::fs::copy(submission, bed.path("submission.rhai")).expect("copied");
}

#[test]
fn a_good_submission_has_full_marks_and_a_whole_folder() {
    let bed = TestBed::new();
    bed.copy_labs();
    good(&bed);
    let ran = bed.run(&["grade", "01-kinematics", "submission.rhai"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert_eq!(ran.stderr, OWN_LABS);
    assert!(
        ran.stdout
            .ends_with("24 of 24 points\nreport: out/report.html\n"),
        "{ran:?}"
    );
    let files = files_below(&bed.path("out"));
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    for name in [
        "grade.json",
        "lab/01-kinematics/lab.toml",
        "lab/robots/rrbot.toml",
        "move/run.mcap",
        "plots/move-joints.svg",
        "report.html",
        "report.json",
        "submission.rhai",
    ] {
        assert!(names.contains(&name), "{name} is missing in {names:?}");
    }
    // no path of this machine is in any file
    let here = bed.path("").canonicalize().expect("path");
    for (name, bytes) in &files {
        for path in [
            here.to_string_lossy(),
            root().canonicalize().expect("root").to_string_lossy(),
        ] {
            let found = bytes
                .windows(path.len())
                .any(|window| window == path.as_bytes());
            assert!(!found, "{name} holds {path}");
        }
    }
    // nothing else is left behind
    let mut left: Vec<String> = std::fs::read_dir(bed.path(""))
        .expect("folder")
        .map(|entry| {
            entry
                .expect("entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    left.sort();
    assert_eq!(left, ["labs", "out", "reference", "submission.rhai"]);
}

#[test]
fn the_record_is_printed_as_it_is_written() {
    let bed = TestBed::new();
    good(&bed);
    let ran = bed.run(&[
        "grade",
        "01-kinematics",
        "submission.rhai",
        "--json",
        "--out",
        "a/b",
    ]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let written = std::fs::read_to_string(bed.path("a/b/grade.json")).expect("record");
    assert_eq!(ran.stdout, written);
}

#[test]
fn an_earlier_report_is_replaced_whole_and_nothing_else_ever() {
    let bed = TestBed::new();
    good(&bed);
    let args = ["grade", "01-kinematics", "submission.rhai"];
    assert_eq!(bed.run(&args).code, Some(0));
    // a plot that the report lists goes with it, one that it does not list is somebody's
    bed.write("out/plots/stale.svg", "old");
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("contains `plots/stale.svg`"), "{ran:?}");
    bed.edit(
        "out/report.json",
        "\"files\": {",
        "\"files\": {\n    \"plots/stale.svg\": \"\",",
    );
    assert_eq!(bed.run(&args).code, Some(0));
    assert!(!bed.path("out/plots/stale.svg").exists());
    // a folder of an older version has no list of its files
    std::fs::rename(bed.path("out/report.json"), bed.path("away")).expect("moved");
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr.contains("no report.json") && ran.stderr.contains("move or delete"),
        "{ran:?}"
    );
    std::fs::rename(bed.path("away"), bed.path("out/report.json")).expect("moved");
    // a file stays a file, whatever it is
    let ran = bed.run(&[
        "grade",
        "01-kinematics",
        "submission.rhai",
        "--out",
        "submission.rhai",
    ]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("is not a directory"), "{ran:?}");
    bed.write("thesis/chapter.tex", "precious");
    let ran = bed.run(&[
        "grade",
        "01-kinematics",
        "submission.rhai",
        "--out",
        "thesis",
    ]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("contains `chapter.tex`"), "{ran:?}");
    // not even beside an earlier report
    bed.write("out/notes.txt", "precious");
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(bed.path("out/notes.txt").exists());
    assert!(bed.path("thesis/chapter.tex").exists());
}

#[test]
fn a_wrong_submission_reads_like_this() {
    let bed = TestBed::new();
    bed.copy_labs();
    let submission = "fn forward_kinematics(robot, q) {
    let l = robot.link_lengths;
    let x = robot.base_height + l[0] * cos(q[0]) + l[1] * cos(q[1]);
    [x, l[0] * sin(q[0]) + l[1] * sin(q[1]), 2 * robot.link_offset]
}

fn inverse_kinematics(robot, position) {
    [acos(position[0]), 0.0]
}

fn control(observation) {
    let goal = observation.taget;
    goal
}
";
    bed.write("submission.rhai", submission);
    let ran = bed.run(&["grade", "01-kinematics", "submission.rhai"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    reads("a_wrong_submission_reads_like_this", &ran.stdout);
}

#[cfg(unix)]
#[test]
fn a_pipe_or_a_device_is_no_folder_to_replace() {
    let bed = TestBed::new();
    good(&bed);
    let link = bed.path("nowhere");
    std::os::unix::fs::symlink("/no/such/folder", &link).expect("link");
    for out in ["/dev/null", "nowhere"] {
        let ran = bed.run(&["grade", "01-kinematics", "submission.rhai", "--out", out]);
        assert_eq!(ran.code, Some(2), "{out}: {ran:?}");
    }
    assert!(link.symlink_metadata().is_ok_and(|data| data.is_symlink()));
}

#[cfg(unix)]
#[test]
fn a_folder_that_cannot_be_written_does_not_lose_the_grade() {
    let bed = TestBed::new();
    good(&bed);
    // no user can create a folder on a device, not even the administrator, whom permissions would not stop
    let ran = bed.run(&[
        "grade",
        "01-kinematics",
        "submission.rhai",
        "--out",
        "/dev/full/out",
    ]);
    assert_eq!(ran.code, Some(4), "{ran:?}");
    assert!(ran.stdout.contains("24 of 24 points"), "{ran:?}");
    assert!(ran.stderr.contains("cannot be written"), "{ran:?}");
}

#[cfg(target_os = "linux")]
#[test]
fn an_output_that_cannot_be_written_does_not_lose_the_report() {
    let bed = TestBed::new();
    good(&bed);
    for more in [&[][..], &["--json"], &["--format", "short"]] {
        let full = std::fs::File::options().write(true).open("/dev/full");
        let mut command = bed.command(&["grade", "01-kinematics", "submission.rhai"]);
        command.args(more).stdout(full.expect("/dev/full"));
        let ran = command.output().expect("the binary runs");
        let ran: crate::testbed::CommandResult = ran.into();
        assert_eq!(ran.code, Some(4), "{more:?} {ran:?}");
        let says = "standard output cannot be written";
        assert!(ran.stderr.contains(says), "{ran:?}");
        assert_eq!(bed.run(&["verify", "out"]).code, Some(0), "{more:?}");
        std::fs::remove_dir_all(bed.path("out")).expect("a report");
    }
}

/// What is in a folder that this test made, without the submission.
#[cfg(unix)]
fn beside(bed: &TestBed) -> Vec<String> {
    let entries = std::fs::read_dir(bed.path(".")).expect("a folder");
    let names = entries.map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<String> = names
        .map(|name| name.into_string().expect("UTF-8"))
        .filter(|name| name != "submission.rhai")
        .collect();
    names.sort();
    names
}

/// Grades, and is killed in the midst of the report, every time at the same place: the system kills what writes more to a file than is
/// allowed.
#[cfg(unix)]
fn killed(bed: &TestBed, blocks: u32) {
    let script = format!(
        "ulimit -f {blocks}; exec '{}' grade 01-kinematics submission.rhai",
        crate::testbed::binary().display()
    );
    let mut limited = std::process::Command::new("sh");
    limited.args(["-c", &script]).current_dir(bed.path("."));
    let ran: crate::testbed::CommandResult = limited.output().expect("sh runs").into();
    assert_eq!(ran.code, None, "it was not killed: {ran:?}");
}

#[cfg(unix)]
#[test]
fn what_a_killed_grade_leaves_is_gone_after_the_next() {
    let bed = TestBed::new();
    good(&bed);
    killed(&bed, 8);
    let left = beside(&bed);
    assert!(
        left.len() == 1 && left[0].starts_with(".kinemark-"),
        "{left:?}"
    );
    let grade = ["grade", "01-kinematics", "submission.rhai"];
    let ran = bed.run(&grade);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert_eq!(beside(&bed), ["out"]);
    // an earlier report stays whole
    let page = || std::fs::read(bed.path("out/report.html")).expect("a page");
    let before = page();
    killed(&bed, 64);
    assert_eq!(beside(&bed).len(), 2);
    assert_eq!(bed.run(&["verify", "out"]).code, Some(0));
    // tables beside a log, as a grade that was killed behind the exchange would leave them
    let left = beside(&bed).remove(0);
    let table = format!("{left}/new/move/run-csv/a.csv");
    bed.write(&table, "mine");
    let place = r#"{ "name": "out", "kept": ["move/run-csv"] }"#;
    bed.write(&format!("{left}/place.json"), place);
    let log = ["log", "export", "out/move/run.mcap", "--csv"];
    let out = ["--out", "tables"];
    let ran = bed.run(&[&log[..], &out].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert_eq!(beside(&bed), ["out", "tables"]);
    let table = std::fs::read_to_string(bed.path("out/move/run-csv/a.csv"));
    assert_eq!(table.expect("a table"), "mine");
    assert_eq!(page(), before);
}

/// Where folders cannot be exchanged a report is moved aside for a moment: whoever looks for it then finds it.
#[cfg(unix)]
#[test]
fn a_report_that_a_killed_grade_had_moved_aside_is_found() {
    let bed = TestBed::new();
    good(&bed);
    let grade = ["grade", "01-kinematics", "submission.rhai"];
    for look in [&["verify", "out"][..], &grade] {
        let ran = bed.run(&grade);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        killed(&bed, 64);
        let left = beside(&bed).remove(0);
        bed.write(
            &format!("{left}/place.json"),
            r#"{ "name": "out", "kept": [] }"#,
        );
        std::fs::rename(bed.path("out"), bed.path(&left).join("old")).expect("moved aside");
        let ran = bed.run(look);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        assert_eq!(beside(&bed), ["out"]);
    }
}

/// Who grades a class loops over folders that students named.
#[cfg(unix)]
#[test]
fn a_folder_that_would_steer_the_terminal_is_printed_in_plain_characters() {
    let bed = TestBed::new();
    assert_eq!(bed.run(&["new", "01-kinematics", "mine"]).code, Some(0));
    let out = "o\u{1b}[31m\u{202E}x";
    let args = [
        "grade",
        "01-kinematics",
        "mine/submission.rhai",
        "--out",
        out,
    ];
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let expected = "report: o⟨U+001B⟩[31m⟨U+202E⟩x/report.html\n";
    assert!(ran.stdout.contains(expected), "{ran:?}");
    assert!(bed.path(out).join("report.html").exists());
}
