//! A robot with a closed loop in a lab: where it starts, and where it cannot.

use crate::own_lab::{OwnLab, value};

/// A crank of 0.2 m, a rod of 0.4 m, a rocker of 0.3 m, on feet 0.4 m apart.
const ROBOT: &str = r#"
format = 1
name = "fourbar"
links = [
    { name = "base" },
    { name = "crank", shapes = [{ box = { size_m = [0.02, 0.02, 0.2] }, origin = { xyz_m = [0, 0, 0.1] } }], inertia = { mass_kg = 0.5 } },
    { name = "rod", shapes = [{ box = { size_m = [0.02, 0.02, 0.4] }, origin = { xyz_m = [0, 0, 0.2] } }], inertia = { mass_kg = 0.5 } },
    { name = "rocker", shapes = [{ box = { size_m = [0.02, 0.02, 0.3] }, origin = { xyz_m = [0, 0, 0.15] } }], inertia = { mass_kg = 0.5 } },
]
joints = [
    { name = "a", type = "continuous", parent = "base", child = "crank", origin = { xyz_m = [-0.2, 0, 0] }, axis = [0, 1, 0], damping = 0.1 },
    { name = "b", type = "continuous", parent = "crank", child = "rod", origin = { xyz_m = [0, 0, 0.2] }, axis = [0, 1, 0], passive = true, guess = 1.3 },
    { name = "c", type = "continuous", parent = "base", child = "rocker", origin = { xyz_m = [0.2, 0, 0] }, axis = [0, 1, 0], passive = true, guess = 0.1 },
]
loops = [{ type = "revolute", links = ["rod", "rocker"], axis = [0, 1, 0], frame_on_first = { xyz_m = [0, 0, 0.4] }, frame_on_second = { xyz_m = [0, 0, 0.3] } }]
frames = [{ name = "tcp", link = "rod", origin = { xyz_m = [0, 0, 0.2] } }]
"#;

const LAB: &str = r#"
format = 1
name = "95-linkage"
title = "A linkage"
robot = "fourbar"

[[tasks]]
name = "hold"
title = "Hold it"

[tasks.motion]
mode = "position"
duration_s = 0.2
servo = { kp = 2000.0, kd = 20.0, derivative = "velocity" }
start_rad = [0, 1.319, -0.0421]

[[tasks.checks]]
name = "calm"
title = "Nothing jumps"
points = 1.0
joint-speed = { full_rad_s = 0.2, zero_rad_s = 3.0 }
"#;

const HOLDS: &str = "fn control(observation) { [0.0, 0.0, 0.0] }";

fn lab() -> OwnLab {
    let lab = OwnLab::new("95-linkage", LAB);
    lab.write("labs/robots/fourbar.toml", ROBOT);
    lab
}

/// Started open by half a metre it is thrown together at more than 4 rad/s.
#[test]
fn a_linkage_starts_closed_where_its_file_has_it() {
    let given = lab();
    let speed = value(&given.graded(HOLDS, 0), "calm");
    let home = lab();
    home.edit("start_rad = [0, 1.319, -0.0421]\n", "");
    let at_home = value(&home.graded(HOLDS, 0), "calm");
    // both sag a little under gravity, and nothing more
    assert!(speed < 0.2 && at_home < 0.2, "{speed} and {at_home} rad/s");
}

#[test]
fn a_start_of_the_independent_joints_closes_the_loops() {
    let whole = lab();
    let driven = lab();
    driven.edit("start_rad = [0, 1.319, -0.0421]", "start_rad = [0.0]");
    let speeds = [&whole, &driven].map(|lab| value(&lab.graded(HOLDS, 0), "calm"));
    assert!(speeds.iter().all(|speed| *speed < 0.2), "{speeds:?} rad/s");
    let start = "start_rad = [0, 1.319, -0.0421]";
    lab().is_refused(
        HOLDS,
        &[(
            start,
            "start_rad = [0.0, 1.319]",
            "lab::joint_count",
            "joints of `fourbar`: a, b, c",
        )],
    );
}

#[test]
fn a_start_with_an_open_loop_is_refused_with_the_start_that_closes_it() {
    // with all joints at zero the rod ends 0.5 m from where the rocker does
    let open = "a loop of robot `fourbar` is open by 0.5000 m";
    let closed = "b, c follow from a";
    let beyond = "start_rad = [0, 1.319, 0.3]";
    let start = "start_rad = [0, 1.319, -0.0421]";
    lab().is_refused(
        HOLDS,
        &[
            (start, "start_rad = [0, 0, 0]", "lab::start", open),
            (start, "start_rad = [0, 0, 0]", "lab::start", closed),
            (
                start,
                beyond,
                "lab::start",
                "not a place where the robot can be",
            ),
        ],
    );
}
