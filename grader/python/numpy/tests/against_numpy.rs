//! Runs every program of `tests/programs` in the interpreter, and compares with what real numpy gives: with the committed answers, or, when the
//! environment variable `KINEMARK_NUMPY` is the path of a Python that has numpy, with its answers now. `KINEMARK_PROGRAM` is the path of one more
//! program to compare, with its answers in a .json file beside it.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::float_cmp,
    reason = "a test may stop and say what it did"
)]

use rustpython_vm::{
    Interpreter, PyObjectRef, VirtualMachine,
    builtins::{PyDictRef, PyTuple},
    compiler::Mode,
    scope::Scope,
};
use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

#[derive(serde::Deserialize)]
struct Answers {
    results: Vec<Answer>,
}

#[derive(serde::Deserialize)]
struct Answer {
    structure: String,
    numbers: Vec<String>,
    sentence: String,
}

struct Case {
    line: usize,
    text: String,
    block: String,
    expression: String,
    compare_sentence: bool,
}

fn cases(program: &str) -> Vec<Case> {
    let mut cases = Vec::new();
    let mut block = Vec::new();
    for (place, line) in program.lines().enumerate() {
        if let Some(statement) = line.strip_prefix("| ") {
            block.push(statement.to_owned());
            continue;
        }
        if line.trim().is_empty() || line.starts_with('#') {
            continue;
        }
        let (code, remark) = line.split_once("  # ").unwrap_or((line, ""));
        let mut statements: Vec<String> = code
            .trim()
            .split(';')
            .map(|part| part.trim().to_owned())
            .collect();
        let expression = statements.pop().unwrap_or_default();
        block.extend(statements);
        cases.push(Case {
            line: place + 1,
            text: line.to_owned(),
            block: std::mem::take(&mut block).join("\n"),
            expression,
            compare_sentence: remark.contains("sentence"),
        });
    }
    cases
}

fn programs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/programs")
}

fn answers(path: &Path) -> Answers {
    let text = match std::env::var_os("KINEMARK_NUMPY") {
        Some(python) => {
            let output = Command::new(python)
                .arg(programs().join("expected.py"))
                .arg(path)
                .output()
                .expect("KINEMARK_NUMPY is no program");
            assert!(
                output.status.success(),
                "{}",
                String::from_utf8_lossy(&output.stderr)
            );
            String::from_utf8(output.stdout).unwrap()
        }
        None => fs::read_to_string(path.with_extension("json"))
            .expect("run expected.py with a Python that has numpy"),
    };
    serde_json::from_str(&text).unwrap()
}

fn interpreter() -> Interpreter {
    let interpreter = Interpreter::builder(Default::default()).build();
    interpreter.enter(|vm| {
        kinemark_python_numpy::install(vm)
            .map_err(|error| show(&error.into(), vm))
            .unwrap()
    });
    interpreter
}

fn show(object: &PyObjectRef, vm: &VirtualMachine) -> String {
    object.repr(vm).map_or_else(
        |_| "?".to_owned(),
        |text| text.to_string_lossy().into_owned(),
    )
}

fn close(left: f64, right: f64) -> bool {
    left == right
        || (left.is_nan() && right.is_nan())
        || (left - right).abs() <= 1e-12 * left.abs().max(right.abs()).max(1.0)
}

fn number(text: &str) -> f64 {
    text.parse()
        .unwrap_or_else(|_| panic!("{text} is no number"))
}

/// What the interpreter makes of a case: structure, numbers, sentence.
fn found(case: &Case, names: &PyDictRef, vm: &VirtualMachine) -> (String, Vec<f64>, String) {
    let run = names.get_item("run", vm).unwrap();
    let arguments = (
        vm.ctx.new_str(case.block.as_str()),
        vm.ctx.new_str(case.expression.as_str()),
    );
    let result = run.call(arguments, vm).unwrap_or_else(|error| {
        panic!(
            "line {}: {}: {}",
            case.line,
            case.text,
            show(&error.into(), vm)
        )
    });
    let parts = result.downcast_ref::<PyTuple>().unwrap().as_slice();
    let text = |object: &PyObjectRef| object.str(vm).unwrap().to_string_lossy().into_owned();
    let numbers = parts[1].clone().try_to_value(vm).unwrap();
    (text(&parts[0]), numbers, text(&parts[2]))
}

fn check(name: &str) {
    check_file(&programs().join(name));
}

#[test]
fn the_program_that_is_asked_for() {
    if let Some(path) = std::env::var_os("KINEMARK_PROGRAM") {
        check_file(Path::new(&path));
    }
}

fn check_file(path: &Path) {
    let cases = cases(&fs::read_to_string(path).unwrap());
    let answers = answers(path).results;
    assert_eq!(cases.len(), answers.len(), "run expected.py again");
    let mut wrong = Vec::new();
    interpreter().enter(|vm| {
        let names = vm.ctx.new_dict();
        let scope = Scope::with_builtins(None, names.clone(), vm);
        let driver = fs::read_to_string(programs().join("driver.py")).unwrap();
        let code = vm.compile(&driver, Mode::Exec, "driver.py".to_owned()).unwrap();
        vm.run_code_obj(code, scope).map_err(|error| show(&error.into(), vm)).unwrap();
        for (case, answer) in cases.iter().zip(&answers) {
            let (structure, numbers, sentence) = found(case, &names, vm);
            let expected: Vec<f64> = answer.numbers.iter().map(|text| number(text)).collect();
            let same = structure == answer.structure
                && numbers.len() == expected.len()
                && numbers.iter().zip(&expected).all(|(left, right)| close(*left, *right))
                && (!case.compare_sentence || sentence == answer.sentence);
            if !same {
                wrong.push(format!(
                    "line {}: {}\n  here  {structure} {numbers:?} {sentence}\n  numpy {} {expected:?} {}",
                    case.line, case.text, answer.structure, answer.sentence
                ));
            }
        }
    });
    println!("{}: {} cases", path.display(), cases.len());
    assert!(
        wrong.is_empty(),
        "{} of {} differ:\n{}",
        wrong.len(),
        cases.len(),
        wrong.join("\n")
    );
}

macro_rules! programs {
    ($($name:ident),*) => {
        $(
            #[test]
            fn $name() {
                check(concat!(stringify!($name), ".py"));
            }
        )*

        #[test]
        fn every_program_is_a_test() {
            let mut known = vec!["driver.py", "expected.py", $(concat!(stringify!($name), ".py")),*];
            known.sort_unstable();
            let mut found: Vec<String> = fs::read_dir(programs())
                .unwrap()
                .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
                .filter(|name| name.ends_with(".py"))
                .collect();
            found.sort_unstable();
            assert_eq!(known, found);
        }
    };
}

programs!(
    construct,
    operators,
    indexing,
    reductions,
    functions,
    linear,
    mathematics,
    printing,
    errors,
    habits
);
