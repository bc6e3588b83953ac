//! The reference solution of lab 4: the hand goes along each line at the speed asked for and is steered back to the line beside it; the
//! inverse of the Jacobian turns the hand's velocity into those of the joints.

use std::array::from_fn;

use kinemark_plugin::linear::{array, dot, norm, solve};
use kinemark_plugin::math::{cos, sin};
use kinemark_plugin::{Observation, Robot, Rows, Submission, export};

/// How quickly the hand goes back to the line \[1/s\].
const BACK: f64 = 6.0;

#[derive(Default)]
struct Knocker {
    /// Upper arm, forearm \[m\].
    link_lengths: [f64; 2],
    /// Index of the point at which the line begins that the hand is on.
    segment: usize,
}

export!(Knocker: init, jacobian, control);

impl Submission for Knocker {
    fn init(&mut self, robot: &Robot, _: &str) {
        self.link_lengths = robot.dimensions().array("link_lengths");
    }

    fn jacobian(&mut self, robot: &Robot, q: &[f64], rows: &mut Rows) {
        for row in jacobian(robot.dimensions().array("link_lengths"), q) {
            rows.push(&row);
        }
    }

    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        let target = observation.target();
        let [x, y, _] = observation.tcp();
        let hand = [x, y];
        let points: Vec<[f64; 2]> = target
            .rows("points")
            .map(|point| array(&point[..2]))
            .collect();
        let last = points.len() - 2;
        let (from, to) = (points[self.segment], points[self.segment + 1]);
        let line: [f64; 2] = from_fn(|i| to[i] - from[i]);
        let length = norm(line);
        let along = line.map(|x| x / length);

        // how much of the line lies ahead
        let ahead: [f64; 2] = from_fn(|i| to[i] - hand[i]);
        let left = dot(ahead, along);
        if left <= 0.0 && self.segment < last {
            self.segment += 1;
        }
        // from the hand to the line, straight across
        let beside: [f64; 2] = from_fn(|i| ahead[i] - left * along[i]);

        // at the very end the hand comes to rest on the last point
        let speed = target.number("speed");
        let speed = if self.segment == last {
            speed.min(BACK * left)
        } else {
            speed
        };
        let v = from_fn(|i| speed * along[i] + BACK * beside[i]);
        let rates = solve(jacobian(self.link_lengths, observation.q()), v);
        command.copy_from_slice(&rates.expect("a regular Jacobian"));
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
