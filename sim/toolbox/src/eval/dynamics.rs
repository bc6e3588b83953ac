//! The operations on efforts, accelerations and energy.

use kinemark_sim::dynamics;
use kinemark_sim::dynamics::GRAVITY_M_S2;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::joint_state::{accelerations, efforts, independent, positions, velocities};
use super::number_fields::{Numbers, finite, finite_number, matrix_rows};
use super::operation::{Operation, Subject};
use super::refusal::{Code, Refusal};
use crate::joint_names::joint_names;

/// Gravity in the world, the earth's where none is given \[m/s²\].
type OptionalGravity = Option<[f64; 3]>;

pub(super) fn gravity(given: OptionalGravity) -> Vector3<f64> {
    given.map_or(GRAVITY_M_S2, Vector3::from)
}

/// One effort per joint that moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Efforts {
    /// \[N m or N\].
    pub effort: Vec<f64>,
}

impl Efforts {
    fn new(effort: &[f64]) -> Result<Self, Refusal> {
        let effort = finite(effort)?;
        Ok(Self { effort })
    }
}

/// Inverse dynamics: the effort that gives an acceleration, with joint damping and dry friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rnea {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// Joint velocities \[rad/s or m/s\].
    pub qd: Numbers,
    /// Joint accelerations \[rad/s² or m/s²\].
    pub qdd: Numbers,
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: OptionalGravity,
}

impl Operation for Rnea {
    const NAME: &'static str = "rnea";
    type Answer = Efforts;

    fn answer(self, Subject { robot, .. }: Subject<'_>) -> Result<Efforts, Refusal> {
        let q = positions(robot, "q", &self.q)?;
        let qd = velocities(robot, "qd", &q, &self.qd)?;
        let qdd = accelerations(robot, "qdd", (&q, &qd), &self.qdd)?;
        let gravity = gravity(self.gravity_m_s2);
        Efforts::new(dynamics::inverse_dynamics(robot, &gravity, &q, &qd, &qdd).as_slice())
    }
}

/// Coriolis, centrifugal and gravity terms, without damping and friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bias {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// Joint velocities \[rad/s or m/s\].
    pub qd: Numbers,
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: OptionalGravity,
}

impl Operation for Bias {
    const NAME: &'static str = "bias";
    type Answer = Efforts;

    fn answer(self, Subject { robot, .. }: Subject<'_>) -> Result<Efforts, Refusal> {
        let q = positions(robot, "q", &self.q)?;
        let qd = velocities(robot, "qd", &q, &self.qd)?;
        let gravity = gravity(self.gravity_m_s2);
        Efforts::new(dynamics::bias_effort(robot, &gravity, &q, &qd).as_slice())
    }
}

/// The effort that holds the robot still against gravity; with loops that of the open tree.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gravity {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: OptionalGravity,
}

impl Operation for Gravity {
    const NAME: &'static str = "gravity";
    type Answer = Efforts;

    fn answer(self, Subject { robot, .. }: Subject<'_>) -> Result<Efforts, Refusal> {
        let q = positions(robot, "q", &self.q)?;
        let gravity = gravity(self.gravity_m_s2);
        Efforts::new(dynamics::gravity_effort(robot, &gravity, &q).as_slice())
    }
}

/// Coriolis and centrifugal terms.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coriolis {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// Joint velocities \[rad/s or m/s\].
    pub qd: Numbers,
}

impl Operation for Coriolis {
    const NAME: &'static str = "coriolis";
    type Answer = Efforts;

    fn answer(self, Subject { robot, .. }: Subject<'_>) -> Result<Efforts, Refusal> {
        let q = positions(robot, "q", &self.q)?;
        let qd = velocities(robot, "qd", &q, &self.qd)?;
        Efforts::new(dynamics::coriolis_effort(robot, &q, &qd).as_slice())
    }
}

/// Inverse dynamics of the independent joints, which alone have drives in a robot with loops; arrays are over them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InverseDynamics {
    /// Positions \[rad or m\].
    pub q: Numbers,
    /// Velocities \[rad/s or m/s\].
    pub qd: Numbers,
    /// Accelerations \[rad/s² or m/s²\].
    pub qdd: Numbers,
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: OptionalGravity,
}

/// The answer to [`InverseDynamics`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DriveEfforts {
    /// Efforts of the independent joints \[N m or N\].
    pub effort: Vec<f64>,
    /// Their names.
    pub joints: Vec<String>,
    /// Positions of all joints, the loops closed \[rad or m\].
    pub q: Vec<f64>,
}

impl Operation for InverseDynamics {
    const NAME: &'static str = "inverse_dynamics";
    type Answer = DriveEfforts;

    fn answer(self, Subject { robot, .. }: Subject<'_>) -> Result<DriveEfforts, Refusal> {
        let q = independent(robot, "q", &self.q)?;
        let qd = independent(robot, "qd", &self.qd)?;
        let qdd = independent(robot, "qdd", &self.qdd)?;
        let motion = dynamics::driven_efforts(robot, &gravity(self.gravity_m_s2), q, qd, qdd)
            .map_err(|error| Refusal::from(&error))?;
        Ok(DriveEfforts {
            effort: finite(&motion.effort)?,
            joints: joint_names(robot, robot.independent()),
            q: finite(motion.q.as_slice())?,
        })
    }
}

/// The mass matrix, armature included.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Crba {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// Makes no difference, but may be in a request like any other.
    pub gravity_m_s2: OptionalGravity,
}

/// The answer to [`Crba`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MassMatrix {
    /// Shape `(n, n)`; with loops that of the open tree.
    pub mass_matrix: Vec<Vec<f64>>,
    /// That of the independent joints, the loops kept closed; only with loops, where they determine the dependent joints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub independent_mass_matrix: Option<Vec<Vec<f64>>>,
}

impl Operation for Crba {
    const NAME: &'static str = "crba";
    type Answer = MassMatrix;

    fn answer(self, Subject { robot, .. }: Subject<'_>) -> Result<MassMatrix, Refusal> {
        let q = positions(robot, "q", &self.q)?;
        let mass_matrix = matrix_rows(&dynamics::mass_matrix(robot, &q))?;
        let has_loops = !robot.loops().is_empty();
        let of_independent = has_loops.then(|| dynamics::driven_mass_matrix(robot, &q).ok());
        let of_independent = of_independent.flatten();
        Ok(MassMatrix {
            mass_matrix,
            independent_mass_matrix: of_independent.as_ref().map(matrix_rows).transpose()?,
        })
    }
}

/// Forward dynamics: the acceleration under an effort, with joint damping and dry friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Aba {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// Joint velocities \[rad/s or m/s\].
    pub qd: Numbers,
    /// Joint efforts \[N m or N\].
    pub effort: Numbers,
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: OptionalGravity,
}

/// The answer to [`Aba`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Accelerations {
    /// \[rad/s² or m/s²\].
    pub qdd: Vec<f64>,
}

impl Operation for Aba {
    const NAME: &'static str = "aba";
    type Answer = Accelerations;

    fn answer(self, Subject { robot, .. }: Subject<'_>) -> Result<Accelerations, Refusal> {
        let q = positions(robot, "q", &self.q)?;
        let qd = velocities(robot, "qd", &q, &self.qd)?;
        let effort = efforts(robot, "effort", &self.effort)?;
        let gravity = gravity(self.gravity_m_s2);
        let qdd = dynamics::forward_dynamics(robot, &gravity, &q, &qd, &effort)
            .map_err(|error| Refusal::new(Code::Singular, error.to_string()))?;
        let qdd = finite(qdd.as_slice())?;
        Ok(Accelerations { qdd })
    }
}

/// Kinetic energy, and potential energy of all links, zero at the world's origin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Energy {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// Joint velocities \[rad/s or m/s\].
    pub qd: Numbers,
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: OptionalGravity,
}

/// The answer to [`Energy`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Energies {
    /// Kinetic energy.
    pub kinetic_j: f64,
    /// Potential energy.
    pub potential_j: f64,
}

impl Operation for Energy {
    const NAME: &'static str = "energy";
    type Answer = Energies;

    fn answer(self, Subject { robot, .. }: Subject<'_>) -> Result<Energies, Refusal> {
        let q = positions(robot, "q", &self.q)?;
        let qd = velocities(robot, "qd", &q, &self.qd)?;
        let energy = dynamics::energy(robot, &gravity(self.gravity_m_s2), &q, &qd);
        Ok(Energies {
            kinetic_j: finite_number(energy.kinetic_j)?,
            potential_j: finite_number(energy.potential_j)?,
        })
    }
}
