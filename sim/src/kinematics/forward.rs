//! Forward kinematics: the pose of every body, and through it of every frame, in the world.

use nalgebra::{Matrix3, Vector3};

use crate::joint_space::JointPositions;
use crate::model::robot::{Attachment, Body, Frame, Robot};
use crate::spatial::{Pose, pose};

/// Pose of a moving body in the world, with the rotation as a plain matrix, for the recursive algorithms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BodyPose {
    pub(crate) world_from_body: Matrix3<f64>,
    pub(crate) position: Vector3<f64>,
}

impl BodyPose {
    pub(crate) const WORLD: Self = Self {
        world_from_body: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        position: Vector3::new(0.0, 0.0, 0.0),
    };

    /// The pose of `body` on its `parent` at the joint position `q`.
    #[inline(always)]
    pub(crate) fn on_parent(parent: &Self, body: &Body, q: f64) -> Self {
        Self::unmoved(parent, body).moved(body, q)
    }

    /// The pose of `body` on its `parent` at the joint position 0.
    #[inline(always)]
    pub(crate) fn unmoved(parent: &Self, body: &Body) -> Self {
        Self {
            world_from_body: parent.world_from_body * body.parent_from_body,
            position: parent.position + parent.world_from_body * body.p_body_in_parent,
        }
    }

    /// This pose of `body` at the joint position 0, moved to `q`.
    #[inline(always)]
    pub(crate) fn moved(&self, body: &Body, q: f64) -> Self {
        let (origin, still) = (self.position, &self.world_from_body);
        if body.turns {
            let (s, c) = libm::sincos(q);
            // turning about z mixes the first two columns only
            let x = still.column(0) * c + still.column(1) * s;
            let y = still.column(1) * c - still.column(0) * s;
            Self {
                world_from_body: Matrix3::from_columns(&[x, y, still.column(2).into_owned()]),
                position: origin,
            }
        } else {
            Self {
                world_from_body: *still,
                position: origin + still.column(2) * q,
            }
        }
    }

    /// The joint's axis in the world.
    #[inline]
    pub(crate) fn axis(&self) -> Vector3<f64> {
        self.world_from_body.column(2).into_owned()
    }
}

/// The poses of all frames of a robot in the world, for one `q`.
#[derive(Debug, Clone, PartialEq)]
pub struct FramePoses {
    pub(crate) placed: Vec<BodyPose>,
}

impl FramePoses {
    /// The poses of `robot` at `q = 0`, to be changed by [`FramePoses::update`].
    pub fn new(robot: &Robot) -> Self {
        let mut poses = Self {
            placed: vec![BodyPose::WORLD; robot.bodies().len()],
        };
        poses.update(robot, &vec![0.0; robot.n()]);
        poses
    }

    /// Moves every body to `q` \[rad or m\], shape `(n)`. Allocates nothing.
    ///
    /// # Panics
    /// If `q` has another length than [`Robot::n`], or `robot` is not the one the poses were made for.
    pub fn update(&mut self, robot: &Robot, q: &[f64]) {
        assert_eq!(q.len(), robot.n(), "one position per joint that moves");
        for (i, body) in robot.bodies().iter().enumerate() {
            let parent = body.parent.map_or(BodyPose::WORLD, |p| self.placed[p]);
            self.placed[i] = BodyPose::on_parent(&parent, body, body.position(q));
        }
    }

    /// The pose `world_from_frame`.
    pub fn world_from(&self, frame: &Frame) -> Pose {
        let Attachment {
            body,
            body_from_here,
        } = &frame.attachment;
        match body {
            None => *body_from_here,
            Some(body) => {
                let BodyPose {
                    world_from_body,
                    position,
                } = self.placed[*body];
                pose(world_from_body, position) * body_from_here
            }
        }
    }
}

/// The poses of all frames of `robot` at `q`.
pub fn forward_kinematics(robot: &Robot, q: &JointPositions) -> FramePoses {
    let mut poses = FramePoses::new(robot);
    poses.update(robot, q.as_slice());
    poses
}
