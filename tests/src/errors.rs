//! Mistakes in files and on the command line: each has a message with its position, and the documented exit code.

use crate::golden::reads;
use crate::testbed::TestBed;

fn bed() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write(
        "submission.rhai",
        "fn control(observation) { [0.5, 0.0] }\n",
    );
    bed
}

const GRADE: [&str; 3] = ["grade", "01-kinematics", "submission.rhai"];

#[test]
fn a_wrong_path_names_the_near_file() {
    let ran = bed().run(&["grade", "01-kinematics", "submision.rhai"]);
    assert_eq!(ran.code, Some(2));
    assert!(
        ran.stderr.contains("there is no file `submision.rhai`"),
        "{ran:?}"
    );
    assert!(
        ran.stderr.contains("did you mean `./submission.rhai`?"),
        "{ran:?}"
    );
    let ran = bed().run(&["grade", "01-kinematiks", "submission.rhai"]);
    assert_eq!(ran.code, Some(2));
    assert!(
        ran.stderr.contains("did you mean `01-kinematics`?"),
        "{ran:?}"
    );
    // a folder is looked through, and one without a submission is graded as such
    let ran = bed().run(&["grade", "01-kinematics", "labs"]);
    assert_eq!(ran.code, Some(1));
    assert!(ran.stdout.contains("`labs`: "), "{ran:?}");
}

/// What is changed in which file, and what the message must say, caret and all.
#[test]
fn typos_in_lab_and_robot_are_shown_at_their_place() {
    let lab = "labs/01-kinematics/lab.toml";
    let robot = "labs/robots/rrbot.toml";
    let hidden = "reference/01-kinematics/hidden.toml";
    let mutants = "reference/01-kinematics/mutants.toml";
    let cases = [
        (
            lab,
            "duration_s = 8.0",
            "duraton_s = 3.0",
            "unknown key `duraton_s`",
            "did you mean `duration_s`?",
        ),
        (
            lab,
            "duration_s = 8.0",
            "duration_s = \"3\"",
            "expected a number",
            "lab.toml:116:14",
        ),
        (
            lab,
            "frame = \"lab\"",
            "frame = \"lob\"",
            "no frame `lob`",
            "did you mean `lab`?",
        ),
        (
            lab,
            "robot = \"rrbot\"",
            "robot = \"rrbott\"",
            "no robot file",
            "did you mean `rrbot`?",
        ),
        (
            lab,
            "control_period_ms = 10.0",
            "control_period_ms = 10.5",
            "not an integer multiple",
            "lab.toml:117",
        ),
        (
            lab,
            "needs = [\"reach\"]",
            "needs = [\"raech\"]",
            "no earlier check",
            "did you mean `reach`?",
        ),
        (
            lab,
            "full_m = 1e-4, zero_m = 5e-3",
            "full_m = 1e-2, zero_m = 5e-3",
            "a band needs",
            "this band",
        ),
        (
            lab,
            "q_rad = [0.7, -1.1]",
            "q_rad = [0.7]",
            "1 number for 2 joints",
            "shoulder, elbow",
        ),
        (
            lab,
            "[parameters]",
            "[paramaters]",
            "unknown key `paramaters`",
            "did you mean `parameters`?",
        ),
        (
            lab,
            "call = \"forward_kinematics\"",
            "call = \"forward_kinematic\"",
            "no built-in task function is called `forward_kinematic`",
            "did you mean `forward_kinematics`?",
        ),
        (
            lab,
            "duration_s = 8.0",
            "duration_s = 1e9",
            "more than 900000 physics steps",
            "write 900 s at most",
        ),
        (
            lab,
            "duration_s = 8.0",
            "duration_s = 3,5",
            "a comma in a number",
            "write 3.5: a decimal has a point",
        ),
        (
            lab,
            "points = 1.0",
            "points = -1.0",
            "more than 0 and at most 1000 points",
            "points are earned, never taken away",
        ),
        (
            "labs/01-kinematics/practice.json",
            "\"points_m\"",
            "\"point_m\"",
            "unknown key `point_m`",
            "did you mean `points_m`?",
        ),
        (
            "labs/01-kinematics/practice.json",
            "\"period_s\":0.02",
            "\"period_s\":0,02",
            "01-kinematics/practice.json:1:",
            "kinemark lab fill",
        ),
        (
            robot,
            "axis = [0.0, 1.0, 0.0]",
            "axis = \"y\"",
            "expected a list of 3",
            "write three numbers, such as [0, 0, 1]",
        ),
        (
            robot,
            "damping = 0.7 ",
            "dampnig = 0.7 ",
            "unknown key `dampnig`",
            "did you mean `damping`?",
        ),
        (
            robot,
            "mass_kg = 1.0",
            "mass_kg = -1.0",
            "must be zero or more, got -1",
            "rrbot.toml:14",
        ),
        (
            robot,
            "\"base_height / 2\"",
            "\"base_hieght / 2\"",
            "no dimension is called `base_hieght`",
            "did you mean `base_height`?",
        ),
        (
            robot,
            "link = \"forearm\"",
            "link = \"forarm\"",
            "no link is called `forarm`",
            "did you mean `forearm`?",
        ),
        (
            hidden,
            "task = \"fk\"",
            "task = \"kf\"",
            "no task `kf`",
            "did you mean `fk`?",
        ),
        (
            hidden,
            "count = 8",
            "cuont = 8",
            "unknown key `cuont`",
            "did you mean `count`?",
        ),
        (
            hidden,
            "count = 8",
            "count = 0",
            "1 to 1000 cases, got 0",
            "hidden.toml:8:9]",
        ),
        (
            hidden,
            "base_height =",
            "base_hieght =",
            "no dimension `base_hieght` in this robot",
            "did you mean `base_height`?",
        ),
        (
            hidden,
            "base_height =",
            "base_hieght =",
            "not a dimension of this robot",
            "hidden.toml:23:16]",
        ),
        (
            hidden,
            "{ base_height = [1.2, 2.6],",
            "{ base_height = [[1.2, 2.6]],",
            "dimension `base_height`",
            "hidden.toml:23:30]",
        ),
        (
            lab,
            "name = \"elbow a quarter turn\"",
            "name = \"straight up\"",
            "case `straight up` is defined twice",
            "give each its own name",
        ),
        (
            mutants,
            "name = \"absolute-elbow\"",
            "name = \"degrees\"",
            "mutant `degrees` is defined twice",
            "mutants.toml:10:8]",
        ),
        (
            mutants,
            "says = \"Angles are treated as degrees. They are radians here: a right angle is pi / 2.\"",
            "says = \"\"",
            "mutant `degrees` says nothing",
            "write what the student reads",
        ),
        (
            mutants,
            "tasks = [\"fk\", \"ik\"]",
            "tasks = []",
            "mutant `degrees` names no task",
            "such as tasks = [\"move\"]",
        ),
    ];
    for (file, from, to, message, place) in cases {
        let bed = bed();
        bed.edit(file, from, to);
        let ran = bed.run(&GRADE);
        assert_eq!(ran.code, Some(3), "{to}: {ran:?}");
        for part in [message, place] {
            // the report may break a line between words
            let plain = ran.stderr.replace("\n  │", "").replace("\n", " ");
            assert!(plain.contains(part), "{to}: no {part:?} in\n{}", ran.stderr);
        }
        assert!(!bed.path("out").exists());
    }
}

#[test]
fn a_scene_of_a_lab_is_wrong_at_its_own_key() {
    let lab = "labs/03-knock-with-position/lab.toml";
    for (from, to, label, help) in [
        (
            "name = \"shelf-and-can\"",
            "name = \"shelf-and-cans\"",
            "no such scene",
            "did you mean `shelf-and-can`?",
        ),
        (
            "shelf_at =",
            "shelf_att =",
            "not a dimension of this scene",
            "did you mean `shelf_at`?",
        ),
    ] {
        let bed = bed();
        bed.edit(lab, from, to);
        let ran = bed.run(&["grade", "03-knock-with-position", "submission.rhai"]);
        assert_eq!(ran.code, Some(3), "{ran:?}");
        let text = std::fs::read_to_string(bed.path(lab)).expect("a lab");
        let line = text.lines().position(|line| line.contains(to));
        let place = format!("lab.toml:{}:", line.expect("the line") + 1);
        for part in [place.as_str(), label, help] {
            assert!(ran.stderr.contains(part), "{part}: {}", ran.stderr);
        }
    }
}

#[test]
fn a_broken_lab_takes_no_other_off_the_list() {
    let bed = bed();
    bed.edit(
        "labs/03-knock-with-position/lab.toml",
        "points = 6.0",
        "pionts = 6.0",
    );
    let ran = bed.run(&[]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(ran.stdout.contains("04-knock-with-velocity"), "{ran:?}");
    assert!(!ran.stdout.contains("03-knock-with-position"), "{ran:?}");
    assert!(ran.stderr.contains("unknown key `pionts`"), "{ran:?}");
    let ran = bed.run(&["--json"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    let list: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!(list["labs"].as_array().map(Vec::len), Some(6));
    assert_eq!(list["broken"][0]["code"], "lab::toml");
}

#[test]
fn a_failure_is_one_value_for_programs_and_words_for_people() {
    let bed = bed();
    bed.edit(
        "labs/00-step-response/lab.toml",
        "joint = \"shoulder\"",
        "joint = \"sholder\"",
    );
    let grade = ["grade", "00-step-response", "submission.rhai"];
    let words = bed.run(&grade);
    let ran = bed.run(&[&grade[..], &["--json"]].concat());
    assert_eq!((ran.code, words.code), (Some(3), Some(3)), "{ran:?}");
    assert_eq!(ran.stderr, words.stderr);
    let printed: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!(printed["format"], 1);
    let error = &printed["error"];
    assert_eq!(error["code"], "lab::unknown_joint", "{error}");
    let message = error["message"].as_str().expect("a message");
    assert!(words.stderr.contains(message), "{error}");
    assert!(error["help"].is_string(), "{error}");
    let file = std::fs::read_to_string(bed.path("labs/00-step-response/lab.toml"));
    let file = file.expect("a lab");
    let span = &error["span"];
    let number = |name: &str| span[name].as_u64().expect("a number") as usize;
    let line = file.lines().nth(number("line") - 1).expect("a line");
    let meant: String = line.chars().skip(number("column") - 1).collect();
    assert_eq!(
        meant.chars().take(number("length")).collect::<String>(),
        "\"sholder\""
    );
    for (args, code) in [
        (&["grade", "--no-such", "--json"][..], "cli::unknown_option"),
        (&["graed", "--json"], "cli::unknown_command"),
    ] {
        let ran = bed.run(args);
        assert_eq!(ran.code, Some(2), "{ran:?}");
        let printed: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON");
        assert_eq!(printed["error"]["code"], code);
    }
}

#[test]
fn an_empty_salt_is_reported_where_it_stands() {
    let bed = bed();
    let output = bed.command(&GRADE).env("KINEMARK_SALT", "").output();
    let stderr = String::from_utf8_lossy(&output.expect("the binary runs").stderr).into_owned();
    assert!(stderr.contains("unset KINEMARK_SALT"), "{stderr}");
    let ran = bed.run(&[&GRADE[..], &["--salt", ""]].concat());
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("leave --salt out"), "{ran:?}");
}

#[test]
fn a_message_reads_like_this() {
    let bed = bed();
    bed.edit(
        "labs/00-step-response/lab.toml",
        "joint = \"shoulder\"",
        "joint = \"sholder\"",
    );
    let ran = bed.run(&["grade", "00-step-response", "submission.rhai"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    for part in ["no joint `sholder`", "did you mean `shoulder`?"] {
        assert!(ran.stderr.contains(part), "{part}: {}", ran.stderr);
    }
    reads("a_message_reads_like_this", &ran.stderr);
}

#[test]
fn files_that_are_no_submission_are_refused_or_judged() {
    let bed = bed();
    let grade = |name: &str| bed.run(&["grade", "01-kinematics", name, "--out", "o"]);
    // an empty file is a program without functions: nothing is earned, and every function is named
    bed.write("empty.rhai", "");
    let ran = grade("empty.rhai");
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains("no function `control(observation)`"),
        "{ran:?}"
    );
    assert!(ran.stdout.contains("0 of 24 points"), "{ran:?}");
    bed.write("binary.rhai", [0x7e, b'E', b'L', b'F', 0xff, 0xfe, 0]);
    let ran = grade("binary.rhai");
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let words = "the file is not UTF-8 text: byte 0xff";
    assert!(ran.stdout.contains(words), "{ran:?}");
    bed.write("large.rhai", " ".repeat(100_000_000));
    let ran = grade("large.rhai");
    assert_eq!(ran.code, Some(2), "{ran:?}");
    for words in [
        "more than 1048576 bytes",
        "a submission has at most 1048576 bytes: is it the right file?",
    ] {
        let plain = ran.stderr.replace("\n  │", "").replace("\n        ", " ");
        assert!(plain.contains(words), "{ran:?}");
    }
    assert!(!ran.stderr.contains("UTF-8"), "{ran:?}");
    bed.write("debug.wasm", "\0asm".repeat(1_000_000));
    let ran = grade("debug.wasm");
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("`--release` in Rust"), "{ran:?}");
    bed.write("lab.toml", "points = 1.0");
    let ran = grade("lab.toml");
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr
            .contains("is a TOML file, not a submission (.rhai)"),
        "{ran:?}"
    );
    // longer than its budget, but no trouble to read: judged
    bed.write("long.rhai", format!("// {}\n", "x".repeat(70_000)));
    let ran = grade("long.rhai");
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains("more than 65536 bytes of source"),
        "{ran:?}"
    );
}

#[cfg(unix)]
#[test]
fn a_pipe_as_submission_is_refused_and_does_not_wait() {
    let bed = bed();
    let made = std::process::Command::new("mkfifo")
        .arg(bed.path("pipe.rhai"))
        .status();
    assert!(made.expect("mkfifo").success());
    for args in [
        &["grade", "01-kinematics", "pipe.rhai"][..],
        &["robot", "eval", "pipe.rhai"],
    ] {
        let ran = bed.run(args);
        assert_eq!(ran.code, Some(2), "{ran:?}");
        assert!(ran.stderr.contains("is a pipe or a device"), "{ran:?}");
    }
}
