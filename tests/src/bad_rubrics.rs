//! Rubrics with a fault each, in a lab that has none: `lab check` finds it without a grade, and says where and with which numbers.

use kinemark_grader::audit::{Accepted, Audit, Row, Rubric};
use kinemark_grader::lab::{Lab, Staff};
use kinemark_grader::task::files::Files;

use crate::every_case::every_case;
use crate::own_lab::OwnLab;

const LAB: &str = r#"
format = 1
name = "94-rubric"
title = "A rubric without faults"
robot = "rrbot"
frame = "lab"

[parameters]
out = 1.2

[variants]
out = { from = 1.1, to = 1.3, step = 0.01 }

[[tasks]]
name = "fk"
title = "Forward kinematics"

[tasks.function]
call = "forward_kinematics"
cases = [
    { name = "both bent", q_rad = [0.7, -1.1] },
    { name = "to the left", q_rad = [-0.9, 0.4] },
]

[[tasks.checks]]
name = "position"
title = "The position of the TCP"
points = 4.0
fk-error = { full_m = 1e-4, zero_m = 5e-3 }

[[tasks]]
name = "ik"
title = "Inverse kinematics"

[tasks.function]
call = "inverse_kinematics"
cases = [
    { name = "to the right", position_m = [2.0, 1.4, 0.05] },
    { name = "far away", position_m = [6.0, 1.0, 0.05], branches = 0 },
]

[[tasks.checks]]
name = "reach"
title = "One branch reaches"
points = 2.0
ik-reach = { full_m = 1e-3, zero_m = 1e-2 }

[[tasks]]
name = "touch"
title = "Touch and follow"

[tasks.motion]
mode = "position"
duration_s = 3.0
goals = [{ position_m = [2.5, "= out", 0.05], dwell_s = 0.5 }]
paths = { line = { points_m = [[2.5, 0.8, 0.05], [2.5, 1.2, 0.05]], trim_m = 0.05 } }
servo = { kp = 1000.0, kd = 30.0, derivative = "velocity", gravity_compensation = true, effort_limit = 100.0 }

[[tasks.checks]]
name = "pose"
title = "There"
points = 2.0
pose-reached = { full_m = 0.002, zero_m = 0.02 }

[[tasks.checks]]
name = "time"
title = "In time"
points = 1.0
finish-time = { full_s = 2.0, zero_s = 3.0 }

[[tasks.checks]]
name = "line"
title = "Along the line"
points = 1.0
path-deviation = { path = "line", full_m = 0.008, zero_m = 0.03 }

[[tasks.checks]]
name = "saturation"
title = "Within the motors' limits"
points = 1.0
effort-saturation = { full_s = 0.1, zero_s = 1.0 }

[[tasks]]
name = "push"
title = "Push"

[tasks.motion]
mode = "effort"
duration_s = 1.0
target = { effort_n_m = 2.0 }
grants = ["gravity"]
servo = { effort_limit = 50.0 }

[[tasks.checks]]
name = "peak"
title = "Gently"
points = 1.0
effort-peak = { full_n_m = 10.0, zero_n_m = 20.0 }
"#;

/// A task like the first, before the second.
const AGAIN: &str = r#"[[tasks]]
name = "again"
title = "Forward kinematics again"

[tasks.function]
call = "forward_kinematics"
cases = [
    { name = "both bent", q_rad = [0.7, -1.1] },
    { name = "to the left", q_rad = [-0.9, 0.4] },
]

[[tasks.checks]]
name = "position"
title = "The position of the TCP"
points = 1.0
fk-error = { full_m = 1e-4, zero_m = 5e-3 }

[[tasks]]
name = "ik""#;

const HIDDEN: &str = r#"
format = 1
salt = "a long one that nobody can guess"

[[draws]]
task = "fk"
class = "other angles"
count = 5
q_rad = [[-3.0, 3.0], [-3.0, 3.0]]

[[draws]]
task = "ik"
class = "somewhere within reach"
count = 5
q_rad = [[0.2, 0.9], [0.5, 1.5]]
branches = 2

[[draws]]
task = "ik"
class = "out of reach"
count = 5
position_m = [[4.5, 5.0], [1.0, 2.0], [0.05, 0.05]]
branches = 0

[[runs]]
task = "touch"
class = "another place"
count = 1
parameters = { out = [1.05, 1.25] }
"#;

pub(crate) const BRIEF: &str = "Write `forward_kinematics`, `inverse_kinematics` and `control`. `observation.target.effort_n_m` is in N m; \
                     `robot.gravity(q)` is there in the last task.\n";

const SOLUTION: &str = "fn control(observation) {\n    if observation.task == \"push\" { return [observation.target.effort_n_m, 0.0]; }\n    [0.0, 0.0]\n}\n";

pub(crate) fn own_lab() -> OwnLab {
    OwnLab::new("94-rubric", LAB)
        .and("hidden.toml", HIDDEN)
        .and("solution.rhai", SOLUTION)
}

pub(crate) fn staff_of(own: &OwnLab, lab: &Lab) -> Staff {
    own.staff(lab).expect("the course staff's part")
}

/// The rows of the rules that need no grade.
pub(crate) fn rows(own: &OwnLab, brief: &str, accepted: &Accepted) -> Vec<Row> {
    let lab = own.lab();
    let staff = staff_of(own, &lab);
    let salt = Staff::salt(own as &dyn Files, &lab.name, None).expect("hidden.toml");
    let known = [(
        "kinemark-01-kinematics".to_owned(),
        "the shipped lab `01-kinematics`".to_owned(),
    )];
    let mut audit = Audit::new(&lab);
    audit.rubric(
        &Rubric {
            lab: &lab,
            staff: &staff,
            salt: salt.as_deref(),
            known_salts: &known,
            brief: Some(brief),
            starter: None,
            zeros: None,
            played_back: None,
            reference: None,
            finer: None,
            mutants: &[],
            moved_bodies: &[],
            margins: &[],
            corners: None,
        },
        accepted,
    );
    audit.rows
}

pub(crate) fn problems(rows: &[Row]) -> Vec<(String, String)> {
    let bad = rows
        .iter()
        .filter_map(|row| Some((row, row.problem.clone()?)));
    bad.map(|(row, problem)| (row.name.clone(), problem))
        .collect()
}

#[test]
fn a_rubric_without_faults_raises_no_doubt() {
    let found = rows(&own_lab(), BRIEF, &Accepted::default());
    assert_eq!(problems(&found), [], "{found:#?}");
    assert!(found.len() >= 12, "a row for every rule: {found:#?}");
}

#[test]
fn every_fault_is_found_with_its_place_and_numbers() {
    // file, from, to; rule, words
    let faults = [
        (
            "lab.toml",
            "full_s = 0.1, zero_s = 1.0",
            "full_s = 100.0, zero_s = 200.0",
            "band",
            "touch/saturation: all points up to 100 s",
        ),
        (
            "lab.toml",
            "full_s = 2.0, zero_s = 3.0",
            "full_s = 100.0, zero_s = 200.0",
            "band",
            "the whole run takes 3 s",
        ),
        (
            "lab.toml",
            "full_m = 0.008, zero_m = 0.03",
            "full_m = 1.0, zero_m = 2.0",
            "band",
            "touch/line: all points up to 1.000 m",
        ),
        (
            "lab.toml",
            "full_m = 0.002, zero_m = 0.02",
            "full_m = 0.6, zero_m = 1.0",
            "band",
            "touch/pose",
        ),
        (
            "lab.toml",
            "full_m = 1e-4, zero_m = 5e-3",
            "full_m = 0.7, zero_m = 1.0",
            "band",
            "fk/position",
        ),
        (
            "lab.toml",
            "full_n_m = 10.0, zero_n_m = 20.0",
            "full_n_m = 60.0, zero_n_m = 80.0",
            "band",
            "no effort is greater than 50 N m",
        ),
        (
            "lab.toml",
            "position_m = [2.5, \"= out\", 0.05]",
            "position_m = [4.5, \"= out\", 0.05]",
            "reach",
            "touch/goal 1: [4.5, 1.2, 0.05] is out of reach by",
        ),
        (
            "lab.toml",
            "position_m = [2.5, \"= out\", 0.05]",
            "position_m = [3.6, \"= out\", 0.05]",
            "reach",
            "nearly singular",
        ),
        (
            "lab.toml",
            "[2.5, 1.2, 0.05]], trim_m",
            "[2.5, 3.0, 0.05]], trim_m",
            "reach",
            "touch/line: [",
        ),
        (
            "lab.toml",
            "position_m = [2.0, 1.4, 0.05] }",
            "position_m = [2.0, 1.4, 0.05], branches = 1 }",
            "branches",
            "2 branches reach [2, 1.4, 0.05]",
        ),
        (
            "lab.toml",
            "position_m = [6.0, 1.0, 0.05], branches = 0",
            "position_m = [6.0, 1.0, 0.05]",
            "branches",
            "ik/far away: [6, 1, 0.05] is out of reach by",
        ),
        (
            "lab.toml",
            "position_m = [6.0, 1.0, 0.05], branches = 0",
            "position_m = [2.5, 1.0, 0.05], branches = 0",
            "branches",
            "and 0 are stated",
        ),
        (
            "lab.toml",
            "{ name = \"to the left\", q_rad = [-0.9, 0.4] }",
            "{ name = \"again\", q_rad = [0.7, -1.1] }",
            "cases",
            "fk/again: the same numbers as case \"both bent\"",
        ),
        (
            "lab.toml",
            "[parameters]\nout = 1.2",
            "[parameters]\nout = 1.2\nin = 0.3",
            "unused",
            "in: no expression",
        ),
        (
            "lab.toml",
            "\"= out\"",
            "1.2",
            "unused",
            "differs from student to student",
        ),
        (
            "lab.toml",
            "path-deviation = { path = \"line\", full_m = 0.008, zero_m = 0.03 }",
            "overshoot = { full = 0.01, zero = 0.1 }",
            "unused",
            "touch/line: no check follows this path",
        ),
        (
            "lab.toml",
            "duration_s = 3.0\n",
            "duration_s = 3.0\nsensors = [{ name = \"spare\", type = \"joint-position\", joint = \"elbow\" }]\n",
            "unused",
            "touch/spare: no check names this sensor",
        ),
        (
            "lab.toml",
            "servo = { effort_limit = 50.0 }",
            "servo = { kp = 10.0, effort_limit = 50.0 }",
            "settings",
            "push/servo: kp, ki and kd do nothing",
        ),
        (
            "lab.toml",
            "target = { effort_n_m = 2.0 }",
            "target = { effort_n_m = 2.0, speed_m_s = 1.0 }",
            "brief",
            "does not mention `speed_m_s`",
        ),
        (
            "lab.toml",
            "grants = [\"gravity\"]",
            "grants = [\"gravity\", \"mass_matrix\"]",
            "brief",
            "`mass_matrix`, which task \"Push\" lends",
        ),
        (
            "hidden.toml",
            "parameters = { out = [1.05, 1.25] }",
            "parameters = { out = [1.2, 1.2] }",
            "hidden",
            "touch/another place: run 1 of the class has the numbers of the visible one",
        ),
        (
            "hidden.toml",
            "q_rad = [[-3.0, 3.0], [-3.0, 3.0]]",
            "q_rad = [[0.3, 0.3], [0.5, 0.5]]",
            "hidden",
            "its ranges have no width",
        ),
        (
            "hidden.toml",
            "count = 5\nq_rad = [[-3.0, 3.0], [-3.0, 3.0]]",
            "count = 1\nq_rad = [[0.7, 0.7], [-1.1, -1.1]]",
            "hidden",
            "a hidden case has the numbers of a visible one",
        ),
        (
            "hidden.toml",
            "position_m = [[4.5, 5.0], [1.0, 2.0], [0.05, 0.05]]",
            "position_m = [[2.5, 5.0], [1.0, 2.0], [0.05, 0.05]]",
            "branches",
            "ik/out of reach",
        ),
        (
            "hidden.toml",
            "q_rad = [[0.2, 0.9], [0.5, 1.5]]\nbranches = 2",
            "q_rad = [[0.2, 0.9], [0.5, 1.5]]\nbranches = 1",
            "branches",
            "ik/somewhere within reach: 2 branches reach",
        ),
        (
            "hidden.toml",
            "[[draws]]\ntask = \"fk\"\nclass = \"other angles\"\ncount = 5\nq_rad = [[-3.0, 3.0], [-3.0, 3.0]]\n",
            "",
            "hidden",
            "fk: it has no hidden cases",
        ),
        (
            "hidden.toml",
            "[[runs]]\ntask = \"touch\"\nclass = \"another place\"\ncount = 1\nparameters = { out = [1.05, 1.25] }\n",
            "",
            "hidden",
            "touch: it has no hidden runs",
        ),
        (
            "lab.toml",
            "fk-error = { full_m = 1e-4, zero_m = 5e-3 }\n",
            "fk-error = { full_m = 1e-4, zero_m = 5e-3 }\n\n[[tasks.checks]]\nname = \"again\"\ntitle = \"Again\"\n\
             points = 1.0\nfk-error = { full_m = 1e-4, zero_m = 5e-3 }\n",
            "cases",
            "fk/again: it measures what check `position` does",
        ),
        (
            "lab.toml",
            "title = \"Gently\"",
            "title = \"TODO: gently\"",
            "names",
            "push/peak: it still says TODO",
        ),
        (
            "lab.toml",
            "title = \"One branch reaches\"",
            "title = \"One branch reaches\"\nhints = [\"Which of `robot.lengths` do you use?\"]",
            "names",
            "ik/reach: it mentions `robot.lengths`, which there is not",
        ),
        (
            "lab.toml",
            "title = \"Gently\"",
            "title = \"Gently\"\nhints = [\"How far is `target.effort` from what you command?\"]",
            "names",
            "push/peak: it mentions `target.effort`, which there is not",
        ),
        (
            "hidden.toml",
            "q_rad = [[-3.0, 3.0], [-3.0, 3.0]]",
            "q_rad = [[-180.0, 180.0], [-180.0, 180.0]]",
            "reach",
            "fk/other angles: at [",
        ),
        (
            "hidden.toml",
            "[[draws]]\n",
            "[[draws]]\ntask = \"fk\"\nclass = \"other angles\"\ncount = 5\nq_rad = [[-3.0, 3.0], [-3.0, 3.0]]\n\n[[draws]]\n",
            "hidden",
            "fk/other angles: it draws the numbers of a draw before it",
        ),
        (
            "hidden.toml",
            "a long one that nobody can guess",
            "a",
            "salt",
            "1 of at least 12 characters",
        ),
        (
            "hidden.toml",
            "a long one that nobody can guess",
            "kinemark-01-kinematics",
            "salt",
            "others know it",
        ),
        (
            "hidden.toml",
            "out = [1.05, 1.25]",
            "out = [1.05, 2.0]",
            "reach",
            "touch/goal 1 in class \"another place\": [2.5, 2, 0.05] is out of reach",
        ),
        (
            "hidden.toml",
            "[[draws]]\n",
            "[[draws]]\ntask = \"fk\"\nclass = \"many\"\ncount = 95\nq_rad = [[-2.0, 2.0], [-2.0, 2.0]]\n\n[[draws]]\n",
            "hidden",
            "fk/many: 95 of the 100 hidden cases of the task are of this class",
        ),
        (
            "hidden.toml",
            "q_rad = [[-3.0, 3.0], [-3.0, 3.0]]",
            "q_rad = [[0.3, 0.3], [0.5, 0.5]]\ndimensions = { link_lengths = [[0.7, 0.9], [1.1, 1.3]] }",
            "hidden",
            "fk/other angles: the joints are at the same positions in all of its cases",
        ),
        (
            "lab.toml",
            "duration_s = 3.0\n",
            "duration_s = 3.0\nsensors = [{ name = \"end\", type = \"limit-switch\", joint = \"elbow\", side = \"upper\", at = 1.0, hysteresis = 2.0 }]\n",
            "settings",
            "touch/end: its hysteresis is 2, and joint `elbow` moves by 12.",
        ),
        (
            "lab.toml",
            "trim_m = 0.05",
            "trim_m = 0.16",
            "goals",
            "touch/line: `trim_m` leaves 80.0 mm of a segment of 0.400 m",
        ),
        (
            "hidden.toml",
            "a long one that nobody can guess",
            "abababababababab",
            "salt",
            "the salt is a few signs again and again",
        ),
        (
            "hidden.toml",
            "a long one that nobody can guess",
            "1234567890123",
            "salt",
            "the salt is digits in a row",
        ),
        (
            "lab.toml",
            "out = { from = 1.1, to = 1.3, step = 0.01 }",
            "out = { from = 1.25, to = 1.3, step = 0.01 }",
            "variants",
            "out: lab.toml has 1.2, and students get 1.25 to 1.3",
        ),
        (
            "hidden.toml",
            "class = \"other angles\"",
            "class = \"other angles\"\ndimensions = { link_lengths = [[1.0, 1.0], [1.0, 1.0]] }",
            "hidden",
            "fk/other angles: the dimensions that it draws are the robot's own",
        ),
        (
            "lab.toml",
            "\"= out\"",
            "1.2",
            "hidden",
            "touch/another place: run 1 of the class has the numbers of the visible one",
        ),
        (
            "lab.toml",
            "target = { effort_n_m = 2.0 }",
            "target = { effort_n_m = 2.0, effort_limit = 40.0 }",
            "settings",
            "push/effort_limit: the target gives students another `effort_limit` than the servo has, [50, 50]",
        ),
        (
            "lab.toml",
            "target = { effort_n_m = 2.0 }",
            "target = { effort_n_m = 2.0, place_m = [1.0, 2.0] }",
            "unused",
            "target.place_m: neither the solution nor a mutant reads this key",
        ),
        (
            "lab.toml",
            "full_m = 1e-4, zero_m = 5e-3",
            "full_m = 1e-4, zero_m = 50.0",
            "band",
            "fk/position: no points from 50.000 m on",
        ),
        (
            "lab.toml",
            "effort-peak = { full_n_m = 10.0, zero_n_m = 20.0 }",
            "effort-peak = { full_n_m = 50.0, zero_n_m = 60.0 }",
            "band",
            "push/peak: all points up to 50 N m",
        ),
        (
            "lab.toml",
            "title = \"Gently\"\npoints = 1.0\neffort-peak = { full_n_m",
            "title = \"The shoulder is gentle\"\npoints = 1.0\neffort-peak = { joint = \"elbow\", full_n_m",
            "words",
            "push/peak: \"The shoulder is gentle\" is about `shoulder`, and reads the joint `elbow`",
        ),
        (
            "lab.toml",
            "servo = { kp = 1000.0",
            "start_rad = [0.0, 7.0]\nservo = { kp = 1000.0",
            "reach",
            "touch/start: the run starts at [0, 7]: joint `elbow` would be at 7 rad",
        ),
        (
            "lab.toml",
            "dwell_s = 0.5 }]",
            "dwell_s = 0.5 }, { position_m = [2.5, 1.21, 0.05], dwell_s = 0.5 }]",
            "goals",
            "touch/goal 2: it is 10.0 mm from the goal before it, and check `pose` gives points up to 20.0 mm",
        ),
        (
            "lab.toml",
            "dwell_s = 0.5 }]",
            "dwell_s = 0.02 }]",
            "goals",
            "touch/goal 1: `dwell_s` is 0.02 s, less than 3 control periods of 0.01 s",
        ),
        (
            "lab.toml",
            "duration_s = 3.0\n",
            "duration_s = 3.0\ntarget = { line_m = [[2.5, 0.8], [2.5, 1.1]] }\n",
            "goals",
            "touch/line_m: students are given point 2 at [2.5, 1.1], and checks follow path `line`",
        ),
        (
            "lab.toml",
            "out = { from = 1.1, to = 1.3, step = 0.01 }",
            "out = { from = 1.2, to = 1.2, step = 0.01 }",
            "variants",
            "out: its range has no width",
        ),
        (
            "lab.toml",
            "out = { from = 1.1, to = 1.3, step = 0.01 }",
            "out = { choices = [1.1, 1.2, 1.1] }",
            "variants",
            "out: the choice 1.1 is there twice",
        ),
        (
            "lab.toml",
            "[[tasks]]\nname = \"ik\"",
            AGAIN,
            "cases",
            "again: it calls the function of task `fk` with the same cases",
        ),
        (
            "lab.toml",
            "position_m = [2.5, \"= out\", 0.05], dwell_s = 0.5 }]",
            "position_m = [3.99, 0.01, 0.05], dwell_s = 0.5 }]",
            "goals",
            "touch/goal 1: the arm starts 14.1 mm from it, and check `pose` gives points up to 20.0 mm",
        ),
        (
            "hidden.toml",
            "out = [1.05, 1.25]",
            "out = [3.9, 3.95]",
            "reach",
            "touch/goal 1 in class \"another place\": [2.5, 3.9",
        ),
        (
            "lab.toml",
            "robot = \"rrbot\"",
            "robot = \"rrbot\"\nkept_after_stop = 0.08",
            "settings",
            "kept_after_stop: who stops once",
        ),
        (
            "lab.toml",
            "title = \"In time\"",
            "title = \"There\"",
            "cases",
            "touch/time: it has the title of check `pose`",
        ),
        (
            "lab.toml",
            "gravity_compensation = true, effort_limit = 100.0 }",
            "gravity_compensation = true, effort_limit = [100.0, 200.0] }",
            "settings",
            "touch/servo: `effort_limit` gives joint `elbow` 200, and the robot's own limit is 100",
        ),
        (
            "lab.toml",
            "ik-reach = { full_m = 1e-3, zero_m = 1e-2 }\n",
            "ik-reach = { full_m = 1e-3, zero_m = 1e-2 }\n\n[[tasks.checks]]\nname = \"both\"\ntitle = \"Both branches\"\n\
             points = 1.0\nik-branches = { full_m = 0.1, zero_m = 1.0 }\n",
            "band",
            "ik/both: a branch may be 0.1 m off, and `ik/reach` gives all points up to 0.001 m",
        ),
        (
            "lab.toml",
            "path-deviation = { path = \"line\", full_m = 0.008, zero_m = 0.03 }",
            "path-coverage = { path = \"line\", within_m = 0.02, full = 0.3, zero = 0.1 }",
            "band",
            "touch/line: all points for 0.3 of the path",
        ),
        (
            "lab.toml",
            "path-deviation = { path = \"line\", full_m = 0.008, zero_m = 0.03 }",
            "path-deviation = { path = \"line\", full_m = 0.008, zero_m = 0.03 }\n\n[[tasks.checks]]\nname = \"whole\"\n\
             title = \"The whole line\"\npoints = 1.0\npath-coverage = { path = \"line\", within_m = 0.2, full = 0.9, zero = 0.1 }",
            "band",
            "touch/whole: what is within 0.2 m of the path counts, and at 0.03 m nothing is earned",
        ),
        (
            "lab.toml",
            "title = \"There\"\npoints = 2.0",
            "title = \"There\"\npoints = 20.0",
            "points",
            "touch/pose: 20 of 30 points, more than half of all",
        ),
        (
            "lab.toml",
            "title = \"There\"\npoints = 2.0",
            "title = \"There\"\npoints = 0.02",
            "points",
            "touch/pose: 0.02 of 10.02 points, less than a hundredth of all",
        ),
        (
            "lab.toml",
            "title = \"In time\"",
            "title = \"In 5 s\"",
            "words",
            "touch/time: \"In 5 s\" says 5 s, and the check has 2 s and 3 s",
        ),
        (
            "lab.toml",
            "title = \"There\"",
            "title = \"There\"\nhints = [\"Is the TCP within 2 cm, in its best 0.5 s?\", \"It should be within 20 cm.\"]",
            "words",
            "touch/pose: a hint says 0.200 m, and the check has 20.0 mm",
        ),
        (
            "lab.toml",
            "full_m = 1e-4, zero_m = 5e-3",
            "full_m = 1e-15, zero_m = 5e-3",
            "band",
            "fk/position: `full_m` is 0.000000000000001: two right ways",
        ),
    ];
    let faults: Vec<_> = faults
        .iter()
        .map(|fault| (fault.2.to_owned(), *fault))
        .collect();
    every_case(&faults, |&(file, from, to, rule, words)| {
        let found = problems(&rows(
            &own_lab().with(file, from, to),
            BRIEF,
            &Accepted::default(),
        ));
        let hit = |(name, problem): &(String, String)| name == rule && problem.contains(words);
        assert!(found.iter().any(hit), "{rule}, {words}: {found:#?}");
    });
}

/// An angle of a joint may be more than half a turn, an orientation cannot.
#[test]
fn an_orientation_that_loses_points_beyond_half_a_turn_alone_is_doubted() {
    for (zero_rad, count) in [(5.0, 1), (3.0, 0)] {
        let own = own_lab()
            .with(
                "lab.toml",
                "call = \"forward_kinematics\"",
                "call = \"forward_kinematics\"\npose = \"full\"",
            )
            .with(
                "lab.toml",
                "fk-error = { full_m = 1e-4, zero_m = 5e-3 }",
                &format!("fk-orientation = {{ full_rad = 1e-4, zero_rad = {zero_rad:.1} }}"),
            );
        let found = problems(&rows(&own, BRIEF, &Accepted::default()));
        let of_band: Vec<_> = found.iter().filter(|(rule, _)| rule == "band").collect();
        assert_eq!(of_band.len(), count, "{found:#?}");
        let words = "fk/position: no points from 5 rad on, and nothing is turned away by more than half a turn";
        assert!(
            of_band
                .iter()
                .all(|(_, problem)| problem.starts_with(words))
        );
    }
}

#[test]
fn hints_of_another_check_are_doubted() {
    let hints = "hints = [\"When does it arrive?\"]\n";
    let own = own_lab()
        .with(
            "lab.toml",
            "finish-time =",
            &format!("{hints}finish-time ="),
        )
        .with(
            "lab.toml",
            "effort-saturation =",
            &format!("{hints}effort-saturation ="),
        );
    let found = problems(&rows(&own, BRIEF, &Accepted::default()));
    let words =
        "touch/saturation: its hints are those of touch/time, which measures something else";
    assert!(
        found
            .iter()
            .any(|(rule, problem)| rule == "words" && problem.starts_with(words)),
        "{found:#?}"
    );
}

#[test]
fn a_doubt_is_accepted_with_a_reason_and_an_idle_entry_is_a_problem() {
    let faulty = own_lab().with("hidden.toml", "a long one that nobody can guess", "a");
    let entry = |rule: &str, because: &str| {
        format!(
            "format = 1\n[[accepted]]\nrule = \"{rule}\"\nof = \"salt\"\nbecause = \"{because}\"\n"
        )
    };
    let load = |own: OwnLab| {
        let lab = own.lab();
        Accepted::load(&own, &lab).map(|accepted| problems(&rows(&own, BRIEF, &accepted)))
    };
    let accepted = faulty.and("accepted.toml", entry("salt", "a test"));
    assert_eq!(load(accepted).expect("a file"), []);
    let idle = own_lab().and("accepted.toml", entry("salt", "a test"));
    let found = load(idle).expect("a file");
    assert!(found[0].1.contains("nobody doubts it"), "{found:?}");
    for (rule, because, words) in [("sald", "a test", "UnknownRule"), ("salt", " ", "NoReason")] {
        let error = load(own_lab().and("accepted.toml", entry(rule, because))).expect_err(words);
        assert!(format!("{error:?}").contains(words), "{error:?}");
    }
}

#[test]
fn commands_that_do_nothing_are_doubted() {
    let own = own_lab().with(
        "lab.toml",
        "kp = 1000.0, kd = 30.0, derivative = \"velocity\", ",
        "",
    );
    let found = problems(&rows(&own, BRIEF, &Accepted::default()));
    let words = "touch/servo: kp, ki and kd are zero for every joint: a command does nothing";
    let hit = |(rule, what): &(String, String)| rule == "settings" && what == words;
    assert!(found.iter().any(hit), "{found:#?}");
}

#[test]
fn gravity_that_pulls_sideways_is_doubted() {
    for (gravity, count) in [("[-9.81, 0.0, 0.0]", 1), ("[1.0, 0.0, -1.6]", 0)] {
        let own = own_lab().with(
            "lab.toml",
            "target = { effort_n_m = 2.0 }\n",
            &format!("target = {{ effort_n_m = 2.0 }}\ngravity_m_s2 = {gravity}\n"),
        );
        let found = problems(&rows(&own, BRIEF, &Accepted::default()));
        let words = "push/gravity_m_s2: gravity is [-9.81, 0, 0] in the world, where z is up";
        let hits = found
            .iter()
            .filter(|(rule, what)| rule == "settings" && what.starts_with(words));
        assert_eq!(hits.count(), count, "{found:#?}");
    }
}

#[test]
fn a_level_with_the_damping_that_is_there_is_refused() {
    let own = own_lab().with(
        "lab.toml",
        "[[tasks]]\nname = \"push\"",
        "[[tasks.checks]]\nname = \"still\"\ntitle = \"Still there\"\npoints = 1.0\n\
         robustness = { check = \"pose\", rungs = [{ name = \"as-it-is\", damping = 1.0 }] }\n\n[[tasks]]\nname = \"push\"",
    );
    let error = own.load().expect_err("a level that does nothing");
    let error = format!("{error:?}");
    assert!(
        error.contains("Nothing") || error.contains("NoDamping"),
        "{error}"
    );
}
