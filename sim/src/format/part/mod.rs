//! What robot files and scene files have in common: numbers over dimensions, origins, shapes, masses, surfaces, and the mistakes
//! in them.

mod composition;
pub(super) mod mesh_files;
mod origin;
pub(super) mod part_problem;
pub(super) mod part_tables;
pub(super) mod values;

pub use part_problem::PartProblem;
