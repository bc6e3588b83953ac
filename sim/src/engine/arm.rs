//! The robot among the bodies: where its links are in a step, and how its joints answer to impulses.
//!
//! Contact points are found where the links are at the start of a step. Impulses see the links in its middle: so the directions in which
//! they act and push are right to second order.

use nalgebra::{DMatrix, Vector3};

use crate::dynamics::ForwardDynamics;
use crate::kinematics::body_motion::{BodyMotions, Motion};
use crate::kinematics::forward::BodyPose;
use crate::model::robot::Robot;

/// The robot in one step.
#[derive(Debug, Clone)]
pub(super) struct Arm {
    motions: BodyMotions,
    /// Where each body was when contact points were found.
    found_at: Vec<BodyPose>,
    middle_q: Vec<f64>,
    dynamics: ForwardDynamics,
    /// Half of what viscous damping takes from a unit of velocity in a step: it resists an impulse that is spread over the step like
    /// inertia \[kg m² or kg\].
    resists: Vec<f64>,
    /// Joint rates per unit impulse, shape `(n, n)`; zero where the mass matrix is singular.
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
            found_at: vec![BodyPose::WORLD; robot.bodies().len()],
            middle_q: vec![0.0; robot.n()],
            dynamics: ForwardDynamics::new(robot),
            resists,
            response: DMatrix::zeros(robot.n(), robot.n()),
            row: vec![0.0; robot.n()],
        }
    }

    /// Moves the links to where a step starts, `(q, qd)` of shape `(n)` each, to find contact points there.
    pub(super) fn place(&mut self, robot: &Robot, q: &[f64], qd: &[f64]) {
        self.motions.update(robot, q, qd);
        for (index, found_at) in self.found_at.iter_mut().enumerate() {
            *found_at = self.motions.body(index).placed;
        }
    }

    /// Where body `index` of the robot is at the start of the step.
    pub(super) fn placed(&self, index: usize) -> &BodyPose {
        &self.found_at[index]
    }

    /// Moves the links on to the middle of the step that ends at `next_q` without contact.
    pub(super) fn advance_to_middle(
        &mut self,
        robot: &Robot,
        q: &[f64],
        qd: &[f64],
        next_q: &[f64],
    ) {
        for (middle, (q, next)) in self.middle_q.iter_mut().zip(q.iter().zip(next_q)) {
            *middle = 0.5 * (q + next);
        }
        self.motions.update(robot, &self.middle_q, qd);
    }

    /// Where the matter of body `index` that was at `p` at the start of the step is in its middle, world axes.
    pub(super) fn carried(&self, index: usize, p: &Vector3<f64>) -> Vector3<f64> {
        let (from, to) = (&self.found_at[index], &self.motions.body(index).placed);
        to.position + to.world_from_body * (from.world_from_body.transpose() * (p - from.position))
    }

    /// Computes how the joints answer to impulses in the middle of the step.
    pub(super) fn weigh(&mut self, robot: &Robot) {
        let added = Some(self.resists.as_slice());
        let inverse = self.dynamics.inverse_inertia(robot, &self.middle_q, added);
        match inverse {
            Some(inverse) => self.response.copy_from(inverse),
            None => self.response.fill(0.0),
        }
    }

    /// Lets no impulse change its motion in this step.
    pub(super) fn hold(&mut self) {
        self.response.fill(0.0);
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

    /// The row of the speed along `direction` of the matter of body `index` that is at `p` in the middle of the step, world axes:
    /// `row · qd`.
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
