//! Slips that people made while they wrote labs from the documentation: each is answered with what to write instead.

use crate::own_lab::{OwnLab, check};
use crate::testbed::TestBed;

const LAB: &str = r#"
format = 1
name = "95-slips"
title = "Slips"
robot = "rrbot"
frame = "lab"

[parameters]
pick = [2.5, 1.2, 0.05]

[[tasks]]
name = "fk"
title = "Forward kinematics"

[tasks.function]
call = "forward_kinematics"
cases = [
    { name = "straight up", q_rad = [0.0, 0.0] },
]

[[tasks.checks]]
name = "position"
title = "The position of the TCP"
points = 4.0
fk-error = { full_m = 1e-4, zero_m = 5e-3 }

[[tasks]]
name = "own"
title = "A function of the lab's own"

[tasks.function]
call = "two_squares"
cases = [
    { name = "small", given = { a = 2.0, b = 3.0 }, expected = [4.0, 9.0] },
]

[[tasks.checks]]
name = "squares"
title = "Both squares"
points = 2.0
function-cases = { full = 0.01, zero = 0.1 }

[[tasks]]
name = "touch"
title = "Touch"

[tasks.motion]
mode = "position"
duration_s = 3.0
goals = [{ position_m = "= pick", dwell_s = 0.5 }]
servo = { kp = 1000.0, kd = 30.0, derivative = "velocity", gravity_compensation = true }

[[tasks.checks]]
name = "pose"
title = "There"
points = 2.0
pose-reached = { full_m = 0.01, zero_m = 0.05 }
"#;

/// Right in the second task, and where `pick` is in the third.
const SUBMISSION: &str = "
fn two_squares(given) { [given.a * given.a, given.b * given.b] }
fn init(robot, task) { this.height = robot.base_height; }
fn control(observation) {
    let p = observation.target[0];
    let u = p.x - this.height;
    let q2 = acos((u * u + p.y * p.y - 2.0) / 2.0);
    [atan2(p.y, u) - atan2(sin(q2), 1.0 + cos(q2)), q2]
}
";

fn own_lab() -> OwnLab {
    OwnLab::new("95-slips", LAB)
}

#[test]
fn a_whole_list_stands_for_its_numbers_and_an_answer_may_be_a_list() {
    let record = own_lab().record(SUBMISSION, 1);
    let tasks = record["tasks"].as_array().expect("tasks");
    assert_eq!(check(&tasks[1], "squares")["outcome"], "full", "{record}");
    assert_eq!(check(&tasks[2], "pose")["outcome"], "full", "{record}");
    let wrong = SUBMISSION.replace("given.b * given.b]", "given.b * given.b, 1.0]");
    let record = own_lab().record(&wrong, 1);
    let squares = check(&record["tasks"][1], "squares");
    assert_eq!(squares["points"], 0.0, "{squares}");
    assert!(
        squares.to_string().contains("a list of 2 numbers"),
        "{squares}"
    );
}

#[test]
fn each_slip_is_answered_with_what_to_write() {
    let kind = "fk-error = { full_m = 1e-4, zero_m = 5e-3 }";
    let two =
        "fk-error = { full_m = 1e-4, zero_m = 5e-3 }\nik-reach = { full_m = 1.0, zero_m = 2.0 }";
    own_lab().is_refused(
        SUBMISSION,
        &[
            ("expected = [4.0, 9.0]", "expected = [[4.0], [9.0]]", "lab::toml", "a number, a list of numbers, or a table of these"),
            (kind, two, "lab::check_kind", "has two kinds, `fk-error` and `ik-reach`"),
            (kind, "", "lab::check_kind", "such as `fk-error = {"),
            ("function-cases = { full = 0.01, zero = 0.1 }", "", "lab::check_kind", "such as `function-cases = {"),
            ("pose-reached = { full_m = 0.01, zero_m = 0.05 }", "", "lab::check_kind", "such as `pose-reached = {"),
            ("\"forward_kinematics\"", "\"fk\"", "lab::call", "did you mean `forward_kinematics`?"),
            ("robot = \"rrbot\"", "robot = \"rrbot.toml\"", "lab::unknown_robot", "leave out `.toml`"),
            ("\"= pick\"", "[\"= sin(pick[0])\", 1.0, 0.05]", "lab::expression", "`sin` cannot be called"),
            ("\"= pick\"", "\"= pick + 1\"", "lab::expression", "`pick` is a list and needs an index"),
            ("[parameters]", "[budgets]\nkept_after_stop = 0.5\n\n[parameters]", "lab::toml", "keys of the lab come before the first table"),
            ("[[tasks]]\nname = \"fk\"", "[tasks]\nname = \"fk\"", "lab::toml", "line 11 has [tasks]: write [[tasks]] there"),
            ("pose-reached = { full_m = 0.01, zero_m = 0.05 }", "joint-limits = { full_m = 0.0, zero_m = 0.1 }", "lab::toml", "write `full_rad`: of a joint that slides it holds metres"),
            ("given = { a = 2.0, b = 3.0 }, expected = [4.0, 9.0] },", "given = { a = 2.0, b = 3.0 }, expected = [4.0, 9.0] },\n { name = \"other\", given = { a = 2.0, b = 3.0 }, expected = 4.0 },", "lab::case_input", "expects one number, the first case expects a list"),
        ],
    );
}

#[test]
fn a_lab_in_another_encoding_is_refused_at_line_and_column() {
    let bed = TestBed::new();
    bed.copy_labs();
    let path = bed.path("labs/01-kinematics/lab.toml");
    let text = std::fs::read_to_string(&path).expect("a lab");
    let (before, after) = text.split_once("title = \"").expect("a title");
    let mut bytes = format!("{before}title = \"Gr").into_bytes();
    bytes.push(0xf6);
    bytes.extend(after.as_bytes());
    std::fs::write(&path, bytes).expect("written");
    bed.write("mine.rhai", "fn control(observation) { [0.0, 0.0] }\n");
    let ran = bed.run(&["grade", "01-kinematics", "mine.rhai", "--practice"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    let line = before.matches('\n').count() + 1;
    let place = format!("line {line}, column 12");
    let words = ran.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        words.contains(&place) && words.contains("Windows-1252"),
        "{words}"
    );
}
