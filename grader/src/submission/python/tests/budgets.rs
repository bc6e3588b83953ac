//! What is counted and limited: instructions and memory.

use super::*;

/// What a process translated before, which instance it is, and what was called before: none of it is paid by a call.
#[test]
fn the_same_call_costs_the_same_instructions() {
    let source = "import numpy as np\n\n\ndef forward_kinematics(robot, q):\n    return np.sin(q) @ np.eye(2) * 3\n";
    let cost = |controller: &mut PythonController| {
        let answer = controller.call(&forward_kinematics()).expect("an answer");
        answer.operations
    };
    let mut first = open(source);
    let costs = [cost(&mut first), cost(&mut first), cost(&mut open(source))];
    assert_eq!(costs, [costs[0]; 3]);
    assert!(costs[0] > 100, "{costs:?}");
}

#[test]
fn a_loop_without_an_end_is_over_budget_at_its_line() {
    let stop =
        control("def control(observation):\n    x = 0\n    while True:\n        x = 1 - x\n")
            .unwrap_err();
    let Stop::OverBudget {
        budget,
        limit,
        place,
        function,
    } = stop
    else {
        panic!("{stop:?}");
    };
    assert_eq!(budget, Budget::InstructionsPerCall);
    assert_eq!(limit, Budgets::default().python_instructions_per_call());
    let line = place.expect("a place").line;
    assert!((3..=4).contains(&line), "{line}");
    assert_eq!(function.as_deref(), Some("control"));
}

#[test]
fn a_task_has_a_budget_of_its_own() {
    let source = "def control(observation):\n    for _ in range(5_000):\n        pass\n    return observation.q\n";
    let mut opening = opening(source);
    opening.budgets.operations_per_task = 2 * opening.budgets.operations_per_call;
    let mut controller = PythonController::open(&opening).expect("it opens");
    let calls = (0..1_000).find_map(|_| controller.call(&Call::Control(observation())).err());
    let Some(Stop::OverBudget { budget, limit, .. }) = calls else {
        panic!("{calls:?}");
    };
    assert_eq!(budget, Budget::InstructionsPerTask);
    assert_eq!(limit, opening.budgets.python_instructions_per_task());
}

#[test]
fn a_call_after_one_that_was_stopped_has_an_answer_where_cases_are_asked() {
    let source =
        "def forward_kinematics(robot, q):\n    while q[0] > 0:\n        pass\n    return q\n";
    let mut controller = open(source);
    assert!(matches!(
        controller.call(&forward_kinematics()),
        Err(Stop::OverBudget { .. })
    ));
    let other = Call::ForwardKinematics {
        robot: robot(),
        q: vec![-1.0, 2.0],
    };
    assert_eq!(
        controller.call(&other).expect("an answer").value,
        list(&[-1.0, 2.0])
    );
}

#[test]
fn memory_is_limited_at_the_line_that_takes_it() {
    for line in [
        "kept = [0.0] * 10**9",
        "kept = 'x' * 10**9",
        "kept = [0.0] * 10**18",
        "kept = bytearray(10**9)",
    ] {
        let source = format!(
            "def control(observation):\n    return 1\n\n\ndef forward_kinematics(robot, q):\n    {line}\n    return kept\n"
        );
        let (message, _, at, _) = mistake(open(&source).call(&forward_kinematics()).unwrap_err());
        assert!(
            message.starts_with("MemoryError") || message.starts_with("OverflowError"),
            "{line}: {message}"
        );
        assert_eq!(at, 6, "{line}: {message}");
    }
}

#[test]
fn a_file_as_large_as_it_may_be_can_be_read() {
    let most = Budgets::default().source_bytes as usize;
    let end = "def control(observation):\n    return f1(1.0)\n";
    let mut source = String::new();
    // what takes the reader longest: small functions
    for i in 1.. {
        let next = format!("def f{i}(x):\n    y = x + {i}\n    return y\n\n\n");
        if source.len() + next.len() + end.len() > most {
            break;
        }
        source.push_str(&next);
    }
    source.push_str(end);
    let answer = control(&source).expect("an answer");
    assert_eq!(answer.value, Value::Number(2.0));
}
