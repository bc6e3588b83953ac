//! Lab 0: what does a motor do when the command jumps?
//!
//! Angles are radians: x is up, y is sideways, and both links point straight up at q = [0, 0]. A positive torque turns a joint
//! the way its angle grows.
//!
//! Your neighbour's arm may have other lengths, steps and gains. Read yours from `robot` and `observation.target()`; do not type
//! them in.
//!
//! Build with `cargo build --release --target wasm32-unknown-unknown`, and grade with `kinemark grade`. What you print with
//! `kinemark_plugin::log!("q = {:?}", observation.q())` is in the report; `println!` prints nowhere.

// Until your formulas use them all: then delete this line, and the compiler finds what you forgot.
#![allow(unused_variables)]

use kinemark_plugin::{Answer, Map, Observation, Robot, Submission, export};

// The functions that are called from outside: the methods of the trait, and after `own` those of this lab.
export!(Motors: init, control, own position_loop, velocity_loop);

/// What you keep from call to call. Each run begins with `Motors::default()`, all zeros.
#[derive(Default)]
struct Motors {
    /// Upper arm, forearm, in m.
    link_lengths: [f64; 2],
    /// Room for the integrals of two errors.
    sum: [f64; 2],
}

impl Motors {
    // Task 2, "position-loop". `given` has
    //     mass (kg), length, width (m)   of the forearm, a box that turns about one of its ends
    //     damping (N m s/rad)            of the joint
    //     kp, ki, kd                     the gains, in N m/rad, N m/(rad s), N m s/rad
    //     load_torque (N m)              a constant load at the joint
    // Replace each -1.
    fn position_loop(&mut self, given: &Map, answer: &mut Answer) {
        let kp = given.number("kp"); // the others in the same way
        answer.number("inertia", -1.0); // about the joint, kg m²
        answer.number("natural_frequency", -1.0); // rad/s
        answer.number("damping_ratio", -1.0);
        answer.number("steady_state_error", -1.0); // what the load leaves at rest, rad
    }

    // Task 4, "velocity-loop". `given` has inertia (kg m²), damping (N m s/rad), kp (N m s/rad), period (s).
    fn velocity_loop(&mut self, given: &Map, answer: &mut Answer) {
        answer.number("final_speed", -1.0); // with kp alone, as a share of the setpoint
        answer.number("time_constant", -1.0); // with kp alone, s
        answer.number("largest_kp", -1.0); // above it the sampled loop diverges, N m s/rad
        answer.number("largest_kd", -1.0); // above it a derivative in this loop diverges, kg m²
    }
}

impl Submission for Motors {
    // Called once before each run. What you keep in `self` is still there in `control`.
    fn init(&mut self, robot: &Robot, task: &str) {
        self.link_lengths = robot.dimensions().array("link_lengths");
        self.sum = [0.0, 0.0];
    }

    // observation.q() and observation.qd() are the angles and speeds of both joints, observation.dt() is the time between two calls,
    // observation.target() what the task wants. Write both commands, [shoulder, elbow], into `command`.
    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        let target = observation.target();
        match observation.task() {
            // Task 1: a servo turns the joints to the angles that you command, [shoulder, elbow] in rad
            "warm-up" => command.copy_from_slice(&[0.5, 0.0]),
            // From here on there is no servo: you command the motors' torques, [shoulder, elbow] in N m, every millisecond
            //
            // Task 3: the elbow to target.number("elbow_rad"), the shoulder at 0, with "kp", "ki" and "kd" of the target
            "pid" => command.copy_from_slice(&[0.0, 0.0]),
            // Task 5: the elbow at target.number("elbow_rad_s"), the shoulder held, with "kp" and "ki" of the target
            "speed" => command.copy_from_slice(&[0.0, 0.0]),
            // Task 6, "hold": the elbow to target.number("elbow_rad") exactly. Here
            // `let carried: [f64; 2] = kinemark_plugin::robot_model::gravity(observation.q());` gives the torques that hold the
            // arm still.
            _ => command.copy_from_slice(&[0.0, 0.0]),
        }
    }
}
