//! Parameters of a lab: named numbers, and the `"= expression"` texts over them that become numbers before a lab file is read.

use std::collections::BTreeMap;
use std::ops::Range;

use kinemark_sim::robot::expression::evaluate_named;
use kinemark_sim::robot::{Dimension, Dimensions};
use kinemark_sim::source::{Source, TomlRefusal};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::load::{Reporter, refuse_not_finite};
use crate::task::problem::{LabError, LabProblem};

/// What a text begins with that is an expression.
const SIGN: char = '=';

/// A table of names with numbers or lists of numbers, every place kept.
pub(super) type NumbersTable = BTreeMap<Spanned<String>, Spanned<Dimension>>;

/// The parameters as a lab file states them.
///
/// # Errors
/// A text that is no TOML, a parameter that is no number or list of numbers, or a name that no expression could use.
pub(super) fn stated(source: &Source) -> Result<Dimensions, LabError> {
    #[derive(Deserialize)]
    struct Stated {
        #[serde(default)]
        parameters: NumbersTable,
    }
    refuse_not_finite(source)?;
    let table: Stated = toml::from_str(source.text()).map_err(|error| refused(source, &error))?;
    let mut parameters = Dimensions::default();
    for (name, value) in table.parameters {
        named(Reporter { source }, &name)?;
        parameters.set(name.into_inner(), value.into_inner());
    }
    Ok(parameters)
}

/// A parameter's name is one that an expression can use.
fn named(report: Reporter<'_>, at: &Spanned<String>) -> Result<(), LabError> {
    let name = at.get_ref();
    let letter = |c: char| c.is_ascii_alphabetic() || c == '_';
    if name.starts_with(letter) && name.chars().all(|c| letter(c) || c.is_ascii_digit()) {
        return Ok(());
    }
    report.err(
        at.span(),
        "lab::bad_name",
        format!("parameter name {name:?} cannot be used"),
        "this name",
        Some("use letters, digits and `_`, and begin with a letter".to_owned()),
    )
}

/// Reads a lab file's tables, every `"= expression"` over `parameters` a number.
///
/// # Errors
/// An expression that has no value, and what the TOML reader refuses.
pub(super) fn tables_with<T: DeserializeOwned>(
    source: &Source,
    parameters: &Dimensions,
) -> Result<T, LabError> {
    // the numbers as texts, in the order in which they are found: the tables borrow from them
    let mut numbers = Vec::new();
    let mut table = DeTable::parse(source.text()).map_err(|error| refused(source, &error))?;
    for (key, value) in table.get_ref() {
        if key.get_ref() == "variants" {
            refuse_expressions(value, source)?;
        }
        if let Err(error) = evaluated(value, source, parameters, &mut numbers) {
            // a table under a wrong name is why a parameter is missing, not the expression
            return Err(unknown_key::<T>(source).unwrap_or(error));
        }
    }
    let mut next = numbers.iter().map(String::as_str);
    for (_, value) in table.get_mut().iter_mut() {
        replaced(value, &mut next);
    }
    T::deserialize(Deserializer::from(table)).map_err(|error| refused(source, &error))
}

/// A key that no table of `T` knows, found with every expression taken for a zero.
fn unknown_key<T: DeserializeOwned>(source: &Source) -> Option<LabError> {
    let mut table = DeTable::parse(source.text()).ok()?;
    let mut zeros = std::iter::repeat("0");
    for (_, value) in table.get_mut().iter_mut() {
        replaced_dyn(value, &mut zeros);
    }
    let error = T::deserialize(Deserializer::from(table)).err()?;
    let is_key = error.message().starts_with("unknown field");
    is_key.then(|| refused(source, &error))
}

/// Refuses expressions in `[variants]`: what parameters are drawn from cannot depend on what was drawn.
fn refuse_expressions(value: &Spanned<DeValue<'_>>, source: &Source) -> Result<(), LabError> {
    match value.get_ref() {
        DeValue::String(text) if text.starts_with(SIGN) => Reporter { source }.err(
            value.span(),
            "lab::variants",
            "[variants] holds numbers, not expressions: parameters are drawn from it".to_owned(),
            "an expression",
            Some("write the number".to_owned()),
        ),
        DeValue::Array(items) => items
            .iter()
            .try_for_each(|item| refuse_expressions(item, source)),
        DeValue::Table(table) => table
            .values()
            .try_for_each(|item| refuse_expressions(item, source)),
        _ => Ok(()),
    }
}

fn evaluated(
    value: &Spanned<DeValue<'_>>,
    source: &Source,
    parameters: &Dimensions,
    numbers: &mut Vec<String>,
) -> Result<(), LabError> {
    match value.get_ref() {
        DeValue::String(text) => {
            if let Some(expression) = text.strip_prefix(SIGN) {
                let number = number(expression, value.span(), source, parameters)?;
                numbers.push(number);
            }
            Ok(())
        }
        DeValue::Array(items) => items
            .iter()
            .try_for_each(|item| evaluated(item, source, parameters, numbers)),
        DeValue::Table(table) => table
            .values()
            .try_for_each(|item| evaluated(item, source, parameters, numbers)),
        _ => Ok(()),
    }
}

fn replaced<'n>(value: &mut Spanned<DeValue<'n>>, numbers: &mut impl Iterator<Item = &'n str>) {
    match value.get_mut() {
        DeValue::String(text) if text.starts_with(SIGN) => {
            let number = numbers.next().and_then(|text| DeValue::parse(text).ok());
            if let Some(number) = number {
                *value.get_mut() = number.into_inner();
            }
        }
        DeValue::Array(items) => items
            .iter_mut()
            .for_each(|item| replaced_dyn(item, numbers)),
        DeValue::Table(table) => table
            .iter_mut()
            .for_each(|(_, item)| replaced_dyn(item, numbers)),
        _ => {}
    }
}

/// Breaks the recursion of types: an iterator behind a reference is one type at every depth.
fn replaced_dyn<'n>(value: &mut Spanned<DeValue<'n>>, numbers: &mut dyn Iterator<Item = &'n str>) {
    let mut numbers = numbers;
    replaced(value, &mut numbers);
}

/// The value of an expression as TOML; a whole one without a point, so that it may stand where a count is asked for.
fn number(
    expression: &str,
    span: Range<usize>,
    source: &Source,
    parameters: &Dimensions,
) -> Result<String, LabError> {
    match evaluate_named(expression, parameters, "parameter") {
        // 2^53: above, whole numbers are no longer exact
        Ok(value) if value.fract().abs() <= 0.0 && value.abs() < 9_007_199_254_740_992.0 => {
            Ok(format!("{value:.0}"))
        }
        Ok(value) => Ok(format!("{value:?}")),
        Err(problem) => {
            // behind the quote and the sign, where the text stands as typed
            let inside = span.start + 1 + SIGN.len_utf8();
            let typed = source.text().get(inside..inside + expression.len());
            let at = if typed == Some(expression) {
                inside + problem.at.start..inside + problem.at.end
            } else {
                span
            };
            Reporter { source }.err(
                at,
                "lab::expression",
                problem.message,
                "in this expression",
                problem.help,
            )
        }
    }
}

/// What the TOML reader refused, with its place.
pub(super) fn refused(source: &Source, error: &toml::de::Error) -> LabError {
    let TomlRefusal { message, help, at } = TomlRefusal::from_error(error, source.text());
    let problem = LabProblem {
        message,
        code: "lab::toml",
        label: "here".to_owned(),
        help,
    };
    LabError::new(problem, source, at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, Deserialize, PartialEq)]
    #[serde(deny_unknown_fields)]
    struct Table {
        parameters: NumbersTable,
        a: Spanned<f64>,
        list: Vec<[f64; 2]>,
        count: u64,
        deep: Deep,
        text: String,
    }

    #[derive(Debug, Deserialize, PartialEq)]
    struct Deep {
        far: Vec<f64>,
    }

    const TEXT: &str = r#"
text = "a = b"
a = "= x * 2 + l[1]"
count = "=l[0]+1"
list = [["= x", 1], [2.0, "= -x"]]
deep = { far = ["= l[1]", 0.5] }
parameters = { x = 0.1, l = [1, 2.5] }
"#;

    fn read(text: &str) -> Result<Table, LabError> {
        let source = Source::new("lab.toml", text);
        tables_with(&source, &stated(&source)?)
    }

    #[test]
    fn expressions_are_numbers_wherever_they_stand() {
        let table = read(TEXT).unwrap();
        assert_eq!(*table.a.get_ref(), 0.1 * 2.0 + 2.5);
        // the place is that of the text
        assert_eq!(&TEXT[table.a.span()], "\"= x * 2 + l[1]\"");
        assert_eq!(table.list, [[0.1, 1.0], [2.0, -0.1]]);
        assert_eq!(table.count, 2);
        assert_eq!(table.deep.far, [2.5, 0.5]);
        assert_eq!(table.text, "a = b");
    }

    #[test]
    fn what_has_no_value_is_refused_at_its_bytes() {
        for (from, to, at, message) in [
            ("x * 2", "y * 2", (3, 8), "no parameter is called `y`"),
            ("l[0]+1", "l[9]+1", (4, 13), "no such index"),
            ("\"= x\"", "\"= x / 0\"", (5, 12), "` x / 0` is inf"),
            (
                "x = 0.1",
                "x-y = 0.1",
                (7, 16),
                "parameter name \"x-y\" cannot be used",
            ),
            (
                "x = 0.1",
                "x = true",
                (7, 20),
                "`true` is true or false, expected",
            ),
            ("x = 0.1", "x = inf", (7, 20), "a lab's numbers are finite"),
            (
                "parameters =",
                "paramaters =",
                (7, 1),
                "unknown key `paramaters`",
            ),
        ] {
            let error = read(&TEXT.replacen(from, to, 1)).unwrap_err();
            assert!(error.to_string().contains(message), "{to}: {error}");
            assert_eq!(error.line_and_column(), at, "{to}: {error}");
        }
    }
}
