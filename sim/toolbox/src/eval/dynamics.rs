//! The operations on efforts, accelerations and energy.

use kinemark_sim::dynamics;
use kinemark_sim::dynamics::GRAVITY_M_S2;
use kinemark_sim::model::robot::Robot;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::joint_state::{accelerations, efforts, independent, positions, velocities};
use super::number_fields::{Numbers, finite, finite_number, matrix_rows};
use super::refusal::{Code, Refusal, refuse};
use crate::joint_names::joint_names;

/// Gravity in the world, the earth's where none is given \[m/s²\].
pub(super) fn gravity_or_earths(given: Option<[f64; 3]>) -> Vector3<f64> {
    given.map_or(GRAVITY_M_S2, Vector3::from)
}

/// Refuses a robot that has nothing to move: its efforts and energies would all be zero, which nobody asks for.
fn refuse_massless(robot: &Robot) -> Result<(), Refusal> {
    if robot.n() > 0 && dynamics::moves_nothing(robot) {
        return refuse(
            Code::NoMass,
            "no link that moves has mass, so there is nothing to compute efforts for: give links an `inertia`, or a joint string a \
             `--density`",
        );
    }
    Ok(())
}

/// A robot at rest.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct AtRest {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// Gravity in the world \[m/s²\]; to `crba` it makes no difference.
    pub gravity_m_s2: Option<[f64; 3]>,
}

/// A robot in motion, without gravity.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct InMotion {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// Joint velocities \[rad/s or m/s\].
    pub qd: Numbers,
}

/// A robot in motion under gravity.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct UnderGravity {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// Joint velocities \[rad/s or m/s\].
    pub qd: Numbers,
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: Option<[f64; 3]>,
}

/// A robot that accelerates; of the joints that move, or with `inverse_dynamics` of the independent ones.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Accelerated {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// Joint velocities \[rad/s or m/s\].
    pub qd: Numbers,
    /// Joint accelerations \[rad/s² or m/s²\].
    pub qdd: Numbers,
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: Option<[f64; 3]>,
}

/// A robot in motion under efforts.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct UnderEffort {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// Joint velocities \[rad/s or m/s\].
    pub qd: Numbers,
    /// Joint efforts \[N m or N\].
    pub effort: Numbers,
    /// Gravity in the world \[m/s²\].
    pub gravity_m_s2: Option<[f64; 3]>,
}

/// One effort per joint that moves.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn rnea(robot: &Robot, request: &Accelerated) -> Result<Efforts, Refusal> {
    robot.check_inertias()?;
    refuse_massless(robot)?;
    let q = positions(robot, "q", &request.q)?;
    let qd = velocities(robot, "qd", &q, &request.qd)?;
    let qdd = accelerations(robot, "qdd", (&q, &qd), &request.qdd)?;
    let gravity = gravity_or_earths(request.gravity_m_s2);
    Efforts::new(dynamics::inverse_dynamics(robot, &gravity, &q, &qd, &qdd).as_slice())
}

/// Coriolis, centrifugal and gravity terms, without damping and friction.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn bias(robot: &Robot, request: &UnderGravity) -> Result<Efforts, Refusal> {
    robot.check_inertias()?;
    refuse_massless(robot)?;
    let q = positions(robot, "q", &request.q)?;
    let qd = velocities(robot, "qd", &q, &request.qd)?;
    let gravity = gravity_or_earths(request.gravity_m_s2);
    Efforts::new(dynamics::bias_effort(robot, &gravity, &q, &qd).as_slice())
}

/// The effort that holds the robot still against gravity; with loops that of the open tree.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn gravity(robot: &Robot, request: &AtRest) -> Result<Efforts, Refusal> {
    robot.check_inertias()?;
    refuse_massless(robot)?;
    let q = positions(robot, "q", &request.q)?;
    let gravity = gravity_or_earths(request.gravity_m_s2);
    Efforts::new(dynamics::gravity_effort(robot, &gravity, &q).as_slice())
}

/// Coriolis and centrifugal terms.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn coriolis(robot: &Robot, request: &InMotion) -> Result<Efforts, Refusal> {
    robot.check_inertias()?;
    refuse_massless(robot)?;
    let q = positions(robot, "q", &request.q)?;
    let qd = velocities(robot, "qd", &q, &request.qd)?;
    Efforts::new(dynamics::coriolis_effort(robot, &q, &qd).as_slice())
}

/// Efforts of the independent joints.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DriveEfforts {
    /// \[N m or N\].
    pub effort: Vec<f64>,
    /// Names of the independent joints.
    pub joints: Vec<String>,
    /// Positions of all joints, the loops closed \[rad or m\].
    pub q: Vec<f64>,
}

/// Inverse dynamics of the independent joints, which alone have drives in a robot with loops.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn inverse_dynamics(robot: &Robot, request: &Accelerated) -> Result<DriveEfforts, Refusal> {
    robot.check_inertias()?;
    refuse_massless(robot)?;
    let q = independent(robot, "q", &request.q)?;
    let qd = independent(robot, "qd", &request.qd)?;
    let qdd = independent(robot, "qdd", &request.qdd)?;
    let gravity = gravity_or_earths(request.gravity_m_s2);
    let motion = dynamics::driven_efforts(robot, &gravity, q, qd, qdd)?;
    Ok(DriveEfforts {
        effort: finite(&motion.effort)?,
        joints: joint_names(robot, robot.independent()),
        q: finite(motion.q.as_slice())?,
    })
}

/// The mass matrix, armature included.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MassMatrix {
    /// Shape `(n, n)`; with loops that of the open tree.
    pub mass_matrix: Vec<Vec<f64>>,
    /// That of the independent joints, the loops kept closed; only with loops, where they determine the dependent joints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub independent_mass_matrix: Option<Vec<Vec<f64>>>,
}

/// The mass matrix.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn crba(robot: &Robot, request: &AtRest) -> Result<MassMatrix, Refusal> {
    robot.check_inertias()?;
    refuse_massless(robot)?;
    let q = positions(robot, "q", &request.q)?;
    let has_loops = !robot.loops().is_empty();
    let of_independent = has_loops.then(|| dynamics::driven_mass_matrix(robot, &q).ok());
    Ok(MassMatrix {
        mass_matrix: matrix_rows(&dynamics::mass_matrix(robot, &q))?,
        independent_mass_matrix: of_independent
            .flatten()
            .as_ref()
            .map(matrix_rows)
            .transpose()?,
    })
}

/// One acceleration per joint that moves.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Accelerations {
    /// \[rad/s² or m/s²\].
    pub qdd: Vec<f64>,
}

/// Forward dynamics: the acceleration under an effort, with joint damping and dry friction.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn aba(robot: &Robot, request: &UnderEffort) -> Result<Accelerations, Refusal> {
    robot.check_inertias()?;
    let q = positions(robot, "q", &request.q)?;
    let qd = velocities(robot, "qd", &q, &request.qd)?;
    let effort = efforts(robot, "effort", &request.effort)?;
    let gravity = gravity_or_earths(request.gravity_m_s2);
    let qdd = dynamics::forward_dynamics(robot, &gravity, &q, &qd, &effort)
        .map_err(|error| Refusal::new(Code::Singular, error))?;
    let qdd = finite(qdd.as_slice())?;
    Ok(Accelerations { qdd })
}

/// Kinetic energy, and potential energy of all links, zero at the world's origin.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Energies {
    /// Kinetic energy.
    pub kinetic_j: f64,
    /// Potential energy.
    pub potential_j: f64,
}

/// Kinetic and potential energy.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn energy(robot: &Robot, request: &UnderGravity) -> Result<Energies, Refusal> {
    robot.check_inertias()?;
    refuse_massless(robot)?;
    let q = positions(robot, "q", &request.q)?;
    let qd = velocities(robot, "qd", &q, &request.qd)?;
    let energy = dynamics::energy(robot, &gravity_or_earths(request.gravity_m_s2), &q, &qd);
    Ok(Energies {
        kinetic_j: finite_number(energy.kinetic_j)?,
        potential_j: finite_number(energy.potential_j)?,
    })
}
