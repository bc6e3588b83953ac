//! The planar arm: inverse kinematics against an independent tool's numbers, special points by hand, and laws by property.

#![expect(
    clippy::unwrap_used,
    reason = "a test that cannot read its golden file fails"
)]

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use kinemark_reference::planar_2r::{IkSolutions, JointState, Planar2r};
use nalgebra::{Matrix2, Vector2};
use proptest::prelude::*;
use serde_json::Value;

/// The golden file has 15 digits of numbers up to 10.
const TOLERANCE: f64 = 1e-12;

fn golden() -> Value {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/golden/A_rrbot.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("not a number: {value}"))
}

fn pair(value: &Value) -> Vector2<f64> {
    Vector2::new(number(&value[0]), number(&value[1]))
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

fn assert_near(what: &str, got: f64, expected: f64) {
    assert!(
        (got - expected).abs() <= TOLERANCE,
        "{what}: got {got:.17}, expected {expected:.17}"
    );
}

fn assert_all_near<'a>(
    what: &str,
    got: impl IntoIterator<Item = &'a f64>,
    expected: impl IntoIterator<Item = f64>,
) {
    let (got, expected): (Vec<_>, Vec<_>) =
        (got.into_iter().collect(), expected.into_iter().collect());
    assert_eq!(got.len(), expected.len(), "{what}");
    for (got, expected) in got.into_iter().zip(expected) {
        assert_near(what, *got, expected);
    }
}

#[test]
fn golden_inverse_kinematics() {
    let (golden, arm) = (golden(), Planar2r::lab_arm());
    assert_eq!(list(&golden["ik"]).len(), 50);
    for sample in list(&golden["ik"]) {
        let solutions = arm.inverse_kinematics(number(&sample["x"]), number(&sample["y"]));
        let IkSolutions::Branches {
            elbow_plus_rad,
            elbow_minus_rad,
        } = solutions
        else {
            panic!("{sample}: {solutions:?}");
        };
        for (got, key) in [
            (elbow_plus_rad, "elbow_plus_rad"),
            (elbow_minus_rad, "elbow_minus_rad"),
        ] {
            assert_all_near(key, got.iter(), list(&sample[key]).iter().map(number));
        }
    }
}

#[test]
fn golden_edge_cases() {
    let (golden, arm) = (golden(), Planar2r::lab_arm());
    let mut names = Vec::new();
    for case in list(&golden["ik_edge_cases"]) {
        let solutions = arm.inverse_kinematics(number(&case["x"]), number(&case["y"]));
        let name = case["name"].as_str().unwrap();
        match name {
            "fully_stretched_up" | "fully_stretched_side" | "origin_of_base" => {
                let IkSolutions::Straight { q_rad } = solutions else {
                    panic!("{name}: {solutions:?}")
                };
                // The file lists one solution once or twice.
                for expected in list(&case["solutions_rad"]) {
                    assert_all_near(name, q_rad.iter(), list(expected).iter().map(number));
                }
                assert_near(name, arm.jacobian_determinant(q_rad), 0.0);
            }
            "just_outside" | "far_outside" => {
                let IkSolutions::Unreachable {
                    distance_m,
                    nearest_m,
                    farthest_m,
                } = solutions
                else {
                    panic!("{name}: {solutions:?}");
                };
                assert!(distance_m > farthest_m, "{solutions:?}");
                assert_eq!((nearest_m, farthest_m), (0.0, 2.0));
            }
            "shoulder" => assert_eq!(solutions, IkSolutions::AnyShoulderAngle),
            other => panic!("no edge case called {other}"),
        }
        names.push(name);
    }
    assert_eq!(names.len(), 6);
}

#[test]
fn golden_lab_1_targets() {
    let (golden, arm) = (golden(), Planar2r::lab_arm());
    let lab1 = &golden["lab1"];
    assert_eq!(list(&lab1["targets"]).len(), 3);
    for target in list(&lab1["targets"]) {
        let goal = &target["target_m"];
        let solutions = arm
            .inverse_kinematics(number(&goal[0]), number(&goal[1]))
            .isolated();
        let expected = list(&target["solutions_deg"]);
        assert_eq!(solutions.len(), expected.len(), "{target}");
        for q in &solutions {
            let p = arm.p_tcp_in_lab(*q);
            assert_all_near("target", p.iter(), list(goal).iter().map(number));
            // The file sorts by shoulder angle in one list and by name of branch nowhere: match by content.
            let in_degrees = q.map(f64::to_degrees);
            assert!(
                expected
                    .iter()
                    .any(|e| (pair(e) - in_degrees).norm() < 1e-10),
                "{in_degrees} {target}"
            );
            let positive = in_degrees.map(|a| if a < 0.0 { a + 360.0 } else { a });
            let expected = list(&target["solutions_deg_0_360"]);
            assert!(
                expected.iter().any(|e| (pair(e) - positive).norm() < 1e-10),
                "{positive} {target}"
            );
        }
    }
}

#[test]
fn the_labs_rounded_angles_miss_by_14_mm() {
    // errata 003-12
    let (golden, arm) = (golden(), Planar2r::lab_arm());
    let rounded = list(&golden["lab1"]["report_rounded_solutions"]);
    assert_eq!(rounded.len(), 4);
    for sample in rounded {
        let p = arm.p_tcp_in_lab(pair(&sample["report_q_deg"]).map(f64::to_radians));
        assert_all_near(
            "position",
            p.iter(),
            list(&sample["fk_m"]).iter().map(number),
        );
        let error_m = (p.xy() - pair(&sample["target"])).norm();
        assert_near("error", error_m, number(&sample["position_error_m"]));
        assert!((error_m - 0.0142).abs() < 1e-4, "{error_m}");
    }
}

/// An arm whose links differ in everything.
fn unequal(l1_m: f64, l2_m: f64) -> Planar2r {
    Planar2r {
        base_height_m: 0.3,
        l1_m,
        l2_m,
        m1_kg: 1.7,
        m2_kg: 0.4,
        com1_m: 0.35 * l1_m,
        com2_m: 0.6 * l2_m,
        i1_com_kg_m2: 0.03,
        i2_com_kg_m2: 0.008,
        ..Planar2r::lab_arm()
    }
}

#[test]
fn right_angles_worked_by_hand() {
    let arm = unequal(0.8, 0.5);
    // upper link sideways, lower link up again
    let q = Vector2::new(FRAC_PI_2, -FRAC_PI_2);
    assert_all_near(
        "position",
        arm.p_tcp_in_lab(q).iter(),
        [0.3 + 0.5, 0.8, 0.05],
    );
    let jacobian = arm.tcp_jacobian_in_lab(q);
    assert_all_near("Jacobian", jacobian.iter(), [-0.8, 0.5, 0.0, 0.5]);
    assert_near("determinant", arm.jacobian_determinant(q), -0.4);
    // gravity pulls on the sideways upper link, with the lower link's weight at the elbow
    let hold = arm.gravity_efforts_n_m(q);
    assert_all_near("hold", hold.iter(), [-9.81 * (1.7 * 0.28 + 0.4 * 0.8), 0.0]);
}

#[test]
fn unequal_links_fold_on_the_inner_circle() {
    for (l1, l2, q1) in [(0.8, 0.5, FRAC_PI_2), (0.5, 0.8, -FRAC_PI_2)] {
        let arm = unequal(l1, l2);
        let solutions = arm.inverse_kinematics(0.3, 0.3);
        let IkSolutions::Folded { q_rad } = solutions else {
            panic!("{solutions:?}")
        };
        assert_all_near("folded", q_rad.iter(), [q1, PI]);
        assert_all_near("back", arm.p_tcp_in_lab(q_rad).iter(), [0.3, 0.3, 0.05]);
        // Closer is out of reach, and the shoulder most of all.
        for y in [0.299, 0.0] {
            let solutions = arm.inverse_kinematics(0.3, y);
            assert!(
                matches!(solutions, IkSolutions::Unreachable { .. }),
                "{solutions:?}"
            );
        }
    }
}

#[test]
fn a_target_that_is_not_finite_is_unreachable() {
    for (x, y) in [
        (f64::NAN, 0.0),
        (1.0, f64::NAN),
        (f64::INFINITY, 0.0),
        (f64::MAX, f64::MAX),
    ] {
        let solutions = Planar2r::lab_arm().inverse_kinematics(x, y);
        let far = matches!(solutions, IkSolutions::Unreachable { distance_m, .. } if distance_m == f64::INFINITY);
        assert!(far, "{solutions:?}");
    }
}

#[test]
fn the_elbow_keeps_its_digits_next_to_the_straight_arm() {
    // d = 2 cos(q₂/2): at q₂ = 1e-5 the distance differs from 2 by 2.5e-11
    let arm = Planar2r {
        base_height_m: 0.0,
        ..Planar2r::lab_arm()
    };
    let q2 = 1e-5;
    let IkSolutions::Branches { elbow_plus_rad, .. } =
        arm.inverse_kinematics(2.0 * libm::cos(q2 / 2.0), 0.0)
    else {
        panic!("inside the circle");
    };
    // a last place of the distance, 4e-16, is worth 4e-16 / (q₂/2)
    assert!((elbow_plus_rad.y - q2).abs() < 1e-10, "{elbow_plus_rad}");
    assert!(
        (elbow_plus_rad.x + q2 / 2.0).abs() < 1e-10,
        "{elbow_plus_rad}"
    );
}

#[test]
fn a_hanging_arm_rests() {
    let arm = unequal(0.8, 0.5);
    let rest = JointState {
        q_rad: Vector2::new(PI, 0.0),
        qd_rad_s: Vector2::zeros(),
    };
    let acceleration = arm.forward_dynamics_rad_s2(&rest, Vector2::zeros());
    assert!(acceleration.norm() < 1e-13, "{acceleration}");
    assert_near(
        "lowest",
        arm.energy_j(&rest),
        -9.81 * (1.7 * 0.28 + 0.4 * (0.8 + 0.3)),
    );
}

/// Whether two angles are equal up to full turns.
fn same_angle(a: f64, b: f64, tolerance: f64) -> bool {
    let turns = (a - b) / TAU;
    (turns - turns.round()).abs() * TAU <= tolerance
}

proptest! {
    #[test]
    fn inverse_kinematics_returns_to_the_target(
        l1 in 0.1..2.0f64, l2 in 0.1..2.0f64, fraction in 0.0..1.0f64, direction in -PI..PI,
    ) {
        let arm = unequal(l1, l2);
        let (nearest, farthest) = ((l1 - l2).abs(), l1 + l2);
        let distance = nearest + fraction * (farthest - nearest);
        let target = Vector2::new(0.3 + distance * libm::cos(direction), distance * libm::sin(direction));
        let solutions = arm.inverse_kinematics(target.x, target.y);
        let isolated = solutions.isolated();
        prop_assert!(!isolated.is_empty(), "{solutions:?}");
        for q in isolated {
            prop_assert!((arm.p_tcp_in_lab(q).xy() - target).norm() < 1e-13, "{solutions:?}");
            prop_assert!((-PI..PI).contains(&q.x), "{solutions:?}");
        }
        if let IkSolutions::Branches { elbow_plus_rad, elbow_minus_rad } = solutions {
            prop_assert!(elbow_plus_rad.y > 0.0 && elbow_minus_rad.y < 0.0, "{solutions:?}");
        }
    }

    #[test]
    fn one_branch_is_where_the_target_came_from(
        l1 in 0.1..2.0f64, l2 in 0.1..2.0f64, q1 in -PI..PI, q2 in -PI..PI,
    ) {
        // Near the singular circles a rounded target is worth half its digits.
        prop_assume!(libm::sin(q2).abs() > 1e-3 && (l1 - l2).abs() > 1e-2);
        let arm = unequal(l1, l2);
        let p = arm.p_tcp_in_lab(Vector2::new(q1, q2));
        let solutions = arm.inverse_kinematics(p.x, p.y);
        let found = (solutions.isolated().iter())
            .any(|q| same_angle(q.x, q1, 1e-9) && same_angle(q.y, q2, 1e-9));
        prop_assert!(found, "{solutions:?}");
    }

    #[test]
    fn a_straight_arm_is_in_reach_whatever_the_rounding(
        base in -3.0..3.0f64, l1 in 0.1..2.0f64, l2 in 0.1..2.0f64, q1 in -PI..PI,
    ) {
        let arm = Planar2r { base_height_m: base, ..unequal(l1, l2) };
        let p = arm.p_tcp_in_lab(Vector2::new(q1, 0.0));
        let solutions = arm.inverse_kinematics(p.x, p.y);
        prop_assert!(matches!(solutions, IkSolutions::Straight { .. }), "{solutions:?}");
        let p = arm.p_tcp_in_lab(Vector2::new(q1, PI));
        let solutions = arm.inverse_kinematics(p.x, p.y);
        prop_assert!(!solutions.isolated().is_empty(), "{solutions:?}");
    }

    #[test]
    fn jacobian_matches_central_differences(q1 in -3.2..3.2f64, q2 in -3.2..3.2f64) {
        let (arm, q, h) = (unequal(0.8, 0.5), Vector2::new(q1, q2), 1e-5);
        let jacobian = arm.tcp_jacobian_in_lab(q);
        for j in 0..2 {
            let mut dq = Vector2::zeros();
            dq[j] = h;
            // truncation h² and round-off ε/h meet near 1e-10
            let slope = (arm.p_tcp_in_lab(q + dq) - arm.p_tcp_in_lab(q - dq)).xy() / (2.0 * h);
            prop_assert!((jacobian.column(j) - slope).norm() < 1e-9, "{jacobian} {slope}");
        }
        prop_assert!((jacobian.determinant() - arm.jacobian_determinant(q)).abs() < 1e-15);
    }

    #[test]
    fn forward_dynamics_undoes_inverse_dynamics(
        q1 in -3.2..3.2f64, q2 in -3.2..3.2f64, w1 in -5.0..5.0f64, w2 in -5.0..5.0f64,
        a1 in -9.0..9.0f64, a2 in -9.0..9.0f64,
    ) {
        let arm = unequal(0.8, 0.5);
        let state = JointState { q_rad: Vector2::new(q1, q2), qd_rad_s: Vector2::new(w1, w2) };
        let qdd = Vector2::new(a1, a2);
        let back = arm.forward_dynamics_rad_s2(&state, arm.inverse_dynamics_n_m(&state, qdd));
        prop_assert!((back - qdd).norm() < 1e-11, "{back} {qdd}");
        let m = arm.mass_matrix(state.q_rad);
        prop_assert!(m == m.transpose() && m.m11 > 0.0 && m.determinant() > 0.0, "{m}");
    }

    #[test]
    fn energy_grows_by_the_power_of_the_efforts_less_damping(
        q1 in -3.2..3.2f64, q2 in -3.2..3.2f64, w1 in -5.0..5.0f64, w2 in -5.0..5.0f64,
        t1 in -9.0..9.0f64, t2 in -9.0..9.0f64,
    ) {
        let arm = unequal(0.8, 0.5);
        let state = JointState { q_rad: Vector2::new(q1, q2), qd_rad_s: Vector2::new(w1, w2) };
        let efforts = Vector2::new(t1, t2);
        let acceleration = arm.forward_dynamics_rad_s2(&state, efforts);
        // along the motion's tangent: dE/dt depends on q̇ and q̈ alone
        let h = 1e-6;
        let moved = |dt: f64| JointState {
            q_rad: state.q_rad + dt * state.qd_rad_s,
            qd_rad_s: state.qd_rad_s + dt * acceleration,
        };
        let rate = (arm.energy_j(&moved(h)) - arm.energy_j(&moved(-h))) / (2.0 * h);
        let power = efforts.dot(&state.qd_rad_s) - arm.joint_damping_n_m_s * state.qd_rad_s.norm_squared();
        // truncation: h² times the third derivative, up to (10/s)³ of the energy, here with accelerations to 10³
        let size = 1.0 + power.abs() + acceleration.norm_squared();
        prop_assert!((rate - power).abs() < 1e-7 * size, "{rate} {power}");
    }

    #[test]
    fn bias_is_what_lagrange_says(
        q1 in -3.2..3.2f64, q2 in -3.2..3.2f64, w1 in -5.0..5.0f64, w2 in -5.0..5.0f64,
    ) {
        // Ṁ q̇ - ½ ∂(q̇ᵀ M q̇)/∂q + ∂V/∂q, with M and V alone
        let (arm, h) = (unequal(0.8, 0.5), 1e-5);
        let state = JointState { q_rad: Vector2::new(q1, q2), qd_rad_s: Vector2::new(w1, w2) };
        let (q, w) = (state.q_rad, state.qd_rad_s);
        let along = |dq: Vector2<f64>| -> Matrix2<f64> { (arm.mass_matrix(q + dq) - arm.mass_matrix(q - dq)) / (2.0 * h) };
        let mut expected = along(h * w) * w;
        for j in 0..2 {
            let mut dq = Vector2::zeros();
            dq[j] = h;
            expected[j] -= 0.5 * w.dot(&(along(dq) * w));
            expected[j] += (arm.potential_energy_j(q + dq) - arm.potential_energy_j(q - dq)) / (2.0 * h);
        }
        let bias = arm.bias_n_m(&state);
        prop_assert!((bias - expected).norm() < 1e-7, "{bias} {expected}");
    }
}
