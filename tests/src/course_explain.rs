//! A complaint answered: the grade as it was given whatever has become of the lab, and a paragraph without a hidden number.

use kinemark_sim::text::number::trimmed;
use serde_json::Value;

use crate::course_class::{LAB, accept_lab, class, grade, standings};
use crate::testbed::{TestBed, files_below, root};

fn explained(bed: &TestBed, student: &str, more: &[&str]) -> Value {
    let args = [&["course", "explain", student, LAB, "--json"], more].concat();
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    serde_json::from_str(&ran.stdout).expect("JSON")
}

/// Points and record of a student.
fn grade_of(bed: &TestBed, student: &str) -> (Value, Value) {
    let rows = standings(bed);
    let row = rows.into_iter().find(|row| row.0 == student);
    let (.., points, record) = row.expect("a row");
    (points, record)
}

/// All numbers below a value.
fn numbers(value: &Value, into: &mut Vec<f64>) {
    match value {
        Value::Number(number) => into.extend(number.as_f64()),
        Value::Array(values) => values.iter().for_each(|value| numbers(value, into)),
        Value::Object(values) => values.values().for_each(|value| numbers(value, into)),
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}

/// No number of a hidden case or run is in the paragraph.
fn is_free_of_hidden_numbers(explained: &Value) {
    let paragraph = explained["paragraph"].as_str().expect("a paragraph");
    let mut hidden = Vec::new();
    for draw in explained["hidden"].as_array().expect("draws") {
        numbers(&draw["draw"]["numbers"], &mut hidden);
    }
    assert!(!hidden.is_empty());
    for number in hidden {
        // fewer digits are those of points and counts
        for decimals in 3..7 {
            let written = trimmed(number, decimals);
            let found = written.len() > 4 && paragraph.contains(&written);
            assert!(!found, "{written} in {paragraph}");
        }
    }
}

#[test]
fn a_grade_is_explained_as_it_was_given() {
    let bed = class();
    grade(&bed, &["--no-reports"]);
    let (points, first) = grade_of(&bed, "s103");
    let first = first.as_str().expect("a key").to_owned();
    let before = explained(&bed, "s103", &[]);
    let lab = format!("labs/{LAB}/lab.toml");
    for (from, to) in [
        ("fk-error = { full_m = 1e-4", "fk-error = { full_m = 1e-5"),
        (
            "pose-reached = { full_m = 2e-3, zero_m = 2e-2",
            "pose-reached = { full_m = 1e-3, zero_m = 5e-3",
        ),
    ] {
        bed.edit(&lab, from, to);
        accept_lab(&bed);
        let apply = ["--apply", "--allow-lower", "--why", "a band was too wide"];
        let ran = bed.run(&[&["course", "regrade", LAB][..], &apply[..]].concat());
        assert_eq!(ran.code, Some(0), "{ran:?}");
    }
    let (points_now, record_now) = grade_of(&bed, "s103");
    assert_ne!(points, points_now);
    // neither the labs of today nor the reference is needed
    std::fs::rename(bed.path("labs"), bed.path("away")).expect("moved");
    std::fs::rename(bed.path("reference"), bed.path("away-too")).expect("moved");
    let now = explained(&bed, "s103", &[]);
    assert_eq!((&now["points"], &now["record"]), (&points_now, &record_now));
    assert_eq!(
        (&now["counts"], &now["is_same_grade"]),
        (&true.into(), &true.into())
    );
    let then = explained(&bed, "s103", &["--record", &first[..12]]);
    assert_eq!((&then["points"], &then["record"]), (&points, &first.into()));
    assert_eq!(
        (&then["counts"], &then["is_same_grade"]),
        (&false.into(), &true.into())
    );
    assert_eq!(
        (&then["hidden"], &then["paragraph"]),
        (&before["hidden"], &before["paragraph"])
    );
    let history = now["history"][0]["grades"].as_array().expect("grades");
    assert_eq!(history.len(), 3);
    assert_eq!(history[2]["why"], "a band was too wide");
    for explained in [&now, &then] {
        is_free_of_hidden_numbers(explained);
    }
    assert_eq!(explained(&bed, "s103", &["--attempt", "1"]), now);
    for wrong in [
        &["--attempt", "2"][..],
        &["--record", "abc"],
        &["--record", "00000000"],
    ] {
        let ran = bed.run(&[&["course", "explain", "s103", LAB], wrong].concat());
        assert_eq!(ran.code, Some(2), "{ran:?}");
        assert!(ran.stderr.contains("there are these records"), "{ran:?}");
    }
}

#[test]
fn a_file_that_is_no_program_is_explained_once_and_truly() {
    let bed = class();
    let good = root().join(format!("tests/submissions/{LAB}/good/submission.rhai"));
    let text = std::fs::read_to_string(good).expect("a submission");
    let utf_16 = [0xFEFF].into_iter().chain(text.encode_utf16());
    let bytes: Vec<u8> = utf_16.flat_map(u16::to_le_bytes).collect();
    bed.write("in/s106.rhai", bytes);
    grade(&bed, &["--no-reports"]);
    for (student, why) in [
        ("s102", "(line 3: \"}\")"),
        ("s106", "the file is text in UTF-16, not a submission"),
    ] {
        let ran = bed.run(&["course", "explain", student, LAB, "--out", "complaint"]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        let heading = "To send to the student";
        assert_eq!(ran.stdout.matches(heading).count(), 1, "{ran:?}");
        let (for_staff, paragraph) = ran.stdout.split_once(heading).expect("a paragraph");
        assert!(
            paragraph.contains("Nothing of it could be run: "),
            "{paragraph}"
        );
        assert_eq!(paragraph.matches(why).count(), 1, "{paragraph}");
        assert!(
            for_staff.contains("Nothing of it could be run:"),
            "{for_staff}"
        );
        for absent in [
            "no answer",
            "gives another grade",
            "off by more",
            "was the book changed",
        ] {
            assert!(!ran.stdout.contains(absent), "{absent}: {ran:?}");
        }
    }
    // who waits for a person has no grade to explain
    let ran = bed.run(&["course", "explain", "s107", LAB]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("waits for a person"), "{ran:?}");
    #[cfg(unix)]
    for (path, _) in files_below(&bed.path("complaint")) {
        use std::os::unix::fs::PermissionsExt as _;
        let file = bed.path("complaint").join(&path);
        let mode = file.metadata().expect("it").permissions().mode();
        assert_eq!(mode & 0o777, 0o600, "{path}");
    }
}
