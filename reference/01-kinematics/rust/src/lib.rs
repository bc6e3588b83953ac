//! The reference solution of lab 1: closed forms, and quintic moves between the two places.

use kinemark_plugin::linear::array;
use kinemark_plugin::math::{acos, atan2, cos, lerp, quintic, sin, wrap_pi};
use kinemark_plugin::{Observation, Robot, Rows, Submission, export};

/// More than is asked for \[s\]: the arm settles while it stands.
const DWELL: f64 = 0.9;
/// The time of a move \[s\].
const MOVE: f64 = 1.6;

/// The dimensions of the arm \[m\].
#[derive(Default)]
struct Arm {
    base_height: f64,
    link_lengths: [f64; 2],
    link_offset: f64,
}

impl Arm {
    fn of(robot: &Robot) -> Self {
        let dimensions = robot.dimensions();
        Self {
            base_height: dimensions.number("base_height"),
            link_lengths: dimensions.array("link_lengths"),
            link_offset: dimensions.number("link_offset"),
        }
    }

    /// Both branches; `None` out of reach.
    fn angles(&self, position: [f64; 3]) -> Option<[[f64; 2]; 2]> {
        let [l1, l2] = self.link_lengths;
        let u = position[0] - self.base_height;
        let y = position[1];
        let c = (u * u + y * y - l1 * l1 - l2 * l2) / (2.0 * l1 * l2);
        // the boundary itself is in reach; what lies beyond it by more than rounding is not
        if c.abs() > 1.0 + 1e-9 {
            return None;
        }
        let bend = acos(c.clamp(-1.0, 1.0));
        Some([bend, -bend].map(|bend| {
            let shoulder = atan2(y, u) - atan2(l2 * sin(bend), l1 + l2 * cos(bend));
            [shoulder, bend]
        }))
    }
}

#[derive(Default)]
struct Mover {
    arm: Arm,
    moves: Option<Moves>,
}

/// Where the arm is on its way through the two places.
struct Moves {
    from: [f64; 2],
    goals: [[f64; 2]; 2],
    /// Index of the goal that it goes to.
    leg: usize,
    /// When it left for it \[s\].
    start: f64,
}

export!(Mover: forward_kinematics, inverse_kinematics, init, control);

impl Submission for Mover {
    fn forward_kinematics(&mut self, robot: &Robot, q: &[f64]) -> [f64; 3] {
        let arm = Arm::of(robot);
        let l = arm.link_lengths;
        let x = arm.base_height + l[0] * cos(q[0]) + l[1] * cos(q[0] + q[1]);
        let y = l[0] * sin(q[0]) + l[1] * sin(q[0] + q[1]);
        [x, y, 2.0 * arm.link_offset]
    }

    fn inverse_kinematics(&mut self, robot: &Robot, position: [f64; 3], branches: &mut Rows) {
        for branch in Arm::of(robot).angles(position).into_iter().flatten() {
            branches.push(&branch);
        }
    }

    fn init(&mut self, robot: &Robot, _: &str) {
        self.arm = Arm::of(robot);
    }

    fn control(&mut self, observation: &Observation, command: &mut [f64]) {
        let arm = &self.arm;
        let moves = self.moves.get_or_insert_with(|| {
            let mut targets = observation.target().rows("target");
            // the elbow bends the same way at both places
            let mut goals = [(); 2].map(|()| {
                let target = targets.next().expect("two places");
                arm.angles(array(target)).expect("places within reach")[0]
            });
            // the shoulder takes the short way round
            goals[1][0] = goals[0][0] + wrap_pi(goals[1][0] - goals[0][0]);
            Moves {
                from: array(observation.q()),
                goals,
                leg: 0,
                start: 0.0,
            }
        });
        if moves.leg == 0 && observation.time() >= moves.start + MOVE + DWELL {
            moves.from = moves.goals[0];
            moves.start = observation.time();
            moves.leg = 1;
        }
        let s = ((observation.time() - moves.start) / MOVE).clamp(0.0, 1.0);
        for (i, command) in command.iter_mut().enumerate() {
            *command = lerp(moves.from[i], moves.goals[moves.leg][i], quintic(s));
        }
    }
}
