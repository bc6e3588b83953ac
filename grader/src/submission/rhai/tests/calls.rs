//! What goes into a call and comes out of it, and what stays between calls.

use super::{answer, asked, assert_values, numbers, observation, opening, robot, run, stop};
use crate::submission::controller::{
    Call, Controller, Mistake, Namesake, SourcePosition, Stop, Value,
};
use crate::submission::rhai::ScriptController;

#[test]
fn what_is_printed_and_plotted_comes_with_the_answer() {
    let answer = answer(
        "print(observation.q, 1, \"x\"); debug(#{a: [1, \"t\"]}); plot(\"e\", 1); plot(\"q\", observation.q); 0",
    );
    assert_eq!(answer.said.texts(), ["[0.25, 0.5] 1 x", "#{a: [1, \"t\"]}"]);
    assert_eq!(
        answer.said.plots,
        [
            ("e".to_owned(), 1.0),
            ("q[0]".to_owned(), 0.25),
            ("q[1]".to_owned(), 0.5)
        ]
    );
    assert!(answer.operations > 10);
}

#[test]
fn a_printed_line_knows_the_line_of_the_script_that_printed_it() {
    let script = "fn say(x) {
  print(x + sqrt(x));
}
fn control(o) {
  say(4.0); print(
    -1);
  if true { debug(3); }
  say(9.0);
  let e = sqrt(-1.0);
  e
}";
    let mut script = ScriptController::open(&opening(script)).unwrap();
    let said = match script.call(&Call::Control(observation())) {
        Ok(answer) => answer.said,
        Err(_) => script.unanswered(),
    };
    let lines: Vec<_> = said.log.iter().map(|printed| printed.line).collect();
    let texts = said.texts();
    assert_eq!(texts[..4], ["6", "-1", "3", "12"]);
    assert_eq!(lines[..4], [Some(2), Some(5), Some(7), Some(2)]);
    // what the grader says among them stands in no line
    assert!(lines[4..].iter().all(Option::is_none), "{said:?}");
}

#[test]
fn lines_printed_before_a_mistake_are_not_lost() {
    let mut script = ScriptController::open(&opening("fn control(o) { print(1); o.zz }")).unwrap();
    assert!(script.call(&Call::Control(observation())).is_err());
    assert_eq!(script.unanswered().texts(), ["1"]);
}

#[test]
fn observation_and_robot_hold_what_they_should() {
    assert_values([
        ("observation.task", Value::Text("move".into())),
        ("observation.tick", Value::Number(30.0)),
        ("observation.time", Value::Number(0.03)),
        ("observation.target", numbers([2.0, 1.4, 0.0])),
        ("observation.effort", numbers([0.5, -0.5])),
        ("observation.sensors", Value::Map(vec![])),
    ]);
    let source = "fn forward_kinematics(robot, q) {
        [robot.base_height, robot.link_lengths[1], robot.joints, len(robot.joint_names), robot.upper[0], robot.effort[1], q[0]]
    }
    fn inverse_kinematics(robot, position) { [[position.x, 1], [position[1], 2]] }";
    let mut script = ScriptController::open(&opening(source)).unwrap();
    let call = Call::ForwardKinematics {
        robot: robot(),
        q: vec![0.5, 0.0],
    };
    let answer = script.call(&call).unwrap();
    assert_eq!(answer.value, numbers([2.0, 0.5, 2.0, 2.0, 6.3, 15.0, 0.5]));
    // another robot in the next case
    let mut other = robot();
    other.dimensions[0].1 = Value::Number(3.0);
    let call = Call::ForwardKinematics {
        robot: other,
        q: vec![0.5, 0.0],
    };
    let answer = script.call(&call).unwrap();
    assert_eq!(answer.value, numbers([3.0, 0.5, 2.0, 2.0, 6.3, 15.0, 0.5]));
    let call = Call::InverseKinematics {
        robot: robot(),
        position_m: [2.0, 1.4, 0.0],
    };
    let answer = script.call(&call).unwrap();
    assert_eq!(
        answer.value,
        Value::List(vec![numbers([2.0, 1.0]), numbers([1.4, 2.0])])
    );
}

#[test]
fn this_is_shared_by_init_and_control_and_kept() {
    let source = "fn init(robot, task) { this.count = robot.joints; this.task = task; }
        fn control(o) { this.count += 1; if this.task == \"move\" { this.count } }";
    let mut script = ScriptController::open(&opening(source)).unwrap();
    assert_eq!(script.call(&Call::Init).unwrap().value, Value::Nothing);
    for count in [3.0, 4.0, 5.0] {
        let answer = script.call(&Call::Control(observation())).unwrap();
        assert_eq!(answer.value, Value::Number(count));
    }
}

#[test]
fn every_case_of_a_function_begins_with_an_empty_this() {
    let counting = |function: &str| {
        format!("fn {function} {{ let before = keys(this); this.n = 1; this.log = [1]; before }}")
    };
    let mut opening = opening(&format!(
        "{} {} {} {}",
        counting("forward_kinematics(robot, q)"),
        counting("inverse_kinematics(robot, position)"),
        counting("jacobian(robot, q)"),
        counting("own(given)"),
    ));
    opening.function = Some(asked("own"));
    let mut script = ScriptController::open(&opening).unwrap();
    let q = vec![0.5, 0.0];
    let calls = [
        Call::ForwardKinematics {
            robot: robot(),
            q: q.clone(),
        },
        Call::InverseKinematics {
            robot: robot(),
            position_m: [2.0, 1.4, 0.0],
        },
        Call::Jacobian { robot: robot(), q },
        Call::Free {
            function: "own".into(),
            robot: None,
            given: vec![("x".into(), Value::Number(1.0))],
        },
    ];
    let first: Vec<_> = calls
        .iter()
        .map(|call| script.call(call).unwrap())
        .collect();
    let again: Vec<_> = calls
        .iter()
        .map(|call| script.call(call).unwrap())
        .collect();
    for (first, again) in first.iter().zip(&again) {
        assert_eq!(first.value, Value::List(Vec::new()));
        assert_eq!(first, again);
    }
}

#[test]
fn constants_are_seen_in_functions_and_variables_are_not() {
    let source = "const A = 2; const B = A * 3; fn double(x) { x * A } const C = double(B); fn control(o) { helper() } fn helper() { C + pi - PI }";
    assert_eq!(run(source).unwrap().value, Value::Number(12.0));
    let Stop::Crashed(mistake) = stop("let kp = 5;\nfn control(o) {\n  kp * 2\n}") else {
        panic!("no crash");
    };
    assert_eq!(
        mistake,
        Mistake {
            further: Vec::new(),
            message: "variable `kp` is not known here".into(),
            place: Some(SourcePosition { line: 3, column: 3 }),
            help: Some("a `let` outside of a function is not seen inside: write const kp = ..., or keep it in `this`".into()),
        }
    );
}

#[test]
fn a_missing_function_is_named_with_the_nearest_one() {
    let help = |source: &str| match stop(source) {
        Stop::Missing { function, help, .. } => {
            format!("{function} | {}", help.unwrap_or_default())
        }
        other => panic!("{source}: {other:?}"),
    };
    assert_eq!(
        help(""),
        "control(observation) | write fn control(observation) { ... }"
    );
    assert_eq!(
        help("fn controll(o) { 1 }"),
        "control(observation) | rename `controll` to `control`"
    );
    let source = "// mine\n  fn control(q, qd) { 1 }";
    assert_eq!(
        help(source),
        "control(observation) | write fn control(observation)"
    );
    let Stop::Missing { namesake, .. } = stop(source) else {
        panic!("it is not missing");
    };
    assert_eq!(
        namesake,
        Some(Namesake {
            parameters: 2,
            wanted: 1,
            place: Some(SourcePosition { line: 2, column: 6 }),
        })
    );
    let mut script = ScriptController::open(&opening("fn init() {} fn control(o) { 1 }")).unwrap();
    assert!(matches!(
        script.call(&Call::Init),
        Err(Stop::Missing { function, .. }) if function == "init(robot, task)"
    ));
    let mut script = ScriptController::open(&opening("fn control(o) { 1 }")).unwrap();
    assert_eq!(script.call(&Call::Init).unwrap().value, Value::Nothing);
}

#[test]
fn the_same_calls_use_the_same_operations() {
    let used = || {
        let source = "fn control(o) { let s = 0; for i in 0..50 { s += norm(o.q) * i; } s }";
        let mut script = ScriptController::open(&opening(source)).unwrap();
        let mut call = || {
            script
                .call(&Call::Control(observation()))
                .unwrap()
                .operations
        };
        [call(), call(), call()]
    };
    let first = used();
    assert_eq!(first, used());
    assert_eq!(first[0], first[2]);
}
