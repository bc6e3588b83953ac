//! From the parts of a description to the robot: names become indices, links moving bodies, and loops are closed.

pub(super) mod assembler;
pub(super) mod description;
mod heavy_meshes;
mod joint_order;
mod unphysical_links;
