//! Speed limits of joints, as drives keep them: at or beyond its limit a motor gives no effort that would accelerate its joint further.
//!
//! The limit is checked once a physics step, so a joint may exceed it by what its motor adds in one step. Only the motor is limited:
//! gravity and contact can accelerate the joint beyond the limit.

use crate::model::robot::Robot;

/// The speed limits of one robot.
#[derive(Debug, Clone, PartialEq)]
pub struct SpeedLimits {
    /// By entry of `q`; infinite where there is none \[rad/s or m/s\].
    limits: Vec<f64>,
}

impl SpeedLimits {
    /// The limits of the joints of `robot`.
    pub fn new(robot: &Robot) -> Self {
        let limit =
            |joint: &crate::model::robot::Joint| joint.limits.speed.unwrap_or(f64::INFINITY);
        Self {
            limits: robot.moving_joints().map(limit).collect(),
        }
    }

    /// Whether joint `joint` of `q` at the rate `qd` has reached its limit.
    pub fn is_reached(&self, joint: usize, qd: f64) -> bool {
        qd.abs() >= self.limits[joint]
    }

    /// Sets to zero the entries of `effort` that would accelerate a joint beyond its limit; both have shape `(n)`.
    pub fn hold(&self, qd: &[f64], effort: &mut [f64]) {
        for (joint, effort) in effort.iter_mut().enumerate() {
            if *effort * qd[joint] > 0.0 && self.is_reached(joint, qd[joint]) {
                *effort = 0.0;
            }
        }
    }
}
