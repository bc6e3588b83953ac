//! The course's arm against `tests/golden/A_rrbot.json`: closed forms cross-checked there with Pinocchio to 4e-15.

use kinemark_sim::dynamics::{
    GRAVITY_M_S2, bias_effort, energy, forward_dynamics, inverse_dynamics, mass_matrix,
};
use kinemark_sim::kinematics::{forward_kinematics, geometric_jacobian};
use serde_json::Value;

use crate::arms::rrbot;

/// As stated for the file: its numbers are rounded to 15 digits.
const TOLERANCE: f64 = 1e-12;

pub(crate) fn golden(name: &str) -> Value {
    let path = format!("{}/../tests/golden/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).expect(&path);
    serde_json::from_str(&text).expect(&path)
}

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list");
    list.iter().map(|x| x.as_f64().expect("a number")).collect()
}

fn close(got: f64, expected: f64, what: &str) {
    assert!(
        (got - expected).abs() <= TOLERANCE,
        "{what}: {got} against {expected}"
    );
}

#[test]
fn poses_jacobians_and_dynamics_agree_in_all_states() {
    let robot = rrbot();
    let (tcp, lab) = (robot.tcp(), robot.frame("lab").expect("lab"));
    let g = GRAVITY_M_S2;
    let states = golden("A_rrbot.json");
    let states = states["fk"].as_array().expect("fk");
    assert_eq!(states.len(), 51);
    for state in states {
        let q = robot.positions(&numbers(&state["q_rad"])).expect("q");
        let qd = robot.velocities(&numbers(&state["dq"])).expect("dq");
        let qdd = robot.accelerations(&numbers(&state["ddq"])).expect("ddq");
        let poses = forward_kinematics(&robot, &q);
        let lab_from_world = poses.world_from(lab).inverse();
        let lab_from_tcp = lab_from_world * poses.world_from(tcp);
        let pos = numbers(&state["pos_m"]);
        for (got, expected) in lab_from_tcp.translation.vector.iter().zip(&pos) {
            close(*got, *expected, "position");
        }
        let jacobian = geometric_jacobian(&robot, &q, tcp);
        let m = mass_matrix(&robot, &q);
        for column in 0..2 {
            let linear = lab_from_world.rotation * jacobian.fixed_view::<3, 1>(0, column);
            for row in 0..2 {
                let expected = numbers(&state["jac_xy"][row])[column];
                close(linear[row], expected, "jacobian");
                close(
                    m[(row, column)],
                    numbers(&state["M"][row])[column],
                    "mass matrix",
                );
            }
        }
        let tau = inverse_dynamics(&robot, &g, &q, &qd, &qdd);
        let bias = bias_effort(&robot, &g, &q, &qd);
        let back = forward_dynamics(&robot, &g, &q, &qd, &tau).expect("not singular");
        for i in 0..2 {
            close(
                tau.as_slice()[i],
                numbers(&state["tau_with_damping"])[i],
                "effort",
            );
            close(
                bias.as_slice()[i],
                numbers(&state["bias_C_plus_G"])[i],
                "bias",
            );
            let expected = qdd.as_slice()[i];
            // M's condition number reaches 60: ABA may lose two digits more than RNEA
            assert!((back.as_slice()[i] - expected).abs() < 1e-10, "aba {i}");
        }
        // potential zero at the shoulder there, at the world's origin here: two arms at 2 m, the post at 1 m
        let e = energy(&robot, &g, &q, &qd);
        let above = 9.81 * (1.0 * 2.0 + 1.0 * 1.0);
        let expected = state["energy_J"].as_f64().expect("energy");
        assert!((e.kinetic_j + e.potential_j - above - expected).abs() < 1e-11);
    }
}

#[test]
fn joint_inertias_are_those_of_boxes() {
    let robot = rrbot();
    let file = golden("A_rrbot.json");
    let inertia = &file["inertia_about_joints"];
    for (q2, name) in [
        (0.0, "q2_0"),
        (std::f64::consts::FRAC_PI_2, "q2_90"),
        (std::f64::consts::PI, "q2_180"),
    ] {
        let m = mass_matrix(&robot, &robot.positions(&[0.3, q2]).expect("q"));
        close(
            m[(0, 0)],
            inertia["joint1_effective_M11"][name].as_f64().expect("M11"),
            name,
        );
        close(
            m[(1, 1)],
            inertia["box_link2_about_joint2"].as_f64().expect("M22"),
            name,
        );
    }
}
