//! JSON Lines read line by line.

use serde_json::Value;

use super::*;
use crate::release::sample::{Class, HOSTILE, change, material};

#[test]
fn a_line_a_student_with_points_only_where_they_are_decided() {
    let mut class = Class::hostile();
    class.of("s02").by_hand = vec![change(Some("fk/mean-error"), 0.5, "why\nso", false)];
    let rows = class.rows();
    let made = FORM.release(&material(&rows, None)).unwrap();
    let text = String::from_utf8(made.files[0].bytes.clone()).unwrap();
    let lines: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(lines.len(), rows.len());
    assert_eq!(lines[0]["format"], "kinemark-release/1");
    assert_eq!(lines[0]["points"], 17.5);
    assert_eq!(lines[1]["tasks"][0]["checks"][1]["points"], 1.7);
    assert_eq!(lines[1]["by_hand"][0]["why"], "why\nso");
    for line in &lines[HOSTILE.len()..lines.len() - 1] {
        assert!(line["points"].is_null() && line["tasks"].as_array().unwrap().is_empty());
    }
    assert_eq!(lines[HOSTILE.len() + 2]["status"], "host-limit");
    // ids and no names
    assert!(!text.contains("Lovelace"));
}
