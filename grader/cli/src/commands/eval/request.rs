//! The fields of requests, read with errors that name the field.

use kinemark_sim::kinematics::manipulability::{ANGULAR, LINEAR, TWIST};
use kinemark_sim::robot::{Frame, Robot};
use kinemark_sim::source::{nearest, suggest};
use nalgebra::{Matrix3, Vector3};
use serde_json::{Map, Value};

use super::Refusal;
use super::ik::rotation_of;

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

    /// The fields of an object inside a request.
    pub(super) fn part(robot: &'r Robot, fields: Map<String, Value>) -> Self {
        Self {
            robot,
            fields,
            known: Vec::new(),
        }
    }

    /// Whether a field stands there and is not `null`.
    pub(super) fn has(&self, name: &str) -> bool {
        self.fields.get(name).is_some_and(|value| !value.is_null())
    }

    fn take(&mut self, name: &'static str) -> Option<Value> {
        self.known.push(name);
        self.fields.remove(name).filter(|value| !value.is_null())
    }

    pub(super) fn need(&mut self, name: &'static str) -> Result<Value, Refusal> {
        let taken = self.take(name);
        taken.ok_or_else(|| {
            // one that nothing has read yet may be meant
            let others = self.fields.keys().map(String::as_str);
            let meant = nearest(name, others)
                .map_or_else(String::new, |near| format!("; is it meant by `{near}`?"));
            Refusal::new("missing-field", format!("`{name}` is missing{meant}"))
        })
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

    /// Numbers; a bare one counts as a list of one.
    pub(super) fn numbers(&mut self, name: &'static str) -> Result<Vec<f64>, Refusal> {
        let value = self.need(name)?;
        match &value {
            Value::Number(_) => Ok(vec![number(name, &value)?]),
            _ => list(name, &value),
        }
    }

    /// A number, or one per joint, spread over the joints; zeros at dependent joints where there is one per independent joint.
    pub(super) fn spread(&mut self, name: &'static str) -> Result<Option<Vec<f64>>, Refusal> {
        let n = self.robot.n();
        match self.take(name) {
            None => Ok(None),
            Some(value @ Value::Number(_)) => Ok(Some(vec![number(name, &value)?; n])),
            Some(value) => {
                let values = list(name, &value)?;
                let k = self.robot.independent().len();
                if values.len() == n {
                    Ok(Some(values))
                } else if values.len() == k {
                    Ok(Some(self.over_all(&values)))
                } else {
                    let or = if k < n {
                        format!(", {k}")
                    } else {
                        String::new()
                    };
                    Err(Refusal::new(
                        "wrong-length",
                        format!(
                            "`{name}` has {} numbers, expected 1{or} or {n}",
                            values.len()
                        ),
                    ))
                }
            }
        }
    }

    /// A number for all of `n` axes, or one for each.
    pub(super) fn per_axis(
        &mut self,
        name: &'static str,
        n: usize,
    ) -> Result<Option<Vec<f64>>, Refusal> {
        match self.take(name) {
            None => Ok(None),
            Some(value @ Value::Number(_)) => Ok(Some(vec![number(name, &value)?; n])),
            Some(value) => {
                let values = list(name, &value)?;
                if values.len() == n {
                    return Ok(Some(values));
                }
                let found = values.len();
                let message = format!("`{name}` has {found} numbers, expected 1 or {n}");
                Err(Refusal::new("wrong-length", message))
            }
        }
    }

    /// A list of lists of numbers.
    pub(super) fn lists(&mut self, name: &'static str) -> Result<Vec<Vec<f64>>, Refusal> {
        match self.need(name)? {
            Value::Array(items) => items.iter().map(|item| list(name, item)).collect(),
            other => Err(wrong_type(name, "a list of lists of numbers", &other)),
        }
    }

    /// The fields of an object inside the request.
    pub(super) fn object(&mut self, name: &'static str) -> Result<Fields<'r>, Refusal> {
        match self.need(name)? {
            Value::Object(fields) => Ok(Fields::part(self.robot, fields)),
            other => Err(wrong_type(name, "an object", &other)),
        }
    }

    pub(super) fn number(&mut self, name: &'static str) -> Result<Option<f64>, Refusal> {
        self.take(name)
            .map(|value| number(name, &value))
            .transpose()
    }

    /// A whole number, zero or more.
    pub(super) fn whole(&mut self, name: &'static str) -> Result<Option<usize>, Refusal> {
        match self.take(name) {
            None => Ok(None),
            Some(value) => match value.as_u64().and_then(|n| usize::try_from(n).ok()) {
                Some(n) => Ok(Some(n)),
                None => Err(Refusal::new(
                    "out-of-range",
                    format!("`{name}` must be a whole number, zero or more, got {value}"),
                )),
            },
        }
    }

    /// Three numbers.
    pub(super) fn triple(&mut self, name: &'static str) -> Result<Option<Vector3<f64>>, Refusal> {
        match self.take(name) {
            None => Ok(None),
            Some(value) => match list(name, &value)?.as_slice() {
                [x, y, z] => Ok(Some(Vector3::new(*x, *y, *z))),
                other => Err(Refusal::new(
                    "wrong-length",
                    format!("`{name}` has {} numbers, expected 3", other.len()),
                )),
            },
        }
    }

    /// A rotation as three rows, as `fk` answers it.
    pub(super) fn rotation(&mut self, name: &'static str) -> Result<Option<Matrix3<f64>>, Refusal> {
        match self.take(name) {
            None => Ok(None),
            Some(Value::Array(rows)) => {
                let rows: Result<Vec<Vec<f64>>, Refusal> =
                    rows.iter().map(|row| list(name, row)).collect();
                rotation_of(name, &rows?).map(Some)
            }
            Some(other) => Err(wrong_type(name, "three rows of three numbers", &other)),
        }
    }

    /// A list of texts.
    pub(super) fn texts(&mut self, name: &'static str) -> Result<Option<Vec<String>>, Refusal> {
        let Some(value) = self.take(name) else {
            return Ok(None);
        };
        let texts = value.as_array().and_then(|items| {
            let texts = items.iter().map(|item| Some(item.as_str()?.to_owned()));
            texts.collect::<Option<Vec<String>>>()
        });
        texts
            .map(Some)
            .ok_or_else(|| wrong_type(name, "a list of texts", &value))
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
        let given = self.triple("gravity_m_s2")?;
        Ok(given.unwrap_or(kinemark_sim::dynamics::GRAVITY_M_S2))
    }

    /// The rows of a Jacobian: a name for three or six of them, or their numbers from zero. All without the field.
    pub(super) fn rows(&mut self) -> Result<Vec<usize>, Refusal> {
        let name = "rows";
        let refuse = |found: &str| {
            Err(Refusal::new(
                "out-of-range",
                format!(
                    "`{name}` is `all`, `linear`, `angular` or a list of rows 0 to 5, got {found}"
                ),
            ))
        };
        match self.take(name) {
            None => Ok(TWIST.to_vec()),
            Some(Value::String(text)) => match text.as_str() {
                "all" => Ok(TWIST.to_vec()),
                "linear" => Ok(LINEAR.to_vec()),
                "angular" => Ok(ANGULAR.to_vec()),
                other => refuse(&format!("`{other}`")),
            },
            Some(Value::Array(items)) => {
                let mut rows = Vec::new();
                for item in &items {
                    match item.as_u64() {
                        Some(row @ 0..=5) if !rows.contains(&(row as usize)) => {
                            rows.push(row as usize)
                        }
                        _ => return refuse(&item.to_string()),
                    }
                }
                if rows.is_empty() {
                    refuse("[]")
                } else {
                    Ok(rows)
                }
            }
            Some(other) => Err(wrong_type(name, "a text or a list of numbers", &other)),
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
