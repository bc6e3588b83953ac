//! The schema of the table of a check, which is read by hand: the keys that every check has, and exactly one kind.

use std::borrow::Cow;

use kinemark_sim::text::schema::{exactly_one, in_turn};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Map, Value, json};

use super::kind::KINDS;
use super::registry::{CheckTable, Kind};

/// What each kind measures, by its name: the first paragraph of its file's first comment.
const SUMMARIES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/kind_summaries.rs"));

/// The keys that every check has.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "a schema reads no values")]
struct CommonKeys {
    /// Its name: lower-case letters, digits and `-`.
    name: String,
    /// One line, which students read.
    title: String,
    /// What full marks are worth, more than 0 and at most 1000.
    points: f64,
    /// Names of earlier checks of the same task: it is not judged until all of them have earned something.
    needs: Option<Vec<String>>,
    /// A question, then the steps that `kinemark hint` unfolds, the last of which is the remedy.
    hints: Option<Vec<String>>,
}

impl JsonSchema for CheckTable {
    fn schema_name() -> Cow<'static, str> {
        "Check".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = CommonKeys::json_schema(generator);
        if let Some(Value::Object(properties)) = schema.get_mut("properties") {
            for kind in KINDS {
                let mut table = (kind.in_schema)(generator);
                let summary = SUMMARIES.iter().find(|(name, _)| *name == kind.name);
                let (_, summary) = summary.copied().unwrap_or_default();
                let (first, rest) = summary.split_at(summary.len().min(1));
                let summary = format!("{}{rest}", first.to_uppercase());
                table.insert("description".to_owned(), summary.into());
                properties.insert(kind.name.to_owned(), table.to_value());
            }
        }
        let names: Vec<&str> = KINDS.iter().map(|kind| kind.name).collect();
        exactly_one(&names)(&mut schema);
        schema
    }
}

/// Refuses, in the schema of a task, checks of kinds that cannot judge it.
pub(crate) fn only_kinds_that_fit(task: &mut Schema) {
    let known = KINDS.iter().filter_map(|kind| kind.function);
    let mut known: Vec<&str> = known.collect();
    known.sort_unstable();
    known.dedup();
    let moves = (
        json!({ "required": ["motion"] }),
        without(|kind| kind.of_motion),
    );
    let of_function =
        |call: Value| json!({ "required": ["function"], "properties": { "function": call } });
    let of_known = known.into_iter().map(|function| {
        let is_called =
            json!({ "required": ["call"], "properties": { "call": { "const": function } } });
        let fits = move |kind: &Kind| kind.function == Some(function);
        (of_function(is_called), without(fits))
    });
    let of_own = (
        of_function(json!({ "required": ["call"] })),
        without(|kind| !kind.of_motion && kind.function.is_none()),
    );
    let cases: Vec<_> = std::iter::once(moves)
        .chain(of_known)
        .chain([of_own])
        .collect();
    in_turn(task, cases.into_iter());
}

/// A task whose checks have no kind but those that fit.
fn without(fits: impl Fn(&Kind) -> bool) -> Value {
    let others = KINDS.iter().filter(|kind| !fits(kind));
    let refused: Map<String, Value> = others
        .map(|kind| (kind.name.to_owned(), false.into()))
        .collect();
    json!({ "properties": { "checks": { "items": { "properties": refused } } } })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::kind::KEYS;
    use kinemark_sim::text::schema::schema_of;

    #[test]
    fn the_schema_has_the_keys_that_are_read() {
        let schema = schema_of::<CheckTable>("A check");
        let properties = schema.as_value()["properties"].as_object().unwrap();
        let mut read = KEYS.to_vec();
        read.sort_unstable();
        let mut known: Vec<&str> = properties.keys().map(String::as_str).collect();
        known.sort_unstable();
        assert_eq!(known, read);
        for kind in KINDS {
            let summary = properties[kind.name]["description"].as_str().unwrap();
            assert!(summary.len() > 20, "{}: {summary}", kind.name);
        }
    }
}
