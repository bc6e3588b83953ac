//! Mutants that are not named: `lab check` says which rule of the diagnosis failed, with its numbers.

use kinemark_grader::audit::{Audit, Form};

use crate::every_case::every_case;
use crate::own_lab::OwnLab;

const LAB: &str = r#"
format = 1
name = "95-unnamed"
title = "Mistakes that nobody sees"
robot = "rrbot"
frame = "lab"

[parameters]
x = 3.187693            # where both joints are at 0.6

[[tasks]]
name = "fk"
title = "Forward kinematics"

[tasks.function]
call = "forward_kinematics"
cases = [
    { name = "both bent", q_rad = [0.7, -1.1] },
    { name = "to the left", q_rad = [-0.9, 0.4] },
    { name = "down", q_rad = [2.9, 0.3] },
]

[[tasks.checks]]
name = "position"
title = "The position of the TCP"
points = 4.0
fk-error = { full_m = 1e-4, zero_m = 5e-3 }

[[tasks]]
name = "reach"
title = "One place"

[tasks.motion]
mode = "position"
duration_s = 3.0
start_rad = [0.2, 0.2]
target = { place_m = ["= x", 1.496681] }
goals = [{ position_m = ["= x", 1.496681, 0.05], dwell_s = 0.3 }]
servo = { kp = 1000.0, kd = 30.0, derivative = "velocity", gravity_compensation = true, effort_limit = 100.0 }

[[tasks.checks]]
name = "pose"
title = "There"
points = 2.0
pose-reached = { full_m = 0.004, zero_m = 0.04 }

[[tasks.checks]]
name = "time"
title = "In time"
points = 1.0
finish-time = { full_s = 1.5, zero_s = 3.0 }

[[tasks]]
name = "turn"
title = "Slowly"

[tasks.motion]
mode = "velocity"
duration_s = 2.0
start_rad = [0.2, 0.2]
servo = { kp = 20.0, ki = 50.0, gravity_compensation = true, effort_limit = [60.0, 30.0] }

[[tasks.checks]]
name = "calm"
title = "Never fast"
points = 1.0
tcp-speed = { at = "run", full_m_s = 0.5, zero_m_s = 0.9 }
"#;

const HIDDEN: &str = r#"
format = 1
salt = "a long one that nobody can guess"

[[draws]]
task = "fk"
class = "other angles"
count = 5
q_rad = [[-3.0, 3.0], [-3.0, 3.0]]

[[runs]]
task = "reach"
class = "another place"
count = 1
parameters = { x = [2.9, 3.0] }
"#;

const SOLUTION: &str = r#"
fn forward_kinematics(robot, q) {
    let l = robot.link_lengths;
    [robot.base_height + l[0] * cos(q[0]) + l[1] * cos(q[0] + q[1]), l[0] * sin(q[0]) + l[1] * sin(q[0] + q[1]), 0.05]
}

fn init(robot, task) { this.task = task; }

fn control(observation) {
    if observation.task == "turn" { return [0.15, 0.0]; }
    let up = observation.target.place_m[0] - 2.0;
    let side = observation.target.place_m[1];
    let elbow = acos((up * up + side * side - 2.0) / 2.0);
    let shoulder = atan2(side, up) - elbow / 2.0;
    [shoulder, elbow]
}
"#;

/// A mutant: its name, its tasks, and what it changes in the solution.
type Made = (&'static str, &'static str, &'static str, &'static str);

fn lab_with(mutants: &[Made]) -> OwnLab {
    let mut lab = OwnLab::new("95-unnamed", LAB)
        .and("hidden.toml", HIDDEN)
        .and("solution.rhai", SOLUTION);
    let mut list = "format = 1\n".to_owned();
    for (name, tasks, from, to) in mutants {
        assert!(SOLUTION.contains(from), "{from}");
        list +=
            &format!("[[mutants]]\nname = \"{name}\"\ntasks = {tasks}\nsays = \"A mistake.\"\n");
        let path: &'static str = format!("mutants/{name}.rhai").leak();
        lab = lab.and(path, SOLUTION.replace(from, to));
    }
    lab.and("mutants.toml", list)
}

const CONTROL: &str = "[shoulder, elbow]";
const Y: &str = "l[0] * sin(q[0]) + l[1]";
const TURN: &str = "return [0.15, 0.0];";

/// A mutant that is not named: its words, what is made of the lab, and what is said of it.
type Fault<'w> = (String, (Vec<Made>, Vec<&'w str>));

#[test]
fn the_rule_that_failed_is_named() {
    let faults: Vec<Fault<'_>> = vec![
        (
            "a little off everywhere".to_owned(),
            (
                vec![("little", "[\"fk\"]", "0.05]", "0.051]")],
                vec![
                    "is not named: its answer earns nothing in 0 of 8 cases, hidden ones among them, and 3 are needed; in case \"",
                    "it is off by 1 mm, where 5.0 mm would count",
                ],
            ),
        ),
        (
            "the same as another".to_owned(),
            (
                vec![
                    ("sine", "[\"fk\"]", Y, "l[0] * cos(q[0]) + l[1]"),
                    ("cosine", "[\"fk\"]", Y, "cos(q[0]) * l[0] + l[1]"),
                ],
                vec!["is not named: does the same as mutant `cosine` in all 8 cases"],
            ),
        ),
        (
            "it does not move".to_owned(),
            (
                vec![("stays", "[\"reach\"]", CONTROL, "[0.2, 0.2]")],
                vec![
                    "is not named: goal 1: its nearest stay is the start (",
                    "so it says nothing",
                ],
            ),
        ),
        (
            "right, but slow".to_owned(),
            (
                vec![(
                    "slow",
                    "[\"reach\"]",
                    CONTROL,
                    "if observation.time < 1.6 { return [0.2, 0.2]; } [shoulder, elbow]",
                )],
                vec![
                    "is not named: goal 1: it stands ",
                    "from it, and more than 4.0 mm would count",
                ],
            ),
        ),
        (
            "typed in".to_owned(),
            (
                vec![("typed-in", "[\"reach\"]", CONTROL, "[0.6, 0.6]")],
                vec![
                    "its visible run loses nothing: it shows in 1 of 1 hidden runs of the class \"another place\" only, which a diagnosis \
                     never looks at",
                ],
            ),
        ),
        (
            "nearly the solution".to_owned(),
            (
                vec![(
                    "twitch",
                    "[\"turn\"]",
                    TURN,
                    "if observation.tick == 1000 { return [1.0, 0.0]; } return [0.15, 0.0];",
                )],
                vec![
                    "is not named: its joints differ from those of the solution by ",
                    "where 0.02 rad would count",
                ],
            ),
        ),
        (
            "another whole run that is the same".to_owned(),
            (
                vec![
                    ("fast", "[\"turn\"]", TURN, "return [0.6, 0.0];"),
                    ("faster", "[\"turn\"]", TURN, "return [0.601, 0.0];"),
                ],
                vec!["is not named: does the same as mutant `faster`: of "],
            ),
        ),
        (
            "right in a task where it should show".to_owned(),
            (
                vec![(
                    "half-right",
                    "[\"fk\", \"turn\"]",
                    TURN,
                    "return [0.6, 0.0];",
                )],
                vec![
                    "loses no point: The position of the TCP ",
                    "it has full marks in task `fk`, where it should show, too",
                ],
            ),
        ),
        (
            "loses nothing".to_owned(),
            (
                vec![("right", "[\"turn\"]", "0.15, 0.0", "0.1501, 0.0")],
                vec![
                    "loses no point: Never fast 0.",
                    "(all points up to 0.5 m/s)",
                ],
            ),
        ),
    ];
    every_case(&faults, |(mutants, words)| {
        let own = lab_with(mutants);
        let lab = own.lab();
        let staff = own.staff(&lab).expect("the course staff's part");
        let mut audit = Audit::new(&lab);
        assert!(audit.reference(&lab, &staff, "").is_some());
        assert_eq!(audit.problems().count(), 0, "{:#?}", audit.rows);
        let form = Form::new(&lab, &staff);
        let found = form.mutant(0);
        let problems: Vec<&String> = found
            .rows
            .iter()
            .filter_map(|row| row.problem.as_ref())
            .collect();
        for words in words {
            let says = |problem: &&&String| problem.contains(*words);
            assert!(
                problems.iter().any(|problem| says(&problem)),
                "{words}: {problems:#?}"
            );
        }
    });
}

/// An arm with a wrist that turns on the spot, sent to one place with a heading.
const HEADING: &str = r#"
format = 1
name = "95-heading"
title = "A heading"
robot = "RzRzRzTz"

[dimensions]
link1 = [0.4, 0.0, 0.0]
link2 = [0.3, 0.0, 0.0]
link3 = [0.0, 0.0, -0.1]
link4 = [0.0, 0.0, -0.1]

[[tasks]]
name = "tour"
title = "One place"

[tasks.motion]
mode = "velocity"
duration_s = 4.0
target = { q_rad = [0.6, 0.9, -0.5, 0.0] }
# the place of these angles
goals = [{ position_m = [0.3513554, 0.5251055, -0.2], rpy_deg = [0.0, 0.0, 57.2957795], dwell_s = 0.3 }]
servo = { kp = [10.0, 4.0, 0.02, 20.0], gravity_compensation = true }

[[tasks.checks]]
name = "pose"
title = "There"
points = 2.0
pose-reached = { full_m = 0.004, zero_m = 0.04 }

[[tasks.checks]]
name = "heading"
title = "The heading"
points = 2.0
orientation-reached = { full_rad = 0.01, zero_rad = 0.2 }
"#;

#[test]
fn a_mistake_of_the_heading_alone_is_named() {
    let turned = |more: &str| {
        format!(
            "fn control(observation) {{ let q = observation.target.q_rad; q[2] += {more}; (q - observation.q) * 3 }}\n"
        )
    };
    let solution = turned("0");
    for (more, words) in [
        ("0.3", None),
        // it loses points, and hardly shows
        (
            "0.015",
            Some("it is turned by 0.015 rad away, and 0.02 rad would count"),
        ),
    ] {
        let own = OwnLab::new("95-heading", HEADING)
            .and("hidden.toml", "format = 1\nsalt = \"a long one that nobody can guess\"\n")
            .and("solution.rhai", solution.clone())
            .and(
                "mutants.toml",
                "format = 1\n[[mutants]]\nname = \"turned\"\ntasks = [\"tour\"]\nsays = \"The heading is off.\"\n",
            )
            .and("mutants/turned.rhai", turned(more));
        let lab = own.lab();
        let staff = own.staff(&lab).expect("the course staff's part");
        let mut audit = Audit::new(&lab);
        assert!(audit.reference(&lab, &staff, "").is_some());
        assert_eq!(audit.problems().count(), 0, "{:#?}", audit.rows);
        let found = Form::new(&lab, &staff).mutant(0);
        let problem = found.rows.iter().find_map(|row| row.problem.as_ref());
        match words {
            None => assert_eq!(problem, None),
            Some(words) => assert!(
                problem.is_some_and(|problem| problem.contains(words)),
                "{words}: {problem:?}"
            ),
        }
    }
}
