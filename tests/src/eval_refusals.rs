//! What `kinemark robot eval` cannot answer has its code, request by request.

use crate::eval::eval_with;
use crate::testbed::TestBed;

#[test]
fn what_cannot_be_answered_has_its_code() {
    let arm = ["RzRyRz", "--links", "0,0,1; 1,0,0; 1,0,0", "--density", "0"];
    let cases = [
        (
            &["uarm"][..],
            r#"{"op": "fk", "q": [0, 0]}"#,
            "wrong-length",
        ),
        (
            &["uarm"],
            r#"{"op": "inverse_dynamics", "q": [0,0,0,0,0], "qd": [0,0,0], "qdd": [0,0,0]}"#,
            "wrong-length",
        ),
        (
            &["uarm"],
            r#"{"op": "fk", "q": [0, 1e9, 0]}"#,
            "out-of-range",
        ),
        (
            &["uarm"],
            r#"{"op": "simulate", "q0": [0,0,1,0,0], "qd0": [0,0,0], "command": [0,0,0], "duration_s": 1, "servo_period_s": 0.001, "sample_period_s": 1, "servo": {"mode": "effort"}}"#,
            "open-loop",
        ),
        (&["rrbot"], r#"{"op": "ik", "target": {}}"#, "missing-field"),
        (&["rrbot"], r#"{"op": "ik"}"#, "missing-field"),
        (
            &["rrbot"],
            r#"{"op": "ik", "target": [1, 2, 3]}"#,
            "wrong-type",
        ),
        (
            &["rrbot"],
            r#"{"op": "ik", "target": {"positoin_m": [1, 2, 3]}}"#,
            "unknown-field",
        ),
        (
            &["rrbot"],
            r#"{"op": "ik", "target": {"position_m": [1, 2, 3], "rotaton": 1}}"#,
            "unknown-field",
        ),
        (
            &["rrbot"],
            r#"{"op": "ik", "target": {"position_m": [1, 2]}}"#,
            "wrong-length",
        ),
        (
            &["rrbot"],
            r#"{"op": "ik", "target": {"rotation": [[1,0,0],[0,1,0],[0,0,-1]]}}"#,
            "out-of-range",
        ),
        (
            &["rrbot"],
            r#"{"op": "ik", "target": {"position_m": [1, 2, 3]}, "in": "tcp"}"#,
            "out-of-range",
        ),
        (
            &["rrbot"],
            r#"{"op": "ik", "target": {"position_m": [1, 2, 3]}, "chain": ["sholder"]}"#,
            "unknown-joint",
        ),
        (
            &["rrbot"],
            r#"{"op": "ik", "target": {"position_m": [1, 2, 3]}, "method": "newton"}"#,
            "out-of-range",
        ),
        (
            &["rrbot"],
            r#"{"op": "ik", "target": {"position_m": [1, 2, 3]}, "damping": 0.1}"#,
            "out-of-range",
        ),
        (
            &["rrbot"],
            r#"{"op": "ik", "target": {"position_m": [1, 2, 3]}, "max_iterations": 1.5}"#,
            "out-of-range",
        ),
        (
            &["rrbot"],
            r#"{"op": "ik", "target": {"position_m": [1, 2, 3]}, "max_iterations": 1000000000}"#,
            "too-large",
        ),
        (
            &["rrbot"],
            r#"{"op": "ik", "targets": []}"#,
            "missing-field",
        ),
        (
            &["rrbot"],
            r#"{"op": "ik", "targets": [], "frame": "tcp"}"#,
            "unknown-field",
        ),
        (
            &["rrbot"],
            r#"{"op": "manipulability", "q": [0, 0], "rows": [0, 6]}"#,
            "out-of-range",
        ),
        (
            &["rrbot"],
            r#"{"op": "manipulability", "q": [0, 0], "rows": "liner"}"#,
            "out-of-range",
        ),
        (&arm, r#"{"op": "com", "q": [0, 0, 0]}"#, "no-mass"),
    ];
    for (robot, request, code) in cases {
        let (answers, exit) = eval_with(&TestBed::new(), robot, &[request.to_owned()]);
        assert_eq!(
            answers[0]["error"]["code"], code,
            "{request}: {}",
            answers[0]
        );
        assert_eq!(exit, Some(1));
    }
    let (answers, _) = eval_with(
        &TestBed::new(),
        &["uarm"],
        &[r#"{"op": "fk", "q": [0, 0]}"#.to_owned()],
    );
    let message = answers[0]["error"]["message"].as_str().expect("message");
    assert!(
        message.contains("5 joints that move, 3 of them independent (turn, crank, lower_arm)"),
        "{message}"
    );
}

/// A four-bar whose crank is longer than its loop can follow.
pub(crate) const FOUR_BAR: &str = r#"
format = 1
name = "four-bar"

[[links]]
name = "ground"
[[links]]
name = "crank"
inertia = { mass_kg = 1, tensor_kg_m2 = [0.01, 0.01, 0.01, 0, 0, 0] }
[[links]]
name = "rod"
inertia = { mass_kg = 1, tensor_kg_m2 = [0.01, 0.01, 0.01, 0, 0, 0] }
[[links]]
name = "rocker"
inertia = { mass_kg = 1, tensor_kg_m2 = [0.01, 0.01, 0.01, 0, 0, 0] }

[[joints]]
name = "crank"
type = "continuous"
parent = "ground"
child = "crank"
origin = { rpy_deg = [0, 0, 90] }
axis = [0, 0, 1]
[[joints]]
name = "rod"
type = "continuous"
parent = "crank"
child = "rod"
origin = { xyz_m = [1, 0, 0], rpy_deg = [0, 0, -90] }
axis = [0, 0, 1]
passive = true
[[joints]]
name = "rocker"
type = "continuous"
parent = "ground"
child = "rocker"
origin = { xyz_m = [1.2, 0, 0], rpy_deg = [0, 0, 90] }
axis = [0, 0, 1]
passive = true

[[loops]]
type = "revolute"
links = ["rod", "rocker"]
frame_on_first = { xyz_m = [1.2, 0, 0] }
frame_on_second = { xyz_m = [0.5, 0, 0] }
"#;

#[test]
fn a_loop_that_does_not_reach_is_open() {
    let bed = TestBed::new();
    bed.write("four-bar.toml", FOUR_BAR);
    let requests = [
        r#"{"op": "fk", "q": [0.1]}"#.to_owned(),
        // the crank points back: rod and rocker together are 1.7 m, the distance is 2.2 m
        r#"{"op": "fk", "q": [1.5707963267948966]}"#.to_owned(),
    ];
    let (answers, _) = eval_with(&bed, &["four-bar.toml"], &requests);
    assert!(answers[0].get("error").is_none(), "{}", answers[0]);
    let code = answers[1]["error"]["code"].as_str().expect("a code");
    assert!(["open-loop", "singular"].contains(&code), "{}", answers[1]);
}
