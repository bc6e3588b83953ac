//! `target`: what a lab writes there is what `observation.target` holds, whatever its shape.

use kinemark_grader::record::verdict::Verdict;
use kinemark_report::text::text;

use crate::own_lab::{OwnLab, check, message};
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

/// A goal that both elbows reach; only with one the forearm points along (1.8 rad).
const TURNED: &str = r#"
format = 1
name = "93-turned"
title = "Turned as asked"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "touch"
title = "Touch"

[tasks.motion]
mode = "position"
duration_s = 4.0
start_rad = [1.2, 0.2]
goals = [{ position_m = [2.598133519, 1.538490104, 0.05], dwell_s = 0.5, ORIENTATION }]
servo = { kp = 1000.0, kd = 60.0, derivative = "velocity", gravity_compensation = true }

[[tasks.checks]]
name = "there"
title = "The place"
points = 1.0
pose-reached = { full_m = 0.01, zero_m = 0.05 }

[[tasks.checks]]
name = "turned"
title = "The direction"
points = 2.0
orientation-reached = { full_rad = 0.02, zero_rad = 0.2 }
"#;

#[test]
fn a_goal_with_an_orientation_is_reached_with_one_elbow_only() {
    // the forearm is the z axis of the TCP; in the lab's frame q = (0.6, 1.2) points it along 1.8 rad
    let axis = "axis = { of_tcp = [0, 0, 2], along = [-0.2272020947, 0.9738476309, 0] }";
    let lab = OwnLab::new("93-turned", TURNED.replace("ORIENTATION", axis));
    let submission = |q: &str| {
        format!(
            "fn control(observation) {{ let goal = observation.target[0]; \
             if abs(goal.along.y - 0.97384763) > 1e-6 || goal.axis.z != 1 || goal.position.z != 0.05 {{ throw \"other\" }} {q} }}"
        )
    };
    let task = lab.graded(&submission("[0.6, 1.2]"), 0);
    assert_eq!(task["points"], 3.0, "{task}");
    let task = lab.graded(&submission("[1.8, -1.2]"), 1);
    assert_eq!(check(&task, "there")["outcome"], "full", "{task}");
    let turned = check(&task, "turned");
    assert_eq!(turned["points"], 0.0);
    let off = turned["measure"]["value"].as_f64().expect("an angle");
    assert!((off - 1.2).abs() < 1e-3, "{off}");
    assert!(
        message(turned).contains("its axis [0, 0, 1] points along [0.825"),
        "{turned}"
    );
    // never there: nothing to judge
    let task = lab.graded(&submission("[0.0, 0.0]"), 1);
    assert_eq!(
        message(check(&task, "turned")),
        "goal 1 was never held, so its orientation cannot be judged"
    );

    for (from, to, code, words) in [
        (
            axis,
            "rpy_deg = [0, 90, 0], axis = { of_tcp = [0, 0, 1], along = [1, 0, 0] }",
            "lab::goal",
            "one orientation",
        ),
        (
            "of_tcp = [0, 0, 2]",
            "of_tcp = [0, 0, 0]",
            "lab::goal",
            "`of_tcp` has no direction",
        ),
        (axis, "rpy = [0, 0, 0]", "lab::toml", "rpy_deg"),
        (axis, "rpy_deg = [0, 0]", "lab::toml", "3"),
    ] {
        lab.is_refused(&submission("[0, 0]"), &[(from, to, code, words)]);
    }
    // without an orientation there is nothing to judge
    let plain = OwnLab::new("93-turned", TURNED.replace(", ORIENTATION", ""));
    let error = plain.load().expect_err("nothing to judge");
    assert!(format!("{error:?}").contains("rpy_deg"), "{error:?}");
}

#[test]
fn a_full_orientation_is_given_as_a_matrix_and_a_target_may_stand_beside_goals() {
    let rpy = "rpy_deg = [0, 0, 90]";
    let lab = OwnLab::new("93-turned", TURNED.replace("ORIENTATION", rpy));
    let given = "fn control(observation) { let r = observation.target[0].rotation; \
                 if abs(r[1][0] - 1) > 1e-9 || abs(r[0][1] + 1) > 1e-9 || r[2][2] != 1 { throw \"other\" } [0, 0] }";
    let task = lab.graded(given, 1);
    assert_eq!(task["verdict"], "missed", "{task}");
    let beside = TURNED
        .replace("ORIENTATION", rpy)
        .replace("goals =", "target = { mass_kg = 0.5 }\ngoals =");
    let lab = OwnLab::new("93-turned", beside);
    let given = "fn control(observation) { if observation.target.mass_kg != 0.5 { throw \"other\" } [0.6, 1.2] }";
    let task = lab.graded(given, 1);
    assert_eq!(check(&task, "there")["outcome"], "full", "{task}");
}
