//! One run with everything in it and its digest, for every build that must have its bits: the module of `tests/wasm` too.

use kinemark_sim::model::robot::Robot;
use kinemark_sim::step::hybrid::HybridStep;

use crate::contact_scenes::{GRAVITY, reach, shelf_and_can};

pub(crate) const DT: f64 = 1e-3;

/// Digest of the run of the course's arm. Changing it moves grades: it needs a line in the changelog that says why.
pub(crate) const DIGEST: &str = "e1cebabf8eae74d78a209798130abc46b08cb90eb49f9de4749c33b4d52f6434";

/// What holds the course's arm against gravity.
pub(crate) fn weight(q: &[f64]) -> [f64; 2] {
    let forearm = -0.25 * 9.81 * libm::sin(q[0] + q[1]);
    [forearm - 0.75 * 9.81 * libm::sin(q[0]), forearm]
}

/// Pulls the arm to `goal` with at most `limit_n_m`, gravity aside.
pub(crate) fn pull(
    q: &[f64],
    qd: &[f64],
    goal: [f64; 2],
    gains: [f64; 2],
    limit_n_m: f64,
) -> [f64; 2] {
    let held = weight(q);
    [0, 1].map(|i| {
        let wanted = gains[0] * (goal[i] - q[i]) - gains[1] * qd[i];
        wanted.max(-limit_n_m).min(limit_n_m) + held[i]
    })
}

/// A run with everything in it: sweep, fall, shelf; `visit` sees each step and may change it.
pub(crate) fn eventful(
    robot: &Robot,
    mut visit: impl FnMut(usize, &mut HybridStep, &mut [f64; 2], &mut [f64; 2]),
) {
    let mut hybrid = HybridStep::new(robot, &shelf_and_can(), GRAVITY, DT).expect("a scene");
    let (mut q, mut qd) = (reach(1.25, 1.2), [0.0; 2]);
    for i in 0..1200 {
        let (up, out) = if i < 600 {
            (1.25, 1.2 - i as f64 * DT)
        } else {
            (1.0, 1.1)
        };
        let effort = pull(&q, &qd, reach(up, out), [1000.0, 30.0], 100.0);
        hybrid
            .advance(robot, &effort, &mut q, &mut qd)
            .expect("a step");
        visit(i, &mut hybrid, &mut q, &mut qd);
    }
}

/// Adds the bits of the robot's state and of all bodies to a digest.
pub(crate) fn put_state(hasher: &mut blake3::Hasher, hybrid: &HybridStep, q: &[f64], qd: &[f64]) {
    let mut put = |x: f64| {
        hasher.update(&x.to_bits().to_le_bytes());
    };
    q.iter().chain(qd).copied().for_each(&mut put);
    for body in hybrid.bodies() {
        let pose = body.world_from_body;
        pose.translation.vector.iter().copied().for_each(&mut put);
        pose.rotation.matrix().iter().copied().for_each(&mut put);
        body.twist.to_vector().iter().copied().for_each(&mut put);
    }
}

/// Digest of the run: the bits of every step's state; `visit` sees each step.
pub(crate) fn digest(robot: &Robot, mut visit: impl FnMut(&HybridStep)) -> String {
    let mut hasher = blake3::Hasher::new();
    eventful(robot, |_, hybrid, q, qd| {
        put_state(&mut hasher, hybrid, q, qd);
        visit(hybrid);
    });
    hasher.finalize().to_hex().to_string()
}
