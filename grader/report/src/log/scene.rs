//! What stands still in its frame: the shapes of the links, the goals, and the reference path.

use kinemark_sim::model::inertia::Solid;
use kinemark_sim::model::robot::Shape;
use kinemark_sim::model::scene::{BodyKind, SceneBody};
use serde::Serialize;

use super::message::{Pose, Time, Vector};
use super::names::{REFERENCE as REFERENCE_FRAMES, body_frame, frame_id, frame_id_of};
use crate::solid::{LogForm, Surface, drawn};
use kinemark_grader::record::graded::{Goal, TaskRun, TcpPath};
use kinemark_sim::spatial::Pose as Isometry;
use kinemark_sim::trace::Trace;

#[derive(Debug, Clone, Copy, Serialize)]
struct Colour {
    r: f64,
    g: f64,
    b: f64,
    a: f64,
}

const fn colour(r: f64, g: f64, b: f64, a: f64) -> Colour {
    Colour { r, g, b, a }
}

/// The links, in turn, so that neighbours differ.
const LINKS: [Colour; 3] = [
    colour(0.55, 0.6, 0.66, 1.0),
    colour(0.0, 0.45, 0.7, 1.0),
    colour(0.34, 0.71, 0.91, 1.0),
];
const STANDING: Colour = colour(0.75, 0.68, 0.58, 1.0);
const DRIVEN: Colour = colour(0.9, 0.62, 0.0, 1.0);
const FREE: Colour = colour(0.84, 0.37, 0.0, 1.0);
const FULL: Colour = colour(0.0, 0.62, 0.45, 0.6);
const ZERO: Colour = colour(0.84, 0.37, 0.0, 0.2);
const REFERENCE: Colour = colour(0.8, 0.47, 0.65, 0.5);
const GHOST: Colour = colour(0.8, 0.47, 0.65, 0.35);

#[derive(Debug, Clone, Serialize)]
struct Solid3 {
    pose: Pose,
    size: Vector,
    color: Colour,
}

#[derive(Debug, Clone, Serialize)]
struct Cylinder {
    pose: Pose,
    size: Vector,
    bottom_scale: f64,
    top_scale: f64,
    color: Colour,
}

#[derive(Debug, Clone, Serialize)]
struct Line {
    #[serde(rename = "type")]
    kind: u8,
    pose: Pose,
    thickness: f64,
    scale_invariant: bool,
    points: Vec<Vector>,
    color: Colour,
    colors: [Colour; 0],
    indices: [u32; 0],
}

#[derive(Debug, Clone, Serialize)]
struct Triangles {
    pose: Pose,
    points: Vec<Vector>,
    color: Colour,
    colors: [Colour; 0],
    indices: Vec<u32>,
}

#[derive(Debug, Clone, Serialize)]
struct KeyValue {
    key: &'static str,
    value: String,
}

/// Primitives of a kind this log does not draw.
type Nothing = [u8; 0];

#[derive(Debug, Clone, Serialize)]
struct Entity {
    timestamp: Time,
    frame_id: String,
    id: String,
    lifetime: Time,
    frame_locked: bool,
    metadata: Vec<KeyValue>,
    arrows: Nothing,
    cubes: Vec<Solid3>,
    spheres: Vec<Solid3>,
    cylinders: Vec<Cylinder>,
    lines: Vec<Line>,
    triangles: Vec<Triangles>,
    texts: Nothing,
    models: Nothing,
}

impl Entity {
    fn new(id: String, frame_id: String) -> Self {
        Self {
            timestamp: Time::from_ns(0),
            frame_id,
            id,
            lifetime: Time::from_ns(0),
            frame_locked: true,
            metadata: Vec::new(),
            arrows: [],
            cubes: Vec::new(),
            spheres: Vec::new(),
            cylinders: Vec::new(),
            lines: Vec::new(),
            triangles: Vec::new(),
            texts: [],
            models: [],
        }
    }

    fn sphere(&mut self, pose: Pose, radius_m: f64, color: Colour) {
        let size = Vector::new([2.0 * radius_m; 3]);
        self.spheres.push(Solid3 { pose, size, color });
    }

    fn solid(&mut self, solid: &Solid, link_from_shape: &Isometry, color: Colour) {
        for (shape_from_part, form) in drawn(solid).log_forms() {
            let pose = match shape_from_part {
                Some(shape_from_part) => Pose::new(&(link_from_shape * shape_from_part)),
                None => Pose::new(link_from_shape),
            };
            match form {
                LogForm::Box(size_m) => {
                    let size = Vector::new(size_m);
                    self.cubes.push(Solid3 { pose, size, color });
                }
                LogForm::Cylinder { radius_m, length_m } => {
                    self.cylinder(pose, radius_m, length_m, color);
                }
                LogForm::Sphere { radius_m } => self.sphere(pose, radius_m, color),
                LogForm::Surface(surface) => self.surface(pose, &surface, color),
            }
        }
    }

    fn surface(&mut self, pose: Pose, surface: &Surface, color: Colour) {
        let points = surface.vertices().iter().copied();
        self.triangles.push(Triangles {
            pose,
            points: points.map(Vector::new).collect(),
            color,
            colors: [],
            indices: surface.triangles().as_flattened().to_vec(),
        });
    }

    fn cylinder(&mut self, pose: Pose, radius_m: f64, length_m: f64, color: Colour) {
        self.cylinders.push(Cylinder {
            pose,
            size: Vector::new([2.0 * radius_m, 2.0 * radius_m, length_m]),
            bottom_scale: 1.0,
            top_scale: 1.0,
            color,
        });
    }
}

/// A message of a scene.
#[derive(Debug, Clone, Serialize)]
pub(super) struct SceneUpdate {
    deletions: Nothing,
    entities: Vec<Entity>,
}

/// The links with their shapes, and the goals with their bands.
pub(super) fn scene(run: &TaskRun) -> SceneUpdate {
    let robot = &run.robot;
    let mut entities = Vec::new();
    for (i, link) in robot.links().iter().enumerate() {
        let mut entity = Entity::new(
            format!("link {}", link.name),
            frame_id(robot, &robot.frames()[i]),
        );
        for shape in &link.shapes {
            let color = if i == 0 {
                LINKS[0]
            } else {
                LINKS[1 + (i - 1) % 2]
            };
            entity.solid(&shape.solid, &shape.link_from_shape, color);
        }
        entities.push(entity);
    }
    for body in run.scene.iter().flat_map(|scene| &scene.scene.bodies) {
        entities.push(body_entity(body));
    }
    let lab = frame_id_of(robot, &run.seen_from);
    let goals = run.goals.iter().enumerate();
    entities.extend(goals.map(|(i, goal)| goal_entity(i, goal, &lab)));
    SceneUpdate {
        deletions: [],
        entities,
    }
}

/// A body of the scene, in a frame of its own.
fn body_entity(body: &SceneBody) -> Entity {
    let mut entity = Entity::new(format!("body {}", body.name), body_frame(&body.name));
    let color = match body.kind {
        BodyKind::Fixed => STANDING,
        BodyKind::Kinematic(_) => DRIVEN,
        BodyKind::Free => FREE,
    };
    for shape in &body.shapes {
        entity.solid(&shape.solid, &shape.link_from_shape, color);
    }
    entity.metadata.push(KeyValue {
        key: "type",
        value: body.kind.name().to_owned(),
    });
    entity
}

fn goal_entity(index: usize, goal: &Goal, lab: &str) -> Entity {
    let mut entity = Entity::new(format!("goal {}", index + 1), lab.to_owned());
    for (radius_m, color) in [(goal.full_m, FULL), (goal.zero_m, ZERO)] {
        if radius_m.is_finite() {
            entity.sphere(Pose::at(goal.position_m), radius_m, color);
        }
    }
    entity.metadata.push(KeyValue {
        key: "dwell_s",
        value: goal.dwell_s.to_string(),
    });
    entity
}

/// What is shown of the reference, if anything: its path, and where its motion is to be seen its links and what it moved.
pub(super) fn reference(run: &TaskRun) -> Option<SceneUpdate> {
    let path = run
        .reference_tcp
        .as_ref()
        .map(|path| path_entity(run, path));
    let mut entities: Vec<Entity> = path.into_iter().collect();
    if let Some(trace) = &run.ghost {
        entities.extend(ghost_entities(run, trace));
    }
    (!entities.is_empty()).then_some(SceneUpdate {
        deletions: [],
        entities,
    })
}

/// Translucent links, and bodies that can move, in frames of their own.
fn ghost_entities(run: &TaskRun, trace: &Trace) -> Vec<Entity> {
    let robot = &run.robot;
    let mut entities = Vec::new();
    let mut ghost = |id: String, frame: String, shapes: &[Shape]| {
        let mut entity = Entity::new(
            format!("reference {id}"),
            format!("{REFERENCE_FRAMES}{frame}"),
        );
        for shape in shapes {
            entity.solid(&shape.solid, &shape.link_from_shape, GHOST);
        }
        entities.push(entity);
    };
    for (link, frame) in robot.links().iter().zip(robot.frames()) {
        ghost(
            format!("link {}", link.name),
            frame_id(robot, frame),
            &link.shapes,
        );
    }
    let bodies = run.scene.iter().flat_map(|scene| &scene.scene.bodies);
    for (index, body) in bodies.enumerate() {
        if trace.moving_bodies.contains(&index) {
            ghost(
                format!("body {}", body.name),
                body_frame(&body.name),
                &body.shapes,
            );
        }
    }
    entities
}

/// The reference path as a line.
fn path_entity(run: &TaskRun, path: &TcpPath) -> Entity {
    let mut entity = Entity::new(
        "reference path".to_owned(),
        frame_id_of(&run.robot, &run.seen_from),
    );
    let points = path.points_m.iter().map(|p| Vector::new(*p));
    entity.lines.push(Line {
        kind: 0,
        pose: Pose::at([0.0; 3]),
        thickness: 2.0,
        scale_invariant: true,
        points: points.filter(Vector::is_finite).collect(),
        color: REFERENCE,
        colors: [],
        indices: [],
    });
    entity
}
