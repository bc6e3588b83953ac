//! What a submission in Python costs: its start, ten lines of `control`, and a case of a function task.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use kinemark_grader::submission::controller::{
    Budgets, Call, Controller, Observation, Opening, RobotFacts, Value,
};
use kinemark_grader::submission::handed_in::Program;
use kinemark_grader::submission::python::PythonController;

/// PD control along a quintic, written as a student would.
const SCALARS: &str = r#"
START = [0.0, 0.0]
GOAL = [1.2, -0.8]
DURATION = 2.0


def control(observation):
    s = min(max(observation.time / DURATION, 0.0), 1.0)
    s = s**3 * (10 - 15 * s + 6 * s**2)
    q = observation.q
    qd = observation.qd
    e0 = START[0] + (GOAL[0] - START[0]) * s - q[0]
    e1 = START[1] + (GOAL[1] - START[1]) * s - q[1]
    u0 = 100 * e0 - 10 * qd[0]
    u1 = 60 * e1 - 6 * qd[1]
    u0 = min(max(u0, -30), 30)
    u1 = min(max(u1, -15), 15)
    return [u0, u1]
"#;

/// The same with arrays.
const VECTORS: &str = r#"
import numpy as np

START = np.zeros(2)
GOAL = np.array([1.2, -0.8])
KP = np.array([100, 60])
KD = np.array([10, 6])
LIMIT = np.array([30, 15])


def control(observation):
    s = quintic(observation.time / 2.0)
    wanted = START + s * (GOAL - START)
    e = wanted - observation.q
    u = KP * e - KD * observation.qd
    plot("error", np.linalg.norm(e))
    if observation.time > 2.5:
        u = u * 0.5
    return np.clip(u, -LIMIT, LIMIT)
"#;

const CASE: &str = "from math import cos, sin\n\n\ndef forward_kinematics(robot, q):\n    return [cos(q[0]), sin(q[0]), robot.base_height]\n";

const NOTHING: &str = "def control(observation):\n    return observation.q\n";

fn robot() -> RobotFacts {
    RobotFacts {
        name: "rrbot".into(),
        joint_names: vec!["shoulder".into(), "elbow".into()],
        dimensions: vec![("base_height".into(), Value::Number(2.0))],
        lower: vec![-6.3; 2],
        upper: vec![6.3; 2],
        effort: vec![30.0, 15.0],
    }
}

fn opening(source: &str) -> Opening {
    Opening {
        file: "submission.py".into(),
        program: Program::Python(source.into()),
        task: "move".into(),
        robot: robot(),
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
    let control = Call::Control(Observation {
        tick: 100,
        time_s: 0.1,
        dt_s: 0.01,
        q: vec![0.1, -0.2],
        qd: vec![0.5, 0.25],
        effort: vec![1.0, 2.0],
        tcp_m: [4.0, 0.1, 0.0],
        tcp_rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        sensors: Vec::new(),
    });
    let mut group = criterion.benchmark_group("python");
    for (name, source) in [
        ("nothing", NOTHING),
        ("scalars", SCALARS),
        ("vectors", VECTORS),
    ] {
        let mut file = PythonController::open(&opening(source)).expect("the file runs");
        group.bench_function(name, |bencher| {
            bencher.iter(|| file.call(black_box(&control)).expect("control runs"));
        });
    }
    group.bench_function("open and first call", |bencher| {
        let opening = opening(VECTORS);
        bencher.iter(|| {
            let mut file = PythonController::open(black_box(&opening)).expect("the file runs");
            file.call(&control).expect("control runs")
        });
    });
    group.bench_function("case", |bencher| {
        let mut file = PythonController::open(&opening(CASE)).expect("the file runs");
        let case = Call::ForwardKinematics {
            robot: robot(),
            q: vec![0.1, 0.2],
        };
        bencher.iter(|| file.call(black_box(&case)).expect("an answer"));
    });
    group.finish();
}

criterion_group!(python, benches);
criterion_main!(python);
