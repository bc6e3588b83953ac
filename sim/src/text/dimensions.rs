//! Named numbers and lists of numbers for expressions: the dimensions of a robot or a scene, the parameters of a lab.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};

/// The named dimensions of a robot, in file order.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Dimensions(Vec<(String, Dimension)>);

/// One named dimension: a number or a list of numbers, SI units.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Dimension {
    /// One number.
    Number(f64),
    /// A list, indexed from zero.
    List(Vec<f64>),
    /// A word that stands for something else than a size, such as the robot of a lab; no robot or scene has one.
    Text(String),
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(_) => write!(f, "one number"),
            Self::List(values) => write!(f, "a list of {}", values.len()),
            Self::Text(_) => write!(f, "a text"),
        }
    }
}

impl Dimensions {
    /// Dimensions in the order given; a later pair of the same name replaces the earlier one.
    pub fn from_pairs(pairs: impl IntoIterator<Item = (String, Dimension)>) -> Self {
        let mut dimensions = Self::default();
        for (name, value) in pairs {
            dimensions.set(name, value);
        }
        dimensions
    }

    /// The dimension called `name`.
    pub fn get(&self, name: &str) -> Option<&Dimension> {
        self.0.iter().find(|(n, _)| n == name).map(|(_, d)| d)
    }

    /// Sets or adds a dimension.
    pub fn set(&mut self, name: String, value: Dimension) {
        match self.0.iter_mut().find(|(n, _)| *n == name) {
            Some((_, old)) => *old = value,
            None => self.0.push((name, value)),
        }
    }

    /// The names, in file order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(name, _)| name.as_str())
    }

    /// Names with values, in file order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Dimension)> {
        self.0.iter().map(|(name, value)| (name.as_str(), value))
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<'de> Deserialize<'de> for Dimensions {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Pairs;
        impl<'de> Visitor<'de> for Pairs {
            type Value = Dimensions;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a table of named dimensions")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Dimensions, A::Error> {
                let mut pairs = Vec::new();
                while let Some((name, value)) = map.next_entry()? {
                    if let Dimension::Text(_) = value {
                        let message = "a dimension is a number or a list of numbers";
                        return Err(de::Error::custom(message));
                    }
                    pairs.push((name, value));
                }
                Ok(Dimensions(pairs))
            }
        }
        deserializer.deserialize_map(Pairs)
    }
}

impl JsonSchema for Dimensions {
    fn schema_name() -> Cow<'static, str> {
        "Dimensions".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        <BTreeMap<String, Dimension>>::json_schema(generator)
    }
}

/// A parameter in schemas: a number, a list of numbers, or a text that is no expression. Dimensions are never texts.
#[derive(Debug, Clone, Copy)]
pub struct ParameterSchema;

impl JsonSchema for ParameterSchema {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Parameter".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": ["number", "array", "string"],
            "items": { "type": "number" },
            // of texts alone
            "pattern": "^[^=]",
        })
    }
}

impl JsonSchema for Dimension {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Dimension".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": ["number", "array"], "items": { "type": "number" } })
    }
}

impl<'de> Deserialize<'de> for Dimension {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberOrList;
        impl<'de> Visitor<'de> for NumberOrList {
            type Value = Dimension;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or a list of numbers")
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Dimension, E> {
                Ok(Dimension::Number(value as f64))
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Dimension, E> {
                if value.is_finite() {
                    Ok(Dimension::Number(value))
                } else {
                    Err(E::custom(format!(
                        "a dimension must be finite, got {value}"
                    )))
                }
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Dimension, E> {
                Ok(Dimension::Text(text.to_owned()))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Dimension, A::Error> {
                let mut values = Vec::new();
                while let Some(item) = seq.next_element::<Dimension>()? {
                    match item {
                        Dimension::Number(value) => values.push(value),
                        Dimension::List(_) => {
                            return Err(de::Error::custom("a list of lists is not a dimension"));
                        }
                        Dimension::Text(_) => {
                            return Err(de::Error::custom("a list of numbers has no texts in it"));
                        }
                    }
                }
                Ok(Dimension::List(values))
            }
        }
        deserializer.deserialize_any(NumberOrList)
    }
}
