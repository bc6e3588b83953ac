//! Robots by DH table, by joint string and with a closed loop, against `tests/golden/{D,E,G,H_puma560}*.json`, whose `how`
//! and `crosscheck` name the tools behind the numbers.

use kinemark_sim::dynamics::{
    GRAVITY_M_S2, bias_effort, driven_efforts, driven_mass_matrix, forward_dynamics,
    gravity_effort, inverse_dynamics, mass_matrix,
};
use kinemark_sim::format::joint_string;
use kinemark_sim::kinematics::closure::{closed_positions, loop_gap_m};
use kinemark_sim::kinematics::{forward_kinematics, frame_twist, geometric_jacobian};
use kinemark_sim::model::robot::{Frame, Robot};
use kinemark_sim::spatial::Pose;
use nalgebra::{Matrix3, Matrix4, Vector3};
use serde_json::Value;

use crate::arms::{lab_robot, robot};
use crate::golden_rrbot::{golden, numbers};

pub(crate) fn rows(value: &Value) -> Vec<Vec<f64>> {
    let list = value.as_array().expect("rows");
    list.iter().map(numbers).collect()
}

fn pose_at(robot: &Robot, q: &[f64], frame: &Frame) -> Pose {
    let q = robot.positions(q).expect("q");
    forward_kinematics(robot, &q).world_from(frame)
}

/// The largest difference between a pose and a 4 by 4 matrix whose lengths are in units of `unit_m`.
fn pose_error(pose: &Pose, expected: &Value, unit_m: f64) -> f64 {
    let expected = rows(expected);
    let mut expected = Matrix4::from_fn(|i, j| expected[i][j]);
    for i in 0..3 {
        expected[(i, 3)] *= unit_m;
    }
    (pose.to_homogeneous() - expected).amax()
}

fn worst(got: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(got.len(), expected.len());
    let differences = got.iter().zip(expected).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

#[test]
fn the_rppr_of_a_modified_dh_table_agrees() {
    let robot = lab_robot("rppr");
    let file = golden("D_rppr.json");
    let samples = file["samples"].as_array().expect("samples");
    assert_eq!(samples.len(), 51);
    // the file is in mm; joints 2 and 3 slide
    let si = |v: &Value| -> Vec<f64> {
        let scale = [1.0, 1e-3, 1e-3, 1.0];
        numbers(v).iter().zip(scale).map(|(x, s)| x * s).collect()
    };
    for sample in samples {
        let q = si(&sample["q"]);
        let pose = pose_at(&robot, &q, robot.tcp());
        // 1e-9 mm, as stated for the file, and rotations to its 15 digits
        let error = pose_error(&pose, &sample["T_0P"], 1e-3);
        assert!(error <= 1e-12, "pose: {error:.1e}");
        let (q, qd) = (
            robot.positions(&q).expect("q"),
            robot.velocities(&si(&sample["dq"])).expect("dq"),
        );
        let twist = frame_twist(&robot, &q, &qd, robot.tcp());
        let velocity = Vector3::from_vec(numbers(&sample["velocity_0"])) * 1e-3;
        let omega = Vector3::from_vec(numbers(&sample["omega_0"]));
        assert!((twist.linear - velocity).amax() <= 1e-12);
        assert!((twist.angular - omega).amax() <= 1e-12);
    }
}

/// The file states 1e-11, but prints angles with 12 digits: half of the last digit of 179.454001544 degrees, four lengths away,
/// moves a point by 3.5e-11.
const CONFIGURATION_TOLERANCE: f64 = 4.5e-11;

#[test]
fn configuration_strings_agree() {
    let file = golden("E_deseroi.json");
    for case in file["configurations"].as_array().expect("configurations") {
        let text = case["config"].as_str().expect("config");
        let links: Vec<String> = rows(&case["links"])
            .iter()
            .map(|l| format!("{},{},{}", l[0], l[1], l[2]))
            .collect();
        let base = case["h_base"].as_f64().expect("base");
        let robot =
            joint_string::robot(text, base, &links.join("; "), joint_string::ALUMINIUM_KG_M3)
                .expect(text);
        let last = robot.links().last().expect("links").name.clone();
        let last = robot.frame(&last).expect("last link");
        for sample in case["samples"].as_array().expect("samples") {
            // the source's interface is in degrees for joints that turn
            let q: Vec<f64> = numbers(&sample["q_deg_or_len"])
                .iter()
                .zip(robot.moving_joints())
                .map(|(q, joint)| {
                    if joint.kind.turns() {
                        q.to_radians()
                    } else {
                        *q
                    }
                })
                .collect();
            for (frame, key) in [(last, "H_last_joint"), (robot.tcp(), "T_tip")] {
                let error = pose_error(&pose_at(&robot, &q, frame), &sample[key], 1.0);
                assert!(
                    error <= CONFIGURATION_TOLERANCE,
                    "{text} {key}: {error:.1e}"
                );
            }
            let q = robot.positions(&q).expect("q");
            let jacobian = geometric_jacobian(&robot, &q, robot.tcp());
            for (i, row) in rows(&sample["jac_tip"]).iter().enumerate() {
                let got: Vec<f64> = jacobian.row(i).iter().copied().collect();
                assert!(
                    worst(&got, row) <= CONFIGURATION_TOLERANCE,
                    "{text} jacobian row {i}"
                );
            }
        }
    }
    for text in file["invalid_strings"].as_array().expect("invalid") {
        let text = text.as_str().expect("text");
        assert!(
            joint_string::robot(text, 2.0, "0,0,1", 0.0).is_err(),
            "{text:?}"
        );
    }
}

#[test]
fn the_puma_of_a_standard_dh_table_agrees() {
    let robot = lab_robot("puma560");
    let file = golden("H_puma560.json");
    let g = GRAVITY_M_S2;
    for (name, q) in file["named_configs"].as_object().expect("named") {
        let error = pose_error(
            &pose_at(&robot, &numbers(q), robot.tcp()),
            &file["fk_named"][name],
            1.0,
        );
        assert!(error <= 1e-9, "{name}: {error:.1e}");
    }
    let states = file["states"].as_array().expect("states");
    assert_eq!(states.len(), 21);
    for state in states {
        let q = robot.positions(&numbers(&state["q"])).expect("q");
        let qd = robot.velocities(&numbers(&state["v"])).expect("v");
        let qdd = robot.accelerations(&numbers(&state["a"])).expect("a");
        let tau = robot.efforts(&numbers(&state["tau_in"])).expect("tau");
        let pose = forward_kinematics(&robot, &q).world_from(robot.tcp());
        assert!(pose_error(&pose, &state["T"], 1.0) <= 1e-9);
        let jacobian = geometric_jacobian(&robot, &q, robot.tcp());
        for (i, row) in rows(&state["J"]).iter().enumerate() {
            let got: Vec<f64> = jacobian.row(i).iter().copied().collect();
            assert!(worst(&got, row) <= 1e-9, "jacobian row {i}");
        }
        let close = |got: &[f64], key: &str| {
            let error = worst(got, &numbers(&state[key]));
            assert!(error <= 1e-9, "{key}: {error:.1e}");
        };
        close(
            inverse_dynamics(&robot, &g, &q, &qd, &qdd).as_slice(),
            "rnea",
        );
        let gravity = gravity_effort(&robot, &g, &q);
        close(gravity.as_slice(), "gravity");
        let bias = bias_effort(&robot, &g, &q, &qd);
        close(
            (bias.vector() - gravity.vector()).as_slice(),
            "coriolis_torque",
        );
        let m = mass_matrix(&robot, &q);
        for (i, row) in rows(&state["mass_matrix"]).iter().enumerate() {
            let got: Vec<f64> = m.row(i).iter().copied().collect();
            assert!(worst(&got, row) <= 1e-9, "mass matrix row {i}");
        }
        let got = forward_dynamics(&robot, &g, &q, &qd, &tau).expect("not singular");
        for (got, expected) in got.as_slice().iter().zip(numbers(&state["aba_ddq"])) {
            // relative, as stated: the wrist's inertia is tiny and its accelerations reach 1e5 rad/s²
            assert!((got - expected).abs() <= 1e-8 * (1.0 + expected.abs()));
        }
    }
}

#[test]
fn the_puma_with_its_motors_agrees() {
    let file = golden("H_puma560.json");
    let path = format!("{}/../labs/robots/puma560.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).expect(&path);
    let mut motors = file["dh_and_dynamics"].as_array().expect("rows").iter();
    let lines = text.lines().map(|line| {
        if line != "type = \"revolute\"" {
            return line.to_owned();
        }
        let motor = motors.next().expect("a motor for each row");
        let number = |key: &str| motor[key].as_f64().expect("a number");
        let gear = number("gear_G").abs();
        let tc = numbers(&motor["coulomb_Tc"]);
        format!(
            "{line}\ndrive = {{ ratio = {gear}, rotor_inertia = {} }}\ndamping = {}\n\
             dry_friction = {{ positive = {}, negative = {} }}",
            number("motor_inertia_Jm"),
            number("viscous_B") * gear * gear,
            gear * tc[0],
            -gear * tc[1],
        )
    });
    let robot = robot(&lines.collect::<Vec<_>>().join("\n"));
    assert!(robot.joints().iter().all(|j| j.mimic.is_none()));
    for state in file["states"].as_array().expect("states") {
        let q = robot.positions(&numbers(&state["q"])).expect("q");
        let qd = robot.velocities(&numbers(&state["v"])).expect("v");
        let qdd = robot.accelerations(&numbers(&state["a"])).expect("a");
        let got = inverse_dynamics(&robot, &GRAVITY_M_S2, &q, &qd, &qdd);
        let parts = ["rnea", "motor_inertia_torque", "friction_torque_link_side"];
        let parts = parts.map(|key| numbers(&state[key]));
        for (i, got) in got.as_slice().iter().enumerate() {
            let expected: f64 = parts.iter().map(|part| part[i]).sum();
            assert!(
                (got - expected).abs() <= 1e-9,
                "joint {i}: {got} {expected}"
            );
        }
    }
    // and as a file that is written and read again
    let again = crate::arms::robot(&robot.to_toml(&mut str::to_owned));
    for (one, other) in robot.joints().iter().zip(again.joints()) {
        assert_eq!(
            (one.dry_friction, one.drive),
            (other.dry_friction, other.drive)
        );
    }
}

#[test]
fn the_uarm_of_a_closed_loop_agrees() {
    let robot = lab_robot("uarm");
    let file = golden("G_uarm.json");
    let names: Vec<&str> = robot
        .independent()
        .iter()
        .map(|&i| robot.moving_joints().nth(i).expect("joint").name.as_str())
        .collect();
    assert_eq!(names, ["turn", "crank", "lower_arm"]);
    let check = |theta_deg: &[f64], rates: &[f64], accelerations: &[f64], tcp_mm: &[f64]| {
        let theta: Vec<f64> = theta_deg.iter().map(|x| x.to_radians()).collect();
        let q = closed_positions(&robot, &theta).expect("closed");
        let gap = loop_gap_m(&robot, &q);
        assert!(gap <= 1e-14, "gap {gap:.1e}");
        let tcp = pose_at(&robot, &q, robot.tcp()).translation.vector * 1e3;
        let error = worst(tcp.as_slice(), tcp_mm);
        (
            error,
            driven_efforts(&robot, &GRAVITY_M_S2, &theta, rates, accelerations).expect("driven"),
        )
    };
    for state in file["random_states"].as_array().expect("random states") {
        let theta = numbers(&state["theta_deg"]);
        let (tcp_error, motion) = check(
            &theta,
            &numbers(&state["dtheta"]),
            &numbers(&state["ddtheta"]),
            &numbers(&state["tcp_mm"]),
        );
        // 1e-9 mm as stated, and the printed digits: 5e-10 degrees of turn at up to 0.35 m
        assert!(tcp_error <= 4e-9, "tcp {tcp_error:.1e} mm at {theta:?}");
        let error = worst(&motion.effort, &numbers(&state["tau"]));
        assert!(error <= 1e-11, "torque {error:.1e} N m at {theta:?}");
        let m = driven_mass_matrix(&robot, &motion.q).expect("not singular");
        for (i, row) in rows(&state["mass_matrix"]).iter().enumerate() {
            let got: Vec<f64> = m.row(i).iter().copied().collect();
            assert!(worst(&got, row) <= 1e-11, "mass matrix row {i}");
        }
        let still = driven_efforts(
            &robot,
            &GRAVITY_M_S2,
            &theta.iter().map(|x| x.to_radians()).collect::<Vec<_>>(),
            &[0.0; 3],
            &[0.0; 3],
        )
        .expect("driven");
        assert!(worst(&still.effort, &numbers(&state["gravity"])) <= 1e-11);
    }
    let rows = rows(&file["trajectory"]["rows"]);
    assert_eq!(rows.len(), 401);
    for row in rows {
        // the law itself: theta = a sin(w t), in degrees
        let law = [(150.0, 0.25), (15.0, 1.0), (20.0, 1.0)];
        let of = |f: &dyn Fn(f64, f64, f64) -> f64| law.map(|(a, w)| f(a, w, w * row[0]));
        let theta = of(&|a, _, x| a * libm::sin(x));
        let rates = of(&|a, w, x| (a * w * libm::cos(x)).to_radians());
        let accelerations = of(&|a, w, x| (-a * w * w * libm::sin(x)).to_radians());
        let (tcp_error, motion) = check(&theta, &rates, &accelerations, &row[4..7]);
        // printed with 11 digits
        assert!(tcp_error <= 6e-9, "tcp {tcp_error:.1e} mm at {} s", row[0]);
        let error = worst(&motion.effort, &row[7..10]);
        assert!(error <= 1e-11, "torque {error:.1e} N m at {} s", row[0]);
    }
}

#[test]
fn a_rotation_matrix_of_quarter_turns_is_exact() {
    let robot = lab_robot("rppr");
    let pose = pose_at(&robot, &[0.0; 4], robot.tcp());
    let expected = Matrix3::new(0.0, -1.0, 0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0);
    assert_eq!(*pose.rotation.matrix(), expected);
}
