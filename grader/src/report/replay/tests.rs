//! The replay of real runs, read back as a viewer reads it.

use kinemark_sim::kinematics::FramePoses;
use serde_json::Value;

use super::column::read;
use super::*;
use crate::report::sample;

fn record(replay: Replay<'_>) -> Value {
    let json = replay.json();
    assert!(!json.contains('<'));
    serde_json::from_str(&json).expect("a replay is JSON")
}

fn columns(track: &Value) -> Vec<Vec<f64>> {
    let quanta: Vec<f64> = track["quanta"]
        .as_array()
        .expect("quanta")
        .iter()
        .filter_map(Value::as_f64)
        .collect();
    let (width, count) = (track["width"].as_u64(), track["count"].as_u64());
    let (width, count) = (
        width.expect("width") as usize,
        count.expect("count") as usize,
    );
    assert_eq!(quanta.len(), width);
    read(width, count, &quanta, track["data"].as_str().expect("data"))
}

fn ticks(record: &Value, count: usize) -> Vec<usize> {
    let ticks = read(1, count, &[1.0], record["ticks"].as_str().expect("ticks"));
    ticks[0].iter().map(|tick| *tick as usize).collect()
}

fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .expect("numbers")
        .iter()
        .filter_map(Value::as_f64)
        .collect()
}

#[test]
fn poses_are_those_of_the_trace() {
    let graded = sample::graded();
    let run = &graded.runs[0];
    let record = record(Replay::of(run, Some(&graded.grade.tasks[3])));
    let nodes = record["nodes"].as_array().expect("nodes");
    let names: Vec<&str> = nodes
        .iter()
        .filter_map(|node| node["name"].as_str())
        .collect();
    assert_eq!(names, ["base", "upper", "forearm"]);
    assert_eq!(nodes[0]["pose"].as_array().map(Vec::len), Some(7));
    let tcp = columns(&record["tcp"]);
    let q = columns(&record["q"]);
    let ticks = ticks(&record, tcp[0].len());
    assert!(ticks.len() > 800 && ticks.is_sorted());
    assert_eq!(ticks.last(), Some(&8000));
    let mut poses = FramePoses::new(&run.robot);
    for (node, link) in [(1, "upper"), (2, "forearm")] {
        let track = nodes[node]["track"].as_u64().expect("it moves") as usize;
        let course = columns(&record["tracks"][track]);
        for (frame, tick) in ticks.iter().enumerate() {
            poses.update(&run.robot, run.trace.q.at(*tick));
            let pose = poses.world_from(run.robot.frame(link).expect("a link"));
            let p = pose.translation.vector;
            for c in 0..3 {
                assert!((course[c][frame] - p[c]).abs() < 0.6 * PLACE);
                assert!((tcp[c][frame] - run.trace.tcp.at(*tick)[c]).abs() < 0.6 * PLACE);
            }
            // the turn between what is told and what was: twice the distance of the quaternions, each element off by half a quantum
            let told = nalgebra::Quaternion::new(
                course[3][frame],
                course[4][frame],
                course[5][frame],
                course[6][frame],
            );
            let told = nalgebra::UnitQuaternion::from_quaternion(told).to_rotation_matrix();
            assert!((told.matrix() - pose.rotation.matrix()).abs().max() < 1e-4);
            if frame > 0 {
                let dot: f64 = (3..7)
                    .map(|c| course[c][frame] * course[c][frame - 1])
                    .sum();
                assert!(dot > 0.9, "the quaternion of {link} jumps at tick {tick}");
            }
        }
    }
    for (joint, course) in q.iter().enumerate() {
        for (frame, tick) in ticks.iter().enumerate() {
            assert!((course[frame] - run.trace.q.at(*tick)[joint]).abs() < 0.6 * PLACE);
        }
    }
}

/// The lab's frame and the TCP's put together give the TCP as the trace has it.
#[test]
fn frames_hang_on_their_nodes() {
    let run = sample::task_run();
    let record = record(Replay::of(&run, None));
    let lab = &record["lab"];
    assert_eq!(
        (lab["name"].as_str(), lab["node"].as_u64()),
        (Some("lab"), None)
    );
    // (x, y, z) of the lab is (Z, X, Y) of the world: a turn about (1, 1, 1)
    assert_eq!(
        numbers(&lab["pose"])[3..]
            .iter()
            .map(|x| x.abs())
            .collect::<Vec<_>>(),
        [0.5; 4]
    );
    let tcp = &record["frames"][0];
    assert_eq!(
        (tcp["name"].as_str(), tcp["node"].as_u64()),
        (Some("tcp"), Some(2))
    );
    assert_eq!(numbers(&tcp["pose"])[..3].len(), 3);
    let goals = record["goals"].as_array().expect("goals");
    assert_eq!(numbers(&goals[0]["position"]), [2.0, 1.4, 0.05]);
    assert_eq!(goals[0]["zero"].as_f64(), Some(0.02));
    let reference = columns(&record["reference"]["path"]);
    assert_eq!(reference[0].len(), 801);
}

#[test]
fn what_happened_has_its_marks() {
    let graded = sample::graded();
    let record = record(Replay::of(&graded.runs[0], Some(&graded.grade.tasks[3])));
    let events = record["events"].as_array().expect("events");
    let kinds: Vec<&str> = events
        .iter()
        .filter_map(|event| event["kind"].as_str())
        .collect();
    assert!(
        kinds.contains(&"saturation") && kinds.contains(&"breach"),
        "{kinds:?}"
    );
    let breaches: Vec<u64> = events
        .iter()
        .filter(|event| event["kind"] == "breach")
        .filter_map(|event| event["tick"].as_u64())
        .collect();
    // of each check that lost points the earliest moment
    assert_eq!(breaches, [620, 3200]);
    let ticks = ticks(
        &record,
        record["tcp"]["count"].as_u64().expect("count") as usize,
    );
    for event in events {
        let tick = event["tick"].as_u64().expect("tick") as usize;
        assert!(ticks.contains(&tick), "no frame at {tick}");
    }
    assert_eq!(record["ended"], Value::Null);
}

#[test]
fn a_run_that_stops_early_says_so() {
    for ticks in [0, 1, 700] {
        let run = sample::stopped_after(ticks);
        let record = record(Replay::of(&run, None));
        assert_eq!(
            record["ended"], "the submission was stopped",
            "after {ticks}"
        );
        assert!(record["tcp"]["count"].as_u64() >= Some(1));
    }
}

#[test]
fn runs_without_sound_rows_are_shown_at_home() {
    for run in [
        sample::chain(2, 0, |_, _| 0.0),
        sample::chain(2, 5, |_, _| f64::NAN),
    ] {
        let record = record(Replay::of(&run, None));
        assert!(Replay::of(&run, None).is_empty());
        assert_eq!(record["tcp"]["count"].as_u64(), Some(0));
        assert_eq!(record["ticks"], "");
        for node in record["nodes"].as_array().expect("nodes") {
            assert!(numbers(&node["pose"]).iter().all(|x| x.is_finite()));
        }
    }
    let broken = sample::chain(2, 100, |tick, _| {
        if tick < 55 {
            0.01 * tick as f64
        } else {
            f64::INFINITY
        }
    });
    let record = record(Replay::of(&broken, None));
    let count = record["tcp"]["count"].as_u64().expect("count") as usize;
    assert_eq!(ticks(&record, count), [0, 10, 20, 30, 40, 50, 54]);
}

#[test]
fn many_joints_are_told_more_coarsely() {
    let run = sample::chain(25, 10_001, |tick, joint| {
        libm::sin(0.001 * (tick * (1 + joint as u64)) as f64)
    });
    let json = Replay::of(&run, None).json();
    assert!(
        json.len() < MOST_CHARACTERS + 20_000,
        "{} bytes",
        json.len()
    );
    let record: Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(record["nodes"].as_array().map(Vec::len), Some(26));
    assert!(record["tcp"]["count"].as_u64() > Some(200));
    // far apart, and so on a curve; a robot of few joints needs none
    assert_eq!(record["between"], "curve");
    let few = sample::chain(2, 10_001, |tick, _| libm::sin(0.001 * tick as f64));
    assert_eq!(self::record(Replay::of(&few, None))["between"], "line");
}

#[test]
fn a_ghost_moves_beside_the_run() {
    let mut run = sample::task_run();
    run.ghost = Some(sample::stopped_after(700).trace);
    let record = record(Replay::of(&run, None));
    assert_eq!(record["ghostLabel"], "reference");
    let nodes = record["nodes"].as_array().expect("nodes");
    let ghosts: Vec<&str> = nodes
        .iter()
        .filter(|node| node["kind"] == "ghost")
        .filter_map(|node| node["name"].as_str())
        .collect();
    assert_eq!(
        ghosts,
        ["reference/base", "reference/upper", "reference/forearm"]
    );
    let track = nodes[5]["track"].as_u64().expect("it moves") as usize;
    let course = columns(&record["tracks"][track]);
    let frames = record["tcp"]["count"].as_u64().expect("count") as usize;
    assert_eq!(course[0].len(), frames);
    // once it ended it stays where it was
    assert!(
        course[0][frames - 1]
            .total_cmp(&course[0][frames / 2])
            .is_eq()
    );
}

#[test]
fn hostile_names_are_harmless() {
    let mut run = sample::task_run();
    run.task = "</script><!--\u{2028}\u{202E}".to_owned();
    let json = Replay::of(&run, None).json();
    assert!(json.contains("\\u003c/script>\\u003c!--⟨U+2028⟩⟨U+202E⟩"));
    assert_eq!(json, Replay::of(&run, None).json());
}
