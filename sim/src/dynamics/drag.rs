//! Drag on links: the joint efforts equivalent to the forces of the air.
//!
//! Each link with drag feels `½ ρ c A |v| v` at its own centre of mass (the origin of its frame if it has no mass), `v` being the
//! velocity of the air relative to that point. The efforts are `Σ Jᵀ F`, computed body by body without Jacobians. Drag on a link that
//! is fixed to the world has no effect.

use nalgebra::Vector3;

use crate::kinematics::forward::BodyPose;
use crate::model::air::{AirNow, Drag};
use crate::model::robot::Robot;

/// The links of one robot with drag, and scratch memory of the recursion, so that a loop allocates nothing.
#[derive(Debug, Clone)]
pub struct LinkDrag {
    points: Vec<DragPoint>,
    nodes: Vec<Node>,
}

/// The point at which the force on one link acts.
#[derive(Debug, Clone, Copy)]
struct DragPoint {
    body: usize,
    /// The link's centre of mass \[m\].
    p_com_in_body: Vector3<f64>,
    drag: Drag,
}

/// A body in world axes; the moment is about its origin.
#[derive(Debug, Clone, Copy)]
struct Node {
    placed: BodyPose,
    w: Vector3<f64>,
    v: Vector3<f64>,
    force_n: Vector3<f64>,
    moment_n_m: Vector3<f64>,
}

impl Node {
    const STILL: Self = Self {
        placed: BodyPose::WORLD,
        w: Vector3::new(0.0, 0.0, 0.0),
        v: Vector3::new(0.0, 0.0, 0.0),
        force_n: Vector3::new(0.0, 0.0, 0.0),
        moment_n_m: Vector3::new(0.0, 0.0, 0.0),
    };
}

impl LinkDrag {
    /// The drag of the links of `robot` that move.
    pub fn new(robot: &Robot) -> Self {
        let points: Vec<DragPoint> = robot
            .links()
            .iter()
            .filter_map(|link| {
                let body_from_link = &link.attachment.body_from_here;
                Some(DragPoint {
                    body: link.attachment.body?,
                    p_com_in_body: body_from_link.rotation * link.inertia.com_m
                        + body_from_link.translation.vector,
                    drag: link.drag?,
                })
            })
            .collect();
        // bodies after the last one with drag have no effect
        let bodies = points.iter().map(|point| point.body + 1).max();
        Self {
            points,
            nodes: vec![Node::STILL; bodies.unwrap_or(0)],
        }
    }

    /// Whether a link that moves has drag.
    pub fn is_present(&self) -> bool {
        !self.points.is_empty()
    }

    /// Adds the efforts of `air` at `(q, qd)` to `effort`; all slices have shape `(n)`, dependent joints of loops included.
    ///
    /// # Panics
    /// If a slice is shorter than [`Robot::n`], or `robot` is not the one of [`LinkDrag::new`].
    pub fn add_efforts(
        &mut self,
        robot: &Robot,
        q: &[f64],
        qd: &[f64],
        air: &AirNow,
        effort: &mut [f64],
    ) {
        let bodies = &robot.bodies()[..self.nodes.len()];
        // outward pass: poses and velocities
        for (i, body) in bodies.iter().enumerate() {
            let parent = body.parent.map_or(Node::STILL, |p| self.nodes[p]);
            let placed = BodyPose::on_parent(&parent.placed, body, body.position(q));
            let drive = placed.axis() * body.rate(qd);
            let r = placed.position - parent.placed.position;
            let carried = parent.v + parent.w.cross(&r);
            let (w, v) = if body.turns {
                (parent.w + drive, carried)
            } else {
                (parent.w, carried + drive)
            };
            self.nodes[i] = Node {
                placed,
                w,
                v,
                ..Node::STILL
            };
        }
        for point in &self.points {
            let node = &mut self.nodes[point.body];
            let r = node.placed.world_from_body * point.p_com_in_body;
            let force = air.drag_n(&point.drag, &(node.v + node.w.cross(&r)));
            node.force_n += force;
            node.moment_n_m += r.cross(&force);
        }
        // inward pass: project the force on each subtree on its joint, add it to the parent
        for (i, body) in bodies.iter().enumerate().rev() {
            let node = self.nodes[i];
            let along = if body.turns {
                node.moment_n_m
            } else {
                node.force_n
            };
            effort[body.q_index] += body.gear * node.placed.axis().dot(&along);
            if let Some(p) = body.parent {
                let parent = &mut self.nodes[p];
                let r = node.placed.position - parent.placed.position;
                parent.force_n += node.force_n;
                parent.moment_n_m += node.moment_n_m + r.cross(&node.force_n);
            }
        }
    }
}
