//! Changes of a solution that a rubric must notice: `lab check --mutate`, on a lab of which it is known what survives.

use std::collections::BTreeSet;

use serde_json::Value as Json;

use crate::testbed::{CommandResult, TestBed};

const LAB: &str = r#"
format = 1
name = "93-height"
title = "A rubric that does not look at millimetres"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "fk"
title = "Forward kinematics"

[tasks.function]
call = "forward_kinematics"
cases = [
    { name = "both bent", q_rad = [0.7, -1.1] },
    { name = "to the left", q_rad = [-0.9, 0.4] },
]

[[tasks.checks]]
name = "position"
title = "The position of the TCP"
points = 4.0
fk-error = { full_m = 0.02, zero_m = 0.2 }
"#;

/// The hand is 0.05 m beside the base's middle. A tenth of that is within the band.
const SOLUTION: &str = r"// Größe: é
const BESIDE = 0.05;     // m, of two links

fn forward_kinematics(robot, q) {
    let l = robot.link_lengths;
    let x = robot.base_height + l[0] * cos(q[0]) + l[1] * cos(q[0] + q[1]);
    let y = l[0] * sin(q[0]) + l[1] * sin(q[0] + q[1]);
    [x, y, BESIDE]
}

fn not_called(x) {
    x + 1
}
";

const HIDDEN: &str = r#"
format = 1
salt = "a long one that nobody can guess"

[[draws]]
task = "fk"
class = "other angles"
count = 5
q_rad = [[-3.0, 3.0], [-3.0, 3.0]]
"#;

const ACCEPTED: &str = r#"
format = 1

[[accepted]]
rule = "mutation"
of = "const BESIDE = 0.05; -> const BESIDE = 0.045;"
because = "The task is about angles."

[[accepted]]
rule = "choice"
of = "const BESIDE = 0.05; -> const BESIDE = 0.055;"
because = "The same."
"#;

fn bed() -> TestBed {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write("labs/93-height/lab.toml", LAB);
    bed.write(
        "labs/93-height/starter.rhai",
        "fn forward_kinematics(robot, q) { [0.0, 0.0, 0.0] }\n",
    );
    bed.write("reference/93-height/solution.rhai", SOLUTION);
    bed.write("reference/93-height/hidden.toml", HIDDEN);
    bed
}

fn mutate(bed: &TestBed, more: &[&str]) -> CommandResult {
    let mut args = vec!["lab", "check", "93-height", "--mutate"];
    args.extend(more);
    bed.run(&args)
}

fn json(bed: &TestBed, more: &[&str]) -> (Option<i32>, Json) {
    let ran = mutate(bed, &[more, &["--json"]].concat());
    let report = serde_json::from_str(&ran.stdout);
    (
        ran.code,
        report.unwrap_or_else(|error| panic!("{error}: {ran:?}")),
    )
}

fn texts<'j>(list: &'j Json, key: &str) -> Vec<&'j str> {
    let list = list.as_array().expect("a list").iter();
    list.filter_map(|entry| entry[key].as_str()).collect()
}

#[test]
fn what_no_check_notices_is_shown_until_somebody_says_why() {
    let bed = bed();
    let (code, report) = json(&bed, &[]);
    assert_eq!(code, Some(1), "{report}");
    let fates = |fate: &str| -> BTreeSet<&str> {
        let all = report["mutations"].as_array().expect("mutations").iter();
        let of_fate = all.filter(|mutation| mutation["fate"] == fate);
        of_fate
            .filter_map(|mutation| mutation["after"].as_str())
            .collect()
    };
    let survivors = ["const BESIDE = 0.045;", "const BESIDE = 0.055;"];
    assert_eq!(fates("survived"), BTreeSet::from(survivors));
    // a sum of three terms in another order has other bits; what no task calls does not matter
    assert!(fates("equivalent").contains("x - 1"), "{report}");
    assert!(
        fates("caught").contains("const BESIDE = -0.05;"),
        "{report}"
    );
    let mut tried = report["mutations"].as_array().expect("mutations").iter();
    let sine = tried.find(|mutation| {
        mutation["after"] == "let y = l[0] * cos(q[0]) + l[1] * sin(q[0] + q[1]);"
    });
    let sine = sine.unwrap_or_else(|| panic!("{report}"));
    assert_eq!((&sine["line"], &sine["column"]), (&7.into(), &20.into()));
    assert_eq!(sine["by"][0]["check"], "position");
    assert_eq!(report["unparsed"], 0);
    assert_eq!(report["total"], report["tried"]);
    assert!(
        report["share"].as_f64().expect("a share") > 0.95,
        "{report}"
    );

    let shown = mutate(&bed, &[]).stdout;
    assert!(
        shown.contains(
            "reference/93-height/solution.rhai:2:16  (gain)\n    const BESIDE = 0.05;     // m, of two links\n                   ^\n    \
             const BESIDE = 0.045;\n"
        ),
        "{shown}"
    );

    bed.write("reference/93-height/accepted.toml", ACCEPTED);
    let (code, report) = json(&bed, &[]);
    assert_eq!(code, Some(0), "{report}");
    assert_eq!(report["problems"], Json::Array(Vec::new()));
    // what is as right as the solution is none of the mistakes that must be caught
    assert_eq!(
        (&report["survived"], &report["choices"]),
        (&2.into(), &1.into())
    );
    let shares = ["share", "share_of_all"].map(|key| report[key].as_f64().expect("a share"));
    let caught = report["caught"].as_f64().expect("a number");
    assert_eq!(shares, [caught / (caught + 1.0), caught / (caught + 2.0)]);
    let accepted = report["mutations"].as_array().expect("mutations").iter();
    let accepted = accepted.filter_map(|mutation| mutation["accepted"]["because"].as_str());
    assert_eq!(
        accepted.collect::<Vec<_>>(),
        ["The task is about angles.", "The same."]
    );
    assert!(mutate(&bed, &[]).stdout.ends_with("; nothing is wrong\n"));
}

/// A change of a function that has another name in the lab is tried in the task that calls it.
#[test]
fn a_function_may_have_a_name_of_the_labs_own() {
    let bed = bed();
    let (_, before) = json(&bed, &[]);
    let (from, to) = ("forward_kinematics", "hand");
    let call = format!("call = \"{from}\"");
    let lab = "labs/93-height/lab.toml";
    bed.edit(lab, &call, &format!("{call}\nas = \"{to}\""));
    bed.edit("labs/93-height/starter.rhai", from, to);
    bed.edit("reference/93-height/solution.rhai", from, to);
    let (_, named) = json(&bed, &[]);
    assert!(named["caught"].as_u64() > Some(10), "{named}");
    assert_eq!(named["caught"], before["caught"]);
    assert_eq!(named["equivalent"], before["equivalent"]);
}

#[test]
fn an_acceptance_of_what_does_not_survive_is_a_problem() {
    let bed = bed();
    let path = "reference/93-height/accepted.toml";
    bed.write(path, ACCEPTED);
    bed.edit(path, "BESIDE = 0.055;", "BESIDE = -0.05;");
    let (code, report) = json(&bed, &[]);
    assert_eq!(code, Some(1));
    let problems = texts(&report["problems"], "what");
    assert!(problems[0].ends_with("keeps all points"), "{problems:?}");
    assert_eq!(
        problems[1],
        "accepted.toml accepts the mutation `const BESIDE = 0.05; -> const BESIDE = -0.05;`, and it is caught by fk/position"
    );
    assert_eq!(problems.len(), 2);

    // a line that is there no more shows wherever the lab is checked
    bed.edit(path, "BESIDE = -0.05;", "BEHIND = 0.05;");
    let words = "`const BESIDE = 0.05; -> const BEHIND = 0.05;`, and the solution has no such line or change";
    let (_, report) = json(&bed, &["--draw", "1"]);
    assert!(report["problems"].to_string().contains(words), "{report}");
    let checked = bed.run(&["lab", "check", "93-height"]).stdout;
    assert!(checked.contains(words), "{checked}");
    assert!(!checked.contains("BESIDE = 0.045"), "{checked}");
}

#[test]
fn threads_change_nothing_and_a_draw_is_the_same_each_time() {
    let bed = bed();
    let one = mutate(&bed, &["--jobs", "1"]);
    let two = mutate(&bed, &["--jobs", "2"]);
    assert_eq!((one.code, &one.stdout), (two.code, &two.stdout));
    assert_eq!(one.stderr, "");
    let numbers = |seed: &str| {
        let (_, report) = json(&bed, &["--draw", "6", "--seed", seed]);
        let mutations = report["mutations"].as_array().expect("mutations").iter();
        let numbers: Vec<u64> = mutations
            .filter_map(|mutation| mutation["number"].as_u64())
            .collect();
        assert_eq!(numbers.len(), 6);
        numbers
    };
    assert_eq!(numbers("1"), numbers("1"));
    assert_ne!(numbers("1"), numbers("2"));
}

/// A function that a lab calls by a name of its own is reached by that name.
#[test]
fn changes_of_a_function_with_another_name_are_graded() {
    let bed = bed();
    let usual = json(&bed, &[]).1;
    bed.edit(
        "labs/93-height/lab.toml",
        "call = \"forward_kinematics\"\n",
        "call = \"forward_kinematics\"\nas = \"hand_of_arm\"\n",
    );
    for file in ["labs/93-height/starter", "reference/93-height/solution"] {
        bed.edit(
            &format!("{file}.rhai"),
            "fn forward_kinematics",
            "fn hand_of_arm",
        );
    }
    let renamed = json(&bed, &[]).1;
    for key in ["total", "equivalent", "caught", "survived"] {
        assert_eq!(usual[key], renamed[key], "{key}");
    }
}

#[test]
fn a_change_is_kept_as_a_new_file_and_never_over_another() {
    let bed = bed();
    let (_, report) = json(&bed, &[]);
    let mut all = report["mutations"].as_array().expect("mutations").iter();
    let number = |mutation: &Json| mutation["number"].to_string();
    let negative = all
        .find(|mutation| mutation["after"] == "const BESIDE = -0.05;")
        .map(number);
    let negative = negative.expect("a change of the sign");
    let kept = mutate(&bed, &["--keep", &negative, "--as", "other-side"]);
    assert_eq!(kept.code, Some(0), "{kept:?}");
    assert!(
        kept.stdout
            .ends_with("[[mutants]]\nname = \"other-side\"\ntasks = [\"fk\"]\nsays = \"\"\n"),
        "{kept:?}"
    );
    let path = bed.path("reference/93-height/mutants/other-side.rhai");
    let written = std::fs::read_to_string(&path).expect("the copy");
    assert_eq!(written, SOLUTION.replace("= 0.05;", "= -0.05;"));

    let again = mutate(&bed, &["--keep", "1", "--as", "other-side"]);
    assert_eq!(again.code, Some(2), "{again:?}");
    assert!(
        again
            .stderr
            .contains("is there already, and stays as it is"),
        "{again:?}"
    );
    assert_eq!(std::fs::read_to_string(&path).expect("the copy"), written);
    for (refused, why) in [
        (&["--keep", "9999"][..], "there is no mutation 9999"),
        (
            &["--keep", "1", "--as", "../x"],
            "`../x` is no name of a mutant",
        ),
    ] {
        let ran = mutate(&bed, refused);
        assert_eq!(ran.code, Some(2), "{ran:?}");
        assert!(ran.stderr.contains(why), "{ran:?}");
    }
    let folder = std::fs::read_dir(path.parent().expect("a folder")).expect("a folder");
    assert_eq!(folder.count(), 1);
}

#[test]
fn a_solution_that_loses_points_is_not_changed() {
    let bed = bed();
    bed.edit(
        "reference/93-height/solution.rhai",
        "+ l[0] * cos",
        "- l[0] * cos",
    );
    let ran = mutate(&bed, &[]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(
        ran.stderr
            .contains("the solution loses points in task `fk`"),
        "{ran:?}"
    );
}
