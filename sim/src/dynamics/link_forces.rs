//! Forces on links other than contact: the drag of the air, and pushes; the joint efforts equivalent to them.
//!
//! Each link with drag feels `½ ρ c A |v| v` at its own centre of mass (the origin of its frame if it has no mass), `v` being the
//! velocity of the air relative to that point. A push is a constant force in world axes at a point of the link. The efforts are `Σ Jᵀ F`,
//! computed body by body without Jacobians. Forces on a link that is fixed to the world have no effect.

use nalgebra::Vector3;

use crate::kinematics::forward::BodyPose;
use crate::model::air::{AirNow, Drag};
use crate::model::contact::{ContactFact, Party};
use crate::model::push::{Push, Pushed};
use crate::model::robot::Robot;

/// The forces on the links of one robot, and scratch memory of the recursion, so that a loop allocates nothing.
#[derive(Debug, Clone)]
pub struct LinkForces {
    drags: Vec<DragPoint>,
    /// The air, if any link has drag.
    air: Option<AirNow>,
    pushes: Vec<BodyPush>,
    wrenches: Vec<BodyWrench>,
    nodes: Vec<Node>,
    /// Bodies up to the last one with drag.
    with_drag: usize,
}

/// The point at which the force on one link acts.
#[derive(Debug, Clone, Copy)]
struct DragPoint {
    body: usize,
    /// The link's centre of mass \[m\].
    p_com_in_body: Vector3<f64>,
    drag: Drag,
}

/// A push on a link, which is fixed to a body.
#[derive(Debug, Clone, Copy)]
struct BodyPush {
    body: usize,
    p_in_body: Vector3<f64>,
    force_n: Vector3<f64>,
    moment_n_m: Vector3<f64>,
}

/// A force and its moment about the world's origin, world axes.
#[derive(Debug, Clone, Copy)]
struct BodyWrench {
    body: usize,
    force_n: Vector3<f64>,
    moment_n_m: Vector3<f64>,
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

impl LinkForces {
    /// No forces yet on the links of `robot`.
    pub fn new(robot: &Robot) -> Self {
        let drags: Vec<DragPoint> = robot
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
        let with_drag = drags.iter().map(|point| point.body + 1).max();
        Self {
            drags,
            air: None,
            pushes: Vec::new(),
            wrenches: Vec::new(),
            nodes: vec![Node::STILL; robot.bodies().len()],
            with_drag: with_drag.unwrap_or(0),
        }
    }

    /// Whether a link that moves has drag.
    pub fn have_drag(&self) -> bool {
        !self.drags.is_empty()
    }

    /// Sets the air; initially there is none.
    pub fn set_air(&mut self, air: Option<AirNow>) {
        self.air = air.filter(|_| self.have_drag());
    }

    /// Sets the pushes in effect to those of `pushes` that are on links which move.
    pub fn set_pushes<'p>(&mut self, robot: &Robot, pushes: impl Iterator<Item = &'p Push>) {
        self.pushes.clear();
        for push in pushes {
            let Pushed::Link(link) = push.on else {
                continue;
            };
            let attachment = &robot.links()[link].attachment;
            let body_from_link = &attachment.body_from_here;
            self.pushes.extend(attachment.body.map(|body| BodyPush {
                body,
                p_in_body: body_from_link.rotation * push.p_m + body_from_link.translation.vector,
                force_n: push.force_n,
                moment_n_m: push.moment_n_m,
            }));
        }
    }

    /// Sets the forces of `contacts` over a step of `dt_s` on links that move.
    pub(crate) fn set_contacts(&mut self, robot: &Robot, contacts: &[ContactFact], dt_s: f64) {
        self.wrenches.clear();
        for contact in contacts {
            // impulses act on the second party
            for (party, sign) in contact.parties.iter().zip([-1.0, 1.0]) {
                let Party::Link(link) = party else {
                    continue;
                };
                let impulse_n_s = contact.normal_impulse_n_s + contact.friction_impulse_n_s;
                let body = robot.links()[*link].attachment.body;
                self.wrenches.extend(body.map(|body| BodyWrench {
                    body,
                    force_n: impulse_n_s * (sign / dt_s),
                    moment_n_m: contact.moment_impulse_n_m_s * (sign / dt_s),
                }));
            }
        }
    }

    /// Takes over the air and the pushes of `other`, which are of the same robot.
    pub fn set_like(&mut self, other: &Self) {
        self.air = other.air;
        self.pushes.clone_from(&other.pushes);
        self.wrenches.clone_from(&other.wrenches);
    }

    /// Whether anything acts on the links: there is air and drag, a push, or a contact.
    pub fn act(&self) -> bool {
        self.air.is_some() || !(self.pushes.is_empty() && self.wrenches.is_empty())
    }

    /// Adds the efforts of the forces at `(q, qd)` to `effort`; all slices have shape `(n)`, dependent joints of loops included.
    ///
    /// # Panics
    /// If a slice is shorter than [`Robot::n`], or `robot` is not the one of [`LinkForces::new`].
    pub fn add_efforts(&mut self, robot: &Robot, q: &[f64], qd: &[f64], effort: &mut [f64]) {
        // bodies after the last one that feels anything have no effect
        let dragged = self.air.map_or(0, |_| self.with_drag);
        let pushed = self.pushes.iter().map(|push| push.body + 1);
        let touched = self.wrenches.iter().map(|wrench| wrench.body + 1);
        let reached = pushed.chain(touched).max().unwrap_or(0);
        let bodies = &robot.bodies()[..dragged.max(reached)];
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
        if let Some(air) = &self.air {
            for point in &self.drags {
                let node = &mut self.nodes[point.body];
                let r = node.placed.world_from_body * point.p_com_in_body;
                let force = air.drag_n(&point.drag, &(node.v + node.w.cross(&r)));
                node.force_n += force;
                node.moment_n_m += r.cross(&force);
            }
        }
        for push in &self.pushes {
            let node = &mut self.nodes[push.body];
            let r = node.placed.world_from_body * push.p_in_body;
            node.force_n += push.force_n;
            node.moment_n_m += r.cross(&push.force_n) + push.moment_n_m;
        }
        for wrench in &self.wrenches {
            let node = &mut self.nodes[wrench.body];
            node.force_n += wrench.force_n;
            node.moment_n_m += wrench.moment_n_m - node.placed.position.cross(&wrench.force_n);
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
