//! The mass matrix by the composite-rigid-body algorithm.

use nalgebra::{DMatrix, Vector3};

use crate::joint_space::JointPositions;
use crate::kinematics::forward::BodyPose;
use crate::model::robot::Robot;
use crate::spatial::Symmetric3;

/// Returns the mass matrix `M(q)`, shape `(n, n)`, symmetric; armature is on its diagonal.
///
/// Positive definite where every joint moves some mass or has an armature.
pub fn mass_matrix(robot: &Robot, q: &JointPositions) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(robot.n(), robot.n());
    Crba::new(robot).fill(robot, q.as_slice(), &mut matrix);
    matrix
}

/// Scratch memory of the algorithm for one robot, so that a loop allocates nothing.
#[derive(Debug, Clone)]
pub struct Crba {
    nodes: Vec<Node>,
}

/// A subtree frozen into one rigid body, about the origin of its first body, in world axes.
#[derive(Debug, Clone, Copy)]
struct Node {
    placed: BodyPose,
    mass_kg: f64,
    h: Vector3<f64>,
    inertia: Symmetric3,
}

impl Crba {
    /// Allocates the scratch memory for `robot`.
    pub fn new(robot: &Robot) -> Self {
        let node = Node {
            placed: BodyPose::WORLD,
            mass_kg: 0.0,
            h: Vector3::zeros(),
            inertia: Symmetric3::default(),
        };
        Self {
            nodes: vec![node; robot.bodies().len()],
        }
    }

    /// Writes the mass matrix at `q` into `matrix`. Allocates nothing.
    ///
    /// # Panics
    /// If `q` or `matrix` does not have the shape of `robot`, or `robot` is not the one of [`Crba::new`].
    pub fn fill(&mut self, robot: &Robot, q: &[f64], matrix: &mut DMatrix<f64>) {
        // cleared as one block: entry by entry would cost as much as the rest
        matrix.as_mut_slice().fill(0.0);
        for (i, body) in robot.bodies().iter().enumerate() {
            let parent = body
                .parent
                .map_or(BodyPose::WORLD, |p| self.nodes[p].placed);
            let placed = BodyPose::on_parent(&parent, body, body.position(q));
            self.nodes[i] = Node {
                placed,
                mass_kg: body.mass_kg,
                h: placed.world_from_body * body.first_moment,
                inertia: body.inertia.rotated(&placed.world_from_body),
            };
        }
        for (i, body) in robot.bodies().iter().enumerate().rev() {
            let node = self.nodes[i];
            if let Some(p) = body.parent {
                let parent = &mut self.nodes[p];
                let r = node.placed.position - parent.placed.position;
                // the subtree about the parent's origin: parallel axes with h = m c
                parent.mass_kg += node.mass_kg;
                parent.h += node.h + r * node.mass_kg;
                parent.inertia.add(&node.inertia);
                parent
                    .inertia
                    .add(&Symmetric3::of_point_mass(node.mass_kg, &r));
                let twice = 2.0 * node.h.dot(&r);
                let (h, t) = (node.h, &mut parent.inertia);
                t.xx += twice - 2.0 * h.x * r.x;
                t.yy += twice - 2.0 * h.y * r.y;
                t.zz += twice - 2.0 * h.z * r.z;
                t.xy -= h.x * r.y + h.y * r.x;
                t.xz -= h.x * r.z + h.z * r.x;
                t.yz -= h.y * r.z + h.z * r.y;
            }
            // the wrench that a unit acceleration of joint i needs
            let axis = node.placed.axis();
            let (mut n, f) = if body.turns {
                (node.inertia.times(&axis), axis.cross(&node.h))
            } else {
                (node.h.cross(&axis), axis * node.mass_kg)
            };
            let k = body.q_index;
            let along = if body.turns { n } else { f };
            // a mimic joint adds to the row and column of its master
            matrix[(k, k)] += body.gear * body.gear * (axis.dot(&along) + body.armature);
            // the wrench acts on every joint towards the root
            let mut at = node.placed.position;
            let mut next = body.parent;
            while let Some(p) = next {
                let carrier = &robot.bodies()[p];
                let placed = &self.nodes[p].placed;
                n += (at - placed.position).cross(&f);
                at = placed.position;
                let along = if carrier.turns { n } else { f };
                let value = placed.axis().dot(&along) * body.gear * carrier.gear;
                matrix[(k, carrier.q_index)] += value;
                matrix[(carrier.q_index, k)] += value;
                next = carrier.parent;
            }
        }
    }
}
