//! Where the TCP of a lab's robot is, in the frame in which students work.

use kinemark_sim::model::robot::Robot;
use nalgebra::Vector3;

use super::pose::pose_in;

/// Position of the TCP in the frame `frame` \[m\]; `None` if `q` does not fit the robot, or there is no such frame.
pub fn tcp_in(robot: &Robot, frame: &str, q: &[f64]) -> Option<Vector3<f64>> {
    Some(pose_in(robot, frame, q)?.translation.vector)
}
