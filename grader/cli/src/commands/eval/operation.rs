//! The operations: each reads its fields, asks the simulator, and makes its answer.

use kinemark_sim::dynamics;
use kinemark_sim::kinematics::{forward_kinematics, geometric_jacobian};
use kinemark_sim::robot::{Joint, Robot};
use kinemark_sim::source::suggest;
use nalgebra::Matrix3;
use serde_json::{Map, Value, json};

use super::request::Fields;
use super::{Refusal, simulate};

const OPERATIONS: [&str; 9] = [
    "info", "fk", "jacobian", "rnea", "bias", "crba", "aba", "energy", "simulate",
];

/// Answers one request.
pub(super) fn answer(
    robot: &Robot,
    mut request: Map<String, Value>,
) -> Result<Map<String, Value>, Refusal> {
    let op = match request.remove("op") {
        Some(Value::String(op)) => op,
        Some(_) => return Err(Refusal::new("wrong-type", "`op` must be a text")),
        None => return Err(Refusal::new("missing-field", "`op` is missing")),
    };
    let fields = Fields::new(robot, request);
    let answer = match op.as_str() {
        "info" => info(fields),
        "fk" => fk(fields),
        "jacobian" => jacobian(fields),
        "rnea" => rnea(fields),
        "bias" => bias(fields),
        "crba" => crba(fields),
        "aba" => aba(fields),
        "energy" => energy(fields),
        "simulate" => simulate::answer(fields),
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
    Ok(json!({
        "name": robot.name(),
        "joints": joints,
        "frames": frames,
        "mass_kg": robot.mass_kg(),
    }))
}

fn fk(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = dynamic(robot.positions(&fields.per_joint("q")?))?;
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
    let q = dynamic(robot.positions(&fields.per_joint("q")?))?;
    let (frame, seen_in) = (fields.frame()?, fields.seen_in()?);
    fields.finish()?;
    let mut jacobian = geometric_jacobian(robot, &q, frame);
    if let Some(seen_in) = seen_in {
        let poses = forward_kinematics(robot, &q);
        let axes: Matrix3<f64> = poses.world_from(seen_in).rotation.matrix().transpose();
        for mut column in jacobian.column_iter_mut() {
            let linear = axes * column.fixed_rows::<3>(0);
            let angular = axes * column.fixed_rows::<3>(3);
            column.fixed_rows_mut::<3>(0).copy_from(&linear);
            column.fixed_rows_mut::<3>(3).copy_from(&angular);
        }
    }
    let rows = rows(jacobian.row_iter().map(|row| row.iter().copied().collect()))?;
    Ok(json!({ "jacobian": rows }))
}

fn rnea(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = dynamic(robot.positions(&fields.per_joint("q")?))?;
    let qd = dynamic(robot.velocities(&fields.per_joint("qd")?))?;
    let qdd = dynamic(robot.accelerations(&fields.per_joint("qdd")?))?;
    let gravity = fields.gravity_m_s2()?;
    fields.finish()?;
    let effort = dynamics::inverse_dynamics(robot, &gravity, &q, &qd, &qdd);
    Ok(json!({ "effort": finite(effort.as_slice())? }))
}

fn bias(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = dynamic(robot.positions(&fields.per_joint("q")?))?;
    let qd = dynamic(robot.velocities(&fields.per_joint("qd")?))?;
    let gravity = fields.gravity_m_s2()?;
    fields.finish()?;
    let effort = dynamics::bias_effort(robot, &gravity, &q, &qd);
    Ok(json!({ "effort": finite(effort.as_slice())? }))
}

fn crba(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = dynamic(robot.positions(&fields.per_joint("q")?))?;
    // gravity makes no difference here, but may stand in a request like any other
    fields.gravity_m_s2()?;
    fields.finish()?;
    let matrix = dynamics::mass_matrix(robot, &q);
    let rows = rows(matrix.row_iter().map(|row| row.iter().copied().collect()))?;
    Ok(json!({ "mass_matrix": rows }))
}

fn aba(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = dynamic(robot.positions(&fields.per_joint("q")?))?;
    let qd = dynamic(robot.velocities(&fields.per_joint("qd")?))?;
    let effort = dynamic(robot.efforts(&fields.per_joint("effort")?))?;
    let gravity = fields.gravity_m_s2()?;
    fields.finish()?;
    let qdd = dynamics::forward_dynamics(robot, &gravity, &q, &qd, &effort)
        .map_err(|error| Refusal::new("singular", error.to_string()))?;
    Ok(json!({ "qdd": finite(qdd.as_slice())? }))
}

fn energy(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q = dynamic(robot.positions(&fields.per_joint("q")?))?;
    let qd = dynamic(robot.velocities(&fields.per_joint("qd")?))?;
    let gravity = fields.gravity_m_s2()?;
    fields.finish()?;
    let energy = dynamics::energy(robot, &gravity, &q, &qd);
    let values = finite(&[energy.kinetic_j, energy.potential_j])?;
    Ok(json!({ "kinetic_j": values[0], "potential_j": values[1] }))
}

/// The length has been checked with words of its own; this keeps the types honest.
fn dynamic<T>(
    vector: Result<T, kinemark_sim::robot::model::JointCountError>,
) -> Result<T, Refusal> {
    vector.map_err(|error| Refusal::new("wrong-length", error.to_string()))
}
