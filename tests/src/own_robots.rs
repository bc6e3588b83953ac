//! Tasks with a robot of their own beside those of the lab's: visible and hidden cases, a run, reports and packs.

use serde_json::Value as Json;

use crate::own_lab::{OwnLab, check};

/// A carriage of 2 kg that slides along x.
const CARRIAGE: &str = r#"
format = 1
name = "carriage"
links = [
    { name = "rail" },
    { name = "sled", shapes = [{ box = { size_m = [0.1, 0.1, 0.1] } }], inertia = { mass_kg = 2.0, com_m = [0, 0, 0], tensor_kg_m2 = [0.004, 0.004, 0.004, 0, 0, 0] } },
]
joints = [{ name = "slide", type = "prismatic", parent = "rail", child = "sled", axis = [1, 0, 0], limit = { lower = -5, upper = 5, effort = 30 } }]
frames = [{ name = "tcp", link = "sled", origin = { xyz_m = [0, 0, 0.25] } }]
"#;

const LAB: &str = r#"
format = 1
name = "97-robots"
title = "Two robots and a row"
robot = "rrbot"
frame = "lab"

[[tasks]]
name = "arm"
title = "The arm"
[tasks.function]
call = "forward_kinematics"
cases = [{ name = "up", q_rad = [0.0, 0.0] }]
[[tasks.checks]]
name = "place"
title = "Place"
points = 1
fk-error = { full_m = 1e-9, zero_m = 1e-3 }

[[tasks]]
name = "carriage"
title = "The carriage"
robot = "carriage"
[tasks.function]
call = "forward_kinematics"
cases = [{ name = "to the right", q_rad = [0.4] }]
[[tasks.checks]]
name = "place"
title = "Place"
points = 1
fk-error = { full_m = 1e-9, zero_m = 1e-3 }

[[tasks]]
name = "row"
title = "The row"
robot = "TxTy"
[tasks.function]
call = "velocity"
cases = [{ name = "anywhere", q_rad = [0.1, 0.2], qd_rad_s = [0.3, -0.4] }]
[[tasks.checks]]
name = "velocity"
title = "Velocity"
points = 1
function-cases = { full = 1e-9, zero = 0.1 }

[[tasks]]
name = "go"
title = "Go"
robot = "carriage"
[tasks.motion]
mode = "position"
duration_s = 2.0
servo = { kp = 800.0, kd = 80.0, derivative = "velocity" }
goals = [{ position_m = [0.3, 0, 0.25], dwell_s = 0.2 }]
[[tasks.checks]]
name = "there"
title = "There"
points = 1
pose-reached = { full_m = 1e-3, zero_m = 0.1 }
"#;

const HIDDEN: &str = r#"
format = 1
salt = "of a test, long enough"
[[draws]]
task = "arm"
class = "other angles"
count = 3
q_rad = [[-1, 1], [-1, 1]]
[[draws]]
task = "carriage"
class = "other places"
count = 3
q_rad = [[-4, 4]]
[[draws]]
task = "row"
class = "other speeds"
count = 3
q_rad = [[-1, 1], [-1, 1]]
qd_rad_s = [[-1, 1], [-1, 1]]
"#;

const SOLUTION: &str = r#"
fn forward_kinematics(robot, q) {
    if q.len() == 1 { return [q[0], 0.0, 0.25]; }
    let l = robot.link_lengths;
    [robot.base_height + l[0] * cos(q[0]) + l[1] * cos(q[0] + q[1]), l[0] * sin(q[0]) + l[1] * sin(q[0] + q[1]), 2 * robot.link_offset]
}
fn velocity(robot, q, qd) { [qd[0], qd[1], 0.0] }
fn control(observation) { [0.3] }
"#;

fn lab() -> OwnLab {
    let lab = OwnLab::new("97-robots", LAB)
        .and("hidden.toml", HIDDEN)
        .and("solution.rhai", SOLUTION);
    lab.write("labs/robots/carriage.toml", CARRIAGE);
    lab
}

#[test]
fn each_task_has_its_robot_in_what_is_visible_and_hidden() {
    let lab = lab();
    let record = lab.record(SOLUTION, 0);
    assert_eq!(record["points"], 4.0, "{record}");
    let hidden = |task: usize| record["tasks"][task]["hidden"].clone();
    for task in 0..3 {
        assert_ne!(hidden(task), Json::Null, "{record}");
    }
    // the frame of the lab is not one of the carriage's: its first link is taken
    let short = SOLUTION.replace("0.25]", "0.35]");
    let record = lab.record(&short, 1);
    let place = check(&record["tasks"][1], "place");
    let off = place["measure"]["value"].as_f64().expect("a value");
    assert!((off - 0.1).abs() < 1e-12, "{place}");
    assert_eq!(record["tasks"][0]["points"], 1.0, "{record}");

    // what a report and a pack hold is enough to grade again, and says which robot ran
    let bed = lab.bed();
    assert!(bed.path("out/lab/robots/carriage.toml").is_file());
    let ran = bed.run(&["lab", "draws", "97-robots"]);
    assert!(ran.stdout.contains("q = ["), "{ran:?}");
    bed.write(
        "labs/97-robots/starter.rhai",
        "fn control(observation) { observation.q }\n",
    );
    bed.write("labs/97-robots/brief.md", "# Robots\n");
    let ran = bed.run(&["lab", "pack", "97-robots", "--for", "students"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    let packed = std::fs::File::open(bed.path("97-robots-students.zip")).expect("a pack");
    let packed = zip::ZipArchive::new(packed).expect("a ZIP");
    let names: Vec<String> = packed
        .file_names()
        .map(|name| name.expect("a name").into_owned())
        .collect();
    for robot in ["rrbot", "carriage"] {
        let path = format!("97-robots/labs/robots/{robot}.toml");
        assert!(names.contains(&path), "{names:?}");
    }
    // another robot file makes another grade
    let digest = |record: &Json| record["robot"]["digest"].clone();
    let before = digest(&lab.record(SOLUTION, 0));
    bed.edit(
        "labs/robots/carriage.toml",
        "mass_kg = 2.0",
        "mass_kg = 2.5",
    );
    assert_ne!(digest(&lab.record(SOLUTION, 0)), before);
}

#[test]
fn a_robot_that_is_not_there_is_refused_at_its_place() {
    lab().is_refused(
        SOLUTION,
        &[
            (
                "robot = \"carriage\"\n[tasks.function]",
                "robot = \"cariage\"\n[tasks.function]",
                "lab::unknown_robot",
                "did you mean `carriage`?",
            ),
            (
                "q_rad = [0.4]",
                "q_rad = [0.4, 0.1]",
                "lab::joint_count",
                "joints of the task: slide",
            ),
        ],
    );
}

/// One more task of [`LAB`], with the lab's robot in another size.
const LONG_ARM: &str = r#"
[[tasks]]
name = "long-arm"
title = "The arm, longer"
dimensions = { link_lengths = ["= 0.35 / sin(pi / 6)", 1.2] }
[tasks.function]
call = "forward_kinematics"
cases = [
    { name = "to the right", q_rad = [1.5707963267948966, 0.0] },
    { name = "back", q_rad = [0.0, 3.0] },
]
[[tasks.checks]]
name = "place"
title = "Place"
points = 1
fk-error = { full_m = 1e-9, zero_m = 1e-3 }
"#;

fn longer_arm() -> OwnLab {
    let hidden = "[[draws]]\ntask = \"long-arm\"\nclass = \"other angles\"\ncount = 3\nq_rad = [[-1, 1], [-1, 1]]\n";
    let lab = OwnLab::new("97-robots", format!("{LAB}{LONG_ARM}"))
        .and("hidden.toml", format!("{HIDDEN}{hidden}"))
        .and("solution.rhai", SOLUTION);
    lab.write("labs/robots/carriage.toml", CARRIAGE);
    lab
}

#[test]
fn a_task_may_differ_in_dimensions_alone() {
    let lab = longer_arm();
    let record = lab.record(SOLUTION, 0);
    assert_eq!(record["points"], 5.0, "{record}");
    // a constant of the lab's own robot is wrong in this task, whose links are 0.3 m shorter and 0.2 m longer
    let constant = SOLUTION.replace("robot.link_lengths", "[1.0, 1.0]");
    let record = lab.record(&constant, 1);
    let off = |task: usize| {
        let place = check(&record["tasks"][task], "place");
        place["measure"]["value"].as_f64().expect("a value")
    };
    assert!(off(0) < 1e-12 && off(4) > 0.01, "{record}");
    lab.is_refused(
        SOLUTION,
        &[
            (
                "dimensions = { link_lengths",
                "dimensions = { link_length",
                "lab::dimensions",
                "did you mean `link_lengths`?",
            ),
            (
                "1.2] }\n[tasks.function]",
                "1.2, 3] }\n[tasks.function]",
                "lab::dimensions",
                "link_lengths",
            ),
            (
                "sin(pi / 6)",
                "sine(pi / 6)",
                "lab::expression",
                "did you mean `sin`?",
            ),
            (
                "0.35 / sin(pi / 6)",
                "0.35 / sin(0)",
                "lab::expression",
                "inf",
            ),
        ],
    );
}

#[test]
fn mistakes_of_several_cases_are_reported_together() {
    let lab = longer_arm();
    lab.edit("q_rad = [1.5707963267948966, 0.0]", "q_rad = [1.5]");
    lab.edit(
        "{ name = \"back\", q_rad = [0.0, 3.0] }",
        "{ name = \"back\", position_m = [1, 0, 0] }",
    );
    let ran = lab.grade(SOLUTION);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    for words in [
        "`q_rad` has 1 number for 2 joints",
        "case `back` of `forward_kinematics` is given by `q_rad`",
    ] {
        assert!(
            ran.stderr.contains(words),
            "no {words:?} in\n{}",
            ran.stderr
        );
    }
}
