//! Lab 5: an industrial arm.
//!
//! Angles are radians, lengths are metres. The joints are turn, lift, reach and the turn of the gripper; q[2] counts backwards: where
//! it grows, the arm is drawn in. The lengths are column, carriage, side, reach, drop and gripper. Your arm may differ from your
//! neighbour's, and from hidden cases: take every length from the robot, and never type it in.
//!
//! Build with `cargo build --release --target wasm32-unknown-unknown`, and grade with `kinemark grade`. What you print with
//! `kinemark_plugin::log!("q = {:?}", observation.q())` is in the report; `println!` prints nowhere.

// Until your formulas use them all: then delete this line, and the compiler finds what you forgot.
#![allow(unused_variables)]

use kinemark_plugin::{Answer, Map, Observation, Robot, Rows, Submission, export};

// The functions that are called from outside.
export!(Arm: inverse_kinematics, init, control, own tcp_pose, velocity, acceleration, joint_rates, joint_accelerations);

/// What you keep from call to call, in fields that you add. Each run begins with `Arm::default()`.
#[derive(Default)]
struct Arm {}

impl Arm {
    // Task "fk". The pose of the TCP: the axes of the gripper and the position in the frame of the base.
    // given.number("robot.side") is a length, given.array("q") are the positions of the four joints.
    // `kinemark_plugin::math` has sin, cos and the like.
    fn tcp_pose(&mut self, given: &Map, answer: &mut Answer) {
        let q: [f64; 4] = given.array("q");
        answer.matrix(
            "",
            &[
                [1.0, 0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, 1.0, 0.0],
                [0.0, 0.0, 0.0, 1.0],
            ],
        );
    }

    // Task "velocity". vx, vy and vz of the TCP in m/s; `given` has "q" and "qd" of the four joints.
    fn velocity(&mut self, given: &Map, answer: &mut Answer) {
        answer.list("", &[0.0, 0.0, 0.0]);
    }

    // Task "acceleration". ax, ay and az of the TCP in m/s²; `given` has "q", "qd" and "qdd" of the four joints.
    fn acceleration(&mut self, given: &Map, answer: &mut Answer) {
        answer.list("", &[0.0, 0.0, 0.0]);
    }

    // Task "rates". The rates of the joints that give the TCP the velocity "v"; "q" has the positions of the first three joints.
    fn joint_rates(&mut self, given: &Map, answer: &mut Answer) {
        answer.number("turn", 0.0);
        answer.number("lift", 0.0);
        answer.number("reach", 0.0);
    }

    // Task "accelerations". The accelerations of the joints that give the TCP the acceleration "a", with "q" and "qd" of three joints.
    fn joint_accelerations(&mut self, given: &Map, answer: &mut Answer) {
        answer.number("turn", 0.0);
        answer.number("lift", 0.0);
        answer.number("reach", 0.0);
    }
}

impl Submission for Arm {
    // Task "ik". Push [q1, q2, q3] of every way to bring the TCP to position = [x, y, z], branches.push(&[q1, q2, q3]), and nothing
    // where there is none. Here the lengths are robot.dimensions().number("side") and so on.
    fn inverse_kinematics(&mut self, robot: &Robot, position: [f64; 3], branches: &mut Rows) {}

    // Called once before each run. What you keep in `self` is still there in `control`.
    fn init(&mut self, robot: &Robot, task: &str) {}

    // Task "pick". Called every 10 ms: write the rates of the four joints into `command`, rad/s, m/s, m/s and rad/s.
    //     observation.q()          the joints now, in rad, m, m and rad
    //     observation.target()     .rows("target") are the six places for the TCP, x, y and z of each
    //     observation.sensors()    .number("lift_lower") is 1 while the switch is pressed, and 0 otherwise
    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        command.copy_from_slice(&[0.0, 0.0, 0.0, 0.0]);
    }
}
