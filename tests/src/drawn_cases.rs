//! Cases of functions as a page draws them: the arm and the answer where they are, entries right or wrong.

use kinemark_grader::record::shown_case::{BranchCount, ComparedNumber, ShownCase, ShownCases};

use crate::testbed::{grade, lab};

/// The drawn cases of a task.
fn drawn(lab_name: &str, task: &str, source: &str) -> ShownCases {
    let graded = grade(&lab(lab_name), None, "mine.rhai", source);
    let mut shown = graded.cases.into_iter();
    shown.find(|shown| shown.task == task).expect("the task")
}

fn case<'s>(shown: &'s ShownCases, name: &str) -> &'s ShownCase {
    let mut cases = shown.cases.iter();
    cases.find(|case| case.name == name).expect("the case")
}

fn near(points: &[[f64; 3]], expected: &[[f64; 3]]) {
    assert_eq!(points.len(), expected.len(), "{points:?}");
    let pairs = points.iter().flatten().zip(expected.iter().flatten());
    for (number, expected) in pairs {
        assert!((number - expected).abs() < 1e-9, "{points:?}");
    }
}

#[test]
fn forward_kinematics_has_the_arm_the_tcp_and_the_answer() {
    let absolute = "fn forward_kinematics(robot, q) {
        [2.0 + cos(q[0]) + cos(q[1]), sin(q[0]) + sin(q[1]), 0.05]
    }";
    let shown = drawn("01-kinematics", "fk", absolute);
    assert_eq!(shown.seen_from, "lab");
    // what is wrong comes first
    let first_good = shown.cases.iter().position(|case| case.is_good);
    let from_there = first_good.map_or(&[][..], |at| &shown.cases[at..]);
    assert!(!shown.cases[0].is_good && from_there.iter().all(|case| case.is_good));
    // x is up: the post ends at 2 m, each link is 1 m long, and lies beside the one before
    let turned = case(&shown, "shoulder a quarter turn");
    let places = turned.places.as_ref().expect("places");
    near(
        &places.arm_m,
        &[[2.0, 0.0, 0.025], [2.0, 1.0, 0.05], [2.0, 2.0, 0.05]],
    );
    near(&[places.right_m], &[[2.0, 2.0, 0.05]]);
    assert_eq!(places.upward.map(|x| x.round()), [1.0, 0.0, 0.0]);
    let [answered] = places.answered.as_slice() else {
        panic!("{places:?}")
    };
    // cos 90° + cos 0°, sin 90° + sin 0°
    near(&[answered.tcp_m], &[[3.0, 1.0, 0.05]]);
    assert!(!answered.is_right && answered.arm_m.is_empty());
}

#[test]
fn inverse_kinematics_has_the_arm_at_every_answered_branch() {
    // one branch of the elbow, and the straight arm beside it
    let mixed = "fn inverse_kinematics(robot, position) {
        let x = position[0] - 2.0;
        let y = position[1];
        let c = (x * x + y * y - 2.0) / 2.0;
        if c > 1.0 || c < -1.0 { return []; }
        let elbow = acos(c);
        let shoulder = atan2(y, x) - atan2(sin(elbow), 1.0 + cos(elbow));
        [[shoulder, elbow], [0.0, 0.0]]
    }";
    let shown = drawn("01-kinematics", "ik", mixed);
    let case = case(&shown, "to the right");
    let places = case.places.as_ref().expect("places");
    assert_eq!(places.branches, Some(BranchCount { found: 1, all: 2 }));
    assert!(places.arm_m.is_empty());
    let right: Vec<bool> = places.answered.iter().map(|place| place.is_right).collect();
    assert_eq!(right, [true, false]);
    near(&[places.answered[0].tcp_m], &[places.right_m]);
    near(
        &places.answered[1].arm_m,
        &[[2.0, 0.0, 0.025], [3.0, 0.0, 0.05], [4.0, 0.0, 0.05]],
    );
}

#[test]
fn a_branch_that_is_answered_twice_counts_once() {
    // the elbow on one side, once more a full turn away
    let twice = "fn inverse_kinematics(robot, position) {
        let x = position[0] - 2.0;
        let y = position[1];
        let c = (x * x + y * y - 2.0) / 2.0;
        if c > 1.0 || c < -1.0 { return []; }
        let elbow = acos(c);
        let shoulder = atan2(y, x) - atan2(sin(elbow), 1.0 + cos(elbow));
        [[shoulder, elbow], [shoulder + 2.0 * PI, elbow]]
    }";
    let bed = crate::testbed::TestBed::new();
    bed.write("mine.rhai", twice);
    let ran = bed.run(&["grade", "01-kinematics", "mine.rhai", "--practice"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let page = std::fs::read_to_string(bed.path("out/report.html")).expect("a page");
    assert!(page.contains("1 of 2 branches"), "one is missing");
    assert!(!page.contains("2 of 2 branches"));
    let shown = drawn("01-kinematics", "ik", twice);
    let places = case(&shown, "to the right")
        .places
        .as_ref()
        .expect("places");
    assert!(places.answered.len() == 2 && places.answered.iter().all(|place| place.is_right));
    assert_eq!(places.branches, Some(BranchCount { found: 1, all: 2 }));
    let beyond = shown.cases.iter().filter_map(|case| case.places.as_ref());
    let beyond: Vec<_> = beyond.filter(|places| places.is_out_of_reach()).collect();
    assert!(
        !beyond.is_empty(),
        "lab 1 has a target that nothing reaches"
    );
    assert!(page.contains("target out of reach") && page.contains("nothing reaches ("));
}

#[test]
fn entries_are_marked_one_by_one() {
    let one_sign = "fn jacobian(robot, q) {
        let a = q[0];
        let b = q[0] + q[1];
        [[-sin(a) - sin(b), -sin(b)], [cos(a) + cos(b), -cos(b)]]
    }";
    let shown = drawn("02-jacobian-velocity", "jacobian", one_sign);
    let bent = case(&shown, "both bent");
    assert!(bent.places.is_none());
    let [numbers] = bent.numbers.as_slice() else {
        panic!("{bent:?}")
    };
    assert_eq!(numbers.columns, 2);
    let right: Vec<bool> = numbers
        .numbers
        .iter()
        .map(|number| number.is_right)
        .collect();
    assert_eq!(right, [true, true, true, false]);
    let ComparedNumber {
        answered, right, ..
    } = numbers.numbers[3];
    assert!((answered + right).abs() < 1e-12 && right.abs() > 0.1);
    // nothing of a case that is good is written out
    assert!(
        shown
            .cases
            .iter()
            .all(|case| case.is_good == case.numbers.is_empty())
    );
}

#[test]
fn the_page_draws_them_and_says_them() {
    let absolute = "fn forward_kinematics(robot, q) {
        [2.0 + cos(q[0]) + cos(q[1]), sin(q[0]) + sin(q[1]), 0.05]
    }";
    let bed = crate::testbed::TestBed::new();
    bed.write("mine.rhai", absolute);
    let ran = bed.run(&["grade", "01-kinematics", "mine.rhai", "--practice"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let page = std::fs::read_to_string(bed.path("out/report.html")).expect("a page");
    assert!(page.contains("<ul class=\"sketches\">"));
    assert!(page.contains(
        "shoulder a quarter turn: the TCP is at (2, 2, 0.05) m, the answer says (3, 1, 0.05) m"
    ));
}
