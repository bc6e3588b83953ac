//! Errors of the TOML reader, reworded for authors of labs, robots and scenes, with what to do about them.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::nearest;
use super::toml_slips::{
    brackets, day_month_year, decimal_comma, is_in_list, line_of, not_quoted, word_at,
};

/// An error of the TOML reader: its message, its position, and what to do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TomlRefusal {
    /// What is wrong.
    pub message: String,
    /// The nearest valid name, the list of valid names, or what to write instead.
    pub help: Option<String>,
    /// The bytes with the error.
    pub at: Range<usize>,
}

/// The help for a syntax error without a message of its own.
const LINES: &str =
    "a line is `key = value`, a table begins with `[name]`, and strings are in quotes";

impl TomlRefusal {
    /// Rewords the reader's error about `text`.
    pub fn from_error(error: &toml::de::Error, text: &str) -> Self {
        Self::reworded(error, text, false)
    }

    /// As [`TomlRefusal::from_error`], about a text in which a number may be an expression.
    pub(super) fn with_expressions(error: &toml::de::Error, text: &str) -> Self {
        Self::reworded(error, text, true)
    }

    fn reworded(error: &toml::de::Error, text: &str, expressions: bool) -> Self {
        let at = error.span().unwrap_or(0..0);
        let given = text.get(at.clone()).unwrap_or_default();
        let message = error.message().trim();
        let (message, help) = if let Some(help) = decimal_comma(text, at.start) {
            ("a comma in a number".to_owned(), help)
        } else {
            unknown(message, given, text, &at)
                .or_else(|| key(message, given, text, at.start))
                .or_else(|| not_quoted(message, given, (expressions, is_in_list(text, at.start))))
                .or_else(|| value(message, given, expressions))
                .or_else(|| brackets(message, text, at.start))
                .unwrap_or_else(|| syntax(message, text, at.start))
        };
        Self {
            message,
            help: Some(help),
            at,
        }
    }
}

/// A message, and what to do.
pub(super) type Words = (String, String);

/// An unknown name: of a key, of a kind that is a key, or of a value.
fn unknown(message: &str, given: &str, text: &str, at: &Range<usize>) -> Option<Words> {
    let what = if message.starts_with("unknown field") {
        "key"
    } else if !message.starts_with("unknown variant") {
        return None;
    } else if given.starts_with(['"', '\'']) {
        "value"
    } else {
        "kind"
    };
    let mut quoted = message.split('`').skip(1).step_by(2);
    let name = quoted.next().unwrap_or_default();
    let known: Vec<&str> = quoted.collect();
    // a second one of the same key would be the next mistake
    let present = keys_beside(text, at);
    let is_item = line_of(text, at.start).1.trim_start().starts_with("[[");
    let free = known.iter().copied();
    let free = free.filter(|name| is_item || !present.iter().any(|key| key == name));
    let of_turning = |stem: &str| {
        known
            .iter()
            .copied()
            .find(|known| *known == format!("{stem}_rad"))
    };
    let sliding = name.strip_suffix("_m").and_then(of_turning);
    let help = match (sliding, nearest(name, free)) {
        (Some(known), _) => format!("write `{known}`: of a joint that slides it holds metres"),
        (None, Some(near)) => format!("did you mean `{near}`?"),
        (None, None) => format!("known here: {}", known.join(", ")),
    };
    Some((format!("unknown {what} `{name}`"), help))
}

/// A key that is missing or duplicate.
fn key(message: &str, given: &str, text: &str, at: usize) -> Option<Words> {
    if message == "duplicate key" {
        let (_, line) = line_of(text, at);
        let once = format!("[{given}]");
        let is_table = line.trim_start().starts_with(&once);
        let is_item = line.trim_start().starts_with(&format!("[[{given}]]"));
        let first = text
            .lines()
            .position(|line| line.trim_start().starts_with(&once));
        let help = match (is_table, first) {
            _ if let Some((line, other)) = nearly_the_same_list(text, at) => {
                format!("line {line} has [[{other}]]: write it as in the other tables")
            }
            (true, _) => format!(
                "keep one of the two; each item of a list is [[{given}]], with two brackets"
            ),
            (false, Some(first)) if is_item => {
                format!(
                    "line {} has [{given}]: write [[{given}]] there, with two brackets",
                    first + 1
                )
            }
            (false, _) => "keep one of the two".to_owned(),
        };
        return Some((format!("the key `{given}` is defined twice"), help));
    }
    let name = message.strip_prefix("missing field ")?.trim_matches('`');
    let help = if name == "format" {
        "write `format = 1` in the first line".to_owned()
    } else {
        format!("add `{name} = ...` to this table")
    };
    Some((format!("the key `{name}` is missing"), help))
}

/// A list of tables whose name is nearly that of the table at `at`, with its line: `[[task]]` among `[[tasks]]`.
fn nearly_the_same_list(text: &str, at: usize) -> Option<(usize, &str)> {
    let (_, line) = line_of(text, at);
    let name = line.trim_start().trim_start_matches('[');
    let name = name.split(['.', ']']).next()?.trim();
    let lists = text.lines().enumerate().filter_map(|(i, line)| {
        let (other, _) = line.trim_start().strip_prefix("[[")?.split_once("]]")?;
        Some((i + 1, other.trim()))
    });
    lists
        .filter(|(_, other)| *other != name && !other.contains('.'))
        .find(|(_, other)| nearest(other, std::iter::once(name)).is_some())
}

/// A value of a wrong type or length.
fn value(message: &str, given: &str, expressions: bool) -> Option<Words> {
    if !message.starts_with("invalid ") {
        return None;
    }
    let (_, expected) = message.split_once(", expected ")?;
    let expected = in_our_words(expected);
    if let Some(rest) = message.strip_prefix("invalid length ") {
        let (found, _) = rest.split_once(',')?;
        return Some((
            format!("a list of {found}, expected {expected}"),
            written_as(&expected, given),
        ));
    }
    let found = ["invalid type: ", "invalid value: "]
        .iter()
        .find_map(|head| message.strip_prefix(head))?;
    let (found, _) = found.split_once(", expected ")?;
    let (kind, _) = found.split_once([' ', '`']).unwrap_or((found, ""));
    let kind = match kind {
        "string" => "a string",
        "integer" => "an integer",
        "floating" => "a number",
        "boolean" => "true or false",
        "sequence" => "a list",
        "map" => "a table",
        _ => "a value",
    };
    // a value of several lines is shown by the caret alone
    let shown = if given.len() <= 40 && !given.contains('\n') {
        format!("`{given}` is {kind}")
    } else {
        format!("this is {kind}")
    };
    let bare = given.trim_matches(['"', '\'']);
    let help = if kind == "a string" && expected.contains("number") && bare.parse::<f64>().is_ok() {
        format!("write {bare}, without quotes")
    } else if expressions && kind == "a string" && expected == "a number" && names_values(bare) {
        format!("an expression begins with =: \"= {bare}\"")
    } else if expected == "a string" {
        "put it in quotes".to_owned()
    } else {
        written_as(&expected, given)
    };
    Some((format!("{shown}, expected {expected}"), help))
}

/// What to write where `expected` is expected instead of `given`.
fn written_as(expected: &str, given: &str) -> String {
    // a list of lists is one of ranges or points, as far as that can be seen
    let of_numbers = !given.starts_with("[[");
    match expected {
        "a list of 2" if of_numbers => "write two numbers, such as [0, 1]".to_owned(),
        "a list of 3" if of_numbers => "write three numbers, such as [0, 0, 1]".to_owned(),
        _ => format!("write {expected}"),
    }
}

/// Whether a text could be meant as an expression over names: `right[0]`.
fn names_values(text: &str) -> bool {
    let of_expression = |c: char| c.is_ascii_alphanumeric() || "_[]+-*/(). ".contains(c);
    text.len() <= 40
        && text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && text.chars().all(of_expression)
}

/// The keys of the table in which the key at `at` is, that one among them; none where the text is no TOML.
fn keys_beside(text: &str, at: &Range<usize>) -> Vec<String> {
    fn in_table(table: &DeTable<'_>, at: &Range<usize>) -> Option<Vec<String>> {
        if table.keys().any(|key| key.span() == *at) {
            return Some(table.keys().map(|key| key.get_ref().to_string()).collect());
        }
        table.values().find_map(|value| in_value(value, at))
    }
    fn in_value(value: &Spanned<DeValue<'_>>, at: &Range<usize>) -> Option<Vec<String>> {
        match value.get_ref() {
            DeValue::Table(table) => in_table(table, at),
            DeValue::Array(items) => items.iter().find_map(|item| in_value(item, at)),
            _ => None,
        }
    }
    let table = DeTable::parse(text).ok();
    table
        .and_then(|table| in_table(table.get_ref(), at))
        .unwrap_or_default()
}

/// The reader's name of an expected type, reworded.
fn in_our_words(expected: &str) -> String {
    if expected.starts_with("struct ") || expected == "a map" || expected == "map" {
        return "a table".to_owned();
    }
    match expected {
        "f64" | "f32" => "a number".to_owned(),
        "i64" | "i32" => "an integer".to_owned(),
        "u64" | "u32" | "usize" => "an integer, zero or more".to_owned(),
        "a string" | "string" => "a string".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "a sequence" => "a list".to_owned(),
        other => other.replace("an array of length ", "a list of "),
    }
}

/// A text that is not TOML.
fn syntax(message: &str, text: &str, at: usize) -> Words {
    let of_numbers = [
        "invalid float",
        "invalid fraction",
        "invalid mantissa",
        "unexpected leading zero",
    ];
    if of_numbers.iter().any(|known| message.starts_with(known))
        || message.contains("integer number")
    {
        let word = word_at(text, at);
        if let Some(date) = word.and_then(day_month_year) {
            return (
                format!("`{}` is not a date", word.unwrap_or_default()),
                format!("write the year first, and a time with its zone: {date}T23:59:00+01:00"),
            );
        }
        let message = match word {
            Some(word) => format!("`{word}` is not a number"),
            None => "this is not a number".to_owned(),
        };
        return (message, "a number is such as 2, -0.5 or 1e-3".to_owned());
    }
    let (message, help) = if message.starts_with("invalid basic string") {
        (
            "a string is not closed",
            "end it with `\"` in the same line",
        )
    } else if message.starts_with("missing comma between array elements") {
        (
            "a list is neither closed here nor goes on",
            "put a `]` or a `,` before this",
        )
    } else {
        (message, LINES)
    };
    (message.to_owned(), help.to_owned())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use serde::Deserialize;

    use super::*;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "only its refusals are looked at")]
    struct Table {
        mass_kg: f64,
        #[serde(default)]
        name: String,
        #[serde(default)]
        axis: Option<[f64; 3]>,
        #[serde(default)]
        count: Option<u64>,
        #[serde(default)]
        side: Option<Side>,
        #[serde(default)]
        part: BTreeMap<String, f64>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Side {
        Near,
        Far,
    }

    #[test]
    fn every_refusal_says_what_to_write() {
        for (text, message, help) in [
            (
                "mass_kg = 0,5",
                "a comma in a number",
                "write 0.5: a decimal has a point",
            ),
            (
                "part = { a = 0,5 }\nmass_kg = 1",
                "a comma in a number",
                "write 0.5: a decimal has a point",
            ),
            (
                "part = { a = -0,033, b = 1 }\nmass_kg = 1",
                "a comma in a number",
                "write -0.033: a decimal has a point",
            ),
            (
                "mass_kg = \"5.0\"",
                "`\"5.0\"` is a string, expected a number",
                "write 5.0, without quotes",
            ),
            (
                "mass_kg = \"five\"",
                "`\"five\"` is a string, expected a number",
                "write a number",
            ),
            (
                "mass_kg = 1\nname = 2",
                "`2` is an integer, expected a string",
                "put it in quotes",
            ),
            (
                "mass_kg = 1\naxis = \"y\"",
                "`\"y\"` is a string, expected a list of 3",
                "write three numbers, such as [0, 0, 1]",
            ),
            (
                "mass_kg = 1\naxis = [0, 1]",
                "a list of 2, expected a list of 3",
                "write three numbers, such as [0, 0, 1]",
            ),
            (
                "mass_kg = 1\ncount = -1",
                "`-1` is an integer, expected an integer, zero or more",
                "write an integer, zero or more",
            ),
            (
                "mass_kg = 1\nside = \"nera\"",
                "unknown value `nera`",
                "did you mean `near`?",
            ),
            (
                "mass_kgs = 1",
                "unknown key `mass_kgs`",
                "did you mean `mass_kg`?",
            ),
            (
                "mass_kg = 1\nmass_kg = 2",
                "the key `mass_kg` is defined twice",
                "keep one of the two",
            ),
            (
                "mass_kg = 1\n[part]\na = 1\n[part]\nb = 1",
                "the key `part` is defined twice",
                "keep one of the two; each item of a list is [[part]], with two brackets",
            ),
            (
                "mass_kg = 1\nmass_kgs = 1",
                "unknown key `mass_kgs`",
                "known here: mass_kg, name, axis, count, side, part",
            ),
            (
                "mass_kg = 1.0.0",
                "`1.0.0` is not a number",
                "a number is such as 2, -0.5 or 1e-3",
            ),
            (
                "mass_kg = 1\nname = lab # here",
                "`lab` is not in quotes",
                "text stands in quotes: \"lab\"",
            ),
            (
                "name = \"a\"",
                "the key `mass_kg` is missing",
                "add `mass_kg = ...` to this table",
            ),
            (
                "name = \"a\nmass_kg = 1",
                "a string is not closed",
                "end it with `\"` in the same line",
            ),
            (
                "axis = [0, 1 }\nmass_kg = 1",
                "a list is neither closed here nor goes on",
                "put a `]` or a `,` before this",
            ),
        ] {
            let error = toml::from_str::<Table>(text).expect_err(text);
            let refusal = TomlRefusal::from_error(&error, text);
            assert_eq!(refusal.message, message, "{text}: {error}");
            assert_eq!(refusal.help.as_deref(), Some(help), "{text}: {error}");
        }
        let text = "mass_kg";
        let error = toml::from_str::<Table>(text).expect_err(text);
        assert_eq!(
            TomlRefusal::from_error(&error, text).help.as_deref(),
            Some(LINES)
        );
    }

    #[test]
    fn an_expression_without_its_mark_is_reported_where_one_may_be() {
        let text = "mass_kg = \"right[0]\"";
        let error = toml::from_str::<Table>(text).expect_err(text);
        for (refusal, help) in [
            (TomlRefusal::from_error(&error, text), "write a number"),
            (
                TomlRefusal::with_expressions(&error, text),
                "an expression begins with =: \"= right[0]\"",
            ),
        ] {
            assert_eq!(refusal.help.as_deref(), Some(help));
        }
    }
}
