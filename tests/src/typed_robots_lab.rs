//! Lab 6 against figures that were computed elsewhere: what its reference solution answers for every sample of `E_deseroi.json`, for both
//! examples that the lab's source prints, and rows that are none.

use std::f64::consts::PI;
use std::fmt::Write as _;

use kinemark_grader::record::verdict::Verdict;
use kinemark_report::text::text;
use serde_json::Value as Json;

use crate::own_lab::OwnLab;
use crate::testbed::{grade, root};

/// Of 100, which no pose and no Jacobian here exceeds: so each may be off by 1e-10 in the Frobenius norm.
const BAND: &str = "least_size = 100.0";
const CHECK: &str = "function-cases = { full = 1e-12, zero = 1e-12 }";

const HEAD: &str = r#"
format = 1
name = "96-samples"
title = "Samples"
robot = "Rz"
"#;

/// What the samples ask of a submission of lab 6, in one function.
const ASKED: &str = r#"
fn answers(robot, given) {
    #{ last_joint: last_joint(robot, given.q), tip: tip(robot, given.q), jacobian: jacobian(robot, given.q) }
}
fn poses(robot, given) {
    #{ last_joint: last_joint(robot, given.q), tip: tip(robot, given.q) }
}
"#;

fn golden() -> Json {
    let path = root().join("tests/golden/E_deseroi.json");
    serde_json::from_str(&std::fs::read_to_string(path).expect("a file")).expect("JSON")
}

fn of_lab(file: &str) -> String {
    let path = root().join("reference/06-typed-robots").join(file);
    std::fs::read_to_string(path).expect("a file of lab 6") + ASKED
}

fn array(value: &Json) -> &[Json] {
    value.as_array().expect("an array")
}

/// A case of the configuration `of` with the joints at `q_deg_or_m`: degrees where they turn.
fn case(name: &str, of: &Json, q_deg_or_m: &Json, expected: &str) -> String {
    let row = of["config"].as_str().expect("a row");
    let q: Vec<f64> = array(q_deg_or_m)
        .iter()
        .zip(row.as_bytes().chunks(2))
        .map(|(q, joint)| {
            let q = q.as_f64().expect("a number");
            if joint[0] == b'R' { q * PI / 180.0 } else { q }
        })
        .collect();
    let mut dimensions = format!("base_height = {}", of["h_base"]);
    for (i, link) in array(&of["links"]).iter().enumerate() {
        let _ = write!(dimensions, ", link{} = {link}", i + 1);
    }
    format!(
        "{{ name = \"{name}\", robot = \"{row}\", dimensions = {{ {dimensions} }}, given = {{ q = {q:?} }}, expected = {{ {expected} }} }},\n"
    )
}

fn task(name: &str, call: &str, cases: &str) -> String {
    format!(
        "\n[[tasks]]\nname = \"{}\"\ntitle = \"{name}\"\nchecks = [{{ name = \"c\", title = \"C\", points = 1.0, {CHECK} }}]\n\
         [tasks.function]\ncall = \"{call}\"\nwith_robot = true\n{BAND}\ncases = [\n{cases}]\n",
        name.to_lowercase()
    )
}

/// A task for each configuration, with all of its samples.
fn samples() -> String {
    let file = golden();
    let configurations = array(&file["configurations"]);
    assert_eq!(configurations.len(), 5);
    let mut tasks = String::new();
    for of in configurations {
        let samples = array(&of["samples"]);
        assert_eq!(samples.len(), 31);
        let cases: String = (samples.iter().enumerate())
            .map(|(i, sample)| {
                let expected = format!(
                    "last_joint = {}, tip = {}, jacobian = {}",
                    sample["H_last_joint"], sample["T_tip"], sample["jac_tip"]
                );
                case(&format!("s{i}"), of, &sample["q_deg_or_len"], &expected)
            })
            .collect();
        tasks += &task(of["config"].as_str().expect("a row"), "answers", &cases);
    }
    tasks
}

/// The examples that the source prints, with the joint angles that give what it prints; `all` adds those that tell the joints apart.
fn printed(all: bool) -> String {
    let file = golden();
    let cases: String = (array(&file["paper_examples"]["cases"]).iter().enumerate())
        .filter(|(_, of)| all || array(&of["q_deg"]).iter().all(|q| q.as_f64() == Some(0.0)))
        .map(|(i, of)| {
            let expected = format!("last_joint = {}, tip = {}", of["H_last_joint"], of["T_tip"]);
            case(&format!("e{i}"), of, &of["q_deg"], &expected)
        })
        .collect();
    assert_eq!(cases.lines().count(), if all { 11 } else { 2 });
    task("printed", "poses", &cases)
}

/// The points of a submission of lab 6 for these tasks, its verdict, and the feedback.
fn points(tasks: &str, submission: &str) -> (f64, Verdict, String) {
    let lab = OwnLab::new("96-samples", format!("{HEAD}{tasks}")).lab();
    let grade = grade(&lab, None, "mine.rhai", submission).grade;
    (grade.points, grade.verdict, text(&grade))
}

#[test]
fn the_reference_solution_agrees_with_all_samples() {
    let (points, verdict, text) = points(&samples(), &of_lab("solution.rhai"));
    assert_eq!((points, verdict), (5.0, Verdict::Passed), "{text}");
}

#[test]
fn a_nanometre_is_noticed_in_the_samples() {
    let solution = of_lab("solution.rhai");
    let off = solution.replace("robot.base_height]", "robot.base_height + 1e-9]");
    assert_ne!(off, solution);
    let (points, _, text) = points(&samples(), &off);
    // the Jacobian, a third of each of the five tasks, does not depend on the height
    assert_eq!(points, 1.65, "{text}");
}

/// The printed position (3, 0, 6) is right, and proves little: frames that every joint turns back to the world have it, too.
#[test]
fn the_printed_examples_are_right_and_prove_little() {
    let back = of_lab("mutants/back-to-the-world.rhai");
    for (all, submission, expected) in [
        (true, of_lab("solution.rhai"), Verdict::Passed),
        (false, back.clone(), Verdict::Passed),
        (true, back, Verdict::Missed),
    ] {
        let (_, verdict, text) = points(&printed(all), &submission);
        assert_eq!(verdict, expected, "{text}");
    }
    for of in array(&golden()["paper_examples"]["cases"]) {
        if array(&of["q_deg"]).iter().all(|q| q.as_f64() == Some(0.0)) {
            let at: Vec<f64> = (0..3)
                .map(|i| of["H_last_joint"][i][3].as_f64().expect("a number"))
                .collect();
            assert_eq!(at, [3.0, 0.0, 6.0]);
        }
    }
}

/// A row that is none is refused as the robot of a case, with what is wrong in it; as a lab's robot it may be the name of a file, too.
#[test]
fn rows_that_are_none_are_refused() {
    const EXPECTED: [(&str, &str); 8] = [
        ("", "an empty string has no joints"),
        ("R", "`R` at the end has no axis"),
        ("Rw", "`w` is no axis"),
        ("RzRy3", "sign 5: `3` is not a joint"),
        ("zR", "sign 1: `z` is not a joint"),
        ("rzry", "sign 1: `r` is not a joint"),
        ("Rz Ry", "sign 3: ` ` is not a joint"),
        ("RzRyRzX", "sign 7: `X` is not a joint"),
    ];
    let cases = "{ name = \"a\", given = { q = [0.0] }, expected = { tip = [1.0] } },\n";
    let text = format!("{HEAD}{}", task("a", "poses", cases));
    let refusal = |from: &str, to: &str| {
        let lab = OwnLab::new("96-samples", text.replacen(from, to, 1));
        match lab.load() {
            Ok(_) => panic!("{to} is accepted"),
            Err(error) => error.to_string(),
        }
    };
    let file = golden();
    let invalid = array(&file["invalid_strings"]).iter();
    let invalid: Vec<&str> = invalid.map(|row| row.as_str().expect("a text")).collect();
    assert_eq!(invalid, EXPECTED.map(|(row, _)| row));
    for (row, expected) in EXPECTED {
        let of_case = refusal(
            "name = \"a\", ",
            &format!("name = \"a\", robot = \"{row}\", "),
        );
        assert!(of_case.contains(expected), "{row}: {of_case}");
        let of_lab = refusal("robot = \"Rz\"", &format!("robot = \"{row}\""));
        let no_file = format!("no robot file `robots/{row}.toml`");
        assert!(
            of_lab.contains(expected) || of_lab.contains(&no_file),
            "{row}: {of_lab}"
        );
    }
}
