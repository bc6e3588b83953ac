//! Kinematics and dynamics of planar arms of any size and mass against their closed forms.

use std::f64::consts::TAU;

use kinemark_reference::planar_2r::{IkSolutions, JointState, Planar2r};
use kinemark_sim::dynamics::{
    bias_effort, energy, forward_dynamics, gravity_effort, inverse_dynamics, mass_matrix,
};
use kinemark_sim::joint_space::{JointAccelerations, JointPositions, JointVelocities};
use kinemark_sim::kinematics::inverse::{IkSettings, Target, inverse_kinematics};
use kinemark_sim::kinematics::manipulability::Manipulability;
use kinemark_sim::kinematics::{forward_kinematics, geometric_jacobian};
use kinemark_sim::model::robot::Robot;
use nalgebra::{Vector2, Vector3};
use proptest::prelude::*;

use crate::arms::robot;

/// Products and sums of a handful of numbers up to a hundred.
const ROUNDING: f64 = 1e-12;

/// Arms whose links differ in everything.
fn arms() -> impl Strategy<Value = Planar2r> {
    let lengths = (0.1..2.0f64, 0.1..2.0f64, -1.0..3.0f64);
    let offsets = (-0.2..0.2f64, -0.2..0.2f64);
    let masses = (0.1..5.0f64, 0.1..5.0f64, 0.01..0.5f64, 0.01..0.5f64);
    // a centre of mass may lie beyond a link's ends
    let centres = (-0.2..1.2f64, -0.2..1.2f64);
    let outside = (0.0..2.0f64, 0.0..20.0f64);
    let all = (lengths, offsets, masses, centres, outside);
    all.prop_map(|(lengths, offsets, masses, centres, outside)| Planar2r {
        base_height_m: lengths.2,
        l1_m: lengths.0,
        l2_m: lengths.1,
        offset_z1_m: offsets.0,
        offset_z2_m: offsets.1,
        m1_kg: masses.0,
        m2_kg: masses.1,
        com1_m: centres.0 * lengths.0,
        com2_m: centres.1 * lengths.1,
        i1_com_kg_m2: masses.2,
        i2_com_kg_m2: masses.3,
        joint_damping_n_m_s: outside.0,
        gravity_m_s2: outside.1,
    })
}

/// The arm as a robot, its links along z of the world and its joints about y; only the inertia about y can matter.
fn built(arm: &Planar2r) -> Robot {
    let link = |name: &str, mass: f64, com: f64, inertia: f64| {
        format!(
            "[[links]]\nname = '{name}'\ninertia = {{ mass_kg = {mass}, com_m = [0, 0, {com}], tensor_kg_m2 = [{inertia}, {inertia}, {}, 0, 0, 0] }}\n",
            0.3 * inertia
        )
    };
    let joint = |name: &str, parent: &str, child: &str, sideways: f64, up: f64| {
        format!(
            "[[joints]]\nname = '{name}'\ntype = 'continuous'\nparent = '{parent}'\nchild = '{child}'\norigin = {{ xyz_m = [0, {sideways}, {up}] }}\naxis = [0, 1, 0]\ndamping = {}\n",
            arm.joint_damping_n_m_s
        )
    };
    robot(&format!(
        "format = 1\nname = 'planar'\n[[links]]\nname = 'base'\n{}{}{}{}\
         [[frames]]\nname = 'tcp'\nlink = 'lower'\norigin = {{ xyz_m = [0, 0, {}] }}\n\
         [[frames]]\nname = 'lab'\nlink = 'base'\norigin = {{ x_axis = [0, 0, 1], y_axis = [1, 0, 0] }}\n",
        link("upper", arm.m1_kg, arm.com1_m, arm.i1_com_kg_m2),
        link("lower", arm.m2_kg, arm.com2_m, arm.i2_com_kg_m2),
        joint(
            "shoulder",
            "base",
            "upper",
            arm.offset_z1_m,
            arm.base_height_m
        ),
        joint("elbow", "upper", "lower", arm.offset_z2_m, arm.l1_m),
        arm.l2_m,
    ))
}

fn angles() -> impl Strategy<Value = Vector2<f64>> {
    (-4.0..4.0f64, -4.0..4.0f64).prop_map(|(a, b)| Vector2::new(a, b))
}

fn values(v: Vector2<f64>) -> [f64; 2] {
    v.into()
}

fn apart(got: &[f64], expected: Vector2<f64>) -> f64 {
    assert_eq!(got.len(), 2);
    (Vector2::new(got[0], got[1]) - expected).amax()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn poses_and_jacobians_are_those_of_the_closed_form(arm in arms(), q in angles()) {
        let robot = built(&arm);
        let (tcp, lab) = (robot.tcp(), robot.frame("lab").expect("lab"));
        let positions = JointPositions::new(values(q));
        let poses = forward_kinematics(&robot, &positions);
        let lab_from_world = poses.world_from(lab).inverse();
        let lab_from_tcp = lab_from_world * poses.world_from(tcp);
        let expected = arm.lab_from_tcp(q);
        let position = lab_from_tcp.translation.vector;
        prop_assert!((position - expected.fixed_view::<3, 1>(0, 3)).amax() < ROUNDING, "{position}");
        // the closed form's x is along the link, the robot's z
        for (closed, ours) in [(0, 2), (1, 0), (2, 1)] {
            let axis = lab_from_tcp.rotation.matrix().column(ours).into_owned();
            prop_assert!((axis - expected.fixed_view::<3, 1>(0, closed)).amax() < ROUNDING, "{axis}");
        }
        let jacobian = geometric_jacobian(&robot, &positions, tcp);
        let expected = arm.tcp_jacobian_in_lab(q);
        for column in 0..2 {
            let linear = lab_from_world.rotation * jacobian.fixed_view::<3, 1>(0, column);
            let angular = lab_from_world.rotation * jacobian.fixed_view::<3, 1>(3, column);
            let wanted = Vector3::new(expected[(0, column)], expected[(1, column)], 0.0);
            prop_assert!((linear - wanted).amax() < ROUNDING, "{linear}");
            prop_assert!((angular - Vector3::z()).amax() < ROUNDING, "{angular}");
        }
        // rows x and z of the world: the plane of the motion
        let measure = Manipulability::of(&jacobian, &[0, 2]).yoshikawa();
        prop_assert!((measure - arm.jacobian_determinant(q).abs()).abs() < ROUNDING, "{measure}");
    }

    #[test]
    fn the_inverse_kinematics_finds_either_branch_from_beside_it(arm in arms(), q in angles(), off in -0.1..0.1f64) {
        // near the straight and the folded arm both branches are close together
        prop_assume!(libm::sin(q.y).abs() > 0.3);
        let robot = built(&arm);
        let p = arm.p_tcp_in_lab(q);
        let IkSolutions::Branches { elbow_plus_rad, elbow_minus_rad } = arm.inverse_kinematics(p.x, p.y) else {
            panic!("{q} is singular");
        };
        // the lab's (x, y, z) are the world's (z, x, y)
        let target = Target::Position(Vector3::new(p.y, p.z, p.x));
        let settings = IkSettings { tolerance_m: 1e-11, ..IkSettings::default() };
        for branch in [elbow_plus_rad, elbow_minus_rad] {
            let start = values(branch.add_scalar(off));
            let answer = inverse_kinematics(&robot, robot.tcp(), target, &start, &settings).expect("a question");
            prop_assert!(answer.reached, "{answer:?}");
            for (got, expected) in answer.q.iter().zip(values(branch)) {
                let turns = (got - expected) / TAU;
                // 1e-11 m over l₁ l₂ sin q₂ / (l₁ + l₂), at least 0.015 m
                prop_assert!((turns - turns.round()).abs() * TAU < 1e-8, "{answer:?} {branch}");
            }
        }
    }

    #[test]
    fn what_is_out_of_reach_is_missed_by_what_the_closed_form_says(arm in arms(), angle in -3.0..3.0f64, beyond in 0.01..1.0f64) {
        let robot = built(&arm);
        let distance = arm.l1_m + arm.l2_m + beyond;
        let (x, y) = (arm.base_height_m + distance * libm::cos(angle), distance * libm::sin(angle));
        let IkSolutions::Unreachable { distance_m, farthest_m, .. } = arm.inverse_kinematics(x, y) else {
            panic!("{beyond} m is beyond reach");
        };
        let target = Target::Position(Vector3::new(y, arm.offset_z1_m + arm.offset_z2_m, x));
        let answer = inverse_kinematics(&robot, robot.tcp(), target, &[0.3, 0.4], &IkSettings::default()).expect("a question");
        prop_assert!(!answer.reached, "{answer:?}");
        prop_assert!(answer.residual_m >= distance_m - farthest_m - ROUNDING, "{answer:?}");
    }

    #[test]
    fn efforts_and_accelerations_are_those_of_the_closed_form(
        arm in arms(), q in angles(), qd in angles(), qdd in angles(),
    ) {
        let robot = built(&arm);
        let gravity = Vector3::new(0.0, 0.0, -arm.gravity_m_s2);
        let state = JointState { q_rad: q, qd_rad_s: qd };
        let (at, rates) = (JointPositions::new(values(q)), JointVelocities::new(values(qd)));
        let accelerations = JointAccelerations::new(values(qdd));
        let mass = mass_matrix(&robot, &at);
        let expected = arm.mass_matrix(q);
        let size = expected.amax();
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            prop_assert!((mass[(i, j)] - expected[(i, j)]).abs() < ROUNDING * size, "{mass}");
        }
        // efforts are sums of mass times accelerations and of weights
        let size = size * (1.0 + qd.norm_squared() + qdd.norm()) + arm.gravity_efforts_n_m(q).amax() + 1.0;
        let holds = gravity_effort(&robot, &gravity, &at);
        prop_assert!(apart(holds.as_slice(), arm.gravity_efforts_n_m(q)) < ROUNDING * size);
        let bias = bias_effort(&robot, &gravity, &at, &rates);
        prop_assert!(apart(bias.as_slice(), arm.bias_n_m(&state)) < ROUNDING * size);
        let effort = inverse_dynamics(&robot, &gravity, &at, &rates, &accelerations);
        let expected_effort = arm.inverse_dynamics_n_m(&state, qdd);
        prop_assert!(apart(effort.as_slice(), expected_effort) < ROUNDING * size);
        let back = forward_dynamics(&robot, &gravity, &at, &rates, &effort).expect("inertia everywhere");
        let expected_back = arm.forward_dynamics_rad_s2(&state, expected_effort);
        // the mass matrix's inverse makes errors of efforts larger
        let inverse = expected.try_inverse().expect("positive definite").amax();
        prop_assert!(apart(back.as_slice(), expected_back) < 10.0 * ROUNDING * size * inverse, "{back:?} {expected_back}");
        let moving = energy(&robot, &gravity, &at, &rates);
        let shoulder = arm.gravity_m_s2 * (arm.m1_kg + arm.m2_kg) * arm.base_height_m;
        prop_assert!((moving.kinetic_j - arm.kinetic_energy_j(&state)).abs() < ROUNDING * size);
        prop_assert!((moving.potential_j - shoulder - arm.potential_energy_j(q)).abs() < ROUNDING * (size + shoulder.abs()));
    }
}
