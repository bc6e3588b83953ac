//! Steps that take viscous damping implicitly, against closed forms, against Radau's method (`tests/golden/K_stiff_damping.json`), and
//! against Runge-Kutta, which every other step still is.

use kinemark_sim::dynamics::{ForwardDynamics, GRAVITY_M_S2, mass_matrix};
use kinemark_sim::model::robot::Robot;
use kinemark_sim::step::smooth::SmoothStep;
use nalgebra::{DMatrix, Vector3};
use proptest::prelude::*;

use crate::arms::robot;
use crate::golden_rrbot::{golden, numbers};

const STEP_S: f64 = 0.001;

fn model(name: &str) -> Robot {
    let path = format!(
        "{}/../tests/golden/models/{name}.toml",
        env!("CARGO_MANIFEST_DIR")
    );
    robot(&std::fs::read_to_string(&path).expect(&path))
}

/// A bar of `tensor` \[kg m²\] about its hinge, without weight.
fn flywheel(tensor: f64, joint: &str) -> Robot {
    robot(&format!(
        r#"
        format = 1
        name = "flywheel"
        [[links]]
        name = "post"
        [[links]]
        name = "wheel"
        inertia = {{ mass_kg = 1.0, com_m = [0, 0, 0], tensor_kg_m2 = [{tensor}, {tensor}, {tensor}, 0, 0, 0] }}
        [[joints]]
        name = "hinge"
        type = "continuous"
        parent = "post"
        child = "wheel"
        axis = [0, 1, 0]
        {joint}
        "#
    ))
}

/// Two bars with the damping `first` and `second` \[N m s/rad\].
fn two_bars(first: f64, second: f64) -> Robot {
    robot(&format!(
        r#"
        format = 1
        name = "two bars"
        [[links]]
        name = "base"
        [[links]]
        name = "upper"
        inertia = {{ mass_kg = 0.5, com_m = [0, 0, -0.5], tensor_kg_m2 = [0.04, 0.04, 0.001, 0, 0, 0] }}
        [[links]]
        name = "lower"
        inertia = {{ mass_kg = 0.5, com_m = [0.1, 0, -0.5], tensor_kg_m2 = [0.04, 0.04, 0.001, 0, 0, 0] }}
        [[joints]]
        name = "shoulder"
        type = "continuous"
        parent = "base"
        child = "upper"
        axis = [0, 1, 0]
        damping = {first}
        [[joints]]
        name = "elbow"
        type = "continuous"
        parent = "upper"
        child = "lower"
        origin = {{ xyz_m = [0, 0, -1] }}
        axis = [0, 1, 0]
        damping = {second}
        "#
    ))
}

fn advance(robot: &Robot, dt_s: f64, steps: usize, q: &mut [f64], qd: &mut [f64], effort: &[f64]) {
    let mut step = SmoothStep::new(robot, GRAVITY_M_S2, dt_s);
    for _ in 0..steps {
        step.advance(robot, effort, q, qd).expect("inertia");
    }
}

/// One step of Runge-Kutta of order four, written out once more.
fn runge_kutta(robot: &Robot, dt_s: f64, effort: &[f64], q: &mut [f64], qd: &mut [f64]) {
    let n = q.len();
    let mut dynamics = ForwardDynamics::new(robot);
    let mut rates = vec![vec![0.0; n]; 4];
    let mut slopes = vec![vec![0.0; n]; 4];
    for stage in 0..4 {
        let (mut at, mut rate) = (q.to_vec(), qd.to_vec());
        if stage > 0 {
            let reach = if stage == 3 { dt_s } else { 0.5 * dt_s };
            for i in 0..n {
                at[i] += reach * rates[stage - 1][i];
                rate[i] += reach * slopes[stage - 1][i];
            }
        }
        dynamics
            .acceleration(robot, &GRAVITY_M_S2, &at, &rate, effort, &mut slopes[stage])
            .expect("inertia");
        rates[stage] = rate;
    }
    let sixth = dt_s / 6.0;
    for i in 0..n {
        q[i] += sixth * (rates[0][i] + 2.0 * (rates[1][i] + rates[2][i]) + rates[3][i]);
        qd[i] += sixth * (slopes[0][i] + 2.0 * (slopes[1][i] + slopes[2][i]) + slopes[3][i]);
    }
}

/// The largest eigenvalue of `M⁻¹ D` at `q`, by the symmetric matrix `D^½ M⁻¹ D^½`.
fn fastest_damping(robot: &Robot, q: &[f64]) -> f64 {
    let q = robot.positions(q).expect("positions");
    let mass = mass_matrix(robot, &q);
    let roots: Vec<f64> = robot.moving_joints().map(|j| j.damping.sqrt()).collect();
    let inverse = mass.cholesky().expect("inertia").inverse();
    let n = roots.len();
    let scaled = DMatrix::from_fn(n, n, |i, j| roots[i] * inverse[(i, j)] * roots[j]);
    scaled.symmetric_eigenvalues().max()
}

#[test]
fn stiff_robots_move_as_radau_says() {
    let file = golden("K_stiff_damping.json");
    let (mut worst_q, mut worst_qd) = (0.0_f64, 0.0_f64);
    for case in file["cases"].as_array().expect("cases") {
        let robot = model(case["robot"].as_str().expect("robot"));
        let (mut q, mut qd) = (numbers(&case["q0"]), numbers(&case["qd0"]));
        let stated = case["fastest_damping_per_s"].as_f64().expect("rate");
        let rate = fastest_damping(&robot, &q);
        assert!(
            (rate / stated - 1.0).abs() < 1e-9,
            "{rate} against {stated}"
        );
        assert!(rate * STEP_S > 7.0);
        let effort = numbers(&case["effort"]);
        let mut done = 0;
        for row in case["rows"].as_array().expect("rows") {
            let until = (row["t_s"].as_f64().expect("time") / STEP_S).round() as usize;
            advance(&robot, STEP_S, until - done, &mut q, &mut qd, &effort);
            done = until;
            let off = |got: &[f64], expected: &[f64]| {
                let pairs = got.iter().zip(expected);
                pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            };
            worst_q = worst_q.max(off(&q, &numbers(&row["q"])));
            worst_qd = worst_qd.max(off(&qd, &numbers(&row["qd"])));
        }
    }
    println!("{worst_q:e} rad or m, {worst_qd:e} rad/s or m/s");
    assert!(
        worst_q < 1e-6 && worst_qd < 1e-5,
        "{worst_q:e}, {worst_qd:e}"
    );
}

#[test]
fn a_damped_flywheel_under_a_torque_follows_its_closed_form() {
    // J dω/dt = τ - D ω: ω = τ/D (1 - e^(-t D/J)), φ = τ/D (t - J/D (1 - e^(-t D/J)))
    for per_step in [0.6, 3.0, 30.0, 1e3, 1e6, 1e12] {
        let (inertia, torque) = (0.01, 2.0);
        let damping = per_step * inertia / STEP_S;
        let robot = flywheel(inertia, &format!("damping = {damping:e}"));
        let (mut q, mut qd) = ([0.0], [0.0]);
        advance(&robot, STEP_S, 1000, &mut q, &mut qd, &[torque]);
        let end = torque / damping;
        let angle = end * (1.0 - inertia / damping);
        // the start, a step long, is all that is not exact: a hundredth of it
        assert!((qd[0] / end - 1.0).abs() < 1e-12, "{per_step}: {qd:?}");
        let missed = (q[0] - angle).abs();
        assert!(
            missed < 1e-2 * end * STEP_S,
            "{per_step}: {missed:e} of {angle:e}"
        );
    }
}

#[test]
fn a_velocity_that_damping_brakes_dies_out_within_a_step() {
    let robot = flywheel(1e-6, "damping = 1.0");
    let (mut q, mut qd) = ([0.0], [50.0]);
    advance(&robot, STEP_S, 1, &mut q, &mut qd, &[0.0]);
    // ω J/D = 5e-5 rad in all; the extrapolated Euler steps leave at most ω / (h D/J)
    assert!(
        qd[0].abs() < 50.0 * 1e-3 && (q[0] - 5e-5).abs() < 5e-5,
        "{q:?} {qd:?}"
    );
    advance(&robot, STEP_S, 5, &mut q, &mut qd, &[0.0]);
    assert!(
        qd[0].abs() < 1e-12 && (q[0] - 5e-5).abs() < 5e-5,
        "{q:?} {qd:?}"
    );
}

#[test]
fn halving_the_step_divides_the_error_by_sixteen_on_soft_joints_beside_a_stiff_one() {
    // the elbow is braked 7 times a step and more, the shoulder swings
    let robot = two_bars(0.0, 150.0);
    let ends: Vec<[f64; 2]> = [4, 8, 16, 640]
        .map(|steps| {
            let (mut q, mut qd) = ([1.5, 0.3], [0.0, 0.0]);
            advance(
                &robot,
                0.4 / f64::from(steps),
                steps as usize,
                &mut q,
                &mut qd,
                &[0.0; 2],
            );
            q
        })
        .to_vec();
    let off = |i: usize| (ends[i][0] - ends[3][0]).abs();
    let orders = [off(0) / off(1), off(1) / off(2)];
    assert!(
        orders.iter().all(|ratio| *ratio > 10.0),
        "{orders:?} {}",
        off(0)
    );
}

#[test]
fn the_step_is_runge_kutta_to_the_bit_up_to_a_half_and_not_beyond() {
    let (q0, qd0, effort) = ([0.4, -1.1], [2.0, -3.0], [0.5, 0.1]);
    let soft = fastest_damping(&two_bars(1.0, 1.0), &q0) * STEP_S;
    let after_a_step = |share: f64| {
        let damping = share * 0.5 / soft;
        let robot = two_bars(damping, damping);
        let (mut a, mut ad) = (q0, qd0);
        advance(&robot, STEP_S, 1, &mut a, &mut ad, &effort);
        let (mut b, mut bd) = (q0, qd0);
        runge_kutta(&robot, STEP_S, &effort, &mut b, &mut bd);
        let added = SmoothStep::new(&robot, GRAVITY_M_S2, STEP_S)
            .damping_inertia(&robot, &q0)
            .map(<[f64]>::to_vec);
        let bits = |values: &[f64]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        let same = bits(&a) == bits(&b) && bits(&ad) == bits(&bd);
        (same, added, damping)
    };
    for share in [0.01, 0.3, 0.9, 0.999_999] {
        let (same, added, _) = after_a_step(share);
        assert!(same && added.is_none(), "{share}");
    }
    for share in [1.000_001, 1.1, 5.0] {
        let (same, added, damping) = after_a_step(share);
        assert!(!same, "{share}");
        assert_eq!(added, Some(vec![damping * STEP_S; 2]), "{share}");
    }
}

#[test]
fn the_choice_follows_the_configuration() {
    // straight, the elbow feels less inertia than bent by a right angle: between both, one is implicit and the other is not
    let rates = [0.0, 1.57].map(|elbow| fastest_damping(&two_bars(0.1, 1.0), &[0.3, elbow]));
    let between = 0.5 * (rates[0] + rates[1]);
    let scale = 0.5 / (between * STEP_S);
    let robot = two_bars(0.1 * scale, scale);
    let mut step = SmoothStep::new(&robot, GRAVITY_M_S2, STEP_S);
    for (elbow, rate) in [0.0, 1.57].into_iter().zip(rates) {
        let is_stiff = step.damping_inertia(&robot, &[0.3, elbow]).is_some();
        assert_eq!(is_stiff, rate > between, "{elbow}");
    }
}

#[test]
fn dry_friction_holds_and_stops_a_stiff_joint() {
    // a finger with friction beyond its weight stays; one that is thrown stops
    let joint = "damping = 0.5\ndry_friction = 0.05";
    let text = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../tests/golden/models/stiff_finger.toml"
    ));
    let robot = robot(&text.expect("finger").replace("damping = 0.5", joint));
    let (mut q, mut qd) = ([0.2], [0.0]);
    advance(&robot, STEP_S, 1000, &mut q, &mut qd, &[0.0]);
    assert!(
        (q[0] - 0.2).abs() < 1e-15 && qd[0].abs() < 1e-15,
        "{q:?} {qd:?}"
    );
    let (mut q, mut qd) = ([0.2], [20.0]);
    advance(&robot, STEP_S, 1000, &mut q, &mut qd, &[0.0]);
    // it has 5.4e-4 N m s of angular momentum, which damping takes up within 1.1e-3 rad
    assert!(
        (q[0] - 0.2).abs() < 1.5e-3 && qd[0].abs() < 1e-12,
        "{q:?} {qd:?}"
    );
}

#[test]
fn a_mimic_pair_is_damped_as_the_joint_that_it_amounts_to() {
    // two wheels, the second three times as fast: J + 9 J, D + 9 D
    let wheels = |damping: f64| {
        robot(&format!(
            r#"
            format = 1
            name = "pair"
            [[links]]
            name = "post"
            [[links]]
            name = "first"
            inertia = {{ mass_kg = 1.0, com_m = [0, 0, 0], tensor_kg_m2 = [0.01, 0.01, 0.01, 0, 0, 0] }}
            [[links]]
            name = "second"
            inertia = {{ mass_kg = 1.0, com_m = [0, 0, 0], tensor_kg_m2 = [0.01, 0.01, 0.01, 0, 0, 0] }}
            [[joints]]
            name = "a"
            type = "continuous"
            parent = "post"
            child = "first"
            axis = [0, 1, 0]
            damping = {damping}
            [[joints]]
            name = "b"
            type = "continuous"
            parent = "post"
            child = "second"
            axis = [0, 1, 0]
            damping = {damping}
            mimic = {{ joint = "a", multiplier = 3.0 }}
            "#
        ))
    };
    for damping in [2.0, 50.0] {
        let (mut q, mut qd) = ([0.1], [1.0]);
        advance(&wheels(damping), STEP_S, 20, &mut q, &mut qd, &[4.0]);
        let one = flywheel(0.1, &format!("damping = {}", 10.0 * damping));
        let (mut q1, mut qd1) = ([0.1], [1.0]);
        advance(&one, STEP_S, 20, &mut q1, &mut qd1, &[4.0]);
        assert!((q[0] - q1[0]).abs() < 1e-13 && (qd[0] - qd1[0]).abs() < 1e-12);
    }
}

/// A chain of three joints, revolute and prismatic, with arbitrary inertias and damping.
fn chain() -> impl Strategy<Value = Robot> {
    let link = (
        0.001..2.0_f64,
        prop::array::uniform3(-0.2..0.2_f64),
        prop::array::uniform3(0.3..1.0_f64),
        1e-6..1e-2_f64,
    );
    let joint = (
        any::<bool>(),
        prop::array::uniform3(0.1..1.0_f64),
        prop::array::uniform3(-0.3..0.3_f64),
        0.0..50.0_f64,
        prop_oneof![Just(0.0), 0.0..0.01_f64],
    );
    (prop::collection::vec(link, 3), prop::collection::vec(joint, 3)).prop_map(|(links, joints)| {
        let mut text = "format = 1\nname = 'chain'\n[[links]]\nname = 'l0'\n".to_owned();
        for (i, (mass, com, tensor, scale)) in links.iter().enumerate() {
            // moments of 0.3 to 1 are those of a body, since 0.3 + 0.3 is not; the sums of squares are
            let [a, b, c] = tensor.map(|x| x * scale);
            text += &format!(
                "[[links]]\nname = 'l{}'\ninertia = {{ mass_kg = {mass}, com_m = {com:?}, tensor_kg_m2 = [{}, {}, {}, 0, 0, 0] }}\n",
                i + 1, b + c, a + c, a + b
            );
        }
        for (i, (turns, axis, at, damping, armature)) in joints.iter().enumerate() {
            let kind = if *turns { "continuous" } else { "prismatic" };
            text += &format!(
                "[[joints]]\nname = 'j{i}'\ntype = '{kind}'\nparent = 'l{i}'\nchild = 'l{}'\norigin = {{ xyz_m = {at:?} }}\n\
                 axis = {axis:?}\ndamping = {damping}\narmature = {armature}\n",
                i + 1
            );
        }
        robot(&text)
    })
}

proptest! {
    #[test]
    fn damping_is_implicit_exactly_where_its_fastest_rate_is_beyond_half_a_step(
        robot in chain(),
        q in prop::array::uniform3(-2.0..2.0_f64),
        tenths in 1_u8..40,
    ) {
        let rate = fastest_damping(&robot, &q);
        prop_assume!(rate > 0.0);
        let dt_s = f64::from(tenths) / 10.0 * 0.5 / rate;
        // not at the threshold, where rounding decides
        prop_assume!(tenths != 10);
        let mut step = SmoothStep::new(&robot, Vector3::zeros(), dt_s);
        prop_assert_eq!(step.damping_inertia(&robot, &q).is_some(), tenths > 10);
    }

    #[test]
    fn damping_alone_never_speeds_a_robot_up(
        robot in chain(),
        q in prop::array::uniform3(-2.0..2.0_f64),
        qd in prop::array::uniform3(-1.0..1.0_f64),
        times in 1.0..1e6_f64,
    ) {
        let rate = fastest_damping(&robot, &q);
        prop_assume!(rate > 1e-3);
        let dt_s = (times * 0.5 / rate).min(0.01);
        let energy = |q: &[f64; 3], qd: &[f64; 3]| {
            let (q, qd) = (robot.positions(q).unwrap(), robot.velocities(qd).unwrap());
            kinemark_sim::dynamics::energy(&robot, &Vector3::zeros(), &q, &qd).kinetic_j
        };
        let (mut at, mut rates) = (q, qd);
        let before = energy(&at, &rates);
        let mut step = SmoothStep::new(&robot, Vector3::zeros(), dt_s);
        for _ in 0..20 {
            step.advance(&robot, &[0.0; 3], &mut at, &mut rates).unwrap();
        }
        prop_assert!(energy(&at, &rates) <= before * (1.0 + 1e-6), "{} {}", before, energy(&at, &rates));
    }
}
