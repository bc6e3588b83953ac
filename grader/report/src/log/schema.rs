//! Schemas of the messages. Those called `foxglove.*` are Foxglove's own, as protobuf descriptors from its crate, and as JSON schemas in
//! `well_known_schemas.json` (from `@foxglove/schemas` 2.1.0, MIT); viewers go by name and content. Flat numbers have one of their own.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use foxglove::Encode;
use serde_json::{Value, json};

/// What a channel is written with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Schema {
    pub(super) name: String,
    /// `protobuf` or `jsonschema`.
    pub(super) encoding: &'static str,
    pub(super) data: Vec<u8>,
    /// `protobuf` or `json`.
    pub(super) of_messages: &'static str,
}

static WELL_KNOWN: LazyLock<BTreeMap<String, Value>> = LazyLock::new(|| {
    let text = include_str!("well_known_schemas.json");
    serde_json::from_str(text).unwrap_or_default()
});

/// The descriptors of a message of Foxglove's.
pub(super) fn protobuf<M: Encode>() -> Schema {
    let schema = M::get_schema();
    let (name, data) = schema.map_or_else(Default::default, |schema| {
        (schema.name, schema.data.into_owned())
    });
    Schema {
        name,
        encoding: "protobuf",
        data,
        of_messages: "protobuf",
    }
}

/// The JSON schema of a message of Foxglove's.
pub(super) fn json_of<M: Encode>() -> Schema {
    let name = M::get_schema().map_or_else(String::new, |schema| schema.name);
    let schema = well_known(&name);
    in_json(name, schema)
}

/// Foxglove's JSON schema of its messages of a name; null of others.
pub(super) fn well_known(name: &str) -> Value {
    WELL_KNOWN.get(name).cloned().unwrap_or_default()
}

/// Flat numbers with what each is; one that is not finite is left out of its message.
pub(super) fn flat(title: &str, fields: &[(String, String)]) -> Schema {
    let properties: serde_json::Map<String, Value> = fields
        .iter()
        .map(|(name, what)| {
            (
                name.clone(),
                json!({ "type": "number", "description": what }),
            )
        })
        .collect();
    let schema = json!({ "title": title, "type": "object", "properties": properties });
    in_json(title.to_owned(), schema)
}

fn in_json(name: String, mut schema: Value) -> Schema {
    // whether a JSON map is sorted depends on how its crate was built; the bytes must not
    schema.sort_all_objects();
    Schema {
        name,
        encoding: "jsonschema",
        data: schema.to_string().into_bytes(),
        of_messages: "json",
    }
}

#[cfg(test)]
mod tests {
    use foxglove::messages::{FrameTransforms, JointStates, Log, PoseInFrame, SceneUpdate};

    use super::*;

    #[test]
    fn every_well_known_message_has_both_schemas() {
        fn check<M: Encode>(expected: &str) {
            let (binary, text) = (protobuf::<M>(), json_of::<M>());
            assert_eq!(
                (binary.name.as_str(), text.name.as_str()),
                (expected, expected)
            );
            let described: Value = serde_json::from_slice(&text.data).unwrap();
            assert_eq!(described["title"], json!(expected));
            let pool = prost_reflect::DescriptorPool::decode(binary.data.as_slice()).unwrap();
            let message = pool.get_message_by_name(expected).unwrap();
            // the two say the same of its fields
            let mut fields: Vec<_> = message
                .fields()
                .map(|field| field.name().to_owned())
                .collect();
            let properties = described["properties"].as_object().unwrap();
            let mut named: Vec<_> = properties.keys().cloned().collect();
            fields.sort();
            named.sort();
            assert_eq!(fields, named, "{expected}");
        }
        check::<FrameTransforms>("foxglove.FrameTransforms");
        check::<JointStates>("foxglove.JointStates");
        check::<Log>("foxglove.Log");
        check::<PoseInFrame>("foxglove.PoseInFrame");
        check::<SceneUpdate>("foxglove.SceneUpdate");
        assert_eq!(WELL_KNOWN.len(), 5);
    }
}
