//! Labs that prescribe motion, start with velocity, push, and change gravity, wind and friction: what their runs are, and what is refused.

use serde_json::Value as Json;

use crate::own_lab::{OwnLab, value};

/// A bar of 2 kg and 1 m that turns about y, its centre of mass 0.5 m from the hinge: 2/3 kg m² about the hinge.
const ROBOT: &str = r#"
format = 1
name = "pendulum"
links = [
    { name = "base" },
    { name = "bar", shapes = [{ box = { size_m = [0.02, 0.02, 1.0] }, origin = { xyz_m = [0, 0, -0.5] } }], inertia = { mass_kg = 2.0, com_m = [0, 0, -0.5], tensor_kg_m2 = [0.16666666666666666, 0.16666666666666666, 1e-4, 0, 0, 0] }, drag = { area_m2 = 0.5, coefficient = 0.8 } },
]
joints = [
    { name = "hinge", type = "revolute", parent = "base", child = "bar", origin = { xyz_m = [0, 0, 2] }, axis = [0, 1, 0], damping = 0.5, limit = { lower = -1.5, upper = 1.5, effort = 30.0 } },
]
frames = [{ name = "tcp", link = "bar", origin = { xyz_m = [0, 0, -1] } }]
"#;

const LAB: &str = r#"
format = 1
name = "94-torque"
title = "Torque"
robot = "pendulum"

[[tasks]]
name = "torque"
title = "Which torque does it take?"

[tasks.motion]
mode = "prescribed"
duration_s = 2.0
laws = [{ joint = "hinge", sine = { amplitude = 0.8, angular_frequency_rad_s = 3.0, phase_rad = 0.3, offset = 0.2 } }]

[[tasks.checks]]
name = "torque"
title = "The torque is right"
points = 1.0
effort-match = { full_n_m = 0.001, zero_n_m = 5.0 }
"#;

/// `I q̈ + d q̇ + m g l sin q` of the law, with a factor for the acceleration.
fn expects(acceleration: &str) -> String {
    format!(
        "fn control(observation) {{\n    let phase = 3.0 * observation.time + 0.3;\n    let q = 0.2 + 0.8 * sin(phase);\n    \
         let qd = 2.4 * cos(phase);\n    let qdd = -7.2 * sin(phase);\n    \
         [2.0 / 3.0 * {acceleration} * qdd + 0.5 * qd + 2.0 * 9.81 * 0.5 * sin(q)]\n}}\n"
    )
}

fn lab() -> OwnLab {
    let lab = OwnLab::new("94-torque", LAB);
    lab.write("labs/robots/pendulum.toml", ROBOT);
    lab
}

#[test]
fn the_torque_of_a_prescribed_motion_is_predicted_or_missed() {
    let lab = lab();
    let good = lab.record(&expects("1.0"), 0);
    assert_eq!(good["points"], 1.0);
    assert!(value(&good["tasks"][0], "torque") < 1e-9);
    let forgot = lab.graded(&expects("0.0"), 1);
    // 2/3 7.2 sin: its root mean square over about a period
    let off = value(&forgot, "torque");
    assert!((off - 4.8 / 2.0_f64.sqrt()).abs() < 0.1, "{off}");
    let evidence = forgot["checks"][0]["evidence"][0]["message"].as_str();
    assert!(
        evidence.is_some_and(|words| words.contains("the motion takes")),
        "{evidence:?}"
    );
    // where it is no force of its own, the mode says what a command is
    assert_eq!(good["tasks"][0]["verdict"], "passed");
}

#[test]
fn gravity_wind_and_friction_of_a_task_are_in_the_torque() {
    let law = "laws = [{ joint = \"hinge\", sine = { amplitude = 0.8, angular_frequency_rad_s = 3.0, phase_rad = 0.3, offset = 0.2 } }]";
    let still = "laws = [{ joint = \"hinge\", constant = 0.5 }]";
    let upward = "laws = [{ joint = \"hinge\", polynomial = [-1.0, 0.5] }]";
    let answer = |torque: &str| format!("fn control(observation) {{ [{torque}] }}");
    // m g l sin q on the moon
    let moon = lab();
    moon.edit(law, &format!("{still}\ngravity_m_s2 = [0, 0, -1.62]"));
    let ran = moon.graded(&answer("1.62 * sin(0.5)"), 0);
    assert!(value(&ran, "torque") < 1e-12, "{ran}");
    // friction against each direction, at constant speed
    let stiff = lab();
    let friction = "dry_friction = { positive = 1.25, negative = 0.75 }";
    stiff.edit(law, &format!("{upward}\n{friction}"));
    let ran = stiff.graded(&answer("9.81 * sin(observation.q[0]) + 0.25 + 1.25"), 0);
    assert!(value(&ran, "torque") < 1e-9, "{ran}");
    // ½ 1.2 0.8 0.5 10² = 24 N at the centre of mass
    let windy = lab();
    let wind = "wind = { velocity_m_s = [10, 0, 0], air_density_kg_m3 = 1.2 }";
    windy.edit(law, &format!("{still}\n{wind}"));
    let ran = windy.graded(&answer("9.81 * sin(0.5) + 0.5 * 24.0 * cos(0.5)"), 0);
    assert!(value(&ran, "torque") < 1e-9, "{ran}");
    // a push at the tip for the whole run
    let pushed = lab();
    let push = "pushes = [{ on = \"bar\", at_s = 0, for_s = 2, force_n = [0, 0, -7.0], point_m = [0, 0, -1] }]";
    pushed.edit(law, &format!("{still}\n{push}"));
    let ran = pushed.graded(&answer("(9.81 + 7.0) * sin(0.5)"), 0);
    assert!(value(&ran, "torque") < 1e-9, "{ran}");
}

const FALLS: &str = "fn control(observation) {\n    plot(\"level\", observation.tcp_rotation[0][2]);\n    [0.0]\n}\n";

/// The task in effort mode, where nothing drives the bar.
fn free() -> OwnLab {
    let (before, after) = LAB.split_once("mode = \"prescribed\"").expect("a mode");
    let (_, after) = after.split_once("]\n").expect("laws");
    let (after, _) = after.split_once("effort-match").expect("a check");
    let text = format!(
        "{before}mode = \"effort\"\nduration_s = 0.5\nstart_rad = [0.4]\n{after}joint-speed = {{ full_rad_s = 80.0, zero_rad_s = 90.0 }}\n"
    );
    let lab = OwnLab::new("94-torque", text);
    lab.write("labs/robots/pendulum.toml", ROBOT);
    lab
}

#[test]
fn a_run_starts_with_velocity_and_gets_pushes() {
    let speed = |more: &str| {
        let lab = free();
        lab.edit(
            "start_rad = [0.4]\n",
            &format!("start_rad = [0.4]\n{more}\n"),
        );
        value(&lab.graded(FALLS, 0), "torque")
    };
    assert_eq!(speed("gravity_m_s2 = [0, 0, 0]"), 0.0);
    let started = speed("gravity_m_s2 = [0, 0, 0]\nstart_rad_s = [1.2]");
    assert!((started - 1.2).abs() < 1e-12, "{started}");
    // 60 N m for 10 ms on 2/3 kg m², against a damping of 0.5 N m s
    let kicked = speed(
        "gravity_m_s2 = [0, 0, 0]\npushes = [{ on = \"bar\", at_s = 0.1, for_s = 0.01, moment_n_m = [0, 60, 0] }]",
    );
    // 0.6 / I with `(1 - exp(-x)) / x` of x = d t / I = 0.0075
    let x: f64 = 0.5 * 0.01 / (2.0 / 3.0);
    let expected = 0.9 * (1.0 - x / 2.0 + x * x / 6.0 - x * x * x / 24.0);
    assert!((kicked - expected).abs() < 1e-9, "{kicked} for {expected}");
    let stuck = speed("gravity_m_s2 = [0, 0, -9.81]\ndry_friction = 4.0");
    assert!(stuck < 1e-15, "{stuck}");
}

#[test]
fn orientation_of_the_tcp_is_observed() {
    let lab = free();
    lab.edit(
        "start_rad = [0.4]\n",
        "start_rad = [0.4]\ngravity_m_s2 = [0, 0, 0]\n",
    );
    let asks = "fn control(observation) {\n    let r = observation.tcp_rotation;\n    \
        if abs(r[0][2] - sin(0.4)) > 1e-12 || abs(r[2][2] - cos(0.4)) > 1e-12 || r[1][1] != 1.0 { throw \"turned\" }\n    [0.0]\n}\n";
    assert_eq!(lab.record(asks, 0)["tasks"][0]["verdict"], "passed");
}

#[test]
fn a_push_on_a_body_of_the_scene_moves_it() {
    let lab = free();
    lab.edit(
        "start_rad = [0.4]\n",
        "start_rad = [0.4]\nscene = \"shelf-and-can\"\npushes = [{ on = \"can\", at_s = 0.1, for_s = 0.1, force_n = [6, 0, 0] }]\n",
    );
    let ran = lab.graded(FALLS, 0);
    let events = ran["events"].as_array().expect("events").iter();
    let moved = |event: &&Json| event["event"] == "moved";
    assert!(events.clone().any(|event| moved(&event)), "{ran}");
}

#[test]
fn what_a_prescribed_motion_cannot_be_is_refused_at_its_place() {
    let law = "laws = [{ joint = \"hinge\", sine = { amplitude = 0.8, angular_frequency_rad_s = 3.0, phase_rad = 0.3, offset = 0.2 } }]";
    let prescribed = "mode = \"prescribed\"";
    let run = "duration_s = 2.0\n";
    let with = |more: &str| format!("{run}{more}\n");
    lab().is_refused(
        FALLS,
        &[
            (law, "", "lab::prescribed", "needs laws"),
            (prescribed, "mode = \"effort\"", "lab::prescribed", "laws are for mode `prescribed`"),
            (run, &with("start_rad = [0.1]"), "lab::prescribed", "leave `start_rad` out"),
            (run, &with("servo = { kp = 1 }"), "lab::prescribed", "has no servo"),
            ("joint = \"hinge\"", "joint = \"hinje\"", "lab::law", "did you mean `hinge`"),
            ("amplitude = 0.8", "amplitude = 1.4", "lab::law", "beyond its upper limit of 1.5"),
            ("sine = { amplitude = 0.8, angular_frequency_rad_s = 3.0, phase_rad = 0.3, offset = 0.2 }", "constant = 0.1, polynomial = [1]", "lab::law", "exactly one"),
            ("sine = { amplitude = 0.8, angular_frequency_rad_s = 3.0, phase_rad = 0.3, offset = 0.2 }", "trapezoid = { from = 0, to = 1, speed = 0, acceleration = 1 }", "lab::law", "limit of speed must be positive"),
            ("sine = { amplitude = 0.8, angular_frequency_rad_s = 3.0, phase_rad = 0.3, offset = 0.2 }", "table = { times_s = [0, 2, 1], positions = [0, 1, 0] }", "lab::law", "must increase"),
            ("offset = 0.2 }", "offsett = 0.2 }", "lab::toml", "offsett"),
            (run, &with("pushes = [{ on = \"arm\", at_s = 0, for_s = 1, force_n = [1, 0, 0] }]"), "lab::push", "no link of the robot"),
            (run, &with("pushes = [{ on = \"base\", at_s = 0, for_s = 1, force_n = [1, 0, 0] }]"), "lab::push", "does not move"),
            (run, &with("pushes = [{ on = \"bar\", at_s = 0, for_s = 1 }]"), "lab::push", "needs a force"),
            (run, &with("pushes = [{ on = \"bar\", at_s = 2.5, for_s = 1, force_n = [1, 0, 0] }]"), "lab::push", "after the end"),
            (run, &with("pushes = [{ on = \"bar\", at_s = 0.5, for_s = 0.0003, force_n = [1, 0, 0] }]"), "lab::periods", "the length of a push"),
            (run, &with("wind = { velocity_m_s = [0, 0, 0], gust = { speed_m_s = 1, correlation_s = 1, seed = 1 } }"), "lab::wind", "has no direction"),
            (run, &with("dry_friction = [1, 2]"), "lab::joint_count", "one per joint"),
            (run, &with("dry_friction = -1"), "lab::out_of_range", "zero or more"),
            (run, &with("gravity_m_s2 = [0, 0, 1e9]"), "lab::out_of_range", "beyond 1e6"),
        ],
    );
    let free = free();
    free.is_refused(
        FALLS,
        &[
            (
                "start_rad = [0.4]",
                "start_rad_s = [0.4, 1]",
                "lab::joint_count",
                "start_rad_s",
            ),
            (
                "joint-speed = { full_rad_s = 80.0, zero_rad_s = 90.0 }",
                "effort-match = { full_n_m = 1, zero_n_m = 2 }",
                "lab::check_kind",
                "mode = \"prescribed\"",
            ),
        ],
    );
}
