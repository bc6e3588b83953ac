//! The fields of requests, read with errors that name the field.

use kinemark_sim::robot::{Frame, Robot};
use kinemark_sim::source::suggest;
use nalgebra::Vector3;
use serde_json::{Map, Value};

use super::Refusal;

/// The fields of one request that have not been read yet.
pub(super) struct Fields<'r> {
    pub(super) robot: &'r Robot,
    fields: Map<String, Value>,
    known: Vec<&'static str>,
}

impl<'r> Fields<'r> {
    pub(super) fn new(robot: &'r Robot, fields: Map<String, Value>) -> Self {
        Self {
            robot,
            fields,
            known: vec!["id", "op"],
        }
    }

    fn take(&mut self, name: &'static str) -> Option<Value> {
        self.known.push(name);
        self.fields.remove(name).filter(|value| !value.is_null())
    }

    pub(super) fn need(&mut self, name: &'static str) -> Result<Value, Refusal> {
        self.take(name)
            .ok_or_else(|| Refusal::new("missing-field", format!("`{name}` is missing")))
    }

    /// Refuses what no operation has read: a typo must not pass in silence.
    pub(super) fn finish(self) -> Result<(), Refusal> {
        match self.fields.keys().next() {
            None => Ok(()),
            Some(stranger) => Err(Refusal::new(
                "unknown-field",
                format!(
                    "`{stranger}` is no field of this operation; {}",
                    suggest(stranger, "fields", self.known.into_iter())
                ),
            )),
        }
    }

    /// One number per joint that moves; a bare number where there is one joint.
    pub(super) fn per_joint(&mut self, name: &'static str) -> Result<Vec<f64>, Refusal> {
        let value = self.need(name)?;
        let values = match &value {
            Value::Number(_) => vec![number(name, &value)?],
            _ => list(name, &value)?,
        };
        let n = self.robot.n();
        if values.len() == n {
            return Ok(values);
        }
        Err(Refusal::new(
            "wrong-length",
            format!(
                "`{name}` has {} numbers, the robot has {n} joints that move",
                values.len()
            ),
        ))
    }

    /// A number, or one per joint, spread over the joints.
    pub(super) fn spread(&mut self, name: &'static str) -> Result<Option<Vec<f64>>, Refusal> {
        let n = self.robot.n();
        match self.take(name) {
            None => Ok(None),
            Some(value @ Value::Number(_)) => Ok(Some(vec![number(name, &value)?; n])),
            Some(value) => {
                let values = list(name, &value)?;
                if values.len() == n {
                    Ok(Some(values))
                } else {
                    Err(Refusal::new(
                        "wrong-length",
                        format!("`{name}` has {} numbers, expected 1 or {n}", values.len()),
                    ))
                }
            }
        }
    }

    pub(super) fn number(&mut self, name: &'static str) -> Result<Option<f64>, Refusal> {
        self.take(name)
            .map(|value| number(name, &value))
            .transpose()
    }

    /// A positive, finite number.
    pub(super) fn positive(&mut self, name: &'static str) -> Result<f64, Refusal> {
        let value = number(name, &self.need(name)?)?;
        if value > 0.0 {
            Ok(value)
        } else {
            Err(Refusal::new(
                "out-of-range",
                format!("`{name}` must be positive, got {value}"),
            ))
        }
    }

    pub(super) fn truth(&mut self, name: &'static str) -> Result<Option<bool>, Refusal> {
        match self.take(name) {
            None => Ok(None),
            Some(Value::Bool(truth)) => Ok(Some(truth)),
            Some(other) => Err(wrong_type(name, "true or false", &other)),
        }
    }

    pub(super) fn text(&mut self, name: &'static str) -> Result<Option<String>, Refusal> {
        match self.take(name) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(other) => Err(wrong_type(name, "a text", &other)),
        }
    }

    pub(super) fn gravity_m_s2(&mut self) -> Result<Vector3<f64>, Refusal> {
        let name = "gravity_m_s2";
        match self.take(name) {
            None => Ok(kinemark_sim::dynamics::GRAVITY_M_S2),
            Some(value) => match list(name, &value)?.as_slice() {
                [x, y, z] => Ok(Vector3::new(*x, *y, *z)),
                other => Err(Refusal::new(
                    "wrong-length",
                    format!("`{name}` has {} numbers, expected 3", other.len()),
                )),
            },
        }
    }

    /// The frame asked for; the TCP where none is.
    pub(super) fn frame(&mut self) -> Result<&'r Frame, Refusal> {
        let robot = self.robot;
        match self.text("frame")? {
            None => Ok(robot.tcp()),
            Some(name) => named_frame(robot, &name),
        }
    }

    /// The frame coordinates are expressed in; `None` for the world.
    pub(super) fn seen_in(&mut self) -> Result<Option<&'r Frame>, Refusal> {
        let robot = self.robot;
        match self.text("in")? {
            None => Ok(None),
            Some(name) if name == "world" => Ok(None),
            Some(name) => named_frame(robot, &name).map(Some),
        }
    }
}

fn named_frame<'r>(robot: &'r Robot, name: &str) -> Result<&'r Frame, Refusal> {
    robot.frame(name).ok_or_else(|| {
        let known = robot.frames().iter().map(|frame| frame.name.as_str());
        Refusal::new(
            "unknown-frame",
            format!(
                "no frame is called `{name}`; {}",
                suggest(name, "frames", known)
            ),
        )
    })
}

fn wrong_type(name: &str, wanted: &str, found: &Value) -> Refusal {
    let found = match found {
        Value::Null => "null",
        Value::Bool(_) => "a truth value",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    };
    Refusal::new(
        "wrong-type",
        format!("`{name}` must be {wanted}, got {found}"),
    )
}

fn number(name: &str, value: &Value) -> Result<f64, Refusal> {
    value
        .as_f64()
        .ok_or_else(|| wrong_type(name, "a number", value))
}

fn list(name: &str, value: &Value) -> Result<Vec<f64>, Refusal> {
    let Value::Array(items) = value else {
        return Err(wrong_type(name, "a list of numbers", value));
    };
    items.iter().map(|item| number(name, item)).collect()
}
