//! An arm as a line, the way a sketch has it: the origins of its links from the first to the TCP's, and the TCP.

use super::FramePoses;
use crate::model::robot::{Frame, Robot};

/// The points of the line at `poses`, in the frame `seen_from`, in the world without one \[m\]: the origins of all links between the root
/// and the TCP, and the TCP. Of a robot with loops it is the way through the tree of its joints.
///
/// `poses` are those of `robot`.
pub fn stick_figure(robot: &Robot, poses: &FramePoses, seen_from: Option<&Frame>) -> Vec<[f64; 3]> {
    let tcp = robot.tcp();
    let mut links = Vec::new();
    let mut link = tcp.link;
    while let Some(joint) = robot.joints().iter().find(|joint| joint.child == link) {
        links.push(link);
        link = joint.parent;
    }
    let world_from_seen = seen_from.map(|frame| poses.world_from(frame));
    let place = |frame| {
        let pose = poses.world_from(frame);
        let pose = world_from_seen.map_or(pose, |world_from_seen| world_from_seen.inv_mul(&pose));
        let p = pose.translation.vector;
        [p.x, p.y, p.z]
    };
    let chain = links.iter().rev().map(|link| &robot.frames()[*link]);
    chain.chain([tcp]).map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::RobotFile;
    use crate::text::Source;

    #[test]
    fn the_line_of_a_planar_arm_is_its_joints_and_its_tip() {
        let text = r#"
            format = 1
            name = "planar"
            links = [{ name = "base" }, { name = "upper" }, { name = "lower" }]
            [[joints]]
            name = "shoulder"
            type = "continuous"
            parent = "base"
            child = "upper"
            origin = { xyz_m = [0, 0, 1] }
            axis = [0, 0, 1]
            [[joints]]
            name = "elbow"
            type = "continuous"
            parent = "upper"
            child = "lower"
            origin = { xyz_m = [0.5, 0, 0] }
            axis = [0, 0, 1]
            [[frames]]
            name = "tcp"
            link = "lower"
            origin = { xyz_m = [0.25, 0, 0] }
        "#;
        let file = RobotFile::parse(Source::new("t", text)).unwrap();
        let robot = file.build(&[]).unwrap();
        let mut poses = FramePoses::new(&robot);
        let quarter = std::f64::consts::FRAC_PI_2;
        poses.update(&robot, &[quarter, -quarter]);
        let near = |points: Vec<[f64; 3]>, expected: [[f64; 3]; 3]| {
            assert_eq!(points.len(), 3);
            let entries = points.iter().flatten().zip(expected.iter().flatten());
            for (entry, expected) in entries {
                assert!((entry - expected).abs() < 1e-15, "{points:?}");
            }
        };
        let in_world = stick_figure(&robot, &poses, None);
        near(
            in_world,
            [[0.0, 0.0, 1.0], [0.0, 0.5, 1.0], [0.25, 0.5, 1.0]],
        );
        // from the upper arm, whose x axis is the world's y
        let upper = robot.frame("upper");
        let of_upper = stick_figure(&robot, &poses, upper);
        near(
            of_upper,
            [[0.0, 0.0, 0.0], [0.5, 0.0, 0.0], [0.5, -0.25, 0.0]],
        );
    }
}
