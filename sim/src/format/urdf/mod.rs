//! URDF to robot: the format people bring, read with a line and a column for whatever is wrong.
//!
//! What a URDF may say and this reader does:
//! - The link that is no joint's child is the root, fixed to the world, and comes first; all else keeps its order, so that `q` follows
//!   the file.
//! - A `floating` joint is the base's: it becomes `NAME_x`, `_y`, `_z` (prismatic), `_yaw`, `_pitch`, `_roll` (continuous) with
//!   massless links between. A `planar` one becomes `NAME_x`, `_y` in the plane normal to its axis, and `_yaw` about it.
//! - A `mimic` joint follows its master and has no entry in `q`, unless [`UrdfOptions::ignore_mimic`].
//! - Shapes come from `<collision>`, or from `<visual>` where a link has no collision. A mesh that cannot be read is a warning.
//! - Materials, transmissions, calibration, safety controllers and extensions of simulators are left out without a word; what looks
//!   like a slip of the pen inside a link or a joint is a warning.
//!
//! Source: the URDF specification of ROS (wiki.ros.org/urdf/XML).

mod document;
mod inertial;
mod joint;
mod limits;
pub mod mesh_location;
mod reader;
mod shape;
mod tree;
mod urdf_robot;

pub use urdf_robot::{UrdfOptions, robot};
