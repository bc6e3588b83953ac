//! Options of `kinemark lab check`, through the binary: what is quick, how many at once, the page; and the doubt that needs a second run.

use serde_json::Value as Json;

use crate::own_lab::OwnLab;
use crate::testbed::{CommandResult, TestBed};

fn check(bed: &TestBed, lab: &str, more: &[&str]) -> (CommandResult, Json) {
    let ran = bed.run(&[&["lab", "check", lab, "--json"], more].concat());
    assert!(matches!(ran.code, Some(0 | 1)), "{ran:?}");
    let audit = serde_json::from_str(&ran.stdout).expect("JSON");
    (ran, audit)
}

#[test]
fn however_many_are_tried_at_once_the_answer_is_the_same_and_a_page_shows_every_band() {
    let bed = TestBed::new();
    bed.copy_labs();
    let lab = "01-kinematics";
    let (one, audit) = check(
        &bed,
        lab,
        &["--quick", "--jobs", "1", "--page", "bands.html"],
    );
    let (two, _) = check(&bed, lab, &["--quick", "--jobs", "2"]);
    assert_eq!(one.code, Some(0), "{one:?}");
    assert_eq!(one.stdout, two.stdout);
    assert_ne!(
        audit["left_out"],
        Json::Null,
        "what --quick leaves out is said: {audit}"
    );

    let page = std::fs::read_to_string(bed.path("bands.html")).expect("a page");
    let bands = audit["bands"].as_array().expect("bands");
    assert!(bands.len() >= 8, "{bands:?}");
    for band in bands {
        let title = band["title"]
            .as_str()
            .expect("a title")
            .replace('\'', "&#39;");
        let plain = page.replace("&#x27;", "&#39;").replace('\'', "&#39;");
        assert!(plain.contains(&title), "no {title}");
    }
    assert!(!page.contains("NaN"));
    let all = bed.run(&["lab", "check", lab, "--jobs", "0"]);
    assert_eq!(all.code, Some(2), "{all:?}");
}

#[test]
fn the_folder_of_a_lab_gets_the_name_and_the_option_to_type() {
    let bed = TestBed::new();
    bed.copy_labs();
    for command in [&["lab", "check"][..], &["lab", "fill"], &["lab", "draws"]] {
        let ran = bed.run(&[command, &["labs/01-kinematics/"]].concat());
        assert_eq!(ran.code, Some(2), "{ran:?}");
        for words in [
            "`labs/01-kinematics/` is the folder of a lab, and a lab is given by its name",
            "type `01-kinematics --labs labs` in place of it",
        ] {
            assert!(ran.stderr.contains(words), "{words}: {ran:?}");
        }
    }
}

/// A brief that shows what is not there, and a starter with the solution in it.
#[test]
fn pictures_that_are_missing_and_solutions_in_starters_are_found() {
    let bed = TestBed::new();
    bed.copy_labs();
    let lab = "01-kinematics";
    bed.edit(&format!("labs/{lab}/brief.md"), ".svg)", "-.svg)");
    let solution = std::fs::read_to_string(bed.path("reference/01-kinematics/solution.py"));
    bed.write(
        "labs/01-kinematics/starter.py",
        solution.expect("a solution"),
    );
    let (ran, _) = check(&bed, lab, &["--quick"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    for words in [
        "brief.md shows the picture `",
        "starter.py has ",
        "and there is no such file",
    ] {
        assert!(ran.stdout.contains(words), "{words}: {}", ran.stdout);
    }
    // options of changes alone are not dropped in silence
    let ran = bed.run(&["lab", "check", lab, "--quick", "--draw", "3"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("--mutate"), "{ran:?}");
}

/// A servo that is too stiff for a physics step of 1 ms, and a band that is thinner than what this makes of the value.
const LAB: &str = r#"
format = 1
name = "98-thin"
title = "Thin"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "turn"
title = "Turn"
[tasks.motion]
mode = "position"
duration_s = 1.0
servo = { kp = 400.0, kd = 8.0, derivative = "velocity", gravity_compensation = true, effort_limit = 200.0 }
[[tasks.checks]]
name = "rise"
title = "How far it swings past"
points = 1
step-overshoot = { joint = "elbow", full = 0.1, zero = 0.100001 }
"#;

#[test]
fn a_band_that_is_thinner_than_the_simulation_is_accurate_is_doubted_with_both_values() {
    let lab = OwnLab::new("98-thin", LAB)
        .and(
            "hidden.toml",
            "format = 1\nsalt = \"of a test, long enough\"\n",
        )
        .and("solution.rhai", "fn control(observation) { [0.0, 1.0] }\n");
    lab.write(
        "labs/98-thin/starter.rhai",
        "fn control(observation) { observation.q }\n",
    );
    lab.write("labs/98-thin/brief.md", "# Thin\n\nWrite `control`.\n");
    let (_, audit) = check(lab.bed(), "98-thin", &[]);
    let rows = audit["rows"].as_array().expect("rows").iter();
    let of_rule = |row: &&Json| row["name"] == "accuracy";
    let problems: Vec<&str> = rows
        .filter(of_rule)
        .filter_map(|row| row["problem"].as_str())
        .collect();
    let [problem] = problems[..] else {
        panic!("{problems:?}: {audit}");
    };
    for words in [
        "turn/rise: with half the physics step, 0.5 ms",
        "instead of",
    ] {
        assert!(problem.contains(words), "{problem}");
    }
}
