//! Files in Python: what they get and what they answer; how they fail, what is counted and what there is of the language in files of their own.

mod budgets;
mod language;
mod mistakes;

use super::PythonController;
use crate::submission::controller::{
    Answer, AskedFunction, Budget, Budgets, Call, Controller, Failed, Mistake, Observation,
    Opening, Reads, RobotFacts, SensorFacts, SourcePosition, Stop, Value,
};
use crate::submission::handed_in::Program;

fn robot() -> RobotFacts {
    RobotFacts {
        name: "arm".into(),
        joint_names: vec!["a".into(), "bc".into()],
        dimensions: vec![
            ("height".into(), Value::Number(2.5)),
            ("lengths".into(), list(&[1.0, 0.5])),
        ],
        lower: vec![-1.0, f64::NEG_INFINITY],
        upper: vec![1.0, f64::INFINITY],
        effort: vec![10.0, 20.0],
    }
}

fn opening(source: &str) -> Opening {
    Opening {
        file: "submission.py".into(),
        program: Program::Python(source.to_owned()),
        task: "move".into(),
        robot: robot(),
        target: Value::Map(vec![("speed".into(), Value::Number(0.25))]),
        sensors: vec![
            SensorFacts {
                name: "touch".into(),
                reads: Reads::Truth,
            },
            SensorFacts {
                name: "beam".into(),
                reads: Reads::Vector(2),
            },
        ],
        budgets: Budgets::default(),
        granted: None,
        function: None,
    }
}

fn observation() -> Observation {
    Observation {
        tick: 30,
        time_s: 0.03,
        dt_s: 0.01,
        q: vec![0.1, 0.2],
        qd: vec![0.3, 0.4],
        effort: vec![0.5, 0.6],
        tcp_m: [0.7, 0.8, 0.9],
        tcp_rotation: [[0.01, 0.02, 0.03], [0.04, 0.05, 0.06], [0.07, 0.08, 0.09]],
        sensors: vec![1.0, 4.0, 5.0],
    }
}

fn list(numbers: &[f64]) -> Value {
    Value::List(numbers.iter().copied().map(Value::Number).collect())
}

fn open(source: &str) -> PythonController {
    PythonController::open(&opening(source)).unwrap_or_else(|failed| panic!("{failed:?}"))
}

/// How a file ends that cannot be opened.
fn failed(source: &str) -> Failed {
    let opened = PythonController::open(&opening(source));
    *opened.err().expect(source)
}

/// What `control` of a file answers.
fn control(source: &str) -> Result<Answer, Stop> {
    let mut opened = PythonController::open(&opening(source)).map_err(|failed| failed.stop)?;
    opened.call(&Call::Control(observation()))
}

/// The exception that ends `control` of a file.
fn crash(source: &str) -> Mistake {
    match control(source) {
        Err(Stop::Crashed(mistake)) => mistake,
        other => panic!("{source}: {other:?}"),
    }
}

/// What an expression of the observation is.
fn value(expression: &str) -> Value {
    let source =
        format!("import numpy as np\ndef control(observation):\n    return {expression}\n");
    match control(&source) {
        Ok(answer) => answer.value,
        Err(stop) => panic!("{expression}: {stop:?}"),
    }
}

fn forward_kinematics() -> Call {
    Call::ForwardKinematics {
        robot: robot(),
        q: vec![0.1, 0.2],
    }
}

/// Message, help, line and column of a mistake.
fn mistake(stop: Stop) -> (String, String, usize, usize) {
    match stop {
        Stop::Crashed(mistake) | Stop::DidNotBuild(mistake) => {
            let place = mistake
                .place
                .unwrap_or(SourcePosition { line: 0, column: 0 });
            (
                mistake.message,
                mistake.help.unwrap_or_default(),
                place.line,
                place.column,
            )
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_field_of_the_observation_arrives() {
    assert_eq!(value("observation.q"), list(&[0.1, 0.2]));
    assert_eq!(
        value("[*observation.qd, observation.effort[1]]"),
        list(&[0.3, 0.4, 0.6])
    );
    assert_eq!(value("observation.tcp"), list(&[0.7, 0.8, 0.9]));
    assert_eq!(value("observation.tcp_rotation[1, 2]"), Value::Number(0.06));
    assert_eq!(
        value("[observation.tick, observation.time, observation.dt]"),
        list(&[30.0, 0.03, 0.01])
    );
    assert_eq!(value("observation.task"), Value::Text("move".into()));
    assert_eq!(value("observation.target.speed"), Value::Number(0.25));
    assert_eq!(value("observation['target']['speed']"), Value::Number(0.25));
    assert_eq!(value("observation.sensors.touch"), Value::Boolean(true));
    assert_eq!(value("observation.sensors['beam']"), list(&[4.0, 5.0]));
    assert_eq!(value("'beam' in observation.sensors"), Value::Boolean(true));
}

/// Its fields are made when they are read, which no program can see.
#[test]
fn an_observation_is_like_a_record_with_all_its_fields() {
    for expression in [
        "observation.q is observation.q and observation['q'] is observation.q",
        "list(observation) == list(observation.keys()) == list(vars(observation))",
        "list(observation)[:3] + list(observation)[-1:] == ['task', 'tick', 'time', 'sensors']",
        "len(observation) == 11 and 'q' in observation and 'x' not in observation and 1 not in observation",
        "[name for name, value in observation.items() if value is observation.tcp] == ['tcp']",
        "observation.get('qd') is observation.qd and observation.get('x') is None and observation.get('x', 2) == 2",
        "repr(observation).startswith(\"Observation(task='move', tick=30, time=0.03, dt=0.01, q=array([0.1, 0.2]), qd=\")",
        "getattr(observation, 'x', 5) == 5 and not hasattr(observation, 'x') and hasattr(observation, 'sensors')",
        "__import__('kinemark').Observation is type(observation) and isinstance(observation, __import__('kinemark').Observation)",
    ] {
        assert_eq!(value(expression), Value::Boolean(true), "{expression}");
    }
    let body = |lines: &str| {
        let lines: Vec<String> = lines.lines().map(|line| format!("    {line}\n")).collect();
        control(&format!(
            "import copy\ndef control(observation):\n{}",
            lines.concat()
        ))
    };
    let changed = "other = copy.deepcopy(observation)\nobservation.q[0] = 7\nobservation['qd'] = 8\nobservation.dt = 9\n\
                   return [observation.q[0], observation.qd, observation.dt, other.q[0], other.qd[0], other.dt]";
    let answer = body(changed).expect("an answer");
    assert_eq!(answer.value, list(&[7.0, 8.0, 9.0, 0.1, 0.3, 0.01]));
    for (lines, words) in [
        (
            "observation['qdot']",
            "KeyError: \"observation has no 'qdot'. Did you mean: 'qd'?\"",
        ),
        (
            "observation.last = 1",
            "AttributeError: observation has no 'last', and keeps nothing: each call is given another one",
        ),
        (
            "del observation.q",
            "AttributeError: the fields of observation cannot be deleted",
        ),
        (
            "observation[0]",
            "KeyError: 'observation has no 0; it has task, tick",
        ),
        (
            "observation.sensors.torch",
            "AttributeError: sensors has no 'torch'. Did you mean: 'touch'?",
        ),
    ] {
        let (message, _, line, _) = mistake(body(lines).unwrap_err());
        assert!(message.starts_with(words), "{lines}: {message}");
        assert_eq!(line, 3, "{lines}");
    }
}

#[test]
fn a_quintic_is_taken_of_numbers_and_of_each_element() {
    for expression in [
        "quintic(0.5) == 0.5 and quintic(-3) == 0.0 and quintic(2) == 1.0 and quintic_rate(0.5) == 1.875",
        "(quintic(np.array([[0.0, 0.5], [1.0, 2.0]])) == np.array([[0.0, 0.5], [1.0, 1.0]])).all()",
        "(quintic_rate([0.0, 0.5]) == np.array([0.0, 1.875])).all() and quintic(np.nan) != quintic(np.nan)",
    ] {
        assert_eq!(value(expression), Value::Boolean(true), "{expression}");
    }
}

#[test]
fn the_robot_has_its_facts_and_whole_numbers_are_ints() {
    let source = "def forward_kinematics(robot, q):\n    return [robot.joints, robot.height, *robot.lengths, robot.upper[0], len(robot.joint_names), sum(1 for _ in range(robot.joints))]\n";
    let answer = open(source).call(&forward_kinematics()).expect("an answer");
    assert_eq!(answer.value, list(&[2.0, 2.5, 1.0, 0.5, 1.0, 2.0, 2.0]));
}

#[test]
fn answers_are_what_python_has_for_numbers() {
    assert_eq!(value("(1, 2.5)"), list(&[1.0, 2.5]));
    assert_eq!(
        value("np.array([[1, 2], [3, 4]])"),
        Value::List(vec![list(&[1.0, 2.0]), list(&[3.0, 4.0])])
    );
    assert_eq!(value("np.float64(3)"), Value::Number(3.0));
    assert_eq!(value("True"), Value::Boolean(true));
    assert_eq!(value("None"), Value::Nothing);
    assert_eq!(
        value("{'b': 1, 'a': [2]}"),
        Value::Map(vec![
            ("a".into(), list(&[2.0])),
            ("b".into(), Value::Number(1.0))
        ])
    );
    assert_eq!(value("1j"), Value::Other("complex".into()));
    assert_eq!(value("control"), Value::Other("function".into()));
}

#[test]
fn state_is_kept_in_a_run_and_never_between_cases() {
    let source = "count = 0\n\n\ndef control(observation):\n    global count\n    count += 1\n    return [count]\n\n\ndef forward_kinematics(robot, q):\n    global count\n    count += 1\n    return [count]\n";
    let mut run = open(source);
    for expected in [1.0, 2.0, 3.0] {
        let answer = run.call(&Call::Control(observation())).expect("an answer");
        assert_eq!(answer.value, list(&[expected]));
    }
    let mut cases = open(source);
    for _ in 0..3 {
        let answer = cases.call(&forward_kinematics()).expect("an answer");
        assert_eq!(answer.value, list(&[1.0]));
    }
}

#[test]
fn prints_and_plots_are_kept_as_in_a_script() {
    let answer = control("def control(observation):\n    print('a', 1, sep='-', end='')\n    print(['b'])\n    print('c\\nd', end='')\n    plot('e', observation.q)\n    plot('f', 2)\n    return 1\n").expect("an answer");
    assert_eq!(answer.said.texts(), ["a-1['b']", "c", "d"]);
    let lines: Vec<Option<usize>> = answer.said.log.iter().map(|printed| printed.line).collect();
    // a line without its end is written when the call is over
    assert_eq!(lines, [Some(3), Some(4), None]);
    let plots: Vec<(&str, f64)> = answer
        .said
        .plots
        .iter()
        .map(|(name, x)| (name.as_str(), *x))
        .collect();
    assert_eq!(plots, [("e[0]", 0.1), ("e[1]", 0.2), ("f", 2.0)]);
}

#[test]
fn what_was_printed_before_a_stop_is_there() {
    let mut controller =
        open("def control(observation):\n    print('here')\n    raise ValueError('no')\n");
    let (message, _, line, _) =
        mistake(controller.call(&Call::Control(observation())).unwrap_err());
    assert_eq!((message.as_str(), line), ("ValueError: no", 3));
    assert_eq!(controller.unanswered().texts(), ["here"]);
}

#[test]
fn a_function_of_the_labs_own_is_given_a_record() {
    let mut opening = opening(
        "def loop(robot, given):\n    return {'sum': given.gain + given['mass'] + robot.height, 'rows': given.m @ given.v}\n",
    );
    opening.function = Some(AskedFunction {
        name: "loop".into(),
        parameters: vec!["robot".into(), "given".into()],
    });
    let call = Call::Free {
        function: "loop".into(),
        robot: Some(robot()),
        given: vec![
            ("gain".into(), Value::Number(1.0)),
            ("mass".into(), Value::Number(2.0)),
            (
                "m".into(),
                Value::List(vec![list(&[1.0, 2.0]), list(&[3.0, 4.0])]),
            ),
            ("v".into(), list(&[1.0, 1.0])),
        ],
    };
    let answer = PythonController::open(&opening)
        .expect("it opens")
        .call(&call)
        .expect("an answer");
    let expected = vec![
        ("rows".into(), list(&[3.0, 7.0])),
        ("sum".into(), Value::Number(5.5)),
    ];
    assert_eq!(answer.value, Value::Map(expected));
}

#[test]
fn what_is_done_to_the_target_is_gone_at_the_next_call() {
    let source = "def control(observation):\n    observation.target.speed += 1\n    return observation.target.speed\n";
    let mut opened = open(source);
    for _ in 0..3 {
        let answer = opened
            .call(&Call::Control(observation()))
            .expect("an answer");
        assert_eq!(answer.value, Value::Number(1.25));
    }
}

/// The value with its numbers to twelve digits.
fn rounded(value: Value) -> Value {
    match value {
        Value::Number(number) => Value::Number((number * 1e12).round() / 1e12),
        Value::List(items) => Value::List(items.into_iter().map(rounded).collect()),
        other => other,
    }
}
