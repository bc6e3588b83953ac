//! `kinemark robot eval` on robots of every kind: the golden numbers of joint strings, DH tables, loops, URDFs and textbook
//! inverse kinematics, through the JSON interface.

use serde_json::{Value, json};

use crate::eval::{close, eval_with, golden, numbers};
use crate::testbed::{TestBed, root};

pub(crate) fn model(name: &str) -> String {
    let path = root().join("tests/golden/models").join(name);
    path.to_str().expect("UTF-8").to_owned()
}

/// Asks, expects every request to be answered.
pub(crate) fn ask(robot: &[&str], requests: &[Value]) -> Vec<Value> {
    let lines: Vec<String> = requests.iter().map(Value::to_string).collect();
    let (answers, code) = eval_with(&TestBed::new(), robot, &lines);
    let bad = answers.iter().find(|answer| answer.get("error").is_some());
    assert_eq!((bad, code), (None, Some(0)), "{robot:?}");
    assert_eq!(answers.len(), requests.len());
    answers
}

pub(crate) fn rows(value: &Value) -> Vec<Vec<f64>> {
    value
        .as_array()
        .expect("rows")
        .iter()
        .map(numbers)
        .collect()
}

/// Position and rotation of a pose given as rows of `[R | p]`.
fn parts(pose: &Value) -> (Value, Value) {
    let rows = rows(pose);
    let position: Vec<f64> = rows[..3].iter().map(|row| row[3]).collect();
    let rotation: Vec<&[f64]> = rows[..3].iter().map(|row| &row[..3]).collect();
    (json!(position), json!(rotation))
}

/// Index of each joint of the robot in the order of the golden file.
fn order(robot: &[&str], golden_order: &Value) -> Vec<usize> {
    let info = ask(robot, &[json!({ "op": "info" })]);
    let golden_order = golden_order.as_array().expect("joint order");
    let joints = info[0]["joints"].as_array().expect("joints");
    let place = |joint: &Value| golden_order.iter().position(|name| *name == joint["name"]);
    joints
        .iter()
        .map(|joint| place(joint).expect("a joint of the file"))
        .collect()
}

fn pick(value: &Value, order: &[usize]) -> Value {
    let values = numbers(value);
    json!(order.iter().map(|&i| values[i]).collect::<Vec<f64>>())
}

fn pick_columns(value: &Value, order: &[usize]) -> Value {
    let pick = |row: &Vec<f64>| order.iter().map(|&i| row[i]).collect::<Vec<f64>>();
    json!(rows(value).iter().map(pick).collect::<Vec<_>>())
}

#[test]
fn configuration_strings_answer_with_the_golden_numbers() {
    // the file states 1e-11, but prints angles with 12 digits: 3.5e-11 m at four lengths
    let tolerance = 4.5e-11;
    for case in golden("E_deseroi.json")["configurations"]
        .as_array()
        .expect("configurations")
    {
        let text = case["config"].as_str().expect("config");
        let links: Vec<String> = rows(&case["links"])
            .iter()
            .map(|l| format!("{},{},{}", l[0], l[1], l[2]))
            .collect();
        let (links, base) = (links.join("; "), case["h_base"].to_string());
        let robot = [text, "--base", &base, "--links", &links];
        let turns = |i: usize| text.as_bytes()[2 * i] == b'R';
        let last = format!("link{}", text.len() / 2);
        let samples = case["samples"].as_array().expect("samples");
        let requests: Vec<Value> = samples
            .iter()
            .flat_map(|sample| {
                // joints that turn are in degrees there
                let q = numbers(&sample["q_deg_or_len"]);
                let q: Vec<f64> = q
                    .iter()
                    .enumerate()
                    .map(|(i, q)| if turns(i) { q.to_radians() } else { *q })
                    .collect();
                [
                    json!({ "op": "fk", "q": q, "frame": last }),
                    json!({ "op": "fk", "q": q }),
                    json!({ "op": "jacobian", "q": q }),
                ]
            })
            .collect();
        let answers = ask(&robot, &requests);
        for (sample, answers) in samples.iter().zip(answers.chunks(3)) {
            for (answer, key) in [(&answers[0], "H_last_joint"), (&answers[1], "T_tip")] {
                let (position, rotation) = parts(&sample[key]);
                close(&answer["position_m"], &position, tolerance, key);
                close(&answer["rotation"], &rotation, tolerance, key);
            }
            close(
                &answers[2]["jacobian"],
                &sample["jac_tip"],
                tolerance,
                "jacobian",
            );
        }
    }
}

#[test]
fn the_loop_answers_with_the_golden_numbers() {
    let file = golden("G_uarm.json");
    let states = file["random_states"].as_array().expect("states");
    let requests: Vec<Value> = states
        .iter()
        .flat_map(|state| {
            let theta = numbers(&state["theta_deg"]);
            let q: Vec<f64> = theta.iter().map(|x| x.to_radians()).collect();
            let (qd, qdd) = (&state["dtheta"], &state["ddtheta"]);
            [
                json!({ "op": "inverse_dynamics", "q": q, "qd": qd, "qdd": qdd }),
                json!({ "op": "fk", "q": q }),
                json!({ "op": "crba", "q": q }),
                json!({ "op": "aba", "q": q, "qd": qd, "effort": state["tau"] }),
            ]
        })
        .collect();
    let answers = ask(&["uarm"], &requests);
    for (state, answers) in states.iter().zip(answers.chunks(4)) {
        // tolerances stated for the file; positions are in mm, of angles printed with 12 digits
        assert_eq!(answers[0]["joints"], json!(["turn", "crank", "lower_arm"]));
        close(&answers[0]["effort"], &state["tau"], 1e-11, "torque");
        let p_mm: Vec<f64> = numbers(&answers[1]["position_m"])
            .iter()
            .map(|x| x * 1e3)
            .collect();
        close(&json!(p_mm), &state["tcp_mm"], 4e-9, "tcp");
        let mass = &answers[2]["independent_mass_matrix"];
        close(mass, &state["mass_matrix"], 1e-11, "mass matrix");
        // forward dynamics of those torques gives the accelerations back: 1e-11 N m on 1e-3 kg m² and less
        let qdd = numbers(&answers[3]["qdd"]);
        let driven = json!([qdd[0], qdd[1], qdd[3]]);
        close(&driven, &state["ddtheta"], 1e-7, "aba");
    }
}

#[test]
fn the_dh_table_answers_with_the_golden_numbers() {
    let file = golden("H_puma560.json");
    let states = file["states"].as_array().expect("states");
    check_states(&["puma560"], states, &(0..6).collect::<Vec<_>>(), None);
}

#[test]
fn urdfs_answer_with_the_golden_numbers() {
    let (panda, ur5) = (model("panda.urdf"), model("ur5.urdf"));
    for (name, robot) in [
        ("H_panda.json", vec![panda.as_str(), "--ignore-mimic"]),
        ("H_ur5.json", vec![ur5.as_str()]),
    ] {
        let file = golden(name);
        let order = order(&robot, &file["convention"]["joint_order"]);
        let states = file["states"].as_array().expect("states");
        check_states(&robot, states, &order, file["frame"].as_str());
    }
    let tree = model("randtree.urdf");
    let file = golden("H_randtree.json");
    let order = order(&[&tree], &file["convention"]["joint_order"]);
    for frame in ["l11", "l06"] {
        let mut states = file["states"].as_array().expect("states").clone();
        for state in &mut states {
            state["T"] = state["T"][frame].clone();
            state["J"] = state["J"][frame].clone();
        }
        check_states(&[&tree], &states, &order, Some(frame));
    }
}

/// Checks states of the `H_*` files, at their stated tolerances.
fn check_states(robot: &[&str], states: &[Value], order: &[usize], frame: Option<&str>) {
    let requests: Vec<Value> = states
        .iter()
        .flat_map(|state| {
            let of = |key: &str| pick(&state[key], order);
            let (q, qd, qdd) = (of("q"), of("v"), of("a"));
            [
                json!({ "op": "fk", "q": q, "frame": frame }),
                json!({ "op": "jacobian", "q": q, "frame": frame }),
                json!({ "op": "inverse_dynamics", "q": q, "qd": qd, "qdd": qdd }),
                json!({ "op": "crba", "q": q }),
                json!({ "op": "aba", "q": q, "qd": qd, "effort": of("tau_in") }),
                json!({ "op": "com", "q": q, "counted": "moving" }),
                json!({ "op": "bias", "q": q, "qd": qd }),
            ]
        })
        .collect();
    let answers = ask(robot, &requests);
    for (state, answers) in states.iter().zip(answers.chunks(7)) {
        let (position, rotation) = parts(&state["T"]);
        close(&answers[0]["position_m"], &position, 1e-9, "position");
        close(&answers[0]["rotation"], &rotation, 1e-9, "rotation");
        close(
            &answers[1]["jacobian"],
            &pick_columns(&state["J"], order),
            1e-9,
            "jacobian",
        );
        let mass: Vec<Vec<f64>> = rows(&state["mass_matrix"]);
        let mass: Vec<&Vec<f64>> = order.iter().map(|&i| &mass[i]).collect();
        close(
            &answers[3]["mass_matrix"],
            &pick_columns(&json!(mass), order),
            1e-9,
            "mass matrix",
        );
        let expected = numbers(&pick(&state["aba_ddq"], order));
        for (got, expected) in numbers(&answers[4]["qdd"]).iter().zip(&expected) {
            // relative, as stated: light wrists reach 1e5 rad/s²
            assert!(
                (got - expected).abs() <= 1e-8 * (1.0 + expected.abs()),
                "aba"
            );
        }
        close(&answers[5]["position_m"], &state["com"], 1e-9, "com");
        // damping and friction of the URDFs are not in the numbers
        let bias = pick(&state["gravity"], order);
        let bias: Vec<f64> = numbers(&bias)
            .iter()
            .zip(numbers(&pick(&state["coriolis_torque"], order)))
            .map(|(g, c)| g + c)
            .collect();
        close(&answers[6]["effort"], &json!(bias), 1e-9, "bias");
    }
}

#[test]
fn the_humanoid_answers_with_the_golden_numbers() {
    let robot = model("humanoid25.urdf");
    let robot = [robot.as_str()];
    let file = golden("F_humanoid25.json");
    let order = order(&robot, &file["conventions"]["joint_order"]);
    let states = file["states"].as_array().expect("states");
    let requests: Vec<Value> = states
        .iter()
        .flat_map(|state| {
            let of = |key: &str| pick(&state[key], &order);
            let (q, qd, qdd) = (of("q"), of("v"), of("a"));
            [
                json!({ "op": "fk", "q": q, "frame": "left_foot" }),
                json!({ "op": "jacobian", "q": q, "frame": "right_gear" }),
                json!({ "op": "rnea", "q": q, "qd": qd, "qdd": qdd }),
                json!({ "op": "com", "q": q, "counted": "moving" }),
                json!({ "op": "energy", "q": q, "qd": qd }),
            ]
        })
        .collect();
    let answers = ask(&robot, &requests);
    // 1e-10 as stated
    for (state, answers) in states.iter().zip(answers.chunks(5)) {
        // only the first states have poses and Jacobians
        let pose = &state["fk_3x4"]["left_foot"];
        if !pose.is_null() {
            let (position, rotation) = parts(pose);
            close(&answers[0]["position_m"], &position, 1e-10, "position");
            close(&answers[0]["rotation"], &rotation, 1e-10, "rotation");
        }
        let jacobian = &state["jac_6xn"]["right_gear"];
        if !jacobian.is_null() {
            let jacobian = pick_columns(jacobian, &order);
            close(&answers[1]["jacobian"], &jacobian, 1e-10, "jacobian");
        }
        close(
            &answers[2]["effort"],
            &pick(&state["rnea"], &order),
            1e-10,
            "rnea",
        );
        close(&answers[3]["position_m"], &state["com"], 1e-10, "com");
        close(
            &answers[4]["kinetic_j"],
            &state["kinetic_energy"],
            1e-10,
            "energy",
        );
    }
}

#[test]
fn textbook_inverse_kinematics_answers_with_the_golden_residuals() {
    let robot = model("humanoid25.urdf");
    let robot = [robot.as_str()];
    let file = golden("F_humanoid25.json");
    let info = ask(&robot, &[json!({ "op": "info" })]);
    let names = info[0]["independent"].as_array().expect("names").clone();
    let cases = file["ik"].as_array().expect("ik");
    let requests: Vec<Value> = cases
        .iter()
        .map(|case| {
            let chain = case["chain"].as_array().expect("chain");
            let q0: Vec<f64> = names
                .iter()
                .map(|name| {
                    let place = chain.iter().position(|joint| joint == name);
                    place.map_or(0.0, |i| numbers(&case["q0_chain"])[i])
                })
                .collect();
            let mut target = json!({ "position_m": case["target_position"] });
            if case["position_only"] == false {
                target["rotation"] = case["target_R"].clone();
            }
            let mut request = json!({
                "op": "ik", "frame": case["tip"], "target": target, "q0": q0, "chain": chain,
                "max_iterations": case["iterations"], "respect_limits": false,
            });
            if case["algorithm"] == "pinv" {
                request["method"] = json!("pseudo-inverse");
            } else {
                request["method"] = json!("damped-least-squares");
                request["damping"] = case["lambda_"].clone();
            }
            request
        })
        .collect();
    let answers = ask(&robot, &requests);
    let mut compared = 0;
    for (case, answer) in cases.iter().zip(&answers) {
        // two paths leap by more than 100 rad: their ends depend on the last of the twelve digits of the target
        let leaps = case["algorithm"] == "pinv"
            && case["position_only"] == false
            && case["max_abs_step_rad"]
                .as_f64()
                .is_some_and(|step| step > 100.0);
        if case["reproducible"] == true && !leaps {
            // 1e-6 as stated for final errors
            let expected = &case["final_position_error_m"];
            close(&answer["residual_m"], expected, 1e-6, "position error");
            if case["position_only"] == false {
                let expected = &case["final_orientation_error_rad"];
                close(&answer["residual_rad"], expected, 1e-6, "orientation error");
            }
            compared += 1;
        }
    }
    assert_eq!(compared, 20);
}
