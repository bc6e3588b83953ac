//! The motion of every body at `(q, qd)`: its twist, and its acceleration at `qdd = 0`.

use nalgebra::Vector3;

use super::forward::BodyPose;
use crate::model::robot::{Attachment, Robot};

/// Motion of one body, world axes, reference point at its own origin.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion {
    pub(crate) placed: BodyPose,
    /// Angular velocity \[rad/s\].
    pub(crate) w: Vector3<f64>,
    /// Velocity of the origin \[m/s\].
    pub(crate) v: Vector3<f64>,
    /// Angular acceleration at `qdd = 0` \[rad/s²\].
    pub(crate) dw: Vector3<f64>,
    /// Classical acceleration of the origin at `qdd = 0` \[m/s²\].
    pub(crate) a: Vector3<f64>,
}

/// Motion of one point fixed to a body, world axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PointMotion {
    pub(crate) position: Vector3<f64>,
    pub(crate) velocity: Vector3<f64>,
    pub(crate) acceleration: Vector3<f64>,
}

impl Motion {
    pub(crate) const STILL: Self = Self {
        placed: BodyPose::WORLD,
        w: Vector3::new(0.0, 0.0, 0.0),
        v: Vector3::new(0.0, 0.0, 0.0),
        dw: Vector3::new(0.0, 0.0, 0.0),
        a: Vector3::new(0.0, 0.0, 0.0),
    };

    /// The motion of a point `r` away from the origin, world axes.
    pub(crate) fn at(&self, r: &Vector3<f64>) -> PointMotion {
        let swing = self.w.cross(r);
        PointMotion {
            position: self.placed.position + r,
            velocity: self.v + swing,
            acceleration: self.a + self.dw.cross(r) + self.w.cross(&swing),
        }
    }
}

/// The motions of all bodies of one robot.
#[derive(Debug, Clone)]
pub(crate) struct BodyMotions {
    motions: Vec<Motion>,
}

impl BodyMotions {
    pub(crate) fn new(robot: &Robot) -> Self {
        Self {
            motions: vec![Motion::STILL; robot.bodies().len()],
        }
    }

    /// Moves every body to `(q, qd)`.
    pub(crate) fn update(&mut self, robot: &Robot, q: &[f64], qd: &[f64]) {
        for (i, body) in robot.bodies().iter().enumerate() {
            let parent = body.parent.map_or(Motion::STILL, |p| self.motions[p]);
            let placed = BodyPose::on_parent(&parent.placed, body, body.position(q));
            let carried = parent.at(&(placed.position - parent.placed.position));
            let drive = placed.axis() * body.rate(qd);
            let turned = parent.w.cross(&drive);
            self.motions[i] = if body.turns {
                Motion {
                    placed,
                    w: parent.w + drive,
                    v: carried.velocity,
                    dw: parent.dw + turned,
                    a: carried.acceleration,
                }
            } else {
                Motion {
                    placed,
                    w: parent.w,
                    v: carried.velocity + drive,
                    dw: parent.dw,
                    a: carried.acceleration + turned * 2.0,
                }
            };
        }
    }

    /// The motion of the body to which `attachment` is fixed, or of the world.
    pub(crate) fn of(&self, attachment: &Attachment) -> Motion {
        attachment.body.map_or(Motion::STILL, |i| self.motions[i])
    }

    pub(crate) fn body(&self, index: usize) -> &Motion {
        &self.motions[index]
    }
}
