//! TOML in which a string that begins with `=` is an expression: each is replaced by its number before the tables are read, and the name
//! of a list or a text alone by that.
//!
//! An expression over a number that is not known yet, such as what a reference run will reach, is replaced by a [`super::Linear`] instead.

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::expression::{ExpressionProblem, MARK, evaluate_in};
use super::linear::{linear_in, names};
use super::{Dimension, Dimensions, Source, TomlRefusal};

/// Why tables could not be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MarkedNumbersProblem {
    /// The text is not TOML, or does not fit the tables.
    Refused(TomlRefusal),
    /// An expression has no value; the error points into the source.
    Expression(ExpressionProblem),
}

/// Reads the tables of `source` with every `"= expression"` over `named` as a number; messages call those values `noun` (`parameter`).
/// An expression that names `later` is read as a [`super::Linear`] in it.
///
/// # Errors
/// An expression that has no value, and what the TOML reader refuses. If a table has a wrong name, the error names the table and not the
/// expressions that refer to it.
pub fn read_with_marked_numbers<T: DeserializeOwned>(
    source: &Source,
    named: &Dimensions,
    noun: &'static str,
    later: &'static str,
) -> Result<T, MarkedNumbersProblem> {
    let refused = |error: &toml::de::Error| {
        MarkedNumbersProblem::Refused(TomlRefusal::with_expressions(error, source.text()))
    };
    let mut table = DeTable::parse(source.text()).map_err(|error| refused(&error))?;
    let numbers = match numbers_of(&table, source, named, (noun, later)) {
        Ok(numbers) => numbers,
        Err(problem) => {
            return Err(match unknown_key::<T>(source) {
                Some(error) => refused(&error),
                None => MarkedNumbersProblem::Expression(problem),
            });
        }
    };
    replace_all(&mut table, &numbers);
    T::deserialize(Deserializer::from(table)).map_err(|error| refused(&error))
}

/// What is refused in a text whose tables are read part by part: `parts` gets them with every expression as a number. Nothing in a text
/// that is no TOML, or has an expression without a value: that is said as a whole.
pub fn refused_parts(
    source: &Source,
    named: &Dimensions,
    (noun, later): (&'static str, &'static str),
    parts: impl FnOnce(&Spanned<DeTable<'_>>) -> Vec<toml::de::Error>,
) -> Vec<TomlRefusal> {
    let Ok(mut table) = DeTable::parse(source.text()) else {
        return Vec::new();
    };
    let Ok(numbers) = numbers_of(&table, source, named, (noun, later)) else {
        return Vec::new();
    };
    replace_all(&mut table, &numbers);
    let refused = parts(&table);
    let refused = refused.iter();
    refused
        .map(|error| TomlRefusal::with_expressions(error, source.text()))
        .collect()
}

/// The numbers of the expressions as text, in the order in which they are found: the tables will borrow from them.
fn numbers_of(
    table: &Spanned<DeTable<'_>>,
    source: &Source,
    named: &Dimensions,
    (noun, later): (&'static str, &'static str),
) -> Result<Vec<String>, ExpressionProblem> {
    let mut numbers = Vec::new();
    for value in table.get_ref().values() {
        each_expression(value, &mut |text, value| {
            let at = value.span();
            numbers.push(if names(text, later) {
                linear_in(source, &at, text, named, (noun, later))?.as_toml()
            } else if let Some(whole) = whole(text, named) {
                whole
            } else {
                as_toml(evaluate_in(source, &at, text, named, noun)?)
            });
            Ok(())
        })?;
    }
    Ok(numbers)
}

/// Puts the numbers where the expressions were.
fn replace_all<'n>(table: &mut Spanned<DeTable<'n>>, numbers: &'n [String]) {
    let mut next = numbers.iter().map(String::as_str);
    for (_, value) in table.get_mut().iter_mut() {
        replace(value, &mut next);
    }
}

/// The list or the text that an expression names as TOML, if it is nothing but the name of one.
fn whole(text: &str, named: &Dimensions) -> Option<String> {
    let name = text.strip_prefix(MARK)?.trim();
    match named.get(name)? {
        Dimension::List(values) => {
            let items: Vec<String> = values.iter().copied().map(as_toml).collect();
            Some(format!("[{}]", items.join(", ")))
        }
        Dimension::Text(text) => Some(toml::Value::String(text.clone()).to_string()),
        Dimension::Number(_) => None,
    }
}

/// An unknown key of the tables of `T`, found by reading every expression as zero.
fn unknown_key<T: DeserializeOwned>(source: &Source) -> Option<toml::de::Error> {
    let mut table = DeTable::parse(source.text()).ok()?;
    let mut zeros = std::iter::repeat("0");
    for (_, value) in table.get_mut().iter_mut() {
        replace(value, &mut zeros);
    }
    let error = T::deserialize(Deserializer::from(table)).err()?;
    error
        .message()
        .starts_with("unknown field")
        .then_some(error)
}

/// A visitor of an expression and the TOML value that holds it.
type Visit<'v> = dyn FnMut(&str, &Spanned<DeValue<'_>>) -> Result<(), ExpressionProblem> + 'v;

/// Calls `visit` for every expression in `value`, in the order of the text, until it returns an error.
fn each_expression(
    value: &Spanned<DeValue<'_>>,
    visit: &mut Visit<'_>,
) -> Result<(), ExpressionProblem> {
    match value.get_ref() {
        DeValue::String(text) if text.starts_with(MARK) => visit(text, value),
        DeValue::Array(items) => items
            .iter()
            .try_for_each(|item| each_expression(item, visit)),
        DeValue::Table(table) => table
            .values()
            .try_for_each(|item| each_expression(item, visit)),
        _ => Ok(()),
    }
}

/// Replaces the expressions in `value` by `numbers`, in the same order.
fn replace<'n>(value: &mut Spanned<DeValue<'n>>, numbers: &mut dyn Iterator<Item = &'n str>) {
    match value.get_mut() {
        DeValue::String(text) if text.starts_with(MARK) => {
            let number = numbers.next().and_then(|text| DeValue::parse(text).ok());
            if let Some(number) = number {
                *value.get_mut() = number.into_inner();
            }
        }
        DeValue::Array(items) => items.iter_mut().for_each(|item| replace(item, numbers)),
        DeValue::Table(table) => table
            .iter_mut()
            .for_each(|(_, item)| replace(item, numbers)),
        _ => {}
    }
}

/// A number as TOML; an integer without a decimal point, so that it is also valid as a count.
fn as_toml(number: f64) -> String {
    // 2^53: above, integers are no longer exact
    if number.fract().abs() <= 0.0 && number.abs() < 9_007_199_254_740_992.0 {
        format!("{number:.0}")
    } else {
        format!("{number:?}")
    }
}
