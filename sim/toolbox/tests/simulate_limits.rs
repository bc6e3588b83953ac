//! `simulate` at the limits of its periods: what it reports where they do not resolve a motion, and why a run diverged.

use kinemark_sim::model::robot::Robot;
use serde_json::{Value, json};

use crate::{ask, numbers, robot_of, uarm};

/// Two bars of 1 m and 0.5 kg that hang and swing without friction.
fn two_bars() -> Robot {
    robot_of(
        "format = 1\nname = 'two bars'\n[[links]]\nname = 'base'\n\
         [[links]]\nname = 'u'\ninertia = { mass_kg = 0.5, com_m = [0, 0, -0.5], tensor_kg_m2 = [0.04, 0.04, 0.0004, 0, 0, 0] }\n\
         [[links]]\nname = 'f'\ninertia = { mass_kg = 0.5, com_m = [0, 0, -0.5], tensor_kg_m2 = [0.04, 0.04, 0.0004, 0, 0, 0] }\n\
         [[joints]]\nname = 'j0'\ntype = 'continuous'\nparent = 'base'\nchild = 'u'\naxis = [0, 1, 0]\n\
         [[joints]]\nname = 'j1'\ntype = 'continuous'\nparent = 'u'\nchild = 'f'\norigin = { xyz_m = [0, 0, -1] }\naxis = [0, 1, 0]\n",
    )
}

/// The arm of the course without limits, which would hold what runs away.
fn rrbot() -> Robot {
    let path = format!(
        "{}/../../labs/robots/rrbot.toml",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(&path).expect(&path);
    let lines = text.lines().filter(|line| !line.starts_with("limit"));
    robot_of(&lines.collect::<Vec<_>>().join("\n"))
}

/// A wheel that alone turns as fast as it likes.
fn wheel() -> Robot {
    robot_of(
        "format = 1\nname = 'wheel'\n[[links]]\nname = 'base'\n\
         [[links]]\nname = 'rim'\ninertia = { mass_kg = 0.5, com_m = [0, 0, 0], tensor_kg_m2 = [0.01, 0.02, 0.01, 0, 0, 0] }\n\
         [[joints]]\nname = 'axle'\ntype = 'continuous'\nparent = 'base'\nchild = 'rim'\naxis = [0, 1, 0]\n",
    )
}

fn swing(robot: &Robot, q0: Value, qd0: Value, step_s: f64) -> Value {
    swing_for(1, robot, q0, qd0, step_s)
}

fn swing_for(duration_s: u8, robot: &Robot, q0: Value, qd0: Value, step_s: f64) -> Value {
    let n = robot.n();
    ask(
        robot,
        &json!({ "op": "simulate", "q0": q0, "qd0": qd0, "command": vec![0.0; n], "duration_s": duration_s, "servo_period_s": step_s,
            "physics_step_s": step_s, "sample_period_s": 1, "servo": { "mode": "effort" } }),
    )
}

fn held(kp: f64, kd: f64, servo_s: f64) -> Value {
    ask(
        &rrbot(),
        &json!({ "op": "simulate", "q0": [0, 0], "qd0": [0, 0], "command": [0.5, 0.2], "duration_s": 1, "servo_period_s": servo_s,
            "physics_step_s": 0.001, "sample_period_s": 1, "servo": { "mode": "position", "kp": kp, "kd": kd } }),
    )
}

/// The joints that are reported, with the words of the first event.
fn unresolved(answer: &Value) -> (Vec<String>, String) {
    let events = answer["events"].as_array().cloned().unwrap_or_default();
    let text = |event: &Value, key: &str| event[key].as_str().unwrap_or_default().to_owned();
    for event in &events {
        assert_eq!(event["event"], "under-resolved", "{event}");
        assert!(event["t_s"].is_number());
    }
    (
        events.iter().map(|event| text(event, "joint")).collect(),
        events
            .first()
            .map_or_else(String::new, |event| text(event, "message")),
    )
}

#[test]
fn fast_spin_is_reported_where_it_loses_energy_and_not_before() {
    for (rate, expected) in [(10.0, 0), (100.0, 0), (300.0, 2), (1000.0, 2)] {
        let answer = swing(&two_bars(), json!([1, 0.5]), json!([rate, -rate]), 0.001);
        let (joints, message) = unresolved(&answer);
        assert_eq!(joints.len(), expected, "{rate}: {answer}");
        if expected > 0 {
            assert!(
                message.contains("moves too fast for the physics step"),
                "{message}"
            );
        }
    }
    // nothing is lost by a wheel that turns alone, however fast
    let answer = swing(&wheel(), json!([0]), json!([3000]), 0.001);
    assert!(unresolved(&answer).0.is_empty(), "{answer}");
    assert!((numbers(&answer["qd"])[1] - 3000.0).abs() < 1e-9);
}

#[test]
fn a_long_step_is_reported_where_the_motion_suffers() {
    for (step_s, expected) in [(0.01, 0), (0.05, 0), (0.1, 2), (0.2, 2)] {
        let answer = swing(&two_bars(), json!([1, 0.5]), json!([0, 0]), step_s);
        assert_eq!(unresolved(&answer).0.len(), expected, "{step_s}: {answer}");
    }
}

#[test]
fn a_servo_that_kicks_and_a_period_that_is_too_long_are_reported() {
    let (joints, message) = unresolved(&held(10_000.0, 100.0, 0.001));
    assert_eq!(joints, ["elbow", "elbow", "shoulder"]);
    assert!(
        message.starts_with(
            "the servo of `elbow` is unstable: its gains need a servo period below 0.6"
        ),
        "{message}"
    );
    for (kp, kd) in [(100.0, 10.0), (0.0, 0.0), (5.0, 0.5)] {
        // the last two are too weak to hold the arm up, which no shorter period mends
        let answer = held(kp, kd, 0.001);
        assert!(unresolved(&answer).0.is_empty(), "{kp}: {answer}");
    }
    let (joints, message) = unresolved(&held(100.0, 10.0, 0.008));
    assert_eq!(
        joints.first().map(String::as_str),
        Some("elbow"),
        "{message}"
    );
}

#[test]
fn a_divergence_names_its_joint_and_its_cause() {
    let message = |answer: &Value| {
        assert_eq!(answer["error"]["code"], "diverged", "{answer}");
        answer["error"]["message"]
            .as_str()
            .unwrap_or_default()
            .to_owned()
    };
    let began = message(&swing(
        &two_bars(),
        json!([1, 0.5]),
        json!([1e4, -1e4]),
        0.001,
    ));
    assert!(
        began.starts_with("the robot's kinetic energy began at"),
        "{began}"
    );
    assert!(
        began.ends_with("the physics step of 1 ms is too long for the motion of `j0`, which moves by 10 rad in a step"),
        "{began}"
    );
    let long = message(&swing_for(
        2,
        &two_bars(),
        json!([1, 0.5]),
        json!([0, 0]),
        0.5,
    ));
    assert!(
        long.starts_with("the robot's kinetic energy grew to"),
        "{long}"
    );
    assert!(
        long.contains("the physics step of 500 ms is too long for the motion of `j"),
        "{long}"
    );
    let gains = message(&held(1e6, 1e4, 0.001));
    assert!(
        gains.contains("its servo makes each error") && gains.contains("`elbow`"),
        "{gains}"
    );
}

#[test]
fn commands_are_of_all_joints_or_of_the_independent_ones() {
    let request = |commands: Value| {
        json!({ "op": "simulate", "q0": [0, 0, 0], "qd0": [0, 0, 0], "commands": commands, "command_period_s": 0.05,
            "duration_s": 0.1, "servo_period_s": 0.001, "sample_period_s": 0.1, "servo": { "mode": "position", "kp": 1, "kd": 0.05 } })
    };
    let some = ask(&uarm(), &request(json!([[0.1, 0.2, 0.1], [0, 0, 0]])));
    assert!(some["error"].is_null(), "{some}");
    // turn, crank, coupler, lower arm, forearm: the independent ones are named by `info`
    let all = ask(&uarm(), &json!({ "op": "info" }));
    let independent = all["independent"].as_array().expect("names").clone();
    let whole = |values: [f64; 3]| -> Vec<f64> {
        let joints = all["joints"].as_array().expect("joints").iter();
        joints
            .map(|joint| {
                let at = independent.iter().position(|name| *name == joint["name"]);
                at.map_or(0.0, |at| values[at])
            })
            .collect()
    };
    let rows = json!([whole([0.1, 0.2, 0.1]), whole([0.0; 3])]);
    assert_eq!(some["q"], ask(&uarm(), &request(rows))["q"]);
    let wrong = ask(&uarm(), &request(json!([[0.1, 0.2, 0.1], [0, 0]])));
    assert_eq!(
        wrong["error"]["message"],
        "`commands[1]` has 2 numbers, expected 3 (independent joints) or 5"
    );
}
