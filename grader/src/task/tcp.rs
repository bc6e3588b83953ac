//! Where the TCP of a lab's robot is, in the frame in which students work.

use kinemark_sim::kinematics::forward_kinematics;
use kinemark_sim::model::robot::Robot;
use nalgebra::Vector3;

/// Position of the TCP in the frame `frame` \[m\]; `None` if `q` does not fit the robot, or there is no such frame.
pub fn tcp_in(robot: &Robot, frame: &str, q: &[f64]) -> Option<Vector3<f64>> {
    let q = robot.positions(q).ok()?;
    let poses = forward_kinematics(robot, &q);
    let world_from_lab = poses.world_from(robot.frame(frame)?);
    let lab_from_tcp = world_from_lab.inv_mul(&poses.world_from(robot.tcp()));
    Some(lab_from_tcp.translation.vector)
}
