//! Files in Python: what they get, what is counted, and how each way to fail is reported.

use super::PythonController;
use crate::submission::controller::{
    Answer, AskedFunction, Budget, Budgets, Call, Controller, Mistake, Observation, Opening, Reads,
    RobotFacts, SensorFacts, SourcePosition, Stop, Value,
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
    PythonController::open(&opening(source)).unwrap_or_else(|stop| panic!("{stop:?}"))
}

/// What `control` of a file answers.
fn control(source: &str) -> Result<Answer, Stop> {
    PythonController::open(&opening(source))?.call(&Call::Control(observation()))
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
fn an_exception_has_pythons_words_its_place_and_help() {
    let (message, help, line, column) =
        mistake(control("import numpy as np\n\n\ndef control(observation):\n    e = observation.q\n    return e + observation.tcp\n").unwrap_err());
    assert!(
        message.starts_with(
            "ValueError: operands could not be broadcast together with shapes (2,) (3,)"
        ),
        "{message}"
    );
    assert!(help.contains(".shape"), "{help}");
    assert_eq!((line, column), (6, 12));
    let (message, help, line, _) = mistake(control("def control(observation):\n    return helper(observation)\n\n\ndef helper(observation):\n    return [observation.qdot[0]]\n").unwrap_err());
    assert_eq!(
        message,
        "AttributeError: observation has no 'qdot'. Did you mean: 'qd'?"
    );
    assert_eq!((line, help.as_str()), (6, ""));
    let (message, help, ..) = mistake(
        control("def control(observation):\n    return np.sin(observation.q)\n").unwrap_err(),
    );
    assert!(
        message.starts_with("NameError: name 'np' is not defined"),
        "{message}"
    );
    assert_eq!(help, "write `import numpy as np` at the top");
}

#[test]
fn a_file_that_python_cannot_read_does_not_build() {
    for (source, words, at) in [
        ("def control(observation)\n    return 1\n", "SyntaxError", 1),
        ("x = (1\n", "SyntaxError", 1),
        (
            "def control(observation):\nreturn 1\n",
            "IndentationError",
            2,
        ),
        ("x = 1\ny = 2 +\n", "SyntaxError", 2),
        ("x = 'abc\n", "SyntaxError", 1),
    ] {
        let stop = PythonController::open(&opening(source))
            .err()
            .expect(source);
        assert!(matches!(stop, Stop::DidNotBuild(_)), "{source}: {stop:?}");
        let (message, _, line, _) = mistake(stop);
        assert!(message.starts_with(words), "{source}: {message}");
        assert_eq!(line, at, "{source}: {message}");
    }
    let stop = PythonController::open(&opening("import numpy\nx = 1 / 0\n"))
        .err()
        .expect("it stops");
    let (message, _, line, _) = mistake(stop);
    assert_eq!(
        (message.as_str(), line),
        ("ZeroDivisionError: division by zero", 2)
    );
}

#[test]
fn a_function_that_is_missing_is_named_with_what_is_like_it() {
    let Err(Stop::Missing {
        function,
        help,
        namesake,
    }) = control("def controll(observation):\n    return 1\n")
    else {
        panic!("nothing is missing");
    };
    assert_eq!(function, "control(observation)");
    assert!(help.expect("help").contains("controll"));
    assert!(namesake.is_none());
    let Err(Stop::Missing { namesake, .. }) = control("x = 1\ndef control():\n    return 1\n")
    else {
        panic!("nothing is missing");
    };
    let namesake = namesake.expect("a function of this name");
    assert_eq!((namesake.parameters, namesake.wanted), (0, 1));
    assert_eq!(namesake.place.expect("a place").line, 2);
    // one that `init` makes is there when it has run
    let mut made = open(
        "def init(robot, task):\n    global control\n    control = lambda observation: [robot.height]\n",
    );
    made.call(&Call::Init).expect("init runs");
    let answer = made.call(&Call::Control(observation())).expect("an answer");
    assert_eq!(answer.value, list(&[2.5]));
    let mut none = open("def init(robot, task):\n    pass\n");
    none.call(&Call::Init).expect("init runs");
    let stop = none.call(&Call::Control(observation())).unwrap_err();
    assert!(matches!(stop, Stop::Missing { .. }), "{stop:?}");
    // parameters that have values of their own, and any number of them, fit
    for head in ["observation, gain=3", "*anything", "observation=None"] {
        let source = format!("def control({head}):\n    return 1\n");
        assert!(control(&source).is_ok(), "{head}");
    }
    assert_eq!(
        open("x = 1\n").call(&Call::Init).expect("no init").value,
        Value::Nothing
    );
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
fn there_is_nothing_outside() {
    for (line, words) in [
        (
            "import os",
            "ModuleNotFoundError: No module named 'os': there are no files and no system",
        ),
        (
            "import time",
            "ModuleNotFoundError: No module named 'time': there is no clock",
        ),
        (
            "import random",
            "ModuleNotFoundError: No module named 'random': there is no chance",
        ),
        (
            "from . import other",
            "ImportError: a submission is one file",
        ),
        (
            "import numpyy",
            "ModuleNotFoundError: No module named 'numpyy': did you mean 'numpy'?",
        ),
        (
            "open('x')",
            "NameError: name 'open' is not there: there are no files",
        ),
        ("eval('1')", "NameError: name 'eval' is not there"),
        ("exec('1')", "NameError: name 'exec' is not there"),
    ] {
        let stop = PythonController::open(&opening(&format!("{line}\n")))
            .err()
            .expect(line);
        let (message, ..) = mistake(stop);
        assert!(message.starts_with(words), "{line}: {message}");
    }
}

#[test]
fn what_python_people_use_can_be_imported() {
    let source = "from __future__ import annotations\n\nimport itertools\nimport math\nfrom collections import deque, namedtuple\nfrom dataclasses import dataclass, field\nfrom enum import Enum, auto\nfrom functools import lru_cache, partial, reduce\nfrom typing import TYPE_CHECKING, List, Optional\n\nimport numpy as np\nimport numpy.linalg as la\nfrom numpy import pi\n\nif TYPE_CHECKING:\n    from kinemark import Observation\n\nPoint = namedtuple('Point', 'x y')\n\n\nclass Phase(Enum):\n    REACH = auto()\n    HOLD = 2\n\n\n@dataclass\nclass State:\n    gain: float\n    seen: List[float] = field(default_factory=list)\n    phase: Optional[Phase] = Phase.REACH\n\n    def __post_init__(self):\n        self.twice = 2 * self.gain\n\n\nstate = State(3.0)\n\n\n@lru_cache(maxsize=None)\ndef slow(n):\n    return n if n < 2 else slow(n - 1) + slow(n - 2)\n\n\ndef control(observation: Observation):\n    state.seen.append(observation.time)\n    state.phase = Phase.HOLD if state.phase is Phase.REACH else Phase.REACH\n    last = deque([1, 2, 3], maxlen=2)\n    return [state.twice, len(state.seen), state.phase.value, last[0], Point(4, 5).y, slow(30), la.norm([3, 4]), math.floor(pi), reduce(lambda a, b: a + b, itertools.islice(itertools.count(), 4)), partial(max, 7)(1)]\n";
    let answer = control(source).unwrap_or_else(|stop| panic!("{stop:?}"));
    assert_eq!(
        answer.value,
        list(&[6.0, 1.0, 2.0, 2.0, 5.0, 832_040.0, 5.0, 3.0, 6.0, 7.0])
    );
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

/// Names of sets and dicts come in the order in which they were put in, whatever their hashes are, and hashes are the same in each process.
#[test]
fn nothing_varies_from_start_to_start() {
    let source = "def control(observation):\n    names = {'b', 'a', 'c', 'd'}\n    return [hash('kinemark') % 1000, id(names) % 1000, *[ord(name) for name in names]]\n";
    let first = control(source).expect("an answer");
    assert_eq!(first, control(source).expect("an answer"));
}

/// Programs without arrays print what Python 3.11 prints: `.ci/full runtime` runs them with the one of the machine.
#[test]
fn programs_print_what_python_prints() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/python/runtime/programs");
    let mut programs: Vec<_> = std::fs::read_dir(folder)
        .expect("the programs")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "py"))
        .collect();
    programs.sort();
    assert!(programs.len() > 10);
    for path in programs {
        let source = std::fs::read_to_string(&path).expect("a program");
        let expected = std::fs::read_to_string(path.with_extension("out")).expect("its output");
        let mut opened = match PythonController::open(&opening(&source)) {
            Ok(opened) => opened,
            Err(stop) => panic!("{}: {stop:?}", path.display()),
        };
        let printed = opened.unanswered().log.into_iter();
        let printed: Vec<String> = printed.map(|line| line.text).collect();
        let expected: Vec<&str> = expected.lines().collect();
        assert_eq!(printed, expected, "{}", path.display());
    }
}

/// The exception that ends `control` of a file.
fn crash(source: &str) -> Mistake {
    match control(source) {
        Err(Stop::Crashed(mistake)) => mistake,
        other => panic!("{source}: {other:?}"),
    }
}

#[test]
fn a_large_file_can_be_read() {
    let mut source = String::new();
    let mut i = 0;
    while source.len() < 60_000 {
        i += 1;
        source.push_str(&format!(
            "def f{i}(x, y):\n    a = [x * k for k in range(3)]\n    return a[0] + y ** 2 - {i}.5\n\n"
        ));
    }
    source.push_str("def control(observation):\n    return f1(1.0, 2.0)\n");
    let answer = control(&source).expect("an answer");
    assert_eq!(answer.value, Value::Number(2.5));
}

#[test]
fn a_file_may_begin_with_a_mark_of_its_encoding() {
    let answer = control("\u{feff}def control(observation):\n    return 1.0\n").expect("an answer");
    assert_eq!(answer.value, Value::Number(1.0));
}

#[test]
fn columns_count_characters() {
    let source = "def control(observation):\n    print(\"Größe\"); return observation.q[7]\n";
    assert_eq!(
        crash(source).place,
        Some(SourcePosition {
            line: 2,
            column: 28
        })
    );
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

#[test]
fn a_forgotten_global_is_named() {
    let help = |source: &str| crash(source).help.unwrap_or_default();
    let none = "state = None\ndef start():\n    state = [1]\ndef control(observation):\n    start()\n    return state[0]\n";
    assert!(
        help(none).contains("write `global state`"),
        "{}",
        help(none)
    );
    let unknown =
        "def start():\n    best = 1\ndef control(observation):\n    start()\n    return best\n";
    assert!(
        help(unknown).contains("write `global best`"),
        "{}",
        help(unknown)
    );
    let right = "state = None\ndef start():\n    global state\n    state = 1\ndef control(observation):\n    return state[0]\n";
    assert!(!help(right).contains("global"), "{}", help(right));
}

#[test]
fn an_error_that_imitates_the_compiler_is_a_crash() {
    for error in [
        "SyntaxError('m', ('f.py', 0, 0, None))",
        "SyntaxError('m', ('f.py', 10**9, -5, None))",
        "type('SyntaxError', (Exception,), {})('m')",
    ] {
        let mistake = crash(&format!("def control(observation):\n    raise {error}\n"));
        assert_eq!(mistake.place.map(|place| place.line), Some(2), "{error}");
    }
}

#[test]
fn an_exception_that_nobody_can_catch_is_printed() {
    let source = "class Log:\n    def __del__(self):\n        print(self.missing)\ndef control(observation):\n    Log()\n    return 1.0\n";
    let answer = control(source).expect("an answer");
    assert!(
        answer.said.log[0].text.starts_with("Exception ignored in "),
        "{:?}",
        answer.said.log
    );
}

#[test]
fn no_function_is_made_of_bytes() {
    for line in [
        "f.__code__ = (lambda: 1).__code__",
        "f.__code__.replace(co_code=b'')",
        "type(f.__code__)()",
    ] {
        let source = format!(
            "def f():\n    return 1\ndef control(observation):\n    {line}\n    return 1.0\n"
        );
        let message = crash(&source).message;
        assert!(
            message.starts_with("TypeError") || message.starts_with("AttributeError"),
            "{message}"
        );
    }
}

#[test]
fn arrays_are_made_of_what_has_elements() {
    for (expression, wanted) in [
        (
            "np.mean(deque([[1.0, 3.0], [3.0, 5.0]], maxlen=5), axis=0)",
            list(&[2.0, 4.0]),
        ),
        ("deque([1.0, 2.0])", list(&[1.0, 2.0])),
        ("np.ones(2) + Point(1.0, 2.0)", list(&[2.0, 3.0])),
        (
            "np.ravel([[1, 2], [3, 4]], order='F')",
            list(&[1.0, 3.0, 2.0, 4.0]),
        ),
        (
            "np.arange(6).reshape((2, 3), order='F')[1]",
            list(&[1.0, 3.0, 5.0]),
        ),
        ("np.arange(stop=3)", list(&[0.0, 1.0, 2.0])),
        ("1.0 if ~np.any([False]) else 2.0", Value::Number(1.0)),
        (
            "np.linalg.lstsq([[1.0, 1], [1, 1]], [2.0, 2], rcond=-1)[0]",
            list(&[1.0, 1.0]),
        ),
    ] {
        let source = format!(
            "import numpy as np\nfrom collections import deque, namedtuple\nPoint = namedtuple('Point', 'x y')\ndef control(observation):\n    return {expression}\n"
        );
        match control(&source) {
            Ok(answer) => assert_eq!(rounded(answer.value), wanted, "{expression}"),
            Err(stop) => panic!("{expression}: {stop:?}"),
        }
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
