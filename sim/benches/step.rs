//! The loops of a run: dynamics alone, the step with its servo, and the whole with trace and digest.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use kinemark_sim::control::{Derivative, Gains, Mode, ServoSettings};
use kinemark_sim::dynamics::ForwardDynamics;
use kinemark_sim::dynamics::GRAVITY_M_S2;
use kinemark_sim::format::RobotFile;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::run::{Recorder, Row, Setup, run};
use kinemark_sim::text::Source;
use kinemark_sim::ticks::Periods;
use kinemark_sim::trace::TraceRecorder;

const TICKS: u64 = 8000;

fn rrbot() -> Robot {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../labs/robots/rrbot.toml");
    let text = std::fs::read_to_string(path).expect("rrbot.toml");
    let file = RobotFile::parse(Source::new("rrbot.toml", text)).expect("readable");
    file.build(&[]).expect("a robot")
}

fn setup(robot: &Robot, gravity_compensation: bool) -> Setup<'_> {
    let gains = Gains {
        kp: 100.0,
        ki: 0.0,
        kd: 10.0,
        effort_limit: 30.0,
        integral_limit: f64::INFINITY,
    };
    Setup {
        robot,
        scene: None,
        tcp: robot.tcp(),
        seen_from: robot.frame("lab").expect("lab"),
        periods: Periods::new(0.001, 0.001, 0.01).expect("periods"),
        gravity_m_s2: GRAVITY_M_S2,
        servo: ServoSettings {
            mode: Mode::Position,
            derivative: Derivative::Velocity,
            gains: vec![gains; 2],
            gravity_compensation,
        },
        sensors: Vec::new(),
        start_q: vec![0.0; 2],
        start_qd: vec![0.0; 2],
        laws: None,
        pushes: Vec::new(),
        ticks: TICKS,
    }
}

/// Keeps the last row only.
struct Last(f64);

impl Recorder for Last {
    fn row(&mut self, row: Row<'_>) {
        self.0 = row.q[0];
    }
}

fn wave(observation: &kinemark_sim::run::Observation<'_>, command: &mut [f64]) -> Result<(), ()> {
    command[0] = libm::sin(observation.time_s);
    command[1] = libm::cos(2.0 * observation.time_s);
    Ok(())
}

fn step(c: &mut Criterion) {
    let robot = rrbot();
    let mut group = c.benchmark_group("rr arm");
    group.bench_function("aba", |b| {
        let mut aba = ForwardDynamics::new(&robot);
        let mut qdd = [0.0; 2];
        b.iter(|| {
            aba.acceleration(
                &robot,
                &GRAVITY_M_S2,
                black_box(&[0.3, -1.2]),
                black_box(&[0.5, 0.7]),
                black_box(&[1.0, 2.0]),
                &mut qdd,
            )
        });
    });
    group.throughput(Throughput::Elements(TICKS));
    group.sample_size(30);
    for (name, compensation) in [("rk4 and servo", false), ("rk4, servo, gravity", true)] {
        let setup = setup(&robot, compensation);
        group.bench_function(name, |b| {
            b.iter(|| {
                let mut last = Last(0.0);
                run(&setup, wave, &mut last).expect("runs");
                last.0
            });
        });
    }
    let setup = setup(&robot, false);
    group.bench_function("rk4, servo, trace, digest", |b| {
        b.iter(|| {
            let mut recorder = TraceRecorder::new(&setup);
            run(&setup, wave, &mut recorder).expect("runs");
            recorder.finish().digest()
        });
    });
    group.finish();
}

criterion_group!(benches, step);
criterion_main!(benches);
