//! The velocity that the TCP would have by the command, where joints are driven by velocities.

use kinemark_sim::control::Mode;
use kinemark_sim::joint_space::JointVelocities;
use kinemark_sim::kinematics::{forward_kinematics, frame_twist};

use super::column::Track;
use kinemark_grader::record::graded::TaskRun;

/// A velocity is written in so many parts of the greatest.
const PARTS: f64 = 1000.0;

/// The velocities at `ticks`, in the frame of the TCP's path \[m/s\]. None where the mode is another, where the robot has loops, whose
/// other joints have no command, or where nothing is commanded.
pub(super) fn velocity(run: &TaskRun, ticks: &[usize]) -> Option<Track> {
    let robot = &run.robot;
    let last = run.trace.len().checked_sub(1)?;
    if run.mode != Mode::Velocity || run.trace.command.at(0).len() != robot.n() {
        return None;
    }
    let rows: Option<Vec<[f64; 3]>> = ticks
        .iter()
        .map(|tick| at(run, (*tick).min(last)))
        .collect();
    let rows = rows?;
    let greatest = rows
        .iter()
        .flatten()
        .fold(0.0, |most: f64, x| most.max(x.abs()));
    (greatest > 0.0).then(|| Track::at(ticks, &[greatest / PARTS; 3], rows.iter()))
}

/// The velocity at a tick, as one sees it from the frame: that of the TCP less that of the frame's point where it is.
fn at(run: &TaskRun, tick: usize) -> Option<[f64; 3]> {
    let robot = &run.robot;
    let q = robot.positions(run.trace.q.at(tick)).ok()?;
    let qd = JointVelocities::new(run.trace.command.at(tick).iter().copied());
    let frame = robot.frame(&run.seen_from)?;
    let poses = forward_kinematics(robot, &q);
    let (world_from_frame, world_from_tcp) =
        (poses.world_from(frame), poses.world_from(robot.tcp()));
    let (of_frame, of_tcp) = (
        frame_twist(robot, &q, &qd, frame),
        frame_twist(robot, &q, &qd, robot.tcp()),
    );
    let from_frame = world_from_tcp.translation.vector - world_from_frame.translation.vector;
    let seen = of_tcp.linear - of_frame.linear - of_frame.angular.cross(&from_frame);
    let v = world_from_frame.inverse_transform_vector(&seen);
    v.iter().all(|x| x.is_finite()).then(|| v.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::sample;

    #[test]
    fn a_link_that_turns_moves_its_end_at_right_angles() {
        // the second joint is 0.2 m from the first, which is at 0.5 rad and is commanded 0.5 rad/s about y
        let run = sample::chain(2, 3, |_, joint| if joint == 0 { 0.5 } else { 0.0 });
        let [x, y, z] = at(&run, 1).expect("a velocity");
        let (s, c) = libm::sincos(0.5);
        assert!((x - 0.1 * c).abs() < 1e-15 && y.abs() < 1e-15 && (z + 0.1 * s).abs() < 1e-15);
        assert!(velocity(&run, &[0, 2]).is_some());
    }

    #[test]
    fn there_is_none_where_nothing_or_something_else_is_commanded() {
        let still = sample::chain(2, 3, |_, _| 0.0);
        assert_eq!(velocity(&still, &[0, 2]), None);
        let mut other = sample::chain(2, 3, |_, _| 0.5);
        other.mode = Mode::Position;
        assert_eq!(velocity(&other, &[0, 2]), None);
        assert_eq!(velocity(&sample::chain(2, 0, |_, _| 0.5), &[0]), None);
    }
}
