//! A TOML table that is kept as typed, with every place, until it is known what its keys should be.

use std::collections::BTreeMap;
use std::fmt;

use serde::Deserialize;
use serde::de::{self, DeserializeOwned, Deserializer, SeqAccess, Visitor};
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue, ValueDeserializer};

/// A table as typed, which [`TypedTable::read`] reads in parts.
#[derive(Debug, Clone, Deserialize)]
#[serde(transparent)]
pub struct TypedTable(Spanned<BTreeMap<Spanned<String>, Spanned<Typed>>>);

/// A value as typed; a number in the digits of TOML.
#[derive(Debug, Clone)]
enum Typed {
    Text(String),
    Number(String),
    Flag(bool),
    List(Vec<Spanned<Typed>>),
}

impl TypedTable {
    /// Reads the keys for which `wanted` holds into a `T`, as if there were no others.
    ///
    /// # Errors
    /// What the TOML reader refuses, with its place in the text that the table is from.
    pub fn read<T: DeserializeOwned>(
        &self,
        wanted: impl Fn(&str) -> bool,
    ) -> Result<T, toml::de::Error> {
        let entries = self.0.get_ref().iter();
        let table: DeTable<'_> = entries
            .filter(|(key, _)| wanted(key.get_ref()))
            .map(|(key, value)| {
                let key = Spanned::new(key.span(), key.get_ref().as_str().into());
                (key, Spanned::new(value.span(), value.get_ref().as_toml()))
            })
            .collect();
        let table = Spanned::new(self.0.span(), DeValue::Table(table));
        T::deserialize(ValueDeserializer::from(table))
    }
}

impl Typed {
    fn as_toml(&self) -> DeValue<'_> {
        match self {
            Self::Text(text) => DeValue::String(text.as_str().into()),
            Self::Number(digits) => match DeValue::parse(digits) {
                Ok(number) => number.into_inner(),
                Err(_) => DeValue::String(digits.as_str().into()),
            },
            Self::Flag(flag) => DeValue::Boolean(*flag),
            Self::List(items) => {
                let mut list = DeArray::new();
                for item in items {
                    list.push(Spanned::new(item.span(), item.get_ref().as_toml()));
                }
                DeValue::Array(list)
            }
        }
    }
}

impl<'de> Deserialize<'de> for Typed {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct AnyValue;
        impl<'de> Visitor<'de> for AnyValue {
            type Value = Typed;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, a text, true or false, or a list of these")
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Typed, E> {
                Ok(Typed::Text(text.to_owned()))
            }
            fn visit_bool<E: de::Error>(self, flag: bool) -> Result<Typed, E> {
                Ok(Typed::Flag(flag))
            }
            fn visit_i64<E: de::Error>(self, number: i64) -> Result<Typed, E> {
                Ok(Typed::Number(number.to_string()))
            }
            // only numbers beyond `i64`
            fn visit_u64<E: de::Error>(self, number: u64) -> Result<Typed, E> {
                Ok(Typed::Number(number.to_string()))
            }
            fn visit_f64<E: de::Error>(self, number: f64) -> Result<Typed, E> {
                // as TOML has them: nan, not NaN
                Ok(Typed::Number(format!("{number:?}").to_lowercase()))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Typed, A::Error> {
                let mut items = Vec::new();
                while let Some(item) = seq.next_element()? {
                    items.push(item);
                }
                Ok(Typed::List(items))
            }
        }
        deserializer.deserialize_any(AnyValue)
    }
}
