//! Slips that people made while they wrote labs from the documentation: each is answered with what to write instead.

use kinemark_grader::task::problem::{LabError, LoadError};
use kinemark_sim::text::Problem as _;

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

/// A task before the first, with an entry that a quantity of the robot has not.
const GRAVITY: &str = "[[tasks]]
name = \"gravity\"
title = \"Gravity\"

[tasks.function]
call = \"gravity\"
cases = [{ name = \"bent\", q_rad = [0.7, -1.1] }]

[[tasks.checks]]
name = \"shoulder\"
title = \"The torque of the shoulder\"
points = 1.0
function-cases = { full = 0.01, zero = 0.1, entry = \"shoulder\" }

[[tasks]]
name = \"fk\"";

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
            ("expected = [4.0, 9.0]", "expected = [[4.0], [9.0, 1.0]]", "lab::case_input", "write rows of equal length"),
            (kind, two, "lab::check_kind", "has two kinds, `fk-error` and `ik-reach`"),
            (kind, "", "lab::check_kind", "such as `fk-error = {"),
            ("function-cases = { full = 0.01, zero = 0.1 }", "", "lab::check_kind", "such as `function-cases = {"),
            ("pose-reached = { full_m = 0.01, zero_m = 0.05 }", "", "lab::check_kind", "such as `pose-reached = {"),
            ("\"forward_kinematics\"", "\"fk\"", "lab::call", "did you mean `forward_kinematics`?"),
            ("robot = \"rrbot\"", "robot = \"rrbot.toml\"", "lab::unknown_robot", "leave out `.toml`"),
            ("[[tasks]]\nname = \"fk\"", GRAVITY, "lab::unknown_entry", "the answer of `gravity` has no entries with names"),
            ("robot = \"rrbot\"", "robot = \"RzTq\"", "lab::unknown_robot", "`q` is no axis"),
            ("\"= pick\"", "[\"= sine(pick[0])\", 1.0, 0.05]", "lab::expression", "did you mean `sin`?"),
            ("\"= pick\"", "\"= pick + 1\"", "lab::expression", "`pick` is a list and needs an index"),
            ("[parameters]", "[budgets]\nkept_after_stop = 0.5\n\n[parameters]", "lab::toml", "keys of the lab come before the first table"),
            ("[[tasks]]\nname = \"fk\"", "[tasks]\nname = \"fk\"", "lab::toml", "line 11 has [tasks]: write [[tasks]] there"),
            ("pose-reached = { full_m = 0.01, zero_m = 0.05 }", "joint-limits = { full_m = 0.0, zero_m = 0.1 }", "lab::toml", "write `full_rad`: of a joint that slides it holds metres"),
            ("given = { a = 2.0, b = 3.0 }, expected = [4.0, 9.0] },", "given = { a = 2.0, b = 3.0 }, expected = [4.0, 9.0] },\n { name = \"other\", given = { a = 2.0, b = 3.0 }, expected = 4.0 },", "lab::case_input", "expects one number, the first case expects a list"),
        ],
    );
}

/// What is refused in a lab, in the order of the text: each with its code, its line and its message.
fn refused(lab: &OwnLab) -> Vec<(String, usize, String)> {
    let Err(LoadError::Lab(first)) = lab.load() else {
        panic!("a lab with mistakes");
    };
    let all = std::iter::once(&first).chain(first.others());
    let row = |one: &LabError| {
        let code = one.problem.code().to_owned();
        (code, one.line_and_column().0, one.to_string())
    };
    all.map(row).collect()
}

/// The text of the lab with every one of the edits, and the lines where they are.
fn edited(edits: &[(&str, &str)]) -> (String, Vec<usize>) {
    let mut text = LAB.to_owned();
    for (from, to) in edits {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    let line = |(_, to): &(&str, &str)| {
        let at = text.find(to).expect("the edit");
        text[..at].matches('\n').count() + 1
    };
    let lines = edits.iter().map(line).collect();
    (text, lines)
}

#[test]
fn slips_in_different_tasks_and_checks_are_refused_together() {
    let (text, lines) = edited(&[
        ("frame = \"lab\"", "fraem = \"lab\""),
        ("fk-error = { full_m", "fk-error = { full"),
        ("given = { a = 2.0", "givn = { a = 2.0"),
        ("function-cases = {", "function-case = {"),
        ("duration_s = 3.0", "duration_s = true"),
        (
            "points = 2.0\npose-reached",
            "points = \"two\"\npose-reached",
        ),
    ]);
    let refused = refused(&OwnLab::new("95-slips", &*text));
    let found: Vec<usize> = refused.iter().map(|(_, line, _)| *line).collect();
    assert_eq!(found, lines, "{refused:#?}");
    assert!(refused.iter().all(|(code, ..)| code == "lab::toml"));
    // all of them are shown, each at its place
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write("labs/95-slips/lab.toml", &text);
    bed.write("mine.rhai", SUBMISSION);
    let ran = bed.run(&["grade", "95-slips", "mine.rhai", "--practice"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    for line in lines {
        let place = format!("lab.toml:{line}:");
        assert_eq!(
            ran.stderr.matches(&place).count(),
            1,
            "{place} in {}",
            ran.stderr
        );
    }
}

#[test]
fn mistakes_that_are_found_later_are_refused_together() {
    let more = "pose-reached = { full_m = 0.05, zero_m = 0.01 }

[[tasks.checks]]
name = \"after\"
title = \"It may be right\"
points = 1.0
needs = [\"pose\"]
finish-time = { full_s = 1.0, zero_s = 2.0 }

[[tasks.checks]]
name = \"other\"
title = \"It names a joint that is not there\"
points = 1.0
joint-reached = { joint = \"wrist\", position_rad = 0.5, hold_s = 0.1, full_rad = 0.01, zero_rad = 0.1 }
";
    let (text, lines) = edited(&[
        ("frame = \"lab\"", "frame = \"lab\"\nkept_after_stop = 2"),
        ("points = 4.0", "points = 0"),
        ("call = \"two_squares\"", "call = \"two squares\""),
        ("pose-reached = { full_m = 0.01, zero_m = 0.05 }\n", more),
    ]);
    let refused = refused(&OwnLab::new("95-slips", text));
    let codes: Vec<&str> = refused.iter().map(|(code, ..)| code.as_str()).collect();
    let expected = [
        "lab::out_of_range",
        "lab::points",
        "lab::call",
        "lab::band",
        "lab::unknown_joint",
    ];
    assert_eq!(codes, expected, "{refused:#?}");
    assert_eq!(refused[0].1, lines[0] + 1);
    assert_eq!(refused[3].1, lines[3]);
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
