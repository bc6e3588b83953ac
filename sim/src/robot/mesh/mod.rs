//! Triangle meshes of links: read from bytes, checked to bound a solid, and weighed.
//!
//! | file | what it holds |
//! |---|---|
//! | `surface` | [`Mesh`]: welded vertices and triangles, scale, bounds |
//! | `stl`, `obj` | the two formats, from bytes to corners |
//! | `closed` | whether the triangles bound a solid, and where they do not |
//! | `integrals` | volume, centre of mass and inertia of that solid |
//! | `problem` | everything that can be wrong with a mesh |

mod closed;
mod integrals;
mod obj;
mod problem;
mod stl;
mod surface;

pub use problem::{MeshProblem, Place};
pub use surface::Mesh;
