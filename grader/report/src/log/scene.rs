//! What stands still in its frame: the shapes of the links, the goals, and the reference path.

use foxglove::messages::line_primitive::Type;
use foxglove::messages::{
    Color, CubePrimitive, CylinderPrimitive, Duration, KeyValuePair, LinePrimitive, Pose,
    SceneEntity, SceneUpdate, SpherePrimitive, TriangleListPrimitive,
};
use kinemark_sim::model::inertia::Solid;
use kinemark_sim::model::robot::Shape;
use kinemark_sim::model::scene::SceneBody;

use super::message::{point, pose, pose_at, time, vector};
use super::names::{REFERENCE as REFERENCE_FRAMES, body_frame, frame_id, frame_id_of};
use crate::palette::{SolidColour, log, of_body, of_link};
use crate::solid::{LogForm, Surface, drawn};
use kinemark_grader::record::graded::{Goal, TaskRun, TcpPath};
use kinemark_sim::spatial::Pose as Isometry;
use kinemark_sim::trace::Trace;

fn colour([r, g, b, a]: [f64; 4]) -> Color {
    Color { r, g, b, a }
}

fn solid_colour(colour: SolidColour) -> Color {
    let [r, g, b] = colour.log;
    Color { r, g, b, a: 1.0 }
}

/// An entity that goes with its frame, from the start to the end.
struct Entity(SceneEntity);

impl Entity {
    fn new(id: String, frame_id: String) -> Self {
        Self(SceneEntity {
            timestamp: Some(time(0)),
            frame_id,
            id,
            lifetime: Some(Duration::new(0, 0)),
            frame_locked: true,
            ..SceneEntity::default()
        })
    }

    fn note(&mut self, key: &str, value: String) {
        self.0.metadata.push(KeyValuePair {
            key: key.to_owned(),
            value,
        });
    }

    fn sphere(&mut self, pose: Pose, radius_m: f64, color: Color) {
        self.0.spheres.push(SpherePrimitive {
            pose: Some(pose),
            size: Some(vector([2.0 * radius_m; 3])),
            color: Some(color),
        });
    }

    fn solid(&mut self, solid: &Solid, link_from_shape: &Isometry, color: Color) {
        for (shape_from_part, form) in drawn(solid).log_forms() {
            let pose = match shape_from_part {
                Some(shape_from_part) => pose(&(link_from_shape * shape_from_part)),
                None => pose(link_from_shape),
            };
            match form {
                LogForm::Box(size_m) => self.0.cubes.push(CubePrimitive {
                    pose: Some(pose),
                    size: Some(vector(size_m)),
                    color: Some(color),
                }),
                LogForm::Cylinder { radius_m, length_m } => {
                    self.cylinder(pose, radius_m, length_m, color);
                }
                LogForm::Sphere { radius_m } => self.sphere(pose, radius_m, color),
                LogForm::Surface(surface) => self.surface(pose, &surface, color),
            }
        }
    }

    fn surface(&mut self, pose: Pose, surface: &Surface, color: Color) {
        let points = surface.vertices().iter().copied();
        self.0.triangles.push(TriangleListPrimitive {
            pose: Some(pose),
            // a mesh has finite vertices only, or its triangles would name others
            points: points.map(|p| point(p).unwrap_or_default()).collect(),
            color: Some(color),
            colors: Vec::new(),
            indices: surface.triangles().as_flattened().to_vec(),
        });
    }

    fn cylinder(&mut self, pose: Pose, radius_m: f64, length_m: f64, color: Color) {
        self.0.cylinders.push(CylinderPrimitive {
            pose: Some(pose),
            size: Some(vector([2.0 * radius_m, 2.0 * radius_m, length_m])),
            bottom_scale: 1.0,
            top_scale: 1.0,
            color: Some(color),
        });
    }
}

fn update(entities: Vec<Entity>) -> SceneUpdate {
    SceneUpdate {
        deletions: Vec::new(),
        entities: entities.into_iter().map(|entity| entity.0).collect(),
    }
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
            let color = solid_colour(of_link(i));
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
    update(entities)
}

/// A body of the scene, in a frame of its own.
fn body_entity(body: &SceneBody) -> Entity {
    let mut entity = Entity::new(format!("body {}", body.name), body_frame(&body.name));
    let color = solid_colour(of_body(&body.kind));
    for shape in &body.shapes {
        entity.solid(&shape.solid, &shape.link_from_shape, color);
    }
    entity.note("type", body.kind.name().to_owned());
    entity
}

fn goal_entity(index: usize, goal: &Goal, lab: &str) -> Entity {
    let mut entity = Entity::new(format!("goal {}", index + 1), lab.to_owned());
    for (radius_m, color) in [(goal.full_m, log::FULL), (goal.zero_m, log::ZERO)] {
        if radius_m.is_finite() {
            entity.sphere(pose_at(goal.position_m), radius_m, colour(color));
        }
    }
    entity.note("dwell_s", goal.dwell_s.to_string());
    entity
}

/// What is shown of the reference, if anything: its path, and where its motion is to be seen its links and what it moved.
pub(super) fn reference(run: &TaskRun) -> Option<SceneUpdate> {
    let path = run
        .reference_tcp
        .as_ref()
        .map(|path| path_entity(run, path));
    let mut entities: Vec<Entity> = path.into_iter().collect();
    if let Some(trace) = &run.reference_overlay {
        entities.extend(ghost_entities(run, trace));
    }
    (!entities.is_empty()).then(|| update(entities))
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
            entity.solid(
                &shape.solid,
                &shape.link_from_shape,
                colour(log::REFERENCE_ARM),
            );
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
    entity.0.lines.push(LinePrimitive {
        r#type: Type::LineStrip as i32,
        pose: Some(pose_at([0.0; 3])),
        thickness: 2.0,
        scale_invariant: true,
        points: path.points_m.iter().filter_map(|p| point(*p)).collect(),
        color: Some(colour(log::REFERENCE_PATH)),
        colors: Vec::new(),
        indices: Vec::new(),
    });
    entity
}
