//! The reference solution of lab 5: closed forms, and one place of the path after the other at the speed of the drives.

use std::array::from_fn;
use std::f64::consts::PI;

use kinemark_plugin::linear::{array, norm};
use kinemark_plugin::math::{atan2, cos, sin, sqrt};
use kinemark_plugin::{Answer, Map, Observation, Robot, Rows, Submission, export};

/// Of the four joints \[rad/s, m/s, m/s, rad/s\].
const TOP_SPEED: [f64; 4] = [18.0 * PI / 180.0, 0.02, 0.02, PI];
/// Near a place the arm slows down with a time constant of 0.1 s \[1/s\].
const GAIN: f64 = 10.0;

/// The lengths of the arm \[m\].
#[derive(Default)]
struct Lengths {
    column: f64,
    carriage: f64,
    side: f64,
    reach: f64,
    drop: f64,
    gripper: f64,
}

impl Lengths {
    fn of(length: impl Fn(&str) -> f64) -> Self {
        Self {
            column: length("column"),
            carriage: length("carriage"),
            side: length("side"),
            reach: length("reach"),
            drop: length("drop"),
            gripper: length("gripper"),
        }
    }

    fn of_given(given: &Map) -> Self {
        Self::of(|name| given.number(&format!("robot.{name}")))
    }

    fn of_robot(robot: &Robot) -> Self {
        Self::of(|name| robot.dimensions().number(name))
    }

    /// How far the TCP is ahead of the column's axis: A of the brief.
    fn ahead(&self, q: &[f64]) -> f64 {
        self.reach + self.gripper - q[2]
    }

    fn branch(&self, p: [f64; 3], a: f64) -> [f64; 3] {
        [
            atan2(p[1] * self.side - p[0] * a, p[0] * self.side + p[1] * a),
            p[2] + self.drop - self.column - self.carriage,
            self.reach + self.gripper - a,
        ]
    }

    /// Both branches; `None` in the hole.
    fn branches(&self, p: [f64; 3]) -> Option<[[f64; 3]; 2]> {
        let squared = p[0] * p[0] + p[1] * p[1] - self.side * self.side;
        // the edge of the hole is within reach; rounding may put it a little inside
        if squared < -1e-12 {
            return None;
        }
        let a = sqrt(squared.max(0.0));
        Some([self.branch(p, a), self.branch(p, -a)])
    }
}

#[derive(Default)]
struct Arm {
    lengths: Lengths,
    /// Index of the place that the arm goes to.
    place: usize,
}

export!(Arm: inverse_kinematics, init, control, own tcp_pose, velocity, acceleration, joint_rates, joint_accelerations);

impl Arm {
    fn tcp_pose(&mut self, given: &Map, answer: &mut Answer) {
        let l = Lengths::of_given(given);
        let q: [f64; 4] = given.array("q");
        let a = l.ahead(&q);
        let (c1, s1, c4, s4) = (cos(q[0]), sin(q[0]), cos(q[3]), sin(q[3]));
        let pose = [
            [-c1 * s4, -c1 * c4, -s1, l.side * c1 - a * s1],
            [-s1 * s4, -s1 * c4, c1, l.side * s1 + a * c1],
            [-c4, s4, 0.0, l.column + l.carriage - l.drop + q[1]],
            [0.0, 0.0, 0.0, 1.0],
        ];
        answer.matrix("", &pose);
    }

    fn velocity(&mut self, given: &Map, answer: &mut Answer) {
        let l = Lengths::of_given(given);
        let (q, qd): ([f64; 4], [f64; 4]) = (given.array("q"), given.array("qd"));
        let a = l.ahead(&q);
        let (c1, s1) = (cos(q[0]), sin(q[0]));
        let x = -qd[0] * (a * c1 + l.side * s1) + qd[2] * s1;
        let y = -qd[0] * (a * s1 - l.side * c1) - qd[2] * c1;
        answer.list("", &[x, y, qd[1]]);
    }

    fn acceleration(&mut self, given: &Map, answer: &mut Answer) {
        let l = Lengths::of_given(given);
        let q: [f64; 4] = given.array("q");
        let (qd, qdd): ([f64; 4], [f64; 4]) = (given.array("qd"), given.array("qdd"));
        let a = l.ahead(&q);
        let (c1, s1) = (cos(q[0]), sin(q[0]));
        let (x, y) = (a * c1 + l.side * s1, a * s1 - l.side * c1);
        let (w, coriolis) = (qd[0], 2.0 * qd[0] * qd[2]);
        answer.list(
            "",
            &[
                -qdd[0] * x + qdd[2] * s1 + w * w * y + coriolis * c1,
                -qdd[0] * y - qdd[2] * c1 - w * w * x + coriolis * s1,
                qdd[1],
            ],
        );
    }

    fn joint_rates(&mut self, given: &Map, answer: &mut Answer) {
        let l = Lengths::of_given(given);
        let (q, v): ([f64; 3], [f64; 3]) = (given.array("q"), given.array("v"));
        let a = l.ahead(&q);
        let (c1, s1) = (cos(q[0]), sin(q[0]));
        // beside the column, turn and reach move the TCP along the same line: then the turn rests
        let turn = if a.abs() > 1e-9 {
            -(v[0] * c1 + v[1] * s1) / a
        } else {
            0.0
        };
        answer.number("turn", turn);
        answer.number("lift", v[2]);
        answer.number("reach", l.side * turn + s1 * v[0] - c1 * v[1]);
    }

    fn joint_accelerations(&mut self, given: &Map, answer: &mut Answer) {
        let l = Lengths::of_given(given);
        let (q, qd): ([f64; 3], [f64; 3]) = (given.array("q"), given.array("qd"));
        let wanted: [f64; 3] = given.array("a");
        let a = l.ahead(&q);
        let (c1, s1, w) = (cos(q[0]), sin(q[0]), qd[0]);
        let turn = -(wanted[0] * c1 + wanted[1] * s1 + l.side * w * w - 2.0 * w * qd[2]) / a;
        let reach = l.side * turn - a * w * w + s1 * wanted[0] - c1 * wanted[1];
        answer.number("turn", turn);
        answer.number("lift", wanted[2]);
        answer.number("reach", reach);
    }
}

impl Submission for Arm {
    fn inverse_kinematics(&mut self, robot: &Robot, position: [f64; 3], branches: &mut Rows) {
        let all = Lengths::of_robot(robot).branches(position);
        for branch in all.into_iter().flatten() {
            branches.push(&branch);
        }
    }

    fn init(&mut self, robot: &Robot, _: &str) {
        self.lengths = Lengths::of_robot(robot);
    }

    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        let target = observation.target().rows("target").nth(self.place);
        let place = array(target.expect("six places"));
        let [turn, lift, reach] = self.lengths.branches(place).expect("within reach")[0];
        let goal = [turn, lift, reach, 0.0];
        let q: [f64; 4] = array(observation.q());
        let mut off: [f64; 4] = from_fn(|i| goal[i] - q[i]);
        // at its switch the lift is at its end, wherever the drawing has it
        let is_pressed = |switch| observation.sensors().number(switch) != 0.0;
        if is_pressed("lift_lower") && off[1] < 0.0 || is_pressed("lift_upper") && off[1] > 0.0 {
            off[1] = 0.0;
        }
        if norm(off) < 5e-4 && self.place < 5 {
            self.place += 1;
        }
        for (i, command) in command.iter_mut().enumerate() {
            *command = (off[i] * GAIN).clamp(-TOP_SPEED[i], TOP_SPEED[i]);
        }
    }
}
