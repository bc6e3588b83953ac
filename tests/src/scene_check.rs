//! `kinemark scene check`: what it says of scenes and labs, in words and as JSON, and its exit codes.

use serde_json::Value;

use crate::testbed::{CommandResult, TestBed};

/// Finds nothing wrong with itself, but for what a test makes of it.
const SCENE: &str = r#"format = 1
name = "bench"

[environment]
ground = { friction = 0.4 }

[[bodies]]
name = "table"
type = "fixed"
origin = { xyz_m = [1.0, 0.05, 0.5] }
shapes = [{ box = { size_m = [0.4, 0.4, 1.0] } }]
contact = { friction = 0.4 }

[[bodies]]
name = "box"
type = "free"
origin = { xyz_m = [1.0, 0.05, 1.05] }
shapes = [{ box = { size_m = [0.1, 0.1, 0.1] } }]
inertia = { mass_kg = 0.5 }
contact = { friction = 0.4 }
"#;

const LAB: &str = r#"
format = 1
name = "90-bench"
title = "Bench"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "point"
title = "Point at it"

[tasks.motion]
mode = "position"
scene = "bench"
duration_s = 3.0
goals = [{ position_m = [1.4, 0.5, 0.05], dwell_s = 0.2 }, { position_m = [2.0, 1.5, 0.05], dwell_s = 0.2 }]

[[tasks.checks]]
name = "there"
title = "The tip is there"
points = 2.0
pose-reached = { full_m = 0.02, zero_m = 0.1 }
"#;

fn checked(ran: &CommandResult, code: i32) -> Value {
    assert_eq!(ran.code, Some(code), "{ran:?}");
    serde_json::from_str(&ran.stdout).expect("JSON")
}

#[test]
fn a_valid_scene_has_no_findings_and_a_sunk_box_is_reported_with_its_line() {
    let bed = TestBed::new();
    bed.write("bench.toml", SCENE);
    let ran = bed.run(&["scene", "check", "bench.toml"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert_eq!(ran.stdout, "scene bench\n\nno problems found\n");

    bed.edit("bench.toml", "0.05, 1.05]", "0.05, 1.03]");
    let ran = bed.run(&["scene", "check", "bench.toml"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let expected = "error    `table` and `box` overlap by 20.0 mm  (bench.toml:15)\n";
    assert!(ran.stdout.contains(expected), "{ran:?}");
    let record = checked(&bed.run(&["scene", "check", "bench.toml", "--json"]), 1);
    assert_eq!(record["scene"], "bench");
    let overlap = &record["findings"][0];
    assert_eq!(overlap["severity"], "error");
    assert_eq!(overlap["kind"], "overlap");
    assert_eq!(overlap["parties"], serde_json::json!(["table", "box"]));
    assert_eq!(overlap["line"], 15);
    let depth_m = overlap["depth_m"].as_f64().expect("a number");
    assert!((depth_m - 0.02).abs() < 1e-6, "{depth_m}");

    // a warning does not fail a script
    bed.edit("bench.toml", "0.05, 1.03]", "0.05, 1.08]");
    let ran = bed.run(&["scene", "check", "bench.toml"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout
            .contains("warning  `box` does not stay where it is put: it ends 30.0 mm away"),
        "{ran:?}"
    );
    assert!(ran.stdout.ends_with("\n1 warning\n"), "{ran:?}");
}

#[test]
fn via_points_are_given_in_the_frame_of_the_robot() {
    let bed = TestBed::new();
    bed.write("bench.toml", SCENE);
    let ran = bed.run(&[
        "scene",
        "check",
        "bench.toml",
        "--robot",
        "rrbot",
        "--start",
        "0.1,-0.1",
        "--via",
        "0.5,1.0,0.05; 2.0,3.5,0.05",
    ]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    for expected in [
        "scene bench with robot rrbot\n",
        "via point 1 (0.5, 1, 0.05): link `forearm` and `table` overlap by 0.",
        "via point 2 (2, 3.5, 0.05) is out of reach by 1.500 m\n",
        "\n2 errors\n",
    ] {
        assert!(ran.stdout.contains(expected), "{expected} {ran:?}");
    }
    // the same point in world coordinates: the robot's first link is there
    let record = checked(
        &bed.run(&[
            "scene",
            "check",
            "bench.toml",
            "--robot",
            "rrbot",
            "--frame",
            "base",
            "--via",
            "3.5,0.05,2",
            "--json",
        ]),
        1,
    );
    assert_eq!(record["frame"], "base");
    let residual_m = record["findings"][0]["residual_m"].as_f64();
    assert!(
        (residual_m.expect("a number") - 1.5).abs() < 1e-4,
        "{record}"
    );
    assert_eq!(record["findings"][0]["point"], 1);
}

#[test]
fn a_lab_is_checked_with_its_robot_starts_and_goals() {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write("labs/scenes/bench.toml", SCENE);
    bed.write("labs/90-bench/lab.toml", LAB);
    for named in ["90-bench", "labs/90-bench", "labs/90-bench/lab.toml"] {
        let record = checked(&bed.run(&["scene", "check", named, "--json"]), 0);
        assert_eq!(record["lab"], "90-bench");
        assert_eq!(record["scenes"][0]["task"], "point");
        assert_eq!(record["scenes"][0]["robot"], "rrbot");
        let findings = record["scenes"][0]["findings"].as_array().expect("a list");
        assert!(
            findings.iter().all(|f| f["severity"] != "error"),
            "{record}"
        );
    }
    bed.edit(
        "labs/90-bench/lab.toml",
        "[2.0, 1.5, 0.05]",
        "[0.5, 1.0, 0.05]",
    );
    let ran = bed.run(&["scene", "check", "90-bench"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout
            .starts_with("task point: scene bench with robot rrbot\n"),
        "{ran:?}"
    );
    assert!(
        ran.stdout
            .contains("error    goal 2 (0.5, 1, 0.05): link `forearm`"),
        "{ran:?}"
    );
}

#[test]
fn what_cannot_be_checked_has_its_code_and_a_way_out() {
    let bed = TestBed::new();
    bed.write("bench.toml", SCENE);
    bed.write("broken.toml", "format = 1\nname = \"x\"\nboddies = []\n");
    let cases: [(&[&str], i32, &str); 13] = [
        (&["shelf-and-cann"], 2, "did you mean `shelf-and-can`?"),
        (&["bensh.toml"], 2, "did you mean `./bench.toml`?"),
        (&["broken.toml"], 3, "boddies"),
        (
            &["01-kinematics"],
            2,
            "no motion task of lab `01-kinematics` has a scene",
        ),
        (&["bench.toml", "--via", "1,2,3"], 2, "--robot"),
        (&["bench.toml", "--balance"], 2, "--robot ROBOT"),
        (
            &["03-knock-with-position", "--ignore-mimic"],
            2,
            "leave out --robot and its options",
        ),
        (
            &["bench.toml", "--robot", "rrbot", "--accept-unphysical"],
            2,
            "--accept-unphysical is for URDFs",
        ),
        (
            &["bench.toml", "--robot", "rrbott"],
            2,
            "did you mean `rrbot`?",
        ),
        (
            &["bench.toml", "--robot", "rrbot", "--start", "1"],
            2,
            "shoulder, elbow",
        ),
        (
            &["bench.toml", "--robot", "rrbot", "--start", "1,x"],
            2,
            "`x` in --start",
        ),
        (
            &["bench.toml", "--robot", "rrbot", "--via", "1,2"],
            2,
            "via point 1 has 2 numbers",
        ),
        (
            &["bench.toml", "--robot", "rrbot", "--frame", "lap"],
            2,
            "did you mean `lab`?",
        ),
    ];
    for (args, code, expected) in cases {
        let all = [&["scene", "check"], args].concat();
        let ran = bed.run(&all);
        assert_eq!(ran.code, Some(code), "{args:?} {ran:?}");
        assert!(ran.stderr.contains(expected), "{args:?} {ran:?}");
        assert!(ran.stdout.is_empty(), "{args:?} {ran:?}");
    }
}

/// Files that would cost minutes: too many shapes are refused, by `scene check` and with a lab; too many overlaps are not simulated.
#[test]
fn what_would_be_too_much_work_is_refused_or_reported() {
    let bed = TestBed::new();
    let shape = "  { box = { size_m = [0.4, 0.4, 1.0] } },\n";
    let many = SCENE.replace(
        "shapes = [{ box = { size_m = [0.4, 0.4, 1.0] } }]",
        &format!("shapes = [\n{}]", shape.repeat(2000)),
    );
    bed.write("bench.toml", &many);
    bed.copy_labs();
    bed.write("labs/scenes/bench.toml", &many);
    bed.write("labs/90-bench/lab.toml", LAB);
    bed.write("mine.rhai", "fn control(o) { [0.0, 0.0] }");
    for args in [
        &["scene", "check", "bench.toml"][..],
        &["scene", "check", "90-bench"],
        &["grade", "90-bench", "mine.rhai", "--practice"],
    ] {
        let ran = bed.run(args);
        assert_eq!(ran.code, Some(3), "{ran:?}");
        for words in [
            "2001 shapes are more than a scene may have (2000)",
            "bench.toml:2019:",
            "one too many",
            "fewer shapes",
        ] {
            assert!(ran.stderr.contains(words), "{words} {ran:?}");
        }
    }
    let (head, box_) = SCENE.rsplit_once("[[bodies]]").expect("a body");
    let boxes: String = (0..46)
        .map(|i| {
            format!(
                "[[bodies]]{}",
                box_.replace("\"box\"", &format!("\"box{i}\""))
            )
        })
        .collect();
    bed.write("bench.toml", format!("{head}{boxes}"));
    let ran = bed.run(&["scene", "check", "bench.toml", "--json"]);
    let record = checked(&ran, 1);
    let findings = record["findings"].as_array().expect("findings");
    let last = findings.last().expect("a finding");
    assert_eq!(last["kind"], "not-checked");
    assert_eq!(
        (&last["severity"], &last["stage"]),
        (&"warning".into(), &"settling".into())
    );
}
