//! The RPPR robot against golden numbers of an independent tool, at special points, and by property.

#![expect(
    clippy::unwrap_used,
    reason = "a test that cannot read its golden file fails"
)]

use std::f64::consts::PI;

use kinemark_reference::rppr::{DhRow, Rppr, RpprIk, roll_rad};
use nalgebra::{Matrix4, Vector3, Vector4};
use proptest::prelude::*;
use serde_json::Value;

/// The golden file has 15 digits of numbers up to 1000 mm.
const TOLERANCE_MM: f64 = 1e-9;
/// Rounding of a handful of products of numbers near one.
const ROUNDING: f64 = 1e-13;

fn golden() -> Value {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/golden/D_rppr.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn robot(golden: &Value) -> Rppr {
    let length = |name: &str| golden["lengths_mm"][name].as_f64().unwrap() / 1000.0;
    Rppr {
        l0_m: length("l0"),
        l1_m: length("l1"),
        l3_m: length("l3"),
        l4_m: length("l4"),
        l5_m: length("l5"),
        l6_m: length("l6"),
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().unwrap().iter();
    list.map(|x| x.as_f64().unwrap()).collect()
}

/// A joint vector of the file, whose lengths are in mm.
fn joints(value: &Value) -> Vector4<f64> {
    let q = numbers(value);
    Vector4::new(q[0], q[1] / 1000.0, q[2] / 1000.0, q[3])
}

/// In the file's units, compared with the file.
fn assert_joints(what: &str, got: Vector4<f64>, expected: &Value) {
    let got = [got[0], 1000.0 * got[1], 1000.0 * got[2], got[3]];
    assert_all(what, &got, &numbers(expected));
}

fn assert_mm(what: &str, got_m: Vector3<f64>, expected: &Value) {
    assert_all(what, (got_m * 1000.0).as_slice(), &numbers(expected));
}

fn assert_rad(what: &str, got_rad: Vector3<f64>, expected: &Value) {
    assert_all(what, got_rad.as_slice(), &numbers(expected));
}

fn assert_all(what: &str, got: &[f64], expected: &[f64]) {
    assert_eq!(got.len(), expected.len(), "{what}");
    for (got, expected) in got.iter().zip(expected) {
        assert!(
            (got - expected).abs() <= TOLERANCE_MM,
            "{what}: got {got:.17}, expected {expected:.17}"
        );
    }
}

fn samples(golden: &Value) -> &[Value] {
    let samples = golden["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 51);
    samples
}

#[test]
fn poses_and_motions_are_those_of_all_samples() {
    let golden = golden();
    let robot = robot(&golden);
    for sample in samples(&golden) {
        let [q, qd, qdd] = ["q", "dq", "ddq"].map(|name| joints(&sample[name]));
        let mut pose = robot.base_from_tcp(q);
        for i in 0..3 {
            pose[(i, 3)] *= 1000.0;
            let row: Vec<f64> = pose.row(i).iter().copied().collect();
            assert_all("pose", &row, &numbers(&sample["T_0P"][i]));
        }
        assert_mm(
            "velocity",
            robot.v_tcp_in_base(q, qd),
            &sample["velocity_0"],
        );
        assert_mm(
            "velocity in tcp",
            robot.v_tcp_in_tcp(q, qd),
            &sample["velocity_P"],
        );
        let a = robot.a_tcp_in_base(q, qd, qdd);
        assert_mm("acceleration", a, &sample["acceleration_0"]);
        let omega = robot.angular_velocity_in_base(q, qd);
        assert_rad("angular velocity", omega, &sample["omega_0"]);
        let omega = robot.angular_velocity_in_tcp(q, qd);
        assert_rad("angular velocity in tcp", omega, &sample["omega_P"]);
        let alpha = robot.angular_acceleration_in_base(q, qd, qdd);
        assert_rad("angular acceleration", alpha, &sample["alpha_0"]);
    }
}

#[test]
fn inverses_find_the_joints_of_all_samples() {
    let golden = golden();
    let robot = robot(&golden);
    for sample in samples(&golden) {
        let [q, qd, qdd] = ["q", "dq", "ddq"].map(|name| joints(&sample[name]));
        let rows: Vec<f64> = (0..4).flat_map(|i| numbers(&sample["T_0P"][i])).collect();
        let pose = Matrix4::from_row_slice(&rows);
        let roll = roll_rad(&pose.fixed_view::<3, 3>(0, 0).into_owned()).unwrap();
        let p = pose.fixed_view::<3, 1>(0, 3) / 1000.0;
        let branches = robot.inverse_kinematics(p, roll).isolated();
        let expected = sample["ik_all_branches"].as_array().unwrap();
        assert_eq!(branches.len(), expected.len());
        for (branch, expected) in branches.iter().zip(expected) {
            assert_joints("branch", *branch, expected);
        }
        let index = sample["ik_reachable_branch_index"].as_u64().unwrap() as usize;
        assert_joints(
            "the branch within the strokes",
            branches[index],
            &sample["q"],
        );

        let vector = |name: &str, scale: f64| Vector3::from_vec(numbers(&sample[name])) / scale;
        let (v, omega) = (vector("velocity_0", 1000.0), vector("omega_0", 1.0));
        let rates = robot.inverse_velocity(q, v, omega).unwrap();
        assert_joints("rates", rates, &sample["dq"]);
        let (a, alpha) = (vector("acceleration_0", 1000.0), vector("alpha_0", 1.0));
        let accelerations = robot.inverse_acceleration(q, qd, a, alpha).unwrap();
        assert_joints("accelerations", accelerations, &sample["ddq"]);
        assert!((accelerations - qdd).norm() <= 1e-12);
    }
}

#[test]
fn the_hole_and_its_edge_are_as_the_file_says() {
    let golden = golden();
    let robot = robot(&golden);
    let cases = golden["edge_cases"].as_array().unwrap();
    let [hole, edge] = &cases[..] else {
        panic!("two edge cases");
    };
    let point = |case: &Value| Vector3::from_vec(numbers(&case["xyz"])) / 1000.0;

    let inside = robot.inverse_kinematics(point(hole), 0.0);
    assert_eq!(hole["solutions"], serde_json::json!([]));
    assert!(inside.isolated().is_empty());
    assert!(
        matches!(inside, RpprIk::Unreachable { distance_m, nearest_m } if distance_m < nearest_m)
    );

    let RpprIk::HoleEdge { q } = robot.inverse_kinematics(point(edge), 0.3) else {
        panic!("the edge");
    };
    let expected = [
        edge["q1"].as_f64().unwrap(),
        60.0,
        edge["q3"].as_f64().unwrap(),
        0.3,
    ];
    assert_joints("edge", q, &serde_json::json!(expected));
    let v = Vector3::new(0.1, 0.0, 0.0);
    assert_eq!(robot.inverse_velocity(q, v, Vector3::zeros()), None);
    assert_eq!(robot.inverse_acceleration(q, q, v, Vector3::zeros()), None);
}

#[test]
fn the_sweep_along_a_line_is_the_files() {
    let golden = golden();
    let robot = robot(&golden);
    let rows = golden["sweep_like_fig2"]["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 41);
    for row in rows {
        let row = numbers(row);
        let p = Vector3::new(row[0], row[1], row[2]) / 1000.0;
        let q = robot.inverse_kinematics(p, 0.0).isolated()[0];
        let got = [q[0], 1000.0 * q[1], 1000.0 * q[2]];
        assert_all("sweep", &got, &row[3..6]);
    }
}

#[test]
fn every_point_of_the_hole_edge_is_found_and_none_within() {
    let robot = robot(&golden());
    let reach = robot.l4_m + robot.l6_m;
    for i in -31..=31 {
        let q = Vector4::new(0.1 * f64::from(i), 0.1, reach, 1.0);
        let p = robot.p_tcp_in_base(q);
        let solutions = robot.inverse_kinematics(p, 1.0).isolated();
        assert_eq!(solutions.len(), 1, "at {q}");
        assert!((solutions[0] - q).norm() <= ROUNDING, "at {q}");
        let within = Vector3::new(p.x * 0.999_999, p.y * 0.999_999, p.z);
        assert!(robot.inverse_kinematics(within, 1.0).isolated().is_empty());
    }
}

#[test]
fn odd_robots_and_odd_points_give_no_nan() {
    let mut robot = robot(&golden());
    for bad in [f64::NAN, f64::INFINITY] {
        for i in 0..3 {
            let mut p = Vector3::new(0.1, 0.2, 0.3);
            p[i] = bad;
            let ik = robot.inverse_kinematics(p, 0.0);
            assert!(
                matches!(ik, RpprIk::Unreachable { distance_m, .. } if distance_m == f64::INFINITY)
            );
        }
    }
    robot.l3_m = 0.0;
    let on_axis = robot.inverse_kinematics(Vector3::new(0.0, 0.0, 0.4), 0.0);
    assert_eq!(on_axis, RpprIk::AnyHeading);
    // the arm on either side of the column: half a turn between the branches
    let beside = robot
        .inverse_kinematics(Vector3::new(0.0, 0.3, 0.4), 0.0)
        .isolated();
    assert!(beside[0][0].abs() <= ROUNDING && (beside[1][0].abs() - PI).abs() <= ROUNDING);
}

#[test]
fn an_upright_tool_has_no_roll() {
    let upright = nalgebra::Matrix3::identity();
    assert_eq!(roll_rad(&upright), None);
    assert_eq!(roll_rad(&(upright * f64::NAN)), None);
}

/// Craig's forward transform of one row.
fn transform(row: &DhRow) -> Matrix4<f64> {
    let (st, ct) = libm::sincos(row.theta_rad);
    let (sa, ca) = libm::sincos(row.alpha_rad);
    #[rustfmt::skip]
    let transform = Matrix4::new(
        ct,      -st,       0.0, row.a_m,
        st * ca,  ct * ca, -sa,  -sa * row.d_m,
        st * sa,  ct * sa,  ca,   ca * row.d_m,
        0.0,      0.0,      0.0,  1.0,
    );
    transform
}

fn joint_vector() -> impl Strategy<Value = Vector4<f64>> {
    (-3.1..3.1, -0.5..0.5, -0.5..1.5, -3.1..3.1).prop_map(|(a, b, c, d)| Vector4::new(a, b, c, d))
}

proptest! {
    #[test]
    fn the_pose_is_the_product_of_the_table(q in joint_vector()) {
        let robot = robot(&golden());
        let product = robot.dh_rows(q).iter().fold(Matrix4::identity(), |t, row| t * transform(row));
        prop_assert!((product - robot.base_from_tcp(q)).norm() <= ROUNDING);
    }

    #[test]
    fn every_branch_reaches_its_point(
        x in -1.0..1.0, y in -1.0..1.0, z in -1.0..1.0, roll in -PI..PI, l3 in -0.3..0.3,
    ) {
        let robot = Rppr { l3_m: l3, ..robot(&golden()) };
        let p = Vector3::new(x, y, z);
        let solutions = robot.inverse_kinematics(p, roll).isolated();
        prop_assert_eq!(solutions.is_empty(), libm::hypot(x, y) < l3.abs());
        for q in solutions {
            prop_assert!((robot.p_tcp_in_base(q) - p).norm() <= ROUNDING);
            let pose = robot.base_from_tcp(q);
            let found = roll_rad(&pose.fixed_view::<3, 3>(0, 0).into_owned()).unwrap();
            prop_assert!((found - roll).abs() <= ROUNDING);
        }
    }

    #[test]
    fn motions_are_slopes_of_what_they_move(
        q in joint_vector(), qd in joint_vector(), qdd in joint_vector(),
    ) {
        let robot = robot(&golden());
        // error of a central difference: h² times third derivatives, up to about 100 here, and rounding over h, below 1e-11
        let (h, tolerance) = (1e-5, 1e-7);
        let at = |t: f64| (q + qd * t + qdd * (0.5 * t * t), qd + qdd * t);
        let ((q_before, qd_before), (q_after, qd_after)) = (at(-h), at(h));
        let v = (robot.p_tcp_in_base(q_after) - robot.p_tcp_in_base(q_before)) / (2.0 * h);
        prop_assert!((v - robot.v_tcp_in_base(q, qd)).norm() <= tolerance);
        let a = (robot.v_tcp_in_base(q_after, qd_after) - robot.v_tcp_in_base(q_before, qd_before)) / (2.0 * h);
        prop_assert!((a - robot.a_tcp_in_base(q, qd, qdd)).norm() <= tolerance);
        let alpha = (robot.angular_velocity_in_base(q_after, qd_after)
            - robot.angular_velocity_in_base(q_before, qd_before)) / (2.0 * h);
        prop_assert!((alpha - robot.angular_acceleration_in_base(q, qd, qdd)).norm() <= tolerance);
        // the TCP's axes turn at the angular velocity
        let turn = |q| robot.base_from_tcp(q).fixed_view::<3, 3>(0, 0).into_owned();
        let spin = (turn(q_after) - turn(q_before)) / (2.0 * h);
        let omega = robot.angular_velocity_in_base(q, qd);
        prop_assert!((spin - omega.cross_matrix() * turn(q)).norm() <= tolerance);
        // and the same vectors stand in them
        prop_assert!((turn(q) * robot.v_tcp_in_tcp(q, qd) - robot.v_tcp_in_base(q, qd)).norm() <= ROUNDING * 10.0);
        prop_assert!(
            (turn(q) * robot.a_tcp_in_tcp(q, qd, qdd) - robot.a_tcp_in_base(q, qd, qdd)).norm() <= ROUNDING * 100.0
        );
        prop_assert!((turn(q) * robot.angular_velocity_in_tcp(q, qd) - omega).norm() <= ROUNDING);
    }

    #[test]
    fn inverse_motions_undo_the_forward_ones(
        q in joint_vector(), qd in joint_vector(), qdd in joint_vector(),
    ) {
        let robot = robot(&golden());
        let reach = robot.reach_m(q[2]).abs();
        prop_assume!(reach > 1e-3);
        // numbers up to about 100, and one division by the reach
        let tolerance = 1e-12 / reach;
        let v = robot.v_tcp_in_base(q, qd);
        let rates = robot.inverse_velocity(q, v, robot.angular_velocity_in_base(q, qd)).unwrap();
        prop_assert!((rates - qd).norm() <= tolerance);
        let a = robot.a_tcp_in_base(q, qd, qdd);
        let alpha = robot.angular_acceleration_in_base(q, qd, qdd);
        let accelerations = robot.inverse_acceleration(q, qd, a, alpha).unwrap();
        prop_assert!((accelerations - qdd).norm() <= tolerance);
    }
}
