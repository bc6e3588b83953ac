//! Lab 1: where is the hand, and how do I get it there?
//!
//! Angles are radians. x is up, y is sideways, z is along the joint axes. q[0] is the shoulder, q[1] the elbow; the elbow's angle
//! is relative to the upper arm, and both links point straight up at q = [0, 0].
//!
//! Build with `cargo build --release --target wasm32-unknown-unknown`, and grade with `kinemark grade`. What you print with
//! `kinemark_plugin::log!("q = {:?}", observation.q())` is in the report; `println!` prints nowhere.

// Until your formulas use them all: then delete this line, and the compiler finds what you forgot.
#![allow(unused_variables)]

use kinemark_plugin::{Observation, Robot, Rows, Submission, export};

// The functions that are called from outside.
export!(Arm: forward_kinematics, inverse_kinematics, control);

/// What you keep from call to call, in fields that you add. Each run begins with `Arm::default()`.
#[derive(Default)]
struct Arm {}

impl Submission for Arm {
    // Where is the hand? Return [x, y, z] in metres.
    // Of robot.dimensions(), .number("base_height") and .number("link_offset") are numbers, .array("link_lengths") is [f64; 2].
    // `kinemark_plugin::math` has sin, cos and the like.
    fn forward_kinematics(&mut self, robot: &Robot, q: &[f64]) -> [f64; 3] {
        [0.0, 0.0, 0.0]
    }

    // Which angles bring the hand to position = [x, y, z]? Push every way to get there, branches.push(&[q1, q2]),
    // and nothing where there is none.
    fn inverse_kinematics(&mut self, robot: &Robot, position: [f64; 3], branches: &mut Rows) {}

    // Task "move", called every 10 ms: write the two joint angles that the motors should go to into `command`.
    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        // observation.target().rows("target") are the two places to go to, observation.time() is the time in seconds. The robot is
        // not here: write an `init(&mut self, robot: &Robot, task: &str)` that keeps what you need of it in `self`.
        command.copy_from_slice(observation.q());
    }
}
