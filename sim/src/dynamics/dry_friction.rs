//! Dry friction over one step: the effort, within `-positive ..= negative`, that brings each joint as near to rest as possible.
//!
//! A sign function inside the integrator would chatter around rest. Instead the effort is computed once a step and held, like that of
//! a servo: it stops a joint that can be stopped within the step (so a joint sticks exactly), and otherwise opposes motion with its
//! full value. The joints are coupled through the mass matrix, so the efforts are found together by projected Gauss-Seidel.
//!
//! Source: Stewart & Trinkle, *An implicit time-stepping scheme for rigid body dynamics* (1996), restricted to joint friction.

use nalgebra::DVector;

use super::forward::ForwardDynamics;
use crate::model::joint_friction::JointFriction;
use crate::model::robot::Robot;

/// Sweeps over the joints. The iteration contracts on any positive definite matrix; 40 sweeps leave less than rounding on arms.
const SWEEPS: usize = 40;

/// The friction efforts of one robot and their scratch memory; does nothing for a robot without dry friction.
#[derive(Debug, Clone)]
pub struct DryFriction {
    limits: Vec<JointFriction>,
    rates: DVector<f64>,
    efforts: Vec<f64>,
    present: bool,
}

impl DryFriction {
    /// Allocates the scratch memory for `robot`.
    pub fn new(robot: &Robot) -> Self {
        let n = robot.n();
        let limits = friction_by_entry(robot);
        Self {
            present: limits
                .iter()
                .any(|limit| limit.positive > 0.0 || limit.negative > 0.0),
            limits,
            rates: DVector::zeros(n),
            efforts: vec![0.0; n],
        }
    }

    /// Whether the robot has any dry friction.
    pub fn is_present(&self) -> bool {
        self.present
    }

    /// The friction efforts to hold over the step, shape `(n)`, where `qdd` is the acceleration without them. In a step that takes
    /// damping implicitly, `added` is the inertia that it adds, shape `(n)`, and `qdd` is the acceleration with it.
    ///
    /// All zero if the mass matrix is not positive definite: the step itself then reports the singular joint.
    pub fn efforts(
        &mut self,
        robot: &Robot,
        dynamics: &mut ForwardDynamics,
        dt_s: f64,
        (q, qd): (&[f64], &[f64]),
        added: Option<&[f64]>,
        qdd: &[f64],
    ) -> &[f64] {
        let n = self.limits.len();
        self.efforts.fill(0.0);
        let Some(inverse) = dynamics.inverse_inertia(robot, q, added) else {
            return &self.efforts;
        };
        for i in 0..n {
            self.rates[i] = qd[i] + dt_s * qdd[i];
        }
        for _ in 0..SWEEPS {
            // a sweep that changes no bit is followed by others that change none
            let mut is_settled = true;
            for i in 0..n {
                let per_effort = dt_s * inverse[(i, i)];
                // no effort moves a joint that the loops lock
                if per_effort <= 0.0 {
                    continue;
                }
                let wanted = self.efforts[i] - self.rates[i] / per_effort;
                let next = wanted.clamp(-self.limits[i].positive, self.limits[i].negative);
                let change = next - self.efforts[i];
                is_settled &= next.to_bits() == self.efforts[i].to_bits();
                self.efforts[i] = next;
                for j in 0..n {
                    let rate = self.rates[j] + dt_s * inverse[(j, i)] * change;
                    is_settled &= rate.to_bits() == self.rates[j].to_bits();
                    self.rates[j] = rate;
                }
            }
            if is_settled {
                break;
            }
        }
        &self.efforts
    }
}

/// The dry friction against motion of each entry of `q`: that of its joint, and of the joints that mimic it.
pub(crate) fn friction_by_entry(robot: &Robot) -> Vec<JointFriction> {
    let mut limits = vec![JointFriction::default(); robot.n()];
    for body in robot.bodies() {
        let friction = body.joint_friction().through(body.gear);
        let limit = &mut limits[body.q_index];
        limit.positive += friction.positive;
        limit.negative += friction.negative;
    }
    limits
}
