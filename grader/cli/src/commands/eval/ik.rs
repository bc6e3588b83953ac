//! The operation `ik`: joint positions that bring frames to targets.

use kinemark_sim::kinematics::inverse::groups::{Group, solve_by_priority, solve_in_turn};
use kinemark_sim::kinematics::inverse::{Goal, IkAnswer, Posture};
use kinemark_sim::kinematics::{IkError, IkSettings, IkSolver, Method, Target, forward_kinematics};
use kinemark_sim::robot::{Frame, Robot};
use kinemark_sim::source::suggest;
use kinemark_sim::spatial::{Pose, pose};
use nalgebra::{Matrix3, Unit, Vector3};
use serde_json::{Map, Value, json};

use super::Refusal;
use super::operation::finite;
use super::request::Fields;
use super::state::loop_refusal;

/// A rotation's rows may be off by this: they are often printed with six digits.
const ROTATION_TOLERANCE: f64 = 1e-5;

/// Answers an `ik` request.
pub(super) fn answer(mut fields: Fields<'_>) -> Result<Value, Refusal> {
    let robot = fields.robot;
    let q0 = if fields.has("q0") {
        fields.positions("q0")?.as_slice().to_vec()
    } else {
        robot.home().to_vec()
    };
    let world_from_seen = fields
        .seen_in()?
        .map(|seen_in| still(robot, seen_in))
        .transpose()?;
    let world_from_seen = world_from_seen.unwrap_or_else(Pose::identity);
    let goals = goals(&mut fields, &world_from_seen)?;
    let settings = settings(&mut fields)?;
    let order = fields.text("order")?;
    fields.finish()?;
    let solved = match order.as_deref() {
        None | Some("together") => {
            return IkSolver::new(robot, &goals, settings)
                .and_then(|mut solver| solver.solve(&q0))
                .map_err(|error| refusal(&error))
                .and_then(|answer| told(&answer));
        }
        Some("in-turn") => {
            let groups: Vec<Group<'_>> = goals
                .iter()
                .map(|goal| Group {
                    goals: vec![*goal],
                    settings: settings.clone(),
                })
                .collect();
            solve_in_turn(robot, &groups, &q0)
        }
        Some("priority") => {
            let levels: Vec<Vec<Goal<'_>>> = goals.iter().map(|goal| vec![*goal]).collect();
            solve_by_priority(robot, &levels, &settings, &q0)
        }
        Some(other) => {
            return Err(Refusal::new(
                "out-of-range",
                format!("`order` is `together`, `in-turn` or `priority`, got `{other}`"),
            ));
        }
    };
    let solved = solved.map_err(|error| refusal(&error))?;
    let worst =
        |part: &dyn Fn(&IkAnswer) -> f64| solved.groups.iter().map(part).fold(0.0, f64::max);
    let whole = IkAnswer {
        q: solved.q.clone(),
        reached: solved.reached,
        residual_m: worst(&|answer| answer.residual_m),
        residual_rad: worst(&|answer| answer.residual_rad),
        iterations: solved.groups.iter().map(|answer| answer.iterations).sum(),
    };
    let mut answer = told(&whole)?;
    let each = solved.groups.iter().map(|answer| {
        Ok(json!({
            "reached": answer.reached,
            "residual_m": finite(&[answer.residual_m])?[0],
            "residual_rad": finite(&[answer.residual_rad])?[0],
        }))
    });
    answer["targets"] = each.collect::<Result<Value, Refusal>>()?;
    Ok(answer)
}

fn told(answer: &IkAnswer) -> Result<Value, Refusal> {
    let left = finite(&[answer.residual_m, answer.residual_rad])?;
    Ok(json!({
        "q": finite(&answer.q)?,
        "reached": answer.reached,
        "residual_m": left[0],
        "residual_rad": left[1],
        "iterations": answer.iterations,
    }))
}

/// Where a frame that stands still lies; a target seen from a moving one would move with the answer.
fn still(robot: &Robot, frame: &Frame) -> Result<Pose, Refusal> {
    if frame.attachment.body.is_some() {
        return Err(Refusal::new(
            "out-of-range",
            format!(
                "`in` names `{}`, which moves with the robot; name a frame that stands still",
                frame.name
            ),
        ));
    }
    let home = robot
        .positions(robot.home())
        .map_err(|error| Refusal::new("wrong-length", error.to_string()))?;
    Ok(forward_kinematics(robot, &home).world_from(frame))
}

/// One goal by `frame` and `target`, or several by `targets`.
fn goals<'r>(fields: &mut Fields<'r>, world_from_seen: &Pose) -> Result<Vec<Goal<'r>>, Refusal> {
    let robot = fields.robot;
    if !fields.has("targets") {
        let frame = fields.frame()?;
        let table = object("target", fields.need("target")?)?;
        let mut fields = Fields::part(robot, table);
        let target = target(&mut fields, world_from_seen)?;
        fields.finish()?;
        let weight = 1.0;
        return Ok(vec![Goal {
            frame,
            target,
            weight,
        }]);
    }
    let Value::Array(items) = fields.need("targets")? else {
        return Err(Refusal::new(
            "wrong-type",
            "`targets` must be a list of objects",
        ));
    };
    for alone in ["frame", "target"] {
        if fields.has(alone) {
            return Err(Refusal::new(
                "unknown-field",
                format!("`{alone}` stands beside `targets`; each of `targets` has its own frame"),
            ));
        }
    }
    let goal = |item: Value| {
        let mut fields = Fields::part(robot, object("targets", item)?);
        let goal = Goal {
            frame: fields.frame()?,
            target: target(&mut fields, world_from_seen)?,
            weight: fields.number("weight")?.unwrap_or(1.0),
        };
        fields.finish()?;
        Ok(goal)
    };
    items.into_iter().map(goal).collect()
}

fn object(name: &str, value: Value) -> Result<Map<String, Value>, Refusal> {
    match value {
        Value::Object(table) => Ok(table),
        _ => Err(Refusal::new(
            "wrong-type",
            format!("`{name}` must hold objects such as {{\"position_m\": [0, 0, 1]}}"),
        )),
    }
}

fn target(fields: &mut Fields<'_>, world_from_seen: &Pose) -> Result<Target, Refusal> {
    let position_m = fields.triple("position_m")?;
    let position_m = position_m.map(|p| world_from_seen.transform_point(&p.into()).coords);
    let rotation = fields.rotation("rotation")?;
    let rotation = rotation.map(|r| world_from_seen.rotation.matrix() * r);
    let axis = fields.triple("axis")?;
    let direction = fields.triple("direction")?;
    let refuse = |code, message: &str| Err(Refusal::new(code, message));
    match (position_m, rotation, axis, direction) {
        (Some(position_m), None, None, None) => Ok(Target::Position(position_m)),
        (Some(position_m), Some(rotation), None, None) => {
            Ok(Target::Pose(pose(rotation, position_m)))
        }
        (None, Some(rotation), None, None) => Ok(Target::Rotation(rotation)),
        (Some(position_m), None, Some(axis), Some(direction)) => {
            let unit = |v: Vector3<f64>| Unit::try_new(v, f64::MIN_POSITIVE);
            match (unit(axis), unit(world_from_seen.rotation * direction)) {
                (Some(axis_in_frame), Some(direction_in_world)) => Ok(Target::Axis {
                    position_m,
                    axis_in_frame,
                    direction_in_world,
                }),
                _ => refuse("out-of-range", "`axis` and `direction` must not be zero"),
            }
        }
        (None, None, None, None) => refuse(
            "missing-field",
            "a target has `position_m`, `rotation`, both, or `position_m` with `axis` and `direction`",
        ),
        _ => refuse(
            "missing-field",
            "`axis`, `direction` and `position_m` belong together, without `rotation`",
        ),
    }
}

fn settings(fields: &mut Fields<'_>) -> Result<IkSettings, Refusal> {
    let mut settings = IkSettings::default();
    let damping = fields.number("damping")?;
    let method = fields.text("method")?;
    settings.method = match method.as_deref() {
        None | Some("auto") => Method::Auto,
        Some("pseudo-inverse") => Method::PseudoInverse,
        Some("damped-least-squares") => Method::DampedLeastSquares { damping },
        Some("fallback") => Method::Fallback { damping },
        Some(other) => {
            let known = ["auto", "pseudo-inverse", "damped-least-squares", "fallback"];
            let known = suggest(other, "methods", known.into_iter());
            return Err(Refusal::new(
                "out-of-range",
                format!("no method `{other}`; {known}"),
            ));
        }
    };
    if damping.is_some() && matches!(settings.method, Method::Auto | Method::PseudoInverse) {
        return Err(Refusal::new(
            "out-of-range",
            "`damping` is for the methods `damped-least-squares` and `fallback`",
        ));
    }
    if let Some(steps) = fields.whole("max_iterations")? {
        settings.max_iterations = steps;
    }
    if let Some(restarts) = fields.whole("restarts")? {
        settings.restarts = restarts;
    }
    if let Some(tolerance) = fields.number("tolerance_m")? {
        settings.tolerance_m = tolerance;
    }
    if let Some(tolerance) = fields.number("tolerance_rad")? {
        settings.tolerance_rad = tolerance;
    }
    if let Some(respect) = fields.truth("respect_limits")? {
        settings.respect_limits = respect;
    }
    settings.chain = chain(fields)?;
    if fields.has("posture") {
        let q = fields.positions("posture")?.as_slice().to_vec();
        let gain = fields.number("posture_gain")?.unwrap_or(DEFAULT_GAIN);
        settings.posture = Some(Posture { q, gain });
    }
    Ok(settings)
}

/// A posture is approached by this fraction of the way in a step, if the request does not say.
const DEFAULT_GAIN: f64 = 0.5;

/// The entries of `q` of the joints that may move.
fn chain(fields: &mut Fields<'_>) -> Result<Option<Vec<usize>>, Refusal> {
    let robot = fields.robot;
    let Some(names) = fields.texts("chain")? else {
        return Ok(None);
    };
    let place = |name: &String| {
        robot
            .moving_joints()
            .position(|joint| joint.name == *name)
            .ok_or_else(|| {
                let known = robot.moving_joints().map(|joint| joint.name.as_str());
                let known = suggest(name, "joints that move", known);
                Refusal::new(
                    "unknown-joint",
                    format!("no joint that moves is called `{name}`; {known}"),
                )
            })
    };
    names
        .iter()
        .map(place)
        .collect::<Result<Vec<usize>, Refusal>>()
        .map(Some)
}

fn refusal(error: &IkError) -> Refusal {
    let code = match error {
        IkError::JointCount { .. } => "wrong-length",
        IkError::NoSuchJoint { .. } => "unknown-joint",
        IkError::Value { .. } => "out-of-range",
        IkError::NoGoal => "missing-field",
        IkError::Budget { .. } => "too-large",
        IkError::Loops(error) => return loop_refusal(error),
    };
    Refusal::new(code, error.to_string())
}

/// Three rows as a matrix, if they are those of a rotation.
pub(super) fn rotation_of(name: &str, rows: &[Vec<f64>]) -> Result<Matrix3<f64>, Refusal> {
    let [x, y, z] = rows else {
        return Err(Refusal::new(
            "wrong-length",
            format!("`{name}` has {} rows, expected 3", rows.len()),
        ));
    };
    if let Some(row) = [x, y, z].into_iter().find(|row| row.len() != 3) {
        return Err(Refusal::new(
            "wrong-length",
            format!("a row of `{name}` has {} numbers, expected 3", row.len()),
        ));
    }
    let r = Matrix3::from_fn(|i, j| rows[i][j]);
    let off = (r * r.transpose() - Matrix3::identity()).amax();
    if off <= ROTATION_TOLERANCE && r.determinant() > 0.0 {
        return Ok(r);
    }
    Err(Refusal::new(
        "out-of-range",
        format!(
            "`{name}` is no rotation: its rows are not of length 1, at right angles and right-handed"
        ),
    ))
}
