//! A message in protobuf as a JSON value, by the descriptors that its log brings: the same columns as of the message written as JSON.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use prost_reflect::{
    DescriptorPool, DynamicMessage, MapKey, MessageDescriptor, ReflectMessage as _, Value,
};
use serde_json::Number;

use super::json::{Json, MOST_VALUES};

/// A longer message is not unpacked: a byte of it may become a hundred.
const MOST_MESSAGE_BYTES: usize = 8 << 20;

/// The message `name` of a set of file descriptors, as a schema of a log is one.
///
/// # Errors
/// In words: bytes that are no descriptors, and a name that they do not have.
pub(super) fn described(name: &str, schema: &[u8]) -> Result<MessageDescriptor, String> {
    let pool = DescriptorPool::decode(schema).map_err(|error| error.to_string())?;
    let message = pool.get_message_by_name(name);
    message.ok_or_else(|| format!("its schema has no message `{name}`"))
}

/// A message as a value, its members in the order of their descriptors. What has no presence of its own is there even where it is zero.
///
/// # Errors
/// In words: bytes that are no such message, and more of them, or of values, than makes sense.
pub(super) fn parse(message: &MessageDescriptor, bytes: &[u8]) -> Result<Json, String> {
    if bytes.len() > MOST_MESSAGE_BYTES {
        return Err(format!(
            "it has {} bytes, at most {MOST_MESSAGE_BYTES} are read",
            bytes.len()
        ));
    }
    decoded(message, bytes, MOST_VALUES)
}

/// A message of our own, of any size.
///
/// # Errors
/// In words, where the descriptors are of another message.
pub(super) fn of_own(message: &MessageDescriptor, bytes: &[u8]) -> Result<Json, String> {
    decoded(message, bytes, usize::MAX)
}

fn decoded(message: &MessageDescriptor, bytes: &[u8], left: usize) -> Result<Json, String> {
    let message = DynamicMessage::decode(message.clone(), bytes);
    let message = message.map_err(|error| error.to_string())?;
    Reading { left }.message(&message)
}

/// How many values a message may still have.
struct Reading {
    left: usize,
}

impl Reading {
    fn message(&mut self, message: &DynamicMessage) -> Result<Json, String> {
        let descriptor = message.descriptor();
        let is_time = matches!(
            descriptor.full_name(),
            "google.protobuf.Timestamp" | "google.protobuf.Duration"
        );
        let mut members = Vec::new();
        for field in descriptor.fields() {
            if field.supports_presence() && !message.has_field(&field) {
                continue;
            }
            let value = self.value(&message.get_field(&field))?;
            // as the schemas of the same name in JSON call them
            let name = match (is_time, field.name()) {
                (true, "seconds") => "sec",
                (true, "nanos") => "nsec",
                (_, name) => name,
            };
            members.push((name.to_owned(), value));
        }
        Ok(Json::Object(members))
    }

    fn value(&mut self, value: &Value) -> Result<Json, String> {
        let left = self.left.checked_sub(1);
        self.left = left.ok_or_else(|| format!("it has more than {MOST_VALUES} values"))?;
        let value = match value {
            Value::Bool(value) => Json::Bool(*value),
            Value::I32(value) | Value::EnumNumber(value) => Json::Number((*value).into()),
            Value::I64(value) => Json::Number((*value).into()),
            Value::U32(value) => Json::Number((*value).into()),
            Value::U64(value) => Json::Number((*value).into()),
            Value::F32(value) => number(f64::from(*value)),
            Value::F64(value) => number(*value),
            Value::String(text) => Json::Text(text.clone()),
            Value::Bytes(bytes) => Json::Text(STANDARD.encode(bytes)),
            Value::Message(message) => self.message(message)?,
            Value::List(items) => {
                let items = items.iter().map(|item| self.value(item));
                Json::List(items.collect::<Result<_, _>>()?)
            }
            Value::Map(entries) => {
                let mut entries: Vec<_> = entries.iter().collect();
                entries.sort_by(|one, other| one.0.cmp(other.0));
                let entries = entries.into_iter().map(|(key, value)| {
                    let key = match key {
                        MapKey::Bool(key) => key.to_string(),
                        MapKey::I32(key) => key.to_string(),
                        MapKey::I64(key) => key.to_string(),
                        MapKey::U32(key) => key.to_string(),
                        MapKey::U64(key) => key.to_string(),
                        MapKey::String(key) => key.clone(),
                    };
                    Ok((key, self.value(value)?))
                });
                Json::Object(entries.collect::<Result<_, String>>()?)
            }
        };
        Ok(value)
    }
}

/// A number; JSON has none that is not finite.
fn number(value: f64) -> Json {
    Number::from_f64(value).map_or(Json::Null, Json::Number)
}

#[cfg(test)]
mod tests {
    use foxglove::Encode;
    use foxglove::messages::{JointState, JointStates, Log, Timestamp};

    use super::*;

    fn parsed<M: Encode>(message: &M) -> Json {
        let mut bytes = Vec::new();
        message.encode(&mut bytes).unwrap();
        let schema = M::get_schema().unwrap();
        parse(&described(&schema.name, &schema.data).unwrap(), &bytes).unwrap()
    }

    #[test]
    fn a_message_has_the_members_of_its_json_form() {
        let joint = JointState {
            name: "elbow".to_owned(),
            position: Some(0.0),
            velocity: Some(f64::NAN),
            acceleration: None,
            effort: Some(-1.5),
        };
        let states = JointStates {
            timestamp: Some(Timestamp::new(3, 7)),
            joints: vec![joint],
        };
        let expected = r#"{"timestamp": {"sec": 3, "nsec": 7},
            "joints": [{"name": "elbow", "position": 0.0, "velocity": null, "effort": -1.5}]}"#;
        assert_eq!(parsed(&states), Json::parse(expected.as_bytes()).unwrap());
        // zeros that are not on the wire are there
        let log = Log {
            message: "x".to_owned(),
            ..Log::default()
        };
        let expected = r#"{"level": 0, "message": "x", "name": "", "file": "", "line": 0}"#;
        assert_eq!(parsed(&log), Json::parse(expected.as_bytes()).unwrap());
    }

    #[test]
    fn what_is_no_such_message_is_refused_in_words() {
        let schema = Log::get_schema().unwrap();
        let log = described("foxglove.Log", &schema.data).unwrap();
        assert!(
            described("foxglove.Lob", &schema.data)
                .unwrap_err()
                .contains("`foxglove.Lob`")
        );
        assert!(described("foxglove.Log", b"no descriptors").is_err());
        assert!(parse(&log, &[0x0a, 0x7f]).is_err());
        let long = vec![0; MOST_MESSAGE_BYTES + 1];
        assert!(parse(&log, &long).unwrap_err().contains("at most"));
        // many values in few bytes
        let line = foxglove::messages::SceneUpdate::get_schema().unwrap();
        let line = described("foxglove.LinePrimitive", &line.data).unwrap();
        // field 8, packed numbers of four bytes
        let mut packed = vec![0x42];
        let bytes = 4 * (MOST_VALUES + 1);
        packed.extend([bytes, bytes >> 7].map(|part| (part & 0x7f) as u8 | 0x80));
        packed.push((bytes >> 14) as u8);
        packed.resize(packed.len() + bytes, 0);
        assert!(parse(&line, &packed).unwrap_err().contains("values"));
    }
}
