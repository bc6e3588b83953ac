//! The bodies of a scene as frames under the world.

use kinemark_sim::trace::Trace;

use super::message::{FrameTransform, FrameTransforms, Pose, Time};
use super::names::{WORLD, body_frame};
use crate::graded::TaskRun;

/// Every body of the scene of a run: those that stand where they stand, the others where the trace says.
pub(super) struct Bodies {
    /// Names of frames, and the pose of a body that never moves.
    frames: Vec<(String, Option<Pose>)>,
}

impl Bodies {
    pub(super) fn new(run: &TaskRun) -> Self {
        let bodies = run.scene.iter().flat_map(|scene| &scene.scene.bodies);
        let frame = |(index, body): (usize, &kinemark_sim::scene::SceneBody)| {
            let moves = run.trace.moving_bodies.contains(&index);
            let stands = (!moves).then(|| Pose::new(&body.world_from_body));
            (body_frame(&body.name), stands)
        };
        Self {
            frames: bodies.enumerate().map(frame).collect(),
        }
    }

    /// Adds where every body is at `tick`; one whose pose is not finite is left out.
    pub(super) fn add<'a>(
        &'a self,
        trace: &Trace,
        tick: usize,
        timestamp: Time,
        to: &mut FrameTransforms<'a>,
    ) {
        for (index, (name, stands)) in self.frames.iter().enumerate() {
            let pose = match (stands, trace.world_from_body(index, tick)) {
                (Some(pose), _) => *pose,
                (None, Some(pose)) if pose.translation.vector.iter().all(|x| x.is_finite()) => {
                    Pose::new(&pose)
                }
                (None, _) => continue,
            };
            to.transforms.push(FrameTransform {
                timestamp,
                parent_frame_id: WORLD,
                child_frame_id: name,
                translation: pose.position,
                rotation: pose.orientation,
            });
        }
    }
}
