//! Dynamics of robots that are not a plain tree: closed loops and mimic joints.
//!
//! Forward: the accelerations of the tree, corrected by the Lagrange multipliers of the loop-closure constraints:
//! `J M⁻¹ Jᵀ λ = -(J a + J̇ q̇)`. Redundant constraints drop out by pivoting. Inverse: with independent rates `u`, all rates are `B u`,
//! and the efforts of the driven joints are `Bᵀ` times those of the tree, which eliminates the constraint forces.
//!
//! Source: Featherstone, *Rigid Body Dynamics Algorithms* (2008), sections 8.5 and 8.6.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Vector3};

use super::aba::SingularMassMatrix;
use super::crba::Crba;
use super::rnea::{Rnea, inverse_dynamics};
use crate::joint_space::{JointAccelerations, JointPositions, JointVelocities};
use crate::kinematics::closure::{
    Closure, LoopError, closed_accelerations, closed_positions, closed_velocities,
    independent_motions,
};
use crate::model::robot::Robot;

/// Pivots below this fraction of the largest belong to redundant constraints.
const REDUNDANT: f64 = 1e-11;

/// Scratch memory of constrained forward dynamics for one robot.
#[derive(Debug, Clone)]
pub(crate) struct Constrained {
    closure: Closure,
    crba: Crba,
    rnea: Rnea,
    matrix: DMatrix<f64>,
    bias: Vec<f64>,
    still: Vec<f64>,
}

impl Constrained {
    pub(crate) fn new(robot: &Robot) -> Self {
        let n = robot.n();
        Self {
            closure: Closure::new(robot),
            crba: Crba::new(robot),
            rnea: Rnea::new(robot),
            matrix: DMatrix::zeros(n, n),
            bias: vec![0.0; n],
            still: vec![0.0; n],
        }
    }

    /// The Cholesky factor of the mass matrix with `added` inertia on the joints, shape `(n)`, if any.
    fn factor(
        &mut self,
        robot: &Robot,
        q: &[f64],
        added: Option<&[f64]>,
    ) -> Result<Cholesky<f64, Dyn>, SingularMassMatrix> {
        self.crba.fill(robot, q, &mut self.matrix);
        for (i, added) in added.into_iter().flatten().enumerate() {
            self.matrix[(i, i)] += added;
        }
        self.matrix
            .clone()
            .cholesky()
            .ok_or_else(|| weakest(robot, &self.matrix))
    }

    /// As [`super::aba::Aba::acceleration_with`]: with viscous damping, without dry friction, with `added` inertia if any.
    pub(crate) fn acceleration(
        &mut self,
        robot: &Robot,
        gravity_m_s2: &Vector3<f64>,
        (q, qd): (&[f64], &[f64]),
        effort: &[f64],
        added: Option<&[f64]>,
        qdd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        let n = robot.n();
        let factor = self.factor(robot, q, added)?;
        self.rnea
            .effort(robot, gravity_m_s2, q, qd, &self.still, &mut self.bias);
        let mut rhs = DVector::from_iterator(n, (0..n).map(|i| effort[i] - self.bias[i]));
        for body in robot.bodies() {
            rhs[body.q_index] -= body.gear * body.damping * body.rate(qd);
        }
        factor.solve_mut(&mut rhs);
        if !robot.loops().is_empty() {
            self.closure.update(robot, q, qd);
            let jacobian = &self.closure.jacobian;
            let missing = -(jacobian * &rhs + &self.closure.bias);
            rhs += Response::new(&factor, jacobian).for_change(&missing);
        }
        qdd[..n].copy_from_slice(rhs.as_slice());
        Ok(())
    }

    /// Whether the mass matrix of the open tree with `added` inertia on the joints is positive definite.
    pub(crate) fn is_positive_with(&mut self, robot: &Robot, q: &[f64], added: &[f64]) -> bool {
        self.factor(robot, q, Some(added)).is_ok()
    }

    /// Accelerations per unit effort, shape `(n, n)`: the inverse mass matrix, with `added` inertia if any, projected on the
    /// constraints.
    pub(crate) fn inverse_inertia(
        &mut self,
        robot: &Robot,
        q: &[f64],
        added: Option<&[f64]>,
    ) -> Option<DMatrix<f64>> {
        let factor = self.factor(robot, q, added).ok()?;
        let mut inverse = factor.inverse();
        if !robot.loops().is_empty() {
            self.closure.update(robot, q, &self.still);
            let response = Response::new(&factor, &self.closure.jacobian);
            for i in 0..robot.n() {
                let column = inverse.column(i).into_owned();
                let missing = -(&self.closure.jacobian * &column);
                let held = column + response.for_change(&missing);
                inverse.set_column(i, &held);
            }
        }
        Some(inverse)
    }

    /// Projects `(q, qd)` onto the loop-closure constraints by the smallest change in the metric of the kinetic energy.
    pub(crate) fn close(
        &mut self,
        robot: &Robot,
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        if robot.loops().is_empty() {
            return Ok(());
        }
        let factor = self.factor(robot, q, None)?;
        // after one step the gap has the size of the integrator's error; two corrections reduce it to rounding
        for _ in 0..2 {
            self.closure.update(robot, q, &self.still);
            let response = Response::new(&factor, &self.closure.jacobian);
            let change = response.for_change(&-&self.closure.residual);
            for (q, change) in q.iter_mut().zip(change.iter()) {
                *q += change;
            }
        }
        self.closure.update(robot, q, &self.still);
        let rates = DVector::from_column_slice(qd);
        let missing = -(&self.closure.jacobian * rates);
        let change = Response::new(&factor, &self.closure.jacobian).for_change(&missing);
        for (qd, change) in qd.iter_mut().zip(change.iter()) {
            *qd += change;
        }
        Ok(())
    }
}

/// Response of the joints to constraint forces: `M⁻¹ Jᵀ`, and the factor of `J M⁻¹ Jᵀ`.
struct Response {
    /// `M⁻¹ Jᵀ`, shape `(n, constraints)`.
    per_multiplier: DMatrix<f64>,
    /// Pivoted Cholesky factor over the constraints that are kept.
    kept: Vec<usize>,
    lower: DMatrix<f64>,
}

impl Response {
    fn new(factor: &Cholesky<f64, Dyn>, jacobian: &DMatrix<f64>) -> Self {
        let rows = jacobian.nrows();
        let mut per_multiplier = jacobian.transpose();
        factor.solve_mut(&mut per_multiplier);
        let compliance = |i: usize, j: usize| -> f64 {
            jacobian
                .row(i)
                .iter()
                .zip(per_multiplier.column(j).iter())
                .map(|(a, b)| a * b)
                .sum()
        };
        // pivoted Cholesky: take the remaining constraint with the largest pivot, until all others are redundant
        let mut rest: Vec<f64> = (0..rows).map(|i| compliance(i, i)).collect();
        let strongest = rest.iter().copied().fold(0.0, f64::max);
        let mut kept: Vec<usize> = Vec::with_capacity(rows);
        let mut lower = DMatrix::zeros(rows, rows);
        while kept.len() < rows {
            let Some(next) = (0..rows)
                .filter(|i| !kept.contains(i))
                .max_by(|&a, &b| rest[a].total_cmp(&rest[b]).then(b.cmp(&a)))
            else {
                break;
            };
            if rest[next] <= REDUNDANT * strongest {
                break;
            }
            let k = kept.len();
            let diagonal = rest[next].sqrt();
            for i in 0..rows {
                let mut value = compliance(i, next);
                for j in 0..k {
                    value -= lower[(i, j)] * lower[(next, j)];
                }
                lower[(i, k)] = value / diagonal;
                if i != next && !kept.contains(&i) {
                    rest[i] -= lower[(i, k)] * lower[(i, k)];
                }
            }
            lower[(next, k)] = diagonal;
            kept.push(next);
        }
        Self {
            per_multiplier,
            kept,
            lower,
        }
    }

    /// The change of the joints that changes the constraints by `wanted`.
    fn for_change(&self, wanted: &DVector<f64>) -> DVector<f64> {
        let k = self.kept.len();
        let mut y = vec![0.0; k];
        for a in 0..k {
            let mut sum = wanted[self.kept[a]];
            for (b, y) in y.iter().enumerate().take(a) {
                sum -= self.lower[(self.kept[a], b)] * y;
            }
            y[a] = sum / self.lower[(self.kept[a], a)];
        }
        let mut multiplier = vec![0.0; k];
        for a in (0..k).rev() {
            let mut sum = y[a];
            for (b, known) in multiplier.iter().enumerate().skip(a + 1) {
                sum -= self.lower[(self.kept[b], a)] * known;
            }
            multiplier[a] = sum / self.lower[(self.kept[a], a)];
        }
        let mut change = DVector::zeros(self.per_multiplier.nrows());
        for (multiplier, &row) in multiplier.iter().zip(&self.kept) {
            change.axpy(*multiplier, &self.per_multiplier.column(row), 1.0);
        }
        change
    }
}

/// The joint that moves the least inertia, for the error message.
#[cold]
fn weakest(robot: &Robot, matrix: &DMatrix<f64>) -> SingularMassMatrix {
    let least = (0..robot.n()).min_by(|&a, &b| matrix[(a, a)].total_cmp(&matrix[(b, b)]));
    SingularMassMatrix {
        joint: least
            .and_then(|i| robot.moving_joints().nth(i))
            .map(|joint| joint.name.clone())
            .unwrap_or_default(),
    }
}

/// The motion and efforts of [`driven_efforts`]; joint vectors are over the whole of `q`.
#[derive(Debug, Clone, PartialEq)]
pub struct ConstrainedMotion {
    /// Positions that close the loops, shape `(n)`.
    pub q: JointPositions,
    /// Their rates, shape `(n)`.
    pub qd: JointVelocities,
    /// Their accelerations, shape `(n)`.
    pub qdd: JointAccelerations,
    /// Efforts of the independent joints, in the order of [`Robot::independent`] \[N m or N\].
    pub effort: Vec<f64>,
}

/// Inverse dynamics of a robot with loops: the efforts of its independent joints, the dependent ones having no drive.
///
/// Takes positions, velocities and accelerations of the independent joints, in the order of [`Robot::independent`]. With damping
/// and dry friction of all joints. A robot without loops gets its plain inverse dynamics.
///
/// # Errors
/// [`LoopError`] where the loops cannot be closed or do not determine the dependent joints.
///
/// # Panics
/// If a slice has another length than [`Robot::independent`].
pub fn driven_efforts(
    robot: &Robot,
    gravity_m_s2: &Vector3<f64>,
    q: &[f64],
    qd: &[f64],
    qdd: &[f64],
) -> Result<ConstrainedMotion, LoopError> {
    let closed = closed_positions(robot, q)?;
    let rates = closed_velocities(robot, &closed, qd)?;
    let accelerations = closed_accelerations(robot, &closed, &rates, qdd)?;
    let motions = independent_motions(robot, &closed)?;
    let (q, qd, qdd) = (
        JointPositions::new(closed),
        JointVelocities::new(rates),
        JointAccelerations::new(accelerations),
    );
    let tree = inverse_dynamics(robot, gravity_m_s2, &q, &qd, &qdd);
    let effort = motions
        .column_iter()
        .map(|b| b.iter().zip(tree.as_slice()).map(|(b, t)| b * t).sum())
        .collect();
    Ok(ConstrainedMotion { q, qd, qdd, effort })
}

/// The mass matrix of the independent joints alone, `Bᵀ M B`, shape `(independent, independent)`, at the closed position `q`,
/// shape `(n)`.
///
/// # Errors
/// [`LoopError::Singular`] where the loops do not determine the dependent joints.
pub fn driven_mass_matrix(robot: &Robot, q: &JointPositions) -> Result<DMatrix<f64>, LoopError> {
    let mass = super::mass_matrix(robot, q);
    let motions = independent_motions(robot, q.as_slice())?;
    let columns: Vec<DVector<f64>> = motions.column_iter().map(|b| b.into_owned()).collect();
    let k = columns.len();
    let moved: Vec<DVector<f64>> = columns.iter().map(|column| &mass * column).collect();
    Ok(DMatrix::from_fn(k, k, |i, j| columns[i].dot(&moved[j])))
}
