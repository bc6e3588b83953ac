//! What another run has that this one has not: its TCP path, bodies that stand elsewhere, other goals and paths to follow.

use kinemark_sim::model::inertia::Solid;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::robot::Shape;
use kinemark_sim::spatial::{Pose, pose};
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::column::Track;
use super::frames::sound_ticks;
use super::moments::MOST_OF_A_NAME;
use super::motion::PLACE;
use super::nodes::Nodes;
use super::record::{OtherJoint, OtherRecord, ReferencePath};
use crate::visible::shortened;
use kinemark_grader::record::graded::{AskedPath, Goal, TaskRun};

/// Time from one point of a TCP path to the next, where there are not too many \[s\].
const PERIOD_S: f64 = 0.01;
/// Numbers have four decimals.
const NUMBER: f64 = 1e-4;
/// Points of a TCP path.
const MOST_POINTS: usize = 3_000;
/// Segments of a path to follow that are drawn.
const MOST_SEGMENTS: usize = 300;
/// A goal that asks for no distance is drawn as a ball of this radius \[m\].
const SMALL_M: f64 = 0.01;
/// A path to follow is drawn as thick as this fraction of its longest side.
const THICKNESS: f64 = 0.004;

/// Where the TCP of `theirs` went, in the lab's frame of `ours`, up to where that run ended.
pub(super) fn tcp_path(theirs: &TaskRun, ours: &TaskRun) -> ReferencePath {
    let ticks = sound_ticks(&theirs.trace);
    let step_s = theirs.trace.step_s;
    let every = ((PERIOD_S / step_s).round() as usize)
        .max(ticks.div_ceil(MOST_POINTS))
        .max(1);
    let from = ours_from_theirs(ours, theirs);
    let ticks = (0..ticks).step_by(every);
    let points = ticks.map(|tick| tcp_at(theirs, tick, from.as_ref()));
    ReferencePath {
        period_s: every as f64 * step_s,
        path: Track::even(&[PLACE; 3], points),
    }
}

/// Where the frame of `theirs` is in that of `ours`, if it is another one.
fn ours_from_theirs(ours: &TaskRun, theirs: &TaskRun) -> Option<Pose> {
    match (
        world_from_lab(&ours.robot, &ours.seen_from),
        world_from_lab(&theirs.robot, &theirs.seen_from),
    ) {
        (Some(ours), Some(theirs)) if ours != theirs => Some(ours.inv_mul(&theirs)),
        // the same frame, or one that moves and so is the same at best
        _ => None,
    }
}

fn tcp_at(run: &TaskRun, tick: usize, ours_from_theirs: Option<&Pose>) -> [f64; 3] {
    let point = run.trace.tcp_position(tick);
    let point = ours_from_theirs.map_or(point, |from| from * point);
    [point.x, point.y, point.z]
}

/// TCP and joints of `theirs` at `ticks` of `ours`, for numbers beside those of `ours`; after its end, those of its end.
pub(super) fn numbers(theirs: &TaskRun, ours: &TaskRun, ticks: &[usize]) -> Option<OtherRecord> {
    let last = sound_ticks(&theirs.trace).checked_sub(1)?;
    let at = |tick: &usize| {
        // two runs may have steps of different length
        let steps = *tick as f64 * ours.trace.step_s / theirs.trace.step_s;
        (steps.round() as usize).min(last)
    };
    let from = ours_from_theirs(ours, theirs);
    let tcp = ticks
        .iter()
        .map(|tick| tcp_at(theirs, at(tick), from.as_ref()));
    let joints = theirs.robot.moving_joints().enumerate();
    Some(OtherRecord {
        tcp: Track::at(ticks, &[NUMBER; 3], tcp),
        q: joints
            .map(|(i, joint)| OtherJoint {
                name: shortened(&joint.name, MOST_OF_A_NAME),
                track: Track::at(
                    ticks,
                    &[NUMBER],
                    ticks.iter().map(|tick| [theirs.trace.q.at(at(tick))[i]]),
                ),
            })
            .collect(),
    })
}

/// The pose of the frame in which a run's TCP is given, if it never moves.
fn world_from_lab(robot: &Robot, name: &str) -> Option<Pose> {
    let attachment = &robot.frame(name)?.attachment;
    attachment
        .body
        .is_none()
        .then_some(attachment.body_from_here)
}

/// Adds what stands in `theirs` and not, or elsewhere, in `ours`: bodies that never move, goals, paths to follow.
pub(super) fn surroundings(nodes: &mut Nodes, theirs: &TaskRun, ours: &TaskRun, label: &str) {
    let label = shortened(label, MOST_OF_A_NAME);
    let name = |name: &str| format!("{label}/{}", shortened(name, MOST_OF_A_NAME));
    let mut stand = |name: String, shapes: &[Shape], world_from_here: &Pose| {
        let shapes = nodes.meshes.shapes(shapes);
        nodes.node(name, "ghost", None, shapes, world_from_here, None);
    };
    let still = |run: &TaskRun| -> Vec<usize> {
        let count = run.scene.as_ref().map_or(0, |s| s.scene.bodies.len());
        (0..count)
            .filter(|index| !run.trace.moving_bodies.contains(index))
            .collect()
    };
    let ours_still = still(ours);
    if let Some(scene) = &theirs.scene {
        for body in still(theirs).into_iter().map(|i| &scene.scene.bodies[i]) {
            let same = ours.scene.iter().any(|other| {
                let mut bodies = ours_still.iter().map(|i| &other.scene.bodies[*i]);
                bodies.any(|other| {
                    other.world_from_body == body.world_from_body && other.shapes == body.shapes
                })
            });
            if !same {
                stand(name(&body.name), &body.shapes, &body.world_from_body);
            }
        }
    }
    let place = |run: &TaskRun| world_from_lab(&run.robot, &run.seen_from);
    let same_place = place(theirs) == place(ours);
    // what is given in a moving frame has no fixed pose
    let Some(world_from_lab) = place(theirs) else {
        return;
    };
    for (i, goal) in theirs.goals.iter().enumerate() {
        let place = goal.position_m.map(f64::to_bits);
        let there = |other: &Goal| other.position_m.map(f64::to_bits) == place;
        let finite = goal.position_m.iter().all(|x| x.is_finite());
        if !finite || (same_place && ours.goals.iter().any(there)) {
            continue;
        }
        let radius_m = if goal.full_m.is_finite() && goal.full_m > 0.0 {
            goal.full_m
        } else {
            SMALL_M
        };
        let ball = Shape {
            solid: Solid::Sphere { radius_m },
            link_from_shape: Pose::identity(),
        };
        let at = world_from_lab * pose(Matrix3::identity(), Vector3::from(goal.position_m));
        stand(name(&format!("goal {}", i + 1)), &[ball], &at);
    }
    for path in &theirs.paths {
        let there = |other: &AskedPath| other.points_m == path.points_m;
        if same_place && ours.paths.iter().any(there) {
            continue;
        }
        let Some(first) = path.points_m.first().map(|p| Vector3::from(*p)) else {
            continue;
        };
        let at = world_from_lab * pose(Matrix3::identity(), first);
        stand(name(&path.name), &rods(&path.points_m, first), &at);
    }
}

/// Segments between points as thin rods, relative to `origin`.
fn rods(points_m: &[[f64; 3]], origin: Vector3<f64>) -> Vec<Shape> {
    let points: Vec<Vector3<f64>> = points_m.iter().map(|p| Vector3::from(*p)).collect();
    // a long path keeps its ends and leaves out points between
    let every = points.len().div_ceil(MOST_SEGMENTS).max(1);
    let mut kept: Vec<Vector3<f64>> = points.iter().step_by(every).copied().collect();
    kept.extend(points.last().copied());
    let reach_m = kept.iter().map(|p| (p - origin).amax()).fold(0.0, f64::max);
    let radius_m = 0.5 * THICKNESS * reach_m;
    let rod = |pair: &[Vector3<f64>]| {
        let way = pair[1] - pair[0];
        let length_m = way.norm();
        // points that are one have no direction
        if !(length_m.is_finite() && length_m > 0.0 && radius_m > 0.0) {
            return None;
        }
        // none where the rod points straight down: upside down it is the same rod
        let turn = Rotation3::rotation_between(&Vector3::z(), &way);
        let rotation = turn.map_or_else(Matrix3::identity, Rotation3::into_inner);
        Some(Shape {
            solid: Solid::Cylinder { radius_m, length_m },
            link_from_shape: pose(rotation, 0.5 * (pair[0] + pair[1]) - origin),
        })
    };
    kept.windows(2).filter_map(rod).collect()
}
