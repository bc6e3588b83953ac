//! The schema of the table of a sensor: the keys that all have, and those of the kind that its `type` names.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Map, Value, json};

use super::kind::KINDS;
use super::sensor_reader::{COMMON, CommonTable, NOISELESS, SensorTable};
use crate::text::schema::in_turn;

impl JsonSchema for SensorTable {
    fn schema_name() -> Cow<'static, str> {
        "Sensor".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = CommonTable::json_schema(generator);
        let kinds = KINDS.iter().map(|kind| {
            let own = (kind.schema)(generator);
            (kind, properties(&own), own.get("required").cloned())
        });
        let kinds: Vec<_> = kinds.collect();
        let table = schema.ensure_object();
        table.insert("additionalProperties".to_owned(), false.into());
        table.insert("description".to_owned(), "A sensor.".into());
        if let Some(Value::Object(all)) = table.get_mut("properties") {
            all["type"]["enum"] = KINDS.iter().map(|kind| kind.name).collect();
            // an editor offers them before it knows which kind it is
            for (_, own, _) in &kinds {
                for (key, value) in own {
                    all.entry(key).or_insert_with(|| value.clone());
                }
            }
        }
        let cases = kinds.into_iter().map(|(kind, own, required)| {
            let common = if kind.is_noisy {
                COMMON.len()
            } else {
                NOISELESS
            };
            let common = COMMON[..common].iter().map(|key| (*key).to_owned());
            let keys = common.chain(own.into_iter().map(|(key, _)| key));
            let known: Map<String, Value> = keys.map(|key| (key, true.into())).collect();
            let mut then = json!({ "properties": known, "additionalProperties": false });
            if let Some(required) = required {
                then["required"] = required;
            }
            let is_of_kind = json!({ "properties": { "type": { "const": kind.name } } });
            (is_of_kind, then)
        });
        in_turn(&mut schema, cases);
        schema
    }
}

/// The keys of a table with their schemas.
fn properties(schema: &Schema) -> Map<String, Value> {
    let properties = schema.get("properties").and_then(Value::as_object);
    properties.cloned().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::documentation::keys;
    use crate::text::schema::schema_of;

    #[test]
    fn the_schema_has_the_keys_that_are_read() {
        let schema = schema_of::<SensorTable>("A sensor");
        let schema = schema.as_value();
        let known: Vec<&String> = schema["properties"].as_object().unwrap().keys().collect();
        let own = KINDS.iter().flat_map(|kind| (kind.own_keys)());
        let mut read: Vec<&str> = COMMON.iter().chain(own).copied().collect();
        read.sort_unstable();
        read.dedup();
        let mut known: Vec<&str> = known.into_iter().map(String::as_str).collect();
        known.sort_unstable();
        assert_eq!(known, read);
        assert_eq!(keys::<CommonTable>(), COMMON);
    }

    /// Kinds may share a key, since one schema of it stands for all.
    #[test]
    fn a_key_of_several_kinds_takes_the_same_values() {
        let mut known: Map<String, Value> = Map::new();
        let mut generator = SchemaGenerator::default();
        for kind in KINDS {
            for (key, mut value) in properties(&(kind.schema)(&mut generator)) {
                value.as_object_mut().unwrap().remove("description");
                let first = known.entry(&key).or_insert_with(|| value.clone());
                assert_eq!(*first, value, "{}: {key}", kind.name);
            }
        }
    }
}
