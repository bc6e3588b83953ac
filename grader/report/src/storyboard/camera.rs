//! Where a run is looked at from: onto the plane of its motion, turned aside and raised, without perspective.

use kinemark_sim::kinematics::FramePoses;
use nalgebra::{Matrix3, Point3, Vector3};

use kinemark_grader::record::graded::TaskRun;

/// How far a plane of motion is turned from facing the viewer \[rad\].
const ASIDE: f64 = 20.0 * DEGREE;
/// How far the viewer is raised \[rad\]: before an upright plane, before a level one, and where there is none.
const RAISED: f64 = 16.0 * DEGREE;
const RAISED_LEVEL: f64 = 52.0 * DEGREE;
const RAISED_SPACE: f64 = 24.0 * DEGREE;
const ASIDE_SPACE: f64 = 32.0 * DEGREE;
const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// Motion across a plane that is less than this part of the motion in it counts as none.
const FLAT: f64 = 0.02;
/// Ticks at which the motion is looked at.
const SAMPLES: usize = 24;

/// Directions of a picture, in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Camera {
    pub(super) right: Vector3<f64>,
    pub(super) up: Vector3<f64>,
    /// To the viewer.
    pub(super) toward: Vector3<f64>,
}

impl Camera {
    /// Looks from `azimuth` (of the viewer, about z, from x) and `raised` above the level.
    fn from(azimuth: f64, raised: f64) -> Self {
        let (sa, ca) = libm::sincos(azimuth);
        let (sr, cr) = libm::sincos(raised);
        let toward = Vector3::new(cr * ca, cr * sa, sr);
        let right = Vector3::new(-sa, ca, 0.0);
        Self {
            right,
            up: toward.cross(&right),
            toward,
        }
    }

    /// The view of a run. Lengths to the right grow as in the plots: along the axis of the lab's frame that lies across.
    pub(super) fn of(run: &TaskRun) -> Self {
        let (normal, flat) = normal(run);
        let level = normal.z.abs() > 0.7;
        let (aside, raised) = match (flat, level) {
            (true, false) => (ASIDE, RAISED),
            (true, true) => (ASIDE, RAISED_LEVEL),
            (false, _) => (ASIDE_SPACE, RAISED_SPACE),
        };
        let horizontal = if level {
            -Vector3::y()
        } else {
            Vector3::new(normal.x, normal.y, 0.0).normalize()
        };
        let right = Vector3::z().cross(&horizontal);
        let poses = FramePoses::new(&run.robot);
        let frame = run.robot.frame(&run.seen_from);
        let axes = frame.map_or_else(Matrix3::identity, |frame| {
            *poses.world_from(frame).rotation.matrix()
        });
        let along = (0..3).map(|i| axes.column(i).dot(&right));
        let across = along.fold(
            0.0,
            |a: f64, b| if b.abs() > a.abs() + 1e-9 { b } else { a },
        );
        let horizontal = if across < 0.0 {
            -horizontal
        } else {
            horizontal
        };
        Self::from(libm::atan2(horizontal.y, horizontal.x) + aside, raised)
    }

    /// Where a point is in the picture: to the right and up \[m\].
    pub(super) fn flat(&self, p: &Point3<f64>) -> (f64, f64) {
        (p.coords.dot(&self.right), p.coords.dot(&self.up))
    }
}

/// The direction in which nothing moves much, and whether that is nothing at all.
fn normal(run: &TaskRun) -> (Vector3<f64>, bool) {
    let robot = &run.robot;
    let mut poses = FramePoses::new(robot);
    // an arm whose joints all turn about one direction moves in a plane, however it is moved
    let axis = |child: usize, axis: &Vector3<f64>| {
        let frame = &robot.frames()[child];
        poses.world_from(frame).rotation * axis
    };
    let axes = robot.moving_joints();
    let turning: Option<Vec<_>> = axes
        .map(|joint| joint.kind.turns().then(|| axis(joint.child, &joint.axis)))
        .collect();
    if let Some([first, others @ ..]) = turning.as_deref()
        && others.iter().all(|other| other.cross(first).norm() < 1e-6)
        && first.norm() > 0.5
    {
        return (first.normalize(), true);
    }
    // else as the run moved it
    let len = run.trace.len();
    let mut tracks: Vec<Vec<Vector3<f64>>> = Vec::new();
    for sample in 0..SAMPLES.min(len) {
        let tick = sample * (len - 1) / (SAMPLES - 1).max(1);
        let q = run.trace.q.at(tick);
        if !q.iter().all(|q| q.abs() < 1e6) {
            continue;
        }
        poses.update(robot, q);
        let frames = robot.frames()[..robot.links().len()].iter();
        let frames = frames.chain([robot.tcp()]);
        let mut places: Vec<_> = frames
            .map(|frame| poses.world_from(frame).translation.vector)
            .collect();
        for (i, body) in run.trace.moving_bodies.iter().enumerate() {
            let pose = run.trace.world_from_body(*body, tick);
            let p = pose.map_or_else(Vector3::zeros, |pose| pose.translation.vector);
            // what flies off is not what the picture is of
            let first = tracks.get(robot.links().len() + 1 + i);
            let start = first.and_then(|track| track.first()).copied();
            let near = start.is_none_or(|start| (p - start).norm() < 2.0);
            places.push(if near { p } else { start.unwrap_or(p) });
        }
        tracks.resize_with(places.len(), Vec::new);
        for (track, place) in tracks.iter_mut().zip(places) {
            track.push(place);
        }
    }
    let mut spread = Matrix3::zeros();
    for track in &tracks {
        let mean = track.iter().sum::<Vector3<f64>>() / track.len().max(1) as f64;
        for p in track {
            let d = p - mean;
            spread += d * d.transpose();
        }
    }
    if !spread.iter().all(|x| x.is_finite()) || spread.trace() < 1e-9 {
        return (-Vector3::y(), false);
    }
    let eigen = spread.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let value = |i: usize| eigen.eigenvalues[order[i]];
    if value(0) <= FLAT * value(1) && value(1) > 1e-4 * value(2) {
        return (eigen.eigenvectors.column(order[0]).into_owned(), true);
    }
    // in space: across the level direction of most motion
    let (a, b, c) = (spread.m11, spread.m12, spread.m22);
    let heading = 0.5 * libm::atan2(2.0 * b, a - c);
    let (s, c) = libm::sincos(heading);
    (Vector3::new(s, -c, 0.0), false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::sample;

    #[test]
    fn the_arm_of_the_course_is_seen_as_in_its_plots_turned_aside() {
        let camera = Camera::of(&sample::task_run());
        // its y axis, which is the world's x, goes to the right, and the world's z goes up
        assert!(
            (camera.right.x - libm::cos(ASIDE)).abs() < 1e-9,
            "{camera:?}"
        );
        assert!((camera.up.z - libm::cos(RAISED)).abs() < 1e-9, "{camera:?}");
        assert!(camera.toward.y < -0.8, "{camera:?}");
        let turned = Matrix3::from_columns(&[camera.right, camera.up, camera.toward]);
        assert!((turned.determinant() - 1.0).abs() < 1e-12);
        assert!((turned * turned.transpose() - Matrix3::identity()).norm() < 1e-12);
    }

    #[test]
    fn a_run_without_a_tick_has_a_view() {
        let camera = Camera::of(&sample::chain(3, 0, |_, _| 0.0));
        assert!(camera.toward.z > 0.1 && camera.toward.norm() > 0.99);
    }
}
