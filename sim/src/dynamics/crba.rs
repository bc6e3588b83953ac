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
    /// Of a body without a parent: its pose at the joint position 0.
    unmoved: BodyPose,
    placed: BodyPose,
    mass_kg: f64,
    h: Vector3<f64>,
    inertia: Symmetric3,
    carrier: Carrier,
}

/// What the way from a body to the root needs of it.
#[derive(Debug, Clone, Copy)]
struct Carrier {
    parent: Option<usize>,
    q_index: usize,
    turns: bool,
    gear: f64,
}

impl Crba {
    /// Allocates the scratch memory for `robot`.
    pub fn new(robot: &Robot) -> Self {
        let nodes = robot.bodies().iter().map(|body| Node {
            unmoved: BodyPose::unmoved(&BodyPose::WORLD, body),
            placed: BodyPose::WORLD,
            mass_kg: 0.0,
            h: Vector3::zeros(),
            inertia: Symmetric3::default(),
            carrier: Carrier {
                parent: body.parent,
                q_index: body.q_index,
                turns: body.turns,
                gear: body.gear,
            },
        });
        Self {
            nodes: nodes.collect(),
        }
    }

    /// Writes the mass matrix at `q` into `matrix`. Allocates nothing.
    ///
    /// # Panics
    /// If `q` or `matrix` does not have the shape of `robot`, or `robot` is not the one of [`Crba::new`].
    pub fn fill(&mut self, robot: &Robot, q: &[f64], matrix: &mut DMatrix<f64>) {
        let n = robot.n();
        assert_eq!(matrix.shape(), (n, n), "a mass matrix of {n} joints");
        // cleared as one block: entry by entry would cost as much as the rest
        matrix.as_mut_slice().fill(0.0);
        let bodies = robot.bodies();
        let nodes = &mut self.nodes[..bodies.len()];
        for (i, body) in bodies.iter().enumerate() {
            let (before, rest) = nodes.split_at_mut(i);
            let node = &mut rest[0];
            let position = body.position(q);
            let placed = match body.parent {
                Some(parent) => BodyPose::on_parent(&before[parent].placed, body, position),
                None => node.unmoved.moved(body, position),
            };
            node.mass_kg = body.mass_kg;
            node.h = placed.world_from_body * body.first_moment;
            node.inertia = body.inertia.rotated(&placed.world_from_body);
            node.placed = placed;
        }
        let entries = matrix.as_mut_slice();
        for (i, body) in bodies.iter().enumerate().rev() {
            let (before, rest) = nodes.split_at_mut(i);
            let node = &rest[0];
            if let Some(p) = node.carrier.parent {
                let parent = &mut before[p];
                let r = node.placed.position - parent.placed.position;
                // the subtree about the parent's origin: parallel axes with h = m c
                parent.mass_kg += node.mass_kg;
                parent.h += node.h + r * node.mass_kg;
                parent.inertia.add(&node.inertia);
                parent
                    .inertia
                    .add(&Symmetric3::of_point_mass(node.mass_kg, &r));
                let twice = 2.0 * node.h.dot(&r);
                let (h, t) = (&node.h, &mut parent.inertia);
                t.xx += twice - 2.0 * h.x * r.x;
                t.yy += twice - 2.0 * h.y * r.y;
                t.zz += twice - 2.0 * h.z * r.z;
                t.xy -= h.x * r.y + h.y * r.x;
                t.xz -= h.x * r.z + h.z * r.x;
                t.yz -= h.y * r.z + h.z * r.y;
            }
            // the wrench that a unit acceleration of joint i needs
            let axis = node.placed.axis();
            let (mut moment, force) = if body.turns {
                (node.inertia.times(&axis), axis.cross(&node.h))
            } else {
                (node.h.cross(&axis), axis * node.mass_kg)
            };
            let k = body.q_index;
            let along = if body.turns { moment } else { force };
            // a mimic joint adds to the row and column of its master
            entries[k * n + k] += body.gear * body.gear * (axis.dot(&along) + body.armature);
            // the wrench acts on every joint towards the root
            let mut at = node.placed.position;
            let mut next = node.carrier.parent;
            while let Some(p) = next {
                let Node {
                    placed, carrier, ..
                } = &before[p];
                moment += (at - placed.position).cross(&force);
                at = placed.position;
                let along = if carrier.turns { moment } else { force };
                let value = placed.axis().dot(&along) * body.gear * carrier.gear;
                entries[k * n + carrier.q_index] += value;
                entries[carrier.q_index * n + k] += value;
                next = carrier.parent;
            }
        }
    }
}
