//! The operations: each reads its fields, asks the simulator, and makes its answer.

use kinemark_sim::dynamics;
use kinemark_sim::joint::JointPositions;
use kinemark_sim::kinematics::analytic::{Angles, analytic_jacobian};
use kinemark_sim::kinematics::centre_of_mass::{Counted, centre_of_mass};
use kinemark_sim::kinematics::closure::independent_motions;
use kinemark_sim::kinematics::derivative::jacobian_derivative;
use kinemark_sim::kinematics::manipulability::Manipulability;
use kinemark_sim::kinematics::workspace::sample_workspace;
use kinemark_sim::kinematics::{forward_kinematics, geometric_jacobian};
use kinemark_sim::robot::{Frame, Joint, Robot};
use kinemark_sim::source::suggest;
use nalgebra::{Dim, Matrix, Matrix3, Matrix6xX, RawStorage, Vector3, Vector6};
use serde_json::{Map, Value, json};

use super::request::Fields;
use super::state::{loop_refusal, names_of};
use super::{Refusal, Subject, ik, simulate, trajectory};

const OPERATIONS: [&str; 18] = [
    "info",
    "fk",
    "jacobian",
    "jacobian_derivative",
    "manipulability",
    "workspace",
    "ik",
    "com",
    "rnea",
    "bias",
    "gravity",
    "coriolis",
    "inverse_dynamics",
    "crba",
    "aba",
    "energy",
    "trajectory",
    "simulate",
];

/// A workspace of more points is asked for by mistake.
const MOST_SAMPLES: usize = 100_000;

/// Answers one request.
pub(super) fn answer(
    subject: Subject<'_>,
    mut request: Map<String, Value>,
) -> Result<Map<String, Value>, Refusal> {
    let op = match request.remove("op") {
        Some(Value::String(op)) => op,
        Some(_) => return Err(Refusal::new("wrong-type", "`op` must be a text")),
        None => return Err(Refusal::new("missing-field", "`op` is missing")),
    };
    let fields = Fields::new(subject.robot, request);
    let answer = match op.as_str() {
        "info" => info(fields),
        "fk" => fk(fields),
        "jacobian" => jacobian(fields),
        "jacobian_derivative" => derivative(fields),
        "manipulability" => manipulability(fields),
        "workspace" => workspace(fields),
        "ik" => ik::answer(fields),
        "com" => com(fields),
        "rnea" => rnea(fields),
        "bias" => bias(fields),
        "gravity" => gravity(fields),
        "coriolis" => coriolis(fields),
        "inverse_dynamics" => inverse_dynamics(fields),
        "crba" => crba(fields),
        "aba" => aba(fields),
        "energy" => energy(fields),
        "trajectory" => trajectory::answer(fields),
        "simulate" => simulate::answer(subject.scene, fields),
        _ => {
            let known = suggest(&op, "operations", OPERATIONS.into_iter());
            Err(Refusal::new(
                "unknown-op",
                format!("no operation `{op}`; {known}"),
            ))
        }
    }?;
    match answer {
        Value::Object(fields) => Ok(fields),
        other => Ok(Map::from_iter([("answer".to_owned(), other)])),
    }
}

/// Numbers for JSON; one that is not finite has no place there.
pub(super) fn finite(values: &[f64]) -> Result<Value, Refusal> {
    let numbers: Option<Vec<Value>> = values
        .iter()
        .map(|value| serde_json::Number::from_f64(*value).map(Value::Number))
        .collect();
    numbers.map(Value::Array).ok_or_else(|| {
        Refusal::new(
            "not-finite",
            "the answer is not finite: the numbers given are too large",
        )
    })
}

fn rows(values: impl Iterator<Item = Vec<f64>>) -> Result<Value, Refusal> {
    let rows: Result<Vec<Value>, Refusal> = values.map(|row| finite(&row)).collect();
    rows.map(Value::Array)
}

pub(super) fn matrix_rows<R: Dim, C: Dim, S: RawStorage<f64, R, C>>(
    matrix: &Matrix<f64, R, C, S>,
) -> Result<Value, Refusal> {
    rows(matrix.row_iter().map(|row| row.iter().copied().collect()))
}

fn info(fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    fields.finish()?;
    let joint = |joint: &Joint| {
        json!({
            "name": joint.name,
            "type": joint.kind.name(),
            "lower": joint.limits.lower,
            "upper": joint.limits.upper,
            "speed": joint.limits.speed,
            "effort": joint.limits.effort,
        })
    };
    let joints: Vec<Value> = robot.moving_joints().map(joint).collect();
    let frames: Vec<&str> = robot
        .frames()
        .iter()
        .map(|frame| frame.name.as_str())
        .collect();
    let mimics = robot.joints().iter().filter_map(|joint| {
        let mimic = joint.mimic?;
        Some(json!({
            "name": joint.name,
            "joint": robot.joints()[mimic.joint].name,
            "multiplier": mimic.multiplier,
            "offset": mimic.offset,
        }))
    });
    Ok(json!({
        "name": robot.name(),
        "joints": joints,
        "frames": frames,
        "mass_kg": robot.mass_kg(),
        "independent": names_of(robot, robot.independent()),
        "mimics": mimics.collect::<Vec<Value>>(),
        "loops": robot.loops().len(),
        "warnings": robot.warnings(),
    }))
}

fn fk(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = fields.positions("q")?;
    let (frame, seen_in) = (fields.frame()?, fields.seen_in()?);
    fields.finish()?;
    let poses = forward_kinematics(robot, &q);
    let world_from_frame = poses.world_from(frame);
    let pose = match seen_in {
        None => world_from_frame,
        Some(seen_in) => poses.world_from(seen_in).inv_mul(&world_from_frame),
    };
    let r = pose.rotation.matrix();
    Ok(json!({
        "position_m": finite(pose.translation.vector.as_slice())?,
        "rotation": rows(r.row_iter().map(|row| row.iter().copied().collect()))?,
    }))
}

fn jacobian(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = fields.positions("q")?;
    let (frame, seen_in) = (fields.frame()?, fields.seen_in()?);
    let angles = match fields.text("angles")?.as_deref() {
        None => None,
        Some("rpy") => Some(Angles::RollPitchYaw),
        Some("zyz") => Some(Angles::Zyz),
        Some(other) => {
            return Err(Refusal::new(
                "out-of-range",
                format!("`angles` is `rpy` or `zyz`, got `{other}`"),
            ));
        }
    };
    fields.finish()?;
    let jacobian = match (angles, seen_in) {
        (None, _) => seen_jacobian(robot, &q, frame, seen_in),
        (Some(angles), None) => analytic_jacobian(robot, &q, frame, angles)
            .map_err(|error| Refusal::new("singular", error.to_string()))?,
        (Some(_), Some(_)) => {
            return Err(Refusal::new(
                "out-of-range",
                "`angles` are those of the world; leave `in` out",
            ));
        }
    };
    let mut answer = json!({ "jacobian": matrix_rows(&jacobian)? });
    if !robot.loops().is_empty()
        && let Ok(independent) = independent_columns(robot, &q, &jacobian)
    {
        answer["independent_jacobian"] = matrix_rows(&independent)?;
    }
    Ok(answer)
}

fn rnea(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = fields.positions("q")?;
    let qd = fields.velocities("qd", &q)?;
    let qdd = fields.accelerations("qdd", &q, &qd)?;
    let gravity = fields.gravity_m_s2()?;
    fields.finish()?;
    let effort = dynamics::inverse_dynamics(robot, &gravity, &q, &qd, &qdd);
    Ok(json!({ "effort": finite(effort.as_slice())? }))
}

/// The time derivative of the geometric Jacobian, world axes.
fn derivative(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = fields.positions("q")?;
    let qd = fields.velocities("qd", &q)?;
    let frame = fields.frame()?;
    fields.finish()?;
    let derivative = jacobian_derivative(robot, &q, &qd, frame);
    Ok(json!({ "jacobian_derivative": matrix_rows(&derivative)? }))
}

/// Positions that a frame reaches.
fn workspace(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let frame = fields.frame()?;
    let samples = fields.whole("samples")?.unwrap_or(1000);
    let from = fields.triple("from_m")?.unwrap_or(Vector3::zeros());
    fields.finish()?;
    if samples > MOST_SAMPLES {
        let message = format!("{samples} samples are more than {MOST_SAMPLES}");
        return Err(Refusal::new("too-large", message));
    }
    let workspace = sample_workspace(robot, frame, samples);
    let bounds: Option<Value> = workspace
        .bounds_m()
        .map(|[low, high]| Ok(json!([finite(low.as_slice())?, finite(high.as_slice())?])))
        .transpose()?;
    Ok(json!({
        "points_m": rows(workspace.points_m().iter().map(|p| p.as_slice().to_vec()))?,
        "bounds_m": bounds,
        "reach_m": finite(&[workspace.reach_m(&from)])?[0],
        "open_samples": workspace.open_samples(),
    }))
}

fn gravity(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = fields.positions("q")?;
    let gravity = fields.gravity_m_s2()?;
    fields.finish()?;
    let effort = dynamics::gravity_effort(robot, &gravity, &q);
    Ok(json!({ "effort": finite(effort.as_slice())? }))
}

fn coriolis(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = fields.positions("q")?;
    let qd = fields.velocities("qd", &q)?;
    fields.finish()?;
    let effort = dynamics::coriolis_effort(robot, &q, &qd);
    Ok(json!({ "effort": finite(effort.as_slice())? }))
}

fn bias(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = fields.positions("q")?;
    let qd = fields.velocities("qd", &q)?;
    let gravity = fields.gravity_m_s2()?;
    fields.finish()?;
    let effort = dynamics::bias_effort(robot, &gravity, &q, &qd);
    Ok(json!({ "effort": finite(effort.as_slice())? }))
}

fn crba(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = fields.positions("q")?;
    // gravity makes no difference here, but may stand in a request like any other
    fields.gravity_m_s2()?;
    fields.finish()?;
    let mut answer = json!({ "mass_matrix": matrix_rows(&dynamics::mass_matrix(robot, &q))? });
    if !robot.loops().is_empty()
        && let Ok(independent) = dynamics::driven_mass_matrix(robot, &q)
    {
        answer["independent_mass_matrix"] = matrix_rows(&independent)?;
    }
    Ok(answer)
}

fn aba(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = fields.positions("q")?;
    let qd = fields.velocities("qd", &q)?;
    let effort = fields.efforts("effort")?;
    let gravity = fields.gravity_m_s2()?;
    fields.finish()?;
    let qdd = dynamics::forward_dynamics(robot, &gravity, &q, &qd, &effort)
        .map_err(|error| Refusal::new("singular", error.to_string()))?;
    Ok(json!({ "qdd": finite(qdd.as_slice())? }))
}

fn energy(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = fields.positions("q")?;
    let qd = fields.velocities("qd", &q)?;
    let gravity = fields.gravity_m_s2()?;
    fields.finish()?;
    let energy = dynamics::energy(robot, &gravity, &q, &qd);
    let values = finite(&[energy.kinetic_j, energy.potential_j])?;
    Ok(json!({ "kinetic_j": values[0], "potential_j": values[1] }))
}

/// Inverse dynamics of the independent joints, which alone have drives in a robot with loops.
fn inverse_dynamics(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = fields.independent("q")?;
    let qd = fields.independent("qd")?;
    let qdd = fields.independent("qdd")?;
    let gravity = fields.gravity_m_s2()?;
    fields.finish()?;
    let motion = dynamics::driven_efforts(robot, &gravity, &q, &qd, &qdd)
        .map_err(|error| loop_refusal(&error))?;
    Ok(json!({
        "effort": finite(&motion.effort)?,
        "joints": names_of(robot, robot.independent()),
        "q": finite(motion.q.as_slice())?,
    }))
}

fn com(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = fields.positions("q")?;
    let seen_in = fields.seen_in()?;
    let counted = match fields.text("counted")?.as_deref() {
        None | Some("moving") => Counted::MovingLinks,
        Some("all") => Counted::WholeRobot,
        Some(other) => {
            return Err(Refusal::new(
                "out-of-range",
                format!("`counted` is `moving` or `all`, got `{other}`"),
            ));
        }
    };
    fields.finish()?;
    let Some(p_com) = centre_of_mass(robot, &q, counted) else {
        let message = "what has no mass has no centre of mass; give links `inertia`";
        return Err(Refusal::new("no-mass", message));
    };
    let p_com = match seen_in {
        None => p_com,
        Some(seen_in) => {
            let world_from_seen = forward_kinematics(robot, &q).world_from(seen_in);
            world_from_seen
                .inverse_transform_point(&p_com.into())
                .coords
        }
    };
    Ok(json!({
        "position_m": finite(p_com.as_slice())?,
        "mass_kg": mass_kg(robot, counted),
    }))
}

fn mass_kg(robot: &Robot, counted: Counted) -> f64 {
    let links = robot.links().iter();
    let links =
        links.filter(|link| counted == Counted::WholeRobot || link.attachment.body.is_some());
    links.map(|link| link.inertia.mass_kg).sum()
}

fn manipulability(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = fields.positions("q")?;
    let (frame, seen_in) = (fields.frame()?, fields.seen_in()?);
    let rows = fields.rows()?;
    fields.finish()?;
    let jacobian = seen_jacobian(robot, &q, frame, seen_in);
    // only the independent joints can be moved at will
    let jacobian = if robot.loops().is_empty() {
        jacobian
    } else {
        independent_columns(robot, &q, &jacobian)?
    };
    let ellipsoid = Manipulability::of(&jacobian, &rows);
    Ok(json!({
        "measure": finite(&[ellipsoid.yoshikawa()])?[0],
        "singular_values": finite(ellipsoid.singular_values())?,
        "condition": ellipsoid.condition(),
    }))
}

/// The Jacobian of `frame` in the axes of `seen_in`, shape `(6, n)`.
fn seen_jacobian(
    robot: &Robot,
    q: &JointPositions,
    frame: &Frame,
    seen_in: Option<&Frame>,
) -> Matrix6xX<f64> {
    let mut jacobian = geometric_jacobian(robot, q, frame);
    if let Some(seen_in) = seen_in {
        let poses = forward_kinematics(robot, q);
        let axes: Matrix3<f64> = poses.world_from(seen_in).rotation.matrix().transpose();
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
    let motions = independent_motions(robot, q.as_slice()).map_err(|error| loop_refusal(&error))?;
    let columns: Vec<Vector6<f64>> = motions
        .column_iter()
        .map(|motion| jacobian * motion)
        .collect();
    Ok(Matrix6xX::from_columns(&columns))
}
