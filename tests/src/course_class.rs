//! Classes that tests grade through `kinemark course`: a folder with everything that a course needs, and what the book says afterwards.

use std::path::PathBuf;

use serde_json::Value;

use crate::testbed::{CommandResult, TestBed, files_below, names_below, root};

pub(crate) const LAB: &str = "01-kinematics";

/// Who hands in what: one file a person, named by id.
pub(crate) const CLASS: [(&str, &str, &str); 6] = [
    ("s100", "Jörg Müller", "good"),
    ("s101", "李 雷", "degrees"),
    ("s102", "=SUM(A1) Formula", "syntax"),
    ("s103", "Ann Lee", "four-millimetres-off"),
    ("s104", "Renée d'Été", "misnamed"),
    ("s105", "😀", "elbow-flips"),
];

/// A course of [`CLASS`] and two more, whose lab has its digest in `course.toml`, and a folder `in` with the hand-ins of the class.
pub(crate) fn class() -> TestBed {
    class_in(TestBed::new())
}

/// The same in `bed`.
pub(crate) fn class_in(bed: TestBed) -> TestBed {
    let mut roster = "id,name\n".to_owned();
    for (id, name, submission) in CLASS {
        roster += &format!("{id},\"{name}\"\n");
        hand_in(&bed, &format!("in/{id}.rhai"), submission);
    }
    roster += "s106,\"Nobody's Work\"\ns107,\"Two Files\"\n";
    hand_in(&bed, "in/s107/a.rhai", "good");
    hand_in(&bed, "in/s107/b.rhai", "degrees");
    course(&bed, &roster);
    bed
}

/// A course of `count` students in `bed`, no two of whom hand in the same.
pub(crate) fn large_class_in(bed: TestBed, count: usize) -> TestBed {
    let mut roster = "id,name\n".to_owned();
    for number in 0..count {
        let (_, _, submission) = CLASS[number % CLASS.len()];
        let text = std::fs::read_to_string(submission_file(submission)).expect("a submission");
        roster += &format!("s{number},Person {number}\n");
        bed.write(
            &format!("in/s{number}.rhai"),
            format!("{text}\n// {number}\n"),
        );
    }
    course(&bed, &roster);
    bed
}

/// Labs, salt, roster and rules.
pub(crate) fn course(bed: &TestBed, roster: &str) {
    bed.copy_labs();
    bed.write("salt.txt", "a line that nobody can guess\n");
    bed.write("roster.csv", roster);
    bed.write(
        "course.toml",
        format!(
            "format = 1\ntitle = \"Robots\"\nsalt_file = \"salt.txt\"\npublic_solutions = true\n\
             labs_folder = \"labs\"\nreference = \"reference\"\n\n[[labs]]\nname = \"{LAB}\"\ndigest = \"\"\n"
        ),
    );
    accept_lab(bed);
}

fn submission_file(name: &str) -> PathBuf {
    root().join(format!("tests/submissions/{LAB}/{name}/submission.rhai"))
}

pub(crate) fn hand_in(bed: &TestBed, path: &str, submission: &str) {
    let file = submission_file(submission);
    bed.write(path, std::fs::read(file).expect("a submission"));
}

/// Writes the digest of the lab as it is now into `course.toml`, as `course check` says.
pub(crate) fn accept_lab(bed: &TestBed) {
    let ran = bed.run(&["course", "check", "--json"]);
    let rows: Value = serde_json::from_str(&ran.stdout).expect("JSON");
    let row = rows["checks"]
        .as_array()
        .and_then(|rows| rows.iter().find(|row| row["what"] == LAB));
    let help = row.and_then(|row| row["help"].as_str()).expect("a help");
    let (_, rest) = help.split_once("digest = \"").expect("a digest");
    let digest = &rest[..64];
    let text = std::fs::read_to_string(bed.path("course.toml")).expect("file");
    let (before, old) = text.split_once("digest = \"").expect("a line");
    let (_, after) = old.split_once('"').expect("its end");
    bed.write(
        "course.toml",
        format!("{before}digest = \"{digest}\"{after}"),
    );
    let ran = bed.run(&["course", "check"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
}

pub(crate) fn grade(bed: &TestBed, more: &[&str]) -> CommandResult {
    bed.run(&[&["course", "grade", "in", LAB], more].concat())
}

/// A student's id, status, points and record.
pub(crate) type Stands = (String, String, Value, Value);

/// How everybody stands, by id.
pub(crate) fn standings(bed: &TestBed) -> Vec<Stands> {
    let ran = bed.run(&["course", "grade", LAB, "--json"]);
    let rows: Value = serde_json::from_str(&ran.stdout).expect("JSON");
    let rows = rows["standings"].as_array().expect("a list").iter();
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    rows.map(|row| {
        let (points, record) = (row["points"].clone(), row["record"].clone());
        (text(&row["student"]), text(&row["status"]), points, record)
    })
    .collect()
}

/// Records by path, with their bytes; what a killed process was writing is none.
pub(crate) fn records(bed: &TestBed) -> Vec<(String, Vec<u8>)> {
    let mut files = files_below(&bed.path("book/records"));
    files.retain(|(path, _)| path.ends_with(".json"));
    files
}

/// Whether anybody has a record, while others write.
pub(crate) fn has_graded(bed: &TestBed) -> bool {
    let names = names_below(&bed.path("book/records"));
    names.iter().any(|name| name.ends_with(".json"))
}
