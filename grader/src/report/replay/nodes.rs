//! What stands and moves in a replay: links, bodies and ghosts, each with its shapes and its place or track.

use kinemark_sim::robot::Robot;
use kinemark_sim::spatial::Pose;

use super::Ghost;
use super::column::Track;
use super::moments::MOST_OF_A_NAME;
use super::motion::{Course, Motion};
use super::record::{NodeRecord, Place};
use super::shapes::{self, Meshes, ShapeRecord, pose_record};
use crate::graded::TaskRun;
use crate::report::visible::shortened;

/// Nodes with their tracks and meshes.
#[derive(Debug, Default)]
pub(super) struct Nodes {
    pub(super) nodes: Vec<NodeRecord>,
    pub(super) tracks: Vec<Track>,
    pub(super) meshes: Meshes,
}

impl Nodes {
    /// Adds a node that stands at `pose` unless it has a course on which it moves.
    pub(super) fn node(
        &mut self,
        name: String,
        kind: &'static str,
        parent: Option<usize>,
        shapes: Vec<ShapeRecord>,
        pose: &Pose,
        course: Option<&Course>,
    ) {
        let place = match course {
            Some(course) if !course.columns.stands_still() => {
                self.tracks.push(course.columns.track());
                Place::Track(self.tracks.len() - 1)
            }
            Some(course) => Place::Pose(shapes::rounded(course.start)),
            None => Place::Pose(pose_record(pose)),
        };
        self.nodes.push(NodeRecord {
            name,
            kind,
            parent,
            shapes,
            place,
        });
    }

    /// Adds the links of a robot, those of a ghost under its label.
    pub(super) fn robot(&mut self, robot: &Robot, motion: &Motion, label: Option<&str>) {
        let first = self.nodes.len();
        for (i, link) in robot.links().iter().enumerate() {
            let parent = robot.joints().iter().find(|joint| joint.child == i);
            let name = shortened(&link.name, MOST_OF_A_NAME);
            let (name, kind) = match label {
                Some(label) => (
                    format!("{}/{name}", shortened(label, MOST_OF_A_NAME)),
                    "ghost",
                ),
                None => (name, "link"),
            };
            let shapes = self.meshes.shapes(&link.shapes);
            self.node(
                name,
                kind,
                parent.map(|joint| first + joint.parent),
                shapes,
                &link.attachment.body_from_here,
                motion.links[i].as_ref(),
            );
        }
    }

    /// Adds a ghost: its robot, and what else went another way than in the run.
    pub(super) fn ghost(
        &mut self,
        ghost: &Ghost<'_>,
        run: &TaskRun,
        main: &Motion,
        frames: &[usize],
    ) {
        let motion = Motion::of(ghost.robot, ghost.trace, frames, run.trace.step_s);
        self.robot(ghost.robot, &motion, Some(ghost.label));
        let bodies = ghost.scene.map_or(&[][..], |scene| &scene.bodies);
        for (course, index) in motion.bodies.iter().zip(&ghost.trace.moving_bodies) {
            let Some(body) = bodies.get(*index) else {
                continue;
            };
            let same = main.bodies.iter().any(|other| other == course);
            if same || course.columns.stands_still() {
                continue;
            }
            let shapes = self.meshes.shapes(&body.shapes);
            let (label, name) = (ghost.label, &body.name);
            let [label, name] = [label, name.as_str()].map(|text| shortened(text, MOST_OF_A_NAME));
            let name = format!("{label}/{name}");
            self.node(
                name,
                "ghost",
                None,
                shapes,
                &body.world_from_body,
                Some(course),
            );
        }
    }
}
