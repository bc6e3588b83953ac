//! The robot among the bodies: where its links are at the start of a step, and how its joints answer to impulses.

use nalgebra::{DMatrix, Vector3};

use crate::dynamics::ForwardDynamics;
use crate::kinematics::body_motion::{BodyMotions, Motion};
use crate::model::robot::Robot;

/// The robot in one step.
#[derive(Debug, Clone)]
pub(super) struct Arm {
    motions: BodyMotions,
    dynamics: ForwardDynamics,
    /// Half of what viscous damping takes from a unit of velocity in a step: it resists an impulse that is spread over the step like
    /// inertia \[kg m² or kg\].
    resists: Vec<f64>,
    /// Joint rates per unit impulse, shape `(n, n)`; empty where the mass matrix is singular.
    response: DMatrix<f64>,
    /// Room for a row.
    row: Vec<f64>,
}

impl Arm {
    pub(super) fn new(robot: &Robot, dt_s: f64) -> Self {
        let mut resists = vec![0.0; robot.n()];
        for body in robot.bodies() {
            resists[body.q_index] += 0.5 * dt_s * body.gear * body.gear * body.damping;
        }
        Self {
            motions: BodyMotions::new(robot),
            dynamics: ForwardDynamics::new(robot),
            resists,
            response: DMatrix::zeros(0, 0),
            row: vec![0.0; robot.n()],
        }
    }

    /// Moves the links to `(q, qd)`, shape `(n)` each.
    pub(super) fn place(&mut self, robot: &Robot, q: &[f64], qd: &[f64]) {
        self.motions.update(robot, q, qd);
    }

    /// The motion of body `index` of the robot at the start of the step.
    pub(super) fn motion(&self, index: usize) -> &Motion {
        self.motions.body(index)
    }

    /// Computes how the joints answer to impulses at `q`.
    pub(super) fn weigh(&mut self, robot: &Robot, q: &[f64]) {
        let inverse = self.dynamics.inverse_inertia(robot, q, Some(&self.resists));
        self.response = inverse.unwrap_or_else(|| DMatrix::zeros(robot.n(), robot.n()));
    }

    /// Writes the change of the joint rates by an impulse of one along `row`.
    pub(super) fn respond(&self, row: &[f64], change: &mut [f64]) {
        for (column, entry) in row.iter().enumerate() {
            if *entry != 0.0 {
                for (change, response) in change.iter_mut().zip(self.response.column(column).iter())
                {
                    *change += response * entry;
                }
            }
        }
    }

    /// The row of the speed along `direction` of the point `p` of body `index`, world axes: `row · qd`.
    pub(super) fn along(
        &mut self,
        robot: &Robot,
        index: usize,
        p: &Vector3<f64>,
        direction: &Vector3<f64>,
    ) -> &[f64] {
        self.fill(robot, index, |motion, turns| {
            let axis = motion.placed.axis();
            if turns {
                direction.dot(&axis.cross(&(p - motion.placed.position)))
            } else {
                direction.dot(&axis)
            }
        })
    }

    /// The row of the angular velocity of body `index` along `direction`, world axes.
    pub(super) fn about(
        &mut self,
        robot: &Robot,
        index: usize,
        direction: &Vector3<f64>,
    ) -> &[f64] {
        self.fill(robot, index, |motion, turns| {
            if turns {
                direction.dot(&motion.placed.axis())
            } else {
                0.0
            }
        })
    }

    fn fill(
        &mut self,
        robot: &Robot,
        index: usize,
        entry: impl Fn(&Motion, bool) -> f64,
    ) -> &[f64] {
        self.row.fill(0.0);
        let mut next = Some(index);
        while let Some(index) = next {
            let body = &robot.bodies()[index];
            self.row[body.q_index] += body.gear * entry(self.motions.body(index), body.turns);
            next = body.parent;
        }
        &self.row
    }

    /// The row of joint `index` alone.
    pub(super) fn joint(&mut self, index: usize, sign: f64) -> &[f64] {
        self.row.fill(0.0);
        self.row[index] = sign;
        &self.row
    }
}
