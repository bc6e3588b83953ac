//! Lab 3: why is the hand too low?
//!
//! Angles are radians, lengths metres, efforts N m. x is up, y is sideways, z is along the joint axes. q[0] is the shoulder, q[1] the
//! elbow, relative to the upper arm.
//!
//! The lengths of the arm, the height of the shelf and the points may differ from student to student, and do in the course's hidden
//! runs: take them from `robot` and `observation.target()`, never type them in.
//!
//! Build with `cargo build --release --target wasm32-unknown-unknown`, and grade with `kinemark grade`. What you print with
//! `kinemark_plugin::log!("q = {:?}", observation.q())` is in the report; `println!` prints nowhere.

// Until your formulas use them all: then delete this line, and the compiler finds what you forgot.
#![allow(unused_variables, dead_code)]

use kinemark_plugin::linear::array;
use kinemark_plugin::{Observation, Robot, Submission, export};

// The functions that are called from outside.
export!(Knocker: init, control);

/// What the servo gives for 1 rad between command and angle, in N m/rad.
const KP: f64 = 100.0;

/// What you keep from call to call. Each run begins with `Knocker::default()`, all zeros.
#[derive(Default)]
struct Knocker {
    /// The shoulder above the ground, in m.
    base_height: f64,
    /// Upper arm, forearm, in m.
    link_lengths: [f64; 2],
}

impl Knocker {
    // Task 1, first half: which angles bring the hand to position = [x, y, z]? Bring your answer from lab 1; of its two branches take
    // the one whose elbow angle is positive, as at the start.
    fn angles(&self, position: [f64; 3]) -> [f64; 2] {
        [0.775397496610753, 1.5907976603682872]
    }

    // Task 1, second half: which angles must be commanded so that the arm comes to rest at q? Until you say, the arm sags.
    // `let carried: [f64; 2] = kinemark_plugin::robot_model::gravity(&q);` gives the efforts that hold the arm still at the angles
    // q, one per joint.
    fn command_for(&self, q: [f64; 2]) -> [f64; 2] {
        q
    }
}

impl Submission for Knocker {
    // Called once before each run. What is kept in `self` is there in `control`.
    fn init(&mut self, robot: &Robot, task: &str) {
        self.base_height = robot.dimensions().number("base_height");
        self.link_lengths = robot.dimensions().array("link_lengths");
    }

    // Called every 10 ms. Write the two angles that the servo should go to into `command`.
    // observation.time() (s), .q(), .qd() (rad, rad/s), .tcp() (the hand: [x, y, z] in m), .task(), .target()
    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        let points: Vec<[f64; 3]> = if observation.task() == "hold" {
            // Task 1: two positions. Stand at the first for at least half a second, then at the second, within 8 s.
            observation.target().rows("target").map(array).collect()
        } else {
            // Task 2: four positions to go through, one after the other. Of the target, .array("can") is the middle of the can,
            // .number("shelf_top") the height of the shelf. Do not jump from one to the next: `lerp` and `quintic` of
            // `kinemark_plugin::math` lead the hand, `lerp(from[0], to[0], quintic(s))` its x.
            observation.target().rows("points").map(array).collect()
        };
        command.copy_from_slice(&self.command_for(self.angles(points[0])));
    }
}
