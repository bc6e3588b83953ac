//! What a call of a submission costs: a ten-line control call of a script and of a module, its observation built and its answer
//! converted.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use kinemark_grader::submission::controller::{
    Budgets, Call, Controller, Observation, Opening, RobotFacts, Value,
};
use kinemark_grader::submission::handed_in::Program;
use kinemark_grader::submission::plugin::PluginController;
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

/// `SCALARS` as a compiler makes a module of it.
const MODULE: &str = r#"(module
  (memory (export "memory") 2)
  (func (export "km_version") (result i32) (i32.const 1))
  (func (export "km_buffer") (param i32) (result i32) (i32.const 1024))
  (func $clamp (param $x f64) (param $most f64) (result f64)
    (f64.min (f64.max (local.get $x) (f64.neg (local.get $most))) (local.get $most)))
  (func $joint (param $at i32) (param $q i32) (param $qd i32) (param $s f64) (param $goal f64) (param $kp f64) (param $kd f64)
      (param $most f64) (result f64)
    (call $clamp
      (f64.sub
        (f64.mul (local.get $kp)
          (f64.sub (f64.mul (local.get $goal) (local.get $s)) (f64.load (i32.add (local.get $q) (local.get $at)))))
        (f64.mul (local.get $kd) (f64.load (i32.add (local.get $qd) (local.get $at)))))
      (local.get $most)))
  (func (export "km_control") (param $observation i32) (param $command i32)
    (local $s f64) (local $q i32) (local $qd i32)
    (local.set $s (f64.min (f64.const 1) (f64.max (f64.const 0)
      (f64.div (f64.load offset=8 (local.get $observation)) (f64.const 2)))))
    (local.set $s (f64.mul
      (f64.mul (local.get $s) (f64.mul (local.get $s) (local.get $s)))
      (f64.add (f64.const 10) (f64.mul (local.get $s) (f64.sub (f64.mul (f64.const 6) (local.get $s)) (f64.const 15))))))
    (local.set $q (i32.load offset=28 (local.get $observation)))
    (local.set $qd (i32.load offset=32 (local.get $observation)))
    (f64.store (local.get $command)
      (call $joint (i32.const 0) (local.get $q) (local.get $qd) (local.get $s)
        (f64.const 1.2) (f64.const 100) (f64.const 10) (f64.const 30)))
    (f64.store offset=8 (local.get $command)
      (call $joint (i32.const 8) (local.get $q) (local.get $qd) (local.get $s)
        (f64.const -0.8) (f64.const 60) (f64.const 6) (f64.const 15)))))"#;

fn opening(source: &str) -> Opening {
    opening_of(Program::Script(source.into()))
}

fn opening_of(program: Program) -> Opening {
    Opening {
        file: "submission".into(),
        program,
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
            instructions_per_task: u64::MAX,
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
        tcp_rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
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

    let mut group = criterion.benchmark_group("module");
    let bytes = wat::parse_str(MODULE).expect("a module");
    let opening = opening_of(Program::Module(bytes));
    let mut module = PluginController::open(&opening).expect("the module builds");
    module.call(&Call::Init).expect("init runs");
    let call = Call::Control(observation.clone());
    group.bench_function("scalars", |bencher| {
        bencher.iter(|| module.call(black_box(&call)).expect("control runs"));
    });
    group.bench_function("open", |bencher| {
        bencher.iter(|| PluginController::open(black_box(&opening)).is_ok());
    });
    group.finish();
}

criterion_group!(script, benches);
criterion_main!(script);
