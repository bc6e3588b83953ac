//! The replay of real runs, read back as a viewer reads it.

mod beside;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use kinemark_sim::kinematics::FramePoses;
use serde_json::Value;

use super::column::read;
use super::*;
use kinemark_grader::record::sample;

fn record(replay: Replay<'_>) -> Value {
    let json = replay.json();
    assert!(!json.contains('<'));
    serde_json::from_str(&json).expect("a replay is JSON")
}

/// The rows of a track, at its ticks; of one at a fixed period, by number.
fn rows(track: &Value) -> (Vec<usize>, Vec<Vec<f64>>) {
    let count = track["count"].as_u64().expect("count") as usize;
    let quanta = numbers(&track["quanta"]);
    assert_eq!(Some(quanta.len() as u64), track["width"].as_u64());
    let ticks = track["ticks"].as_str().map(|text| ticks_of(text, count));
    let data = track["data"].as_str().expect("data");
    let columns = read(count, &quanta, ticks.as_deref(), data);
    let rows = (0..count).map(|i| columns.iter().map(|column| column[i]).collect());
    (
        ticks.unwrap_or_else(|| (0..count).collect()),
        rows.collect(),
    )
}

fn ticks_of(text: &str, count: usize) -> Vec<usize> {
    let ticks = read(count, &[1.0], None, text);
    ticks[0].iter().map(|tick| *tick as usize).collect()
}

/// The ticks stepped through: as many as their bytes end numbers.
fn steps_of(record: &Value) -> Vec<usize> {
    let text = record["ticks"].as_str().expect("ticks");
    let bytes = STANDARD.decode(text).expect("base64");
    ticks_of(text, bytes.iter().filter(|byte| **byte < 0x80).count())
}

/// What a viewer shows at a tick: a row of the track, its quaternion, if it has one, of length one.
fn shown((ticks, rows): &(Vec<usize>, Vec<Vec<f64>>), tick: usize) -> Vec<f64> {
    let last = ticks.len() - 1;
    let from = ticks.partition_point(|at| *at <= tick).saturating_sub(1);
    let around = [
        from.saturating_sub(1),
        from,
        (from + 1).min(last),
        (from + 2).min(last),
    ];
    let weights = between::weights(around.map(|i| ticks[i] as f64), tick as f64);
    let mut row = vec![0.0; rows[0].len()];
    for (i, weight) in around.into_iter().zip(weights) {
        for (sum, x) in row.iter_mut().zip(&rows[i]) {
            *sum += weight * x;
        }
    }
    if let Some(turn) = row.get_mut(3..7) {
        let length: f64 = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
        turn.iter_mut().for_each(|x| *x /= length);
    }
    row
}

/// How far the pose shown is from a pose \[m\], \[rad\].
fn apart(shown: &[f64], pose: &Pose) -> (f64, f64) {
    let place = nalgebra::Vector3::from_column_slice(&shown[..3]) - pose.translation.vector;
    let quaternion = nalgebra::Quaternion::new(shown[3], shown[4], shown[5], shown[6]);
    let rotation = nalgebra::UnitQuaternion::from_quaternion(quaternion).to_rotation_matrix();
    // of a small turn the greatest element of the difference is the sine at most
    let turn = (rotation.matrix() - pose.rotation.matrix()).abs().max();
    (place.norm(), turn)
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
    // every tick is shown, not only those that have a row
    let tcp = rows(&record["tcp"]);
    let q: Vec<_> = record["q"]
        .as_array()
        .expect("joints")
        .iter()
        .map(rows)
        .collect();
    let courses = record["tracks"]
        .as_array()
        .expect("tracks")
        .iter()
        .map(rows);
    let courses: Vec<_> = courses.collect();
    let mut poses = FramePoses::new(&run.robot);
    for tick in 0..run.trace.len() {
        poses.update(&run.robot, run.trace.q.at(tick));
        for (node, link) in [(1, "upper"), (2, "forearm")] {
            let track = nodes[node]["track"].as_u64().expect("it moves") as usize;
            let pose = poses.world_from(run.robot.frame(link).expect("a link"));
            let (place, turn) = apart(&shown(&courses[track], tick), &pose);
            assert!(
                place <= WITHIN && turn <= WITHIN,
                "{link} at {tick}: {place} m, {turn}"
            );
        }
        let position = shown(&tcp, tick);
        for (coordinate, expected) in position.iter().zip(run.trace.tcp.at(tick)) {
            assert!((coordinate - expected).abs() <= NUMBERS_WITHIN);
        }
        for (joint, course) in q.iter().enumerate() {
            assert!((shown(course, tick)[0] - run.trace.q.at(tick)[joint]).abs() <= NUMBERS_WITHIN);
        }
    }
    // at its frames a track is as true as its quanta
    for (i, tick) in tcp.0.iter().enumerate() {
        assert!((tcp.1[i][0] - run.trace.tcp.at(*tick)[0]).abs() < 0.6 * PLACE);
    }
    assert!(tcp.0.len() < 800, "{} frames", tcp.0.len());
    assert_eq!(record["tcp"]["within"].as_f64(), Some(NUMBERS_WITHIN));
    let steps = steps_of(&record);
    assert!(steps.len() > 800 && steps.is_sorted());
    assert_eq!(steps.last(), Some(&8000));
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
    let pose_of = |numbers: &[f64]| {
        let turn = nalgebra::Quaternion::new(numbers[3], numbers[4], numbers[5], numbers[6]);
        let turn = nalgebra::UnitQuaternion::from_quaternion(turn);
        nalgebra::Isometry3::from_parts(
            nalgebra::Translation3::new(numbers[0], numbers[1], numbers[2]),
            turn,
        )
    };
    let world_from_lab = pose_of(&numbers(&lab["pose"]));
    let forearm_from_tcp = pose_of(&numbers(&tcp["pose"]));
    let track = record["nodes"][2]["track"].as_u64().expect("it moves") as usize;
    let course = rows(&record["tracks"][track]);
    for (tick, forearm) in course.0.iter().zip(&course.1) {
        let put_together = world_from_lab.inverse() * pose_of(forearm) * forearm_from_tcp;
        let recorded = run.trace.tcp_position(*tick);
        let apart = (put_together.translation.vector - recorded).norm();
        // half a quantum of each place, and of each element of the turn over a metre or so
        assert!(apart < 1e-4, "{apart} m at tick {tick}");
    }
    let goals = record["goals"].as_array().expect("goals");
    assert_eq!(numbers(&goals[0]["position"]), [2.0, 1.4, 0.05]);
    assert_eq!(goals[0]["zero"].as_f64(), Some(0.02));
    let (_, reference) = rows(&record["reference"]["path"]);
    assert_eq!(reference.len(), 801);
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
    let ticks = steps_of(&record);
    for event in events {
        let tick = event["tick"].as_u64().expect("tick") as usize;
        assert!(ticks.contains(&tick), "no step at {tick}");
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
    assert_eq!(steps_of(&record), [0, 10, 20, 30, 40, 50, 54]);
}

/// Of a chain of joints of which one buzzes at every tick, all others are recorded accurately, and the record says what is not.
#[test]
fn what_takes_most_is_recorded_less_accurately_and_the_record_says_so() {
    let run = sample::chain(25, 10_001, |tick, joint| match joint {
        24 => 0.3 * f64::from(tick as u32 % 2),
        _ => 0.1 * libm::sin(0.001 * (tick * (1 + joint as u64 % 3)) as f64 + joint as f64),
    });
    let replay = Replay::of(&run, None);
    let json = replay.json();
    assert!(
        json.len() < MOST_CHARACTERS + 20_000,
        "{} bytes",
        json.len()
    );
    let record: Value = serde_json::from_str(&json).expect("JSON");
    let nodes = record["nodes"].as_array().expect("nodes");
    assert_eq!(nodes.len(), 26);
    let mut poses = FramePoses::new(&run.robot);
    let mut untrue = 0;
    for node in nodes.iter().filter(|node| node["track"].is_u64()) {
        let track = &record["tracks"][node["track"].as_u64().expect("a track") as usize];
        let within = track["within"].as_f64().expect("how true it is");
        untrue += usize::from(within > WITHIN);
        let course = rows(track);
        for tick in (0..run.trace.len()).step_by(37) {
            poses.update(&run.robot, run.trace.q.at(tick));
            let link = node["name"].as_str().expect("a name");
            let pose = poses.world_from(run.robot.frame(link).expect("a link"));
            let (place, turn) = apart(&shown(&course, tick), &pose);
            assert!(
                place <= within && turn <= within,
                "{link} at {tick}: {place}, {turn}, not {within}"
            );
        }
    }
    assert_eq!(untrue, 1, "the last link buzzes");
}

/// An arm of a millimetre is recorded as accurately as one of a metre, by its size.
#[test]
fn small_arms_are_recorded_more_finely() {
    let run = sample::chain(2, 1001, |tick, _| libm::sin(0.003 * tick as f64));
    let metre = unit_m(&run, run.trace.len());
    assert!(metre > 0.05 && metre <= 1.0, "{metre}");
    let record = record(Replay::of(&run, None));
    let place = numbers(&record["tcp"]["quanta"])[0];
    assert!((place - PLACE * metre).abs() < 1e-12);
}

#[test]
fn a_ghost_moves_beside_the_run() {
    let mut run = sample::task_run();
    run.reference_overlay = Some(sample::stopped_after(700).trace);
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
    let course = rows(&record["tracks"][track]);
    // once it ended it stays where it was
    let [at_end, before] = [run.trace.len() - 1, 700].map(|tick| shown(&course, tick));
    assert!((at_end[0] - before[0]).abs() <= 2.0 * PLACE, "{at_end:?}");
}

#[test]
fn hostile_names_are_harmless() {
    let mut run = sample::task_run();
    run.task = "</script><!--\u{2028}\u{202E}".to_owned();
    let json = Replay::of(&run, None).json();
    assert!(json.contains("\\u003c/script>\\u003c!--⟨U+2028⟩⟨U+202E⟩"));
    assert_eq!(json, Replay::of(&run, None).json());
}
