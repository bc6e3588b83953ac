//! The frames of a robot as a tree under the world.

use foxglove::messages::{FrameTransform, FrameTransforms, Timestamp};
use kinemark_sim::kinematics::FramePoses;
use kinemark_sim::model::robot::{Frame, Robot};
use kinemark_sim::spatial::Pose as Isometry;

use super::message::pose;
use super::names::{WORLD, frame_id};

/// Every frame of a robot with the one it hangs on.
pub(super) struct Tree<'a> {
    robot: &'a Robot,
    /// Each frame's name, and which frame it hangs on.
    branches: Vec<(String, Option<usize>)>,
}

impl<'a> Tree<'a> {
    /// The tree of a robot; `prefix` stands before the name of every frame.
    pub(super) fn new(robot: &'a Robot, prefix: &str) -> Self {
        let links = robot.links().len();
        let hangs_on = |(i, frame): (usize, &Frame)| {
            let parent = if i < links {
                robot
                    .joints()
                    .iter()
                    .find(|joint| joint.child == i)
                    .map(|joint| joint.parent)
            } else {
                Some(frame.link)
            };
            (format!("{prefix}{}", frame_id(robot, frame)), parent)
        };
        Self {
            robot,
            branches: robot.frames().iter().enumerate().map(hangs_on).collect(),
        }
    }

    /// Every frame on the one it hangs on.
    pub(super) fn transforms(&self, poses: &FramePoses, timestamp: Timestamp) -> FrameTransforms {
        let world_from: Vec<Isometry> = self
            .robot
            .frames()
            .iter()
            .map(|frame| poses.world_from(frame))
            .collect();
        FrameTransforms {
            transforms: self
                .branches
                .iter()
                .enumerate()
                .map(|(i, (name, parent))| {
                    let pose = pose(&match parent {
                        Some(parent) => world_from[*parent].inv_mul(&world_from[i]),
                        None => world_from[i],
                    });
                    FrameTransform {
                        timestamp: Some(timestamp),
                        parent_frame_id: parent
                            .map_or(WORLD, |parent| &self.branches[parent].0)
                            .to_owned(),
                        child_frame_id: name.clone(),
                        translation: pose.position,
                        rotation: pose.orientation,
                    }
                })
                .collect(),
        }
    }
}
