//! Modules written as WebAssembly text: what they get, what they may do, and how each way to fail is reported.

mod words;

use super::PluginController;
use crate::submission::controller::{
    Answer, AskedFunction, Budget, Budgets, Call, Controller, Observation, Opening, Reads,
    RobotFacts, SensorFacts, Stop, Value,
};
use crate::submission::handed_in::Program;

/// What every module has, and `more`.
fn module(more: &str) -> Vec<u8> {
    with_ends(
        "(func (export \"km_version\") (result i32) i32.const 1)
         (func (export \"km_buffer\") (param i32) (result i32) i32.const 1024)",
        more,
    )
}

fn with_ends(ends: &str, more: &str) -> Vec<u8> {
    let text = format!("(module {more} (memory (export \"memory\") 2) {ends})");
    wat::parse_str(&text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn robot() -> RobotFacts {
    RobotFacts {
        name: "arm".into(),
        joint_names: vec!["a".into(), "bc".into()],
        dimensions: vec![
            ("height".into(), Value::Number(2.5)),
            (
                "lengths".into(),
                Value::List(vec![Value::Number(1.0), Value::Number(0.5)]),
            ),
        ],
        lower: vec![-1.0, f64::NEG_INFINITY],
        upper: vec![1.0, f64::INFINITY],
        effort: vec![10.0, 20.0],
    }
}

fn opening(bytes: Vec<u8>) -> Opening {
    Opening {
        file: "submission.wasm".into(),
        program: Program::Module(bytes),
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
        dt_s: 0.01,
        q: vec![0.1, 0.2],
        qd: vec![0.3, 0.4],
        effort: vec![0.5, 0.6],
        tcp_m: [0.7, 0.8, 0.9],
        tcp_rotation: [[0.01, 0.02, 0.03], [0.04, 0.05, 0.06], [0.07, 0.08, 0.09]],
        sensors: vec![1.0, 4.0, 5.0],
    }
}

fn call(bytes: Vec<u8>, call: &Call) -> Result<Answer, Stop> {
    PluginController::open(&opening(bytes))?.call(call)
}

fn control(more: &str) -> Result<Answer, Stop> {
    call(module(more), &Call::Control(observation()))
}

/// A `km_control` with this body; parameter 0 is the observation, 1 the command.
fn body(body: &str) -> String {
    format!("(func $km_control (export \"km_control\") (param i32 i32) {body})")
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::List(items) => items
            .iter()
            .map(|item| match item {
                Value::Number(number) => *number,
                other => panic!("{other:?} is no number"),
            })
            .collect(),
        other => panic!("{other:?} is no list"),
    }
}

/// The command that `km_control` returns when it writes what these instructions compute to its first number, and 0 to its second.
fn first(of: &str) -> f64 {
    let text = body(&format!(
        "(f64.store (local.get 1) {of}) (f64.store offset=8 (local.get 1) (f64.const 0))"
    ));
    numbers(&control(&text).expect(&text).value)[0]
}

fn mistake(result: Result<Answer, Stop>) -> (String, String) {
    match result {
        Err(Stop::Crashed(mistake) | Stop::DidNotBuild(mistake)) => {
            (mistake.message, mistake.help.unwrap_or_default())
        }
        other => panic!("{other:?}"),
    }
}

fn refusal(bytes: Vec<u8>) -> String {
    match PluginController::open(&opening(bytes)) {
        Err(Stop::DidNotBuild(mistake)) => mistake.message,
        Err(other) => panic!("{other:?}"),
        Ok(_) => panic!("it opens"),
    }
}

#[test]
fn an_observation_has_the_layout_of_the_header() {
    let pointer = |offset: u32, index: u32| {
        format!(
            "(f64.load offset={} (i32.load offset={offset} (local.get 0)))",
            8 * index
        )
    };
    for (of, wanted) in [
        ("(f64.load (local.get 0))".to_owned(), 30.0),
        ("(f64.load offset=8 (local.get 0))".to_owned(), 0.03),
        ("(f64.load offset=16 (local.get 0))".to_owned(), 0.01),
        (
            "(f64.convert_i32_u (i32.load offset=24 (local.get 0)))".to_owned(),
            2.0,
        ),
        (pointer(28, 1), 0.2),
        (pointer(32, 1), 0.4),
        (pointer(36, 0), 0.5),
        (pointer(40, 2), 0.9),
        (pointer(64, 0), 0.01),
        (pointer(64, 8), 0.09),
        // the task's name begins with m
        (
            "(f64.convert_i32_u (i32.load8_u (i32.load offset=44 (local.get 0))))".to_owned(),
            f64::from(b'm'),
        ),
        // the only field of the target: its numbers, after its name
        (
            "(f64.load (i32.load offset=4 (i32.load offset=48 (local.get 0))))".to_owned(),
            0.25,
        ),
        // the second number of the second sensor
        (
            "(f64.load offset=8 (i32.load offset=24 (i32.load offset=56 (local.get 0))))"
                .to_owned(),
            5.0,
        ),
        (
            "(f64.convert_i32_u (i32.load offset=60 (local.get 0)))".to_owned(),
            2.0,
        ),
    ] {
        assert_eq!(first(&of).to_bits(), f64::to_bits(wanted), "{of}");
    }
}

#[test]
fn a_run_keeps_its_instance_and_each_case_has_a_fresh_one() {
    let counted = "(global $count (mut f64) (f64.const 0))
        (func $next (result f64)
            (global.set $count (f64.add (global.get $count) (f64.const 1))) (global.get $count))
        (func (export \"km_control\") (param i32 i32)
            (f64.store (local.get 1) (call $next)) (f64.store offset=8 (local.get 1) (f64.const 0)))
        (func (export \"km_init\") (param i32 i32) (drop (call $next)))
        (func (export \"km_forward_kinematics\") (param i32 i32 i32)
            (f64.store (local.get 2) (call $next)) (f64.store offset=8 (local.get 2) (f64.load (local.get 1)))
            (f64.store offset=16 (local.get 2) (f64.load (i32.load offset=4 (i32.load offset=24 (local.get 0))))))";
    let mut controller = PluginController::open(&opening(module(counted)))
        .ok()
        .unwrap();
    controller.call(&Call::Init).unwrap();
    for wanted in [2.0, 3.0] {
        let answer = controller.call(&Call::Control(observation())).unwrap();
        assert_eq!(numbers(&answer.value), [wanted, 0.0]);
    }
    for height in [2.5, 3.5] {
        let mut robot = robot();
        robot.dimensions[0].1 = Value::Number(height);
        let case = Call::ForwardKinematics {
            robot,
            q: vec![7.0, 8.0],
        };
        let answer = controller.call(&case).unwrap();
        assert_eq!(numbers(&answer.value), [1.0, 7.0, height]);
    }
}

#[test]
fn what_is_not_written_is_not_a_number() {
    let answer = control(&body("(f64.store (local.get 1) (f64.const 3))")).unwrap();
    let command = numbers(&answer.value);
    assert_eq!(command[0], 3.0);
    // the mark of what is not written goes no further
    assert_eq!(command[1].to_bits(), f64::NAN.to_bits());
    assert_eq!(
        answer.said.texts(),
        ["`km_control` writes nothing to `command[1]`: the result is not a number"]
    );
    // a NaN that was computed is another matter
    let computed = "(f64.div (f64.const 0) (f64.const 0))";
    let text = format!(
        "(f64.store (local.get 1) {computed}) (f64.store offset=8 (local.get 1) {computed})"
    );
    assert_eq!(control(&body(&text)).unwrap().said.texts(), [""; 0]);
}

#[test]
fn branches_and_rows_are_as_many_as_the_module_says() {
    let branches = |returned: u32| {
        let text = format!(
            "(func (export \"km_inverse_kinematics\") (param i32 i32 i32 i32) (result i32)
                (f64.store (local.get 2) (f64.const 1)) (f64.store offset=24 (local.get 2) (f64.const 2))
                (i32.const {returned}))"
        );
        let position = Call::InverseKinematics {
            robot: robot(),
            position_m: [0.0; 3],
        };
        call(module(&text), &position)
    };
    assert_eq!(branches(0).unwrap().value, Value::List(vec![]));
    let Value::List(two) = branches(2).unwrap().value else {
        panic!("no list");
    };
    assert_eq!(numbers(&two[0])[0], 1.0);
    assert_eq!(numbers(&two[1])[1], 2.0);
    let (message, _) = mistake(branches(501));
    assert_eq!(message, "it returned 501 branches, there is room for 500");
    assert!(mistake(branches(u32::MAX)).0.contains("there is room"));
}

#[test]
fn a_function_of_the_labs_own_answers_with_named_numbers() {
    // "k" at 8, two numbers at 16; the answer's fields are at its first word
    let text = "(data (i32.const 8) \"k\\00\")
        (func (export \"km_own\") (param i32 i32) (local $field i32)
            (f64.store (i32.const 16) (f64.load (i32.load offset=4 (i32.load (local.get 0)))))
            (f64.store (i32.const 24) (f64.const 4))
            (local.set $field (i32.load (local.get 1)))
            (i32.store (local.get $field) (i32.const NAME))
            (i32.store offset=4 (local.get $field) (i32.const AT))
            (i32.store offset=12 (local.get $field) (i32.const COUNT))
            (i32.store offset=16 (local.get $field) (i32.const COLUMNS))
            (i32.store offset=4 (local.get 1) (i32.const 1)))";
    let answer = |name: &str, at: &str, count: &str, columns: &str| {
        let text = text
            .replace("NAME", name)
            .replace("AT)", &format!("{at})"))
            .replace("COUNT", count)
            .replace("COLUMNS", columns);
        let mut opening = opening(module(&text));
        opening.function = Some(asked("own"));
        let call = Call::Free {
            function: "own".into(),
            robot: None,
            given: vec![("x".into(), Value::Number(3.0))],
        };
        PluginController::open(&opening).ok().unwrap().call(&call)
    };
    let two = Value::List(vec![Value::Number(3.0), Value::Number(4.0)]);
    let named = Value::Map(vec![("k".into(), two.clone())]);
    assert_eq!(answer("8", "16", "2", "2").unwrap().value, named);
    assert_eq!(answer("0", "16", "2", "2").unwrap().value, two);
    assert_eq!(
        answer("0", "16", "1", "0").unwrap().value,
        Value::Number(3.0)
    );
    assert!(mistake(answer("8", "-8", "2", "2")).0.contains("outside"));
    assert!(mistake(answer("-8", "16", "2", "2")).0.contains("outside"));
    let (message, _) = mistake(answer("8", "16", "1001", "1001"));
    assert!(message.contains("more than 1000 numbers"), "{message}");
    assert!(
        mistake(answer("8", "16", "-1", "1"))
            .0
            .contains("more than")
    );
}

/// The first number of what is given, a number of the map, is the whole answer.
const OF_A_MAP: &str = "(func (export \"km_forward_kinematics\") (param i32 i32) (local $field i32)
    (f64.store (i32.const 16) (f64.load (i32.load offset=4 (i32.load (local.get 0)))))
    (local.set $field (i32.load (local.get 1)))
    (i32.store offset=4 (local.get $field) (i32.const 16))
    (i32.store offset=12 (local.get $field) (i32.const 1))
    (i32.store offset=4 (local.get 1) (i32.const 1)))";

#[test]
fn a_function_of_poses_is_given_a_map_under_the_usual_name() {
    let of_pose = Call::OfRobot {
        function: "forward_kinematics".into(),
        robot: robot(),
        given: vec![("a".into(), Value::Number(3.0))],
    };
    let mut opened = opening(module(OF_A_MAP));
    opened.function = Some(asked("forward_kinematics"));
    let answer = PluginController::open(&opened).ok().unwrap().call(&of_pose);
    assert_eq!(answer.unwrap().value, Value::Number(3.0));
    // a run of the same module asks for another function
    let run = format!(
        "{OF_A_MAP} {}",
        body("(f64.store (local.get 1) (f64.const 3))")
    );
    assert!(control(&run).is_ok());

    let usual = Call::ForwardKinematics {
        robot: robot(),
        q: vec![7.0, 8.0],
    };
    let refused = |stop: Stop| match stop {
        Stop::DidNotBuild(refusal) => format!("{refusal:?}"),
        other => panic!("{other:?}"),
    };
    let words = refused(call(module(OF_A_MAP), &usual).err().unwrap());
    assert!(
        words.contains("it is called as (i32, i32, i32) -> ()"),
        "{words}"
    );
    let positions = "(func (export \"km_forward_kinematics\") (param i32 i32 i32))";
    let mut opened = opening(module(positions));
    opened.function = Some(asked("forward_kinematics"));
    let words = refused(PluginController::open(&opened).err().unwrap());
    assert!(
        words.contains(
            "KM_EXPORT(km_forward_kinematics) void forward_kinematics(const km_map *given"
        ),
        "{words}"
    );
}

/// Two entries, written in the order `b`, `a`: the answer is that of a script, whose maps are sorted.
#[test]
fn entries_of_an_answer_are_sorted_by_name() {
    let entry = |at: u32, name: u32, number: u32| {
        format!(
            "(i32.store offset={at} (local.get $fields) (i32.const {name}))
             (i32.store offset={} (local.get $fields) (i32.const {number}))
             (i32.store offset={} (local.get $fields) (i32.const 1))",
            at + 4,
            at + 12
        )
    };
    let text = format!(
        "(data (i32.const 8) \"b\\00a\\00\")
         (func (export \"km_own\") (param i32 i32) (local $fields i32)
            (f64.store (i32.const 16) (f64.const 2)) (f64.store (i32.const 24) (f64.const 1))
            (local.set $fields (i32.load (local.get 1))) {} {}
            (i32.store offset=4 (local.get 1) (i32.const 2)))",
        entry(0, 8, 16),
        entry(20, 10, 24)
    );
    let mut opening = opening(module(&text));
    opening.function = Some(asked("own"));
    let call = Call::Free {
        function: "own".into(),
        robot: None,
        given: Vec::new(),
    };
    let answer = PluginController::open(&opening).ok().unwrap().call(&call);
    let wanted = [("a", 1.0), ("b", 2.0)].map(|(name, x)| (name.to_owned(), Value::Number(x)));
    assert_eq!(answer.unwrap().value, Value::Map(wanted.to_vec()));
}

#[test]
fn the_name_of_a_signal_has_a_length() {
    let plotted = |length: u32| {
        let text = format!(
            "(import \"kinemark\" \"plot\" (func $plot (param i32 i32 f64))) {}",
            body(&format!(
                "(call $plot (i32.const 4096) (i32.const {length}) (f64.const 1))"
            ))
        );
        control(&text)
    };
    assert_eq!(plotted(64).unwrap().said.plots.len(), 1);
    for length in [0, 65] {
        assert_eq!(
            mistake(plotted(length)).0,
            "the name of a signal has 1 to 64 characters"
        );
    }
}

#[test]
fn functions_of_math_have_the_bits_of_scripts() {
    for (name, wanted) in [("sin", libm::sin(0.3)), ("exp", libm::exp(0.3))] {
        let text = format!(
            "(import \"env\" \"{name}\" (func $f (param f64) (result f64))) {}",
            body(
                "(f64.store (local.get 1) (call $f (f64.const 0.3))) (f64.store offset=8 (local.get 1) (f64.const 0))"
            )
        );
        let answer = control(&text).unwrap();
        assert_eq!(numbers(&answer.value)[0].to_bits(), wanted.to_bits());
    }
}

#[test]
fn every_not_a_number_has_the_same_bits() {
    let bits = first(
        "(f64.sub (f64.reinterpret_i64 (i64.const 0x7ff0000000000000)) (f64.reinterpret_i64 (i64.const 0x7ff0000000000000)))",
    );
    assert_eq!(bits.to_bits(), 0x7ff8_0000_0000_0000);
}

#[test]
fn output_is_kept_up_to_its_budget() {
    let text = format!(
        "(import \"kinemark\" \"log\" (func $log (param i32 i32)))
         (import \"kinemark\" \"plot\" (func $plot (param i32 i32 f64)))
         (data (i32.const 8) \"hi\\ff\") {}",
        body(
            "(local $i i32) (call $plot (i32.const 8) (i32.const 2) (f64.const 4))
             (loop $more (call $log (i32.const 8) (i32.const 3))
                (local.set $i (i32.add (local.get $i) (i32.const 1)))
                (br_if $more (i32.lt_u (local.get $i) (i32.const 1005))))"
        )
    );
    let said = control(&text).unwrap().said;
    assert_eq!(said.plots, [("hi".to_owned(), 4.0)]);
    assert_eq!(said.log.len(), 1001);
    assert_eq!(said.log[0].text, "hi\u{fffd}");
    assert_eq!(
        said.log[1000].text,
        "more than 1000 lines are printed: the rest is not kept"
    );
    let long = text.replace("(i32.const 3))\n", "(i32.const 4001))\n");
    assert_ne!(long, text);
    let stop = control(&long).unwrap_err();
    assert!(
        matches!(
            stop,
            Stop::OverBudget {
                budget: Budget::TextSize,
                limit: 4000,
                ..
            }
        ),
        "{stop:?}"
    );
}

#[test]
fn a_trap_names_what_went_wrong_and_the_function() {
    for (helper, wanted) in [
        ("unreachable", "stops itself, in the function `helper`"),
        (
            "(drop (i32.load (i32.const -4)))",
            "reads or writes outside of its memory, in the function `helper`",
        ),
        (
            "(drop (i32.div_u (i32.const 1) (i32.const 0)))",
            "divides an integer by zero, in the function `helper`",
        ),
        (
            "(drop (i32.trunc_f64_s (f64.const nan)))",
            "converts a number that no integer can hold, in the function `helper`",
        ),
        (
            "(call_indirect (i32.const 0))",
            "calls a function pointer that is none, in the function `helper`",
        ),
        (
            "(call $fail (i32.const 8) (i32.const 2))",
            "no, in the function `helper`",
        ),
        (
            "(call $fail (i32.const 8) (i32.const -2))",
            "a string of more than",
        ),
        // after a helper has returned, its caller runs
        ("", "`km_control` stops itself"),
    ] {
        let text = format!(
            "(import \"kinemark\" \"fail\" (func $fail (param i32 i32))) (table 1 funcref)
             (data (i32.const 8) \"no\") (func $helper {helper}) {}",
            body("(call $helper) unreachable")
        );
        let message = match control(&text).unwrap_err() {
            Stop::Crashed(mistake) => mistake.message,
            Stop::OverBudget {
                budget, function, ..
            } => {
                assert_eq!(budget, Budget::TextSize);
                assert_eq!(function.as_deref(), Some("helper"));
                continue;
            }
            other => panic!("{other:?}"),
        };
        assert!(message.ends_with(wanted), "{helper}: {message}");
    }
}

#[test]
fn instructions_of_a_call_and_of_a_task_are_counted() {
    let endless = body("(loop $again (br $again))");
    let stop = control(&endless).unwrap_err();
    let Stop::OverBudget {
        budget,
        limit,
        function,
        ..
    } = stop
    else {
        panic!("{stop:?}");
    };
    assert_eq!((budget, limit), (Budget::InstructionsPerCall, 1_000_000));
    assert_eq!(function.as_deref(), Some("km_control"));

    let mut opening = opening(module(&body("")));
    opening.budgets.instructions_per_task = 1_000;
    let mut controller = PluginController::open(&opening).ok().unwrap();
    let mut calls = 0;
    let stop = loop {
        match controller.call(&Call::Control(observation())) {
            Ok(answer) => assert!(answer.operations > 0),
            Err(stop) => break stop,
        }
        calls += 1;
    };
    assert!(calls > 10, "{calls}");
    assert!(
        matches!(
            stop,
            Stop::OverBudget {
                budget: Budget::InstructionsPerTask,
                limit: 1_000,
                ..
            }
        ),
        "{stop:?}"
    );
}

#[test]
fn calls_inside_each_other_are_limited() {
    let text = format!("(func $deeper (call $deeper)) {}", body("(call $deeper)"));
    let stop = control(&text).unwrap_err();
    assert!(
        matches!(
            stop,
            Stop::OverBudget {
                budget: Budget::CallDepth,
                limit: 1_000,
                ..
            }
        ),
        "{stop:?}"
    );
}

#[test]
fn memory_grows_to_its_limit_and_no_further() {
    // 16 MiB are 256 pages, of which 2 are there
    assert_eq!(
        first("(f64.convert_i32_s (memory.grow (i32.const 254)))"),
        2.0
    );
    let (message, help) = mistake(control(&body("(drop (memory.grow (i32.const 255)))")));
    assert_eq!(
        message,
        "`km_control` wants more memory, or a larger table, than a module may have"
    );
    assert!(help.contains("16 MiB"), "{help}");
    // a module may have a smaller limit of its own, which it may handle
    let own = wat::parse_str(
        "(module (memory (export \"memory\") 2 3)
            (func (export \"km_version\") (result i32) (i32.add (memory.grow (i32.const 2)) (i32.const 2)))
            (func (export \"km_buffer\") (param i32) (result i32) i32.const 1024))",
    );
    assert!(PluginController::open(&opening(own.unwrap())).is_ok());
    let large = wat::parse_str(
        "(module (memory (export \"memory\") 257)
            (func (export \"km_version\") (result i32) i32.const 1)
            (func (export \"km_buffer\") (param i32) (result i32) i32.const 1024))",
    );
    assert_eq!(
        refusal(large.unwrap()),
        "the module begins with more memory than it may have: 16 MiB"
    );
    assert_eq!(
        refusal(module("(table 10001 funcref)")),
        "the module begins with more tables than it may have: 10000 elements each"
    );
    assert_eq!(
        refusal(module(&"(table 1 funcref) ".repeat(17))),
        "the module begins with more tables than it may have: 16"
    );
    assert_eq!(
        refusal(module(
            "(table 1 funcref) (func $f) (elem (i32.const 7) $f)"
        )),
        "the module fills a table beyond its end"
    );
}

#[test]
fn what_is_no_module_for_kinemark_does_not_build() {
    let buffer = "(func (export \"km_buffer\") (param i32) (result i32) i32.const 1024)";
    let version = "(func (export \"km_version\") (result i32) i32.const 1)";
    let gives = |at: i64| {
        let buffer = buffer.replace("1024", &at.to_string());
        with_ends(&format!("{version} {buffer}"), "")
    };
    let no_memory = wat::parse_str(format!("(module {buffer} {version})"));
    let mut cut = module("");
    cut.truncate(cut.len() - 3);
    for (bytes, wanted) in [
        (b"\0asm".to_vec(), "ends within the header"),
        (b"\0asm\x0d\0\x01\0".to_vec(), "component"),
        (b"\0asm\x02\0\0\0".to_vec(), "another version"),
        (cut, "the module is not valid"),
        (
            module("(func (result v128) (v128.const i64x2 0 0))"),
            "the module is not valid",
        ),
        (no_memory.unwrap(), "exports no memory named `memory`"),
        (
            with_ends(buffer, ""),
            "exports no function `km_version`, so it is not made for Kinemark",
        ),
        (with_ends(version, ""), "exports no function `km_buffer`"),
        (
            with_ends(
                &format!("{} {buffer}", version.replace("const 1", "const 2")),
                "",
            ),
            "made for version 2 of the interface, this is version 1",
        ),
        (gives(0), "`km_buffer` gives no room"),
        (gives(1028), "outside of the memory or no multiple of 8"),
        (gives(131_000), "outside of the memory or no multiple of 8"),
        (gives(-8), "outside of the memory or no multiple of 8"),
        (
            module("(import \"env\" \"sinn\" (func (param f64) (result f64)))"),
            "imports `env.sinn`, which is not there",
        ),
        (
            module("(import \"env\" \"sin\" (func (param f32) (result f32)))"),
            "imports `env.sin` as (f32) -> (f32), it is (f64) -> (f64)",
        ),
        (
            module("(import \"env\" \"table\" (table 1 funcref))"),
            "imports `env.table`, which is no function",
        ),
        (
            module(
                "(import \"wasi_snapshot_preview1\" \"fd_write\" (func (param i32 i32 i32 i32) (result i32)))",
            ),
            "imports `wasi_snapshot_preview1.fd_write`, which is not there",
        ),
        (
            module("(func (export \"km_control\") (param i32))"),
            "exports `km_control` as (i32) -> (), it is called as (i32, i32) -> ()",
        ),
        (
            module("(global (export \"kinemark: the function that runs\") i32 (i32.const 1))"),
            "the module has the name `kinemark: the function that runs`",
        ),
    ] {
        let message = refusal(bytes);
        assert!(message.contains(wanted), "{message}, not {wanted}");
    }
}

#[test]
fn a_start_function_has_the_budget_of_a_call() {
    let endless = module("(func $go (loop $again (br $again))) (start $go)");
    assert!(matches!(
        PluginController::open(&opening(endless)),
        Err(Stop::OverBudget {
            budget: Budget::InstructionsPerCall,
            ..
        })
    ));
    let trap = module("(func $go unreachable) (start $go)");
    assert!(matches!(
        PluginController::open(&opening(trap)),
        Err(Stop::Crashed(_))
    ));
}

#[test]
fn a_module_has_a_size() {
    let text = format!("(data \"{}\")", "a".repeat(262_144));
    assert!(matches!(
        PluginController::open(&opening(module(&text))),
        Err(Stop::OverBudget {
            budget: Budget::ModuleBytes,
            limit: 262_144,
            ..
        })
    ));
}

#[test]
fn a_function_that_is_missing_is_named_with_what_is_there() {
    let missing = |text: &str| match control(text).unwrap_err() {
        Stop::Missing { function, help, .. } => (function, help.unwrap_or_default()),
        other => panic!("{other:?}"),
    };
    let (function, help) = missing("(func (export \"control\") (param i32 i32))");
    assert_eq!(function, "km_control(observation, command)");
    assert_eq!(help, "the module exports `control`: call it `km_control`");
    let (_, help) = missing("(func (export \"km_controll\") (param i32 i32))");
    assert_eq!(
        help,
        "the module exports `km_controll`: call it `km_control`"
    );
    assert!(missing("").1.starts_with("export it: in C define"));
    // what another task asks for is no slip of this one
    let (_, help) = missing("(func (export \"km_init\") (param i32 i32))");
    assert!(help.starts_with("export it"), "{help}");
}

#[test]
fn functions_that_are_not_granted_say_so() {
    let text = format!(
        "(import \"kinemark\" \"fk\" (func $fk (param i32 i32))) {}",
        body("(call $fk (i32.const 8) (i32.const 16))")
    );
    let (message, _) = mistake(control(&text));
    assert_eq!(
        message,
        "`fk` of the robot's model is not granted in this task"
    );
}

#[test]
fn names_that_cannot_be_read_are_no_names() {
    // a name section with a length beyond its end
    let mut bytes = module(&body("unreachable"));
    bytes.extend([0, 7, 4, b'n', b'a', b'm', b'e', 1, 200]);
    assert_eq!(
        mistake(call(bytes, &Call::Control(observation()))).0,
        "`km_control` stops itself"
    );
}
