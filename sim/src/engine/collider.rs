//! Our solids as shapes of the collision library, with the same frames.

use nalgebra::Vector3;
use parry3d_f64::math::{Pose as EnginePose, Vector};
use parry3d_f64::shape::{SharedShape, TriMeshFlags};

use super::convert::engine_pose;
use super::engine_error::EngineError;
use crate::model::inertia::Solid;
use crate::model::mesh::surface::Mesh;
use crate::model::robot::Shape;
use crate::spatial::{Pose, rotation_about_axis_deg};

/// `shape` and its pose on a body; `body_from_owner` is the pose of the shape's owner on it. A mesh becomes its convex hull, or its own
/// surface if the description says so.
///
/// # Errors
/// A mesh without a volume, or without a usable surface.
pub(super) fn shape_of(
    owner: &str,
    shape: &Shape,
    body_from_owner: &Pose,
) -> Result<(SharedShape, EnginePose), EngineError> {
    let mut place = engine_pose(&(body_from_owner * shape.link_from_shape));
    let shared = match &shape.solid {
        Solid::Box {
            size_m: [x, y, z], ..
        } => SharedShape::cuboid(0.5 * x, 0.5 * y, 0.5 * z),
        Solid::Cylinder { radius_m, length_m } => {
            // the engine's cylinders and capsules are along y
            let upright = rotation_about_axis_deg(Vector3::x(), 90.0);
            place *= EnginePose::from_rotation(super::convert::rotation(&upright));
            SharedShape::cylinder(0.5 * length_m, *radius_m)
        }
        Solid::Capsule { radius_m, length_m } => SharedShape::capsule_z(0.5 * length_m, *radius_m),
        Solid::Sphere { radius_m } => SharedShape::ball(*radius_m),
        Solid::Mesh(solid) if !solid.convex => {
            surface(&solid.mesh).map_err(|reason| EngineError::Surface {
                owner: owner.to_owned(),
                file: solid.file.to_string(),
                reason,
            })?
        }
        Solid::Mesh(solid) => hull(&solid.mesh).ok_or_else(|| EngineError::Hull {
            owner: owner.to_owned(),
            file: solid.file.to_string(),
        })?,
    };
    Ok((shared, place))
}

fn points(mesh: &Mesh) -> Vec<Vector> {
    mesh.vertices()
        .iter()
        .map(|[x, y, z]| Vector::new(*x, *y, *z))
        .collect()
}

fn hull(mesh: &Mesh) -> Option<SharedShape> {
    SharedShape::convex_hull(&points(mesh))
}

fn surface(mesh: &Mesh) -> Result<SharedShape, String> {
    // without it, bodies catch on the edges between triangles of one plane
    let flags = TriMeshFlags::FIX_INTERNAL_EDGES;
    SharedShape::trimesh_with_flags(points(mesh), mesh.triangles().to_vec(), flags)
        .map_err(|error| error.to_string())
}
