//! The algorithms on robots that peers publish figures for: `cargo bench -p kinemark-sim --bench algorithms`.
//!
//! Each loop runs over 64 states and allocates nothing. The Jacobian is computed from fresh forward kinematics of its chain.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use kinemark_sim::dynamics::crba::Crba;
use kinemark_sim::dynamics::rnea::Rnea;
use kinemark_sim::dynamics::{ForwardDynamics, GRAVITY_M_S2};
use kinemark_sim::format::{ReadOptions, detect};
use kinemark_sim::kinematics::FramePoses;
use kinemark_sim::kinematics::chain::Chain;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Source;
use nalgebra::DMatrix;

const STATES: usize = 64;

fn robot(name: &str) -> Robot {
    let path = format!(
        "{}/../tests/golden/models/{name}.urdf",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(&path).expect(&path);
    // every joint counts, as for the peer
    let options = ReadOptions {
        ignore_mimic: true,
        ..ReadOptions::default()
    };
    let source = Source::new(path, text);
    (detect(&source).read)(source, &options, &mut |_| Err("no meshes here".to_owned()))
        .expect("a robot")
}

/// Numbers in [-1, 1), the same in every run.
fn states(n: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut state = seed;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    (0..STATES)
        .map(|_| (0..n).map(|_| next()).collect())
        .collect()
}

fn algorithms(c: &mut Criterion) {
    for (name, frame) in [
        ("ur5", "tool0"),
        ("panda", "panda_hand_tcp"),
        ("humanoid25", "right_gear"),
    ] {
        let robot = robot(name);
        let n = robot.n();
        let (q, v, a) = (states(n, 1), states(n, 2), states(n, 3));
        let mut k = 0;
        let mut next = move || {
            k = (k + 1) % STATES;
            k
        };
        let mut group = c.benchmark_group(name);
        let mut poses = FramePoses::new(&robot);
        let mut at = next;
        group.bench_function("forward kinematics", |b| {
            b.iter(|| {
                poses.update(&robot, &q[at()]);
                black_box(&poses);
            });
        });
        let mut chain = Chain::new(&robot, robot.frame(frame).expect(frame));
        let mut at = next;
        group.bench_function("jacobian", |b| {
            b.iter(|| {
                chain.update(&q[at()]);
                black_box(chain.jacobian());
            });
        });
        let mut effort = vec![0.0; n];
        let mut rnea = Rnea::new(&robot);
        let mut at = next;
        group.bench_function("inverse dynamics", |b| {
            b.iter(|| {
                let i = at();
                rnea.effort(&robot, &GRAVITY_M_S2, &q[i], &v[i], &a[i], &mut effort);
                black_box(&effort);
            });
        });
        let mut matrix = DMatrix::zeros(n, n);
        let mut crba = Crba::new(&robot);
        let mut at = next;
        group.bench_function("mass matrix", |b| {
            b.iter(|| {
                crba.fill(&robot, &q[at()], &mut matrix);
                black_box(&matrix);
            });
        });
        let mut qdd = vec![0.0; n];
        let mut dynamics = ForwardDynamics::new(&robot);
        group.bench_function("forward dynamics", |b| {
            b.iter(|| {
                let i = next();
                let done =
                    dynamics.acceleration(&robot, &GRAVITY_M_S2, &q[i], &v[i], &a[i], &mut qdd);
                black_box(done.is_ok());
            });
        });
        group.finish();
    }
}

criterion_group!(benches, algorithms);
criterion_main!(benches);
