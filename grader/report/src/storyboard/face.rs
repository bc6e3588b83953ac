//! Solids as flat faces in the world: what a picture is put together from.

use kinemark_sim::spatial::Pose;
use nalgebra::{Point3, Vector3};

use crate::solid::Faces;

/// A colour, in red, green and blue.
pub(super) type Rgb = (u8, u8, u8);

/// A flat convex face.
#[derive(Debug, Clone)]
pub(super) struct Face {
    /// Its corners, counter-clockwise seen from outside \[m\].
    pub(super) corners: Vec<Point3<f64>>,
    /// Whether the edge from each corner to the next is an edge of the solid, to be drawn as a line.
    pub(super) edges: Vec<bool>,
    /// Its unit normal, outwards.
    pub(super) normal: Vector3<f64>,
    /// The solid it belongs to.
    pub(super) solid: usize,
    /// Whether that solid is convex and closed: none of its faces that are seen hides another.
    pub(super) convex: bool,
    pub(super) colour: Rgb,
}

/// A stick from one point to another, for robots whose links have no shapes.
pub(super) fn stick(a: Point3<f64>, b: Point3<f64>, radius_m: f64) -> Faces {
    let along = b - a;
    let length_m = along.norm();
    if length_m <= 0.0 || !length_m.is_finite() {
        return Faces::default();
    }
    let turn = nalgebra::Rotation3::rotation_between(&Vector3::z(), &along).unwrap_or_else(|| {
        nalgebra::Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    });
    let pose = Pose::from_parts(nalgebra::center(&a, &b).into(), turn);
    let half = 0.5 * length_m;
    let mut faces = Faces::turned(&[(radius_m, -half), (radius_m, half)], 8, true);
    for (corners, _) in &mut faces.faces {
        corners
            .iter_mut()
            .for_each(|corner| *corner = pose * *corner);
    }
    faces
}

/// Moves the faces to where their solid is. Faces without an area, or at no place, are left out.
pub(super) fn place(
    solid_faces: &Faces,
    pose: &Pose,
    solid: usize,
    colour: Rgb,
    faces: &mut Vec<Face>,
) {
    for (corners, edges) in &solid_faces.faces {
        let corners: Vec<_> = corners.iter().map(|corner| pose * corner).collect();
        let Some(normal) = normal(&corners) else {
            continue;
        };
        faces.push(Face {
            corners,
            edges: edges.clone(),
            normal,
            solid,
            convex: solid_faces.is_convex,
            colour,
        });
    }
}

/// The unit normal of a flat polygon, by Newell's sums; none where it has no area.
fn normal(corners: &[Point3<f64>]) -> Option<Vector3<f64>> {
    let first = corners.first()?;
    let mut sum = Vector3::zeros();
    for (i, a) in corners.iter().enumerate() {
        let b = &corners[(i + 1) % corners.len()];
        sum += (a - first).cross(&(b - first));
    }
    let length = sum.norm();
    (length.is_finite() && length > 1e-18).then(|| sum / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sticks_are_closed_and_look_outwards() {
        for to in [Point3::new(0.0, 0.0, -1.0), Point3::new(1.0, 2.0, 3.0)] {
            stick(-to, to, 0.1).assert_closed();
        }
        let none = stick(Point3::origin(), Point3::origin(), 0.1);
        assert!(none.faces.is_empty());
    }

    #[test]
    fn faces_without_an_area_are_left_out() {
        let flat = stick(Point3::origin(), Point3::new(0.0, 0.0, 1.0), 0.0);
        let mut placed = Vec::new();
        place(&flat, &Pose::identity(), 0, (0, 0, 0), &mut placed);
        assert!(placed.is_empty());
    }
}
