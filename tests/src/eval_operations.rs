//! What `kinemark robot eval` answers beyond the golden numbers: mimic joints, loops, inverse kinematics, manipulability, derivatives,
//! targets in order, workspaces.

use kinemark_sim::control::{Derivative, GainLists, Mode, ServoSettings};
use kinemark_sim::dynamics::GRAVITY_M_S2;
use kinemark_sim::format::RobotFile;
use kinemark_sim::kinematics::closure::closed_positions;
use kinemark_sim::run::{End, Recorder, Row, Setup, run};
use kinemark_sim::text::Source;
use kinemark_sim::ticks::Periods;
use serde_json::{Value, json};

use crate::eval::{close, eval_with, numbers};
use crate::eval_golden::{ask, model, rows};
use crate::eval_refusals::FOUR_BAR;
use crate::testbed::TestBed;

#[test]
fn a_mimic_joint_follows_its_master() {
    let panda = model("panda.urdf");
    let info = ask(&[&panda], &[json!({ "op": "info" })]);
    assert_eq!(info[0]["joints"].as_array().map(Vec::len), Some(8));
    assert_eq!(
        info[0]["mimics"],
        json!([{ "name": "panda_finger_joint2", "joint": "panda_finger_joint1", "multiplier": 1.0, "offset": 0.0 }])
    );
    let mut q = vec![0.3, -0.4, 0.2, -1.5, 0.1, 1.6, 0.7, 0.03];
    let fk = |q: &[f64]| json!({ "op": "fk", "q": q, "frame": "panda_rightfinger" });
    let followed = ask(&[&panda], &[fk(&q)]);
    q.push(0.03);
    let apart = ask(
        &[&panda, "--ignore-mimic"],
        &[fk(&q), json!({ "op": "info" })],
    );
    assert_eq!(followed[0], apart[0]);
    assert_eq!(apart[1]["mimics"], json!([]));
    assert_eq!(apart[1]["independent"].as_array().map(Vec::len), Some(9));
}

#[test]
fn without_loops_independent_joints_are_all_joints() {
    let state = json!({ "q": [0.3, -1.2], "qd": [1.0, -2.0], "qdd": [0.5, 3.0] });
    let with = |op: &str| {
        let mut request = state.clone();
        request["op"] = json!(op);
        request
    };
    let answers = ask(&["rrbot"], &[with("rnea"), with("inverse_dynamics")]);
    // damping and friction included: the same to the bit
    assert_eq!(answers[0]["effort"], answers[1]["effort"]);
    assert_eq!(answers[1]["q"], state["q"]);
}

#[test]
fn inverse_kinematics_reaches_what_forward_kinematics_gave() {
    let panda = model("panda.urdf");
    let robot = [panda.as_str()];
    let q = [0.3, -0.4, 0.2, -1.5, 0.1, 1.6, 0.7, 0.03];
    let fk = ask(
        &robot,
        &[json!({ "op": "fk", "q": q, "frame": "panda_hand_tcp" })],
    );
    let (position, rotation) = (&fk[0]["position_m"], &fk[0]["rotation"]);
    let arm: Vec<String> = (1..8).map(|i| format!("panda_joint{i}")).collect();
    let pose = json!({ "position_m": position, "rotation": rotation });
    let z: Vec<f64> = rows(rotation).iter().map(|row| row[2]).collect();
    let requests = [
        json!({ "op": "ik", "frame": "panda_hand_tcp", "target": pose, "chain": arm }),
        json!({ "op": "ik", "frame": "panda_hand_tcp", "target": { "position_m": position } }),
        json!({ "op": "ik", "frame": "panda_hand_tcp", "target": { "rotation": rotation } }),
        json!({ "op": "ik", "frame": "panda_hand_tcp",
            "target": { "position_m": position, "axis": [0, 0, 2], "direction": z } }),
        json!({ "op": "ik", "targets": [
            { "frame": "panda_hand_tcp", "position_m": position, "rotation": rotation },
            { "frame": "panda_hand", "rotation": rotation, "weight": 0.5 } ] }),
        json!({ "op": "ik", "frame": "panda_hand_tcp", "target": pose, "method": "fallback",
            "q0": q, "damping": 0.05 }),
        // a posture keeps the redundant arm near itself
        json!({ "op": "ik", "frame": "panda_hand_tcp", "target": pose, "posture": q, "posture_gain": 0.5 }),
    ];
    let answers = ask(&robot, &requests);
    for (request, answer) in requests.iter().zip(&answers) {
        assert_eq!(answer["reached"], true, "{request}: {answer}");
        let check = ask(
            &robot,
            &[json!({ "op": "fk", "q": answer["q"], "frame": "panda_hand_tcp" })],
        );
        // the default tolerance, and two roundings
        if request["target"]["position_m"].is_array() || request["targets"].is_array() {
            close(&check[0]["position_m"], position, 1.01e-5, "position");
        }
        if request.to_string().contains("rotation") {
            close(&check[0]["rotation"], rotation, 2e-5, "rotation");
        }
    }
    // joints outside the chain stay where they were
    assert_eq!(answers[0]["q"][7], 0.0);
}

#[test]
fn out_of_reach_is_an_answer() {
    let request = json!({ "op": "ik", "target": { "position_m": [0, 9, 0] }, "in": "lab" });
    let answers = ask(&["rrbot"], &[request]);
    assert_eq!(answers[0]["reached"], false);
    // the arm stretched sideways: 9 m away less 2 m of arm, from a shoulder 2 m up; the hand is 0.05 m beside the plane
    let left = answers[0]["residual_m"].as_f64().expect("number");
    let shoulder = hypot(2.0, 9.0) - 2.0;
    let expected = hypot(shoulder, 0.05);
    // the arm is nearly straight where steps no longer help: 10 mm of 7 m
    assert!(
        left >= expected && left < expected + 0.01,
        "{left} against {expected}"
    );
}

fn hypot(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

#[test]
fn manipulability_of_the_arm_is_the_sine_of_its_elbow() {
    // in the plane of the arm: |det J| = l1 l2 |sin q2| with links of 1 m
    let ask_at = |q2: f64, rows: Value| json!({ "op": "manipulability", "q": [0.4, q2], "in": "lab", "rows": rows });
    let requests = [
        ask_at(0.8, json!([0, 1])),
        ask_at(0.0, json!([0, 1])),
        ask_at(0.8, json!("angular")),
        ask_at(0.8, Value::Null),
    ];
    let answers = ask(&["rrbot"], &requests);
    close(
        &answers[0]["measure"],
        &json!(0.717_356_090_899_522_8),
        1e-14,
        "sin 0.8",
    );
    let values = numbers(&answers[0]["singular_values"]);
    close(
        &answers[0]["condition"],
        &json!(values[0] / values[1]),
        1e-12,
        "condition",
    );
    // straight: singular
    close(&answers[1]["measure"], &json!(0.0), 1e-14, "straight");
    assert_eq!(answers[1]["condition"], Value::Null);
    close(
        &answers[2]["singular_values"][0],
        &json!(2.0_f64.sqrt()),
        1e-14,
        "two parallel axes",
    );
    assert_eq!(
        answers[3]["measure"], 0.0,
        "two joints have no six-dimensional volume"
    );
}

#[test]
fn a_loop_stays_closed_through_a_run() {
    let servo = json!({ "mode": "position", "kp": 5, "kd": 0.2, "derivative": "velocity", "gravity_compensation": true });
    let run = |q0: Value, qd0: Value, command: Value| {
        json!({
            "op": "simulate", "q0": q0, "qd0": qd0, "command": command, "duration_s": 0.4,
            "servo_period_s": 0.001, "sample_period_s": 0.2, "servo": servo,
        })
    };
    let still = json!([0, 0, 0]);
    let answers = ask(
        &["uarm"],
        &[
            run(still.clone(), still.clone(), still.clone()),
            run(
                json!([0.1, 0.2, 0.1]),
                json!([0, 0.5, 0]),
                json!([0.3, 0.1, 0.2]),
            ),
        ],
    );
    // gravity compensation through the loop holds the arm where it is: rounding over 400 steps
    close(&answers[0]["q"][2], &json!(vec![0.0; 5]), 1e-12, "held");
    let moved = &answers[1];
    for row in moved["effort"].as_array().expect("rows") {
        assert_eq!(
            (&row[2], &row[4]),
            (&json!(0.0), &json!(0.0)),
            "no drive in the loop"
        );
    }
    // the full end state passes as a start again: its loop is closed
    let (q, qd) = (moved["q"][2].clone(), moved["qd"][2].clone());
    let independent = json!([q[0], q[1], q[3]]);
    let rates = json!([qd[0], qd[1], qd[3]]);
    let again = ask(
        &["uarm"],
        &[
            run(q.clone(), qd.clone(), still.clone()),
            json!({ "op": "energy", "q": q, "qd": qd }),
            json!({ "op": "energy", "q": independent, "qd": rates }),
        ],
    );
    // the dependent joints follow from the independent ones
    close(
        &again[1]["kinetic_j"],
        &again[2]["kinetic_j"],
        1e-12,
        "kinetic",
    );
    close(
        &again[1]["potential_j"],
        &again[2]["potential_j"],
        1e-12,
        "potential",
    );
}

#[test]
fn a_robot_with_loops_moves_as_its_servos_would_move_it_in_a_lab() {
    // no joint is marked as passive, so the two that the loop moves have motors too
    let text = FOUR_BAR.replace("passive = true\n", "");
    let file = RobotFile::parse(Source::new("four-bar.toml", text.as_str())).expect("a robot file");
    let robot = file.build(&[]).expect("a robot");
    let start_q = closed_positions(&robot, &[0.1]).expect("closed");
    let (command, ticks) = ([0.5, 0.0, 0.2], 200);
    let gains = GainLists {
        kp: vec![5.0; 3],
        kd: vec![0.5; 3],
        ..GainLists::none(3)
    };
    let servo = ServoSettings::new(
        &robot,
        Mode::Position,
        Derivative::Measurement,
        &gains,
        false,
    );
    let setup = Setup {
        robot: &robot,
        scene: None,
        tcp: robot.tcp(),
        seen_from: &robot.frames()[0],
        periods: Periods::new(0.001, 0.001, 0.001).expect("periods"),
        gravity_m_s2: GRAVITY_M_S2,
        servo: servo.expect("settings"),
        sensors: Vec::new(),
        start_q: start_q.clone(),
        start_qd: vec![0.0; 3],
        laws: None,
        pushes: Vec::new(),
        ticks,
    };
    struct Last(Vec<f64>);
    impl Recorder for Last {
        fn row(&mut self, row: Row<'_>) {
            self.0 = row.q.to_vec();
        }
    }
    let mut last = Last(Vec::new());
    let end = run(
        &setup,
        |_, slot| {
            slot.copy_from_slice(&command);
            Ok::<(), ()>(())
        },
        &mut last,
    );
    assert_eq!(end, Ok(End::Finished));

    let bed = TestBed::new();
    bed.write("four-bar.toml", &text);
    let request = json!({
        "op": "simulate", "q0": start_q, "qd0": [0, 0, 0], "command": command, "duration_s": 0.2,
        "servo_period_s": 0.001, "sample_period_s": 0.2,
        "servo": { "mode": "position", "kp": 5, "kd": 0.5 },
    });
    let (answers, _) = eval_with(&bed, &["four-bar.toml"], &[request.to_string()]);
    assert!(answers[0].get("error").is_none(), "{}", answers[0]);
    assert_eq!(numbers(&answers[0]["q"][1]), last.0);
    // and what a lab refuses is refused here
    for servo in [
        json!({ "mode": "position", "kp": -1 }),
        json!({ "mode": "effort", "effort_limit": 0 }),
    ] {
        let mut refused = request.clone();
        refused["servo"] = servo;
        let (answers, _) = eval_with(&bed, &["four-bar.toml"], &[refused.to_string()]);
        assert_eq!(
            answers[0]["error"]["code"], "out-of-range",
            "{}",
            answers[0]
        );
    }
}

/// Asks the arm of the course; some answers are errors.
pub(crate) fn mixed(requests: &[Value]) -> Vec<Value> {
    let lines: Vec<String> = requests.iter().map(Value::to_string).collect();
    eval_with(&TestBed::new(), &["rrbot"], &lines).0
}

#[test]
fn derivatives_and_parts_of_the_dynamics_fit_together() {
    let (q, qd) = ([0.3, -1.2], [1.0, -2.0]);
    let h = 1e-6; // truncation O(h²) and round-off O(ε/h) meet near 1e-10
    let moved = |t: f64| [q[0] + t * qd[0], q[1] + t * qd[1]];
    let jacobian = |q: [f64; 2]| json!({ "op": "jacobian", "q": q });
    let answers = mixed(&[
        json!({ "op": "jacobian_derivative", "q": q, "qd": qd }),
        jacobian(moved(h)),
        jacobian(moved(-h)),
        json!({ "op": "gravity", "q": q }),
        json!({ "op": "coriolis", "q": q, "qd": qd }),
        json!({ "op": "bias", "q": q, "qd": qd }),
        json!({ "op": "jacobian", "q": q, "angles": "zyz" }),
        json!({ "op": "jacobian", "q": [0.0, 0.0], "angles": "zyz" }),
        json!({ "op": "jacobian", "q": q, "angles": "xyz" }),
    ]);
    let slope = rows(&answers[0]["jacobian_derivative"]);
    let (plus, minus) = (rows(&answers[1]["jacobian"]), rows(&answers[2]["jacobian"]));
    for i in 0..6 {
        for j in 0..2 {
            let difference = (plus[i][j] - minus[i][j]) / (2.0 * h);
            assert!((slope[i][j] - difference).abs() < 1e-8, "{i} {j}");
        }
    }
    let effort = |i: usize| numbers(&answers[i]["effort"]);
    for i in 0..2 {
        assert!((effort(3)[i] + effort(4)[i] - effort(5)[i]).abs() < 1e-13);
    }
    // turning about y by 0.3 - 1.2 < 0: alpha = pi, beta = 0.9, gamma = -pi; beta falls with both joints
    let analytic = rows(&answers[6]["jacobian"]);
    assert!((analytic[4][0].abs() - 1.0).abs() < 1e-12);
    assert_eq!(answers[7]["error"]["code"], "singular");
    assert_eq!(answers[8]["error"]["code"], "out-of-range");
}

#[test]
fn targets_are_solved_in_the_order_asked_for() {
    // two frames of one arm that cannot both be where they are wanted
    let both = |order: &str| {
        json!({ "op": "ik", "order": order, "q0": [0.5, 0.5], "targets": [
            { "frame": "tcp", "position_m": [1.0, 0.05, 3.0] },
            { "frame": "forearm", "position_m": [0.0, 0.025, 3.0] },
        ] })
    };
    let answers = mixed(&[
        both("priority"),
        both("in-turn"),
        both("together"),
        both("sideways"),
    ]);
    assert_eq!(answers[0]["targets"][0]["reached"], true);
    assert_eq!(answers[1]["targets"][1]["residual_rad"], 0.0);
    assert!(answers[2]["targets"].is_null());
    assert_eq!(answers[3]["error"]["code"], "out-of-range");
}

#[test]
fn a_workspace_lies_within_reach() {
    let answers = mixed(&[
        json!({ "op": "workspace", "samples": 500, "from_m": [0, 0.05, 2] }),
        json!({ "op": "workspace", "samples": 10_000_000 }),
    ]);
    let points = rows(&answers[0]["points_m"]);
    assert_eq!(points.len(), 500);
    let reach = answers[0]["reach_m"].as_f64().expect("reach");
    assert!((1.99..=2.0 + 1e-12).contains(&reach), "{reach}");
    assert_eq!(answers[1]["error"]["code"], "too-large");
}
