//! What a call of a student's script costs: a ten-line control call, its observation built and its answer converted.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use kinemark_grader::submission::controller::{
    Budgets, Call, Controller, Observation, Opening, RobotFacts, Value,
};
use kinemark_grader::submission::handed_in::Program;
use kinemark_grader::submission::rhai::ScriptController;

/// PD control along a quintic, written as a student would.
const SCALARS: &str = r#"
const START = [0.0, 0.0];
const GOAL = [1.2, -0.8];
const DURATION = 2.0;

fn control(observation) {
    let s = quintic(observation.time / DURATION);
    let q = observation.q;
    let qd = observation.qd;
    let e0 = START[0] + (GOAL[0] - START[0]) * s - q[0];
    let e1 = START[1] + (GOAL[1] - START[1]) * s - q[1];
    let u0 = 100 * e0 - 10 * qd[0];
    let u1 = 60 * e1 - 6 * qd[1];
    u0 = clamp(u0, -30, 30);
    u1 = clamp(u1, -15, 15);
    return [u0, u1];
}
"#;

/// The same with vectors.
const VECTORS: &str = r#"
const START = vector([0.0, 0.0]);
const GOAL = vector([1.2, -0.8]);
const KP = vector([100, 60]);
const KD = vector([10, 6]);
const LIMIT = vector([30, 15]);

fn control(observation) {
    let s = quintic(observation.time / 2.0);
    let wanted = lerp(START, GOAL, s);
    let e = wanted - observation.q;
    let u = KP * e - KD * observation.qd;
    this.largest = max(this.largest, norm(e));
    plot("error", norm(e));
    if observation.time > 2.5 {
        u = u * 0.5;
    }
    return clamp(u, -LIMIT, LIMIT);
}

fn init(robot, task) {
    this.largest = 0;
}
"#;

/// A function that returns what it is given: the cost of a call alone.
const NOTHING: &str = "fn control(observation) { observation.q }";

fn opening(source: &str) -> Opening {
    Opening {
        file: "submission.rhai".into(),
        program: Program::Script(source.into()),
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
            // a benchmark goes on for longer than a task
            operations_per_task: u64::MAX,
            plot_samples: u64::MAX,
            ..Budgets::default()
        },
        granted: None,
        function: None,
    }
}

fn benches(criterion: &mut Criterion) {
    let observation = Observation {
        tick: 100,
        time_s: 0.1,
        dt_s: 0.01,
        q: vec![0.1, -0.2],
        qd: vec![0.5, 0.25],
        effort: vec![1.0, 2.0],
        tcp_m: [4.0, 0.1, 0.0],
        sensors: Vec::new(),
    };
    let mut group = criterion.benchmark_group("script");
    for (name, source) in [
        ("nothing", NOTHING),
        ("scalars", SCALARS),
        ("vectors", VECTORS),
    ] {
        let mut script = ScriptController::open(&opening(source)).expect("the script builds");
        script.call(&Call::Init).expect("init runs");
        let call = Call::Control(observation.clone());
        group.bench_function(name, |bencher| {
            bencher.iter(|| script.call(black_box(&call)).expect("control runs"));
        });
    }
    group.bench_function("open", |bencher| {
        let opening = opening(VECTORS);
        bencher.iter(|| ScriptController::open(black_box(&opening)).is_ok());
    });
    group.finish();
}

criterion_group!(script, benches);
criterion_main!(script);
