//! Links in a report that somebody handed in: no command follows one, whatever it replaces, and nothing of what it leads to is shown.

#![cfg(unix)]

use std::os::unix::fs::symlink;

use crate::testbed::{CommandResult, Serving, TestBed, files_below};

/// What must not be seen: no TOML, no JSON and no script, so an error about it would quote it.
const SECRET: &str = "SALT-OF-THE-COURSE = = { 7";

/// A bed with two reports of the same submission, `out` and `other`, and a secret beside them.
fn bed() -> TestBed {
    let bed = TestBed::a_little_off();
    for out in ["out", "other"] {
        let args = ["grade", "01-kinematics", "submission.rhai", "--practice"];
        let ran = bed.run(&[&args[..], &["--out", out]].concat());
        assert_eq!(ran.code, Some(1), "{ran:?}");
    }
    bed.write("secret/lab.toml", SECRET);
    for name in ["grade.json", "report.json", "run.mcap", "rrbot.toml"] {
        bed.write(&format!("secret/{name}"), SECRET);
    }
    bed
}

fn shows_nothing(ran: &CommandResult, what: &str) {
    let all = format!("{}{}", ran.stdout, ran.stderr);
    assert!(!all.contains("SALT-OF"), "{what}: {all}");
}

/// Puts a link to `target` in the place of `path`, and gives back what was there.
fn planted(bed: &TestBed, path: &str, target: &str) {
    let place = bed.path(path);
    if place.symlink_metadata().is_ok() {
        let aside = bed.path("aside");
        std::fs::rename(&place, aside).expect("moved");
    }
    symlink(bed.path(target), place).expect("a link");
}

fn taken_out(bed: &TestBed, path: &str) {
    std::fs::remove_file(bed.path(path)).expect("removed");
    if bed.path("aside").exists() {
        std::fs::rename(bed.path("aside"), bed.path(path)).expect("moved");
    }
}

#[test]
fn no_command_follows_a_link_in_a_report() {
    let bed = bed();
    let whole = files_below(&bed.path("out"));
    for (path, target) in [
        ("out/grade.json", "secret/grade.json"),
        ("out/report.json", "secret/report.json"),
        ("out/submission.rhai", "secret/lab.toml"),
        ("out/lab", "secret"),
        ("out/lab/01-kinematics", "secret"),
        ("out/lab/01-kinematics/lab.toml", "secret/lab.toml"),
        ("out/lab/01-kinematics/variant.toml", "secret/lab.toml"),
        ("out/lab/01-kinematics/practice.json", "secret/lab.toml"),
        ("out/lab/robots", "secret"),
        ("out/lab/robots/rrbot.toml", "secret/lab.toml"),
        // a link to what was there is one, too
        ("out/lab/robots/rrbot.toml", "aside"),
    ] {
        planted(&bed, path, target);
        for args in [
            &["verify", "out"][..],
            &["verify", "out", "--practice", "--json"],
            &["compare", "other", "out"],
        ] {
            let what = format!("{args:?} {path} -> {target}");
            let ran = bed.run(args);
            assert!(matches!(ran.code, Some(1 | 3)), "{what}: {ran:?}");
            let all = format!("{}{}", ran.stdout, ran.stderr).replace("\n  \u{2502} ", " ");
            assert!(all.contains("is a link"), "{what}: {ran:?}");
            shows_nothing(&ran, &what);
        }
        taken_out(&bed, path);
    }
    // pictures and pages are compared, and read by nobody else
    for (path, target) in [
        ("out/report.html", "secret/lab.toml"),
        ("out/plots", "other/plots"),
        ("out/move/run.mcap", "other/move/run.mcap"),
    ] {
        planted(&bed, path, target);
        let ran = bed.run(&["verify", "out"]);
        assert_eq!(ran.code, Some(1), "{path}: {ran:?}");
        assert!(ran.stdout.contains("is a link"), "{path}: {ran:?}");
        shows_nothing(&ran, path);
        taken_out(&bed, path);
    }
    assert!(whole == files_below(&bed.path("out")));
    // the folder itself may be reached by one
    symlink("out", bed.path("chosen")).expect("a link");
    assert_eq!(bed.run(&["verify", "chosen"]).code, Some(0));
    assert_eq!(bed.run(&["compare", "chosen", "other"]).code, Some(0));
}

#[test]
fn a_log_of_a_report_is_read_in_the_report_alone() {
    let bed = bed();
    let export = ["log", "export", "out/move/run.mcap", "--csv"];
    for (path, target) in [
        ("out/move/run.mcap", "other/move/run.mcap"),
        ("out/move", "other/move"),
    ] {
        planted(&bed, path, target);
        let ran = bed.run(&export);
        assert_eq!(ran.code, Some(3), "{path}: {ran:?}");
        assert!(ran.stderr.contains("is a link"), "{path}: {ran:?}");
        let inside = bed.run_in(
            &bed.path("out"),
            &["log", "export", "move/run.mcap", "--csv"],
        );
        assert_eq!(inside.code, Some(3), "{path}: {inside:?}");
        taken_out(&bed, path);
    }
    // a record beside the log makes no report of the folder that a link leads to
    std::fs::copy(
        bed.path("out/grade.json"),
        bed.path("other/move/grade.json"),
    )
    .expect("copied");
    planted(&bed, "out/move", "other/move");
    assert_eq!(bed.run(&export).code, Some(3));
    taken_out(&bed, "out/move");
    // tables go nowhere else, either
    assert_eq!(bed.run(&export).code, Some(0));
    std::fs::rename(bed.path("out/move/run-csv"), bed.path("mine")).expect("moved");
    let mine = files_below(&bed.path("mine"));
    planted(&bed, "out/move/run-csv", "mine");
    bed.edit("mine/export.json", "{", "{ ");
    let ran = bed.run(&export);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert_eq!(files_below(&bed.path("mine")).len(), mine.len());
    // a log that lies elsewhere is whoever names it's
    std::fs::copy(bed.path("out/move/run.mcap"), bed.path("log.mcap")).expect("copied");
    symlink("log.mcap", bed.path("same.mcap")).expect("a link");
    let ran = bed.run(&["log", "export", "same.mcap", "--csv"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
}

#[test]
fn what_shows_or_continues_a_report_follows_no_link_in_it() {
    let bed = bed();
    planted(&bed, "out/plots/move-path.svg", "secret/lab.toml");
    let (serving, _) = Serving::start(&bed, &["view", "out", "--no-open"]);
    assert_eq!(serving.get("/report.html").code, 200);
    assert_eq!(serving.get("/plots/move-path.svg").code, 404);
    assert_eq!(serving.stop(), Some(0));
    taken_out(&bed, "out/plots/move-path.svg");
    // no report is known then, and nothing is replaced
    planted(&bed, "out/grade.json", "other/grade.json");
    let lost = |ran: &CommandResult| ran.stdout.contains("which lost points in the last report");
    let ran = bed.run(&["hint", "move", "--lab", "01-kinematics"]);
    assert!(!lost(&ran), "{ran:?}");
    taken_out(&bed, "out/grade.json");
    let ran = bed.run(&["hint", "move", "--lab", "01-kinematics"]);
    assert!(lost(&ran), "{ran:?}");
    planted(&bed, "out/report.json", "secret/report.json");
    let ran = bed.run(&["grade", "01-kinematics", "submission.rhai", "--practice"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    shows_nothing(&ran, "grade");
    taken_out(&bed, "out/report.json");
    // what lies beside a submission is handed in with it
    bed.write("kinemark.toml", "lab = \"01-kinematics\"\n");
    for name in [".kinemark-history.json", ".kinemark-hints.json"] {
        // the hints above have written one
        let _ = std::fs::remove_file(bed.path(name));
        symlink(bed.path("secret/grade.json"), bed.path(name)).expect("a link");
    }
    for args in [
        &["grade", "--practice"][..],
        &["hint", "--lab", "01-kinematics"],
    ] {
        let ran = bed.run(args);
        assert!(ran.stderr.contains("is a link"), "{args:?} {ran:?}");
        shows_nothing(&ran, "beside the submission");
    }
    let secret = std::fs::read_to_string(bed.path("secret/grade.json")).expect("it stays");
    assert_eq!(secret, SECRET);
}
