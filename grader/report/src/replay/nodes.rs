//! What stands and moves in a replay: links, bodies and ghosts, each with its shapes and its place or track.

use kinemark_sim::model::robot::Robot;
use kinemark_sim::spatial::Pose;

use super::Ghost;
use super::course::Course;
use super::moments::MOST_OF_A_NAME;
use super::motion::Motion;
use super::record::{NodeRecord, Place};
use super::shapes::{self, Meshes, ShapeRecord, pose_record};
use crate::visible::shortened;
use kinemark_grader::record::graded::TaskRun;

/// Nodes with the courses of those that move, and meshes.
#[derive(Debug, Default)]
pub(super) struct Nodes {
    pub(super) nodes: Vec<NodeRecord>,
    pub(super) courses: Vec<Course>,
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
        course: Option<Course>,
    ) {
        let place = match course {
            Some(course) if !course.stands_still() => {
                self.courses.push(course);
                Place::Track(self.courses.len() - 1)
            }
            Some(course) => Place::Pose(
                course
                    .start()
                    .and_then(start_pose)
                    .unwrap_or_else(|| pose_record(pose)),
            ),
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
    pub(super) fn robot(&mut self, robot: &Robot, links: Vec<Option<Course>>, label: Option<&str>) {
        let first = self.nodes.len();
        for (i, (link, course)) in robot.links().iter().zip(links).enumerate() {
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
                course,
            );
        }
    }

    /// Adds a ghost: its robot, and what else went another way than in the run.
    pub(super) fn ghost(
        &mut self,
        ghost: &Ghost<'_>,
        run: &TaskRun,
        main: &[Course],
        looked: &[usize],
        unit_m: f64,
    ) {
        let step_s = run.trace.step_s;
        let motion = Motion::of(ghost.robot, ghost.trace, looked, step_s, unit_m);
        self.robot(ghost.robot, motion.links, Some(ghost.label));
        let bodies = ghost.scene.map_or(&[][..], |scene| &scene.bodies);
        for (course, index) in motion.bodies.into_iter().zip(&ghost.trace.moving_bodies) {
            let Some(body) = bodies.get(*index) else {
                continue;
            };
            let ours = run.scene.iter().flat_map(|scene| &scene.scene.bodies);
            let ours: Vec<_> = ours.collect();
            let mut pairs = main.iter().zip(&run.trace.moving_bodies);
            let same = pairs.any(|(other, index)| {
                *other == course && ours.get(*index).is_some_and(|b| b.shapes == body.shapes)
            });
            if same {
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

/// The pose of a course's first row, as it is written.
fn start_pose(row: &[f64]) -> Option<[f64; 7]> {
    row.try_into().ok().map(shapes::rounded)
}
