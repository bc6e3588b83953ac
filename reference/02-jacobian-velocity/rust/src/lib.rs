//! The reference solution of lab 2: the Jacobian in closed form, the speed of the line fed forward, what the hand is off fed back, and
//! damped least squares so that the inverse stays finite where the arm folds.

use std::array::from_fn;

use kinemark_plugin::linear::{array, dot, norm, solve};
use kinemark_plugin::math::{cos, pow, sin};
use kinemark_plugin::{Observation, Robot, Rows, Submission, export};

/// From rest to full speed \[s\], within the first 5 cm.
const RAMP: f64 = 0.3;
/// A hand that is off comes back with a time constant of 0.2 s \[1/s\].
const GAIN: f64 = 5.0;
/// Far below the lengths of the links, far above what the hand is off \[m\].
const DAMPING: f64 = 0.05;

#[derive(Default)]
struct Hand {
    /// Upper arm, forearm \[m\].
    link_lengths: [f64; 2],
}

export!(Hand: jacobian, init, control);

impl Submission for Hand {
    fn jacobian(&mut self, robot: &Robot, q: &[f64], rows: &mut Rows) {
        for row in jacobian(robot.dimensions().array("link_lengths"), q) {
            rows.push(&row);
        }
    }

    fn init(&mut self, robot: &Robot, _: &str) {
        self.link_lengths = robot.dimensions().array("link_lengths");
    }

    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        let target = observation.target();
        let (from, to): ([f64; 3], [f64; 3]) = (target.array("from"), target.array("to"));
        let way: [f64; 3] = from_fn(|i| to[i] - from[i]);
        let length = norm(way);
        let along = way.map(|x| x / length);
        let (s, speed) = progress(length, target.number("speed"), observation.time());
        let tcp = observation.tcp();
        // only x and y: z is the arm's own
        let v: [f64; 2] = from_fn(|i| {
            let off = from[i] + along[i] * s - tcp[i];
            along[i] * speed + off * GAIN
        });

        // qd = J^T (J J^T + d^2)^-1 v
        let j = jacobian(self.link_lengths, observation.q());
        let damping = pow(DAMPING, 2.0);
        let damped = from_fn(|i| from_fn(|k| dot(j[i], j[k]) + if i == k { damping } else { 0.0 }));
        let x = solve(damped, v).expect("a regular matrix");
        let rate: [f64; 2] = from_fn(|i| dot([j[0][i], j[1][i]], x));
        let largest = rate[0].abs().max(rate[1].abs()).max(1e-9);
        let share = (target.number("max_rate") / largest).min(1.0);
        command.copy_from_slice(&rate.map(|rate| rate * share));
    }
}

/// Rows x and y of the hand's velocity by the speeds of the two joints \[m/rad\].
fn jacobian(l: [f64; 2], q: &[f64]) -> [[f64; 2]; 2] {
    let q: [f64; 2] = array(q);
    let s1 = l[0] * sin(q[0]);
    let c1 = l[0] * cos(q[0]);
    let s12 = l[1] * sin(q[0] + q[1]);
    let c12 = l[1] * cos(q[0] + q[1]);
    [[-s1 - s12, -s12], [c1 + c12, c12]]
}

/// How far along the line the hand should be after `t` \[m\], and how fast \[m/s\]: from rest to the speed, steady, and to rest again.
fn progress(length: f64, speed: f64, t: f64) -> (f64, f64) {
    let end = length / speed + RAMP;
    if t < RAMP {
        return (0.5 * speed * t * t / RAMP, speed * t / RAMP);
    }
    if t < end - RAMP {
        return (speed * (t - 0.5 * RAMP), speed);
    }
    let left = (end - t).max(0.0);
    (
        length - 0.5 * speed * left * left / RAMP,
        speed * left / RAMP,
    )
}
