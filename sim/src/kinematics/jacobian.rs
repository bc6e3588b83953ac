//! The geometric Jacobian of any frame, and the twist it maps joint velocities to.

use std::ops::AddAssign as _;

use nalgebra::Matrix6xX;

use super::forward::{FramePoses, forward_kinematics};
use crate::joint_space::{JointPositions, JointVelocities};
use crate::model::robot::{Frame, Robot};
use crate::spatial::Twist;

/// Returns the geometric Jacobian of `frame`, shape `(6, n)`, rows `[linear; angular]`.
///
/// Rows are the velocity of the frame's origin \[m/s\] and the frame's angular velocity \[rad/s\], both in world axes, per unit of
/// joint velocity. Joints that do not move the frame have zero columns. Loses rank in singular configurations.
pub fn geometric_jacobian(robot: &Robot, q: &JointPositions, frame: &Frame) -> Matrix6xX<f64> {
    let poses = forward_kinematics(robot, q);
    let mut jacobian = Matrix6xX::zeros(robot.n());
    fill(robot, &poses, frame, &mut jacobian);
    jacobian
}

/// Writes the Jacobian of `frame` at `poses` into `jacobian`: [`geometric_jacobian`] without allocations.
///
/// # Panics
/// If `jacobian` has another number of columns than [`Robot::n`].
pub fn fill(robot: &Robot, poses: &FramePoses, frame: &Frame, jacobian: &mut Matrix6xX<f64>) {
    assert_eq!(
        jacobian.ncols(),
        robot.n(),
        "one column per joint that moves"
    );
    jacobian.as_mut_slice().fill(0.0);
    let p_frame = poses.world_from(frame).translation.vector;
    let mut next = frame.attachment.body;
    while let Some(i) = next {
        let body = &robot.bodies()[i];
        let placed = &poses.placed[i];
        let axis = placed.axis();
        // a mimic joint adds to the column of its master
        let axis = axis * body.gear;
        let mut column = jacobian.column_mut(body.q_index);
        if body.turns {
            let linear = axis.cross(&(p_frame - placed.position));
            column.fixed_rows_mut::<3>(0).add_assign(&linear);
            column.fixed_rows_mut::<3>(3).add_assign(&axis);
        } else {
            column.fixed_rows_mut::<3>(0).add_assign(&axis);
        }
        next = body.parent;
    }
}

/// Returns the twist of `frame` in world axes: the Jacobian times `qd`.
pub fn frame_twist(
    robot: &Robot,
    q: &JointPositions,
    qd: &JointVelocities,
    frame: &Frame,
) -> Twist {
    let v = geometric_jacobian(robot, q, frame) * qd.vector();
    Twist {
        linear: v.fixed_rows::<3>(0).into_owned(),
        angular: v.fixed_rows::<3>(3).into_owned(),
    }
}
