//! Inverse kinematics from starts that have nothing to do with the target, and a chain's Jacobian with fresh forward kinematics.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use kinemark_sim::format::{ReadOptions, detect};
use kinemark_sim::kinematics::chain::Chain;
use kinemark_sim::kinematics::inverse::{Goal, IkSettings, IkSolver, Target};
use kinemark_sim::kinematics::joint_samples::JointSamples;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::text::Source;

/// Targets of one round; a round visits each once.
const TARGETS: usize = 10_000;

fn model(name: &str) -> Robot {
    let path = format!(
        "{}/../tests/golden/models/{name}.urdf",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(path).expect("a model");
    let options = ReadOptions {
        ignore_mimic: true,
        ..ReadOptions::default()
    };
    let source = Source::new(name.to_owned(), text);
    (detect(&source).read)(source, &options, &mut |_| Err("none".to_owned())).expect("a robot")
}

/// Positions all over the joint ranges, limits included.
fn positions(robot: &Robot, skip: usize) -> Vec<Vec<f64>> {
    let mut samples = JointSamples::new(robot);
    let mut q = vec![0.0; robot.n()];
    let mut next = || {
        samples.next_into(&mut q);
        q.clone()
    };
    for _ in 0..skip {
        next();
    }
    (0..TARGETS).map(|_| next()).collect()
}

fn inverse(c: &mut Criterion) {
    for (name, frame) in [
        ("ur5", "tool0"),
        ("panda", "panda_hand_tcp"),
        ("humanoid25", "right_gear"),
    ] {
        let robot = model(name);
        let frame = robot.frame(frame).expect("the frame");
        let mut chain = Chain::new(&robot, frame);
        let starts = positions(&robot, 0);
        // far along the same sequence: as if drawn on their own
        let wanted = positions(&robot, 123_456);
        let targets: Vec<Target> = wanted
            .iter()
            .map(|q| Target::Pose(chain.update(q)))
            .collect();
        let mut group = c.benchmark_group(name);
        group.throughput(Throughput::Elements(TARGETS as u64));
        group.sample_size(20);
        group.bench_function("pose and jacobian of the chain", |b| {
            b.iter(|| {
                for q in &starts {
                    black_box(chain.update(black_box(q)));
                    black_box(chain.jacobian());
                }
            });
        });
        let goal = Goal {
            frame,
            target: targets[0],
            weight: 1.0,
        };
        let mut solver = IkSolver::new(&robot, &[goal], IkSettings::default()).expect("a question");
        group.bench_function("inverse kinematics from anywhere", |b| {
            b.iter(|| {
                let mut reached = 0;
                for (q0, target) in starts.iter().zip(&targets) {
                    solver.set_target(0, *target).expect("a pose");
                    reached += usize::from(solver.solve(black_box(q0)).expect("an answer").reached);
                }
                assert!(reached * 1000 >= TARGETS * 995, "{reached} of {TARGETS}");
            });
        });
        group.finish();
    }
}

criterion_group!(benches, inverse);
criterion_main!(benches);
