//! `kinemark lab new`: what it writes loads, and `lab check` finds nothing in it but what its TODOs say.

use serde_json::Value as Json;

use crate::schemas;
use crate::testbed::TestBed;

const TASKS: [&str; 8] = [
    "--task",
    "fk",
    "--task",
    "ik",
    "--task",
    "motion:pick",
    "--task",
    "velocity",
];

/// The rows of `lab check` with a problem.
fn problems(bed: &TestBed, lab: &str) -> Vec<(String, String, String)> {
    let ran = bed.run(&["lab", "check", lab, "--json"]);
    assert!(matches!(ran.code, Some(0 | 1)), "{ran:?}");
    let audit: Json = serde_json::from_str(&ran.stdout).expect("JSON");
    let rows = audit["rows"].as_array().expect("rows").iter();
    let text = |value: &Json| value.as_str().unwrap_or_default().to_owned();
    let bad = rows.filter(|row| !row["problem"].is_null());
    bad.map(|row| {
        (
            text(&row["tried"]),
            text(&row["name"]),
            text(&row["problem"]),
        )
    })
    .collect()
}

/// Forward and inverse kinematics of the course's arm.
const KINEMATICS: &str = "
fn forward_kinematics(robot, q) {
    let l = robot.link_lengths;
    [robot.base_height + l[0] * cos(q[0]) + l[1] * cos(q[0] + q[1]),
     l[0] * sin(q[0]) + l[1] * sin(q[0] + q[1]), 2 * robot.link_offset]
}
fn inverse_kinematics(robot, position) {
    let l = robot.link_lengths;
    let u = position[0] - robot.base_height;
    let v = position[1];
    let c = (u * u + v * v - l[0] * l[0] - l[1] * l[1]) / (2 * l[0] * l[1]);
    if abs(c) > 1 { return []; }
    let branches = [];
    for q2 in [acos(c), -acos(c)] {
        branches.push([atan2(v, u) - atan2(l[1] * sin(q2), l[0] + l[1] * cos(q2)), q2]);
    }
    branches
}
";

// long: one lab, from the first command to the last
#[test]
fn a_new_lab_has_no_problem_but_its_todos_and_none_of_those_once_they_are_done() {
    let bed = TestBed::new();
    let ran = bed.run(&[&["lab", "new", "10-first"], &TASKS[..]].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout.contains("kinemark lab check 10-first"),
        "{ran:?}"
    );
    assert!(
        bed.path("labs/robots/rrbot.toml").is_file(),
        "the robot is there"
    );

    // each file begins with the path of its schema, as seen from its folder
    for (folder, file, kind) in [
        ("labs", "lab.toml", "lab"),
        ("reference", "hidden.toml", "hidden"),
        ("reference", "mutants.toml", "mutants"),
    ] {
        let text = bed.path(&format!("{folder}/10-first/{file}"));
        let text = std::fs::read_to_string(text).expect("a file");
        let schema = text
            .lines()
            .next()
            .expect("a line")
            .strip_prefix("#:schema ");
        let schema = bed.path(&format!("{folder}/10-first/{}", schema.expect("a schema")));
        let schema = std::fs::read_to_string(schema).expect("it is there");
        let printed = bed.run(&["lab", "schema", kind]).stdout;
        assert!(schema == printed, "{kind}");
        schemas::is_valid(kind, file, &text);
    }

    // what students begin with runs, and misses
    let ran = bed.run(&[
        "grade",
        "10-first",
        "labs/10-first/starter.rhai",
        "--practice",
    ]);
    assert_eq!(ran.code, Some(1), "{ran:?}");

    let solution =
        std::fs::read_to_string(bed.path("reference/10-first/solution.rhai")).expect("a solution");
    // before the functions are written, the solution stops in them
    let found = problems(&bed, "10-first");
    let (tried, _, problem) = found
        .iter()
        .find(|row| row.0 == "reference")
        .expect("the solution stops");
    assert!(problem.contains("TODO"), "{tried}: {problem}");

    let control = solution.split_once("fn control").expect("a controller").1;
    bed.write(
        "reference/10-first/solution.rhai",
        format!("{KINEMATICS}fn control{control}"),
    );
    let found = problems(&bed, "10-first");
    let kinds: Vec<(&str, &str)> = found
        .iter()
        .map(|row| (row.0.as_str(), row.1.as_str()))
        .collect();
    let todo = ("rubric", "names");
    let (todos, rest): (Vec<_>, Vec<_>) = kinds.into_iter().partition(|kind| *kind == todo);
    assert_eq!(rest, [("mutants", "")], "{found:#?}");
    // the brief, and title and hints of each task and check
    assert!(todos.len() > 5, "{found:#?}");
    for file in ["labs/10-first/lab.toml", "labs/10-first/brief.md"] {
        let text = std::fs::read_to_string(bed.path(file)).expect("a file");
        // hints that are all the same would be another doubt
        let mut parts = text.split("TODO").enumerate();
        let (_, first) = parts.next().expect("a part");
        let rest = parts.map(|(i, part)| format!("Decided {i}{part}"));
        let done: String = std::iter::once(first.to_owned()).chain(rest).collect();
        bed.write(file, done);
    }
    let found = problems(&bed, "10-first");
    assert_eq!(found.len(), 1, "{found:#?}");

    // it is never replaced
    let ran = bed.run(&["lab", "new", "10-first", "--task", "fk"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("already exists"), "{ran:?}");
}

#[test]
fn a_lab_that_is_moved_in_every_way_has_a_solution_from_the_beginning() {
    let bed = TestBed::new();
    let mut args = vec!["lab", "new", "12-moves"];
    for task in ["effort:push", "motion:turn", "velocity:glide"] {
        args.extend(["--task", task]);
    }
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let found = problems(&bed, "12-moves");
    let is_todo = |row: &&(String, String, String)| row.1 == "names" || row.0 == "mutants";
    let rest: Vec<_> = found.iter().filter(|row| !is_todo(row)).collect();
    assert!(rest.is_empty(), "{rest:#?}");

    let ran = bed.run(&["lab", "new", "13-moves", "--task", "function:mass-matrix"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    let words = "a function of the lab's own cannot be called `mass_matrix`";
    assert!(ran.stderr.contains(words), "{ran:?}");
}

/// Two links that turn, a lift, and a hand that turns about the vertical.
const SCARA: &str = r#"
format = 1
name = "scara"

[dh]
convention = "standard"

[[dh.rows]]
joint = "shoulder"
type = "revolute"
d_m = 0.4
a_m = 0.25
limit = { lower = -2.3, upper = 2.3 }

[[dh.rows]]
joint = "elbow"
type = "revolute"
a_m = 0.2
limit = { lower = -2.5, upper = 2.5 }

[[dh.rows]]
joint = "lift"
type = "prismatic"
alpha_deg = 180
limit = { lower = -0.2, upper = 0 }

[[dh.rows]]
joint = "hand"
type = "revolute"
limit = { lower = -3.1, upper = 3.1 }
"#;

/// Once its two functions of poses are there, the solution moves to places by the inverse kinematics of a task, too.
#[test]
fn a_lab_of_places_and_poses_has_no_problem_but_its_todos() {
    let bed = TestBed::new();
    bed.copy_labs();
    let mut args = vec!["lab", "new", "14-places"];
    for task in ["fk", "ik", "fk-pose", "goals:pick-up"] {
        args.extend(["--task", task]);
    }
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let path = "reference/14-places/solution.rhai";
    let solution = std::fs::read_to_string(bed.path(path)).expect("a solution");
    let init = solution
        .split_once("fn init")
        .expect("it keeps the robot")
        .1;
    let init = init.split_once("fn forward").expect("a function").0;
    let control = solution.split_once("fn control").expect("a controller").1;
    let pose = "
fn pose_of_tcp(robot, q) {
    let p = forward_kinematics(robot, q);
    let a = q[0] + q[1];
    // at zero the TCP's z is up, which is x of the lab
    [[-sin(a), 0, cos(a), p[0]], [cos(a), 0, sin(a), p[1]], [0, 1, 0, p[2]], [0, 0, 0, 1]]
}
";
    bed.write(
        path,
        format!("{KINEMATICS}{pose}fn init{init}fn control{control}"),
    );
    let found = problems(&bed, "14-places");
    let is_todo = |row: &&(String, String, String)| row.1 == "names" || row.0 == "mutants";
    let rest: Vec<_> = found.iter().filter(|row| !is_todo(row)).collect();
    assert!(rest.is_empty(), "{rest:#?}");
}

/// Six joints choose a whole pose, and the two of the course's arm none beside the place.
#[test]
fn poses_are_asked_for_as_far_as_the_robot_can_choose_them() {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write("labs/robots/scara.toml", SCARA);
    for (robot, form, key) in [
        ("puma560", "full", "rpy_deg = ["),
        ("scara", "yaw", "yaw_deg = "),
    ] {
        let name = format!("15-{robot}");
        let ran = bed.run(&["lab", "new", &name, "--robot", robot, "--task", "ik-pose"]);
        assert_eq!(ran.code, Some(0), "{ran:?}");
        let lab = bed.path(&format!("labs/{name}/lab.toml"));
        let lab = std::fs::read_to_string(lab).expect("a file");
        assert!(lab.contains(&format!("pose = \"{form}\"")), "{lab}");
        assert!(lab.contains(key), "{lab}");
        // no doubt about what is reached, and in how many branches
        let found = problems(&bed, &name);
        let of_reach = |row: &&(String, String, String)| row.1 == "branches" || row.1 == "reach";
        assert_eq!(found.iter().find(of_reach), None);
    }
    let ran = bed.run(&["lab", "new", "16-rr", "--task", "ik-pose"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    let words = "robot `rrbot` has too few joints for task `ik-pose`";
    assert!(ran.stderr.contains(words), "{ran:?}");
    assert!(!bed.path("labs/16-rr").exists());
}

#[test]
fn a_lab_can_be_begun_with_every_robot_of_the_course() {
    let bed = TestBed::new();
    bed.copy_labs();
    for (robot, tasks) in [
        ("puma560", &["fk", "ik", "jacobian"][..]),
        ("rppr", &["fk", "motion"]),
        ("rppr_gripper", &["fk", "velocity"]),
        ("uarm", &["function:gear-ratio"]),
        // a row of joints needs no file
        (
            "RzTxRy",
            &[
                "fk",
                "jacobian",
                "motion",
                "tcp-velocity",
                "tcp-acceleration",
                "gravity",
                "coriolis",
                "torque",
                "mass-matrix",
            ],
        ),
    ] {
        let name = format!("11-{}", robot.to_lowercase().replace('_', "-"));
        let mut args = vec!["lab", "new", &name, "--robot", robot];
        args.extend(tasks.iter().flat_map(|task| ["--task", task]));
        let ran = bed.run(&args);
        assert_eq!(ran.code, Some(0), "{robot}: {ran:?}");
        let ran = bed.run(&[
            "grade",
            &name,
            &format!("labs/{name}/starter.rhai"),
            "--practice",
        ]);
        assert_eq!(ran.code, Some(1), "{robot}: {ran:?}");
    }
}

/// What the course staff would have to decide is left, and what follows from the solution is written; else it is a lab without problems.
#[test]
fn a_copy_of_a_lab_has_its_own_numbers_and_no_problem_once_it_is_filled() {
    let bed = TestBed::new();
    bed.copy_labs();
    let salt = "a long salt of a test";
    let copy = ["lab", "new", "10-reach", "--from", "01-kin"];
    let ran = bed.run(&[&copy[..], &["--salt", salt]].concat());
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(ran.stdout.contains("kinemark lab fill 10-reach"), "{ran:?}");
    let of = |lab: &str| {
        let table: toml::Table = bed_text(&bed, &format!("labs/{lab}/lab.toml"));
        table["parameters"].clone()
    };
    assert_ne!(of("10-reach"), of("01-kinematics"));
    let hidden = bed_text(&bed, "reference/10-reach/hidden.toml");
    assert_eq!(hidden["salt"].as_str(), Some(salt));
    let ran = bed.run(&["lab", "fill", "10-reach"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    // but for a mutant that was made for the numbers of before: it types angles in, and shows other checks no more
    let todo = "brief: it still says TODO";
    let found = problems(&bed, "10-reach");
    assert!(
        found.iter().any(|(.., problem)| problem == todo),
        "{found:?}"
    );
    for (tried, name, problem) in found.into_iter().filter(|(.., problem)| problem != todo) {
        assert_eq!(
            (tried.as_str(), name.as_str()),
            ("rubric", "dead"),
            "{problem}"
        );
        assert!(problem.starts_with("move/"), "{problem}");
    }

    // a copy under the same numbers has the same places
    let ran = bed.run(&[
        "lab",
        "new",
        "11-reach",
        "--from",
        "01-kin",
        "--same-numbers",
    ]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert_eq!(of("11-reach"), of("01-kinematics"));
    // with a robot that lacks what the lab needs, the file says so at its place
    let ran = bed.run(&[
        "lab", "new", "12-puma", "--from", "01-kin", "--robot", "puma560",
    ]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let ran = bed.run(&["lab", "check", "12-puma"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(ran.stderr.contains("12-puma/lab.toml:"), "{ran:?}");
}

fn bed_text(bed: &TestBed, path: &str) -> toml::Table {
    let text = std::fs::read_to_string(bed.path(path)).expect("a file");
    text.parse().expect("TOML")
}

/// A second lab, in a folder whose robots are the own ones.
#[test]
fn a_robot_that_is_built_in_is_copied_to_the_labs_that_are_there() {
    let bed = TestBed::new();
    bed.write("labs/robots/scara.toml", SCARA);
    for (args, words) in [
        (
            &["17-rr", "--task", "motion:turn"][..],
            "labs/robots/rrbot.toml",
        ),
        (
            &["18-scara", "--robot", "scara.toml", "--task", "fk"],
            "labs/18-scara/lab.toml",
        ),
    ] {
        let ran = bed.run(&[&["lab", "new"], args].concat());
        assert_eq!(ran.code, Some(0), "{ran:?}");
        assert!(ran.stdout.contains(words), "{ran:?}");
    }
    let ran = bed.run(&["lab", "new", "19-none", "--robot", "scar", "--task", "fk"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("did you mean `scara`?"), "{ran:?}");
    // the other one is there now, and is not written again
    let ran = bed.run(&["lab", "new", "20-rr", "--task", "fk"]);
    assert!(!ran.stdout.contains("robots/rrbot.toml"), "{ran:?}");
}

#[test]
fn what_cannot_be_begun_is_refused_and_nothing_is_written() {
    let bed = TestBed::new();
    bed.copy_labs();
    for (args, words) in [
        (
            &["lab", "new", "My Lab", "--task", "fk"][..],
            "lower-case letters",
        ),
        (
            &["lab", "new", "12-x", "--task", "fks"],
            "did you mean `fk`?",
        ),
        (
            &["lab", "new", "12-x", "--task", "fk", "--task", "fk"],
            "--task fk:fk-2",
        ),
        (
            &["lab", "new", "12-x", "--task", "function:2nd"],
            "begin its name with a letter",
        ),
        (
            &["lab", "new", "12-x", "--robot", "rrbott", "--task", "fk"],
            "did you mean `rrbot`?",
        ),
        (
            &["lab", "new", "12-x", "--robot", "uarm", "--task", "fk"],
            "closed loops",
        ),
        (&["lab", "new", "12-x"], "--task"),
        (
            &[
                "lab",
                "new",
                "12-x",
                "--from",
                "01-kinematic",
                "--task",
                "fk",
            ],
            "--task",
        ),
        (
            &[
                "lab",
                "new",
                "12-x",
                "--from",
                "01-kinematics",
                "--robot",
                "rrbott",
            ],
            "did you mean `rrbot`?",
        ),
        (
            &["lab", "new", "12-x", "--task", "fk", "--same-numbers"],
            "--from",
        ),
        (
            &[
                "lab",
                "new",
                "12-x",
                "--from",
                "01-kinematics",
                "--reference",
                "labs",
            ],
            "course staff's part of `01-kinematics`",
        ),
    ] {
        let ran = bed.run(args);
        assert_eq!(ran.code, Some(2), "{args:?}: {ran:?}");
        let shown = ran.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(shown.contains(words), "{args:?}: {shown}");
    }
    assert!(!bed.path("labs/12-x").exists() && !bed.path("reference/12-x").exists());
}
