//! Lab 6: one program for every robot.
//!
//! A robot is typed as a row such as "RzTxRy": two letters for a joint. R turns (q in rad), T and P slide (q in m); then the axis. Its
//! dimensions are base_height, the height of the first joint in m, and link1, link2 and on: 3 numbers in m from a joint to the next, and
//! from the last one to the tip. All frames are aligned with the base at q = 0: x forward, y to the left, z up. Rows, sizes and the number
//! of joints differ from case to case: take all of them from the robot.
//!
//! Build with `cargo build --release --target wasm32-unknown-unknown`, and grade with `kinemark grade`. What you print with
//! `kinemark_plugin::log!("q = {:?}", observation.q())` is in the report; `println!` prints nowhere.

// Until your formulas use them all: then delete this line, and the compiler finds what you forgot.
#![allow(unused_variables)]

use kinemark_plugin::{Answer, Map, Observation, Robot, Rows, Submission, export};

// The functions that are called from outside.
export!(Row: jacobian, init, control, own last_joint, tip);

/// What you keep from call to call. Each run begins with `Row::default()`.
#[derive(Default)]
struct Row {
    /// The row of joints, such as "RzTxRy".
    name: String,
}

const HOME: [[f64; 4]; 4] = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 1.0],
];

impl Row {
    // Task "last-joint". The pose of the last joint: after its own motion, before the last link. Answer 4 rows of 4 numbers.
    //     given.text("robot.name")               the row; its length is twice the number of joints
    //     given.numbers("q")                     the joints, in rad or m
    //     given.number("robot.base_height")      m
    //     given.array::<3>("robot.link1")        3 numbers in m; format!("robot.link{}", i + 1) makes such a name
    fn last_joint(&mut self, given: &Map, answer: &mut Answer) {
        answer.matrix("", &HOME);
    }

    // Task "tip". The pose of the tip, where the last link ends. Answer 4 rows of 4 numbers. It is given the same.
    fn tip(&mut self, given: &Map, answer: &mut Answer) {
        answer.matrix("", &HOME);
    }
}

impl Submission for Row {
    // Task "jacobian". How does the tip move when the joints do? Push 6 rows of one number per joint: the velocity x, y, z of the tip, then
    // its angular velocity about x, y, z.
    //     robot.name(), robot.joints()           the row, and how many joints it has
    //     robot.dimensions()                     as `given` above, without "robot." before the names
    // `kinemark_plugin::math` has sin, cos and the like.
    fn jacobian(&mut self, robot: &Robot, q: &[f64], rows: &mut Rows) {
        for row in 0..6 {
            rows.push(&vec![0.0; robot.joints()]);
        }
    }

    // Called once before each run. What you keep in `self` is still there in `control`.
    fn init(&mut self, robot: &Robot, task: &str) {
        self.name = robot.name().to_owned();
    }

    // Task "move". Called every 10 ms: write the velocities of the three joints into `command`, in rad/s, or in m/s where a joint slides.
    //     observation.q()        the joints now, in rad or m
    //     observation.tcp()      where the tip is now, [x, y, z] in m
    //     observation.time()     s since the start
    //     observation.target()   what is asked for:
    //         .array("from"), .array("to")   the two ends of the line, [x, y, z] in m; the tip starts at "from"
    //         .number("speed")               how fast the tip should go along it, in m/s
    // `kinemark_plugin::linear` has norm, dot, and solve for a 3x3 system.
    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        command.copy_from_slice(&[0.0, 0.0, 0.0]);
    }
}
