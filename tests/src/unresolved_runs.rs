//! Runs whose simulation is not accurate to the end: students and staff see it in the report, and staff in the list of a class.

use serde_json::Value as Json;

use crate::course_class::{LAB, accept_lab, course};
use crate::testbed::{TestBed, files_below};

/// Two bars on hinges without limits. At 300 rad/s and 1 ms their motion loses energy; at 10 rad/s it does not.
const ROBOT: &str = r#"
format = 1
name = "two-bars"
links = [
    { name = "base" },
    { name = "upper", inertia = { mass_kg = 0.5, com_m = [0, 0, -0.5], tensor_kg_m2 = [0.04, 0.04, 0.0004, 0, 0, 0] } },
    { name = "lower", inertia = { mass_kg = 0.5, com_m = [0, 0, -0.5], tensor_kg_m2 = [0.04, 0.04, 0.0004, 0, 0, 0] } },
]
joints = [
    { name = "first", type = "continuous", parent = "base", child = "upper", axis = [0, 1, 0] },
    { name = "second", type = "continuous", parent = "upper", child = "lower", origin = { xyz_m = [0, 0, -1] }, axis = [0, 1, 0] },
]
frames = [{ name = "tcp", link = "lower", origin = { xyz_m = [0, 0, -1] } }]
"#;

const SPIN: &str = r#"
format = 1
name = "01-kinematics"
title = "Spin"
robot = "two-bars"

[parameters]
spin = 10.0                      # [rad/s]

[variants]
spin = { from = 5.0, to = 15.0, step = 1.0 }

[[tasks]]
name = "spin"
title = "Let it spin"
[tasks.motion]
mode = "effort"
duration_s = 0.5
start_rad = [1.0, 0.5]
start_rad_s = ["= spin", "= 0 - spin"]
[[tasks.checks]]
name = "any"
title = "It may do anything"
points = 1.0
joint-speed = { full_rad_s = 1e5, zero_rad_s = 2e5 }
"#;

const HIDDEN: &str = r#"
format = 1
salt = "sea"

[[runs]]
task = "spin"
class = "much faster"
count = 3
parameters = { spin = [300.0, 310.0] }
"#;

const STILL: &str = "fn control(observation) { [0.0, 0.0] }\n";

/// Drives the bars on until a step of 1 ms does not resolve their motion.
const SPINS_UP: &str = "fn control(observation) { [100.0, -100.0] }\n";

/// A course whose lab is the one above.
fn bed() -> TestBed {
    let bed = TestBed::new();
    course(&bed, "id,name\ns1,Ann\ns2,Ben\n");
    for top in ["labs", "reference"] {
        std::fs::remove_dir_all(bed.path(&format!("{top}/{LAB}"))).expect("removed");
    }
    bed.write("labs/robots/two-bars.toml", ROBOT);
    bed.write(&format!("labs/{LAB}/lab.toml"), SPIN);
    bed.write(&format!("reference/{LAB}/hidden.toml"), HIDDEN);
    bed.write(&format!("reference/{LAB}/solution.rhai"), STILL);
    bed
}

#[test]
fn hidden_runs_that_are_not_accurate_are_counted_and_no_number_is_shown() {
    let bed = bed();
    bed.write("hand-ins/mine.rhai", STILL);
    let ran = bed.run(&["grade", LAB, "hand-ins/mine.rhai"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let words = "the simulation is not accurate to the end of 3 of 3 hidden runs";
    assert!(ran.stdout.contains(words), "{ran:?}");
    let page = std::fs::read_to_string(bed.path("out/report.html")).expect("a page");
    assert!(page.contains(words), "the page");
    let record = std::fs::read_to_string(bed.path("out/grade.json")).expect("a record");
    let record: Json = serde_json::from_str(&record).expect("JSON");
    let task = &record["tasks"][0];
    assert_eq!(task["hidden"][0]["under_resolved"], 3);
    let events = task["events"].as_array().into_iter().flatten();
    let visible = events.filter(|event| event["event"] == "under-resolved");
    assert_eq!(visible.count(), 0, "the visible run is accurate");
    assert_eq!(record["points"], 1.0, "points are as before");
    assert_eq!(bed.run(&["verify", "out"]).code, Some(0));
}

#[test]
fn staff_see_in_the_class_whose_simulation_is_not_accurate() {
    let bed = bed();
    bed.edit(
        &format!("reference/{LAB}/hidden.toml"),
        "[300.0, 310.0]",
        "[8.0, 12.0]",
    );
    accept_lab(&bed);
    bed.write("in/s1.rhai", SPINS_UP);
    bed.write("in/s2.rhai", STILL);
    let ran = bed.run(&["course", "grade", "in", LAB]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let words = "with a run whose simulation is not accurate to the end: s1\n";
    assert!(ran.stdout.contains(&format!("1 {words}")), "{ran:?}");
    let ran = bed.run(&["course", "grade", LAB, "--json"]);
    let rows: Json = serde_json::from_str(&ran.stdout).expect("JSON");
    let marked: Vec<_> = rows["standings"]
        .as_array()
        .expect("rows")
        .iter()
        .map(|row| (row["student"].as_str(), row["is_under_resolved"].as_bool()))
        .collect();
    assert_eq!(
        marked,
        [(Some("s1"), Some(true)), (Some("s2"), Some(false))]
    );
    let ran = bed.run(&["course", "page", LAB, "--names"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let pages = files_below(&bed.path("book/pages"));
    let marks = pages.iter().map(|(_, page)| {
        String::from_utf8_lossy(page)
            .matches("simulation not accurate<")
            .count()
    });
    assert_eq!(marks.sum::<usize>(), 1, "on the page with names");
}
