//! The chain of joints between the world and one frame, for speed: the frame's pose and Jacobian without the rest of the robot.

use nalgebra::{Matrix3, Matrix6xX, Vector3, Vector6};

use super::forward::BodyPose;
use crate::model::robot::{Frame, Robot};
use crate::spatial::{Pose, pose};

/// One moving body of the chain; [`Body`](crate::model::robot::Body) without what only dynamics needs.
#[derive(Debug, Clone)]
struct Segment {
    parent_from_body: Matrix3<f64>,
    p_body_in_parent: Vector3<f64>,
    turns: bool,
    q_index: usize,
    gear: f64,
    offset: f64,
    /// The column its joint adds to, if its joint may move.
    column: Option<usize>,
}

impl Segment {
    /// [`BodyPose::on_parent`] with its products written out: the same operations in the same order, but faster.
    #[inline(always)]
    fn place(&self, parent: &BodyPose, position: f64) -> BodyPose {
        let r = &parent.world_from_body;
        let p = &self.p_body_in_parent;
        let (x, y, z) = (
            turn(r, &self.parent_from_body, 0),
            turn(r, &self.parent_from_body, 1),
            turn(r, &self.parent_from_body, 2),
        );
        let reach = Vector3::new(
            r.m11 * p.x + r.m12 * p.y + r.m13 * p.z,
            r.m21 * p.x + r.m22 * p.y + r.m23 * p.z,
            r.m31 * p.x + r.m32 * p.y + r.m33 * p.z,
        );
        let origin = parent.position + reach;
        if self.turns {
            let (s, c) = libm::sincos(position);
            BodyPose {
                world_from_body: Matrix3::new(
                    x.x * c + y.x * s,
                    y.x * c - x.x * s,
                    z.x,
                    x.y * c + y.y * s,
                    y.y * c - x.y * s,
                    z.y,
                    x.z * c + y.z * s,
                    y.z * c - x.z * s,
                    z.z,
                ),
                position: origin,
            }
        } else {
            BodyPose {
                world_from_body: Matrix3::from_columns(&[x, y, z]),
                position: origin + z * position,
            }
        }
    }
}

/// Column `j` of `r m`.
#[inline(always)]
fn turn(r: &Matrix3<f64>, m: &Matrix3<f64>, j: usize) -> Vector3<f64> {
    let (a, b, c) = (m[(0, j)], m[(1, j)], m[(2, j)]);
    Vector3::new(
        r.m11 * a + r.m12 * b + r.m13 * c,
        r.m21 * a + r.m22 * b + r.m23 * c,
        r.m31 * a + r.m32 * b + r.m33 * c,
    )
}

/// The bodies from the world to one frame, with memory for the frame's pose and Jacobian at one `q`.
///
/// Nothing here allocates after [`Chain::new`]. The pose is bit for bit the one of
/// [`forward_kinematics`](super::forward_kinematics).
#[derive(Debug, Clone)]
pub struct Chain {
    segments: Vec<Segment>,
    placed: Vec<BodyPose>,
    body_from_frame: Pose,
    p_frame: Vector3<f64>,
    joints: Vec<usize>,
    columns: Vec<Vector6<f64>>,
}

impl Chain {
    /// The chain that moves `frame`; its Jacobian has a column for every entry of `q` that moves the frame, in order.
    pub fn new(robot: &Robot, frame: &Frame) -> Self {
        let bodies = robot.bodies();
        let mut joints = Vec::new();
        let mut next = frame.attachment.body;
        while let Some(i) = next {
            joints.push(bodies[i].q_index);
            next = bodies[i].parent;
        }
        joints.sort_unstable();
        joints.dedup();
        Self::with_joints(robot, frame, &joints)
    }

    /// The chain that moves `frame`, with one column for each of the entries of `q` in `joints`, in that order; zero for those
    /// that do not move the frame.
    ///
    /// # Panics
    /// If an entry of `joints` is not below [`Robot::n`].
    pub fn with_joints(robot: &Robot, frame: &Frame, joints: &[usize]) -> Self {
        let mut column_of = vec![None; robot.n()];
        for (column, &joint) in joints.iter().enumerate() {
            column_of[joint] = Some(column);
        }
        let mut segments = Vec::new();
        let mut next = frame.attachment.body;
        while let Some(i) = next {
            let body = &robot.bodies()[i];
            segments.push(Segment {
                parent_from_body: body.parent_from_body,
                p_body_in_parent: body.p_body_in_parent,
                turns: body.turns,
                q_index: body.q_index,
                gear: body.gear,
                offset: body.offset,
                column: column_of[body.q_index],
            });
            next = body.parent;
        }
        segments.reverse();
        let mut chain = Self {
            placed: vec![BodyPose::WORLD; segments.len()],
            segments,
            body_from_frame: frame.attachment.body_from_here,
            p_frame: Vector3::zeros(),
            columns: vec![Vector6::zeros(); joints.len()],
            joints: joints.to_vec(),
        };
        chain.update(&vec![0.0; robot.n()]);
        chain
    }

    /// The entries of `q` to which its columns belong.
    pub fn joints(&self) -> &[usize] {
        &self.joints
    }

    /// Greatest length of the chain with its prismatic joints at zero: the sum of its links' lengths \[m\].
    pub fn length_m(&self) -> f64 {
        let links = self.segments.iter().map(|s| s.p_body_in_parent.norm());
        links.sum::<f64>() + self.body_from_frame.translation.vector.norm()
    }

    /// Moves the chain to `q` \[rad or m\], shape `(n)` of the whole robot, and returns `world_from_frame`.
    ///
    /// # Panics
    /// If `q` has fewer entries than the robot's [`Robot::n`].
    pub fn update(&mut self, q: &[f64]) -> Pose {
        let mut parent = BodyPose::WORLD;
        for (segment, placed) in self.segments.iter().zip(&mut self.placed) {
            let position = segment.gear * q[segment.q_index] + segment.offset;
            parent = segment.place(&parent, position);
            *placed = parent;
        }
        let world_from_frame = if self.segments.is_empty() {
            self.body_from_frame
        } else {
            pose(parent.world_from_body, parent.position) * self.body_from_frame
        };
        self.p_frame = world_from_frame.translation.vector;
        world_from_frame
    }

    /// The geometric Jacobian at the last [`Chain::update`], one column per entry of [`Chain::joints`], rows `[linear; angular]`.
    ///
    /// Rows are the velocity of the frame's origin \[m/s\] and the frame's angular velocity \[rad/s\], world axes.
    pub fn jacobian(&mut self) -> &[Vector6<f64>] {
        self.columns.fill(Vector6::zeros());
        for (segment, placed) in self.segments.iter().zip(&self.placed) {
            let Some(column) = segment.column else {
                continue;
            };
            let axis = placed.axis() * segment.gear;
            // a mimic joint adds to the column of its master
            let column = &mut self.columns[column];
            if segment.turns {
                let linear = axis.cross(&(self.p_frame - placed.position));
                *column += Vector6::new(linear.x, linear.y, linear.z, axis.x, axis.y, axis.z);
            } else {
                *column += Vector6::new(axis.x, axis.y, axis.z, 0.0, 0.0, 0.0);
            }
        }
        &self.columns
    }

    /// [`Chain::jacobian`] as a matrix, shape `(6, columns)`.
    pub fn jacobian_matrix(&mut self) -> Matrix6xX<f64> {
        Matrix6xX::from_columns(self.jacobian())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::RobotFile;
    use crate::kinematics::{forward_kinematics, geometric_jacobian};
    use crate::text::Source;

    /// A prismatic joint, then a revolute one with a mimic joint of multiplier -2; a second arm on the prismatic joint.
    const SHADOW: &str = r#"
        format = 1
        name = "shadow"
        links = [{ name = "base" }, { name = "cart" }, { name = "arm" }, { name = "hand" }, { name = "other" }]
        [[joints]]
        name = "slide"
        type = "prismatic"
        parent = "base"
        child = "cart"
        axis = [1, 0, 0]
        [[joints]]
        name = "turn"
        type = "revolute"
        parent = "cart"
        child = "arm"
        origin = { xyz_m = [0, 0, 0.4], rpy_deg = [10, 20, 30] }
        axis = [0, 1, 0]
        [[joints]]
        name = "shadow"
        type = "revolute"
        parent = "arm"
        child = "hand"
        origin = { xyz_m = [0.5, 0, 0] }
        axis = [0, 0, 1]
        mimic = { joint = "turn", multiplier = -2.0, offset = 0.1 }
        [[joints]]
        name = "aside"
        type = "continuous"
        parent = "cart"
        child = "other"
        axis = [0, 0, 1]
    "#;

    #[test]
    fn a_chain_is_the_whole_robots_kinematics_bit_for_bit() {
        let file = RobotFile::parse(Source::new("t", SHADOW)).unwrap();
        let robot = file.build(&[]).unwrap();
        let q = robot.positions(&[0.3, -0.7, 1.1]).unwrap();
        let poses = forward_kinematics(&robot, &q);
        for name in ["hand", "other", "base"] {
            let frame = robot.frame(name).unwrap();
            let all = geometric_jacobian(&robot, &q, frame);
            let mut chain = Chain::with_joints(&robot, frame, &[2, 0, 1]);
            assert_eq!(chain.update(q.as_slice()), poses.world_from(frame));
            for (column, &joint) in chain.jacobian().to_vec().iter().zip(&[2, 0, 1]) {
                // the sum over a mimic pair is taken from the other end
                assert!((column - all.column(joint)).norm() <= 1e-15);
            }
        }
        let hand = Chain::new(&robot, robot.frame("hand").unwrap());
        assert_eq!(hand.joints(), [0, 1]);
        assert_eq!(hand.length_m(), 0.9);
        assert!(
            Chain::new(&robot, robot.frame("base").unwrap())
                .joints()
                .is_empty()
        );
    }
}
