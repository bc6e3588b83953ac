//! What stands and moves in a run, as faces in the world at a tick.

use kinemark_sim::kinematics::FramePoses;
use kinemark_sim::model::robot::Shape;
use kinemark_sim::spatial::Pose;
use nalgebra::Point3;

use super::face::{Face, place, stick};
use crate::palette::{Rgb, of_body, of_link};
use crate::solid::{Detail, Faces, drawn};
use kinemark_grader::record::graded::TaskRun;

/// Shapes that are drawn.
const MOST_SHAPES: usize = 400;
/// Triangles of all meshes together.
const MOST_TRIANGLES: usize = 1500;
/// Fewest triangles of a mesh that is thinned.
const FEWEST_TRIANGLES: usize = 60;
/// From this number of round shapes on, they are drawn with fewer faces.
const MANY_SHAPES: usize = 60;

/// What a shape hangs on.
#[derive(Debug, Clone, Copy)]
enum Holder {
    Link(usize),
    Body(usize),
}

struct Part {
    faces: Faces,
    holder: Holder,
    holder_from_shape: Pose,
    colour: Rgb,
}

/// The solids of a run.
pub(super) struct Stage<'a> {
    run: &'a TaskRun,
    parts: Vec<Part>,
    /// Whether the links have no shape and are drawn as sticks.
    bare: bool,
}

impl<'a> Stage<'a> {
    pub(super) fn of(run: &'a TaskRun) -> Self {
        let bodies = run.scene.iter().flat_map(|scene| &scene.scene.bodies);
        let links = run
            .robot
            .links()
            .iter()
            .enumerate()
            .map(|(i, link)| (Holder::Link(i), &link.shapes, of_link(i).storyboard));
        let bodies = bodies.enumerate().map(|(i, body)| {
            let colour = of_body(&body.kind).storyboard;
            (Holder::Body(i), &body.shapes, colour)
        });
        let shapes: Vec<(Holder, &Shape, Rgb)> = links
            .chain(bodies)
            .flat_map(|(holder, shapes, colour)| {
                shapes.iter().map(move |shape| (holder, shape, colour))
            })
            .take(MOST_SHAPES)
            .collect();
        let triangles = |shape: &Shape| drawn(&shape.solid).own_triangles();
        let all: usize = shapes.iter().map(|(_, shape, _)| triangles(shape)).sum();
        let around = if shapes.len() > MANY_SHAPES { 12 } else { 24 };
        let part = |(holder, shape, colour): (Holder, &Shape, Rgb)| {
            // each mesh has its share
            let share = (triangles(shape) * MOST_TRIANGLES).div_ceil(all.max(1));
            let most = if all > MOST_TRIANGLES {
                share.max(FEWEST_TRIANGLES)
            } else {
                MOST_TRIANGLES
            };
            let detail = Detail {
                around,
                triangles: most,
            };
            Part {
                faces: drawn(&shape.solid).faces(detail),
                holder,
                holder_from_shape: shape.link_from_shape,
                colour,
            }
        };
        Self {
            run,
            bare: run.robot.links().iter().all(|link| link.shapes.is_empty()),
            parts: shapes.into_iter().map(part).collect(),
        }
    }

    /// Joint positions at a tick; where they are no numbers, as they last were.
    fn q(&self, tick: Option<usize>) -> Option<&[f64]> {
        let rows = tick.into_iter().flat_map(|tick| (0..=tick).rev());
        let mut rows = rows.map(|tick| self.run.trace.q.at(tick));
        rows.find(|q| q.iter().all(|q| q.abs() < 1e9))
    }

    /// The joints at a tick, or with all of them at zero.
    fn poses(&self, tick: Option<usize>) -> FramePoses {
        let mut poses = FramePoses::new(&self.run.robot);
        if let Some(q) = self.q(tick) {
            poses.update(&self.run.robot, q);
        }
        poses
    }

    /// From a joint to where the TCP would be at a tick, were that joint at `target` and all others where they are.
    pub(super) fn aimed(&self, tick: Option<usize>, joint: usize, target: f64) -> [Point3<f64>; 2] {
        let robot = &self.run.robot;
        let mut q = self
            .q(tick)
            .map_or_else(|| vec![0.0; robot.n()], <[f64]>::to_vec);
        if let Some(q) = q.get_mut(joint) {
            *q = target;
        }
        let mut poses = FramePoses::new(robot);
        poses.update(robot, &q);
        let place = |frame| Point3::from(poses.world_from(frame).translation.vector);
        let from = robot.moving_joints().nth(joint);
        let from = from.map_or(robot.tcp(), |joint| &robot.frames()[joint.child]);
        [place(from), place(robot.tcp())]
    }

    /// All faces at a tick, or, without one, as the files have them.
    pub(super) fn faces(&self, tick: Option<usize>) -> Vec<Face> {
        let robot = &self.run.robot;
        let poses = self.poses(tick);
        let mut faces = Vec::new();
        for (solid, part) in self.parts.iter().enumerate() {
            let world_from_holder = match part.holder {
                Holder::Link(link) => poses.world_from(&robot.frames()[link]),
                Holder::Body(body) => match self.body(body, tick) {
                    Some(pose) => pose,
                    None => continue,
                },
            };
            let pose = world_from_holder * part.holder_from_shape;
            place(&part.faces, &pose, solid, part.colour, &mut faces);
        }
        if self.bare {
            let places = |link: usize| {
                Point3::from(poses.world_from(&robot.frames()[link]).translation.vector)
            };
            let tcp = Point3::from(poses.world_from(robot.tcp()).translation.vector);
            let mut sticks: Vec<_> = robot
                .joints()
                .iter()
                .map(|joint| (places(joint.parent), places(joint.child)))
                .collect();
            sticks.push((places(robot.tcp().link), tcp));
            let length: f64 = sticks.iter().map(|(a, b)| (b - a).norm()).sum();
            for (i, (a, b)) in sticks.into_iter().enumerate() {
                let stick = stick(a, b, 0.012 * length);
                let solid = self.parts.len() + i;
                place(
                    &stick,
                    &Pose::identity(),
                    solid,
                    of_link(i + 1).storyboard,
                    &mut faces,
                );
            }
        }
        faces.retain(|face| {
            face.corners
                .iter()
                .flat_map(|p| p.iter())
                .all(|x| x.abs() < 1e6)
        });
        faces
    }

    fn body(&self, index: usize, tick: Option<usize>) -> Option<Pose> {
        let scene = self.run.scene.as_ref()?;
        let start = scene.scene.bodies.get(index)?.world_from_body;
        let moved = tick.and_then(|tick| self.run.trace.world_from_body(index, tick));
        Some(moved.unwrap_or(start))
    }

    /// Where the joints that move are, and the TCP, at a tick.
    pub(super) fn joints(&self, tick: Option<usize>) -> (Vec<Point3<f64>>, Point3<f64>) {
        let robot = &self.run.robot;
        let poses = self.poses(tick);
        let place = |frame| Point3::from(poses.world_from(frame).translation.vector);
        let joints = robot.moving_joints();
        let joints = joints.map(|joint| place(&robot.frames()[joint.child]));
        (joints.collect(), place(robot.tcp()))
    }

    /// The pose of the frame in which TCP, goals and paths are given, in the world, at the start.
    pub(super) fn world_from_lab(&self) -> Pose {
        let poses = self.poses((!self.run.trace.is_empty()).then_some(0));
        let frame = self.run.robot.frame(&self.run.seen_from);
        frame.map_or_else(Pose::identity, |frame| poses.world_from(frame))
    }
}
