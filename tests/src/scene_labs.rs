//! A lab with a scene: graded with events and contacts, copied with its report, verified from the copy, logged for a viewer,
//! and ended with its cause where a servo is beyond its limit.

use serde_json::Value as Json;

use crate::logged;
use crate::testbed::{TestBed, files_below};

const LAB: &str = r#"
format = 1
name = "90-knock"
title = "Knock"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "knock"
title = "Off the shelf"

[tasks.motion]
mode = "position"
scene = "shelf-and-can"
duration_s = 3.0
start_rad = [1.3444, 2.0236]
goals = [{ position_m = [1.25, 1.3, 0.05], dwell_s = 0.2 }]
servo = { kp = 1000.0, kd = 30.0, derivative = "velocity", gravity_compensation = true, effort_limit = 100.0 }

[[tasks.checks]]
name = "there"
title = "The tip is there"
points = 2.0
pose-reached = { full_m = 0.02, zero_m = 0.1 }
"#;

/// Sweeps the tip outwards just above the shelf; keeps values of all kinds between calls.
const SWEEP: &str = r#"
fn reach(robot, up, out) {
    let u = up - robot.base_height;
    let q2 = acos((u * u + out * out - 2.0) / 2.0);
    let q1 = atan2(out, u) - atan2(sin(q2), 1.0 + cos(q2));
    [q1, q2]
}

fn init(robot, task) {
    this.robot = robot;
    this.calls = 0;
    this.seen = [];
    this.label = "sweep";
    this.turn = [[1.0, 0.0], [0.0, 1.0]];
    this.last = vector([0.0, 0.0]);
}

fn control(observation) {
    this.calls += 1;
    if this.calls % 50 == 0 {
        this.seen.push(observation.q[0]);
        print(`${this.label} ${this.calls} ${len(this.seen)}`);
    }
    plot("out", observation.tcp[1]);
    let out = min(0.75 + 0.5 * max(observation.time - 0.5, 0.0), 1.3);
    let q = reach(this.robot, 1.25, out);
    this.last = vector(q) * 0.5 + this.last * 0.5;
    q
}
"#;

fn bed() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write("labs/90-knock/lab.toml", LAB);
    bed.write("mine.rhai", SWEEP);
    bed
}

const GRADE: [&str; 4] = ["grade", "90-knock", "mine.rhai", "--practice"];

fn record(bed: &TestBed) -> Json {
    let text = std::fs::read_to_string(bed.path("out/grade.json")).expect("record");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn a_lab_with_a_scene_is_graded_logged_copied_and_verified() {
    let bed = bed();
    let ran = bed.run(&GRADE);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let record = record(&bed);
    assert_eq!(record["scenes"][0]["name"], "shelf-and-can");
    let task = &record["tasks"][0];
    let messages: Vec<&str> = task["events"]
        .as_array()
        .expect("events")
        .iter()
        .filter_map(|event| event["message"].as_str())
        .collect();
    // out over the far side is +y of the lab's frame
    let expected = [
        "`forearm` touched `can`",
        "`can` moved",
        "`can` lost its support",
        "`can` fell over the far side (+y)",
        "`can` touched `ground`",
    ];
    let mut rest = messages.iter();
    for message in expected {
        assert!(
            rest.any(|messages| *messages == message),
            "{message}: {messages:?}"
        );
    }
    let contacts = task["contacts"].as_array().expect("contacts");
    let pushed = contacts
        .iter()
        .find(|contact| contact["parties"] == serde_json::json!(["forearm", "can"]))
        .expect("the arm pushes the can");
    assert!(pushed["peak_force_n"].as_f64() > Some(0.5), "{pushed}");
    assert!(pushed["impulse_n_s"].as_f64() > Some(0.05), "{pushed}");

    let files = files_below(&bed.path("out"));
    let file = |name: &str| {
        let mut files = files.iter();
        files.find(|(path, _)| path == name).map(|(_, bytes)| bytes)
    };
    assert!(file("lab/scenes/shelf-and-can.toml").is_some());
    let log = file("knock/run.mcap").expect("a log");
    let mut can_z = Vec::new();
    let mut lines = String::new();
    for (topic, content) in logged::messages(log) {
        match topic.as_str() {
            "/tf" => {
                let transforms = content["transforms"].as_array().expect("transforms");
                let can = transforms
                    .iter()
                    .find(|t| t["child_frame_id"] == "body/can");
                can_z.push(
                    can.expect("the can")["translation"]["z"]
                        .as_f64()
                        .expect("z"),
                );
                assert!(
                    transforms
                        .iter()
                        .any(|t| t["child_frame_id"] == "body/shelf")
                );
            }
            "/scene" => {
                let entities = content["entities"].as_array().expect("entities");
                let can = entities
                    .iter()
                    .find(|e| e["id"] == "body can")
                    .expect("the can");
                assert_eq!(can["frame_id"], "body/can");
                assert!(
                    (can["cylinders"][0]["size"]["z"].as_f64().expect("z") - 0.1).abs() < 1e-12
                );
            }
            "/log" => lines += content["message"].as_str().expect("text"),
            _ => {}
        }
    }
    assert!(
        (can_z[0] - 1.25).abs() < 1e-9 && can_z.last() < Some(&0.2),
        "{can_z:?}"
    );
    assert!(
        lines.contains("`can` fell over the far side (+y)"),
        "{lines}"
    );

    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    // in process the same bytes
    let mut args = GRADE.to_vec();
    args.extend(["--in-process", "--out", "second"]);
    assert_eq!(bed.run(&args).code, Some(0));
    assert!(files == files_below(&bed.path("second")));
    // another can is another scene
    bed.edit(
        "labs/scenes/shelf-and-can.toml",
        "mass_kg = 0.39",
        "mass_kg = 0.38",
    );
    assert_eq!(bed.run(&GRADE).code, Some(0));
    let other = self::record(&bed);
    assert_ne!(other["scenes"][0]["digest"], record["scenes"][0]["digest"]);
    assert_ne!(other["tasks"][0]["digests"]["all"], task["digests"]["all"]);
}

#[test]
fn mistakes_about_a_scene_are_shown_at_their_place() {
    let bed = bed();
    let refused = |words: &[&str]| {
        let ran = bed.run(&GRADE);
        assert_eq!(ran.code, Some(3), "{ran:?}");
        for word in words {
            assert!(ran.stderr.contains(word), "{word}: {}", ran.stderr);
        }
    };
    bed.edit(
        "labs/90-knock/lab.toml",
        "scene = \"shelf-and-can\"",
        "scene = \"shelf-and-cam\"",
    );
    refused(&[
        "lab::unknown_scene",
        "scene = \"shelf-and-cam\"",
        "shelf-and-can",
    ]);
    bed.edit("labs/90-knock/lab.toml", "shelf-and-cam", "shelf-and-can");
    bed.edit(
        "labs/scenes/shelf-and-can.toml",
        "name = \"can\"",
        "name = \"forearm\"",
    );
    refused(&[
        "lab::scene_names",
        "`forearm` is a body of this scene and a link",
    ]);
    bed.edit(
        "labs/scenes/shelf-and-can.toml",
        "name = \"forearm\"",
        "name = \"can\"\nmas = 1",
    );
    refused(&["scene::toml", "mas"]);
}

#[test]
fn a_diverged_run_is_reported_with_its_cause() {
    let bed = bed();
    bed.edit(
        "labs/90-knock/lab.toml",
        "kp = 1000.0, kd = 30.0, derivative = \"velocity\", gravity_compensation = true, effort_limit = 100.0",
        "kp = 1000.0, kd = 2000.0, derivative = \"velocity\", gravity_compensation = true",
    );
    let no_limits = |name: &str| {
        let path = bed.path(name);
        let text = std::fs::read_to_string(&path).expect("file");
        let lines = text.lines().filter(|line| !line.starts_with("limit"));
        std::fs::write(path, lines.collect::<Vec<_>>().join("\n")).expect("file");
    };
    no_limits("labs/robots/rrbot.toml");
    let ran = bed.run(&GRADE);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let record = record(&bed);
    let task = &record["tasks"][0];
    assert_eq!(task["verdict"], "missed");
    let message = task["stopped"]["message"].as_str().expect("why");
    assert!(
        message.contains("the simulation diverged at joint")
            && message.contains("sampled every 1 ms")
            && message.contains("it is stable with at most"),
        "{message}"
    );
    assert!(task["stopped"]["tick"].as_u64() < Some(500), "{task}");
    let events = task["events"].as_array().expect("events");
    assert_eq!(events.last().expect("events")["event"], "diverged");
    // what was drawn stops there
    assert!(bed.path("out/plots").is_dir());

    // the student's own feedback
    bed.edit(
        "labs/90-knock/lab.toml",
        "mode = \"position\"",
        "mode = \"effort\"",
    );
    bed.write(
        "mine.rhai",
        "fn control(o) { [-600.0 * o.qd[0] - 100.0 * (o.q[0] - 1.0), -600.0 * o.qd[1] - 100.0 * (o.q[1] - 2.0)] }",
    );
    assert_eq!(bed.run(&GRADE).code, Some(1));
    let record = self::record(&bed);
    let stopped = &record["tasks"][0]["stopped"];
    let message = stopped["message"].as_str().expect("why");
    assert!(
        message.contains("turned round at each of the last"),
        "{message}"
    );
    assert!(
        stopped["help"]
            .as_str()
            .expect("help")
            .contains("period of 10 ms"),
        "{stopped}"
    );
}
