//! What descriptions have in common, whichever format they are in: numbers over dimensions, origins, shapes, masses, surfaces,
//! mesh files, and the mistakes in them.

mod composition;
pub(crate) mod document;
mod mesh_file;
pub(crate) mod mesh_files;
mod origin;
pub(crate) mod part_problem;
pub(crate) mod part_tables;
pub(crate) mod shape_count;
pub(crate) mod toml_text;
pub(crate) mod values;

pub use document::Document;
pub use part_problem::PartProblem;
