//! `grants`: the functions of Kinemark's own model that a task grants to a submission, and which labs may not grant any.

use kinemark_grader::lab::Lab;
use kinemark_grader::record::grade::Grade;
use kinemark_grader::record::verdict::Verdict;
use kinemark_report::text::text;

use crate::own_lab::OwnLab;
use crate::testbed::grade;

const LAB: &str = r#"
format = 1
name = "94-grants"
title = "What is lent"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "jacobian"
title = "The Jacobian from positions"

[tasks.function]
call = "jacobian"
rows = ["x", "y"]
grants = ["fk"]
cases = [
    { name = "both bent", q_rad = [0.7, -1.1] },
    { name = "short upper arm", q_rad = [0.5, 0.9], dimensions = { link_lengths = [0.7, 1.2] } },
    { name = "both bent again", q_rad = [0.7, -1.1] },
]

[[tasks.checks]]
name = "match"
title = "The Jacobian is right"
points = 4.0
jacobian-match = { full = 1e-6, zero = 1e-2 }

[[tasks]]
name = "hold"
title = "Hold against gravity"

[tasks.motion]
mode = "effort"
duration_s = 1.0
start_rad = [0.5, 0.7]
grants = ["fk", "jacobian", "gravity", "mass_matrix"]

[[tasks.checks]]
name = "held"
title = "It stays"
points = 2.0
joint-reached = { joint = "elbow", position_rad = 0.7, hold_s = 0.5, full_rad = 1e-6, zero_rad = 0.1 }
"#;

/// Central differences and gravity compensation; the granted functions are compared with the formulas of the arm.
const SUBMISSION: &str = r#"
fn jacobian(robot, q) {
    let h = 1e-5;
    let j = zeros(2, 2);
    for i in 0..2 {
        let step = zeros(2);
        step[i] = h;
        let d = (robot.fk(q + step) - robot.fk(q - step)) / (2 * h);
        j[0][i] = d.x;
        j[1][i] = d.y;
    }
    j
}

fn init(robot, task) {
    this.robot = robot;
}

fn same(name, a, b) {
    if !(norm(a - b) < 1e-9) {
        throw name + " is " + a + ", should be " + b;
    }
}

fn control(observation) {
    let q = observation.q;
    let robot = this.robot;
    let a = q[0];
    let b = q[0] + q[1];
    same("fk", robot.fk(q), observation.tcp);
    same("fk", this.robot.fk([a, q[1]]), [2 + cos(a) + cos(b), sin(a) + sin(b), 0.05]);
    let j = robot.jacobian(q);
    same("x", j[0], [-sin(a) - sin(b), -sin(b)]);
    same("y", j[1], [cos(a) + cos(b), cos(b)]);
    same("z", j[2], [0, 0]);
    let g = robot.gravity(q);
    same("gravity", g, [-9.81 * (0.75 * sin(a) + 0.25 * sin(b)), -9.81 * 0.25 * sin(b)]);
    let m = robot.mass_matrix(q);
    // a rod of 0.5 kg and 1 m, 0.05 m thick
    let i = 0.5 * (1 + 0.0025) / 12;
    same("m22", m[1], [0.125 + 0.25 * cos(q[1]) + i, 0.125 + i]);
    same("m11", m[0], [0.125 + 0.5 + 0.125 + 0.5 * cos(q[1]) + 2 * i, m[1][0]]);
    g
}
"#;

fn own_lab() -> OwnLab {
    OwnLab::new("94-grants", LAB)
}

fn graded(lab: &Lab, submission: &str) -> Grade {
    grade(lab, None, "mine.rhai", submission).grade
}

#[test]
fn what_is_granted_is_the_robot_of_the_task_and_of_each_case() {
    let grade = graded(&own_lab().lab(), SUBMISSION);
    assert_eq!(grade.verdict, Verdict::Passed, "{}", text(&grade));
    assert_eq!(grade.points, 6.0);
}

#[test]
fn a_worker_gives_the_same_grade_as_this_process() {
    let lab = own_lab();
    let theirs = lab.record(SUBMISSION, 0);
    let theirs: Grade = serde_json::from_value(theirs).expect("a grade");
    assert_eq!(theirs, graded(&lab.lab(), SUBMISSION));
}

#[test]
fn a_call_is_charged_by_the_joints() {
    let lab = own_lab().lab();
    let operations = |calls: &str| {
        let submission = format!(
            "fn jacobian(robot, q) {{ [[0, 0], [0, 0]] }}\nfn init(robot, task) {{ this.robot = robot; }}\nfn control(o) {{ let q = o.q; let r = this.robot; {calls} [0, 0] }}"
        );
        graded(&lab, &submission).tasks[1].operations
    };
    let [none, fk, jacobian, gravity, mass_matrix] = [
        "0;",
        "r.fk(q);",
        "r.jacobian(q);",
        "r.gravity(q);",
        "r.mass_matrix(q);",
    ]
    .map(operations);
    let calls = 100; // 1 s at 10 ms
    // a step of the script besides
    for (with, cost) in [(fk, 20), (jacobian, 40), (gravity, 40), (mass_matrix, 40)] {
        let each = (with - none) / calls;
        assert!((cost..cost + 8).contains(&each), "{each} for {cost}");
    }
    // a loop without end ends
    let endless = SUBMISSION.replace("let g =", "loop { robot.mass_matrix(q); } let g =");
    let grade = graded(&lab, &endless);
    assert_eq!(
        grade.tasks[1].verdict,
        Verdict::OverBudget,
        "{}",
        text(&grade)
    );
}

#[test]
fn what_is_not_granted_or_asked_wrongly_is_refused_with_help() {
    let lab = own_lab().lab();
    for (body, message, help) in [
        (
            "robot.gravity(q)",
            "`robot.gravity` is not granted in this task",
            Some(
                "write it yourself: the dimensions are in `robot`; if this line is for another task, `observation.task` is compared with another name",
            ),
        ),
        (
            "robot.jacobian(q)",
            "`robot.jacobian` is not granted in this task",
            Some("call your own: jacobian(robot, q), and do not ask `robot` inside it"),
        ),
        (
            "robot.fk([1, 2, 3])",
            "`robot.fk` takes 2 positions, one per joint, got 3",
            Some("write robot.fk(observation.q)"),
        ),
        (
            "robot.fk(\"up\")",
            "`robot.fk` takes one position per joint, got the string \"up\"",
            None,
        ),
        (
            "#{}.fk(q)",
            "`fk` is a function of the robot, got a map",
            Some("write robot.fk(q)"),
        ),
    ] {
        let grade = graded(&lab, &format!("fn jacobian(robot, q) {{ {body} }}"));
        let task = &grade.tasks[0];
        assert_eq!(task.verdict, Verdict::Crashed, "{body}: {}", text(&grade));
        let stopped = task.stopped.as_ref().expect("why");
        assert_eq!(stopped.message, message, "{body}");
        assert_eq!(stopped.help.as_deref(), help, "{body}");
    }
}

#[test]
fn a_students_own_function_of_that_name_is_theirs() {
    let lab = own_lab().lab();
    let own = SUBMISSION
        .replace("robot.fk(q + step)", "fk(robot, q + step)")
        .replace("robot.fk(q - step)", "fk(robot, q - step)")
        + "\nfn fk(robot, q) { let l = robot.link_lengths; let b = q[0] + q[1]; vector([2 + l[0] * cos(q[0]) + l[1] * cos(b), l[0] * sin(q[0]) + l[1] * sin(b), 0.05]) }";
    let grade = graded(&lab, &own);
    assert_eq!(grade.verdict, Verdict::Passed, "{}", text(&grade));
    let wrong = own.replace("vector([2 +", "1.1 * vector([2 +");
    let grade = graded(&lab, &wrong);
    assert_eq!(grade.tasks[0].verdict, Verdict::Missed, "{}", text(&grade));
}

#[test]
fn labs_that_grant_what_cannot_be_are_refused() {
    for (from, to, message) in [
        (
            r#"grants = ["fk"]"#,
            r#"grants = ["jacobian"]"#,
            "`robot.jacobian` is what this task asks for",
        ),
        (
            r#"grants = ["fk"]"#,
            r#"grants = ["fk", "fk"]"#,
            "`fk` is granted twice",
        ),
        (
            r#"grants = ["fk"]"#,
            r#"grants = ["gravty"]"#,
            "there is no `robot.gravty` to grant",
        ),
    ] {
        match own_lab().with("lab.toml", from, to).load() {
            Ok(_) => panic!("{to} is accepted"),
            Err(error) => assert_eq!(error.to_string(), message),
        }
    }
}
