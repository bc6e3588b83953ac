//! The `<origin>` of an element of a URDF.

use nalgebra::Vector3;

use crate::format::robot_problem::RobotError;
use crate::format::xml::reader::{Node, Reader};
use crate::spatial::{Pose, pose, rotation_from_rpy};

/// The pose that the `<origin>` of `node` gives; the identity where there is none.
pub(super) fn origin(
    reader: &mut Reader<'_>,
    node: Node<'_>,
    owner: &str,
) -> Result<Pose, RobotError> {
    let Some(origin) = reader.child(node, "origin", owner) else {
        return Ok(Pose::identity());
    };
    if let Some(quaternion) = origin.attribute_node("quat_xyzw") {
        return reader.refuse(
            quaternion.range(),
            format!("`<origin>` of {owner} says its rotation as a quaternion"),
            "not supported",
            "write the rotation as rpy=\"roll pitch yaw\", in radians",
        );
    }
    reader.check(origin, owner, &["xyz", "rpy"], &[]);
    let xyz = reader.triple(origin, "xyz", owner)?.unwrap_or_default();
    let rpy = reader.triple(origin, "rpy", owner)?.unwrap_or_default();
    Ok(pose(rotation_from_rpy(rpy), Vector3::from(xyz)))
}
