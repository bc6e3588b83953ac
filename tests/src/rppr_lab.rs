//! Lab 5 against independent numbers: what its reference solution answers at the golden states of the arm, and how fast the drives are.

use kinemark_grader::record::verdict::Verdict;
use kinemark_report::text::text;
use serde_json::Value as Json;

use crate::eval::{golden, numbers};
use crate::own_lab::OwnLab;
use crate::testbed::{grade, root};

/// The functions of the lab, called as the golden file has its numbers.
const GOLDEN: &str = r"
fn state(robot, given) {
    let pose = tcp_pose(robot, given.q);
    let branches = inverse_kinematics(robot, given.position);
    let rates = joint_rates(robot, #{ q: given.q, v: given.v });
    let accelerations = joint_accelerations(robot, #{ q: given.q, qd: given.qd, a: given.a });
    #{
        position: [pose[0][3], pose[1][3], pose[2][3]],
        rotation: [pose[0].slice(0, 3), pose[1].slice(0, 3), pose[2].slice(0, 3)],
        branches: len(branches),
        turn: branches[0][0],
        other_turn: branches[1][0],
        slides: [branches[0][1], branches[0][2], branches[1][1], branches[1][2]],
        v: velocity(robot, given.q, given.qd),
        a: acceleration(robot, given.q, given.qd, given.qdd),
        turn_rate: rates.turn,
        slide_rates: [rates.lift, rates.reach],
        turn_acceleration: accelerations.turn,
        slide_accelerations: [accelerations.lift, accelerations.reach],
    }
}

fn place(robot, given) {
    let branches = inverse_kinematics(robot, given.position);
    let branch = if is_empty(branches) { [0, 0, 0] } else { branches[0] };
    #{ branches: len(branches), turn: branch[0], slides: [branch[1], branch[2]] }
}
";

/// A task that calls `function` on these cases; its check is on for 1e-12 of what is expected, or of 1 m where that is less.
fn task(function: &str, turns: &str, cases: &[(Json, Json)]) -> String {
    let cases = cases.iter().enumerate().map(|(i, (given, expected))| {
        let (given, expected) = (toml(given), toml(expected));
        format!("    {{ name = \"{i}\", given = {given}, expected = {expected} }},\n")
    });
    let cases: String = cases.collect();
    format!(
        "[[tasks]]\nname = \"{function}\"\ntitle = \"{function}\"\n[tasks.function]\ncall = \"{function}\"\nwith_robot = true\n\
         turns = {turns}\nleast_size = 1.0\ncases = [\n{cases}]\n\
         [[tasks.checks]]\nname = \"same\"\ntitle = \"The golden numbers\"\npoints = 1.0\nfunction-cases = {{ full = 1e-12, zero = 2e-12 }}\n"
    )
}

/// A map of numbers and lists as an inline table.
fn toml(map: &Json) -> String {
    let entries = map.as_object().expect("a map").iter();
    let entries: Vec<String> = entries
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    format!("{{ {} }}", entries.join(", "))
}

/// Numbers of the golden file, of which those at `millimetres` become metres.
fn in_metres(value: &Json, millimetres: &[usize]) -> Vec<f64> {
    let numbers = numbers(value).into_iter().enumerate();
    let metres = numbers.map(|(i, number)| {
        if millimetres.contains(&i) {
            number / 1000.0
        } else {
            number
        }
    });
    metres.collect()
}

/// The 51 golden states: what the functions are given, and what they should answer.
fn states() -> Vec<(Json, Json)> {
    let file = golden("D_rppr.json");
    let samples = file["samples"].as_array().expect("samples").iter();
    let states = samples.map(|sample| {
        let joints = |name: &str| in_metres(&sample[name], &[1, 2]);
        let vector = |name: &str| in_metres(&sample[name], &[0, 1, 2]);
        let (q, qd, qdd) = (joints("q"), joints("dq"), joints("ddq"));
        let pose: Vec<Vec<f64>> = sample["T_0P"]
            .as_array()
            .expect("rows")
            .iter()
            .map(|row| in_metres(row, &[3]))
            .collect();
        let position: Vec<f64> = pose[..3].iter().map(|row| row[3]).collect();
        let rotation: Vec<&[f64]> = pose[..3].iter().map(|row| &row[..3]).collect();
        let branches = sample["ik_all_branches"].as_array().expect("branches");
        let branches: Vec<Vec<f64>> = branches.iter().map(|b| in_metres(b, &[1, 2])).collect();
        let (v, a) = (vector("velocity_0"), vector("acceleration_0"));
        let given =
            serde_json::json!({ "q": q, "qd": qd, "qdd": qdd, "position": position, "v": v, "a": a });
        let expected = serde_json::json!({
            "position": position,
            "rotation": rotation,
            "branches": branches.len(),
            "turn": branches[0][0],
            "other_turn": branches[1][0],
            "slides": [branches[0][1], branches[0][2], branches[1][1], branches[1][2]],
            "v": v,
            "a": a,
            "turn_rate": qd[0],
            "slide_rates": qd[1..3],
            "turn_acceleration": qdd[0],
            "slide_accelerations": qdd[1..3],
        });
        (given, expected)
    });
    states.collect()
}

/// The 41 places of the sweep in figure 2 of the source, one on the edge of the hole, and one inside.
fn places() -> Vec<(Json, Json)> {
    let file = golden("D_rppr.json");
    let place = |position: &[f64], branches: usize, turn: f64, slides: [f64; 2]| {
        let given = serde_json::json!({ "position": position });
        let expected = serde_json::json!({ "branches": branches, "turn": turn, "slides": slides });
        (given, expected)
    };
    let rows = file["sweep_like_fig2"]["rows"].as_array().expect("rows");
    let sweep = rows.iter().map(|row| {
        let row = in_metres(row, &[0, 1, 2, 4, 5]);
        place(&row[..3], 2, row[3], [row[4], row[5]])
    });
    let mut places: Vec<_> = sweep.collect();
    let [hole, edge] = [0, 1].map(|i| &file["edge_cases"][i]);
    let at = |case: &Json| in_metres(&case["xyz"], &[0, 1, 2]);
    let (q1, q3) = (&edge["q1"], in_metres(&edge["q3"], &[0])[0]);
    places.push(place(&at(hole), 0, 0.0, [0.0, 0.0]));
    // 450 mm of column and carriage, less the drop
    let lift = at(edge)[2] - 0.39;
    places.push(place(&at(edge), 2, numbers(q1)[0], [lift, q3]));
    places
}

fn solution() -> String {
    let path = root().join("reference/05-rppr/solution.rhai");
    std::fs::read_to_string(path).expect("the solution")
}

#[test]
fn the_solution_answers_with_the_golden_numbers() {
    let (states, places) = (states(), places());
    assert_eq!((states.len(), places.len()), (51, 43));
    let head = "format = 1\nname = \"92-golden\"\ntitle = \"Golden\"\nrobot = \"rppr\"\nframe = \"base\"\n";
    let states = task("state", "[\"turn\", \"other_turn\"]", &states);
    let places = task("place", "[\"turn\"]", &places);
    let lab = format!("{head}{states}{places}");
    let lab = OwnLab::new("92-golden", lab).lab();
    let points = |submission: &str| {
        let graded = grade(&lab, None, "mine.rhai", &(submission.to_owned() + GOLDEN)).grade;
        (graded.points, graded.verdict, text(&graded))
    };
    let (earned, verdict, words) = points(&solution());
    assert_eq!((earned, verdict), (2.0, Verdict::Passed), "{words}");
    // a hundredth of a nanometre would be seen
    for (right, off) in [
        (
            "robot.side * c1 - a * s1]",
            "robot.side * c1 - a * s1 + 1e-11]",
        ),
        ("robot.gripper - a]", "robot.gripper - a + 1e-11]"),
        ("        qd[1],\n", "        qd[1] + 1e-11,\n"),
        ("        qdd[1],\n", "        qdd[1] + 1e-11,\n"),
        ("lift: v[2]", "lift: v[2] + 1e-11"),
        ("lift: given.a[2]", "lift: given.a[2] + 1e-11"),
    ] {
        assert!(solution().contains(right), "{right}");
        let (earned, _, words) = points(&solution().replace(right, off));
        assert!(earned < 2.0, "{off}: {words}");
    }
}

/// The whole stroke of a joint, from the first point to the second, whatever a submission commands.
const STROKE: &str = r#"
format = 1
name = "92-stroke"
title = "Stroke"
robot = "rppr"
frame = "base"

[[tasks]]
name = "stroke"
title = "From end to end"

[tasks.motion]
mode = "MODE"
duration_s = 16.0
start_rad = START
SERVO

[tasks.motion.paths]
stroke = { points_m = POINTS, trim_m = 1e-5 }

[[tasks.checks]]
name = "not-faster"
title = "It takes this time at least"
points = 1.0
time-limit = { until = "path", path = "stroke", at_least = true, full_s = LEAST, zero_s = 1.0 }

[[tasks.checks]]
name = "arrives"
title = "It takes not much longer"
points = 1.0
time-limit = { until = "path", path = "stroke", full_s = MOST, zero_s = 100.0 }
"#;

/// 310 mm of lift at 20 mm/s take 15.5 s, and half a turn at 18 degrees a second 10 s, however much a submission asks for.
#[test]
fn no_command_is_faster_than_the_drives() {
    let lift = (
        "[0.0, 0.0, 0.0, 0.0]",
        "[[0.08, 0.5, 0.39], [0.08, 0.5, 0.7]]",
        15.5,
        1,
    );
    let turn = (
        "[-1.5707963267948966, 0.0, 0.0, 0.0]",
        "[[0.5, -0.08, 0.39], [-0.5, 0.08, 0.39]]",
        10.0,
        0,
    );
    let servo = "servo = { kp = [2e3, 2e5, 2e5, 100], kd = [200, 2e4, 2e4, 10], derivative = \"velocity\", gravity_compensation = true }";
    let rates = "servo = { kp = [100, 1e4, 1e4, 10], ki = [2e3, 2e5, 2e5, 100], gravity_compensation = true }";
    for (start, points, least, joint) in [lift, turn] {
        for (mode, servo, commanded) in [
            ("position", servo, 2.0),
            ("velocity", rates, 10.0),
            ("effort", "", 1e4),
        ] {
            let lab = STROKE
                .replace("MODE", mode)
                .replace("START", start)
                .replace("SERVO", servo)
                .replace("POINTS", points)
                .replace("LEAST", &format!("{least:?}"))
                .replace("MOST", &format!("{:?}", least + 0.3));
            let mut command = [0.0; 4];
            command[joint] = commanded;
            let submission = format!("fn control(observation) {{ {command:?} }}");
            let lab = OwnLab::new("92-stroke", lab).lab();
            let graded = grade(&lab, None, "mine.rhai", &submission).grade;
            let words = text(&graded);
            assert_eq!(graded.points, 2.0, "{mode}, {command:?}: {words}");
        }
    }
}
