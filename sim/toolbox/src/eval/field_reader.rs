//! Reads the fields of a JSON object into typed requests, with errors that name the field by its path (`targets[1].axis`).
//!
//! It is a serde `Deserializer` of its own because that of `serde_json` has only prose for errors, and because a field that is `null`
//! counts as left out here.

use std::fmt;

use kinemark_sim::text::{nearest, suggest};
use serde::de::value::{MapDeserializer, SeqDeserializer};
use serde::de::{DeserializeOwned, Deserializer, Expected, IntoDeserializer, Unexpected, Visitor};
use serde::forward_to_deserialize_any;
use serde_json::{Map, Value};
use serde_path_to_error::{Path, Segment};

use super::refusal::{Code, Refusal};

/// The fields of a request that nothing has read yet.
#[derive(Debug)]
pub struct Fields {
    object: Map<String, Value>,
    known: Vec<&'static str>,
}

impl Fields {
    /// The fields of a request.
    pub fn of_request(object: Map<String, Value>) -> Self {
        let known = vec!["id", "op"];
        Self { object, known }
    }

    /// Reads the fields that `T` has, and leaves the others.
    ///
    /// # Errors
    /// The first field that is missing or not as `T` has it.
    pub fn read<T: DeserializeOwned>(&mut self) -> Result<T, Refusal> {
        serde_path_to_error::deserialize(ObjectReader(self)).map_err(|error| {
            let path = error.path().clone();
            error.into_inner().refusal(&path)
        })
    }

    /// Checks that every field was read: a typo must not pass in silence.
    ///
    /// # Errors
    /// [`Code::UnknownField`] with the nearest field of the operation.
    pub fn finish(self) -> Result<(), Refusal> {
        let nowhere = serde_path_to_error::Track::new().path();
        self.all_read().map_err(|error| error.refusal(&nowhere))
    }

    fn all_read(&self) -> Result<(), ReadError> {
        let Some(unknown) = self.object.keys().next() else {
            return Ok(());
        };
        let known = suggest(unknown, "fields", self.known.iter().copied());
        Err(ReadError::Unknown(unknown.clone(), known))
    }
}

/// What is read from the fields of a request: every struct that serde can read, and what takes its fields in steps.
pub trait FromFields: Sized {
    /// Takes the fields it has.
    ///
    /// # Errors
    /// As [`Fields::read`].
    fn from_fields(fields: &mut Fields) -> Result<Self, Refusal>;
}

impl<T: DeserializeOwned> FromFields for T {
    fn from_fields(fields: &mut Fields) -> Result<Self, Refusal> {
        fields.read()
    }
}

/// What is wrong with a value, without its path.
#[derive(Debug)]
enum ReadError {
    /// A field of an object is missing; an unknown one has nearly its name.
    Missing(&'static str, Option<String>),
    /// An object has a field too many; what to write instead.
    Unknown(String, String),
    /// The value is null, and must be something.
    Null(String),
    /// The value is not what the field can have: "must be 1 or 2, got 3".
    Value(Code, String),
}

impl ReadError {
    fn refusal(self, path: &Path) -> Refusal {
        let inside = |name: &str| match path.iter().len() {
            0 => name.to_owned(),
            _ => format!("{path}.{name}"),
        };
        let is_item = matches!(path.iter().next_back(), Some(Segment::Seq { .. }));
        let missing = |path: &str| Refusal::new(Code::MissingField, format!("`{path}` is missing"));
        match self {
            Self::Missing(name, None) => missing(&inside(name)),
            Self::Missing(name, Some(near)) => {
                let mut refusal = missing(&inside(name));
                refusal.message += &format!("; `{near}` is not a field: did you mean `{name}`?");
                refusal
            }
            Self::Unknown(name, instead) => Refusal::new(
                Code::UnknownField,
                format!("unknown field `{}`; {instead}", inside(&name)),
            ),
            Self::Null(what) if is_item => Refusal::new(
                Code::WrongType,
                format!("`{path}` must be {what}, got null"),
            ),
            // a field that is null counts as left out
            Self::Null(_) => missing(&path.to_string()),
            Self::Value(code, what) => Refusal::new(code, format!("`{path}` {what}")),
        }
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing(name, _) => write!(f, "`{name}` is missing"),
            Self::Unknown(name, instead) => write!(f, "unknown field `{name}`; {instead}"),
            Self::Null(what) => write!(f, "must be {what}, got null"),
            Self::Value(_, what) => f.write_str(what),
        }
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
            Unexpected::Unit => return Self::Null(expected.to_string()),
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
        let near = nearest(found, names.iter().copied());
        let near = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        let what = format!("must be {}, got `{found}`{near}", one_of(names));
        Self::Value(Code::OutOfRange, what)
    }

    fn missing_field(name: &'static str) -> Self {
        Self::Missing(name, None)
    }
}

/// Names in backquotes: `a`, `b` or `c`.
pub(super) fn one_of(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} or {last}", others.join(", ")),
        _ => quoted.concat(),
    }
}

/// An object of which a struct takes its fields, in the order in which it declares them.
struct ObjectReader<'o>(&'o mut Fields);

impl<'de> Deserializer<'de> for ObjectReader<'_> {
    type Error = ReadError;

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        names: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        let Fields { object, known } = self.0;
        known.extend(names);
        let taken = names
            .iter()
            .filter_map(|name| Some((*name, ValueReader(object.remove(*name)?))));
        let read = visitor.visit_map(MapDeserializer::new(taken.collect::<Vec<_>>().into_iter()));
        read.map_err(|error| match error {
            // one that nothing has read yet may be meant
            ReadError::Missing(name, None) => {
                let near = nearest(name, object.keys().map(String::as_str));
                ReadError::Missing(name, near.map(str::to_owned))
            }
            other => other,
        })
    }

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        Err(serde::de::Error::invalid_type(Unexpected::Map, &visitor))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str string bytes byte_buf option unit unit_struct newtype_struct seq
        tuple tuple_struct map enum identifier ignored_any
    }
}

/// One value of a request.
struct ValueReader(Value);

impl ValueReader {
    fn must_be<T>(&self, what: &str) -> Result<T, ReadError> {
        let found = match &self.0 {
            Value::Null => Unexpected::Unit,
            Value::Bool(value) => Unexpected::Bool(*value),
            Value::Number(_) => Unexpected::Float(0.0),
            Value::String(text) => Unexpected::Str(text),
            Value::Array(_) => Unexpected::Seq,
            Value::Object(_) => Unexpected::Map,
        };
        Err(serde::de::Error::invalid_type(found, &what))
    }
}

impl<'de> IntoDeserializer<'de, ReadError> for ValueReader {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> Deserializer<'de> for ValueReader {
    type Error = ReadError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        match self.0 {
            Value::Null => visitor.visit_unit(),
            Value::Bool(value) => visitor.visit_bool(value),
            Value::Number(number) => visitor.visit_f64(number.as_f64().unwrap_or(f64::NAN)),
            Value::String(text) => visitor.visit_string(text),
            Value::Array(items) => {
                visitor.visit_seq(SeqDeserializer::new(items.into_iter().map(ValueReader)))
            }
            Value::Object(_) => Err(serde::de::Error::invalid_type(Unexpected::Map, &visitor)),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        match self.0 {
            Value::Null => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        match self.0.as_f64() {
            Some(number) => visitor.visit_f64(number),
            None => self.must_be("a number"),
        }
    }

    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        match (&self.0, self.0.as_u64()) {
            (_, Some(number)) => visitor.visit_u64(number),
            (Value::Null, None) => self.must_be("an integer, zero or more"),
            (found, None) => Err(ReadError::Value(
                Code::OutOfRange,
                format!("must be an integer, zero or more, got {found}"),
            )),
        }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, ReadError> {
        match self.0 {
            Value::Array(_) => self.deserialize_any(visitor),
            _ => self.must_be("a list"),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(
        self,
        len: usize,
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        match &self.0 {
            Value::Array(items) if items.len() == len => self.deserialize_any(visitor),
            Value::Array(items) => {
                let rows = items.iter().any(Value::is_array);
                let (found, what) = (items.len(), if rows { "rows" } else { "numbers" });
                let what = format!("has {found} {what}, expected {len}");
                Err(ReadError::Value(Code::WrongLength, what))
            }
            _ => self.must_be(&format!("a list of length {len}")),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        let Value::Object(object) = self.0 else {
            return self.must_be("an object");
        };
        let known = Vec::new();
        let mut inside = Fields { object, known };
        let read = ObjectReader(&mut inside).deserialize_struct(name, fields, visitor)?;
        inside.all_read()?;
        Ok(read)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        match &self.0 {
            Value::String(name) => visitor.visit_enum(name.as_str().into_deserializer()),
            _ => self.must_be("a string"),
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
