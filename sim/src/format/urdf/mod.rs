//! URDF to robot: the format people bring, read with a line and a column for whatever is wrong.
//!
//! What a URDF may say and this reader does:
//! - The link that is no joint's child is the root, fixed to the world, and comes first; all else keeps its order, so that `q` follows
//!   the file.
//! - A `floating` joint is the base's: it becomes `NAME_x`, `_y`, `_z` (prismatic), `_yaw`, `_pitch`, `_roll` (continuous) with
//!   massless links between. A `planar` one becomes `NAME_x`, `_y` in the plane normal to its axis, and `_yaw` about it.
//! - A `mimic` joint follows its master and has no entry in `q`, unless [`ReadOptions::ignore_mimic`](super::ReadOptions::ignore_mimic).
//!   Where it is fixed, or its master is not there or fixed, a warning says so, and it follows nothing.
//! - An inertia that no body can have leaves a robot for kinematics only, unless
//!   [`ReadOptions::on_unphysical`](super::ReadOptions::on_unphysical) says what to do.
//! - Shapes come from `<collision>`, or from `<visual>` where a link has no collision. A mesh that cannot be read is a warning.
//! - Materials, transmissions, calibration, safety controllers and extensions of simulators are left out without a word; what looks
//!   like a slip of the pen inside a link or a joint is a warning.
//!
//! Source: the URDF specification of ROS (wiki.ros.org/urdf/XML).

mod document;
mod inertial;
mod joint;
mod limits;
mod mimic;
mod origin;
mod shape;
mod tree;
mod urdf_robot;

use super::mesh_location::mesh_location;
use super::robot_format::{Likeness, RobotFormat};
use super::xml::document::root_name;

pub(super) const FORMAT: RobotFormat = RobotFormat {
    name: "a URDF",
    likeness: |text, extension| match (root_name(text), extension) {
        (Some("robot"), _) => Likeness::Sure,
        (Some(_), _) | (None, "urdf" | "xml") => Likeness::Possible,
        (None, _) => Likeness::None,
    },
    read: urdf_robot::robot,
    write: None,
    mesh_location,
    is_of_ros: true,
    #[cfg(test)]
    sample: ("arm.urdf", SAMPLE),
};

#[cfg(test)]
const SAMPLE: &str = r#"<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <link name="upper"/>
  <joint name="shoulder" type="continuous">
    <parent link="base"/>
    <child link="upper"/>
    <axis xyz="0 0 1"/>
  </joint>
</robot>
"#;
