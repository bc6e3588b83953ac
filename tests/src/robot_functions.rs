//! Function tasks that know the robot: poses, quantities of motion and efforts, other robots a case, functions of a lab's own with the
//! robot. What is right comes from the engine; the submissions here are worked by hand.

use kinemark_grader::record::verdict::Verdict;
use kinemark_report::text::text;

use crate::own_lab::OwnLab;
use crate::testbed::grade;

/// A turntable with an arm that slides: `x = (1 + q2) cos q1`, `y = (1 + q2) sin q1`, and the tip half a metre above 2 m.
const LAB: &str = r#"
format = 1
name = "94-robot"
title = "Functions of the robot"
robot = "RzTx"
dimensions = { base_height = 2.0, link1 = [1.0, 0.0, 0.0], link2 = [0.0, 0.0, 0.5] }

[[tasks]]
name = "asked"
title = "Asked"

[tasks.function]
FUNCTION

[[tasks.checks]]
name = "right"
title = "It is right"
points = 4.0
CHECK
"#;

fn own_lab(function: &str, check: &str) -> OwnLab {
    let text = LAB.replace("FUNCTION", function).replace("CHECK", check);
    OwnLab::new("94-robot", text)
}

const CASES: &str =
    "cases = [{ name = \"a\", q_rad = [0.0, 0.0] }, { name = \"b\", q_rad = [2.0, 0.25] }]";
const CASES_OF_MOTION: &str = "cases = [{ name = \"a\", q_rad = [0.4, 0.1], qd_rad_s = [0.5, -0.2], qdd_rad_s2 = [0.3, 0.7] }]";
const NUMBERS: &str = "function-cases = { full = 1e-9, zero = 1e-6 }";

/// What a submission earns of 4 points, and its verdict.
fn points(function: &str, check: &str, submission: &str) -> (f64, Verdict, String) {
    let lab = own_lab(function, check).lab();
    let grade = grade(&lab, None, "mine.rhai", submission).grade;
    (grade.points, grade.verdict, text(&grade))
}

#[test]
fn what_is_worked_by_hand_is_right() {
    let turn = "let c = cos(q[0]); let s = sin(q[0]); let r = 1 + q[1];";
    let reach = "fk-error = { full_m = 1e-12, zero_m = 1e-9 }";
    let turned = "fk-orientation = { full_rad = 1e-7, zero_rad = 1e-6 }";
    let rest = "[[c, -s, 0, r * c], [s, c, 0, r * s], [0, 0, 1, HEIGHT], [0, 0, 0, 1]]";
    let rates = "let v = qd[1]; let w = qd[0];";
    for (function, check, answer) in [
        (
            format!("call = \"forward_kinematics\"\n{CASES}"),
            reach,
            format!("fn forward_kinematics(robot, q) {{ {turn} [r * c, r * s, 2.5] }}"),
        ),
        (
            format!("call = \"forward_kinematics\"\npose = \"full\"\n{CASES}"),
            turned,
            format!(
                "fn forward_kinematics(robot, q) {{ {turn} {} }}",
                rest.replace("HEIGHT", "2.5")
            ),
        ),
        // the last joint, which the tip is half a metre above
        (
            format!(
                "call = \"forward_kinematics\"\nas = \"last_joint\"\nframe = \"link2\"\npose = \"full\"\n{CASES}"
            ),
            reach,
            format!(
                "fn last_joint(robot, q) {{ {turn} {} }}",
                rest.replace("HEIGHT", "2")
            ),
        ),
        (
            format!("call = \"forward_kinematics\"\nas = \"heading\"\npose = \"yaw\"\n{CASES}"),
            turned,
            format!("fn heading(robot, q) {{ {turn} [r * c, r * s, 2.5, q[0] - 2 * PI] }}"),
        ),
        // the length of an axis makes no difference
        (
            format!("call = \"forward_kinematics\"\npose = \"axis\"\naxis = [0, 3, 0]\n{CASES}"),
            turned,
            format!(
                "fn forward_kinematics(robot, q) {{ {turn} [r * c, r * s, 2.5, -5 * s, 5 * c, 0] }}"
            ),
        ),
        (
            "call = \"velocity\"\nrows = [\"x\", \"y\", \"rz\"]\n".to_owned()
                + CASES_OF_MOTION
                    .replace(", qdd_rad_s2 = [0.3, 0.7]", "")
                    .as_str(),
            NUMBERS,
            format!(
                "fn velocity(robot, q, qd) {{ {turn} {rates} [v * c - r * w * s, v * s + r * w * c, w] }}"
            ),
        ),
        (
            format!("call = \"acceleration\"\nrows = [\"x\", \"y\", \"rz\"]\n{CASES_OF_MOTION}"),
            NUMBERS,
            format!(
                "fn acceleration(robot, q, qd, qdd) {{ {turn} {rates} let along = qdd[1] - r * w * w; let across = r * qdd[0] + 2 * v * w;\n\
                 [along * c - across * s, along * s + across * c, qdd[0]] }}"
            ),
        ),
        // nothing weighs on a turntable, and what slides on it is level
        (
            format!("call = \"gravity\"\nleast_size = 1.0\n{CASES}"),
            NUMBERS,
            "fn gravity(robot, q) { [0, 0] }".to_owned(),
        ),
        (
            "call = \"coriolis\"\n".to_owned()
                + CASES_OF_MOTION
                    .replace(", qdd_rad_s2 = [0.3, 0.7]", "")
                    .as_str(),
            "function-cases = { full = 1e-3, zero = 1e-2 }",
            // a rod of half a metre, upright at the end of the arm, and an arm that turns without sliding
            format!(
                "fn coriolis(robot, q, qd) {{ {turn} let m = robot.density * PI * 0.06 ** 2 * 0.5; [2 * m * r * qd[0] * qd[1], -m * r * qd[0] ** 2] }}"
            ),
        ),
    ] {
        let (points, verdict, text) = points(&function, check, &answer);
        assert_eq!(
            (points, verdict),
            (4.0, Verdict::Passed),
            "{function}\n{text}"
        );
    }
}

/// A pendulum that another row of joints is in one case: the efforts of a rod of one metre, by hand.
#[test]
fn a_case_may_have_a_robot_of_its_own() {
    let function = "call = \"torque\"\ncases = [\n\
        { name = \"pendulum\", robot = \"Ry\", dimensions = { base_height = 0, link1 = [0, 0, 1] }, q_rad = [0.3], qd_rad_s = [0.0], qdd_rad_s2 = [2.0] },\n\
        { name = \"thick\", robot = \"Ry\", dimensions = { base_height = 0, link1 = [0, 0, 2], density = 1000 }, q_rad = [-0.7], qd_rad_s = [1.0], qdd_rad_s2 = [0.0] },\n\
        { name = \"slide\", robot = \"Tz\", dimensions = { base_height = 0, link1 = [0, 0, 1] }, q_rad = [0.3], qd_rad_s = [0.0], qdd_rad_s2 = [2.0] }]";
    let submission = r#"
        fn torque(robot, q, qd, qdd) {
            let l = robot.link1.z;
            let radius = 0.03 * l;
            let m = robot.density * PI * radius ** 2 * l;
            let g = 9.81;
            if robot.name == "Tz" { return [m * (qdd[0] + g)]; }
            let inertia = m * (3 * radius ** 2 + l ** 2) / 12 + m * l ** 2 / 4;
            [inertia * qdd[0] - m * g * l / 2 * sin(q[0])]
        }"#;
    let (earned, verdict, text) = points(function, NUMBERS, submission);
    assert_eq!((earned, verdict), (4.0, Verdict::Passed), "{text}");
    // standard gravity is another number
    let (earned, _, text) = points(function, NUMBERS, &submission.replace("9.81", "9.80665"));
    assert_eq!(earned, 0.0);
    assert!(
        text.contains("the answer is") && text.contains("should be"),
        "{text}"
    );
    let moon = format!("{function}\ngravity_m_s2 = [0, 0, -1.62]");
    let (earned, ..) = points(&moon, NUMBERS, &submission.replace("9.81", "1.62"));
    assert_eq!(earned, 4.0);
}

#[test]
fn branches_of_poses_are_held_to_their_orientation() {
    let function = "call = \"inverse_kinematics\"\npose = \"yaw\"\ncases = [\n\
        { name = \"there\", position_m = [0.0, 1.5, 2.5], yaw_deg = 90.0, branches = 1 }]";
    let reach = "ik-reach = { full_m = 1e-6, zero_m = 1e-3, full_rad = 1e-6, zero_rad = 0.2 }";
    for (answer, expected) in [
        ("[pose[3], norm(pose[0..2]) - 1]", 4.0),
        // backwards, half a turn away: there, and the wrong way round
        ("[pose[3] + PI, -norm(pose[0..2]) - 1]", 0.0),
        ("[pose[3] - 0.1, norm(pose[0..2]) - 1]", 0.0),
    ] {
        let answer = answer.replace("pose[0..2]", "[pose[0], pose[1]]");
        let submission = format!("fn inverse_kinematics(robot, pose) {{ [{answer}] }}");
        let (earned, _, text) = points(function, reach, &submission);
        assert_eq!(earned, expected, "{answer}\n{text}");
    }
    let (_, _, text) = points(
        function,
        reach,
        "fn inverse_kinematics(robot, pose) { [pose[3] + PI, -2.5] }",
    );
    assert!(text.contains("turned 3.14"), "{text}");
}

/// Beside the only branch of a target, a wrong one costs; the right one alone, or twice as where an arm is stretched, is what `ik-reach` is about.
#[test]
fn a_wrong_branch_beside_the_only_one_costs() {
    let function = "call = \"inverse_kinematics\"\ncases = [\n\
        { name = \"two\", position_m = [0.0, 1.5, 2.5], branches = 2 },\n\
        { name = \"one\", position_m = [0.0, -1.5, 2.5], branches = 1 }]";
    let check = "ik-branches = { full_m = 1e-6, zero_m = 1e-3 }";
    let good = "[PI / 2, 0.5], [-PI / 2, -2.5]";
    for (one, expected) in [
        ("[-PI / 2, 0.5]", 4.0),
        ("[-PI / 2, 0.5], [-PI / 2, 0.5]", 4.0),
        ("[-PI / 2, 0.5], [0.3, 0.4]", 2.0),
        ("[0.3, 0.4]", 4.0),
    ] {
        let submission = format!(
            "fn inverse_kinematics(robot, target) {{ if target[1] > 0 {{ [{good}] }} else {{ [{one}] }} }}"
        );
        let (earned, _, text) = points(function, check, &submission);
        assert_eq!(earned, expected, "{one}\n{text}");
    }
}

/// The puma's first joint alone moves the elbow around: its wrist is neither given nor asked.
#[test]
fn joints_that_are_ignored_have_no_number() {
    let function = "call = \"jacobian\"\nignore = [IGNORED]\nrows = [\"x\", \"y\", \"z\"]\ncases = [{ name = \"a\", q_rad = [0.2, 0.1, -0.4] }]";
    let lab = |ignored: &str| {
        let lab = own_lab(
            &function.replace("IGNORED", ignored),
            "jacobian-match = { full = 1e-9, zero = 1e-6 }",
        );
        lab.with("lab.toml", "robot = \"RzTx\"\ndimensions = { base_height = 2.0, link1 = [1.0, 0.0, 0.0], link2 = [0.0, 0.0, 0.5] }", "robot = \"puma560\"")
    };
    let lab_of_wrist = lab("\"wrist_roll\", \"wrist_pitch\", \"wrist_yaw\"");
    let submission = "fn jacobian(robot, q) { if len(q) != 3 || robot.joints != 3 || len(robot.lower) != 3 { throw \"other joints\" } [[0, 0, 0], [0, 0, 0], [0, 0, 0]] }";
    let loaded = lab_of_wrist.lab();
    let graded = grade(&loaded, None, "mine.rhai", submission).grade;
    assert_eq!(graded.verdict, Verdict::Missed, "{}", text(&graded));
    let error = lab("\"joint9\"").load().expect_err("no such joint");
    assert!(error.to_string().contains("no joint `joint9`"), "{error}");
}

/// Two joints of a robot with loops follow the others: they are in no argument.
#[test]
fn loops_are_closed_from_the_independent_joints() {
    let lab = own_lab(
        "call = \"gravity\"\ncases = [{ name = \"a\", q_rad = [0.2, 0.4, 0.3] }]",
        NUMBERS,
    )
    .with("lab.toml", "robot = \"RzTx\"\ndimensions = { base_height = 2.0, link1 = [1.0, 0.0, 0.0], link2 = [0.0, 0.0, 0.5] }", "robot = \"uarm\"");
    let submission = "fn gravity(robot, q) { if len(q) != 3 || robot.joint_names.len() != 3 { throw \"other joints\" } [0, 0, 0] }";
    let graded = grade(&lab.lab(), None, "mine.rhai", submission).grade;
    assert_eq!(graded.verdict, Verdict::Missed, "{}", text(&graded));
    let error = lab
        .with("lab.toml", "[0.2, 0.4, 0.3]", "[0.2, 0.4, 0.3, 0.1, 0.1]")
        .load()
        .expect_err("five numbers");
    assert!(
        error.to_string().contains("5 numbers for 3 joints"),
        "{error}"
    );
}

#[test]
fn a_function_of_the_lab_may_have_robot_matrices_and_angles() {
    let function = r#"call = "look_at"
with_robot = true
turns = ["yaw"]
least_size = 0.5
cases = [
    { name = "left", given = { eye = [[1, 0], [0, 1]] }, expected = { yaw = 3.1, size = 0.001, m = [[2, 0], [0, 2]] } },
    { name = "high", dimensions = { base_height = 3.0 }, given = { eye = [[1, 0], [0, 1]] }, expected = { yaw = 3.1, size = 0.001, m = [[3, 0], [0, 3]] } },
]"#;
    let good = "fn look_at(robot, given) { #{ yaw: 3.1 - 2 * PI, size: 0.001 + 1e-10, m: given.eye * robot.base_height } }";
    let (earned, verdict, text) = points(function, NUMBERS, good);
    assert_eq!((earned, verdict), (4.0, Verdict::Passed), "{text}");
    let (earned, _, text) = points(
        function,
        NUMBERS,
        &good.replace("given.eye * robot.base_height", "[[2, 0, 0], [0, 2, 0]]"),
    );
    assert!(
        earned < 4.0 && text.contains("2 x 3 numbers") && text.contains("expected 2 x 2"),
        "{text}"
    );
    // an angle is off by what it is off, not by a part of it
    let (earned, _, text) = points(
        function,
        NUMBERS,
        &good.replace("3.1 - 2 * PI", "3.1 + 1e-7"),
    );
    assert!(earned > 3.8 && earned < 4.0, "{earned} {text}");
}

#[test]
fn what_makes_no_function_task_is_refused_with_what_to_write() {
    let fk = format!("call = \"forward_kinematics\"\npose = \"full\"\n{CASES}");
    let numbers = NUMBERS;
    let velocity = "call = \"velocity\"\ncases = [{ name = \"a\", q_rad = [0.4, 0.1], qd_rad_s = [0.5, -0.2] }]";
    let reach = "fk-error = { full_m = 1e-12, zero_m = 1e-9 }";
    for (function, check, from, to, expected) in [
        (
            fk.as_str(),
            reach,
            "\"full\"",
            "\"ful\"",
            "there is no form of poses called `ful`",
        ),
        (
            &fk,
            reach,
            "pose",
            "frame = \"tpc\"\npose",
            "robot `RzTx` has no frame `tpc`",
        ),
        (
            &fk,
            reach,
            "pose",
            "ignore = [\"joint1\", \"joint2\"]\npose",
            "`ignore` leaves no joint",
        ),
        (
            &fk,
            reach,
            "pose",
            "turns = true\npose",
            "`turns` means nothing to `forward_kinematics`",
        ),
        (
            &fk,
            reach,
            "pose",
            "gravity_m_s2 = [0, 0, 0]\npose",
            "`gravity_m_s2` means nothing to `forward_kinematics`",
        ),
        (
            &fk,
            reach,
            "pose",
            "axis = [0, 0, 1]\npose",
            "`axis` is for `pose = \"axis\"`",
        ),
        (
            &fk,
            reach,
            "pose",
            "as = \"sin\"\npose",
            "`sin` cannot be the name of a function",
        ),
        (
            &fk,
            reach,
            "pose",
            "grants = [\"gravity\"]\nframe = \"link2\"\npose",
            "`robot` of this task is not that of the lab",
        ),
        (
            &fk,
            "fk-orientation = { full_rad = 0.1, zero_rad = 0.2 }",
            "pose = \"full\"",
            "",
            "this task asks for positions alone",
        ),
        (
            velocity,
            numbers,
            ", qd_rad_s = [0.5, -0.2]",
            "",
            "case `a` of `velocity` is given by `q_rad` and `qd_rad_s`",
        ),
        (
            velocity,
            numbers,
            "qd_rad_s = [0.5, -0.2]",
            "qd_rad_s = [0.5]",
            "`qd_rad_s` has 1 number for 2 joints",
        ),
        (
            velocity,
            numbers,
            "velocity",
            "velocty",
            "no built-in task function is called `velocty`",
        ),
        (
            velocity,
            numbers,
            "name = \"a\"",
            "name = \"a\", robot = \"RzTq\"",
            "`q` is no axis",
        ),
        (
            velocity,
            numbers,
            "name = \"a\"",
            "name = \"a\", robot = \"RzTxRy\"",
            "`q_rad` has 2 numbers for 3 joints",
        ),
        (
            velocity,
            numbers,
            "name = \"a\"",
            "name = \"a\", dimensions = { link7 = [0, 0, 1] }",
            "link7",
        ),
        (
            velocity,
            numbers,
            "name = \"a\"",
            "name = \"a\", given = { x = 1 }",
            "is given by `given` and `expected`",
        ),
        (
            velocity,
            "jacobian-match = { full = 0.1, zero = 0.2 }",
            "velocity",
            "velocity",
            "jacobian-match",
        ),
    ] {
        let lab = own_lab(function, check);
        let lab = lab.with("lab.toml", from, to);
        match lab.load() {
            Ok(_) => panic!("{to} is accepted"),
            Err(error) => {
                let said = format!("{error}");
                assert!(said.contains(expected), "{from} -> {to}: {said}");
            }
        }
    }
}

#[test]
fn one_name_is_not_asked_for_two_things() {
    let text = LAB
        .replace(
            "FUNCTION",
            &format!("call = \"forward_kinematics\"\n{CASES}"),
        )
        .replace("CHECK", "fk-error = { full_m = 1e-12, zero_m = 1e-9 }");
    let second = "\n[[tasks]]\nname = \"second\"\ntitle = \"Second\"\nchecks = [{ name = \"c\", title = \"C\", points = 1, fk-error = { full_m = 0.1, zero_m = 0.2 } }]\n[tasks.function]\ncall = \"forward_kinematics\"\nframe = \"link2\"\n";
    let lab = OwnLab::new("94-robot", format!("{text}{second}{CASES}\n"));
    let error = lab.load().expect_err("two meanings").to_string();
    assert!(
        error.contains("tasks `asked` and `second` ask different things of `forward_kinematics`"),
        "{error}"
    );
    let named = lab.with(
        "lab.toml",
        "frame = \"link2\"",
        "frame = \"link2\"\nas = \"last_joint\"",
    );
    let lab = named.lab();
    let submission = "fn forward_kinematics(robot, q) { [0, 0, 0] } fn last_joint(robot, q) { let r = 1 + q[1]; [r * cos(q[0]), r * sin(q[0]), 2] }";
    assert_eq!(grade(&lab, None, "mine.rhai", submission).grade.points, 1.0);
}

/// Hidden cases have truth from the engine, too: rows of joints, quantities and poses are drawn.
#[test]
fn hidden_cases_of_poses_quantities_and_rows_are_drawn() {
    let function = format!("call = \"forward_kinematics\"\npose = \"full\"\n{CASES}");
    let lab = own_lab(&function, "fk-error = { full_m = 1e-12, zero_m = 1e-9 }")
        .and(
            "hidden.toml",
            r#"
format = 1
salt = "a salt of seventeen letters"
[[draws]]
task = "asked"
class = "other rows"
count = 20
robots = ["RzTx", "RyTx", "TxRz"]
q_rad = [[-3.0, 3.0], [0.0, 0.5]]
dimensions = { base_height = [1.0, 2.0] }
"#,
        )
        .and("mutants.toml", "format = 1\n");
    let general = r#"
        fn turn(axis, a) {
            let c = cos(a); let s = sin(a);
            if axis == "x" { [[1,0,0,0],[0,c,-s,0],[0,s,c,0],[0,0,0,1]] }
            else if axis == "y" { [[c,0,s,0],[0,1,0,0],[-s,0,c,0],[0,0,0,1]] }
            else { [[c,-s,0,0],[s,c,0,0],[0,0,1,0],[0,0,0,1]] }
        }
        fn shift(p) { [[1,0,0,p[0]],[0,1,0,p[1]],[0,0,1,p[2]],[0,0,0,1]] }
        fn forward_kinematics(robot, q) {
            let h = matrix(shift([0, 0, robot.base_height]));
            for i in 0..robot.joints {
                let kind = robot.name[2 * i]; let axis = robot.name[2 * i + 1];
                let unit = [if axis == "x" { 1 } else { 0 }, if axis == "y" { 1 } else { 0 }, if axis == "z" { 1 } else { 0 }];
                let move = if kind == "R" { turn(axis, q[i]) } else { shift(unit * q[i]) };
                h = h * matrix(move) * matrix(shift(robot["link" + (i + 1)]));
            }
            h
        }"#;
    let lab = lab.and("solution.rhai", general);
    let loaded = lab.lab();
    let staff = lab.staff(&loaded);
    let graded = grade(&loaded, staff.as_ref(), "mine.rhai", general).grade;
    assert_eq!(
        (graded.points, graded.verdict),
        (4.0, Verdict::Passed),
        "{}",
        text(&graded)
    );
    assert_eq!(graded.tasks[0].hidden[0].total, 20);
    // an answer for the lab's own row alone is right in about a third of them
    let own = "fn forward_kinematics(robot, q) { let c = cos(q[0]); let s = sin(q[0]); let r = 1 + q[1];\n\
        [[c, -s, 0, r * c], [s, c, 0, r * s], [0, 0, 1, robot.base_height + 0.5], [0, 0, 0, 1]] }";
    let graded = grade(&loaded, staff.as_ref(), "mine.rhai", own).grade;
    let good = graded.tasks[0].hidden[0].good;
    assert!((2..13).contains(&good) && graded.points == 0.0, "{good}");
}
