//! Kinetic and potential energy: what a frictionless run must keep.

use nalgebra::Vector3;

use super::crba::mass_matrix;
use crate::joint::{JointPositions, JointVelocities};
use crate::kinematics::forward_kinematics;
use crate::robot::Robot;

/// Energy of a robot \[J\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energy {
    /// `qdᵀ M qd / 2`, armature included \[J\].
    pub kinetic_j: f64,
    /// `-m g·c` over all links, fixed ones too, zero at the world's origin \[J\].
    pub potential_j: f64,
}

/// Returns the energy of `robot` at `(q, qd)`.
pub fn energy(
    robot: &Robot,
    gravity_m_s2: &Vector3<f64>,
    q: &JointPositions,
    qd: &JointVelocities,
) -> Energy {
    let momentum = mass_matrix(robot, q) * qd.vector();
    let poses = forward_kinematics(robot, q);
    let world = robot.world_inertia();
    let mut moment = world.com_m * world.mass_kg;
    for (body, placed) in robot.bodies().iter().zip(&poses.placed) {
        moment += placed.position * body.mass_kg + placed.world_from_body * body.first_moment;
    }
    Energy {
        kinetic_j: 0.5 * qd.vector().dot(&momentum),
        potential_j: -gravity_m_s2.dot(&moment),
    }
}
