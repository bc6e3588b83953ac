//! Meshes of triangles: the surface, whether it encloses a volume, and the mass properties of what it encloses.

mod closed;
mod integrals;
pub(crate) mod mesh_problem;
pub(crate) mod surface;

pub use mesh_problem::{MeshProblem, Place};
pub use surface::Mesh;
