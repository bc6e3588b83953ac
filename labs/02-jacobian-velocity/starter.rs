//! Lab 2: how do I make the hand move?
//!
//! Angles are radians, joint velocities rad/s. x is up, y is sideways. q[0] is the shoulder, q[1] the elbow; the elbow's angle is
//! relative to the upper arm, and both links point straight up at q = [0, 0].
//! Your arm, line and speed may differ from your neighbour's, and from hidden runs: take every number from `robot` and
//! `observation.target()`, and never type it in.
//!
//! Build with `cargo build --release --target wasm32-unknown-unknown`, and grade with `kinemark grade`. What you print with
//! `kinemark_plugin::log!("q = {:?}", observation.q())` is in the report; `println!` prints nowhere.

// Until your formulas use them all: then delete this line, and the compiler finds what you forgot.
#![allow(unused_variables)]

use kinemark_plugin::{Observation, Robot, Rows, Submission, export};

// The functions that are called from outside.
export!(Hand: jacobian, init, control);

/// What you keep from call to call. Each run begins with `Hand::default()`, all zeros.
#[derive(Default)]
struct Hand {
    /// Upper arm, forearm, in m.
    link_lengths: [f64; 2],
}

impl Submission for Hand {
    // Task "jacobian". How fast does the hand move when the joints turn? Push two rows, x then y, of one number per joint:
    //     [[dx/dq1, dx/dq2],
    //      [dy/dq1, dy/dq2]]      in m/rad
    // `l` is two lengths in m: upper arm, forearm. `kinemark_plugin::math` has sin, cos and the like.
    fn jacobian(&mut self, robot: &Robot, q: &[f64], rows: &mut Rows) {
        let l: [f64; 2] = robot.dimensions().array("link_lengths");
        rows.push(&[0.0, 0.0]);
        rows.push(&[0.0, 0.0]);
    }

    // Called once before each run. What you keep in `self` is still there in `control`.
    fn init(&mut self, robot: &Robot, task: &str) {
        self.link_lengths = robot.dimensions().array("link_lengths");
    }

    // Tasks "line" and "through-the-shoulder". Called every 10 ms: write the two joint velocities in rad/s into `command`.
    //     observation.q()        the joint angles now, [q1, q2] in rad
    //     observation.qd()       their velocities, in rad/s
    //     observation.tcp()      where the hand is now, [x, y, z] in m
    //     observation.time()     s since the start
    //     observation.target()   what is asked for:
    //         .array("from"), .array("to")   the two ends of the line, [x, y, z] in m; the hand starts at "from"
    //         .number("speed")               how fast the hand should go along it, in m/s
    //         .number("max_rate")            how fast a joint may turn, in rad/s
    //     observation.task()     the name of the task
    // `kinemark_plugin::linear` has norm, dot, and solve for a 2x2 system.
    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        command.copy_from_slice(&[0.0, 0.0]);
    }
}
