//! Requests, answers and texts of the toolbox against numbers worked by hand.

mod eval_answers;
mod eval_errors;
mod published;
mod simulate_limits;
mod step_responses;
mod texts;

use kinemark_sim::format::{ReadOptions, detect};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Source;
use kinemark_toolbox::eval::{Subject, answer_line};
use serde_json::{Value, json};

/// A robot without meshes.
fn robot_of(text: &str) -> Robot {
    let no_mesh = &mut |name: &str| Err(format!("there is no mesh `{name}` here"));
    let source = Source::new("robot", text);
    (detect(&source).read)(source, &ReadOptions::default(), no_mesh)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Two links of 1 m and 0.5 kg on a base of 2 m; straight up at zero, about y.
fn rrbot() -> Robot {
    robot_of(include_str!("../../../labs/robots/rrbot.toml"))
}

/// Three independent joints and two that follow through loops.
fn uarm() -> Robot {
    robot_of(include_str!("../../../labs/robots/uarm.toml"))
}

fn ask(robot: &Robot, request: &Value) -> Value {
    let subject = Subject { robot, scene: None };
    Value::Object(answer_line(subject, request.to_string().as_bytes()))
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        other => vec![
            other
                .as_f64()
                .unwrap_or_else(|| panic!("{other} is not a number")),
        ],
    }
}

#[track_caller]
fn close(got: &Value, expected: &[f64], tolerance: f64) {
    let got = numbers(got);
    assert_eq!(got.len(), expected.len(), "{got:?}");
    for (got, expected) in got.iter().zip(expected) {
        let error = (got - expected).abs();
        assert!(error <= tolerance, "{got} against {expected}");
    }
}

#[test]
fn an_answer_has_the_id_of_its_request() {
    let id = json!({ "any": [1, null] });
    assert_eq!(ask(&rrbot(), &json!({ "op": "info", "id": id }))["id"], id);
    assert_eq!(
        ask(&rrbot(), &json!({ "op": "nothing" }))["id"],
        Value::Null
    );
}
