//! `results.json` against the rules of Gradescope's specification.

use serde_json::Value;

use super::*;
use crate::release::sample::{Class, change, material};

fn results_of(class: &Class) -> Vec<(String, Value)> {
    let rows = class.rows();
    let made = FORM.release(&material(&rows, None)).unwrap();
    made.files
        .into_iter()
        .map(|file| (file.path, serde_json::from_slice(&file.bytes).unwrap()))
        .collect()
}

/// What the specification asks: a score, known values of the fields that have a list of them, numbers where numbers belong.
fn check(results: &Value) {
    let words = |value: &Value, all: &[&str]| {
        let word = value.as_str().unwrap();
        assert!(all.contains(&word), "{word}");
    };
    const VISIBILITY: [&str; 4] = ["hidden", "after_due_date", "after_published", "visible"];
    const FORMATS: [&str; 5] = ["text", "html", "simple_format", "md", "ansi"];
    assert!(results["score"].is_number());
    words(&results["visibility"], &VISIBILITY);
    words(&results["stdout_visibility"], &VISIBILITY);
    for format in ["output_format", "test_output_format", "test_name_format"] {
        words(&results[format], &FORMATS);
    }
    for test in results["tests"].as_array().unwrap() {
        assert!(test["score"].is_number() && test["max_score"].is_number());
        words(&test["status"], &["passed", "failed"]);
        assert!(
            test["name"].is_string() && test["number"].is_string() && test["output"].is_string()
        );
        // a hidden one would hide the total
        assert_eq!(test["visibility"], "visible");
    }
}

#[test]
fn results_follow_the_specification() {
    let class = Class::hostile();
    let all = results_of(&class);
    assert_eq!(all.len(), 9);
    for (path, results) in &all {
        assert!(path.ends_with("/results.json"));
        check(results);
    }
    let (path, first) = &all[0];
    assert_eq!(path, "s01/results.json");
    assert_eq!(first["score"], 17.5);
    let tests = first["tests"].as_array().unwrap();
    assert_eq!(tests[0]["number"], "1.1");
    assert_eq!(tests[0]["name"], "Forward kinematics: Straight arm");
    assert_eq!(
        (&tests[0]["status"], &tests[1]["status"]),
        (&"passed".into(), &"failed".into())
    );
    assert!(
        tests[1]["output"]
            .as_str()
            .unwrap()
            .contains("Next: Draw the arm")
    );
    assert!(first["output"].as_str().unwrap().contains("hidden cases: "));
    // points without a file: a score and no tests
    let (_, by_hand) = all.last().unwrap();
    assert_eq!(by_hand["score"], 20.0);
    assert!(by_hand["tests"].as_array().unwrap().is_empty());
}

#[test]
fn points_by_hand_are_in_the_test_and_paths_are_not() {
    let mut class = Class::of_roster("id,name\ns1,Ada\n");
    class.grade("s1", 10.0);
    class.of("s1").by_hand = vec![change(
        Some("fk/mean-error"),
        1.8,
        "see /srv/ta/x/y.md",
        false,
    )];
    let (_, results) = results_of(&class).remove(0);
    let test = &results["tests"][1];
    assert_eq!(
        (&test["score"], &test["status"]),
        (&3.0.into(), &"passed".into())
    );
    assert!(
        test["output"]
            .as_str()
            .unwrap()
            .ends_with("By hand: +1.8: see y.md")
    );
    assert!(!results.to_string().contains("/home"));
}
