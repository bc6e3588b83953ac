//! A pose of the lab's frame as a target in the world, for the engine's inverse kinematics.

use kinemark_sim::kinematics::joint_samples::JointSamples;
use kinemark_sim::kinematics::{Target, forward_kinematics};
use kinemark_sim::model::robot::Robot;
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

use super::pose::{PoseForm, pose_at, pose_in};

/// Configurations at which it is looked whether a robot tilts its TCP.
const TILTS: usize = 16;

/// Where the TCP is to be in the world, for numbers of this form in the frame `frame` of the robot at home. `None` for a heading of a robot
/// that can tilt its TCP: a heading does not say how.
pub(crate) fn pose_target(
    robot: &Robot,
    frame: &str,
    form: PoseForm,
    numbers: &[f64],
) -> Option<Target> {
    let home = robot.home();
    let poses = forward_kinematics(robot, &robot.positions(home).ok()?);
    let world_from_lab = poses.world_from(robot.frame(frame)?);
    let p_in_lab = form.position(numbers);
    let in_world = |rotation: Rotation3<f64>| world_from_lab * pose_at(p_in_lab, rotation);
    Some(match form {
        PoseForm::Position => Target::Position(in_world(Rotation3::identity()).translation.vector),
        PoseForm::Axis { of_tcp } => {
            let direction = Vector3::new(numbers[3], numbers[4], numbers[5]);
            Target::Axis {
                position_m: in_world(Rotation3::identity()).translation.vector,
                axis_in_frame: Unit::try_new(of_tcp, 0.0)?,
                direction_in_world: Unit::try_new(world_from_lab.rotation * direction, 0.0)?,
            }
        }
        PoseForm::Full => {
            let matrix = Matrix3::from_fn(|i, j| numbers[4 * i + j]);
            Target::Pose(in_world(Rotation3::from_matrix_unchecked(matrix)))
        }
        PoseForm::Yaw => {
            let tilt = the_only_tilt(robot, frame)?;
            let heading = Rotation3::from_axis_angle(&Vector3::z_axis(), numbers[3]);
            Target::Pose(in_world(heading * tilt))
        }
    })
}

/// How the TCP is turned but for its heading, if that is the same in every configuration.
fn the_only_tilt(robot: &Robot, frame: &str) -> Option<Rotation3<f64>> {
    let tilt = |q: &[f64]| {
        let pose = pose_in(robot, frame, q)?;
        let heading = *PoseForm::Yaw.of(&pose).last()?;
        Some(Rotation3::from_axis_angle(&Vector3::z_axis(), -heading) * pose.rotation)
    };
    let at_home = tilt(robot.home())?;
    let mut samples = JointSamples::new(robot);
    let mut q = vec![0.0; robot.n()];
    for _ in 0..TILTS {
        samples.next_into(&mut q);
        if (tilt(&q)?.matrix() - at_home.matrix()).amax() > 1e-9 {
            return None;
        }
    }
    Some(at_home)
}
