//! The workspace of a frame, sampled at joint positions spread evenly over their ranges.

use nalgebra::Vector3;

use super::chain::Chain;
use super::closure::closed_positions;
use super::joint_samples::JointSamples;
use super::position_range::position_ranges;
use crate::model::robot::{Frame, Robot};

/// Sampled positions of a frame, in world axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Workspace {
    points_m: Vec<Vector3<f64>>,
    open: usize,
}

/// Samples the workspace of `frame`: its positions in the world at `count` joint positions spread evenly over their ranges, limits
/// included. A joint without limits is sampled over one turn, or over one metre either way.
///
/// The points are always the same. A robot with loops is sampled over its independent joints; samples at which its loops cannot be
/// closed give no point, but are counted.
pub fn sample_workspace(robot: &Robot, frame: &Frame, count: usize) -> Workspace {
    let mut chain = Chain::new(robot, frame);
    let free: Vec<usize> = robot.independent().to_vec();
    let ranges = position_ranges(robot);
    let mut samples = JointSamples::over(&ranges, &free);
    let mut chosen = vec![0.0; free.len()];
    let mut q = vec![0.0; robot.n()];
    let mut workspace = Workspace {
        points_m: Vec::new(),
        open: 0,
    };
    for _ in 0..count {
        samples.next_into(&mut chosen);
        if robot.loops().is_empty() {
            q.copy_from_slice(&chosen);
        } else {
            match closed_positions(robot, &chosen) {
                Ok(closed) if closed.iter().zip(&ranges).all(|(q, r)| r.contains(*q)) => q = closed,
                _ => {
                    workspace.open += 1;
                    continue;
                }
            }
        }
        workspace.points_m.push(chain.update(&q).translation.vector);
    }
    workspace
}

impl Workspace {
    /// The positions found, in the order of the samples \[m\].
    pub fn points_m(&self) -> &[Vector3<f64>] {
        &self.points_m
    }

    /// Number of samples without a point, because the loops could not be closed there or only beyond a limit.
    pub fn open_samples(&self) -> usize {
        self.open
    }

    /// The corners of the smallest axis-aligned box around all points \[m\]; `None` without points.
    pub fn bounds_m(&self) -> Option<[Vector3<f64>; 2]> {
        let first = *self.points_m.first()?;
        Some(
            self.points_m
                .iter()
                .fold([first, first], |[low, high], p| [low.inf(p), high.sup(p)]),
        )
    }

    /// The greatest distance of a point from `p_centre_in_world` \[m\]; zero without points.
    pub fn reach_m(&self, p_centre_in_world: &Vector3<f64>) -> f64 {
        let distances = self.points_m.iter().map(|p| (p - p_centre_in_world).norm());
        distances.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::RobotFile;
    use crate::text::Source;

    #[test]
    fn a_planar_arm_fills_its_ring() {
        let text = r#"
            format = 1
            name = "planar"
            links = [{ name = "base" }, { name = "upper" }, { name = "lower" }]
            [[joints]]
            name = "shoulder"
            type = "continuous"
            parent = "base"
            child = "upper"
            axis = [0, 0, 1]
            [[joints]]
            name = "elbow"
            type = "revolute"
            parent = "upper"
            child = "lower"
            origin = { xyz_m = [0.5, 0, 0] }
            axis = [0, 0, 1]
            limit = { lower = -1.5707963267948966, upper = 1.5707963267948966 }
            [[frames]]
            name = "tcp"
            link = "lower"
            origin = { xyz_m = [0.3, 0, 0] }
        "#;
        let file = RobotFile::parse(Source::new("t", text)).unwrap();
        let robot = file.build(&[]).unwrap();
        let workspace = sample_workspace(&robot, robot.tcp(), 2000);
        assert_eq!(
            (workspace.points_m().len(), workspace.open_samples()),
            (2000, 0)
        );
        // between the straight arm and the elbow at 90 degrees, each to a few parts in a thousand
        let inner = (0.5_f64 * 0.5 + 0.3 * 0.3).sqrt();
        for p in workspace.points_m() {
            let r = p.norm();
            assert!(inner - 1e-12 <= r && r <= 0.8 + 1e-12);
        }
        assert!(workspace.reach_m(&Vector3::zeros()) > 0.799);
        let [low, high] = workspace.bounds_m().unwrap();
        assert!(low.x < -0.79 && low.y < -0.79 && high.x > 0.79 && high.y > 0.79);
        assert_eq!((low.z, high.z), (0.0, 0.0));
        assert_eq!(workspace, sample_workspace(&robot, robot.tcp(), 2000));
        assert_eq!(sample_workspace(&robot, robot.tcp(), 0).bounds_m(), None);
    }
}
