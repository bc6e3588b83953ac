//! The bodies of a scene as frames under the world.

use foxglove::messages::{FrameTransform, FrameTransforms, Pose, Timestamp};
use kinemark_sim::trace::Trace;

use super::message::pose;
use super::names::{REFERENCE, WORLD, body_frame};
use kinemark_grader::record::graded::TaskRun;

/// Every body of the scene of a run: those that stand where they stand, the others where the trace says.
pub(super) struct Bodies {
    /// Indices in the scene, names of frames, and the pose of a body that never moves.
    frames: Vec<(usize, String, Option<Pose>)>,
}

impl Bodies {
    pub(super) fn new(run: &TaskRun) -> Self {
        let bodies = run.scene.iter().flat_map(|scene| &scene.scene.bodies);
        let frame = |(index, body): (usize, &kinemark_sim::model::scene::SceneBody)| {
            let moves = run.trace.moving_bodies.contains(&index);
            let stands = (!moves).then(|| pose(&body.world_from_body));
            (index, body_frame(&body.name), stands)
        };
        Self {
            frames: bodies.enumerate().map(frame).collect(),
        }
    }

    /// The bodies that moved in the reference solution's run, as its own.
    pub(super) fn of_reference(run: &TaskRun, trace: &Trace) -> Self {
        let bodies = run.scene.iter().flat_map(|scene| &scene.scene.bodies);
        let moving = bodies.enumerate();
        let moving = moving.filter(|(index, _)| trace.moving_bodies.contains(index));
        let frame = |(index, body): (usize, &kinemark_sim::model::scene::SceneBody)| {
            let name = format!("{REFERENCE}{}", body_frame(&body.name));
            (index, name, None)
        };
        Self {
            frames: moving.map(frame).collect(),
        }
    }

    /// Adds where every body is at `tick`; one whose pose is not finite is left out.
    pub(super) fn add(
        &self,
        trace: &Trace,
        tick: usize,
        timestamp: Timestamp,
        to: &mut FrameTransforms,
    ) {
        for (index, name, stands) in &self.frames {
            let at = match (stands, trace.world_from_body(*index, tick)) {
                (Some(stands), _) => *stands,
                (None, Some(moved)) if moved.translation.vector.iter().all(|x| x.is_finite()) => {
                    pose(&moved)
                }
                (None, _) => continue,
            };
            to.transforms.push(FrameTransform {
                timestamp: Some(timestamp),
                parent_frame_id: WORLD.to_owned(),
                child_frame_id: name.clone(),
                translation: at.position,
                rotation: at.orientation,
            });
        }
    }
}
