//! An event as a sentence, with the names of the robot and the scene.

use nalgebra::Vector3;

use super::event::{EventKind, Side, Unresolved};
use crate::model::contact::Party;
use crate::model::robot::{JointKind, Robot};
use crate::model::scene::Scene;
use crate::text::number::trimmed;

/// The robot, scene and frame whose names appear in sentences.
#[derive(Debug, Clone, Copy)]
pub struct Names<'a> {
    /// The robot that moved.
    pub robot: &'a Robot,
    /// The scene around it.
    pub scene: Option<&'a Scene>,
    /// The frame in which students work.
    pub seen_from: &'a str,
}

impl<'a> Names<'a> {
    /// The name of a joint by its index in `q`.
    pub fn joint(&self, index: usize) -> &'a str {
        let found = self.robot.moving_joints().nth(index);
        found.map_or("?", |joint| joint.name.as_str())
    }

    /// The unit of a joint's position by its index in `q`: `m` or `rad`.
    pub fn joint_unit(&self, index: usize) -> &'static str {
        match self
            .robot
            .moving_joints()
            .nth(index)
            .map(|joint| joint.kind)
        {
            Some(JointKind::Prismatic) => "m",
            Some(JointKind::Revolute | JointKind::Continuous | JointKind::Fixed) | None => "rad",
        }
    }

    /// The name of a body of the scene.
    pub fn body(&self, index: usize) -> &'a str {
        let found = self.scene.and_then(|scene| scene.bodies.get(index));
        found.map_or("?", |body| body.name.as_str())
    }

    /// The name of a party of a contact.
    pub fn party(&self, party: Party) -> &'a str {
        match party {
            Party::Link(index) => self.robot.links().get(index).map_or("?", |link| &link.name),
            Party::Body(index) => self.body(index),
            Party::Ground => "ground",
        }
    }

    /// The event as a sentence without a full stop.
    pub fn event(&self, kind: &EventKind) -> String {
        match kind {
            EventKind::Saturated { joint } => {
                format!("effort of `{}` reached its limit", self.joint(*joint))
            }
            EventKind::LimitHit { joint } => {
                format!("`{}` reached a position limit", self.joint(*joint))
            }
            EventKind::SpeedLimitHit { joint } => {
                format!("`{}` reached its speed limit", self.joint(*joint))
            }
            EventKind::UnderResolved { joint, why } => {
                let joint = self.joint(*joint);
                match why {
                    Unresolved::Step => format!(
                        "`{joint}` moves too fast for the physics step: by now 1 % of its speed is the error of the step"
                    ),
                    Unresolved::ServoPeriod { stable_s } => format!(
                        "the servo of `{joint}` is unstable: its gains need a servo period below {} ms",
                        trimmed(stable_s * 1e3, 3)
                    ),
                }
            }
            EventKind::NearSingular => {
                "the arm is near a singular configuration: the TCP cannot move in some direction"
                    .to_owned()
            }
            EventKind::Touched { parties } => {
                let [first, second] = parties.map(|party| self.party(party));
                format!("`{first}` touched `{second}`")
            }
            EventKind::Moved { body } => format!("`{}` moved", self.body(*body)),
            EventKind::Toppled { body } => format!("`{}` toppled", self.body(*body)),
            EventKind::LeftSupport { body } => {
                format!("`{}` lost its support", self.body(*body))
            }
            EventKind::BodyFell { body, side } => match side {
                None => format!("`{}` fell", self.body(*body)),
                Some(side) => format!(
                    "`{}` fell over the {} side{}",
                    self.body(*body),
                    side.seen.name(),
                    self.axis(side)
                ),
            },
            EventKind::Diverged => "the simulation diverged".to_owned(),
            EventKind::Stopped => "the submission was stopped".to_owned(),
        }
    }

    /// The axis of the students' frame that leads out over a side, in brackets, if one does within 20 degrees.
    fn axis(&self, side: &Side) -> String {
        let Some(frame) = self.robot.frame(self.seen_from) else {
            return String::new();
        };
        // a moving frame has no fixed axes
        if frame.attachment.body.is_some() {
            return String::new();
        }
        let world_from_frame = frame.attachment.body_from_here.rotation;
        let out: Vector3<f64> = world_from_frame.inverse_transform_vector(&side.outward);
        let axis = out.iamax();
        if out[axis].abs() < 0.94 {
            return String::new();
        }
        let sign = if out[axis] > 0.0 { '+' } else { '-' };
        format!(" ({sign}{})", ["x", "y", "z"][axis])
    }
}
