//! The time derivative of the geometric Jacobian: a controller needs it to turn an acceleration of the tip into joint accelerations.

use nalgebra::{Matrix6xX, Vector6};

use super::body_motion::BodyMotions;
use crate::joint_space::{JointPositions, JointVelocities};
use crate::model::robot::{Frame, Robot};

/// Returns the time derivative of the geometric Jacobian of `frame`, shape `(6, n)`, rows `[linear; angular]`, at `(q, qd)`.
///
/// World axes, like [`geometric_jacobian`](super::geometric_jacobian): the acceleration of the frame's origin \[m/s²\] and its
/// angular acceleration \[rad/s²\] are `J qdd + dJ/dt qd`. Joints that do not move the frame have zero columns.
///
/// Source: `d/dt [z × (p - o); z]` with `dz/dt = w × z`, `w` the angular velocity of the body the joint moves.
pub fn jacobian_derivative(
    robot: &Robot,
    q: &JointPositions,
    qd: &JointVelocities,
    frame: &Frame,
) -> Matrix6xX<f64> {
    let mut motions = BodyMotions::new(robot);
    motions.update(robot, q.as_slice(), qd.as_slice());
    let carrier = motions.of(&frame.attachment);
    let arm = &frame.attachment.body_from_here.translation.vector;
    let tip = carrier.at(&(carrier.placed.world_from_body * arm));
    let mut derivative = Matrix6xX::zeros(robot.n());
    let mut next = frame.attachment.body;
    while let Some(i) = next {
        let body = &robot.bodies()[i];
        let motion = motions.body(i);
        // the joint rotates the body about this axis, so the axis moves with the body as it does with the parent
        let axis = motion.placed.axis() * body.gear;
        let axis_rate = motion.w.cross(&axis);
        let mut column = derivative.column_mut(body.q_index);
        column += if body.turns {
            let linear = axis_rate.cross(&(tip.position - motion.placed.position))
                + axis.cross(&(tip.velocity - motion.v));
            Vector6::new(
                linear.x,
                linear.y,
                linear.z,
                axis_rate.x,
                axis_rate.y,
                axis_rate.z,
            )
        } else {
            Vector6::new(axis_rate.x, axis_rate.y, axis_rate.z, 0.0, 0.0, 0.0)
        };
        next = body.parent;
    }
    derivative
}
