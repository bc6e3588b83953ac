//! Poses and joints of a robot that is a row of joints: how many branches there are, what is out of reach, what is in degrees.

use kinemark_grader::audit::Accepted;

use crate::bad_rubrics::{problems, rows};
use crate::every_case::every_case;
use crate::own_lab::OwnLab;

/// Two turning joints with links of 0.4 m and 0.3 m, a wrist that turns, and a lift: what many pick and place with.
const POSES: &str = r#"
format = 1
name = "94-poses"
title = "Poses"
robot = "RzRzRzTz"

[dimensions]
link1 = [0.4, 0.0, 0.0]
link2 = [0.3, 0.0, 0.0]
link3 = [0.0, 0.0, -0.1]
link4 = [0.0, 0.0, -0.1]

[[tasks]]
name = "ik"
title = "Inverse kinematics"

[tasks.function]
call = "inverse_kinematics"
FORM

[[tasks.checks]]
name = "reach"
title = "One branch reaches"
points = 2.0
ik-reach = { full_m = 1e-3, zero_m = 1e-2, full_rad = 1e-3, zero_rad = 1e-2 }
"#;

#[test]
fn branches_of_poses_are_counted_and_what_cannot_be_counted_is_not_doubted() {
    let yaw = |place: &str, rest: &str| {
        format!(
            "pose = \"yaw\"\ncases = [{{ name = \"a\", position_m = {place}, yaw_deg = 90{rest} }}]"
        )
    };
    let full = |rpy: &str| {
        format!(
            "pose = \"full\"\ncases = [{{ name = \"a\", position_m = [0.5, 0.2, -0.1], rpy_deg = {rpy} }}]"
        )
    };
    let axis = |direction: &str| {
        format!(
            "pose = \"axis\"\ncases = [{{ name = \"a\", position_m = [0.5, 0.2, -0.1], axis = {direction} }}]"
        )
    };
    let cases = [
        ("a heading", yaw("[0.5, 0.2, -0.1]", ""), None),
        (
            "one too few",
            yaw("[0.5, 0.2, -0.1]", ", branches = 1"),
            Some("2 branches reach [0.5, 0.2, -0.1, 1.5708] within the limits"),
        ),
        (
            "too far",
            yaw("[0.6, 0.5, -0.1]", ""),
            Some("is out of reach by 8"),
        ),
        (
            "nothing there",
            yaw("[0.6, 0.5, -0.1]", ", branches = 0"),
            None,
        ),
        ("a whole pose", full("[0, 0, 90]"), None),
        // the lift is vertical
        (
            "tilted",
            full("[0, 30, 90]"),
            Some("the pose at [0.5, 0.2, -0.1] is out of reach by"),
        ),
        // the wrist is free: as many branches as one likes
        ("upright", axis("[0, 0, 1]"), None),
        (
            "lying",
            axis("[1, 0, 0]"),
            Some("within the limits of the joints, and 2 branches are stated"),
        ),
        (
            "the wrist left out",
            format!("ignore = [\"joint3\"]\n{}", yaw("[0.5, 0.2, -0.1]", "")),
            Some("is out of reach by"),
        ),
    ]
    .map(|(name, form, words)| (name.to_owned(), (form, words)));
    every_case(&cases, |(form, words)| {
        let own = OwnLab::new("94-poses", POSES.replace("FORM", form))
            .and(
                "hidden.toml",
                "format = 1\nsalt = \"a long one that nobody can guess\"\n",
            )
            .and(
                "solution.rhai",
                "fn inverse_kinematics(robot, pose) { [] }\n",
            );
        let found = problems(&rows(
            &own,
            "Write `inverse_kinematics`.",
            &Accepted::default(),
        ));
        let of_branches: Vec<_> = found
            .iter()
            .filter(|(rule, _)| rule == "branches")
            .collect();
        match words {
            None => assert!(of_branches.is_empty(), "{found:#?}"),
            Some(words) => assert!(
                of_branches
                    .iter()
                    .any(|(_, problem)| problem.contains(words)),
                "{words}: {found:#?}"
            ),
        }
    });
}

/// A row of joints has no limits, and 90 rad is an angle like any.
#[test]
fn degrees_of_joints_without_limits_are_doubted() {
    for (angle, count) in [("90.0", 1), ("9.0", 0)] {
        let text = POSES
            .replace(
                "ik-reach = { full_m = 1e-3, zero_m = 1e-2, full_rad = 1e-3, zero_rad = 1e-2 }",
                "fk-error = { full_m = 1e-3, zero_m = 1e-2 }",
            )
            .replace("inverse_kinematics", "forward_kinematics")
            .replace(
                "FORM",
                &format!("cases = [{{ name = \"a\", q_rad = [{angle}, 0.2, 0.3, 0.1] }}]"),
            );
        let own = OwnLab::new("94-poses", text)
            .and(
                "hidden.toml",
                "format = 1\nsalt = \"a long one that nobody can guess\"\n",
            )
            .and("solution.rhai", "fn forward_kinematics(robot, q) { [] }\n");
        let found = problems(&rows(
            &own,
            "Write `forward_kinematics`.",
            &Accepted::default(),
        ));
        let of_reach: Vec<_> = found.iter().filter(|(rule, _)| rule == "reach").collect();
        assert_eq!(of_reach.len(), count, "{found:#?}");
        assert!(
            of_reach
                .iter()
                .all(|(_, problem)| problem.contains("more than 2 turns: are these degrees?")),
            "{found:#?}"
        );
    }
}
