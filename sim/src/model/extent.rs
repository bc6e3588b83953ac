//! Bounding boxes of shapes.

use nalgebra::Vector3;

use super::inertia::Solid;
use super::robot::Shape;

impl Solid {
    /// Centre and half edges, never negative, of the smallest box along the solid's own axes around it \[m\].
    pub fn extent_m(&self) -> (Vector3<f64>, Vector3<f64>) {
        let half = match self {
            Self::Box { size_m: [x, y, z] } => Vector3::new(*x, *y, *z) * 0.5,
            Self::Cylinder { radius_m, length_m } => {
                Vector3::new(*radius_m, *radius_m, 0.5 * length_m)
            }
            Self::Capsule { radius_m, length_m } => {
                Vector3::new(*radius_m, *radius_m, 0.5 * length_m + radius_m)
            }
            Self::Sphere { radius_m } => Vector3::repeat(*radius_m),
            Self::Mesh(solid) => {
                let (low, high) = solid.mesh.bounds();
                let (low, high) = (Vector3::from(low), Vector3::from(high));
                return ((low + high) * 0.5, (high - low) * 0.5);
            }
        };
        (Vector3::zeros(), half)
    }
}

/// Lowest and highest coordinates of a box around `shapes`, along the axes of their frame \[m\]; `None` without shapes.
///
/// It is the smallest such box around the boxes of the shapes; a rotated ball gets a larger one than it needs.
pub fn box_around(shapes: &[Shape]) -> Option<[Vector3<f64>; 2]> {
    shapes
        .iter()
        .map(|shape| {
            let (centre, half) = shape.solid.extent_m();
            let centre = shape.link_from_shape.transform_point(&centre.into()).coords;
            let turned = shape.link_from_shape.rotation.matrix().abs() * half;
            [centre - turned, centre + turned]
        })
        .reduce(|[low, high], [other_low, other_high]| [low.inf(&other_low), high.sup(&other_high)])
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use super::*;
    use crate::spatial::pose;

    #[test]
    fn two_shapes_by_hand() {
        let lying = pose(
            Matrix3::new(0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0),
            Vector3::new(1.0, 0.0, 0.0),
        );
        let shapes = [
            Shape {
                solid: Solid::Capsule {
                    radius_m: 0.25,
                    length_m: 1.0,
                },
                link_from_shape: lying,
            },
            Shape {
                solid: Solid::Sphere { radius_m: 0.5 },
                link_from_shape: pose(Matrix3::identity(), Vector3::new(0.0, 0.0, 2.0)),
            },
        ];
        let [low, high] = box_around(&shapes).expect("shapes");
        assert_eq!(low, Vector3::new(-0.5, -0.5, -0.25));
        assert_eq!(high, Vector3::new(1.75, 0.5, 2.5));
        assert_eq!(box_around(&[]), None);
    }
}
