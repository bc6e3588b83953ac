//! One algorithm against another, on trees of every kind.

use kinemark_sim::dynamics::{
    bias_effort, energy, forward_dynamics, gravity_effort, inverse_dynamics, mass_matrix,
};
use kinemark_sim::joint_space::{JointAccelerations, JointPositions, JointVelocities};
use kinemark_sim::kinematics::{forward_kinematics, frame_twist, geometric_jacobian};
use nalgebra::{DVector, Vector3};
use proptest::prelude::*;

use crate::arms::{Numbers, random_tree};

/// A skew gravity, so that no axis is special.
const G: Vector3<f64> = Vector3::new(1.0, -2.0, -9.0);

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn forward_dynamics_undoes_inverse_dynamics(seed in any::<u64>(), joints in 1usize..12) {
        let robot = random_tree(seed, joints);
        let mut r = Numbers::new(seed ^ 1);
        let q = JointPositions::new(r.vector(robot.n(), 3.0));
        let qd = JointVelocities::new(r.vector(robot.n(), 2.0));
        let qdd = JointAccelerations::new(r.vector(robot.n(), 5.0));
        let tau = inverse_dynamics(&robot, &G, &q, &qd, &qdd);
        let back = forward_dynamics(&robot, &G, &q, &qd, &tau).expect("inertia everywhere");
        let error = (back.vector() - qdd.vector()).amax();
        prop_assert!(error < 1e-9, "{error:.2e} with {} joints", robot.n());
    }

    #[test]
    fn mass_matrix_columns_are_efforts_of_unit_accelerations(seed in any::<u64>(), joints in 1usize..10) {
        let robot = random_tree(seed, joints);
        let n = robot.n();
        let mut r = Numbers::new(seed ^ 2);
        let q = JointPositions::new(r.vector(n, 3.0));
        let m = mass_matrix(&robot, &q);
        for j in 0..n {
            let mut unit = JointAccelerations::zeros(n);
            unit.as_mut_slice()[j] = 1.0;
            let column = inverse_dynamics(&robot, &Vector3::zeros(), &q, &JointVelocities::zeros(n), &unit);
            let error = (column.vector() - m.column(j)).amax();
            prop_assert!(error < 1e-12, "column {j}: {error:.2e}");
        }
        prop_assert!(m.cholesky().is_some(), "positive definite");
    }

    #[test]
    fn the_jacobian_is_the_difference_quotient_of_the_pose(seed in any::<u64>(), joints in 1usize..10) {
        let robot = random_tree(seed, joints);
        let n = robot.n();
        let mut r = Numbers::new(seed ^ 3);
        let q = r.vector(n, 3.0);
        let h = 1e-6; // truncation O(h²) and round-off O(ε/h) meet near 1e-10
        for frame in robot.frames() {
            let jacobian = geometric_jacobian(&robot, &JointPositions::new(q.iter().copied()), frame);
            for j in 0..n {
                let at = |d: f64| {
                    let mut moved = q.clone();
                    moved[j] += d;
                    forward_kinematics(&robot, &JointPositions::new(moved)).world_from(frame)
                };
                let (plus, minus) = (at(h), at(-h));
                let linear = (plus.translation.vector - minus.translation.vector) / (2.0 * h);
                let turn = plus.rotation.matrix() * minus.rotation.matrix().transpose();
                let angular = Vector3::new(turn.m32 - turn.m23, turn.m13 - turn.m31, turn.m21 - turn.m12) / (4.0 * h);
                let error = (jacobian.fixed_view::<3, 1>(0, j) - linear).amax()
                    .max((jacobian.fixed_view::<3, 1>(3, j) - angular).amax());
                prop_assert!(error < 1e-8, "{} by joint {j}: {error:.2e}", frame.name);
            }
        }
    }

    #[test]
    fn bias_is_gravity_and_velocity_terms(seed in any::<u64>(), joints in 1usize..10) {
        let robot = random_tree(seed, joints);
        let n = robot.n();
        let mut r = Numbers::new(seed ^ 4);
        let q = JointPositions::new(r.vector(n, 3.0));
        let qd = JointVelocities::new(r.vector(n, 2.0));
        let rest = bias_effort(&robot, &G, &q, &JointVelocities::zeros(n));
        let gravity = gravity_effort(&robot, &G, &q);
        prop_assert!((rest.vector() - gravity.vector()).amax() < 1e-12);
        // gravity is the slope of the potential
        let h = 1e-6;
        for j in 0..n {
            let at = |d: f64| {
                let mut moved = q.clone();
                moved.as_mut_slice()[j] += d;
                energy(&robot, &G, &moved, &JointVelocities::zeros(n)).potential_j
            };
            let slope = (at(h) - at(-h)) / (2.0 * h);
            prop_assert!((slope - gravity.as_slice()[j]).abs() < 1e-7, "joint {j}");
        }
        // velocity terms grow with the square of the velocity
        let velocity = |s: f64| {
            let scaled = JointVelocities::from(qd.vector() * s);
            bias_effort(&robot, &Vector3::zeros(), &q, &scaled)
        };
        let error: DVector<f64> = velocity(2.0).vector() - velocity(1.0).vector() * 4.0;
        prop_assert!(error.amax() < 1e-10);
    }

    #[test]
    fn power_in_is_energy_gained(seed in any::<u64>(), joints in 1usize..8) {
        // dE/dt = qdᵀ (tau - damping qd), by a central difference along the motion itself
        let robot = random_tree(seed, joints);
        let n = robot.n();
        let mut r = Numbers::new(seed ^ 5);
        let (q, qd) = (r.vector(n, 3.0), r.vector(n, 1.0));
        let tau = kinemark_sim::joint_space::JointEfforts::new(r.vector(n, 5.0));
        let (q0, qd0) = (JointPositions::new(q.clone()), JointVelocities::new(qd.clone()));
        let qdd = forward_dynamics(&robot, &G, &q0, &qd0, &tau).expect("inertia everywhere");
        let h = 1e-6;
        let at = |t: f64| {
            let q = (0..n).map(|i| q[i] + t * qd[i] + 0.5 * t * t * qdd.as_slice()[i]);
            let v = (0..n).map(|i| qd[i] + t * qdd.as_slice()[i]);
            let e = energy(&robot, &G, &JointPositions::new(q), &JointVelocities::new(v));
            e.kinetic_j + e.potential_j
        };
        let gained = (at(h) - at(-h)) / (2.0 * h);
        let damping: Vec<f64> = robot.moving_joints().map(|joint| joint.damping).collect();
        let power: f64 = (0..n).map(|i| qd[i] * (tau.as_slice()[i] - damping[i] * qd[i])).sum();
        prop_assert!((gained - power).abs() < 1e-6 * (1.0 + power.abs()), "{gained} against {power}");
    }

    #[test]
    fn a_twist_is_the_jacobian_times_the_velocity(seed in any::<u64>()) {
        let robot = random_tree(seed, 6);
        let mut r = Numbers::new(seed ^ 6);
        let q = JointPositions::new(r.vector(robot.n(), 3.0));
        let qd = JointVelocities::new(r.vector(robot.n(), 2.0));
        let frame = robot.tcp();
        let twist = frame_twist(&robot, &q, &qd, frame);
        let h = 1e-6;
        let at = |t: f64| {
            let q = (0..robot.n()).map(|i| q.as_slice()[i] + t * qd.as_slice()[i]);
            forward_kinematics(&robot, &JointPositions::new(q)).world_from(frame)
        };
        let linear = (at(h).translation.vector - at(-h).translation.vector) / (2.0 * h);
        prop_assert!((twist.linear - linear).amax() < 1e-8);
        prop_assert_eq!(twist.to_vector().fixed_rows::<3>(3).into_owned(), twist.angular);
    }
}
