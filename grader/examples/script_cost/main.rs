//! What a counted operation of a script takes at most: a list of statements, each in a loop until the budget ends it. Prints those that
//! take more than ten times as long per operation as an addition, and the files that take longest to be read.
//!
//! `cargo run --release -p kinemark-grader --example script_cost [-- --all | WORD]`; docs/performance.md says more.

#![expect(clippy::print_stdout, reason = "it reports to a person")]

mod files;
mod statements;

use std::time::Duration;

use kinemark_grader::submission::controller::{
    Budget, Budgets, Call, Controller, Observation, Opening, RobotFacts, Stop, Value,
};
use kinemark_grader::submission::handed_in::Program;
use kinemark_grader::submission::rhai::{STACK_BYTES, ScriptController};

use files::files;
use statements::{Statement, statements};

/// Operations of a measurement.
const OPERATIONS: u64 = 20_000;

/// Measurements of a statement.
const TIMES: usize = 12;

/// The most that an operation may take, in operations of the baseline.
const MOST: f64 = 10.0;

/// The longest that reading a file may take.
const LONGEST_TO_READ: Duration = Duration::from_secs(1);

impl Statement {
    /// Time of an operation, or why there is none: that of what comes before the loop is taken off.
    fn time(&self) -> Result<Duration, String> {
        let script = |rest: &str, budget| {
            let source = format!(
                "{} fn control(o) {{ {}\n{rest} }}",
                self.functions, self.before
            );
            ScriptController::open(&opening(source, budget))
                .map_err(|stop| format!("does not open: {stop:?}"))
        };
        let call = Call::Control(observation());
        let mut setup = script("1", u64::MAX)?;
        let (of_setup, answer) = timed(|| setup.call(&call));
        let before = answer.map_err(|stop| format!("does not begin: {stop:?}"))?;
        let mut whole = script(
            &format!("loop {{ {} }}", self.repeated),
            before.operations + OPERATIONS,
        )?;
        let (of_whole, result) = timed(|| whole.call(&call));
        match result {
            Err(Stop::OverBudget {
                budget: Budget::OperationsPerCall,
                ..
            }) => Ok(of_whole.saturating_sub(of_setup) / OPERATIONS as u32),
            other => Err(format!("ends otherwise: {other:?}")),
        }
    }

    /// The least of some times, because other programs only ever add to it.
    fn least_time(&self) -> Result<Duration, String> {
        let first = self.time()?;
        let others = (1..TIMES).filter_map(|_| self.time().ok());
        Ok(others.fold(first, Duration::min))
    }
}

#[expect(clippy::disallowed_methods, reason = "it measures time")]
fn timed<T>(work: impl FnOnce() -> T) -> (Duration, T) {
    let start = std::time::Instant::now();
    let result = work();
    (start.elapsed(), result)
}

fn main() {
    // the engine is recursive
    let thread = std::thread::Builder::new().stack_size(STACK_BYTES);
    let measured = thread.spawn(report).expect("a thread").join();
    measured.expect("no panic");
}

fn report() {
    let word = std::env::args().nth(1);
    let all = word.as_deref() == Some("--all");
    let only = word.filter(|_| !all);
    let is_wanted = |name: &str| only.as_deref().is_none_or(|word| name.contains(word));
    let is_shown = all || only.is_some();
    let statements = statements();
    let baseline = statements[0].least_time().expect("the baseline runs");
    println!(
        "{} statements; an operation of `a + 1.0` takes {baseline:?}",
        statements.len()
    );
    for statement in &statements {
        let name = statement.name();
        if !is_wanted(&name) {
            continue;
        }
        match statement.least_time() {
            Err(why) => println!("   ?   {name}: {why:.300}"),
            Ok(time) => {
                let ratio = time.as_secs_f64() / baseline.as_secs_f64();
                if is_shown || ratio > MOST {
                    println!("{ratio:6.1} {name}");
                }
            }
        }
    }
    for (name, source) in files() {
        if !is_wanted(&name) {
            continue;
        }
        let bytes = source.len();
        let opening = opening(source, u64::MAX);
        let (took, result) = timed(|| ScriptController::open(&opening).map(|_| ()));
        if is_shown || took > LONGEST_TO_READ {
            let end = match result {
                Ok(()) => "read".to_owned(),
                Err(stop) => format!("{stop:?}").chars().take(60).collect(),
            };
            println!("{:6} ms {name} ({bytes} bytes): {end}", took.as_millis());
        }
    }
}

fn opening(source: String, operations_per_call: u64) -> Opening {
    Opening {
        file: "submission.rhai".into(),
        program: Program::Script(source),
        task: "move".into(),
        robot: RobotFacts {
            name: "rrbot".into(),
            joint_names: vec!["shoulder".into(), "elbow".into()],
            dimensions: vec![("base_height".into(), Value::Number(2.0))],
            lower: vec![-6.3; 2],
            upper: vec![6.3; 2],
            effort: vec![30.0, 15.0],
        },
        target: Value::List([2.0, 1.4, 0.0].map(Value::Number).to_vec()),
        sensors: Vec::new(),
        budgets: Budgets {
            operations_per_call,
            operations_per_task: u64::MAX,
            ..Budgets::default()
        },
        granted: None,
        function: None,
    }
}

fn observation() -> Observation {
    Observation {
        tick: 100,
        time_s: 0.1,
        dt_s: 0.01,
        q: vec![0.1, -0.2],
        qd: vec![0.5, 0.25],
        effort: vec![1.0, 2.0],
        tcp_m: [4.0, 0.1, 0.0],
        tcp_rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        sensors: Vec::new(),
    }
}
