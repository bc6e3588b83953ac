//! Forward dynamics by the articulated-body algorithm: the accelerations caused by efforts, in time linear in the number of joints.

use nalgebra::{Matrix3, Vector3};

use crate::kinematics::forward::BodyPose;
use crate::model::robot::Robot;
use crate::spatial::Symmetric3;

/// A joint that moves no inertia: an effort on it would cause an infinite acceleration.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("joint `{joint}` moves no inertia, so an effort on it has no finite acceleration")]
pub struct SingularMassMatrix {
    /// The joint.
    pub joint: String,
}

/// Scratch memory of the algorithm for one robot, so that a loop allocates nothing.
#[derive(Debug, Clone)]
pub(super) struct Aba {
    nodes: Vec<Node>,
    /// Zeros of shape `(n)`, and room for accelerations that nobody reads.
    still: Vec<f64>,
    unread: Vec<f64>,
}

/// An articulated body about its own origin, in world axes. Its inertia maps `[dw; a]` to `[n; f]`:
/// `n = upper dw + cross a`, `f = crossᵀ dw + lower a`.
#[derive(Debug, Clone, Copy)]
struct Node {
    /// Of a body without a parent: its pose at the joint position 0.
    unmoved: BodyPose,
    placed: BodyPose,
    /// Origin relative to the parent's origin.
    r: Vector3<f64>,
    axis: Vector3<f64>,
    w: Vector3<f64>,
    /// Velocity-dependent acceleration: angular and linear.
    bias_dw: Vector3<f64>,
    bias_a: Vector3<f64>,
    upper: Symmetric3,
    cross: Matrix3<f64>,
    lower: Symmetric3,
    /// Velocity-dependent wrench: moment and force.
    n: Vector3<f64>,
    f: Vector3<f64>,
    /// Inertia times the joint's axis: moment and force.
    u_n: Vector3<f64>,
    u_f: Vector3<f64>,
    /// Inverse of the articulated inertia at the joint.
    per_inertia: f64,
    /// Effort that remains for acceleration.
    free: f64,
    dw: Vector3<f64>,
    a: Vector3<f64>,
}

impl Node {
    fn zero() -> Self {
        let zero = Vector3::zeros();
        Self {
            unmoved: BodyPose::WORLD,
            placed: BodyPose::WORLD,
            r: zero,
            axis: zero,
            w: zero,
            bias_dw: zero,
            bias_a: zero,
            upper: Symmetric3::default(),
            cross: Matrix3::zeros(),
            lower: Symmetric3::default(),
            n: zero,
            f: zero,
            u_n: zero,
            u_f: zero,
            per_inertia: 0.0,
            free: 0.0,
            dw: zero,
            a: zero,
        }
    }
}

impl Aba {
    /// Allocates the scratch memory for `robot`, a plain tree.
    pub(super) fn new(robot: &Robot) -> Self {
        let bodies = robot.bodies().iter();
        let nodes = bodies.map(|body| Node {
            unmoved: BodyPose::unmoved(&BodyPose::WORLD, body),
            ..Node::zero()
        });
        Self {
            nodes: nodes.collect(),
            still: vec![0.0; robot.n()],
            unread: vec![0.0; robot.n()],
        }
    }

    /// Whether `M + diag(added)` is positive definite at `q`; both slices have shape `(n)`. Allocates nothing.
    ///
    /// The inertias that the joints feel are the pivots of a factorization `Lᵀ D L` of that matrix, so one pass decides.
    /// Source: Featherstone (2008), sec. 6.5 and 7.3.
    pub(super) fn is_positive_with(&mut self, robot: &Robot, q: &[f64], added: &[f64]) -> bool {
        let (still, mut unread) = (
            std::mem::take(&mut self.still),
            std::mem::take(&mut self.unread),
        );
        let (state, none) = ((q, &still[..]), Vector3::zeros());
        let solved = self.solve::<true>(robot, &none, state, &still, added, &mut unread);
        (self.still, self.unread) = (still, unread);
        solved.is_ok()
    }

    /// Writes the accelerations into `qdd`; all slices have shape `(n)`. With viscous damping, without dry friction (whose sign a
    /// caller decides). Allocates nothing.
    ///
    /// # Errors
    /// [`SingularMassMatrix`] if a joint moves neither mass nor armature; `qdd` is then unfinished.
    ///
    /// # Panics
    /// If a slice is shorter than [`Robot::n`], or `robot` is not the one of [`Aba::new`].
    pub(super) fn acceleration(
        &mut self,
        robot: &Robot,
        gravity_m_s2: &Vector3<f64>,
        q: &[f64],
        qd: &[f64],
        effort: &[f64],
        qdd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        self.solve::<false>(robot, gravity_m_s2, (q, qd), effort, &[], qdd)
    }

    /// As [`Self::acceleration`], with `added` inertia on the joints, shape `(n)`: `(M + diag(added)) qdd = effort - h - D qd`.
    ///
    /// # Errors
    /// [`SingularMassMatrix`] if a joint moves nothing with it, or less than nothing.
    pub(super) fn acceleration_with(
        &mut self,
        robot: &Robot,
        gravity_m_s2: &Vector3<f64>,
        state: (&[f64], &[f64]),
        effort: &[f64],
        added: &[f64],
        qdd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        self.solve::<true>(robot, gravity_m_s2, state, effort, added, qdd)
    }

    /// Both of them; compiled separately, so that the inertia that is added costs nothing where there is none.
    // long: three passes over the same nodes. The second turns the rigid inertias of the first into articulated ones in place, and the
    // third reads the results of both, so none of them is meaningful alone or in another order.
    #[inline]
    fn solve<const ADDED: bool>(
        &mut self,
        robot: &Robot,
        gravity_m_s2: &Vector3<f64>,
        (q, qd): (&[f64], &[f64]),
        effort: &[f64],
        added: &[f64],
        qdd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        let bodies = robot.bodies();
        let nodes = &mut self.nodes[..bodies.len()];
        // outward pass: poses, velocities, rigid inertias, velocity terms
        for (i, body) in bodies.iter().enumerate() {
            let (before, rest) = nodes.split_at_mut(i);
            let node = &mut rest[0];
            let (position, rate) = (q[body.q_index], qd[body.q_index]);
            let parent = body.parent.map(|p| &before[p]);
            let placed = match parent {
                Some(parent) => BodyPose::on_parent(&parent.placed, body, position),
                None => node.unmoved.moved(body, position),
            };
            let axis = placed.axis();
            let motion = axis * rate;
            let parent_w = parent.map_or_else(Vector3::zeros, |parent| parent.w);
            let w = if body.turns {
                parent_w + motion
            } else {
                parent_w
            };
            // what only a parent's motion causes is not read where there is no parent
            if let Some(parent) = parent {
                let r = placed.position - parent.placed.position;
                let swung = parent_w.cross(&parent_w.cross(&r));
                let turned = parent_w.cross(&motion);
                (node.bias_dw, node.bias_a) = if body.turns {
                    (turned, swung)
                } else {
                    (Vector3::zeros(), swung + turned * 2.0)
                };
                node.r = r;
            }
            let h = placed.world_from_body * body.first_moment;
            let inertia = body.inertia.rotated(&placed.world_from_body);
            node.n = w.cross(&inertia.times(&w));
            node.f = w.cross(&w.cross(&h));
            node.upper = inertia;
            node.cross = h.cross_matrix();
            node.lower = Symmetric3::scaled_identity(body.mass_kg);
            node.placed = placed;
            node.axis = axis;
            node.w = w;
        }
        // inward pass: articulated inertias
        for i in (0..bodies.len()).rev() {
            let body = &bodies[i];
            let k = body.q_index;
            let passive = effort[k] - body.damping * qd[k];
            let (before, rest) = nodes.split_at_mut(i);
            let node = &mut rest[0];
            let mut felt = if body.turns {
                node.u_n = node.upper.times(&node.axis);
                node.u_f = node.cross.tr_mul(&node.axis);
                node.free = passive - node.axis.dot(&node.n);
                node.axis.dot(&node.u_n)
            } else {
                node.u_n = node.cross * node.axis;
                node.u_f = node.lower.times(&node.axis);
                node.free = passive - node.axis.dot(&node.f);
                node.axis.dot(&node.u_f)
            } + body.armature;
            if ADDED {
                felt += added[k];
            }
            if felt <= 0.0 {
                return Err(singular(robot, k));
            }
            node.per_inertia = 1.0 / felt;
            let Some(p) = body.parent else { continue };
            // the parent gets no force along the motion of the joint
            let s = node.per_inertia;
            node.upper.subtract_outer(&node.u_n, s);
            node.lower.subtract_outer(&node.u_f, s);
            node.cross -= node.u_n * (node.u_f * s).transpose();
            let give = node.free * s;
            let n = node.n
                + node.upper.times(&node.bias_dw)
                + node.cross * node.bias_a
                + node.u_n * give;
            let f = node.f
                + node.cross.tr_mul(&node.bias_dw)
                + node.lower.times(&node.bias_a)
                + node.u_f * give;
            let parent = &mut before[p];
            parent.n += n + node.r.cross(&f);
            parent.f += f;
            add_moved(parent, node);
        }
        // outward pass: accelerations
        for (i, body) in bodies.iter().enumerate() {
            let (dw, a) = match body.parent {
                Some(p) => {
                    let (dw, a) = (nodes[p].dw, nodes[p].a);
                    let node = &nodes[i];
                    (dw + node.bias_dw, a + dw.cross(&node.r) + node.bias_a)
                }
                // gravity as an upward acceleration of the base
                None => (Vector3::zeros(), -gravity_m_s2),
            };
            let node = &mut nodes[i];
            let acceleration =
                (node.free - node.u_n.dot(&dw) - node.u_f.dot(&a)) * node.per_inertia;
            qdd[body.q_index] = acceleration;
            node.dw = dw;
            node.a = a;
            if body.turns {
                node.dw += node.axis * acceleration;
            } else {
                node.a += node.axis * acceleration;
            }
        }
        Ok(())
    }
}

#[cold]
fn singular(robot: &Robot, q_index: usize) -> SingularMassMatrix {
    let joint = robot.moving_joints().nth(q_index);
    SingularMassMatrix {
        joint: joint.map(|joint| joint.name.clone()).unwrap_or_default(),
    }
}

/// Adds a child's articulated inertia to its parent's, moved to the parent's origin by `P = [r]×`:
/// `cross + P lower`, `upper + P crossᵀ - (cross + P lower) P`.
#[inline]
fn add_moved(parent: &mut Node, child: &Node) {
    let (x, y, z) = (child.r.x, child.r.y, child.r.z);
    let m = &child.lower;
    let c = &child.cross;
    // cross + P lower, row by row
    let b11 = c.m11 - z * m.xy + y * m.xz;
    let b12 = c.m12 - z * m.yy + y * m.yz;
    let b13 = c.m13 - z * m.yz + y * m.zz;
    let b21 = c.m21 + z * m.xx - x * m.xz;
    let b22 = c.m22 + z * m.xy - x * m.yz;
    let b23 = c.m23 + z * m.xz - x * m.zz;
    let b31 = c.m31 - y * m.xx + x * m.xy;
    let b32 = c.m32 - y * m.xy + x * m.yy;
    let b33 = c.m33 - y * m.xz + x * m.yz;
    let a = &child.upper;
    // P crossᵀ - b P, upper triangle
    parent.upper.add(&Symmetric3 {
        xx: a.xx + (y * c.m13 - z * c.m12) - (b12 * z - b13 * y),
        yy: a.yy + (z * c.m21 - x * c.m23) - (b23 * x - b21 * z),
        zz: a.zz + (x * c.m32 - y * c.m31) - (b31 * y - b32 * x),
        xy: a.xy + (y * c.m23 - z * c.m22) - (b13 * x - b11 * z),
        xz: a.xz + (y * c.m33 - z * c.m32) - (b11 * y - b12 * x),
        yz: a.yz + (z * c.m31 - x * c.m33) - (b21 * y - b22 * x),
    });
    parent.cross += Matrix3::new(b11, b12, b13, b21, b22, b23, b31, b32, b33);
    parent.lower.add(m);
}
