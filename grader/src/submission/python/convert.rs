//! Values, robots and calls between the grader and the runtime of Python.

use kinemark_python_wire as wire;

use crate::submission::controller::{
    Call, Grant, Observation, Reads, RobotFacts, SensorFacts, Value,
};

/// A value for Python: lists of numbers, and of rows of numbers, become arrays.
pub(super) fn to_wire(value: &Value) -> wire::Value {
    match value {
        Value::Nothing => wire::Value::Nothing,
        Value::Boolean(boolean) => wire::Value::Boolean(*boolean),
        Value::Number(number) => wire::Value::Number(*number),
        Value::Text(text) => wire::Value::Text(text.clone()),
        Value::Other(text) => wire::Value::Other(text.clone()),
        Value::List(elements) => match (numbers(elements), rows(elements)) {
            (Some(values), _) if !values.is_empty() => wire::Value::Numbers { rows: None, values },
            (_, Some((rows, values))) => wire::Value::Numbers {
                rows: Some(rows),
                values,
            },
            _ => wire::Value::List(elements.iter().map(to_wire).collect()),
        },
        Value::Map(entries) => wire::Value::Map(
            entries
                .iter()
                .map(|(name, value)| (name.clone(), to_wire(value)))
                .collect(),
        ),
    }
}

fn numbers(elements: &[Value]) -> Option<Vec<f64>> {
    let number = |element: &Value| match element {
        Value::Number(number) => Some(*number),
        _ => None,
    };
    elements.iter().map(number).collect()
}

/// Rows of equal length, one after the other, with their number.
fn rows(elements: &[Value]) -> Option<(u32, Vec<f64>)> {
    let row = |element: &Value| match element {
        Value::List(row) => numbers(row),
        _ => None,
    };
    let rows: Vec<Vec<f64>> = elements.iter().map(row).collect::<Option<_>>()?;
    let columns = rows.first()?.len();
    let is_matrix = columns > 0 && rows.iter().all(|row| row.len() == columns);
    is_matrix.then(|| (rows.len() as u32, rows.concat()))
}

/// A value from Python.
pub(super) fn from_wire(value: wire::Value) -> Value {
    match value {
        wire::Value::Nothing => Value::Nothing,
        wire::Value::Boolean(boolean) => Value::Boolean(boolean),
        wire::Value::Number(number) => Value::Number(number),
        wire::Value::Integer(whole) => Value::Number(whole as f64),
        wire::Value::Text(text) => Value::Text(text),
        wire::Value::Other(text) => Value::Other(text),
        wire::Value::List(elements) => Value::List(elements.into_iter().map(from_wire).collect()),
        wire::Value::Numbers { rows: None, values } => list(&values),
        wire::Value::Numbers {
            rows: Some(rows),
            values,
        } => {
            let columns = values.len() / (rows as usize).max(1);
            Value::List(match columns {
                0 => vec![Value::List(Vec::new()); rows as usize],
                columns => values.chunks(columns).map(list).collect(),
            })
        }
        wire::Value::Map(entries) => Value::Map(
            entries
                .into_iter()
                .map(|(name, value)| (name, from_wire(value)))
                .collect(),
        ),
    }
}

fn list(values: &[f64]) -> Value {
    Value::List(values.iter().copied().map(Value::Number).collect())
}

/// The object `robot`.
pub(super) fn robot(facts: &RobotFacts, granted: &[Grant]) -> wire::Robot {
    let vector = |values: &[f64]| wire::Value::Numbers {
        rows: None,
        values: values.to_vec(),
    };
    let names = facts.joint_names.iter().cloned().map(wire::Value::Text);
    let mut fields = vec![
        ("name".to_owned(), wire::Value::Text(facts.name.clone())),
        (
            "joints".to_owned(),
            wire::Value::Integer(facts.joint_names.len() as i64),
        ),
        ("joint_names".to_owned(), wire::Value::List(names.collect())),
        ("lower".to_owned(), vector(&facts.lower)),
        ("upper".to_owned(), vector(&facts.upper)),
        ("effort".to_owned(), vector(&facts.effort)),
    ];
    for (name, value) in &facts.dimensions {
        fields.push((name.clone(), to_wire(value)));
    }
    wire::Robot {
        fields,
        granted: granted
            .iter()
            .map(|grant| grant.name().to_owned())
            .collect(),
    }
}

/// The sensors by name.
pub(super) fn sensors(sensors: &[SensorFacts]) -> Vec<(String, wire::Reads)> {
    let reads = |reads| match reads {
        Reads::Truth => wire::Reads::Truth,
        Reads::Number => wire::Reads::Number,
        Reads::Vector(count) => wire::Reads::Vector(count as u32),
    };
    let sensors = sensors.iter();
    sensors
        .map(|sensor| (sensor.name.clone(), reads(sensor.reads)))
        .collect()
}

/// A call.
pub(super) fn call(call: &Call, granted: &[Grant]) -> wire::Call {
    let vector = |values: &[f64]| wire::Value::Numbers {
        rows: None,
        values: values.to_vec(),
    };
    let (facts, arguments) = match call {
        Call::Init => return wire::Call::Init,
        Call::Control(observation) => return control(observation),
        Call::ForwardKinematics { robot, q } | Call::Jacobian { robot, q } => {
            (Some(robot), vec![vector(q)])
        }
        Call::InverseKinematics { robot, position_m } => (Some(robot), vec![vector(position_m)]),
        Call::OfRobot { robot, given, .. } => {
            let given = given.iter();
            (
                Some(robot),
                given.map(|(_, value)| to_wire(value)).collect(),
            )
        }
        Call::Free { robot, given, .. } => {
            let given = Value::Map(given.clone());
            (robot.as_ref(), vec![to_wire(&given)])
        }
    };
    wire::Call::Function {
        name: call.name().to_owned(),
        robot: facts.map(|facts| robot(facts, granted)),
        arguments,
    }
}

fn control(observation: &Observation) -> wire::Call {
    let Observation {
        tick,
        time_s,
        dt_s,
        q,
        qd,
        effort,
        tcp_m,
        tcp_rotation,
        sensors,
    } = observation;
    let rotation = tcp_rotation.as_flattened();
    wire::Call::Control {
        tick: *tick,
        time_s: *time_s,
        dt_s: *dt_s,
        numbers: [q, qd, effort, &tcp_m[..], rotation, sensors].concat(),
    }
}
