//! Reads a JSON object into a typed request, with errors that name the field by its path (`targets[1].axis`).
//!
//! It is a serde `Deserializer` of its own because that of `serde_json` has only prose for errors, and for three rules of requests: a
//! field that is `null` counts as left out; the fields of a variant stand beside the field that names the variant; a field that is
//! left out has the variant with the empty alias, if there is one.

use std::fmt;
use std::slice::Iter;

use kinemark_sim::text::{nearest, suggest};
use serde::de::value::SeqDeserializer;
use serde::de::{
    DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, Error as _, Expected,
    IntoDeserializer, MapAccess, Unexpected, VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use serde_json::{Map, Value};
use serde_path_to_error::{Path, Segment};

use super::refusal::{Code, Refusal};

/// The fields that every request may have; they are read before any other.
const OF_EVERY_REQUEST: [&str; 2] = ["id", "op"];

/// Reads all fields of a request; a typo must not pass in silence.
///
/// # Errors
/// The first field that is missing, not as `T` has it, or not one of `T`.
pub(super) fn request<T: DeserializeOwned>(fields: Map<String, Value>) -> Result<T, Refusal> {
    let reader = ValueReader {
        value: Value::Object(fields),
        beside: None,
    };
    serde_path_to_error::deserialize(reader).map_err(|error| {
        let path = error.path().clone();
        error.into_inner().refusal(&path)
    })
}

/// The fields of an object that nothing has read yet, and the names of all that it may have.
#[derive(Debug)]
struct Fields {
    unread: Map<String, Value>,
    known: Vec<&'static str>,
}

impl Fields {
    /// Reads the fields `names` in this order.
    fn read<'de, V: Visitor<'de>>(
        &mut self,
        names: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        self.known.extend(names);
        visitor.visit_map(FieldAccess {
            fields: self,
            names: names.iter(),
            name: "",
        })
    }

    fn unknown(&self) -> impl Iterator<Item = &String> {
        let unread = self.unread.keys();
        unread.filter(|name| !self.known.contains(&name.as_str()))
    }
}

/// What is wrong with a value, without its path.
#[derive(Debug)]
enum ReadError {
    /// The field is missing; these names are not known.
    Missing(Vec<String>),
    /// An object has a field too many; these are known.
    Unknown(String, Vec<&'static str>),
    /// The value is not what the field can have: "must be 1 or 2, got 3".
    Value(Code, String),
}

impl ReadError {
    fn refusal(self, path: &Path) -> Refusal {
        let segments = names_and_indices(path);
        let path = segments.concat();
        let path = path.trim_start_matches('.');
        match self {
            Self::Missing(unknown) => {
                let name = segments.last().map_or("", |name| &name[1..]);
                let near = nearest(name, unknown.iter().map(String::as_str));
                let near = near.map_or_else(String::new, |near| {
                    format!("; `{near}` is not a field: did you mean `{name}`?")
                });
                Refusal::new(Code::MissingField, format!("`{path}` is missing{near}"))
            }
            Self::Unknown(name, mut known) => {
                let inside = match path {
                    "" => {
                        known.splice(..0, OF_EVERY_REQUEST);
                        name.clone()
                    }
                    path => format!("{path}.{name}"),
                };
                let known = suggest(&name, "fields", known.into_iter());
                Refusal::new(
                    Code::UnknownField,
                    format!("unknown field `{inside}`; {known}"),
                )
            }
            Self::Value(code, what) => Refusal::new(code, format!("`{path}` {what}")),
        }
    }
}

/// A path in parts such as `.servo` and `[1]`. The fields of a variant stand beside the one that names it.
fn names_and_indices(path: &Path) -> Vec<String> {
    let mut parts = Vec::new();
    for segment in path {
        match segment {
            Segment::Map { key } => parts.push(format!(".{key}")),
            Segment::Seq { index } => parts.push(format!("[{index}]")),
            Segment::Enum { .. } => {
                parts.pop();
            }
            Segment::Unknown => {}
        }
    }
    parts
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self:?}")
    }
}

impl std::error::Error for ReadError {}

impl serde::de::Error for ReadError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::Value(Code::OutOfRange, message.to_string())
    }

    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        let found = match found {
            Unexpected::Bool(_) => "a boolean",
            Unexpected::Str(_) => "a string",
            Unexpected::Seq => "a list",
            Unexpected::Map => "an object",
            Unexpected::Unit => "null",
            _ => "a number",
        };
        Self::Value(Code::WrongType, format!("must be {expected}, got {found}"))
    }

    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        let found = match found {
            Unexpected::Str(text) => format!("`{text}`"),
            Unexpected::Unsigned(number) => number.to_string(),
            other => other.to_string(),
        };
        Self::Value(Code::OutOfRange, format!("must be {expected}, got {found}"))
    }

    fn unknown_variant(found: &str, names: &'static [&'static str]) -> Self {
        let names = || names.iter().copied().filter(|name| !name.is_empty());
        let near = nearest(found, names());
        let near = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        let what = format!("must be {}, got `{found}`{near}", one_of(names()));
        Self::Value(Code::OutOfRange, what)
    }
}

/// Names in backquotes: `a`, `b` or `c`.
fn one_of<'n>(names: impl Iterator<Item = &'n str>) -> String {
    let quoted: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} or {last}", others.join(", ")),
        _ => quoted.concat(),
    }
}

/// Fields of an object in the order in which a struct declares them; one that is left out is `null`.
struct FieldAccess<'o> {
    fields: &'o mut Fields,
    names: Iter<'static, &'static str>,
    name: &'static str,
}

impl<'de> MapAccess<'de> for FieldAccess<'_> {
    type Error = ReadError;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, ReadError> {
        let Some(name) = self.names.next() else {
            return Ok(None);
        };
        self.name = name;
        seed.deserialize(self.name.into_deserializer()).map(Some)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, ReadError> {
        let value = self.fields.unread.remove(self.name);
        seed.deserialize(ValueReader {
            value: value.unwrap_or(Value::Null),
            beside: Some(self.fields),
        })
    }
}

/// One value of a request.
struct ValueReader<'o> {
    value: Value,
    /// The other fields, if the value is one.
    beside: Option<&'o mut Fields>,
}

impl ValueReader<'_> {
    fn must_be<T>(&self, what: &dyn Expected) -> Result<T, ReadError> {
        let found = match (&self.value, &self.beside) {
            (Value::Null, Some(fields)) => {
                return Err(ReadError::Missing(fields.unknown().cloned().collect()));
            }
            (Value::Null, None) => Unexpected::Unit,
            (Value::Bool(value), _) => Unexpected::Bool(*value),
            (Value::Number(_), _) => Unexpected::Float(0.0),
            (Value::String(text), _) => Unexpected::Str(text),
            (Value::Array(_), _) => Unexpected::Seq,
            (Value::Object(_), _) => Unexpected::Map,
        };
        Err(ReadError::invalid_type(found, what))
    }
}

impl<'de> IntoDeserializer<'de, ReadError> for ValueReader<'_> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> Deserializer<'de> for ValueReader<'_> {
    type Error = ReadError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        match self.value {
            Value::Null | Value::Object(_) => self.must_be(&visitor),
            Value::Bool(value) => visitor.visit_bool(value),
            Value::Number(number) => visitor.visit_f64(number.as_f64().unwrap_or(f64::NAN)),
            Value::String(text) => visitor.visit_string(text),
            Value::Array(items) => {
                let items = items.into_iter().map(|value| ValueReader {
                    value,
                    beside: None,
                });
                visitor.visit_seq(SeqDeserializer::new(items))
            }
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        match self.value {
            Value::Null => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        match self.value.as_f64() {
            Some(number) => visitor.visit_f64(number),
            None => self.must_be(&"a number"),
        }
    }

    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        let expected = "an integer, zero or more";
        match (self.value.as_u64(), &self.value) {
            (Some(number), _) => visitor.visit_u64(number),
            (None, Value::Null) => self.must_be(&expected),
            (None, found) => Err(ReadError::custom(format!(
                "must be {expected}, got {found}"
            ))),
        }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        match self.value {
            Value::Array(_) => self.deserialize_any(visitor),
            _ => self.must_be(&"a list"),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(
        self,
        len: usize,
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        match &self.value {
            Value::Array(items) if items.len() == len => self.deserialize_any(visitor),
            Value::Array(items) => {
                let rows = items.iter().any(Value::is_array);
                let (found, what) = (items.len(), if rows { "rows" } else { "numbers" });
                let what = format!("has {found} {what}, expected {len}");
                Err(ReadError::Value(Code::WrongLength, what))
            }
            _ => self.must_be(&format!("a list of length {len}").as_str()),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        names: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        let Value::Object(unread) = self.value else {
            return self.must_be(&"an object");
        };
        let known = Vec::new();
        let mut fields = Fields { unread, known };
        let read = fields.read(names, visitor)?;
        let unknown = fields.unread.keys().next().cloned();
        unknown.map_or(Ok(read), |name| Err(ReadError::Unknown(name, fields.known)))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        names: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        match self.value {
            Value::String(_) => visitor.visit_enum(self),
            Value::Null if names.contains(&"") => visitor.visit_enum(self),
            _ => self.must_be(&"a string"),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        visitor.visit_newtype_struct(self)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 u8 u16 u32 f32 char str string bytes byte_buf unit unit_struct tuple_struct map identifier ignored_any
    }
}

impl<'de, 'o> EnumAccess<'de> for ValueReader<'o> {
    type Error = ReadError;
    type Variant = VariantFields<'o>;

    fn variant_seed<V: DeserializeSeed<'de>>(
        self,
        seed: V,
    ) -> Result<(V::Value, VariantFields<'o>), ReadError> {
        let name = self.value.as_str().unwrap_or_default();
        let variant = seed.deserialize(name.into_deserializer())?;
        Ok((variant, VariantFields(self.beside)))
    }
}

/// The object that the fields of a variant are in; a variant in a list has none.
struct VariantFields<'o>(Option<&'o mut Fields>);

impl<'de> VariantAccess<'de> for VariantFields<'_> {
    type Error = ReadError;

    fn unit_variant(self) -> Result<(), ReadError> {
        Ok(())
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, _: T) -> Result<T::Value, ReadError> {
        Err(ReadError::custom("has no variant of one value"))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, _: V) -> Result<V::Value, ReadError> {
        Err(ReadError::custom("has no variant of several values"))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        names: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        match self.0 {
            Some(fields) => fields.read(names, visitor),
            None => Err(ReadError::custom("has no fields beside it")),
        }
    }
}
