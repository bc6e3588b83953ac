//! Conversion of values between the grader and the script language.

use rhai::{Array, Dynamic, Map};

use super::budget::Meter;
use super::mistake::Problem;
use super::vector::{Matrix, Vector};
use super::words::kind;
use crate::submission::controller::{
    Budget, MEASURED, Observation, Opening, Reads, RobotFacts, SensorFacts, Value,
};

/// The return value of a function, with at most a list's budget of values in all.
pub(super) fn to_value(meter: &Meter, value: &Dynamic) -> Result<Value, Problem> {
    let mut taken = 0;
    convert(meter, value, &mut taken, 0)
}

/// Lists inside each other that are taken apart: no answer that a check reads is as deep.
const DEEPEST: usize = 32;
/// Characters of a text in an answer: none of them counts for a check.
const LONGEST_TEXT: usize = 256;

fn convert(
    meter: &Meter,
    value: &Dynamic,
    taken: &mut usize,
    depth: usize,
) -> Result<Value, Problem> {
    if depth > DEEPEST {
        return Ok(Value::Other(format!("{} in {DEEPEST} others", kind(value))));
    }
    *taken += 1;
    meter.within(Budget::ListSize, taken.saturating_sub(1))?;
    Ok(if let Ok(number) = value.as_float() {
        Value::Number(number)
    } else if let Ok(whole) = value.as_int() {
        Value::Number(whole as f64)
    } else if let Some(vector) = value.read_lock::<Vector>() {
        *taken += vector.len();
        meter.within(Budget::ListSize, taken.saturating_sub(1))?;
        numbers(vector.elements())
    } else if let Some(matrix) = value.read_lock::<Matrix>() {
        *taken += matrix.rows() * matrix.columns();
        meter.within(Budget::ListSize, taken.saturating_sub(1))?;
        Value::List(
            (0..matrix.rows())
                .map(|i| numbers(matrix.row(i).elements()))
                .collect(),
        )
    } else if let Ok(list) = value.as_array_ref() {
        let list: &Array = &list;
        Value::List(
            list.iter()
                .map(|element| convert(meter, element, taken, depth + 1))
                .collect::<Result<_, _>>()?,
        )
    } else if let Ok(map) = value.as_map_ref() {
        let map: &Map = &map;
        Value::Map(
            map.iter()
                .map(|(key, element)| {
                    Ok((key.to_string(), convert(meter, element, taken, depth + 1)?))
                })
                .collect::<Result<_, _>>()?,
        )
    } else if let Ok(text) = value.as_immutable_string_ref() {
        Value::Text(text.chars().take(LONGEST_TEXT).collect())
    } else if let Ok(boolean) = value.as_bool() {
        Value::Boolean(boolean)
    } else if let Ok(character) = value.as_char() {
        Value::Text(character.to_string())
    } else if value.is_unit() {
        Value::Nothing
    } else {
        Value::Other(kind(value).to_owned())
    })
}

fn numbers(elements: &[f64]) -> Value {
    Value::List(elements.iter().map(|x| Value::Number(*x)).collect())
}

/// Whether all numbers of a value are finite.
pub(super) fn is_finite(value: &Value) -> bool {
    match value {
        Value::Number(number) => number.is_finite(),
        Value::List(elements) => elements.iter().all(is_finite),
        Value::Map(entries) => entries.iter().all(|(_, value)| is_finite(value)),
        Value::Nothing | Value::Boolean(_) | Value::Text(_) | Value::Other(_) => true,
    }
}

/// A value from the grader; a list of numbers becomes a vector.
pub(super) fn to_dynamic(value: &Value) -> Dynamic {
    match value {
        Value::Nothing => Dynamic::UNIT,
        Value::Boolean(boolean) => (*boolean).into(),
        Value::Number(number) => (*number).into(),
        Value::Text(text) | Value::Other(text) => text.as_str().into(),
        Value::List(elements) => {
            let numbers: Option<Vec<f64>> = elements
                .iter()
                .map(|element| match element {
                    Value::Number(number) => Some(*number),
                    _ => None,
                })
                .collect();
            match numbers {
                Some(numbers) if !numbers.is_empty() => Dynamic::from(Vector::new(&numbers)),
                _ => Dynamic::from_array(elements.iter().map(to_dynamic).collect()),
            }
        }
        Value::Map(entries) => Dynamic::from_map(
            entries
                .iter()
                .map(|(key, value)| (key.as_str().into(), to_dynamic(value)))
                .collect(),
        ),
    }
}

/// The map `robot`.
pub(super) fn robot(facts: &RobotFacts) -> Dynamic {
    let vector = |elements: &[f64]| Dynamic::from(Vector::new(elements));
    let mut map: Map = facts
        .dimensions
        .iter()
        .map(|(name, value)| (name.as_str().into(), to_dynamic(value)))
        .collect();
    // inserted after the dimensions, so that no dimension can hide them
    let names: Array = facts
        .joint_names
        .iter()
        .map(|name| name.as_str().into())
        .collect();
    map.insert("name".into(), facts.name.as_str().into());
    map.insert("joints".into(), Dynamic::from_int(names.len() as rhai::INT));
    map.insert("joint_names".into(), Dynamic::from_array(names));
    map.insert("lower".into(), vector(&facts.lower));
    map.insert("upper".into(), vector(&facts.upper));
    map.insert("effort".into(), vector(&facts.effort));
    Dynamic::from_map(map)
}

/// The map `observation` before the first tick, with the values that are constant in a task.
pub(super) fn observation_template(opening: &Opening) -> Map {
    let mut map = Map::new();
    map.insert("task".into(), opening.task.as_str().into());
    map.insert("target".into(), to_dynamic(&opening.target));
    map.insert("sensors".into(), Dynamic::from_map(Map::new()));
    for key in MEASURED {
        map.insert(key.into(), Dynamic::UNIT);
    }
    map
}

/// The map `observation`.
pub(super) fn observation(
    template: &Map,
    sensors: &[SensorFacts],
    observation: &Observation,
) -> Dynamic {
    let mut map = template.clone();
    let vector = |elements: &[f64]| Dynamic::from(Vector::new(elements));
    for (key, value) in &mut map {
        *value = match key.as_str() {
            "tick" => Dynamic::from_int(observation.tick as rhai::INT),
            "time" => observation.time_s.into(),
            "dt" => observation.dt_s.into(),
            "q" => vector(&observation.q),
            "qd" => vector(&observation.qd),
            "effort" => vector(&observation.effort),
            "tcp" => vector(&observation.tcp_m),
            "tcp_rotation" => {
                let rotation = &observation.tcp_rotation;
                Dynamic::from(Matrix::from_fn(3, 3, |i, j| rotation[i][j]))
            }
            "sensors" => readings(sensors, &observation.sensors),
            _ => continue,
        };
    }
    Dynamic::from_map(map)
}

/// The map `observation.sensors`.
fn readings(sensors: &[SensorFacts], values: &[f64]) -> Dynamic {
    let mut rest = values;
    let mut map = Map::new();
    for sensor in sensors {
        let channels = match sensor.reads {
            Reads::Truth | Reads::Number => 1,
            Reads::Vector(channels) => channels,
        };
        let Some((read, after)) = rest.split_at_checked(channels) else {
            break;
        };
        rest = after;
        let value = match sensor.reads {
            Reads::Truth => (read[0] != 0.0).into(),
            Reads::Number => read[0].into(),
            Reads::Vector(_) => Dynamic::from(Vector::new(read)),
        };
        map.insert(sensor.name.as_str().into(), value);
    }
    Dynamic::from_map(map)
}
