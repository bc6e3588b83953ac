//! The step in a scene: free, pushing, a can knocked off its shelf, a can that rolls.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use kinemark_sim::control::{Derivative, Gains, Mode, Servo, ServoSettings};
use kinemark_sim::dynamics::GRAVITY_M_S2;
use kinemark_sim::format::RobotFile;
use kinemark_sim::format::SceneFile;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::Scene;
use kinemark_sim::spatial::{Twist, pose, rotation_about_axis_deg};
use kinemark_sim::step::hybrid::{HybridStep, StateFrom};
use kinemark_sim::text::Source;
use nalgebra::Vector3;

const DT_S: f64 = 1e-3;

fn read(path: &str) -> Source {
    let path = format!("{}/../labs/{path}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).expect(&path);
    Source::new(path, text)
}

fn rrbot() -> Robot {
    let file = RobotFile::parse(read("robots/rrbot.toml")).expect("readable");
    file.build(&[]).expect("a robot")
}

fn shelf_and_can() -> Scene {
    let file = SceneFile::parse(read("scenes/shelf-and-can.toml")).expect("readable");
    file.build(&[]).expect("a scene")
}

/// The can alone, on its side on the ground, rolling along y.
fn rolling() -> Scene {
    let mut scene = shelf_and_can();
    scene.bodies.retain(|body| body.name == "can");
    let can = &mut scene.bodies[0];
    let lying = rotation_about_axis_deg(Vector3::y(), 90.0);
    can.world_from_body = pose(lying, Vector3::new(1.5, 0.0, 0.033));
    can.twist = Twist {
        linear: Vector3::new(0.0, 0.5, 0.0),
        angular: Vector3::new(-0.5 / 0.033, 0.0, 0.0),
    };
    scene
}

fn step(robot: &Robot, scene: &Scene) -> HybridStep {
    HybridStep::new(robot, scene, GRAVITY_M_S2, DT_S).expect("a scene")
}

/// Elbow outwards, the tip at `x` up and `y` sideways in the lab's frame.
fn reach(x: f64, y: f64) -> [f64; 2] {
    let up = x - 2.0;
    let q2 = libm::acos((up * up + y * y - 2.0) / 2.0);
    let q1 = libm::atan2(y, up) - libm::atan2(libm::sin(q2), 1.0 + libm::cos(q2));
    [q1, q2]
}

fn servo(robot: &Robot, mode: Mode, gains: [f64; 3], limits: [f64; 2]) -> Servo {
    let [kp, ki, kd] = gains;
    let gains = limits.map(|effort_limit| Gains {
        kp,
        ki,
        kd,
        effort_limit,
        integral_limit: f64::INFINITY,
    });
    let settings = ServoSettings {
        mode,
        derivative: Derivative::Measurement,
        gains: gains.to_vec(),
        gravity_compensation: true,
    };
    Servo::new(robot, settings, DT_S, GRAVITY_M_S2).expect("settings")
}

/// Moves to `goal` and stays, `steps` long; says how many steps were in contact.
fn hold(
    robot: &Robot,
    hybrid: &mut HybridStep,
    q: &mut [f64; 2],
    qd: &mut [f64; 2],
    goal: [f64; 2],
    steps: u64,
) -> u64 {
    let mut servo = servo(robot, Mode::Position, [300.0, 0.0, 20.0], [60.0; 2]);
    let mut effort = [0.0; 2];
    let mut pressed = 0;
    for _ in 0..steps {
        servo.sample(robot, &goal, q, qd, &mut effort);
        let report = hybrid.advance(robot, &effort, q, qd).expect("a step");
        pressed += u64::from(report.state_from == StateFrom::Contact);
    }
    pressed
}

/// The sweep of lab 4, 8 s at 1 ms: down beside the shelf in 2 s, across it in 2 s, the can falls, the arm waits. Says how low the
/// can ends.
fn sweep(robot: &Robot, scene: &Scene) -> f64 {
    let wanted = |t_s: f64| {
        let down = (t_s / 2.0).min(1.0);
        let across = ((t_s - 2.0) / 2.0).clamp(0.0, 1.0);
        reach(2.0 - 0.75 * down, 1.4 - 0.8 * across)
    };
    let mut hybrid = step(robot, scene);
    let mut servo = servo(robot, Mode::Velocity, [20.0, 50.0, 0.0], [30.0, 15.0]);
    let (mut q, mut qd) = (wanted(0.0), [0.0; 2]);
    let (mut command, mut effort) = ([0.0; 2], [0.0; 2]);
    for tick in 0..8000 {
        if tick % 10 == 0 {
            let t_s = f64::from(tick) * DT_S;
            let (here, next) = (wanted(t_s), wanted(t_s + 0.01));
            command = [0, 1].map(|i| (next[i] - here[i]) / 0.01 + 5.0 * (here[i] - q[i]));
        }
        servo.sample(robot, &command, &q, &qd, &mut effort);
        hybrid
            .advance(robot, &effort, &mut q, &mut qd)
            .expect("a step");
    }
    hybrid.body(1).world_from_body.translation.vector.z
}

fn contact(c: &mut Criterion) {
    let robot = rrbot();
    let scene = shelf_and_can();
    let mut group = c.benchmark_group("contact");
    group.sample_size(20);

    group.throughput(Throughput::Elements(1000));
    let mut resting = step(&robot, &scene);
    let (mut q, mut qd) = (reach(1.6, 1.2), [0.0; 2]);
    hold(&robot, &mut resting, &mut q, &mut qd, reach(1.6, 1.2), 1000);
    group.bench_function("free", |b| {
        b.iter(|| hold(&robot, &mut resting, &mut q, &mut qd, reach(1.5, 1.3), 1000));
    });

    let mut pushing = step(&robot, &scene);
    let (mut q, mut qd) = (reach(1.0, 0.85), [0.0; 2]);
    let goal = reach(1.0, 0.95);
    hold(&robot, &mut pushing, &mut q, &mut qd, goal, 1000);
    group.bench_function("push", |b| {
        b.iter(|| {
            let pressed = hold(&robot, &mut pushing, &mut q, &mut qd, goal, 1000);
            assert_eq!(pressed, 1000);
        });
    });

    group.throughput(Throughput::Elements(2000));
    let rolling = rolling();
    group.bench_function("roll", |b| {
        b.iter(|| {
            let mut hybrid = step(&robot, &rolling);
            let (mut q, mut qd) = ([0.0; 2], [0.0; 2]);
            hold(&robot, &mut hybrid, &mut q, &mut qd, [0.0; 2], 2000)
        });
    });

    group.throughput(Throughput::Elements(8000));
    group.bench_function("sweep", |b| {
        b.iter(|| {
            let low_m = sweep(&robot, &scene);
            assert!(low_m < 0.1, "the can ends at {low_m} m");
        });
    });
    group.finish();
}

criterion_group!(benches, contact);
criterion_main!(benches);
