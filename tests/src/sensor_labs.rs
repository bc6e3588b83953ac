//! A lab whose robot has sensors: read by the submission, in the digests and in the log; a limit switch that stops a motor.

use serde_json::Value as Json;

use crate::logged::messages;
use crate::testbed::{TestBed, files_below};

const SENSORS: &str = r#"
[[sensors]]
name = "elbow_encoder"
type = "joint-position"
joint = "elbow"

[[sensors]]
name = "top"
type = "limit-switch"
joint = "shoulder"
at = 0.4
side = "upper"

[[sensors]]
name = "wrist"
type = "wrench"
joint = "elbow"
"#;

const LAB: &str = r#"
format = 1
name = "91-feel"
title = "Feel"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "feel"
title = "Until the switch"

[tasks.motion]
mode = "effort"
duration_s = 1.0

[[tasks.motion.sensors]]
name = "elbow_encoder"
type = "joint-position"
joint = "elbow"
noise = 0.01
quantisation = 0.001
delay_s = 0.005
rate_hz = 200

[[tasks.checks]]
name = "there"
title = "The shoulder is somewhere"
points = 1.0
joint-reached = { joint = "shoulder", position_rad = 0.0, hold_s = 0.1, full_rad = 10.0, zero_rad = 20.0 }
"#;

/// Pushes the shoulder up until and beyond its switch.
const PUSH: &str = r#"
fn init(robot, task) { this.reported = false; }

fn control(observation) {
    let sensors = observation.sensors;
    if sensors.top && !this.reported {
        this.reported = true;
        print(`pressed at ${observation.tick}`);
    }
    if observation.tick == 0 {
        print(`${len(sensors.wrist)} ${sensors.top}`);
    }
    [5.0, 0.0]
}
"#;

fn bed() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    let path = bed.path("labs/robots/rrbot.toml");
    let text = std::fs::read_to_string(&path).expect("file");
    std::fs::write(path, text + SENSORS).expect("file");
    bed.write("labs/91-feel/lab.toml", LAB);
    bed.write("mine.rhai", PUSH);
    bed
}

const GRADE: [&str; 4] = ["grade", "91-feel", "mine.rhai", "--practice"];

fn task(bed: &TestBed) -> Json {
    let ran = bed.run(&GRADE);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let text = std::fs::read_to_string(bed.path("out/grade.json")).expect("record");
    let record: Json = serde_json::from_str(&text).expect("JSON");
    record["tasks"][0].clone()
}

#[test]
fn sensors_reach_the_submission_the_digests_and_the_log() {
    let bed = bed();
    let task = task(&bed);
    let said: Vec<&str> = task["log"]
        .as_array()
        .expect("lines")
        .iter()
        .filter_map(|line| line["text"].as_str())
        .collect();
    assert_eq!(said[0], "6 false");
    assert!(said[1].starts_with("pressed at "), "{said:?}");
    let seconds = task["digests"]["seconds"].as_array().expect("seconds");
    assert!(seconds.iter().all(|second| second["sensors"].is_string()));

    let files = files_below(&bed.path("out"));
    let (_, log) = files
        .iter()
        .find(|(path, _)| path == "feel/run.mcap")
        .expect("a log");
    let mut readings = Vec::new();
    let (mut shoulder, mut elbow, mut effort) = (Vec::new(), Vec::new(), Vec::new());
    for (topic, content) in messages(log) {
        match topic.as_str() {
            "/sensors" => readings.push(content),
            "/signals" => {
                shoulder.push(content["q_shoulder"].as_f64().expect("q"));
                elbow.push(content["q_elbow"].as_f64().expect("q"));
                effort.push(content["effort_shoulder"].as_f64().expect("effort"));
            }
            _ => {}
        }
    }
    assert_eq!(readings.len(), 101);
    // weight of the forearm, which rests on the elbow
    let weight = readings[0]["wrist_fz"].as_f64().expect("force");
    assert!((weight - 0.5 * 9.81).abs() < 1e-9, "{weight}");
    // the lab's noisy encoder replaces the robot's: integer multiples of its resolution, not the true position
    let encoder: Vec<f64> = readings
        .iter()
        .map(|reading| reading["elbow_encoder"].as_f64().expect("angle"))
        .collect();
    assert!(
        encoder
            .iter()
            .all(|x| (x * 1e3 - (x * 1e3).round()).abs() < 1e-9)
    );
    let off = encoder.iter().zip(&elbow).map(|(read, q)| (read - q).abs());
    assert!(off.filter(|off| *off > 0.003).count() > 20);
    // the switch opens the motor: at and beyond 0.4 rad it gives nothing upwards, and gravity goes on
    assert!(shoulder.last() > Some(&0.4));
    for (q, effort) in shoulder.iter().zip(&effort) {
        let expected = if *q >= 0.4 { 0.0 } else { 5.0 };
        assert!((effort - expected).abs() < 1e-12, "{q} {effort}");
    }
}

#[test]
fn a_sensor_that_does_not_fit_is_shown_at_its_place() {
    let bed = bed();
    let refused = |from: &str, to: &str, words: &[&str]| {
        bed.edit("labs/91-feel/lab.toml", from, to);
        let ran = bed.run(&GRADE);
        assert_eq!(ran.code, Some(3), "{ran:?}");
        for word in words {
            assert!(ran.stderr.contains(word), "{word}: {}", ran.stderr);
        }
        bed.edit("labs/91-feel/lab.toml", to, from);
    };
    refused(
        "joint = \"elbow\"\nnoise",
        "joint = \"elbo\"\nnoise",
        &["joint = \"elbo\"", "did you mean `elbow`"],
    );
    refused(
        "rate_hz = 200",
        "rate_hz = 300",
        &["lab::sensor", "at 300 Hz"],
    );
    refused("noise = 0.01", "noise = -0.01", &["noise = -0.01"]);
}

#[test]
fn eval_returns_what_sensors_read() {
    use std::io::Write as _;
    let bed = bed();
    let mut child = bed
        .command(&["robot", "eval", "rrbot"])
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .spawn()
        .expect("the binary runs");
    let request = r#"{"op": "simulate", "q0": [0, 0.5], "qd0": [0, 0], "command": [0, 0], "duration_s": 0.1, "servo_period_s": 0.001, "sample_period_s": 0.05, "servo": {"mode": "effort"}}"#;
    let mut input = child.stdin.take().expect("input");
    writeln!(input, "{request}").expect("written");
    drop(input);
    let output = child.wait_with_output().expect("ended");
    let answer: Json = serde_json::from_slice(&output.stdout).expect("JSON");
    let sensors = &answer["sensors"];
    for row in 0..3 {
        assert_eq!(sensors["elbow_encoder"][row], answer["q"][row][1]);
        assert_eq!(sensors["top"][row], 0.0);
        assert_eq!(sensors["wrist"][row].as_array().map(Vec::len), Some(6));
    }
}
