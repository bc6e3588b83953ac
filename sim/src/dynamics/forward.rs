//! Forward dynamics of any robot: the articulated-body algorithm on a plain tree, constrained dynamics where loops or mimic
//! joints couple the joints.

use nalgebra::{DMatrix, Vector3};

use super::aba::{Aba, SingularMassMatrix};
use super::crba::Crba;
use super::loops::Constrained;
use crate::joint_space::{JointAccelerations, JointEfforts, JointPositions, JointVelocities};
use crate::model::robot::Robot;

/// Returns the joint accelerations, shape `(n)`, that `effort` causes at `(q, qd)`, with damping and dry friction.
///
/// # Errors
/// [`SingularMassMatrix`] if a joint moves neither mass nor armature.
pub fn forward_dynamics(
    robot: &Robot,
    gravity_m_s2: &Vector3<f64>,
    q: &JointPositions,
    qd: &JointVelocities,
    effort: &JointEfforts,
) -> Result<JointAccelerations, SingularMassMatrix> {
    let mut applied = effort.clone();
    for body in robot.bodies() {
        applied.as_mut_slice()[body.q_index] -=
            body.gear * body.joint_friction().overcome_at(body.rate(qd.as_slice()));
    }
    let mut qdd = JointAccelerations::zeros(robot.n());
    ForwardDynamics::new(robot).acceleration(
        robot,
        gravity_m_s2,
        q.as_slice(),
        qd.as_slice(),
        applied.as_slice(),
        qdd.as_mut_slice(),
    )?;
    Ok(qdd)
}

/// The first joint found that moves neither mass nor armature at home, if there is one: no effort can move the robot in a simulation.
pub fn immovable_joint(robot: &Robot) -> Option<SingularMassMatrix> {
    let rest = vec![0.0; robot.n()];
    let mut accelerations = rest.clone();
    ForwardDynamics::new(robot)
        .acceleration(
            robot,
            &Vector3::zeros(),
            robot.home(),
            &rest,
            &rest,
            &mut accelerations,
        )
        .err()
}

/// Whether no joint moves anything: no body has mass, a moment of inertia or armature.
pub fn moves_nothing(robot: &Robot) -> bool {
    robot.bodies().iter().all(|body| {
        let tensor = body.inertia.to_matrix();
        body.mass_kg == 0.0 && body.armature == 0.0 && tensor.iter().all(|x| *x == 0.0)
    })
}

/// Forward dynamics of one robot, with its scratch memory. In a loop it allocates nothing for a plain tree.
#[derive(Debug, Clone)]
pub struct ForwardDynamics {
    algorithm: Algorithm,
    /// The last inverse mass matrix.
    inverse: DMatrix<f64>,
}

#[derive(Debug, Clone)]
enum Algorithm {
    Tree(Aba, TreeMass),
    Coupled(Box<Constrained>),
}

/// The mass matrix of a plain tree, with scratch memory.
#[derive(Debug, Clone)]
struct TreeMass {
    crba: Crba,
    matrix: DMatrix<f64>,
}

impl TreeMass {
    /// Writes the inverse of the mass matrix with `added` on its diagonal; `None` if it is singular.
    fn invert(
        &mut self,
        robot: &Robot,
        q: &[f64],
        added: Option<&[f64]>,
        inverse: &mut DMatrix<f64>,
    ) -> Option<()> {
        let mut matrix = std::mem::replace(&mut self.matrix, DMatrix::zeros(0, 0));
        self.crba.fill(robot, q, &mut matrix);
        for (i, added) in added.into_iter().flatten().enumerate() {
            matrix[(i, i)] += added;
        }
        let factor = matrix.cholesky();
        if let Some(factor) = &factor {
            inverse.fill_with_identity();
            factor.solve_mut(inverse);
        }
        let is_regular = factor.is_some();
        self.matrix = match factor {
            Some(factor) => factor.unpack_dirty(),
            None => DMatrix::zeros(robot.n(), robot.n()),
        };
        is_regular.then_some(())
    }
}

impl ForwardDynamics {
    /// Allocates the scratch memory for `robot`.
    pub fn new(robot: &Robot) -> Self {
        let square = || DMatrix::zeros(robot.n(), robot.n());
        Self {
            algorithm: if robot.is_plain_tree() {
                let mass = TreeMass {
                    crba: Crba::new(robot),
                    matrix: square(),
                };
                Algorithm::Tree(Aba::new(robot), mass)
            } else {
                Algorithm::Coupled(Box::new(Constrained::new(robot)))
            },
            inverse: square(),
        }
    }

    /// Writes the accelerations into `qdd`; all slices have shape `(n)`. With viscous damping, without dry friction (whose sign a
    /// caller decides).
    ///
    /// # Errors
    /// [`SingularMassMatrix`] if a joint moves neither mass nor armature; `qdd` is then unfinished.
    ///
    /// # Panics
    /// If a slice is shorter than [`Robot::n`], or `robot` is not the one of [`ForwardDynamics::new`].
    pub fn acceleration(
        &mut self,
        robot: &Robot,
        gravity_m_s2: &Vector3<f64>,
        q: &[f64],
        qd: &[f64],
        effort: &[f64],
        qdd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        match &mut self.algorithm {
            Algorithm::Tree(aba, _) => aba.acceleration(robot, gravity_m_s2, q, qd, effort, qdd),
            Algorithm::Coupled(coupled) => {
                coupled.acceleration(robot, gravity_m_s2, (q, qd), effort, None, qdd)
            }
        }
    }

    /// As [`Self::acceleration`], with `added` inertia on the joints, shape `(n)`: `(M + diag(added)) qdd = effort - h - D qd`, with
    /// the loop-closure constraints if there are any.
    ///
    /// # Errors
    /// [`SingularMassMatrix`] if a joint moves nothing with it.
    pub(crate) fn acceleration_with(
        &mut self,
        robot: &Robot,
        gravity_m_s2: &Vector3<f64>,
        state: (&[f64], &[f64]),
        effort: &[f64],
        added: &[f64],
        qdd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        match &mut self.algorithm {
            Algorithm::Tree(aba, _) => {
                aba.acceleration_with(robot, gravity_m_s2, state, effort, added, qdd)
            }
            Algorithm::Coupled(coupled) => {
                coupled.acceleration(robot, gravity_m_s2, state, effort, Some(added), qdd)
            }
        }
    }

    /// Whether `M + diag(added)` is positive definite at `q`, for the mass matrix of the open tree; both slices have shape `(n)`.
    pub(crate) fn is_positive_with(&mut self, robot: &Robot, q: &[f64], added: &[f64]) -> bool {
        match &mut self.algorithm {
            Algorithm::Tree(aba, _) => aba.is_positive_with(robot, q, added),
            Algorithm::Coupled(coupled) => coupled.is_positive_with(robot, q, added),
        }
    }

    /// Projects a state of shape `(n)` onto the loop-closure constraints; does nothing for a tree.
    ///
    /// # Errors
    /// [`SingularMassMatrix`] if a joint moves neither mass nor armature.
    pub fn close_loops(
        &mut self,
        robot: &Robot,
        q: &mut [f64],
        qd: &mut [f64],
    ) -> Result<(), SingularMassMatrix> {
        match &mut self.algorithm {
            Algorithm::Tree(..) => Ok(()),
            Algorithm::Coupled(coupled) => coupled.close(robot, q, qd),
        }
    }

    /// The inverse mass matrix, constraints included: accelerations per unit effort, shape `(n, n)`; `None` if it is singular. With
    /// `added` inertia on the joints, shape `(n)`, if any.
    pub(crate) fn inverse_inertia(
        &mut self,
        robot: &Robot,
        q: &[f64],
        added: Option<&[f64]>,
    ) -> Option<&DMatrix<f64>> {
        match &mut self.algorithm {
            Algorithm::Coupled(coupled) => {
                self.inverse = coupled.inverse_inertia(robot, q, added)?;
            }
            Algorithm::Tree(_, mass) => mass.invert(robot, q, added, &mut self.inverse)?,
        }
        Some(&self.inverse)
    }
}
