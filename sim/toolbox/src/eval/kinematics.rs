//! The operations on poses, velocities and reach.

use kinemark_sim::joint_space::JointPositions;
use kinemark_sim::kinematics::analytic::{Angles, analytic_jacobian};
use kinemark_sim::kinematics::centre_of_mass::{Counted, centre_of_mass};
use kinemark_sim::kinematics::closure::independent_motions;
use kinemark_sim::kinematics::derivative;
use kinemark_sim::kinematics::manipulability;
use kinemark_sim::kinematics::manipulability::TWIST;
use kinemark_sim::kinematics::workspace::sample_workspace;
use kinemark_sim::kinematics::{forward_kinematics, geometric_jacobian};
use kinemark_sim::model::robot::{Frame, Robot};
use nalgebra::{Matrix3, Matrix6xX, Vector3, Vector6};
use serde::{Deserialize, Serialize};

use super::joint_state::{positions, velocities};
use super::number_fields::{Numbers, TwistRows, finite, finite_number, finite_rows, matrix_rows};
use super::operation::{frame_or_tcp, frame_or_world};
use super::refusal::{Code, Refusal, refuse};

/// A workspace of more points is asked for by mistake.
const MOST_SAMPLES: usize = 100_000;

/// Forward kinematics: the pose of a frame.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Fk {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// The frame; the TCP where none is given.
    pub frame: Option<String>,
    /// The frame that coordinates are expressed in; the world where none is given.
    pub r#in: Option<String>,
}

/// The answer to [`Fk`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FramePose {
    /// Position of the frame's origin.
    pub position_m: Vec<f64>,
    /// Three rows; the columns are the axes of the frame.
    pub rotation: Vec<Vec<f64>>,
}

/// The pose of a frame.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn fk(robot: &Robot, request: &Fk) -> Result<FramePose, Refusal> {
    let q = positions(robot, "q", &request.q)?;
    let frame = frame_or_tcp(robot, request.frame.as_deref())?;
    let base = frame_or_world(robot, request.r#in.as_deref())?;
    let poses = forward_kinematics(robot, &q);
    let world_from_frame = poses.world_from(frame);
    let pose = match base {
        None => world_from_frame,
        Some(base) => poses.world_from(base).inv_mul(&world_from_frame),
    };
    Ok(FramePose {
        position_m: finite(pose.translation.vector.as_slice())?,
        rotation: matrix_rows(pose.rotation.matrix())?,
    })
}

/// The Jacobian of a frame: its rows are `[linear; angular]`, its columns the joints that move.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Jacobian {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// The frame; the TCP where none is given.
    pub frame: Option<String>,
    /// The frame whose axes the rows are in; the world where none is given.
    pub r#in: Option<String>,
    /// Angles whose rates are the lower rows, in the world; the angular velocity where none are given.
    pub angles: Option<Angles>,
}

/// The answer to [`Jacobian`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JacobianRows {
    /// Shape `(6, n)`; with loops that of the open tree.
    pub jacobian: Vec<Vec<f64>>,
    /// Shape `(6, independent)`, the loops kept closed; only with loops, where they determine the dependent joints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub independent_jacobian: Option<Vec<Vec<f64>>>,
}

/// The Jacobian of a frame.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn jacobian(robot: &Robot, request: &Jacobian) -> Result<JacobianRows, Refusal> {
    let q = positions(robot, "q", &request.q)?;
    let frame = frame_or_tcp(robot, request.frame.as_deref())?;
    let base = frame_or_world(robot, request.r#in.as_deref())?;
    let jacobian = match (request.angles, base) {
        (None, _) => jacobian_in(robot, &q, frame, base),
        (Some(angles), None) => analytic_jacobian(robot, &q, frame, angles)
            .map_err(|error| Refusal::new(Code::Singular, error))?,
        (Some(_), Some(_)) => {
            return refuse(
                Code::OutOfRange,
                "`angles` are those of the world; leave `in` out",
            );
        }
    };
    let has_loops = !robot.loops().is_empty();
    let of_independent = has_loops.then(|| independent_columns(robot, &q, &jacobian).ok());
    Ok(JacobianRows {
        jacobian: matrix_rows(&jacobian)?,
        independent_jacobian: of_independent
            .flatten()
            .as_ref()
            .map(matrix_rows)
            .transpose()?,
    })
}

/// The time derivative of the geometric Jacobian, in the axes of the world.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct JacobianDerivative {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// Joint velocities \[rad/s or m/s\].
    pub qd: Numbers,
    /// The frame; the TCP where none is given.
    pub frame: Option<String>,
}

/// The answer to [`JacobianDerivative`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JacobianDerivativeRows {
    /// Shape `(6, n)`, rows `[linear; angular]`.
    pub jacobian_derivative: Vec<Vec<f64>>,
}

/// The time derivative of the geometric Jacobian.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn jacobian_derivative(
    robot: &Robot,
    request: &JacobianDerivative,
) -> Result<JacobianDerivativeRows, Refusal> {
    let q = positions(robot, "q", &request.q)?;
    let qd = velocities(robot, "qd", &q, &request.qd)?;
    let frame = frame_or_tcp(robot, request.frame.as_deref())?;
    let rows = matrix_rows(&derivative::jacobian_derivative(robot, &q, &qd, frame))?;
    Ok(JacobianDerivativeRows {
        jacobian_derivative: rows,
    })
}

/// How well a frame can move, by the singular values of its Jacobian; with loops, that of the independent joints.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Manipulability {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// The frame; the TCP where none is given.
    pub frame: Option<String>,
    /// The frame whose axes the rows are in; the world where none is given.
    pub r#in: Option<String>,
    /// The rows of the Jacobian that count; all where none are given.
    pub rows: Option<TwistRows>,
}

/// The answer to [`Manipulability`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ManipulabilityMeasures {
    /// Yoshikawa's measure: the product of the singular values, zero with fewer joints than rows.
    pub measure: f64,
    /// Largest first.
    pub singular_values: Vec<f64>,
    /// Largest by smallest singular value; `None` where it is infinite.
    pub condition: Option<f64>,
}

/// How well a frame can move.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn manipulability(
    robot: &Robot,
    request: &Manipulability,
) -> Result<ManipulabilityMeasures, Refusal> {
    let q = positions(robot, "q", &request.q)?;
    let frame = frame_or_tcp(robot, request.frame.as_deref())?;
    let base = frame_or_world(robot, request.r#in.as_deref())?;
    let mut jacobian = jacobian_in(robot, &q, frame, base);
    if !robot.loops().is_empty() {
        // only the independent joints can be moved at will
        jacobian = independent_columns(robot, &q, &jacobian)?;
    }
    let rows = request.rows.as_ref().map_or(TWIST, |rows| &rows.0);
    let ellipsoid = manipulability::Manipulability::of(&jacobian, rows);
    Ok(ManipulabilityMeasures {
        measure: finite_number(ellipsoid.yoshikawa())?,
        singular_values: finite(ellipsoid.singular_values())?,
        condition: ellipsoid.condition(),
    })
}

/// Positions that a frame reaches, at joint positions spread evenly over their limits.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Workspace {
    /// The frame; the TCP where none is given.
    pub frame: Option<String>,
    /// How many; 1000 where it is not given.
    pub samples: Option<usize>,
    /// The point that reach is measured from; the world's origin where none is given.
    pub from_m: Option<[f64; 3]>,
}

/// The answer to [`Workspace`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WorkspacePoints {
    /// Points in the world.
    pub points_m: Vec<Vec<f64>>,
    /// The corners of the box around them; `None` without points.
    pub bounds_m: Option<Vec<Vec<f64>>>,
    /// The distance of the farthest one.
    pub reach_m: f64,
    /// How many samples have loops that do not close.
    pub open_samples: usize,
}

/// Positions that a frame reaches.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn workspace(robot: &Robot, request: &Workspace) -> Result<WorkspacePoints, Refusal> {
    let frame = frame_or_tcp(robot, request.frame.as_deref())?;
    let samples = request.samples.unwrap_or(1000);
    if samples > MOST_SAMPLES {
        let message = format!("{samples} samples are more than {MOST_SAMPLES}");
        return refuse(Code::TooLarge, message);
    }
    let workspace = sample_workspace(robot, frame, samples);
    let bounds = workspace.bounds_m();
    let from: Vector3<f64> = request.from_m.unwrap_or_default().into();
    Ok(WorkspacePoints {
        points_m: finite_rows(workspace.points_m().iter().map(Vector3::as_slice))?,
        bounds_m: bounds
            .map(|corners| finite_rows(corners.iter().map(Vector3::as_slice)))
            .transpose()?,
        reach_m: finite_number(workspace.reach_m(&from))?,
        open_samples: workspace.open_samples(),
    })
}

/// The centre of mass.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Com {
    /// Joint positions \[rad or m\].
    pub q: Numbers,
    /// The frame that coordinates are expressed in; the world where none is given.
    pub r#in: Option<String>,
    /// Which links count; where nothing is given, those that move, or all if none does.
    pub counted: Option<Counted>,
}

/// The answer to [`Com`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CentreOfMass {
    /// Where it is.
    pub position_m: Vec<f64>,
    /// The mass of the links that count.
    pub mass_kg: f64,
}

/// The centre of mass.
///
/// # Errors
///
/// The refusal that the same request in JSON is answered with.
pub fn com(robot: &Robot, request: &Com) -> Result<CentreOfMass, Refusal> {
    robot.check_masses()?;
    let q = positions(robot, "q", &request.q)?;
    let base = frame_or_world(robot, request.r#in.as_deref())?;
    // in a robot in which nothing moves, "all that moves" is nothing that anybody would ask for
    let of_all = if robot.n() == 0 {
        Counted::WholeRobot
    } else {
        Counted::MovingLinks
    };
    let counted = request.counted.unwrap_or(of_all);
    let Some(mut p_com) = centre_of_mass(robot, &q, counted) else {
        return refuse(Code::NoMass, no_mass(robot));
    };
    if let Some(base) = base {
        let world_from_base = forward_kinematics(robot, &q).world_from(base);
        let p_in_base = world_from_base.inverse_transform_point(&p_com.into());
        p_com = p_in_base.coords;
    }
    Ok(CentreOfMass {
        position_m: finite(p_com.as_slice())?,
        mass_kg: mass_kg(robot, counted),
    })
}

/// Why nothing that counts has mass, and what to do.
fn no_mass(robot: &Robot) -> String {
    let whole = robot.mass_kg();
    if whole > 0.0 {
        return format!(
            "no link that moves has mass, so they have no centre of mass; `\"counted\": \"all\"` counts those fixed to the world, \
             too, with {whole} kg in all"
        );
    }
    "what has no mass has no centre of mass; give links `inertia`".to_owned()
}

fn mass_kg(robot: &Robot, counted: Counted) -> f64 {
    let links = robot.links().iter();
    let links =
        links.filter(|link| counted == Counted::WholeRobot || link.attachment.body.is_some());
    links.map(|link| link.inertia.mass_kg).sum()
}

/// The Jacobian of `frame` in the axes of `base`, shape `(6, n)`.
fn jacobian_in(
    robot: &Robot,
    q: &JointPositions,
    frame: &Frame,
    base: Option<&Frame>,
) -> Matrix6xX<f64> {
    let mut jacobian = geometric_jacobian(robot, q, frame);
    if let Some(base) = base {
        let poses = forward_kinematics(robot, q);
        let axes: Matrix3<f64> = poses.world_from(base).rotation.matrix().transpose();
        for mut column in jacobian.column_iter_mut() {
            let linear = axes * column.fixed_rows::<3>(0);
            let angular = axes * column.fixed_rows::<3>(3);
            column.fixed_rows_mut::<3>(0).copy_from(&linear);
            column.fixed_rows_mut::<3>(3).copy_from(&angular);
        }
    }
    jacobian
}

/// The Jacobian by the independent joints of a robot with loops, shape `(6, independent)`.
fn independent_columns(
    robot: &Robot,
    q: &JointPositions,
    jacobian: &Matrix6xX<f64>,
) -> Result<Matrix6xX<f64>, Refusal> {
    let motions = independent_motions(robot, q.as_slice())?;
    let columns = motions.column_iter().map(|motion| jacobian * motion);
    Ok(Matrix6xX::from_columns(
        &columns.collect::<Vec<Vector6<f64>>>(),
    ))
}
