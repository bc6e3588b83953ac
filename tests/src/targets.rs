//! `target`: what a lab writes there is what `observation.target` holds, whatever its shape.

use kinemark_grader::record::verdict::Verdict;
use kinemark_report::text::text;

use crate::own_lab::OwnLab;
use crate::testbed::grade;

const LAB: &str = r#"
format = 1
name = "93-target"
title = "What is given"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "hold"
title = "Hold"

[tasks.motion]
mode = "position"
duration_s = 0.1
target = TARGET
servo = { kp = 1000.0, kd = 30.0, derivative = "velocity", gravity_compensation = true }

[[tasks.checks]]
name = "held"
title = "It stays"
points = 1.0
joint-reached = { joint = "shoulder", position_rad = 0.0, hold_s = 0.05, full_rad = 0.01, zero_rad = 0.02 }
"#;

fn own_lab(target: &str) -> OwnLab {
    OwnLab::new("93-target", LAB.replace("TARGET", target))
}

#[test]
fn a_target_of_any_shape_arrives() {
    for (target, test) in [
        ("0.25", "t == 0.25"),
        ("3", "t + 1 == 4"),
        ("\"down\"", "t == \"down\""),
        ("true", "t"),
        ("[0.5, 1]", "norm(t - [0.5, 1]) == 0 && t.x == 0.5"),
        ("[]", "len(t) == 0"),
        ("[[1, 2, 3], [4, 5, 6]]", "len(t) == 2 && t[1].z == 6"),
        (
            "{ speed_m_s = 0.2, points_m = [[2, 1.4, 0.05], [1.25, 1.4, 0.05]], way = { by = \"line\" } }",
            "t.speed_m_s == 0.2 && t.points_m[1].x == 1.25 && t.way.by == \"line\" && !(\"other\" in t)",
        ),
        ("[{ at = 1 }, \"two\"]", "t[0].at == 1 && t[1] == \"two\""),
    ] {
        let lab = own_lab(target).lab();
        let submission = format!(
            "fn control(observation) {{ let t = observation.target; if {test} {{ [0, 0] }} else {{ throw \"other\" }} }}"
        );
        let grade = grade(&lab, None, "mine.rhai", &submission).grade;
        assert_eq!(grade.verdict, Verdict::Passed, "{target}: {}", text(&grade));
    }
}

#[test]
fn a_target_nobody_can_be_given_is_refused() {
    let long = format!("[{}]", "0.5, ".repeat(1000));
    for (target, message) in [
        (
            "[2026-01-01]",
            "a target holds numbers, strings, booleans, lists and tables of them",
        ),
        (
            long.as_str(),
            "a target holds at most 1000 values, this one 1001",
        ),
        ("[nan]", "a lab's numbers are finite"),
    ] {
        match own_lab(target).load() {
            Ok(_) => panic!("{target} is accepted"),
            Err(error) => assert_eq!(error.to_string(), message),
        }
    }
}
