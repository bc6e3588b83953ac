//! Speed limits of joints, as drives keep them: at or beyond its limit a motor gives nothing that would drive its joint faster.
//!
//! The limit is looked at once a physics step, so a joint may be faster by what its motor does to it in one; and nothing but its
//! motor is held back: gravity and contact may make it as fast as they like.

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

    /// Takes from `effort` what drives a joint faster that has reached its limit; both have shape `(n)`.
    pub fn hold(&self, qd: &[f64], effort: &mut [f64]) {
        for (joint, effort) in effort.iter_mut().enumerate() {
            if *effort * qd[joint] > 0.0 && self.is_reached(joint, qd[joint]) {
                *effort = 0.0;
            }
        }
    }
}
