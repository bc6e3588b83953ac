//! What cannot be answered: code and message, word by word.

use kinemark_toolbox::eval::{OPERATIONS, Subject, answer_line, operation_names};
use serde_json::{Value, json};

use crate::{ask, robot_of, rrbot, uarm};

/// Code and message of the refusal of a line.
fn refusal(line: &str) -> (String, String) {
    let robot = rrbot();
    let subject = Subject {
        robot: &robot,
        scene: None,
    };
    let answer = answer_line(subject, line.as_bytes());
    let error = answer
        .get("error")
        .unwrap_or_else(|| panic!("{line}: {answer:?}"));
    let text = |name: &str| error[name].as_str().unwrap_or_default().to_owned();
    (text("code"), text("message"))
}

#[test]
fn a_refusal_names_the_field_and_what_it_must_be() {
    let servo = r#""q0": [0,0], "qd0": [0,0], "duration_s": 1, "servo_period_s": 0.001, "sample_period_s": 0.1"#;
    for (line, code, message) in [
        ("{", "bad-json", "column 1: EOF while parsing an object"),
        (
            r#"{"op": "fk" "q": [0, 0]}"#,
            "bad-json",
            "column 13: expected `,` or `}`",
        ),
        (
            r#"{"op": "fk", "q": [NaN, 0]}"#,
            "bad-json",
            "JSON has no NaN: leave the field out",
        ),
        (
            "[1]",
            "bad-request",
            r#"a request is an object, such as {"op": "info"}"#,
        ),
        (r#"{"q": [0]}"#, "missing-field", "`op` is missing"),
        (r#"{"op": 1}"#, "wrong-type", "`op` must be a string"),
        (
            r#"{"op": "fkk"}"#,
            "unknown-op",
            "no operation `fkk`; did you mean `fk`? operations: info, fk, jacobian, jacobian_derivative, manipulability, workspace, \
             ik, com, rnea, bias, gravity, coriolis, inverse_dynamics, crba, aba, energy, trajectory, simulate",
        ),
        (r#"{"op": "fk"}"#, "missing-field", "`q` is missing"),
        (
            r#"{"op": "fk", "q": null}"#,
            "missing-field",
            "`q` is missing",
        ),
        (
            r#"{"op": "fk", "Q": [0, 0]}"#,
            "missing-field",
            "`q` is missing; `Q` is not a field: did you mean `q`?",
        ),
        (
            r#"{"op": "fk", "q": [0, 0], "farme": "tcp"}"#,
            "unknown-field",
            "unknown field `farme`; did you mean `frame`? fields: id, op, q, frame, in",
        ),
        (
            r#"{"op": "fk", "q": "up"}"#,
            "wrong-type",
            "`q` must be a list of numbers, got a string",
        ),
        (
            r#"{"op": "fk", "q": [0, true]}"#,
            "wrong-type",
            "`q[1]` must be a number, got a boolean",
        ),
        (
            r#"{"op": "fk", "q": [0, null]}"#,
            "wrong-type",
            "`q[1]` must be a number, got null",
        ),
        (
            r#"{"op": "fk", "q": [0]}"#,
            "wrong-length",
            "`q` has 1 numbers, the robot has 2 joints that move",
        ),
        (
            r#"{"op": "fk", "q": [0, 0], "frame": "tpc"}"#,
            "unknown-frame",
            "no frame is called `tpc`; did you mean `tcp`? frames: base, upper, forearm, tcp, lab",
        ),
        (
            r#"{"op": "fk", "q": [0, 0], "in": 3}"#,
            "wrong-type",
            "`in` must be a string, got a number",
        ),
        (
            r#"{"op": "crba", "q": [0, 0], "gravity_m_s2": [0, 1]}"#,
            "wrong-length",
            "`gravity_m_s2` has 2 numbers, expected 3",
        ),
        (
            r#"{"op": "workspace", "samples": 1.5}"#,
            "out-of-range",
            "`samples` must be an integer, zero or more, got 1.5",
        ),
        (
            r#"{"op": "com", "q": [0, 0], "counted": "al"}"#,
            "out-of-range",
            "`counted` must be `moving` or `all`, got `al`; did you mean `all`?",
        ),
        (
            r#"{"op": "manipulability", "q": [0, 0], "rows": [0, 6]}"#,
            "out-of-range",
            "`rows` must be `all`, `linear`, `angular` or a list of different rows 0 to 5, got 6",
        ),
        (r#"{"op": "ik"}"#, "missing-field", "`target` is missing"),
        (
            r#"{"op": "ik", "target": [1, 2, 3]}"#,
            "wrong-type",
            "`target` must be an object, got a list",
        ),
        (
            r#"{"op": "ik", "target": {"positoin_m": [1, 2, 3]}}"#,
            "unknown-field",
            "unknown field `target.positoin_m`; did you mean `position_m`? fields: frame, weight, position_m, rotation, axis, direction",
        ),
        (
            r#"{"op": "ik", "targets": [{"position_m": [1, 2, 3]}, {"position_m": [1, 2]}]}"#,
            "wrong-length",
            "`targets[1].position_m` has 2 numbers, expected 3",
        ),
        (
            r#"{"op": "ik", "target": {"rotation": [[1, 0, 0], [0, 1, 0], [0, 0, -1]]}}"#,
            "out-of-range",
            "`target.rotation` is not a rotation: its rows must have length 1, be at right angles and be right-handed",
        ),
        (
            r#"{"op": "trajectory", "kind": "cubic", "from": 0, "to": 1, "duration_s": 1, "jerk": 2}"#,
            "unknown-field",
            "unknown field `jerk`; fields: id, op, kind, at_s, from, to, duration_s, from_qd, to_qd",
        ),
        (
            r#"{"op": "trajectory", "kind": "line", "from": {}, "to": {"position_m": [1, 2, 3]}}"#,
            "missing-field",
            "`from.position_m` is missing",
        ),
        (
            &format!(
                r#"{{"op": "simulate", {servo}, "command": 0, "servo": {{"mode": "torque"}}}}"#
            ),
            "out-of-range",
            "`servo.mode` must be `position`, `velocity` or `effort`, got `torque`",
        ),
        (
            &format!(
                r#"{{"op": "simulate", {servo}, "command": [0, 0], "servo": {{"mode": "effort", "effort_limit": -1}}}}"#
            ),
            "out-of-range",
            "`servo.effort_limit` must be positive, got -1",
        ),
        (
            r#"{"op": "bias", "q": [0, 0], "qd": [1e200, 0]}"#,
            "not-finite",
            "the answer is not finite: the numbers given are too large",
        ),
    ] {
        assert_eq!(
            refusal(line),
            (code.to_owned(), message.to_owned()),
            "{line}"
        );
    }
}

#[test]
fn a_count_of_joints_names_the_independent_ones() {
    let answer = ask(&uarm(), &json!({ "op": "fk", "q": [0, 0] }));
    let message = answer["error"]["message"].as_str().unwrap_or_default();
    assert_eq!(
        message,
        "`q` has 2 numbers, the robot has 5 joints that move, 3 of them independent (turn, crank, lower_arm)"
    );
}

#[test]
fn dynamics_of_a_robot_without_mass_is_refused_and_not_zero() {
    let bare = |keys: &str| {
        robot_of(&format!(
            "format = 1\nname = 'bare'\n[dh]\nconvention = 'modified'\n[[dh.rows]]\njoint = 'a'\ntype = 'revolute'\n{keys}\n"
        ))
    };
    for request in [
        json!({ "op": "rnea", "q": [0], "qd": [0], "qdd": [1] }),
        json!({ "op": "inverse_dynamics", "q": [0], "qd": [0], "qdd": [1] }),
        json!({ "op": "bias", "q": [0], "qd": [0] }),
        json!({ "op": "coriolis", "q": [0], "qd": [0] }),
        json!({ "op": "gravity", "q": [0] }),
        json!({ "op": "crba", "q": [0] }),
        json!({ "op": "energy", "q": [0], "qd": [0] }),
    ] {
        let answer = ask(&bare(""), &request);
        assert_eq!(answer["error"]["code"], "no-mass", "{request} {answer}");
        // an armature is something to move
        let answer = ask(&bare("armature = 0.5"), &request);
        assert!(answer.get("error").is_none(), "{request} {answer}");
    }
    let felt = bare("drive = { ratio = 100, rotor_inertia = 1e-4 }");
    let answer = ask(
        &felt,
        &json!({ "op": "rnea", "q": [0], "qd": [0], "qdd": [1] }),
    );
    assert!(
        (answer["effort"][0].as_f64().unwrap_or(0.0) - 1.0).abs() < 1e-12,
        "{answer}"
    );
}

#[test]
fn every_operation_is_documented() {
    let page = include_str!("../../../docs/robot-eval.md");
    for operation in OPERATIONS {
        assert!(
            page.contains(&format!("| `{}` |", operation.name)),
            "{}",
            operation.name
        );
    }
    assert!(operation_names().starts_with("info, fk, jacobian, "));
    let unknown = ask(&rrbot(), &json!({ "op": Value::Null }));
    assert_eq!(unknown["error"]["code"], "wrong-type");
}

#[test]
fn a_robot_with_a_tensor_that_no_body_can_have_answers_kinematics_and_refuses_dynamics() {
    let robot = robot_of(include_str!(
        "../../../tests/robots/peculiar/broken_triangle.urdf"
    ));
    let q = json!([0.1, 0.2]);
    for request in [
        json!({ "op": "info" }),
        json!({ "op": "fk", "q": q }),
        json!({ "op": "jacobian", "q": q }),
        json!({ "op": "jacobian_derivative", "q": q, "qd": q }),
        json!({ "op": "manipulability", "q": q }),
        json!({ "op": "workspace", "samples": 3 }),
        json!({ "op": "ik", "q0": q, "targets": [{ "frame": "lower", "position_m": [0, 0, -0.4] }] }),
        // where the masses are is another matter than how they turn
        json!({ "op": "com", "q": q }),
    ] {
        let answer = ask(&robot, &request);
        assert_eq!(answer["error"], Value::Null, "{request}");
    }
    for request in [
        json!({ "op": "rnea", "q": q, "qd": q, "qdd": q }),
        json!({ "op": "bias", "q": q, "qd": q }),
        json!({ "op": "gravity", "q": q }),
        json!({ "op": "coriolis", "q": q, "qd": q }),
        json!({ "op": "inverse_dynamics", "q": q, "qd": q, "qdd": q }),
        json!({ "op": "crba", "q": q }),
        json!({ "op": "aba", "q": q, "qd": q, "effort": q }),
        json!({ "op": "energy", "q": q, "qd": q }),
        json!({
            "op": "simulate", "q0": q, "qd0": q, "command": q, "duration_s": 1, "servo_period_s": 0.1, "sample_period_s": 1,
            "servo": { "mode": "effort" }
        }),
    ] {
        let error = &ask(&robot, &request)["error"];
        assert_eq!(error["code"], "unphysical", "{request}: {error}");
        let message = error["message"].as_str().unwrap_or_default();
        for part in [
            "`upper` (line 5)",
            "`lower` (line 6)",
            "--balance",
            "--accept-unphysical",
        ] {
            assert!(message.contains(part), "{part}: {message}");
        }
    }
    // a negative mass has no centre, either
    let robot = robot_of(include_str!(
        "../../../tests/robots/peculiar/negative_mass.urdf"
    ));
    let error = &ask(&robot, &json!({ "op": "com", "q": [0] }))["error"];
    assert_eq!(error["code"], "unphysical", "{error}");
}
