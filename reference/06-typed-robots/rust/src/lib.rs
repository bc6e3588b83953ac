//! The reference solution of lab 6: one walk along the row, from joint to joint, gives the poses; the axes and places of the joints that
//! it passes give the Jacobian.

use std::array::from_fn;

use kinemark_plugin::linear::{norm, solve};
use kinemark_plugin::math::{cos, sin};
use kinemark_plugin::{Answer, Map, Observation, Robot, Rows, Submission, export};

/// A tip that is off comes back with a time constant of 0.2 s \[1/s\].
const GAIN: f64 = 5.0;

/// Takes coordinates in a frame to coordinates in the base.
type Pose = [[f64; 4]; 4];

struct Joint {
    turns: bool,
    /// 0, 1 or 2 for x, y or z.
    axis: usize,
    /// To the next joint, or to the tip \[m\].
    link: [f64; 3],
}

#[derive(Default)]
struct Row {
    base_height: f64,
    joints: Vec<Joint>,
}

export!(Row: jacobian, init, control, own last_joint, tip);

impl Submission for Row {
    fn jacobian(&mut self, robot: &Robot, q: &[f64], rows: &mut Rows) {
        let jacobian = Row::new(robot.name(), robot.dimensions(), "").jacobian_of(q);
        for k in 0..6 {
            // a zero has no sign in the script, which gives the same bits
            let row: Vec<f64> = jacobian.iter().map(|column| column[k] + 0.0).collect();
            rows.push(&row);
        }
    }

    fn init(&mut self, robot: &Robot, _: &str) {
        *self = Row::new(robot.name(), robot.dimensions(), "");
    }

    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        let target = observation.target();
        let (from, to): ([f64; 3], [f64; 3]) = (target.array("from"), target.array("to"));
        let speed = target.number("speed");
        let line: [f64; 3] = from_fn(|k| to[k] - from[k]);
        let length = norm(line);
        let done = (speed * observation.time()).min(length);
        let tcp = observation.tcp();
        let v: [f64; 3] = from_fn(|k| {
            let along = line[k] / length;
            let back = (from[k] + along * done - tcp[k]) * GAIN;
            back + if done < length { along * speed } else { 0.0 }
        });
        let columns = self.jacobian_of(observation.q());
        let j = from_fn(|k| from_fn(|i| columns[i][k]));
        command.copy_from_slice(&solve(j, v).expect("a regular matrix"));
    }
}

impl Row {
    /// The robot `name`; the names of its dimensions begin with `prefix`.
    fn new(name: &str, of: &Map, prefix: &str) -> Self {
        let joint = |(i, letters): (usize, &[u8])| Joint {
            turns: letters[0] == b'R',
            axis: usize::from(letters[1] - b'x'),
            link: of.array(&format!("{prefix}link{}", i + 1)),
        };
        Self {
            base_height: of.number(&format!("{prefix}base_height")),
            joints: name.as_bytes().chunks(2).enumerate().map(joint).collect(),
        }
    }

    fn of_case(given: &Map) -> Self {
        Self::new(given.text("robot.name"), given, "robot.")
    }

    fn last_joint(&mut self, given: &Map, answer: &mut Answer) {
        let row = Row::of_case(given);
        answer.matrix("", &row.frames(given.numbers("q"))[row.joints.len()]);
    }

    fn tip(&mut self, given: &Map, answer: &mut Answer) {
        let row = Row::of_case(given);
        answer.matrix("", &row.frames(given.numbers("q"))[row.joints.len() + 1]);
    }

    /// The frames in which the joints move, one for each, then the last joint after its motion, then the tip.
    fn frames(&self, q: &[f64]) -> Vec<Pose> {
        let mut h = shift([0.0, 0.0, self.base_height]);
        let mut all = Vec::new();
        let mut last = h;
        for (joint, &q) in self.joints.iter().zip(q) {
            all.push(h);
            last = product(&h, &joint.motion(q));
            h = product(&last, &shift(joint.link));
        }
        all.extend([last, h]);
        all
    }

    /// The columns of the Jacobian of the tip, linear then angular.
    fn jacobian_of(&self, q: &[f64]) -> Vec<[f64; 6]> {
        let all = self.frames(q);
        let tip = all[self.joints.len() + 1];
        let column = |(joint, frame): (&Joint, &Pose)| {
            let a: [f64; 3] = from_fn(|k| frame[k][joint.axis]);
            if !joint.turns {
                return [a[0], a[1], a[2], 0.0, 0.0, 0.0];
            }
            let l: [f64; 3] = from_fn(|k| tip[k][3] - frame[k][3]);
            let x = a[1] * l[2] - a[2] * l[1];
            let y = a[2] * l[0] - a[0] * l[2];
            let z = a[0] * l[1] - a[1] * l[0];
            [x, y, z, a[0], a[1], a[2]]
        };
        self.joints.iter().zip(&all).map(column).collect()
    }
}

impl Joint {
    /// What the joint does when it moves by `q`, rad or m.
    fn motion(&self, q: f64) -> Pose {
        if self.turns {
            return turn(self.axis, q);
        }
        let mut way = [0.0; 3];
        way[self.axis] = q;
        shift(way)
    }
}

/// A turn takes the axis after its own towards the one after that: about x it takes y to z, about y z to x, about z x to y.
fn turn(axis: usize, angle: f64) -> Pose {
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut h = shift([0.0; 3]);
    h[next][next] = cos(angle);
    h[last][last] = cos(angle);
    h[last][next] = sin(angle);
    h[next][last] = -sin(angle);
    h
}

fn shift([x, y, z]: [f64; 3]) -> Pose {
    [
        [1.0, 0.0, 0.0, x],
        [0.0, 1.0, 0.0, y],
        [0.0, 0.0, 1.0, z],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

fn product(a: &Pose, b: &Pose) -> Pose {
    from_fn(|row| from_fn(|column| (0..4).map(|k| a[row][k] * b[k][column]).sum()))
}
