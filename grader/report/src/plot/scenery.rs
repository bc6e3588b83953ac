//! The bodies of a scene as outlines in the plane of a picture: those that stand, and those that can move at the start and at the end.

use kinemark_sim::model::robot::Shape;
use kinemark_sim::spatial::Pose;

use super::plane::Plane;
use crate::solid::drawn;
use kinemark_grader::record::graded::TaskRun;

/// Shapes that are drawn.
const MOST_SHAPES: usize = 400;

/// The scene of a run, flattened.
#[derive(Debug, Default)]
pub(super) struct Scenery {
    /// Outlines of what stands.
    pub(super) standing: Vec<Vec<(f64, f64)>>,
    /// Outlines of what can move, at the start.
    pub(super) at_start: Vec<Vec<(f64, f64)>>,
    /// And at the last tick.
    pub(super) at_end: Vec<Vec<(f64, f64)>>,
}

impl Scenery {
    /// The scene of `run` seen along the plane's normal; `frame_from_world` leads to the frame the plane is in.
    pub(super) fn of(run: &TaskRun, frame_from_world: &Pose, plane: &Plane) -> Self {
        let mut scenery = Self::default();
        let outlines = |shapes: &[Shape], world_from_body: &Pose| {
            let frame_from_body = frame_from_world * world_from_body;
            let outline = |shape: &Shape| {
                let pose = frame_from_body * shape.link_from_shape;
                let points = drawn(&shape.solid).outline_m().into_iter().map(|p| {
                    let p = pose.transform_point(&p);
                    plane.flat(&[p.x, p.y, p.z])
                });
                hull(points.collect())
            };
            shapes.iter().map(outline).collect::<Vec<_>>()
        };
        let bodies = run.scene.iter().flat_map(|scene| &scene.scene.bodies);
        let mut shapes = 0;
        for (index, body) in bodies.enumerate() {
            shapes += body.shapes.len();
            if shapes > MOST_SHAPES {
                break;
            }
            if !run.trace.moving_bodies.contains(&index) {
                let drawn = outlines(&body.shapes, &body.world_from_body);
                scenery.standing.extend(drawn);
                continue;
            }
            if let Some(last) = run.trace.len().checked_sub(1) {
                for (tick, to) in [(0, &mut scenery.at_start), (last, &mut scenery.at_end)] {
                    if let Some(pose) = run.trace.world_from_body(index, tick) {
                        to.extend(outlines(&body.shapes, &pose));
                    }
                }
            }
        }
        scenery
    }

    pub(super) fn is_empty(&self) -> bool {
        self.standing.is_empty() && self.at_start.is_empty()
    }
}

/// The convex hull of points, counter-clockwise; points that are not finite are left out.
///
/// Source: Andrew, *Another efficient algorithm for convex hulls in two dimensions* (1979).
fn hull(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.retain(|p| p.0.is_finite() && p.1.is_finite());
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut hull: Vec<(f64, f64)> = Vec::new();
    let mut half = |points: &mut dyn Iterator<Item = (f64, f64)>| {
        let start = hull.len();
        for p in points {
            while let [.., a, b] = hull[start..] {
                if (b.0 - a.0) * (p.1 - a.1) - (b.1 - a.1) * (p.0 - a.0) > 0.0 {
                    break;
                }
                hull.pop();
            }
            hull.push(p);
        }
        hull.pop();
    };
    half(&mut points.iter().copied());
    half(&mut points.iter().rev().copied());
    hull
}

/// The part of a convex outline inside a rectangle, `low` to `high`.
///
/// Source: Sutherland & Hodgman, *Reentrant polygon clipping* (1974).
pub(super) fn clipped(
    outline: &[(f64, f64)],
    low: (f64, f64),
    high: (f64, f64),
) -> Vec<(f64, f64)> {
    let mut kept = outline.to_vec();
    for side in 0..4 {
        // how far inside this side a point is
        let inside = |p: &(f64, f64)| match side {
            0 => p.0 - low.0,
            1 => high.0 - p.0,
            2 => p.1 - low.1,
            _ => high.1 - p.1,
        };
        let before = std::mem::take(&mut kept);
        for (i, to) in before.iter().enumerate() {
            let from = before[(i + before.len() - 1) % before.len()];
            let (a, b) = (inside(&from), inside(to));
            if (a < 0.0) != (b < 0.0) {
                let share = a / (a - b);
                kept.push((
                    from.0 + share * (to.0 - from.0),
                    from.1 + share * (to.1 - from.1),
                ));
            }
            if b >= 0.0 {
                kept.push(*to);
            }
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_leaves_out_what_lies_inside() {
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        let mut points = square.to_vec();
        points.extend([(1.0, 1.0), (1.0, 0.0), (2.0, 2.0), (f64::NAN, 0.0)]);
        assert_eq!(hull(points), square);
        assert_eq!(hull(vec![(1.0, 1.0), (1.0, 1.0)]), [(1.0, 1.0)]);
    }

    #[test]
    fn an_outline_is_cut_at_the_edge() {
        let triangle = [(-1.0, 0.0), (3.0, 0.0), (1.0, 2.0)];
        let cut = clipped(&triangle, (0.0, -5.0), (2.0, 5.0));
        assert_eq!(
            cut,
            [(0.0, 1.0), (0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 2.0)]
        );
        assert!(clipped(&triangle, (5.0, 5.0), (6.0, 6.0)).is_empty());
        assert_eq!(clipped(&triangle, (-9.0, -9.0), (9.0, 9.0)), triangle);
    }
}
