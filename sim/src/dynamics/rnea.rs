//! Inverse dynamics by the recursive Newton-Euler algorithm: the efforts that cause an acceleration.

use nalgebra::Vector3;

use crate::joint_space::{JointAccelerations, JointEfforts, JointPositions, JointVelocities};
use crate::kinematics::forward::BodyPose;
use crate::model::robot::{Body, Robot};

/// Returns the joint efforts, shape `(n)`, that give `qdd` at `(q, qd)`: `M qdd + h + damping qd + dry_friction sign(qd)`,
/// where each joint has the dry friction of the direction in which it moves.
pub fn inverse_dynamics(
    robot: &Robot,
    gravity_m_s2: &Vector3<f64>,
    q: &JointPositions,
    qd: &JointVelocities,
    qdd: &JointAccelerations,
) -> JointEfforts {
    let mut effort = rigid(robot, gravity_m_s2, q, Some(qd), Some(qdd));
    for body in robot.bodies() {
        let v = body.rate(qd.as_slice());
        effort.as_mut_slice()[body.q_index] +=
            body.gear * (body.damping * v + body.joint_friction().overcome_at(v));
    }
    effort
}

/// Returns the bias `h(q, qd)`, shape `(n)`: Coriolis, centrifugal and gravity terms, without damping or friction.
pub fn bias_effort(
    robot: &Robot,
    gravity_m_s2: &Vector3<f64>,
    q: &JointPositions,
    qd: &JointVelocities,
) -> JointEfforts {
    rigid(robot, gravity_m_s2, q, Some(qd), None)
}

/// Returns the Coriolis and centrifugal efforts, shape `(n)`: the bias without gravity.
pub fn coriolis_effort(robot: &Robot, q: &JointPositions, qd: &JointVelocities) -> JointEfforts {
    rigid(robot, &Vector3::zeros(), q, Some(qd), None)
}

/// Returns the efforts, shape `(n)`, that hold the robot still at `q` against gravity.
pub fn gravity_effort(
    robot: &Robot,
    gravity_m_s2: &Vector3<f64>,
    q: &JointPositions,
) -> JointEfforts {
    rigid(robot, gravity_m_s2, q, None, None)
}

fn rigid(
    robot: &Robot,
    gravity_m_s2: &Vector3<f64>,
    q: &JointPositions,
    qd: Option<&JointVelocities>,
    qdd: Option<&JointAccelerations>,
) -> JointEfforts {
    let zeros = vec![0.0; robot.n()];
    let mut effort = JointEfforts::zeros(robot.n());
    Rnea::new(robot).effort(
        robot,
        gravity_m_s2,
        q.as_slice(),
        qd.map_or(&zeros, |v| v.as_slice()),
        qdd.map_or(&zeros, |a| a.as_slice()),
        effort.as_mut_slice(),
    );
    effort
}

/// Scratch memory of the recursion for one robot, so that a loop allocates nothing.
#[derive(Debug, Clone)]
pub struct Rnea {
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    placed: BodyPose,
    /// Angular velocity in world axes \[rad/s\].
    w: Vector3<f64>,
    /// Angular acceleration in world axes \[rad/s²\].
    dw: Vector3<f64>,
    /// Classical acceleration of the origin, less gravity \[m/s²\].
    a: Vector3<f64>,
    /// Force on the body, then on the subtree \[N\].
    f: Vector3<f64>,
    /// Its moment about the origin \[N m\].
    n: Vector3<f64>,
}

impl Node {
    fn world(gravity_m_s2: &Vector3<f64>) -> Self {
        let zero = Vector3::zeros();
        Self {
            placed: BodyPose::WORLD,
            w: zero,
            dw: zero,
            // gravity as an upward acceleration of the base
            a: -gravity_m_s2,
            f: zero,
            n: zero,
        }
    }

    #[inline]
    fn moved(parent: &Self, body: &Body, q: f64, qd: f64, qdd: f64) -> Self {
        let placed = BodyPose::on_parent(&parent.placed, body, q);
        let axis = placed.axis();
        let r = placed.position - parent.placed.position;
        let carried = parent.a + parent.dw.cross(&r) + parent.w.cross(&parent.w.cross(&r));
        let (w, dw, a) = if body.turns {
            let spin = axis * qd;
            (
                parent.w + spin,
                parent.dw + axis * qdd + parent.w.cross(&spin),
                carried,
            )
        } else {
            let slide = axis * qd;
            (
                parent.w,
                parent.dw,
                carried + axis * qdd + parent.w.cross(&slide) * 2.0,
            )
        };
        let h = placed.world_from_body * body.first_moment;
        let inertia = body.inertia.rotated(&placed.world_from_body);
        // Newton and Euler about the body's origin
        let f = a * body.mass_kg + dw.cross(&h) + w.cross(&w.cross(&h));
        let n = inertia.times(&dw) + w.cross(&inertia.times(&w)) + h.cross(&a);
        Self {
            placed,
            w,
            dw,
            a,
            f,
            n,
        }
    }
}

impl Rnea {
    /// Allocates the scratch memory for `robot`.
    pub fn new(robot: &Robot) -> Self {
        Self {
            nodes: vec![Node::world(&Vector3::zeros()); robot.bodies().len()],
        }
    }

    /// Writes `M qdd + h + armature qdd` into `effort`; all slices have shape `(n)`. No damping, no friction. Allocates nothing.
    ///
    /// # Panics
    /// If a slice is shorter than [`Robot::n`], or `robot` is not the one of [`Rnea::new`].
    pub fn effort(
        &mut self,
        robot: &Robot,
        gravity_m_s2: &Vector3<f64>,
        q: &[f64],
        qd: &[f64],
        qdd: &[f64],
        effort: &mut [f64],
    ) {
        let world = Node::world(gravity_m_s2);
        // outward pass: motion, and the force that it needs on each body
        for (i, body) in robot.bodies().iter().enumerate() {
            let parent = body.parent.map_or(&world, |p| &self.nodes[p]);
            self.nodes[i] = Node::moved(
                parent,
                body,
                body.position(q),
                body.rate(qd),
                body.rate(qdd),
            );
        }
        // inward pass: project each subtree's force on its joint, add it to the parent
        effort[..robot.n()].fill(0.0);
        for (i, body) in robot.bodies().iter().enumerate().rev() {
            let node = self.nodes[i];
            let axis = node.placed.axis();
            let along = if body.turns { node.n } else { node.f };
            effort[body.q_index] += body.gear * (axis.dot(&along) + body.armature * body.rate(qdd));
            if let Some(p) = body.parent {
                let parent = &mut self.nodes[p];
                let r = node.placed.position - parent.placed.position;
                parent.f += node.f;
                parent.n += node.n + r.cross(&node.f);
            }
        }
    }

    /// Writes the efforts that hold the robot still at `q` into `effort`, shape `(n)`: [`Rnea::effort`] at rest, without the
    /// velocity terms. Allocates nothing.
    ///
    /// # Panics
    /// As [`Rnea::effort`].
    pub fn gravity(
        &mut self,
        robot: &Robot,
        gravity_m_s2: &Vector3<f64>,
        q: &[f64],
        effort: &mut [f64],
    ) {
        let world = Node::world(gravity_m_s2);
        for (i, body) in robot.bodies().iter().enumerate() {
            let parent = body.parent.map_or(&world, |p| &self.nodes[p]);
            let placed = BodyPose::on_parent(&parent.placed, body, body.position(q));
            let node = &mut self.nodes[i];
            node.placed = placed;
            node.f = world.a * body.mass_kg;
            node.n = (placed.world_from_body * body.first_moment).cross(&world.a);
        }
        effort[..robot.n()].fill(0.0);
        for (i, body) in robot.bodies().iter().enumerate().rev() {
            let node = self.nodes[i];
            let along = if body.turns { node.n } else { node.f };
            effort[body.q_index] += body.gear * node.placed.axis().dot(&along);
            if let Some(p) = body.parent {
                let parent = &mut self.nodes[p];
                let r = node.placed.position - parent.placed.position;
                parent.f += node.f;
                parent.n += node.n + r.cross(&node.f);
            }
        }
    }
}
