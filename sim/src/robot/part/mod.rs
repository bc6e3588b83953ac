//! What robot files and scene files have in common: numbers over dimensions, origins, shapes, masses, surfaces, and the mistakes
//! in them.
//!
//! | file | what it holds |
//! |---|---|
//! | `tables` | the TOML types, as typed by a person |
//! | `values` | numbers, triples and directions from them; changed dimensions |
//! | `origin` | where a frame lies in its parent |
//! | `mass` | shapes, surfaces, and mass given or taken from the shapes |
//! | `meshes` | the mesh files that shapes name |
//! | `problem` | everything that can be wrong with these |

mod mass;
mod meshes;
mod origin;
mod problem;
pub(crate) mod tables;
mod values;

pub(crate) use meshes::Meshes;
pub(crate) use problem::PartError;
pub use problem::PartProblem;
pub(crate) use values::{Allowed, Values, changed_dimensions};
