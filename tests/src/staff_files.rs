//! Broken submissions of the course staff: the person who grades gets file and line, and students lose no points.

use crate::testbed::{OWN_LABS, TestBed};

const GRADE: [&str; 3] = ["grade", "01-kinematics", "submission.rhai"];
const SOLUTION: &str = "reference/01-kinematics/solution.rhai";
const MUTANT: &str = "reference/01-kinematics/mutants/degrees.rhai";

#[test]
fn what_is_no_program_ends_a_grade_and_a_check_at_its_line() {
    for (file, code, line) in [
        (SOLUTION, "staff::solution", 6),
        (MUTANT, "staff::mutant", 1),
    ] {
        let bed = TestBed::a_little_off();
        let text = std::fs::read_to_string(bed.path(file)).expect("file");
        let found = text
            .lines()
            .position(|line| line.starts_with("fn forward_kinematics"));
        let number = found.expect("the function") + 1;
        assert!(number >= line);
        bed.edit(file, "fn forward_kinematics", "fnn forward_kinematics");
        for args in [&GRADE[..], &["lab", "check", "01-kinematics"]] {
            let ran = bed.run(args);
            assert_eq!(ran.code, Some(3), "{ran:?}");
            let place = format!("{file}:{number}:5]");
            for part in [code, place.as_str(), "did you mean `fn`?"] {
                assert!(ran.stderr.contains(part), "{part}: {}", ran.stderr);
            }
            assert!(!ran.stdout.contains("widen the band"), "{ran:?}");
        }
        assert!(!bed.path("out").exists());
    }
}

#[test]
fn what_stops_in_a_run_is_a_warning_and_the_points_stand() {
    let bed = TestBed::a_little_off();
    // bands of numbers alone: others need the solution
    for (from, to) in [
        (
            "full_s = \"= reference + 1.2\", zero_s = \"= reference + 3.2\"",
            "full_s = 6.0, zero_s = 8.0",
        ),
        (
            "full = \"= reference + 0.3\", zero = \"= reference + 0.6\"",
            "full = 0.5, zero = 1.0",
        ),
    ] {
        bed.edit("labs/01-kinematics/lab.toml", from, to);
    }
    let before = bed.run(&GRADE);
    assert!(before.stdout.contains("first differs"), "{before:?}");
    assert_eq!(before.stderr, OWN_LABS, "{before:?}");
    bed.edit(SOLUTION, "robot.base_height;", "robot.base_hieght;");
    let ran = bed.run(&GRADE);
    assert_eq!(ran.code, before.code, "{ran:?}");
    let points = |text: &str| {
        let line = text.lines().find(|line| line.ends_with(" points"));
        line.map(str::to_owned)
    };
    assert_eq!(points(&ran.stdout), points(&before.stdout));
    for part in [
        "warning: the grade is valid, but a file of the course staff failed",
        "the reference solution stops in task `move`",
        "`base_hieght`",
        &format!("{SOLUTION}:16:"),
        "╰── here",
    ] {
        assert!(ran.stderr.contains(part), "{part}: {}", ran.stderr);
    }
}

#[test]
fn a_solution_that_stops_where_a_band_needs_it_decides_nothing() {
    let bed = TestBed::a_little_off();
    bed.edit(SOLUTION, "robot.base_height;", "robot.base_hieght;");
    let ran = bed.run(&GRADE);
    assert_eq!(ran.code, Some(4), "{ran:?}");
    let words = "the reference solution does not reach the end";
    assert!(ran.stdout.contains(words), "{ran:?}");
    for part in [
        "nothing is decided in some task, because a file of the course staff failed",
        "`base_hieght`",
        &format!("{SOLUTION}:16:"),
    ] {
        assert!(ran.stderr.contains(part), "{part}: {}", ran.stderr);
    }
}

/// `lab check` with nothing at random.
const CHECK: [&str; 7] = [
    "lab",
    "check",
    "01-kinematics",
    "--salts",
    "0",
    "--variants",
    "0",
];

#[test]
fn a_check_shows_where_the_solution_stops() {
    let bed = TestBed::a_little_off();
    bed.edit(SOLUTION, "robot.base_height;", "robot.base_hieght;");
    let ran = bed.run(&CHECK);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains(&format!("{SOLUTION}:16:")),
        "{}",
        ran.stdout
    );
    assert!(ran.stdout.contains("mend the solution"), "{}", ran.stdout);
    assert!(!ran.stdout.contains("widen the band"), "{}", ran.stdout);
}

#[test]
fn a_check_names_the_hidden_class_that_may_be_wrong() {
    let bed = TestBed::a_little_off();
    bed.edit(
        "reference/01-kinematics/hidden.toml",
        "branches = 0",
        "branches = 2",
    );
    let ran = bed.run(&CHECK);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let shown = ran.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    let part = "the class \"out of reach\" in hidden.toml, a visible case in lab.toml, the band, or the solution";
    assert!(shown.contains(part), "{shown}");
}
