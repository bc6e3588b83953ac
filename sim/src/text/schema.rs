//! JSON schemas of the files that people write, in draft 7, which editors of TOML understand. A schema is made from the very types that
//! are read; what those cannot say is added here.
//!
//! Every table is written out where it stands, without references: beside a reference, draft 7 knows no description.

use schemars::generate::SchemaSettings;
use schemars::transform::{Transform, transform_subschemas};
use schemars::{JsonSchema, Schema, json_schema};
use serde_json::{Map, Value, json};

use super::expression::MARK;

/// The schema of a file that is read as a `T`; `title` says what it is.
pub fn schema_of<T: JsonSchema>(title: &str) -> Schema {
    let settings = SchemaSettings::draft07().with(|settings| settings.inline_subschemas = true);
    let mut schema = settings.into_generator().into_root_schema_for::<T>();
    AsInToml.transform(&mut schema);
    schema.insert("title".to_owned(), title.into());
    schema
}

/// What TOML does not have, and what only Rust has.
struct AsInToml;

impl Transform for AsInToml {
    fn transform(&mut self, schema: &mut Schema) {
        transform_subschemas(self, schema);
        let Some(object) = schema.as_object_mut() else {
            return;
        };
        without_null(object);
        listed_words(object);
        // names of types of the code
        object.remove("title");
        // `double` and its kin: the type says it
        object.remove("format");
        if let Some(Value::String(text)) = object.get_mut("description") {
            *text = text
                .replace("\\[", "[")
                .replace("\\]", "]")
                .replace('\n', " ");
        }
    }
}

/// What may be left out is left out: there is no null in TOML.
fn without_null(object: &mut Map<String, Value>) {
    for word in ["type", "enum"] {
        let Some(Value::Array(items)) = object.get_mut(word) else {
            continue;
        };
        items.retain(|item| *item != json!("null") && !item.is_null());
        if let (1, "type") = (items.len(), word) {
            let only = items.remove(0);
            object.insert(word.to_owned(), only);
        }
    }
    let Some(Value::Array(options)) = object.get_mut("anyOf") else {
        return;
    };
    options.retain(|option| option["type"] != json!("null"));
    if options.len() > 1 {
        return;
    }
    // a description beside it is nearer than that of the type
    if let (Some(Value::Object(only)), true) = (options.pop(), object.remove("anyOf").is_some()) {
        // what its words mean follows whichever description there is
        let meanings = only.get("enum").and_then(|_| {
            let text = only.get("description")?.as_str()?;
            text.find(MEANING).map(|at| text[at..].to_owned())
        });
        if let (Some(Value::String(text)), Some(meanings)) =
            (object.get_mut("description"), meanings)
        {
            *text += &meanings;
        }
        for (key, value) in only {
            object.entry(key).or_insert(value);
        }
    }
}

/// How what a word means begins.
const MEANING: &str = " `";

/// Words that may stand in one place: a list of them, since of alternatives a reader says only that none fits. What each means follows
/// the description of the key.
fn listed_words(object: &mut Map<String, Value>) {
    let Some(Value::Array(options)) = object.get("oneOf") else {
        return;
    };
    let mut words = Vec::new();
    let mut meanings = String::new();
    for option in options {
        match (&option["const"], &option["enum"]) {
            (Value::String(word), _) => {
                if let Some(meaning) = option["description"].as_str() {
                    meanings += &format!("{MEANING}{word}`: {meaning}");
                }
                words.push(json!(word));
            }
            (Value::Null, Value::Array(several)) => words.extend(several.iter().cloned()),
            _ => return,
        }
    }
    object.remove("oneOf");
    object.insert("type".to_owned(), json!("string"));
    object.insert("enum".to_owned(), Value::Array(words));
    let own = object.get("description").and_then(Value::as_str);
    let text = format!("{}{meanings}", own.unwrap_or_default());
    object.insert("description".to_owned(), json!(text.trim()));
}

/// One or the other.
pub fn either(first: Schema, second: Schema) -> Schema {
    json_schema!({ "anyOf": [first, second] })
}

/// Makes a table have exactly one of the `keys`.
pub fn exactly_one(keys: &[&str]) -> impl FnMut(&mut Schema) + use<> {
    let options: Vec<Value> = keys
        .iter()
        .map(|key| json!({ "required": [key] }))
        .collect();
    move |schema| {
        schema.insert("oneOf".to_owned(), options.clone().into());
    }
}

/// The first of the `cases` whose condition holds adds its demands to `schema`, as `if`, `then` and `else`.
///
/// A list of alternatives would do, but a reader then says only that none of them fits, and not what is wrong in which place.
pub fn in_turn(schema: &mut Schema, cases: impl DoubleEndedIterator<Item = (Value, Value)>) {
    let mut chain = Value::Null;
    for (condition, demands) in cases.rev() {
        chain = match chain {
            Value::Null => json!({ "if": condition, "then": demands }),
            otherwise => json!({ "if": condition, "then": demands, "else": otherwise }),
        };
    }
    if let Value::Object(chain) = chain {
        schema.ensure_object().extend(chain);
    }
}

/// Makes every number of `schema` a number or an expression, and every list of numbers such a list or an expression that names one; but
/// not below the keys `except` of the file.
pub fn with_marked_numbers(mut schema: Schema, except: &[&str]) -> Schema {
    let properties = schema.get("properties").and_then(Value::as_object);
    let kept = except.iter().filter_map(|key| {
        let value = properties?.get(*key)?.clone();
        Some(((*key).to_owned(), value))
    });
    let kept: Vec<(String, Value)> = kept.collect();
    Marked.transform(&mut schema);
    if let Some(Value::Object(properties)) = schema.get_mut("properties") {
        properties.extend(kept);
    }
    schema
}

/// A number may be an expression.
struct Marked;

impl Transform for Marked {
    fn transform(&mut self, schema: &mut Schema) {
        transform_subschemas(self, schema);
        let Some(object) = schema.as_object_mut() else {
            return;
        };
        // a version is no number to compute with
        if object.contains_key("const") {
            return;
        }
        let mut types = match object.get("type") {
            Some(Value::String(one)) => vec![json!(one)],
            Some(Value::Array(several)) => several.clone(),
            _ => return,
        };
        let is = |name: &str| types.contains(&json!(name));
        let of_numbers = is("array") && is_number(object.get("items"));
        if (is("number") || is("integer") || of_numbers) && !is("string") {
            types.push(json!("string"));
            object.insert("type".to_owned(), Value::Array(types));
            // of texts alone
            object.insert("pattern".to_owned(), json!(format!("^{MARK}")));
        }
    }
}

/// Whether the items of a list are numbers, or were before they could be expressions.
fn is_number(items: Option<&Value>) -> bool {
    let Some(types) = items.map(|items| &items["type"]) else {
        return false;
    };
    let is = |name: &str| {
        let several = types.as_array();
        *types == json!(name) || several.is_some_and(|types| types.contains(&json!(name)))
    };
    (is("number") || is("integer")) && !is("array")
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    /// What it is.
    #[derive(Deserialize, JsonSchema)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "a schema reads no values")]
    struct Table {
        /// A length \[m\].
        a: f64,
        b: Option<u32>,
        c: Option<Inner>,
        d: Vec<[f64; 2]>,
        plain: f64,
        word: String,
    }

    /// Of its own.
    #[derive(Deserialize, JsonSchema)]
    #[expect(dead_code, reason = "a schema reads no values")]
    struct Inner {
        x: f64,
        /// Which way.
        way: Option<Way>,
    }

    /// A way.
    #[derive(Deserialize, JsonSchema)]
    #[serde(rename_all = "lowercase")]
    enum Way {
        /// To the left.
        Left,
        Right,
    }

    #[test]
    fn a_schema_is_that_of_toml() {
        let schema = schema_of::<Table>("A table");
        let schema = schema.as_value();
        assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
        assert_eq!(schema["title"], "A table");
        assert_eq!(schema["additionalProperties"], false);
        assert_eq!(schema["required"], json!(["a", "d", "plain", "word"]));
        let properties = &schema["properties"];
        assert_eq!(
            properties["a"],
            json!({ "description": "A length [m].", "type": "number" })
        );
        assert_eq!(properties["b"], json!({ "type": "integer", "minimum": 0 }));
        // written out, with the description of its type
        assert_eq!(properties["c"]["description"], "Of its own.");
        assert_eq!(properties["c"]["properties"]["x"]["type"], "number");
        let way = &properties["c"]["properties"]["way"];
        let words = json!({
            "description": "Which way. `left`: To the left.",
            "type": "string",
            "enum": ["right", "left"],
        });
        assert_eq!(*way, words);
        assert!(!schema.to_string().contains("null") && !schema.to_string().contains("$ref"));
    }

    #[test]
    fn numbers_may_be_expressions_where_they_are_read_as_such() {
        let schema = with_marked_numbers(schema_of::<Table>("A table"), &["plain"]);
        let properties = &schema.as_value()["properties"];
        let expression = json!(["number", "string"]);
        assert_eq!(properties["a"]["type"], expression);
        assert_eq!(properties["a"]["pattern"], "^=");
        assert_eq!(properties["c"]["properties"]["x"]["type"], expression);
        assert_eq!(properties["plain"]["type"], "number");
        assert_eq!(properties["word"], json!({ "type": "string" }));
        // a list of pairs is no list of numbers, a pair is
        assert_eq!(properties["d"]["type"], "array");
        assert_eq!(properties["d"]["items"]["type"], json!(["array", "string"]));
    }
}
