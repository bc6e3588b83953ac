//! The report with its replay: links to moments, and what of the reference it shows to whom.

use serde_json::Value;

use crate::logged::messages;
use crate::testbed::{TestBed, files_below, root};

const GRADE: [&str; 3] = ["grade", "01-kinematics", "submission.rhai"];

/// The replays in a page.
fn replays(page: &str) -> Vec<Value> {
    let mut parts = page.split("<script type=\"application/json\" id=\"replay-");
    parts.next();
    let data = parts.map(|part| part.split_once('>').expect("data").1);
    data.map(|data| {
        let json = data.split_once("</script>").expect("its end").0;
        serde_json::from_str(json).expect("JSON")
    })
    .collect()
}

/// Topics of a log, with the entities of the reference's scene.
fn log(bytes: &[u8]) -> (Vec<String>, Vec<String>) {
    let (mut topics, mut entities) = (Vec::new(), Vec::new());
    for (topic, scene) in messages(bytes) {
        if topic == "/reference/scene" {
            let shown = scene["entities"].as_array().expect("entities");
            entities.extend(
                shown
                    .iter()
                    .map(|e| e["id"].as_str().expect("id").to_owned()),
            );
        }
        if !topics.contains(&topic) {
            topics.push(topic);
        }
    }
    (topics, entities)
}

#[test]
fn every_lost_point_with_a_moment_has_its_link() {
    let bed = TestBed::a_little_off();
    let ran = bed.run(&GRADE);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let last = ran.stdout.lines().last().expect("lines");
    let link = last
        .strip_prefix("look here first: out/report.html#task=move&t=")
        .unwrap_or_else(|| panic!("{last}"));
    let time_s: f64 = link.parse().expect("a time");
    // the same moment is shown with its evidence, and its link works in the page
    let shown = format!("] #task=move&t={link}");
    assert!(ran.stdout.contains(&shown), "{ran:?}");
    let page = std::fs::read_to_string(bed.path("out/report.html")).expect("page");
    assert!(page.contains(&format!(
        "<a class=\"seek\" href=\"#task=move&amp;t={link}\">"
    )));
    let replays = replays(&page);
    let replay = replays
        .iter()
        .find(|replay| replay["task"] == "move")
        .expect("its replay");
    let tick = (time_s / replay["stepS"].as_f64().expect("the step")).round() as u64;
    let events = replay["events"].as_array().expect("events");
    assert!(
        events
            .iter()
            .any(|event| event["kind"] == "breach" && event["tick"] == tick),
        "no mark at tick {tick}"
    );
}

#[test]
fn nothing_of_the_reference_but_its_path_is_in_a_report() {
    let bed = TestBed::a_little_off();
    assert_eq!(bed.run(&GRADE).code, Some(1));
    let files = files_below(&bed.path("out"));
    let (_, page) = files
        .iter()
        .find(|(name, _)| name == "report.html")
        .expect("page");
    let page = String::from_utf8_lossy(page);
    for replay in replays(&page) {
        assert_eq!(replay["ghostLabel"], Value::Null);
        let nodes = replay["nodes"].as_array().expect("nodes");
        assert!(nodes.iter().all(|node| node["kind"] != "ghost"));
    }
    let mut logs = 0;
    for (_, bytes) in files.iter().filter(|(name, _)| name.ends_with(".mcap")) {
        let (topics, entities) = log(bytes);
        assert!(!topics.contains(&"/reference/tf".to_owned()), "{topics:?}");
        assert!(
            entities.iter().all(|id| id == "reference path"),
            "{entities:?}"
        );
        logs += 1;
    }
    assert_eq!(logs, 1);
}

#[test]
fn staff_may_see_the_reference_move() {
    let bed = TestBed::a_little_off();
    assert_eq!(bed.run(&GRADE).code, Some(1));
    let without = std::fs::read(bed.path("out/grade.json")).expect("record");
    let ran = bed.run(&[
        "grade",
        "01-kinematics",
        "submission.rhai",
        "--reference-overlay",
    ]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    // the grade is the same
    assert_eq!(
        std::fs::read(bed.path("out/grade.json")).expect("record"),
        without
    );
    let page = std::fs::read_to_string(bed.path("out/report.html")).expect("page");
    let replays = replays(&page);
    assert_eq!(replays.len(), 1);
    for replay in &replays {
        assert_eq!(replay["ghostLabel"], "reference");
        let nodes = replay["nodes"].as_array().expect("nodes");
        assert!(
            nodes
                .iter()
                .any(|node| node["name"] == "reference/forearm" && node["kind"] == "ghost")
        );
    }
    let (topics, entities) = log(&std::fs::read(bed.path("out/move/run.mcap")).expect("log"));
    assert!(topics.contains(&"/reference/tf".to_owned()), "{topics:?}");
    assert!(
        entities.contains(&"reference link forearm".to_owned()),
        "{entities:?}"
    );
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
}

#[test]
fn a_reference_overlay_needs_a_reference() {
    let bed = TestBed::new();
    bed.write("submission.rhai", "fn control(observation) { 0.0 }");
    // a folder without labs beside it: those built in, and no reference
    let ran = bed.run(&[
        "grade",
        "01-kinematics",
        "submission.rhai",
        "--reference-overlay",
    ]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(
        ran.stderr
            .contains("--reference-overlay needs the reference solution")
            && ran.stderr.contains("--reference DIR"),
        "{ran:?}"
    );
    assert!(!bed.path("out").exists());
    let ran = bed.run(&[
        "grade",
        "01-kinematics",
        "submission.rhai",
        "--reference-overlay",
        "--practice",
    ]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
}

/// The page groups by the sentences in which a record says what a check waits for: a check that needs another is in the other's row.
#[test]
fn a_check_that_waits_for_another_is_in_its_row_of_costs() {
    let bed = TestBed::new();
    bed.copy_labs();
    let submission = root().join("tests/submissions/04-knock-with-velocity/cuts-the-corner");
    let submission = submission.join("submission.rhai");
    std::fs::copy(submission, bed.path("submission.rhai")).expect("copied");
    let ran = bed.run(&["grade", "04-knock-with-velocity", "submission.rhai"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let page = std::fs::read_to_string(bed.path("out/report.html")).expect("page");
    let costs = page.split("id=\"costs-title\"").nth(1).expect("costs");
    let row = costs.split("</li>").next().expect("a row");
    for part in [
        "up to <b>+7</b>",
        "On the first line",
        "and with it <bdi>The speed along the first line</bdi>",
    ] {
        assert!(row.contains(part), "no {part} in {row}");
    }
}
