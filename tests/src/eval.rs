//! `kinemark robot eval`: the golden numbers through the JSON interface, and its errors.

use std::io::Write as _;
use std::process::Stdio;

use serde_json::{Value, json};

use crate::testbed::{TestBed, root};

/// Sends requests, returns answers and the exit code.
fn eval(robot: &str, requests: &[String]) -> (Vec<Value>, Option<i32>) {
    eval_with(&TestBed::new(), &[robot], requests)
}

/// The same with options, from a folder with files.
pub(crate) fn eval_with(
    bed: &TestBed,
    robot: &[&str],
    requests: &[String],
) -> (Vec<Value>, Option<i32>) {
    let mut command = bed.command(&[&["robot", "eval"], robot].concat());
    let mut child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("runs");
    let text = requests.join("\n") + "\n";
    let mut stdin = child.stdin.take().expect("stdin");
    let writer = std::thread::spawn(move || stdin.write_all(text.as_bytes()));
    let output = child.wait_with_output().expect("ends");
    writer.join().expect("thread").expect("written");
    let answers = String::from_utf8(output.stdout).expect("UTF-8");
    let answers = answers
        .lines()
        .map(|line| serde_json::from_str(line).expect(line));
    (answers.collect(), output.status.code())
}

pub(crate) fn golden(name: &str) -> Value {
    let path = root().join("tests/golden").join(name);
    serde_json::from_str(&std::fs::read_to_string(&path).expect("golden")).expect("JSON")
}

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        other => vec![
            other
                .as_f64()
                .unwrap_or_else(|| panic!("{other} is not a number")),
        ],
    }
}

pub(crate) fn close(got: &Value, expected: &Value, tolerance: f64, what: &str) {
    let (got, expected) = (numbers(got), numbers(expected));
    assert_eq!(got.len(), expected.len(), "{what}");
    for (got, expected) in got.iter().zip(&expected) {
        assert!(
            (got - expected).abs() <= tolerance,
            "{what}: {got} against {expected}"
        );
    }
}

#[test]
fn the_golden_numbers_of_the_arm_come_back() {
    let states = golden("A_rrbot.json");
    let states = states["fk"].as_array().expect("fk");
    let mut requests = Vec::new();
    for (i, state) in states.iter().enumerate() {
        let (q, qd, qdd) = (&state["q_rad"], &state["dq"], &state["ddq"]);
        let tau = &state["tau_with_damping"];
        for request in [
            json!({ "id": i, "op": "fk", "q": q, "in": "lab" }),
            json!({ "id": i, "op": "jacobian", "q": q, "in": "lab" }),
            json!({ "id": i, "op": "crba", "q": q }),
            json!({ "id": i, "op": "bias", "q": q, "qd": qd }),
            json!({ "id": i, "op": "rnea", "q": q, "qd": qd, "qdd": qdd }),
            json!({ "id": i, "op": "aba", "q": q, "qd": qd, "effort": tau }),
        ] {
            requests.push(request.to_string());
        }
    }
    let (answers, code) = eval("rrbot", &requests);
    assert_eq!((answers.len(), code), (6 * states.len(), Some(0)));
    for (i, (state, answers)) in states.iter().zip(answers.chunks(6)).enumerate() {
        let [fk, jacobian, crba, bias, rnea, aba] = answers else {
            panic!("{answers:?}");
        };
        assert_eq!(fk["id"], i);
        close(&fk["position_m"], &state["pos_m"], 1e-12, "fk");
        close(
            &jacobian["jacobian"][0],
            &state["jac_xy"][0],
            1e-12,
            "jacobian x",
        );
        close(
            &jacobian["jacobian"][1],
            &state["jac_xy"][1],
            1e-12,
            "jacobian y",
        );
        close(
            &jacobian["jacobian"][5],
            &json!([1.0, 1.0]),
            1e-15,
            "both joints turn about z",
        );
        close(&crba["mass_matrix"], &state["M"], 1e-12, "crba");
        close(&bias["effort"], &state["bias_C_plus_G"], 1e-12, "bias");
        close(&rnea["effort"], &state["tau_with_damping"], 1e-12, "rnea");
        close(&aba["qdd"], &state["ddq"], 1e-10, "aba");
    }
}

/// The course's arm without limits, which hold it where a golden one moves on.
fn without_limits(bed: &TestBed) -> &'static str {
    let arm = std::fs::read_to_string(root().join("labs/robots/rrbot.toml")).expect("a robot");
    let lines = arm.lines().filter(|line| !line.starts_with("limit"));
    bed.write("arm.toml", lines.collect::<Vec<_>>().join("\n"));
    "arm.toml"
}

#[test]
fn sampled_step_responses_come_back() {
    let bed = TestBed::new();
    let arm = without_limits(&bed);
    let file = golden("B_nonlinear_position.json");
    for scenario in file["scenarios"].as_array().expect("scenarios") {
        if scenario["kind"] != "digital" {
            continue;
        }
        let gains = numbers(&scenario["gains"]);
        let mut servo = json!({
            "mode": "position", "kp": gains[0], "ki": gains[1], "kd": gains[2],
            "derivative": scenario["derivative"], "gravity_compensation": false,
        });
        if let Some(limit) = scenario.get("torque_limit_Nm") {
            servo["effort_limit"] = limit.clone();
        }
        let request = json!({
            "op": "simulate", "q0": [0, 0], "qd0": [0, 0], "duration_s": 5, "physics_step_s": 1e-4,
            "servo_period_s": scenario["Ts"], "sample_period_s": 0.005,
            "command": scenario["ref"], "servo": servo,
        });
        let (answers, code) = eval_with(&bed, &[arm], &[request.to_string()]);
        assert_eq!(code, Some(0), "{:?}", answers[0]["error"]);
        let answer = &answers[0];
        assert_eq!(answer["t_s"][1000], 5.0);
        let joint = |table: &Value, joint: usize| -> Vec<f64> {
            let rows = table.as_array().expect("rows");
            rows.iter()
                .map(|row| row[joint].as_f64().expect("number"))
                .collect()
        };
        for (i, name) in ["q1", "q2"].into_iter().enumerate() {
            let got = Value::from(joint(&answer["q"], i));
            close(
                &got,
                &scenario["curve"][name],
                1e-6,
                &format!("{} {name}", scenario["name"]),
            );
        }
    }
}

#[test]
fn numbers_read_back_to_the_same_bits() {
    let q = [0.1 + 0.2, -1.0 / 3.0];
    let request = json!({ "op": "fk", "q": q }).to_string();
    let (answers, _) = eval("rrbot", &[request.clone(), request]);
    assert_eq!(answers[0]["position_m"], answers[1]["position_m"]);
    let robot = {
        let text = std::fs::read_to_string(root().join("labs/robots/rrbot.toml")).expect("robot");
        let source = kinemark_sim::text::Source::new("rrbot.toml", text);
        let file = kinemark_sim::format::RobotFile::parse(source).expect("readable");
        file.build(&[]).expect("robot")
    };
    let poses =
        kinemark_sim::kinematics::forward_kinematics(&robot, &robot.positions(&q).expect("q"));
    let p = poses.world_from(robot.tcp()).translation.vector;
    let got = numbers(&answers[0]["position_m"]);
    for (got, expected) in got.iter().zip(p.iter()) {
        assert_eq!(got.to_bits(), expected.to_bits());
    }
}

#[test]
fn energy_counts_every_link_from_the_ground() {
    let (answers, _) = eval(
        "rrbot",
        &[
            json!({ "op": "energy", "q": [0, 0], "qd": [0, 0] }).to_string(),
            json!({ "op": "energy", "q": [0, 0], "qd": [1, 0], "gravity_m_s2": [0, 0, 0] })
                .to_string(),
        ],
    );
    // 1 kg at 1 m, 0.5 kg at 2.5 m and 3.5 m
    close(
        &answers[0]["potential_j"],
        &json!(9.81 * (1.0 + 1.25 + 1.75)),
        1e-12,
        "potential",
    );
    close(
        &answers[1]["kinetic_j"],
        &json!(0.5 * 1.333_541_666_666_666_7),
        1e-12,
        "kinetic",
    );
    close(&answers[1]["potential_j"], &json!(0.0), 0.0, "no gravity");
}

#[test]
fn a_bad_request_is_answered_and_the_stream_goes_on() {
    let servo = r#"{"mode": "position", "kp": 100}"#;
    let simulate = |rest: &str| {
        format!(
            r#"{{"op": "simulate", "q0": [0,0], "qd0": [0,0], "command": [0,0], "servo": {servo}, {rest}}}"#
        )
    };
    let cases = [
        ("{".to_owned(), "bad-json"),
        ("[1]".to_owned(), "bad-request"),
        (r#"{"q": [0,0]}"#.to_owned(), "missing-field"),
        (r#"{"op": "fk"}"#.to_owned(), "missing-field"),
        (r#"{"op": "fx", "q": [0,0]}"#.to_owned(), "unknown-op"),
        (r#"{"op": "fk", "q": [0]}"#.to_owned(), "wrong-length"),
        (r#"{"op": "fk", "q": "up"}"#.to_owned(), "wrong-type"),
        (
            r#"{"op": "fk", "q": [0,0], "frame": "tpc"}"#.to_owned(),
            "unknown-frame",
        ),
        (
            r#"{"op": "fk", "q": [0,0], "farme": "tcp"}"#.to_owned(),
            "unknown-field",
        ),
        (
            r#"{"op": "crba", "q": [0,0], "gravity_m_s2": [0,1]}"#.to_owned(),
            "wrong-length",
        ),
        (
            r#"{"op": "bias", "q": [0,0], "qd": [1e200,0]}"#.to_owned(),
            "not-finite",
        ),
        (
            simulate(r#""duration_s": 1, "servo_period_s": 0.0015, "sample_period_s": 0.1"#),
            "bad-period",
        ),
        (
            simulate(r#""duration_s": -1, "servo_period_s": 0.001, "sample_period_s": 0.1"#),
            "out-of-range",
        ),
        (
            simulate(r#""duration_s": 1e9, "servo_period_s": 0.001, "sample_period_s": 0.001"#),
            "too-large",
        ),
    ];
    let mut requests: Vec<String> = cases.iter().map(|(request, _)| request.clone()).collect();
    requests.push(r#"{"id": "last", "op": "info"}"#.to_owned());
    let (answers, code) = eval("rrbot", &requests);
    assert_eq!(code, Some(1));
    assert_eq!(answers.len(), requests.len());
    for ((request, wanted), answer) in cases.iter().zip(&answers) {
        assert_eq!(answer["error"]["code"], *wanted, "{request}: {answer}");
    }
    // it has no id: its number stands for it
    assert_eq!(
        answers[0]["error"]["message"],
        "request 1: column 1: EOF while parsing an object"
    );
    let last = answers.last().expect("answers");
    assert_eq!(last["id"], "last");
    assert_eq!(last["joints"][1]["name"], "elbow");
    assert_eq!(last["mass_kg"], 2.0);
}

#[test]
fn with_json_answers_have_the_envelope_of_every_other_command() {
    let bed = TestBed::new();
    let requests = [
        json!({"id": 1, "op": "fk", "q": [0.0, 0.0]}).to_string(),
        json!({"id": 2, "op": "fk", "q": [0.0, 0.0], "frame": "tpc"}).to_string(),
        "no JSON".to_owned(),
    ];
    let (answers, code) = eval_with(&bed, &["rrbot", "--json"], &requests);
    assert_eq!((answers.len(), code), (3, Some(1)), "{answers:?}");
    assert!(answers.iter().all(|answer| answer["format"] == 1));
    let (plain, _) = eval_with(&bed, &["rrbot"], &requests);
    assert_eq!(answers[0]["position_m"], plain[0]["position_m"]);
    assert!(plain[0].get("format").is_none(), "{plain:?}");
    for (answer, code) in answers[1..]
        .iter()
        .zip(["eval::unknown_frame", "eval::bad_json"])
    {
        let error = &answer["error"];
        assert_eq!(error["code"], code, "{error}");
        let mut fields: Vec<&str> = error
            .as_object()
            .expect("an error")
            .keys()
            .map(String::as_str)
            .collect();
        fields.sort_unstable();
        assert_eq!(fields, ["code", "help", "message", "span"]);
    }
    // what is wrong before any request is one value of the same form
    let ran = bed.run(&["robot", "eval", "no-such", "--json"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    let failed: Value = serde_json::from_str(&ran.stdout).expect("one value");
    assert_eq!(failed["error"]["code"], "cli::unknown_name");
    assert_eq!(failed["format"], 1);
}
