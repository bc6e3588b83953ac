//! Parameters of a lab: named numbers, and the `"= expression"` texts over them that become numbers before a lab file is read.

use std::collections::BTreeMap;

use kinemark_sim::text::expression::{ExpressionProblem, MARK};
use kinemark_sim::text::{
    Dimension, Dimensions, MarkedNumbersProblem, Problem, Source, Spanned, TomlRefusal, nearest,
    read_with_marked_numbers, refused_parts,
};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::de::{DeTable, DeValue};

use super::load::refuse_unreadable;
use crate::task::problem::{LabError, problems};
use crate::task::reporter::Reporter;

problems! {
    /// What is wrong with parameters, or with what they are drawn from.
    enum ParameterProblem {
        BadName { name: String }:
            "lab::bad_name", "parameter name {name:?} cannot be used", "this name",
            "use letters, digits and `_`, and begin with a letter";
        DrawnFromExpression:
            "lab::variants", "[variants] holds numbers, not expressions: parameters are drawn from it", "an expression",
            "write the number";
        OfExpression:
            "lab::expression", "a parameter is a value, and expressions are over parameters", "an expression", "write the number";
        Quoted { text: String }:
            "lab::expression", "a number in quotes is a text", "in quotes", format!("write {} without quotes", text.replace(',', "."));
        OfReference:
            "lab::bad_name", "`reference` cannot be a parameter: in a band it is what the reference solution reaches", "this name",
            "choose another name";
        NoReferenceHere:
            "lab::expression", "`reference` has no value here: it is what the reference solution reaches in a check",
            "not in the band of a run", "name it only in `full` and `zero` of a check that judges a run";
    }
}

/// What the reference solution reaches in a check, in the expressions of its band.
pub(super) const REFERENCE: &str = "reference";

/// What the readers of TOML and of expressions refuse, in their words.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
struct ReadersProblem {
    code: &'static str,
    message: String,
    label: &'static str,
    help: Option<String>,
}

impl Problem for ReadersProblem {
    fn code(&self) -> &'static str {
        self.code
    }

    fn label(&self) -> String {
        self.label.to_owned()
    }

    fn help(&self) -> Option<String> {
        self.help.clone()
    }
}

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
    refuse_unreadable(source)?;
    let table: Stated = toml::from_str(source.text()).map_err(|error| refused(source, &error))?;
    let mut parameters = Dimensions::default();
    for (name, value) in table.parameters {
        let report = Reporter { source };
        named(report, &name)?;
        if let Dimension::Text(text) = value.get_ref() {
            if text.starts_with(MARK) {
                return report.refuse_at(&value, ParameterProblem::OfExpression);
            }
            if text.trim().replace(',', ".").parse::<f64>().is_ok() {
                let text = text.trim().to_owned();
                return report.refuse_at(&value, ParameterProblem::Quoted { text });
            }
        }
        parameters.set(name.into_inner(), value.into_inner());
    }
    Ok(parameters)
}

/// A parameter's name is one that an expression can use.
fn named(report: Reporter<'_>, at: &Spanned<String>) -> Result<(), LabError> {
    let name = at.get_ref();
    if name == REFERENCE {
        return report.refuse_at(at, ParameterProblem::OfReference);
    }
    let letter = |c: char| c.is_ascii_alphabetic() || c == '_';
    if name.starts_with(letter) && name.chars().all(|c| letter(c) || c.is_ascii_digit()) {
        return Ok(());
    }
    let name = name.clone();
    report.refuse_at(at, ParameterProblem::BadName { name })
}

/// Reads a lab file's tables, every `"= expression"` over `parameters` a number.
///
/// # Errors
/// An expression that has no value, and what the TOML reader refuses.
pub(super) fn tables_with<T: DeserializeOwned>(
    source: &Source,
    parameters: &Dimensions,
) -> Result<T, LabError> {
    let table = DeTable::parse(source.text()).map_err(|error| refused(source, &error))?;
    if let Some(variants) = table.get_ref().get("variants") {
        refuse_expressions(variants, source)?;
    }
    let read = read_with_marked_numbers(source, parameters, "parameter", REFERENCE);
    read.map_err(|problem| match problem {
        MarkedNumbersProblem::Refused(refusal) => in_tables(source, refusal),
        // what a misspelt table defines is missed first
        MarkedNumbersProblem::Expression(_) if let Some(at) = misspelt(source) => {
            let typed = &source.text()[at.clone()];
            let refusal = TomlRefusal {
                message: format!("unknown key `{typed}`"),
                help: Some("did you mean `parameters`?".to_owned()),
                at,
            };
            refusal_at(source, refusal)
        }
        MarkedNumbersProblem::Expression(ExpressionProblem { message, help, at }) => {
            let problem = ReadersProblem {
                code: "lab::expression",
                message,
                label: "in this expression",
                help,
            };
            LabError::new(Box::new(problem), source, at)
        }
    })
}

/// What is refused in the tables of a lab file that are read part by part.
pub(super) fn refused_in_parts(
    source: &Source,
    parameters: &Dimensions,
    parts: impl FnOnce(&toml::Spanned<DeTable<'_>>) -> Vec<toml::de::Error>,
) -> Vec<LabError> {
    let refused = refused_parts(source, parameters, ("parameter", REFERENCE), parts);
    let refused = refused.into_iter();
    refused.map(|refusal| in_tables(source, refusal)).collect()
}

/// What the reader refused in tables with expressions.
fn in_tables(source: &Source, refusal: TomlRefusal) -> LabError {
    if is_of_reference(source, &refusal) {
        let problem = Box::new(ParameterProblem::NoReferenceHere);
        return LabError::new(problem, source, refusal.at);
    }
    refusal_at(source, refusal)
}

/// Where the table of parameters stands, if its name is misspelt.
fn misspelt(source: &Source) -> Option<std::ops::Range<usize>> {
    const TABLE: &str = "parameters";
    let table = DeTable::parse(source.text()).ok()?;
    let table = table.get_ref();
    if table.contains_key(TABLE) {
        return None;
    }
    let mut keys = table.keys();
    let near = keys.find(|key| nearest(key.get_ref(), [TABLE].into_iter()).is_some())?;
    Some(near.span())
}

/// Refuses expressions in `[variants]`: what parameters are drawn from cannot depend on what was drawn.
fn refuse_expressions(value: &toml::Spanned<DeValue<'_>>, source: &Source) -> Result<(), LabError> {
    match value.get_ref() {
        DeValue::String(text) if text.starts_with(MARK) => {
            Reporter { source }.refuse(value.span(), ParameterProblem::DrawnFromExpression)
        }
        DeValue::Array(items) => items
            .iter()
            .try_for_each(|item| refuse_expressions(item, source)),
        DeValue::Table(table) => table
            .values()
            .try_for_each(|item| refuse_expressions(item, source)),
        _ => Ok(()),
    }
}

/// Whether a value was refused because its expression names the reference.
fn is_of_reference(source: &Source, refusal: &TomlRefusal) -> bool {
    let typed = source.text().get(refusal.at.clone()).unwrap_or_default();
    let inside = typed.trim_matches(['"', '\'']);
    let mut words = inside.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    inside.starts_with(MARK) && words.any(|word| word == REFERENCE)
}

/// What the TOML reader refused, with its place.
pub(super) fn refused(source: &Source, error: &toml::de::Error) -> LabError {
    refusal_at(source, TomlRefusal::from_error(error, source.text()))
}

/// Keys of a lab itself, which come before its first table.
const OF_LAB: [&str; 7] = [
    "format",
    "name",
    "title",
    "summary",
    "robot",
    "frame",
    "kept_after_stop",
];

/// What to do about an unknown key that is one of the lab itself, but stands in a table.
fn strayed(source: &Source, at: &std::ops::Range<usize>) -> Option<String> {
    let text = source.text();
    let key = text.get(at.clone())?;
    let mut before = text.get(..at.start)?.lines().rev().map(str::trim);
    let table = before.find(|line| line.starts_with('['))?;
    OF_LAB.contains(&key).then(|| {
        format!("this line stands in {table}: keys of the lab come before the first table")
    })
}

fn refusal_at(source: &Source, refusal: TomlRefusal) -> LabError {
    let TomlRefusal { message, help, at } = refusal;
    let help = match message.starts_with("unknown key") {
        true => strayed(source, &at).or(help),
        false => help,
    };
    let problem = ReadersProblem {
        code: "lab::toml",
        message,
        label: "here",
        help,
    };
    LabError::new(Box::new(problem), source, at)
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
deep = { far = "= l" }
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
        // the name of a list is the whole list
        assert_eq!(table.deep.far, [1.0, 2.5]);
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
