//! A task of `jacobian`: what earns its points, what its evidence says, and which labs are refused.

use kinemark_grader::record::grade::{Grade, Outcome, TaskGrade};
use kinemark_grader::record::verdict::Verdict;
use kinemark_report::text::text;

use crate::own_lab::OwnLab;
use crate::testbed::grade;

const LAB: &str = r#"
format = 1
name = "92-jacobian"
title = "How fast is the hand?"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "jacobian"
title = "The Jacobian"

[tasks.function]
call = "jacobian"
rows = ["x", "y"]
cases = [
    { name = "elbow a quarter turn", q_rad = [0.0, 1.5707963267948966] },
    { name = "both bent", q_rad = [0.7, -1.1] },
    { name = "short upper arm", q_rad = [0.5, 0.9], dimensions = { link_lengths = [0.7, 1.2] } },
]

[[tasks.checks]]
name = "match"
title = "The Jacobian is right"
points = 4.0
jacobian-match = { full = 1e-4, zero = 1e-2 }
"#;

const HIDDEN: &str = r#"
format = 1
salt = "salt"

[[draws]]
task = "jacobian"
class = "unequal links"
count = 10
q_rad = [[-3.14, 3.14], [-3.14, 3.14]]
dimensions = { link_lengths = [[0.6, 0.95], [1.05, 1.4]] }
"#;

const MUTANTS: &str = r#"
format = 1

[[mutants]]
name = "elbow-by-shoulder"
tasks = ["jacobian"]
says = "Column 2 is the derivative by q1."

[[mutants]]
name = "absolute-elbow"
tasks = ["jacobian"]
says = "Column 1 leaves the forearm out."
"#;

const SOLUTION: &str = "fn jacobian(robot, q) {
    let l = robot.link_lengths;
    let a = q[0];
    let b = q[0] + q[1];
    [[-l[0] * sin(a) - l[1] * sin(b), -l[1] * sin(b)], [l[0] * cos(a) + l[1] * cos(b), l[1] * cos(b)]]
}";

/// The solution with its first column in place of its second.
const ELBOW_BY_SHOULDER: &str = "fn jacobian(robot, q) {
    let l = robot.link_lengths;
    let x = -l[0] * sin(q[0]) - l[1] * sin(q[0] + q[1]);
    let y = l[0] * cos(q[0]) + l[1] * cos(q[0] + q[1]);
    matrix([[x, x], [y, y]])
}";

const ABSOLUTE_ELBOW: &str = "fn jacobian(robot, q) {
    let l = robot.link_lengths;
    [[-l[0] * sin(q[0]), -l[1] * sin(q[0] + q[1])], [l[0] * cos(q[0]), l[1] * cos(q[0] + q[1])]]
}";

fn own_lab() -> OwnLab {
    OwnLab::new("92-jacobian", LAB)
        .and("hidden.toml", HIDDEN)
        .and("mutants.toml", MUTANTS)
        .and("solution.rhai", SOLUTION)
        .and("mutants/elbow-by-shoulder.rhai", ELBOW_BY_SHOULDER)
        .and("mutants/absolute-elbow.rhai", ABSOLUTE_ELBOW)
}

fn graded(submission: &str) -> Grade {
    let own = own_lab();
    let lab = own.lab();
    let staff = own.staff(&lab);
    grade(&lab, staff.as_ref(), "mine.rhai", submission).grade
}

fn evidence(task: &TaskGrade) -> Vec<&str> {
    let evidence = task.checks[0].evidence.iter();
    evidence.map(|piece| piece.message.as_str()).collect()
}

#[test]
fn a_right_jacobian_earns_everything_as_a_matrix_or_as_rows() {
    let as_matrix = SOLUTION
        .replace("    [[", "    matrix([[")
        .replace("]]\n", "]])\n");
    assert!(as_matrix.contains("matrix"));
    for submission in [SOLUTION, &as_matrix] {
        let grade = graded(submission);
        assert_eq!(grade.verdict, Verdict::Passed, "{}", text(&grade));
        assert_eq!(grade.points, 4.0);
        let case = &grade.tasks[0].cases[0];
        assert_eq!(case.given, "q = [0, 1.5708] rad");
        assert_eq!(case.expected.as_deref(), Some("[[-1, -1], [1, 0]]"));
        assert!(case.good && case.relative_error.is_some_and(|error| error < 1e-12));
        assert_eq!(grade.tasks[0].hidden[0].good, 10);
    }
}

#[test]
fn a_wrong_column_is_reported_and_a_mutant_named() {
    let grade = graded(ELBOW_BY_SHOULDER);
    let task = &grade.tasks[0];
    assert_eq!((task.verdict, task.points), (Verdict::Missed, 0.0));
    let mistakes: Vec<&str> = task.diagnoses.iter().map(|d| d.mistake.as_str()).collect();
    assert_eq!(mistakes, ["elbow-by-shoulder"]);
    let evidence = evidence(task);
    assert!(
        evidence.contains(&"10 of 10 hidden cases of the class \"unequal links\" are off"),
        "{evidence:?}"
    );
    // (-1, 1) instead of (-1, 0): 1 of a norm of √3
    assert!(
        evidence.contains(
            &"elbow a quarter turn: 57.7 % off: column 2 (elbow): d y / d q2 is 1, should be 0"
        ),
        "{evidence:?}"
    );

    let grade = graded(ABSOLUTE_ELBOW);
    let mistakes: Vec<&str> = grade.tasks[0]
        .diagnoses
        .iter()
        .map(|d| d.mistake.as_str())
        .collect();
    assert_eq!(mistakes, ["absolute-elbow"]);
}

#[test]
fn an_error_within_the_band_earns_a_part() {
    // every entry half a per cent too large: a relative error of 0.005 in every case
    let submission = SOLUTION.replace("fn jacobian", "fn right")
        + "\nfn jacobian(robot, q) { matrix(right(robot, q)) * 1.005 }";
    let grade = graded(&submission);
    let check = &grade.tasks[0].checks[0];
    assert_eq!(check.outcome, Outcome::Partial, "{}", text(&grade));
    // 2.0202, cut to whole hundredths
    let expected = (100.0 * 4.0 * (0.01 - 0.005) / (0.01 - 1e-4_f64)).floor() / 100.0;
    assert!((check.points - expected).abs() <= 1e-9, "{}", check.points);
    let measure = check.measure.as_ref().expect("a measure");
    assert!(
        measure
            .value
            .is_some_and(|value| (value - 0.005).abs() <= 1e-12)
    );
}

#[test]
fn what_is_no_matrix_of_the_right_shape_is_reported_and_nan_earns_nothing() {
    for (body, message) in [
        (
            "zeros(3, 2)",
            "jacobian returned 3 x 2 numbers [[0, 0], [0, 0], [0, 0]], expected 2 x 2 numbers (rows x columns)",
        ),
        (
            "q",
            "jacobian returned [0, 1.570796], expected 2 x 2 numbers (rows x columns)",
        ),
        (
            "[[0 / 0, 1], [0, 1]]",
            "jacobian returned [[NaN, 1], [0, 1]], expected finite numbers",
        ),
    ] {
        let grade = graded(&format!("fn jacobian(robot, q) {{ {body} }}"));
        let task = &grade.tasks[0];
        assert_eq!(task.verdict, Verdict::InvalidOutput, "{}", text(&grade));
        let stopped = task.stopped.as_ref().expect("a reason");
        assert_eq!(stopped.message, message);
        assert_eq!(task.points, 0.0);
        assert_eq!(task.cases[0].relative_error, None);
    }
    // one answer that is none costs the check
    let once = SOLUTION.replace("fn jacobian", "fn right")
        + "\nfn jacobian(robot, q) { if robot.link_lengths[0] == 0.7 { 0 / 0 } else { right(robot, q) } }";
    let grade = graded(&once);
    assert_eq!(grade.points, 0.0, "{}", text(&grade));
    let grade = graded("fn jacobean(robot, q) { q }");
    let stopped = grade.tasks[0].stopped.as_ref().expect("a reason");
    assert_eq!(
        stopped.help.as_deref(),
        Some("rename `jacobean` to `jacobian`")
    );
}

#[test]
fn labs_that_ask_for_no_such_jacobian_are_refused() {
    for (from, to, message) in [
        (
            r#"rows = ["x", "y"]"#,
            r#"rows = ["y", "x"]"#,
            "`rows` names some of x, y, z, rx, ry, rz, each once and in this order",
        ),
        (
            r#"call = "jacobian""#,
            r#"call = "forward_kinematics""#,
            "`forward_kinematics` has no `rows`",
        ),
        (
            "q_rad = [0.7, -1.1]",
            "position_m = [1.0, 0.0, 0.0]",
            "case `both bent` of `jacobian` is given by `q_rad`",
        ),
        (
            "jacobian-match = { full = 1e-4, zero = 1e-2 }",
            "fk-error = { full_m = 1e-4, zero_m = 1e-2 }",
            "check `match` of kind `fk-error` needs a function task of `forward_kinematics`",
        ),
        (
            "zero = 1e-2",
            "zero = 1e-5",
            "a band needs `full` at or below `zero`, got 0.0001 and 0.00001",
        ),
    ] {
        match own_lab().with("lab.toml", from, to).load() {
            Ok(_) => panic!("{to} is accepted"),
            Err(error) => assert_eq!(error.to_string(), message),
        }
    }
}

#[test]
fn without_rows_the_three_linear_ones_are_asked_for() {
    let lab = own_lab()
        .with("lab.toml", "rows = [\"x\", \"y\"]\n", "")
        .lab();
    let with_z = SOLUTION.replace("]]\n", "], [0, 0]]\n");
    let run = grade(&lab, None, "mine.rhai", &with_z);
    assert_eq!(run.grade.verdict, Verdict::Passed, "{}", text(&run.grade));
}
