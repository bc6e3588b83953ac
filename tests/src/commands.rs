//! The small commands: the list of labs, new, completions, help, and names of before.

use crate::testbed::TestBed;
#[cfg(unix)]
use crate::testbed::{CommandResult, binary, files_below};

#[test]
fn labs_are_listed_from_the_binary_alone() {
    let bed = TestBed::new();
    let ran = bed.run(&[]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    for lab in [
        "00-step-response",
        "01-kinematics",
        "04-knock-with-velocity",
        "05-rppr",
        "06-typed-robots",
    ] {
        assert!(ran.stdout.contains(lab), "{ran:?}");
    }
    let ran = bed.run(&["--json"]);
    let list: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!(list["format"], 1);
    let labs = &list["labs"];
    assert_eq!(labs[1]["name"], "01-kinematics");
    assert_eq!(labs[1]["points"], 24.0);
}

#[test]
fn a_student_starts_grades_and_sees_the_warm_up_pass() {
    let bed = TestBed::new();
    let ran = bed.run(&["new", "00-step-response"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let ran = bed.run(&[
        "grade",
        "00-step-response",
        "00-step-response/submission.rhai",
    ]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains("practice: visible cases only"),
        "{ran:?}"
    );
    assert!(ran.stdout.contains("\n1 of 30 points\n"), "{ran:?}");
    // nothing of a student's work is overwritten
    let ran = bed.run(&["new", "00-step-response"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("already exists"), "{ran:?}");
    let ran = bed.run(&[
        "new",
        "00-step-response",
        "00-step-response/submission.rhai",
    ]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("is a file"), "{ran:?}");
}

/// A disk that is full after the first files: nothing stays that would stand in the way of the next try.
#[cfg(unix)]
#[test]
fn a_start_that_fails_leaves_nothing_behind() {
    let bed = TestBed::new();
    bed.write("there/notes.txt", "mine");
    for folder in ["mine", "there"] {
        // no file may have more than 4 KiB (8 blocks of 512 bytes, or 8 KiB where blocks are larger): pages do
        let script = format!(
            "trap '' XFSZ; ulimit -f 8; exec '{}' new 01-kinematics {folder}",
            binary().display()
        );
        let mut limited = std::process::Command::new("sh");
        limited.args(["-c", &script]).current_dir(bed.path("."));
        let ran: CommandResult = limited.output().expect("sh runs").into();
        assert_eq!(ran.code, Some(4), "{ran:?}");
        assert!(ran.stderr.contains("cannot be written"), "{ran:?}");
    }
    assert!(!bed.path("mine").exists());
    assert_eq!(files_below(&bed.path("there")).len(), 1);
    let ran = bed.run(&["new", "01-kinematics", "there"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
}

#[test]
fn a_folder_without_labs_is_reported() {
    let bed = TestBed::new();
    bed.write("subs/one/submission.rhai", "");
    let ran = bed.run(&["--labs", "subs"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout.starts_with("no folder in subs has a lab.toml\n"),
        "{ran:?}"
    );
}

/// A name is whole in a message that is wrapped, so that it can be copied.
#[test]
fn a_message_breaks_at_spaces_only() {
    let bed = TestBed::new();
    let path = format!("{}x.rhai", "04-knock/".repeat(12));
    let ran = bed.run(&["grade", "01-kinematics", &path]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains(&format!("`{path}`")), "{ran:?}");
}

/// A message names a file as it was typed, so that it can be opened from there.
#[test]
fn a_broken_robot_is_reported_with_its_folder() {
    let bed = TestBed::new();
    bed.write("r/arm.toml", "name = 1\n");
    let ran = bed.run(&["robot", "show", "r/arm.toml"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(ran.stderr.contains("[r/arm.toml:1:"), "{ran:?}");
}

#[test]
fn completions_name_every_command() {
    let bed = TestBed::new();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let ran = bed.run(&["completions", shell]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        for command in ["grade", "verify", "new", "robot", "scene", "log", "lab"] {
            assert!(ran.stdout.contains(command), "{shell} {command}");
        }
    }
}

#[test]
fn a_renamed_command_says_its_new_name_and_does_nothing() {
    let bed = TestBed::new();
    for (old, message) in [
        ("export", "`kinemark export` is now `kinemark log export`"),
        ("labs", "`kinemark labs` is now `kinemark`"),
        (
            "variant",
            "`kinemark variant` is now `kinemark lab variant`",
        ),
    ] {
        let ran = bed.run(&[old, "--json"]);
        assert_eq!(ran.code, Some(2), "{ran:?}");
        assert!(ran.stderr.contains(message), "{ran:?}");
        let printed: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON");
        assert_eq!(printed["error"]["code"], "cli::usage");
        assert_eq!(printed["error"]["message"], message);
    }
}

/// Each cause has a code of its own, with the exit code that docs/terminal.md lists.
#[test]
fn failures_of_one_exit_code_have_codes_of_their_own() {
    let bed = TestBed::new();
    bed.write("empty/file", "");
    bed.write("mine/submission.rhai", "");
    let taken = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = taken.local_addr().expect("its number").port().to_string();
    let cases: &[(&[&str], &str, i32)] = &[
        (&["compare", "nowhere", "empty"], "cli::no_file", 2),
        (
            &["log", "export", "nowhere.mcap", "--csv"],
            "cli::no_file",
            2,
        ),
        (&["robot", "show", "no-such"], "cli::unknown_name", 2),
        (&["grade", "no-such", "mine"], "lab::unknown_lab", 2),
        (
            &["compare", "empty", "empty", "--out", "mine"],
            "cli::exists",
            2,
        ),
        (&["compare", "empty", "empty"], "cli::no_report", 3),
        (&["view", "empty"], "cli::no_report", 3),
    ];
    for (args, code, exit) in cases {
        let ran = bed.run(&[args, &["--json"][..]].concat());
        assert_eq!(ran.code, Some(*exit), "{args:?} {ran:?}");
        let printed: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON");
        assert_eq!(printed["error"]["code"], *code, "{args:?} {ran:?}");
    }
    let good = crate::testbed::root().join("tests/submissions/01-kinematics/good/submission.rhai");
    bed.write(
        "good.rhai",
        std::fs::read_to_string(good).expect("a submission"),
    );
    let ran = bed.run(&["grade", "01-kinematics", "good.rhai", "--out", "out", "-q"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let ran = bed.run(&["view", "out", "--no-open", "--port", &port, "--json"]);
    assert!(ran.stdout.contains("\"cli::port\""), "{ran:?}");
}

#[test]
fn help_and_usage_errors_have_their_codes() {
    let bed = TestBed::new();
    assert_eq!(bed.run(&["--help"]).code, Some(0));
    let version = bed.run(&["--version"]);
    assert_eq!(version.code, Some(0));
    assert_eq!(version.stdout, bed.run(&["version"]).stdout);
    let json: serde_json::Value =
        serde_json::from_str(&bed.run(&["version", "--json"]).stdout).expect("JSON");
    assert_eq!(json["format"], 1);
    let engine = json["engine"].as_str().expect("an engine");
    assert!(version.stdout.starts_with(engine), "{version:?}");
    assert_eq!(bed.run(&["graed"]).code, Some(2));
    assert_eq!(bed.run(&["grade"]).code, Some(2));
    let ran = bed.run(&["grade", "--help"]);
    assert!(ran.stdout.contains("Examples:"), "{ran:?}");
    assert!(!bed.run(&["--help"]).stdout.contains("worker"));
}
