//! Lab 4: two straight lines.
//!
//! Angles are radians, lengths metres. x is up, y is sideways, z is along the joint axes. q[0] is the shoulder, q[1] the elbow,
//! relative to the upper arm.
//!
//! The lengths of the arm, the points and the speed may differ from student to student, and the course's hidden run has another
//! line and another speed: take them from `robot` and `observation.target()`, never type them in.
//!
//! Build with `cargo build --release --target wasm32-unknown-unknown`, and grade with `kinemark grade`. What you print with
//! `kinemark_plugin::log!("q = {:?}", observation.q())` is in the report; `println!` prints nowhere.

// Until your formulas use them all: then delete this line, and the compiler finds what you forgot.
#![allow(unused_variables)]

use kinemark_plugin::linear::{array, solve};
use kinemark_plugin::{Observation, Robot, Rows, Submission, export};

// The functions that are called from outside.
export!(Knocker: init, jacobian, control);

/// What you keep from call to call. Each run begins with `Knocker::default()`, all zeros.
#[derive(Default)]
struct Knocker {
    /// Upper arm, forearm, in m.
    link_lengths: [f64; 2],
    /// Which line the hand is on: 0 or 1.
    segment: usize,
}

// Task "jacobian": how fast does the hand move when the joints turn? Rows x and y, one column per joint, in m/rad:
//     [[dx/dq1, dx/dq2],
//      [dy/dq1, dy/dq2]]
// `l` is the lengths of the upper arm and the forearm. Bring your answer from lab 2. It is judged for arms of other lengths too, and
// `control` below uses it.
fn jacobian(l: [f64; 2], q: [f64; 2]) -> [[f64; 2]; 2] {
    [[1.0, 0.0], [0.0, 1.0]]
}

impl Submission for Knocker {
    // Called once before the run. What is kept in `self` is there in `control`.
    fn init(&mut self, robot: &Robot, task: &str) {
        self.link_lengths = robot.dimensions().array("link_lengths");
        self.segment = 0;
    }

    fn jacobian(&mut self, robot: &Robot, q: &[f64], rows: &mut Rows) {
        for row in jacobian(robot.dimensions().array("link_lengths"), array(q)) {
            rows.push(&row);
        }
    }

    // Task "knock". Called every 10 ms. Write the two speeds, rad/s, that the joints should have into `command`.
    // observation.time() (s), .q(), .qd() (rad, rad/s), .tcp() (the hand: [x, y, z] in m), .target():
    //   .rows("points")       three positions: go straight from the first to the second, and straight on to the third
    //   .number("speed")      how fast, m/s
    //   .array("can")         the middle of the can
    //   .number("shelf_top")  the height of the shelf
    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        let points: Vec<[f64; 3]> = observation.target().rows("points").map(array).collect();

        // First: the velocity [vx, vy] that takes the hand along the line it is on. A direction is a difference of two points divided
        // by its `norm`, of `kinemark_plugin::linear`.
        let v = [0.0, 0.0];

        // Then: steer back to the line, and go over to the second line when the first is done.

        let q = array(observation.q());
        let rates = solve(jacobian(self.link_lengths, q), v);
        command.copy_from_slice(&rates.expect("a regular Jacobian"));
    }
}
