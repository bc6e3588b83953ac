//! The language as a student meets it: small scripts and what comes of them.

use super::ScriptController;
use crate::submission::controller::{
    Answer, AskedFunction, Budgets, Call, Controller, Observation, Opening, RobotFacts, Stop, Value,
};
use crate::submission::handed_in::Program;

mod budgets;
mod calls;
mod definitions;
mod metered;
mod reference;
mod slips;
mod tree;
mod values;
mod words;

fn robot() -> RobotFacts {
    RobotFacts {
        name: "rrbot".into(),
        joint_names: vec!["shoulder".into(), "elbow".into()],
        dimensions: vec![
            ("base_height".into(), Value::Number(2.0)),
            ("link_lengths".into(), numbers([1.0, 0.5])),
        ],
        lower: vec![-6.3, -6.3],
        upper: vec![6.3, 6.3],
        effort: vec![30.0, 15.0],
    }
}

fn opening(source: &str) -> Opening {
    Opening {
        file: "submission.rhai".into(),
        program: Program::Script(source.into()),
        task: "move".into(),
        robot: robot(),
        target: numbers([2.0, 1.4, 0.0]),
        sensors: Vec::new(),
        budgets: Budgets::default(),
        granted: None,
        function: None,
    }
}

/// The lab's own function of this name.
fn asked(name: &str) -> AskedFunction {
    AskedFunction {
        name: name.into(),
        parameters: vec!["given".into()],
    }
}

fn observation() -> Observation {
    Observation {
        tick: 30,
        time_s: 0.03,
        dt_s: 0.5,
        q: vec![0.25, 0.5],
        qd: vec![1.0, 2.0],
        effort: vec![0.5, -0.5],
        tcp_m: [4.0, 0.0, 0.0],
        tcp_rotation: [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        sensors: Vec::new(),
    }
}

fn numbers<const N: usize>(elements: [f64; N]) -> Value {
    Value::List(elements.map(Value::Number).to_vec())
}

/// Calls `control` of a whole file.
fn run(source: &str) -> Result<Answer, Stop> {
    ScriptController::open(&opening(source))?.call(&Call::Control(observation()))
}

/// What a function body gives.
fn answer(body: &str) -> Answer {
    match run(&format!("fn control(observation) {{ {body} }}")) {
        Ok(answer) => answer,
        Err(stop) => panic!("{body}: {stop:?}"),
    }
}

fn value(body: &str) -> Value {
    answer(body).value
}

fn stop(source: &str) -> Stop {
    match run(source) {
        Ok(answer) => panic!("{source}: {answer:?}"),
        Err(stop) => stop,
    }
}

/// The message and the help of a function body that fails.
fn words(body: &str) -> String {
    match stop(&format!("fn control(observation) {{ {body} }}")) {
        Stop::Crashed(mistake) | Stop::DidNotBuild(mistake) => match mistake.help {
            Some(help) => format!("{} | {help}", mistake.message),
            None => mistake.message,
        },
        other => panic!("{body}: {other:?}"),
    }
}

fn assert_values<const N: usize>(cases: [(&str, Value); N]) {
    for (body, wanted) in cases {
        assert_eq!(value(body), wanted, "{body}");
    }
}

fn assert_words<const N: usize>(cases: [(&str, &str); N]) {
    for (body, wanted) in cases {
        assert_eq!(words(body), wanted, "{body}");
    }
}
