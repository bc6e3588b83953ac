//! Kinetic and potential energy, whose sum a frictionless run conserves.

use nalgebra::{DMatrix, Vector3};

use super::crba::Crba;
use crate::joint_space::{JointPositions, JointVelocities};
use crate::kinematics::forward_kinematics;
use crate::model::robot::Robot;

/// Energy of a robot \[J\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energy {
    /// `qdᵀ M qd / 2`, armature included \[J\].
    pub kinetic_j: f64,
    /// `-m g·c` over all links, including fixed ones; zero at the world's origin \[J\].
    pub potential_j: f64,
}

/// Returns the energy of `robot` at `(q, qd)`.
pub fn energy(
    robot: &Robot,
    gravity_m_s2: &Vector3<f64>,
    q: &JointPositions,
    qd: &JointVelocities,
) -> Energy {
    let poses = forward_kinematics(robot, q);
    let world = robot.world_inertia();
    let mut moment = world.com_m * world.mass_kg;
    for (body, placed) in robot.bodies().iter().zip(&poses.placed) {
        moment += placed.position * body.mass_kg + placed.world_from_body * body.first_moment;
    }
    Energy {
        kinetic_j: kinetic_energy_j(robot, q.as_slice(), qd.as_slice()),
        potential_j: -gravity_m_s2.dot(&moment),
    }
}

/// Returns `qdᵀ M qd / 2`, armature included \[J\]; `q` and `qd` have shape `(n)`.
pub(crate) fn kinetic_energy_j(robot: &Robot, q: &[f64], qd: &[f64]) -> f64 {
    let n = robot.n();
    let mut mass = DMatrix::zeros(n, n);
    Crba::new(robot).fill(robot, q, &mut mass);
    let mut twice_j = 0.0;
    for (i, column) in mass.column_iter().enumerate() {
        let momentum: f64 = column.iter().zip(qd).map(|(m, rate)| m * rate).sum();
        twice_j += qd[i] * momentum;
    }
    0.5 * twice_j
}
