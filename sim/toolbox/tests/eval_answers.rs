//! One test per operation, against a number worked by hand or by another way.

use std::f64::consts::FRAC_PI_2;

use kinemark_toolbox::eval::Numbers;
use kinemark_toolbox::eval::kinematics::{Fk, fk};
use serde_json::{Value, json};

use crate::{ask, close, numbers, robot_of, rrbot, uarm};

// of 0.3 and of 0.3 - 1.2, from tables
const SIN_1: f64 = 0.295_520_206_661_339_6;
const COS_1: f64 = 0.955_336_489_125_606;
const SIN_12: f64 = -0.783_326_909_627_483_4;
const COS_12: f64 = 0.621_609_968_270_664_4;

#[test]
fn info_names_joints_and_frames() {
    let answer = ask(&rrbot(), &json!({ "op": "info" }));
    assert_eq!(answer["joints"][1]["name"], "elbow");
    assert_eq!(answer["joints"][1]["type"], "revolute");
    assert_eq!(
        answer["frames"],
        json!(["base", "upper", "forearm", "tcp", "lab"])
    );
    let answer = ask(&uarm(), &json!({ "op": "info" }));
    assert_eq!(answer["independent"], json!(["turn", "crank", "lower_arm"]));
    assert_eq!(answer["joints"].as_array().map(Vec::len), Some(5));
}

#[test]
fn fk_adds_the_links_up() {
    let answer = ask(
        &rrbot(),
        &json!({ "op": "fk", "q": [0.3, -1.2], "in": "lab" }),
    );
    let expected = [2.0 + COS_1 + COS_12, SIN_1 + SIN_12, 0.05];
    close(&answer["position_m"], &expected, 1e-15);
    let base = ask(
        &rrbot(),
        &json!({ "op": "fk", "q": [0.3, -1.2], "frame": "base" }),
    );
    close(
        &base["rotation"],
        &[1., 0., 0., 0., 1., 0., 0., 0., 1.],
        0.0,
    );
}

#[test]
fn the_jacobian_is_that_of_the_planar_arm() {
    let request = json!({ "op": "jacobian", "q": [0.3, -1.2], "in": "lab" });
    let answer = ask(&rrbot(), &request);
    let rows = &answer["jacobian"];
    close(&rows[0], &[-SIN_1 - SIN_12, -SIN_12], 1e-15);
    close(&rows[1], &[COS_1 + COS_12, COS_12], 1e-15);
    close(&rows[5], &[1.0, 1.0], 1e-15);
    assert_eq!(answer.get("independent_jacobian"), None);
    let looped = ask(&uarm(), &json!({ "op": "jacobian", "q": [0, 0, 0] }));
    assert_eq!(
        looped["independent_jacobian"][0].as_array().map(Vec::len),
        Some(3)
    );
}

#[test]
fn the_derivative_of_the_jacobian_is_its_difference_quotient() {
    let (q, qd, h) = ([0.3, -1.2], [1.0, -2.0], 1e-6); // truncation O(h²) and round-off O(ε/h) meet near 1e-10
    let jacobian = |t: f64| {
        let q = [q[0] + t * qd[0], q[1] + t * qd[1]];
        numbers(&ask(&rrbot(), &json!({ "op": "jacobian", "q": q }))["jacobian"])
    };
    let (plus, minus) = (jacobian(h), jacobian(-h));
    let slope: Vec<f64> = plus
        .iter()
        .zip(&minus)
        .map(|(a, b)| (a - b) / (2.0 * h))
        .collect();
    let request = json!({ "op": "jacobian_derivative", "q": q, "qd": qd });
    close(
        &ask(&rrbot(), &request)["jacobian_derivative"],
        &slope,
        1e-8,
    );
}

#[test]
fn manipulability_is_the_sine_of_the_elbow() {
    let at = |elbow: f64| {
        ask(
            &rrbot(),
            &json!({ "op": "manipulability", "q": [0.4, elbow], "in": "lab", "rows": [0, 1] }),
        )
    };
    close(&at(0.8)["measure"], &[0.717_356_090_899_522_8], 1e-14);
    assert_eq!(at(0.0)["condition"], Value::Null);
}

#[test]
fn the_workspace_reaches_as_far_as_the_arm_is_long() {
    let request = json!({ "op": "workspace", "samples": 200, "from_m": [0, 0.05, 2] });
    let answer = ask(&rrbot(), &request);
    assert_eq!(answer["points_m"].as_array().map(Vec::len), Some(200));
    let reach_m = numbers(&answer["reach_m"])[0];
    assert!((1.95..=2.0 + 1e-12).contains(&reach_m), "{reach_m}");
}

#[test]
fn ik_undoes_fk() {
    let target = json!({ "position_m": [2.0 + COS_1 + COS_12, SIN_1 + SIN_12, 0.05] });
    let request = json!({ "op": "ik", "target": target, "in": "lab", "q0": [0.1, -1] });
    let answer = ask(&rrbot(), &request);
    assert_eq!(answer["reached"], true);
    close(&answer["q"], &[0.3, -1.2], 2e-5);
}

#[test]
fn a_group_is_solved_in_its_order() {
    // two frames of one arm that cannot both be where they are wanted
    let group = |order: &str| {
        ask(
            &rrbot(),
            &json!({ "op": "ik", "order": order, "q0": [0.5, 0.5], "targets": [
            { "frame": "tcp", "position_m": [1.0, 0.05, 3.0] },
            { "frame": "forearm", "position_m": [0.0, 0.025, 3.0] },
        ] }),
        )
    };
    assert_eq!(group("priority")["targets"][0]["reached"], true);
    assert_eq!(
        group("in-turn")["targets"].as_array().map(Vec::len),
        Some(2)
    );
    assert_eq!(group("together").get("targets"), None);
}

#[test]
fn the_centre_of_mass_of_a_straight_arm_is_between_its_links() {
    let request = json!({ "op": "com", "q": [0, 0], "in": "lab" });
    let answer = ask(&rrbot(), &request);
    // links at 2.5 and 3.5 m
    assert_eq!(answer["position_m"][0], 3.0);
    assert_eq!(answer["mass_kg"], 1.0);
    let all = ask(
        &rrbot(),
        &json!({ "op": "com", "q": [0, 0], "in": "lab", "counted": "all" }),
    );
    assert_eq!(
        (&all["position_m"][0], &all["mass_kg"]),
        (&json!(2.0), &json!(2.0))
    );
}

#[test]
fn gravity_pulls_on_a_horizontal_arm() {
    // 0.5 kg at 0.5 m and at 1.5 m
    let answer = ask(&rrbot(), &json!({ "op": "gravity", "q": [FRAC_PI_2, 0] }));
    close(&answer["effort"], &[-9.81, -9.81 / 4.0], 1e-14);
    let moon = json!({ "op": "gravity", "q": [FRAC_PI_2, 0], "gravity_m_s2": [0, 0, -1] });
    close(&ask(&rrbot(), &moon)["effort"], &[-1.0, -0.25], 1e-15);
}

#[test]
fn coriolis_terms_are_those_of_a_bent_elbow() {
    // m l lc qd² with a right angle
    let request = json!({ "op": "coriolis", "q": [0, FRAC_PI_2], "qd": [1, 0] });
    close(&ask(&rrbot(), &request)["effort"], &[0.0, 0.25], 1e-15);
}

#[test]
fn the_bias_is_gravity_and_coriolis() {
    let state = json!({ "q": [0.3, -1.2], "qd": [1, -2] });
    let ask_op = |op: &str, qd: bool| {
        let mut request = json!({ "op": op, "q": state["q"] });
        if qd {
            request["qd"] = state["qd"].clone();
        }
        numbers(&ask(&rrbot(), &request)["effort"])
    };
    let (gravity, coriolis) = (ask_op("gravity", false), ask_op("coriolis", true));
    let sum: Vec<f64> = gravity.iter().zip(&coriolis).map(|(a, b)| a + b).collect();
    close(&json!(ask_op("bias", true)), &sum, 1e-13);
}

#[test]
fn rnea_has_the_damping_of_a_straight_arm() {
    let request = json!({ "op": "rnea", "q": [0, 0], "qd": [1, 0], "qdd": [0, 0] });
    close(&ask(&rrbot(), &request)["effort"], &[0.7, 0.0], 1e-15);
}

#[test]
fn inverse_dynamics_of_a_tree_is_rnea() {
    let with = |op: &str| {
        let request = json!({ "op": op, "q": [0.3, -1.2], "qd": [1, -2], "qdd": [0.5, 3] });
        ask(&rrbot(), &request)["effort"].clone()
    };
    assert_eq!(with("inverse_dynamics"), with("rnea"));
    let request =
        json!({ "op": "inverse_dynamics", "q": [0, 0, 0], "qd": [0, 0, 0], "qdd": [0, 0, 0] });
    let answer = ask(&uarm(), &request);
    assert_eq!(answer["joints"], json!(["turn", "crank", "lower_arm"]));
    assert_eq!(answer["q"].as_array().map(Vec::len), Some(5));
}

#[test]
fn the_mass_matrix_of_a_straight_arm_adds_up() {
    // a rod of 1 m by 0.05 m: m (w² + l²) / 12 about its middle
    let rod = 0.5 * (0.05 * 0.05 + 1.0) / 12.0;
    let elbow = rod + 0.5 * 0.25;
    let coupled = elbow + 0.5 * 0.5;
    let shoulder = rod + 0.5 * 0.25 + rod + 0.5 * 2.25;
    let answer = ask(&rrbot(), &json!({ "op": "crba", "q": [0, 0] }));
    close(
        &answer["mass_matrix"],
        &[shoulder, coupled, coupled, elbow],
        1e-14,
    );
    let looped = ask(&uarm(), &json!({ "op": "crba", "q": [0, 0, 0] }));
    assert_eq!(
        looped["independent_mass_matrix"].as_array().map(Vec::len),
        Some(3)
    );
}

#[test]
fn aba_undoes_the_mass_matrix() {
    let matrix = ask(&rrbot(), &json!({ "op": "crba", "q": [0, 0] }))["mass_matrix"].clone();
    // what accelerates the shoulder alone
    let request =
        json!({ "op": "aba", "q": [0, 0], "qd": [0, 0], "effort": [matrix[0][0], matrix[1][0]] });
    close(&ask(&rrbot(), &request)["qdd"], &[1.0, 0.0], 1e-13);
}

#[test]
fn energy_counts_every_link_from_the_ground() {
    let answer = ask(
        &rrbot(),
        &json!({ "op": "energy", "q": [0, 0], "qd": [0, 0] }),
    );
    // 1 kg at 1 m, 0.5 kg at 2.5 m and 3.5 m
    close(&answer["potential_j"], &[9.81 * 4.0], 1e-12);
    close(&answer["kinetic_j"], &[0.0], 0.0);
}

#[test]
fn trajectories_pass_the_numbers_of_their_formulas() {
    let plan = |kind: &str, fields: Value| {
        let mut request = json!({ "op": "trajectory", "kind": kind });
        for (name, value) in fields.as_object().expect("fields") {
            request[name] = value.clone();
        }
        ask(&rrbot(), &request)
    };
    let fields = json!({ "from": [0, 1], "to": [1, 0], "duration_s": 2, "at_s": [1] });
    close(&plan("quintic", fields)["qd"], &[0.9375, -0.9375], 1e-15); // 15/8 D/T
    let fields = json!({ "from": 0, "to": 1, "duration_s": 1, "at_s": [0.5] });
    close(&plan("cubic", fields)["qd"], &[1.5], 1e-15); // 3/2 D/T
    let fields = json!({ "from": 0, "to": 1, "speed": 1, "acceleration": 4 });
    assert_eq!(plan("trapezoid", fields)["duration_s"], 1.25); // D/v + v/a
    let fields = json!({ "from": 0, "to": 2, "speed": 9, "acceleration": 9, "jerk": 1 });
    assert_eq!(plan("jerk-limited", fields)["duration_s"], 4.0); // 4 (D / 2j)^(1/3)
    let fields = json!({ "points": [[0], [1], [0]], "times_s": [0, 1, 2], "at_s": 0.5 });
    close(&plan("spline", fields)["q"], &[0.5], 1e-15); // 3 u² - 2 u³
    let pose = |x: f64, y: f64| json!({ "position_m": [x, y, 0] });
    let fields =
        json!({ "from": pose(0.0, 0.0), "to": pose(3.0, 4.0), "duration_s": 1, "at_s": [0.5] });
    close(&plan("line", fields)["position_m"], &[1.5, 2.0, 0.0], 1e-15);
    let fields = json!({ "from": pose(1.0, 0.0), "via_m": [0, 1, 0], "to": pose(-1.0, 0.0), "law": "trapezoid",
        "speed": 1, "acceleration": 1 });
    close(
        &plan("arc", fields)["length_m"],
        &[std::f64::consts::PI],
        1e-15,
    );
}

/// 2 kg on a rail.
const CART: &str = r#"
format = 1
name = "cart"
[[links]]
name = "rail"
[[links]]
name = "cart"
inertia = { mass_kg = 2.0, tensor_kg_m2 = [0.01, 0.01, 0.01, 0, 0, 0] }
[[joints]]
name = "slide"
type = "prismatic"
parent = "rail"
child = "cart"
axis = [1.0, 0.0, 0.0]
"#;

#[test]
fn a_simulated_cart_falls_under_its_force() {
    let request = json!({ "op": "simulate", "q0": 0, "qd0": 0, "command": 1, "duration_s": 1, "servo_period_s": 0.001,
        "sample_period_s": 0.5, "servo": { "mode": "effort" } });
    let answer = ask(&robot_of(CART), &request);
    assert_eq!(answer["t_s"], json!([0.0, 0.5, 1.0]));
    close(&answer["q"], &[0.0, 0.0625, 0.25], 1e-12); // F t² / 2 m
    close(&answer["qd"], &[0.0, 0.25, 0.5], 1e-12);
    close(&answer["effort"], &[1.0, 1.0, 1.0], 0.0);
}

/// A program that has a robot calls the function of an operation, without JSON.
#[test]
fn a_typed_request_is_answered_as_its_json_is() {
    let robot = rrbot();
    let joint_positions = |q: &[f64]| Fk {
        q: Numbers::List(q.to_vec()),
        frame: None,
        r#in: None,
    };
    let pose = fk(&robot, &joint_positions(&[0.3, -0.2])).expect("a pose");
    let answer = ask(&robot, &json!({ "op": "fk", "q": [0.3, -0.2] }));
    assert_eq!(json!(pose.position_m), answer["position_m"]);
    assert_eq!(json!(pose.rotation), answer["rotation"]);
    // straight up, then 0.3 rad about y, and 0.1 rad: 2 m + cos 0.3 + cos 0.1
    let height_m = 2.0 + 0.955_336_489_125_606 + 0.995_004_165_278_025_8;
    assert!((pose.position_m[2] - height_m).abs() < 1e-12, "{pose:?}");

    let refusal = fk(&robot, &joint_positions(&[0.3])).expect_err("two joints");
    let answer = ask(&robot, &json!({ "op": "fk", "q": [0.3] }));
    assert_eq!(json!(refusal), answer["error"]);
}

#[test]
fn the_centre_of_mass_of_a_robot_in_which_nothing_moves_is_that_of_all_links() {
    // 1.5 kg at the origin, 0.5 kg at 0.4 m
    let still = robot_of(include_str!(
        "../../../tests/robots/peculiar/nothing_moves.urdf"
    ));
    let answer = ask(&still, &json!({ "op": "com", "q": [] }));
    close(&answer["position_m"], &[0.1, 0.0, 0.0], 1e-15);
    close(&answer["mass_kg"], &[2.0], 0.0);
    // what was asked for word by word is not there, and what is there is said
    let answer = ask(
        &still,
        &json!({ "op": "com", "q": [], "counted": "moving" }),
    );
    assert_eq!(answer["error"]["code"], "no-mass");
    let message = answer["error"]["message"].as_str().unwrap_or_default();
    assert!(
        message.contains("`\"counted\": \"all\"`") && message.contains("2 kg"),
        "{message}"
    );
}
