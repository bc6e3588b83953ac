//! Two runs in one replay.

use super::*;

fn ghost(run: &TaskRun) -> Overlay<'_> {
    Overlay {
        robot: &run.robot,
        scene: run.scene.as_ref().map(|scene| &scene.scene),
        trace: &run.trace,
        label: "B",
        run: Some((run, None)),
    }
}

fn names(record: &Value) -> Vec<&str> {
    let nodes = record["nodes"].as_array().expect("nodes");
    let names = nodes.iter().filter_map(|node| node["name"].as_str());
    names.collect()
}

#[test]
fn the_path_is_that_of_the_other_run_up_to_where_it_ended() {
    let (a, b) = (sample::task_run(), sample::stopped_after(700));
    let record = record(Replay::of(&a, None).beside("A", ghost(&b)));
    let (_, path) = rows(&record["reference"]["path"]);
    let every = record["reference"]["periodS"].as_f64().expect("a period") / b.trace.step_s;
    let every = every.round() as usize;
    assert_eq!(path.len(), b.trace.len().div_ceil(every));
    for (i, tick) in (0..b.trace.len()).step_by(every).enumerate() {
        for (coordinate, place) in path[i].iter().zip(b.trace.tcp.at(tick)) {
            assert!((coordinate - place).abs() < 0.6 * PLACE);
        }
    }
    assert_eq!(record["ended"], "B: the submission was stopped");
    let events = record["events"].as_array().expect("events");
    let stop = events.iter().find(|event| event["kind"] == "stop");
    assert_eq!(
        stop.expect("a stop")["text"],
        "B: the submission was stopped"
    );
    let ours = |event: &Value| {
        event["text"]
            .as_str()
            .is_some_and(|text| text.starts_with("A: "))
    };
    assert!(events.iter().any(ours));
    // the surroundings are the same
    assert!(!names(&record).iter().any(|name| name.contains("goal")));
}

#[test]
fn the_replay_goes_on_as_long_as_either_run() {
    let (a, b) = (sample::stopped_after(700), sample::task_run());
    let record = record(Replay::of(&a, None).beside("A", ghost(&b)));
    let end = b.trace.len() - 1;
    assert_eq!(steps_of(&record).last(), Some(&end));
    let last = a.trace.tcp.at(a.trace.len() - 1);
    assert!((shown(&rows(&record["tcp"]), end)[0] - last[0]).abs() < 0.6 * PLACE);
    assert_eq!(record["ended"], "A: the submission was stopped");
}

#[test]
fn what_stands_elsewhere_is_shown_where_it_stands() {
    let a = sample::task_run();
    let mut b = a.clone();
    b.goals[0].position_m[0] += 0.25;
    b.paths = vec![kinemark_grader::record::graded::AskedPath {
        name: "edge".to_owned(),
        points_m: vec![[0.0, 1.0, 0.0], [0.0, 1.0, 0.5], [0.0, 1.0, 0.0]],
        tube_m: None,
    }];
    let different = record(Replay::of(&a, None).beside("A", ghost(&b)));
    let nodes = different["nodes"].as_array().expect("nodes");
    let named = |name: &str| nodes.iter().find(|node| node["name"] == name);
    let goal = named("B/goal 1").expect("the goal that differs");
    assert_eq!(goal["kind"], "ghost");
    assert!(named("B/goal 2").is_none(), "the same in both");
    // (x, y, z) of the lab is (Z, X, Y) of the world
    let at = b.goals[0].position_m;
    let pose = numbers(&goal["pose"]);
    for (coordinate, expected) in pose.iter().zip([at[1], at[2], at[0]]) {
        assert!((coordinate - expected).abs() < 1e-8, "{pose:?}");
    }
    // there and back, each a rod
    let edge = named("B/edge").expect("the path that differs");
    let rods = edge["shapes"].as_array().expect("shapes");
    assert_eq!(rods.len(), 2);
    for rod in rods {
        assert_eq!(rod["solid"]["cylinder"]["length"].as_f64(), Some(0.5));
        assert_eq!(numbers(&rod["pose"])[..3], [0.0, 0.0, 0.25]);
    }
    // two that are the same in everything have nothing of their own
    let same = record(Replay::of(&a, None).beside("A", ghost(&a)));
    assert!(!names(&same).iter().any(|name| name.contains("goal")));
}

/// Values by time \[s\], on which runs of other steps agree.
fn value(time_s: f64, joint: usize) -> f64 {
    0.3 * time_s + 0.1 * joint as f64
}

/// The columns of a track whose ticks the page has.
fn columns(track: &Value, ticks: &[usize]) -> Vec<Vec<f64>> {
    let data = track["data"].as_str().expect("data");
    read(ticks.len(), &numbers(&track["quanta"]), Some(ticks), data)
}

#[test]
fn numbers_of_a_run_with_other_steps_are_those_at_the_same_time() {
    // 0.5 s in steps of 1 ms, and 0.3 s in steps of 4 ms
    let ours = sample::chain(2, 501, |tick, joint| value(1e-3 * tick as f64, joint));
    let mut theirs = sample::chain(2, 76, |tick, joint| value(4e-3 * tick as f64, joint));
    theirs.trace.step_s = 0.004;
    let last = theirs.trace.len() - 1;
    let ticks = [0, 4, 101, 103, 240, 300, 301, 500];
    // the step that is nearest in time: 101 ms and 103 ms lie between 100 and 104; after its end, the end
    let nearest = [0, 1, 25, 26, 60, 75, 75, 75];
    assert_eq!(last, 75);
    let found = super::super::beside::numbers(&theirs, &ours, &ticks).expect("numbers");
    let found = serde_json::to_value(&found).expect("JSON");
    let near = |a: f64, b: f64| assert!((a - b).abs() <= 0.6e-4, "{a} {b}");
    for (i, joint) in found["q"].as_array().expect("joints").iter().enumerate() {
        let [column] = &columns(&joint["track"], &ticks)[..] else {
            panic!("one number a joint")
        };
        for (q, tick) in column.iter().zip(nearest) {
            near(*q, value(4e-3 * tick as f64, i));
        }
    }
    for (c, column) in columns(&found["tcp"], &ticks).iter().enumerate() {
        for (coordinate, tick) in column.iter().zip(nearest) {
            near(*coordinate, theirs.trace.tcp_position(tick)[c]);
        }
    }
    // the other way round: a step of theirs is four of ours
    let ticks = [0, 25, 75];
    let found = super::super::beside::numbers(&ours, &theirs, &ticks).expect("numbers");
    let found = serde_json::to_value(&found).expect("JSON");
    let column = &columns(&found["q"][0]["track"], &ticks)[0];
    for (q, tick) in column.iter().zip([0.0, 100.0, 300.0]) {
        near(*q, value(1e-3 * tick, 0));
    }
    // a run without a sound row has no numbers
    let broken = sample::chain(2, 5, |_, _| f64::NAN);
    assert!(super::super::beside::numbers(&broken, &ours, &ticks).is_none());
}
