//! Errors of the TOML reader, reworded for authors of labs, robots and scenes, with what to do about them.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::nearest;

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

type Words = (String, String);

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

/// Something that stands where a value does, and not in quotes: a text, or a number with more beside it.
fn not_quoted(message: &str, given: &str, (expressions, in_list): (bool, bool)) -> Option<Words> {
    let is_date = message.starts_with("invalid date");
    if !is_date && !message.starts_with("string values must be quoted") {
        return None;
    }
    let given = given.trim_end_matches([' ', '\t']);
    let first = given.chars().next()?;
    let rest = &given[first.len_utf8()..];
    if first.is_whitespace() || ('\u{200b}'..='\u{200f}').contains(&first) || first == '\u{feff}' {
        let code = first as u32;
        return Some((
            format!(
                "the character U+{code:04X} stands here, which looks like a space or like nothing"
            ),
            "write an ordinary space in its place".to_owned(),
        ));
    }
    // a date that is nearly one
    let has_year = given.len() > 5
        && given.bytes().take(4).all(|byte| byte.is_ascii_digit())
        && given.as_bytes().get(4) == Some(&b'-');
    if is_date && has_year {
        return None;
    }
    if let Some(words) = typeset(given, first, rest) {
        return Some(words);
    }
    let statement = given.strip_suffix(';');
    if let Some(number) = statement.filter(|number| number.parse::<f64>().is_ok()) {
        return Some((
            format!("`{given}` ends with `;`"),
            format!("write {number}"),
        ));
    }
    let mut parts = given
        .split([' ', '\t', ';'])
        .filter(|part| !part.is_empty());
    let numbers: Option<Vec<&str>> = parts
        .by_ref()
        .map(|part| part.parse::<f64>().is_ok().then_some(part))
        .collect();
    if let Some(numbers) = numbers.filter(|numbers| numbers.len() > 1 && in_list) {
        return Some((
            format!("no `,` stands between the elements `{given}`"),
            format!("write {}", numbers.join(", ")),
        ));
    }
    let calculates = given.contains(['*', '/', '(']) && !given.contains('\\');
    let given = &shortened(given)[..];
    if expressions && calculates {
        return Some((
            format!("`{given}` is not in quotes"),
            format!("an expression stands in quotes and begins with =: \"= {given}\""),
        ));
    }
    let number = given.trim_start_matches(['~', '±', '+', '≈']);
    let end = number.find([' ', '\t', '%', '°']).unwrap_or_else(|| {
        let is_of_number = |c: char| c.is_ascii_digit() || ".-+".contains(c);
        number.find(|c| !is_of_number(c)).unwrap_or(number.len())
    });
    if !is_date && number[..end].parse::<f64>().is_ok() && end > 0 {
        return Some((
            format!("`{given}` is more than a number"),
            "write the number alone, in the unit that its key ends with".to_owned(),
        ));
    }
    Some((
        format!("`{given}` is not in quotes"),
        format!("text stands in quotes: \"{given}\""),
    ))
}

/// Whether a list is open before byte `at`, since the key of its line.
fn is_in_list(text: &str, at: usize) -> bool {
    let before = text.get(..at).unwrap_or_default();
    let value = before.rsplit('=').next().unwrap_or_default();
    value.matches('[').count() > value.matches(']').count()
}

/// The beginning of what is too long for a message.
fn shortened(text: &str) -> String {
    const MOST: usize = 40;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// Signs that a word processor writes in place of those of the keyboard.
fn typeset(given: &str, first: char, rest: &str) -> Option<Words> {
    let curly = ['“', '”', '„', '‟', '‘', '’', '‚', '«', '»'];
    if curly.contains(&first) {
        let text = given.trim_matches(curly);
        return Some((
            format!("`{given}` has typographic quotes"),
            format!("write straight ones: \"{text}\""),
        ));
    }
    if ['−', '–', '—'].contains(&first) {
        return Some((
            format!("`{given}` begins with a dash that is no minus sign"),
            format!("write `-{rest}`"),
        ));
    }
    None
}

/// A list or a table that is not closed, or closed too often, and strings that end where they should not.
fn brackets(message: &str, text: &str, at: usize) -> Option<Words> {
    let behind = text.get(at..)?;
    let words = |message: String, help: &str| Some((message, help.to_owned()));
    let of_table = [
        "missing key for inline table element",
        "missing comma between key-value pairs",
        "extra assignment between key-value pairs",
        "invalid inline table element",
    ];
    if of_table.iter().any(|known| message.starts_with(known)) {
        let line = opened_in(&text[..at]).map_or(String::new(), |line| format!(" of line {line}"));
        return words(
            format!("the table `{{ }}`{line} is neither closed here nor goes on"),
            "put a `}` or a `,` before this",
        );
    }
    if message.starts_with("extra comma in array") {
        return words(
            "between two commas an element is missing".to_owned(),
            "take one of them out",
        );
    }
    if message.starts_with("missing escaped value") || message.contains("unicode value") {
        return words(
            "a backslash in a string begins a character such as `\\n`".to_owned(),
            "write `\\\\` for a backslash, or the text in single quotes: '...'",
        );
    }
    if message.starts_with("invalid multi-line basic string") {
        let opened = text.rfind("\"\"\"").map_or(1, |at| line_number(text, at));
        return words(
            format!("the string that begins with `\"\"\"` in line {opened} is not closed"),
            "end it with `\"\"\"`",
        );
    }
    let (_, line) = line_of(text, at);
    if ["<<<<<<<", "=======", ">>>>>>>"]
        .iter()
        .any(|mark| line.starts_with(mark))
    {
        return words(
            "a mark of two versions that Git could not merge".to_owned(),
            "keep one of the two versions, and take the three marks out",
        );
    }
    if !message.starts_with("unexpected key or value") {
        return None;
    }
    match behind.chars().next() {
        Some(bracket @ ('}' | ']')) => words(
            format!("a `{bracket}` that closes nothing"),
            "take it out, or open it before",
        ),
        Some(sign @ (',' | ';')) => {
            words(format!("a line ends without `{sign}`"), "take the sign out")
        }
        Some('/') if behind.starts_with("//") => words(
            "`//` begins no comment".to_owned(),
            "a comment begins with #",
        ),
        Some(_) if text[..at].trim_end().ends_with('"') => words(
            "the string ends before this".to_owned(),
            "a quote inside of a string is written `\\\"`",
        ),
        _ => None,
    }
}

/// The line of the last `{` that is not closed in a text.
fn opened_in(text: &str) -> Option<usize> {
    let mut closed = 0_usize;
    let at = text.char_indices().rev().find(|(_, c)| match c {
        '}' => {
            closed += 1;
            false
        }
        '{' if closed > 0 => {
            closed -= 1;
            false
        }
        c => *c == '{',
    });
    at.map(|(at, _)| line_number(text, at))
}

/// The line of byte `at`, from one.
fn line_number(text: &str, at: usize) -> usize {
    text[..at].matches('\n').count() + 1
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

/// A date such as `27.11.2026` with its year first.
fn day_month_year(word: &str) -> Option<String> {
    let mut parts = word.split('.');
    let (day, month, year) = (parts.next()?, parts.next()?, parts.next()?);
    let [day, month] = [day, month].map(|part| part.parse::<u8>().ok());
    let is_year = year.len() == 4 && year.parse::<u16>().is_ok();
    (is_year && parts.next().is_none()).then_some(())?;
    let (day, month) = (day?, month?);
    let is_date = (1..=31).contains(&day) && (1..=12).contains(&month);
    is_date.then(|| format!("{year}-{month:02}-{day:02}"))
}

/// What to write for a number such as `0,5` that is the value at which the reader stopped.
fn decimal_comma(text: &str, at: usize) -> Option<String> {
    let (start, line) = line_of(text, at);
    line.match_indices('=').find_map(|(sign, _)| {
        let rest = line[sign + 1..].trim_start();
        let begin = line.len() - rest.len();
        let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
        let minus = usize::from(rest.starts_with('-'));
        let whole = minus + digits(&rest[minus..]);
        let fraction = rest.get(whole..)?.strip_prefix(',')?;
        let length = digits(fraction);
        let ends = begin + whole + 1 + length;
        // a little beyond it: the reader may have taken the fraction for a key
        let is_here = (begin..=ends + 3).contains(&(at - start));
        (whole > minus && length > 0 && is_here).then(|| {
            let (whole, fraction) = (&rest[..whole], &fraction[..length]);
            format!("write {whole}.{fraction}: a decimal has a point")
        })
    })
}

/// The line of `text` in which byte `at` is, and where it begins.
fn line_of(text: &str, at: usize) -> (usize, &str) {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    let start = text[..at].rfind('\n').map_or(0, |end| end + 1);
    let end = text[at..].find('\n').map_or(text.len(), |end| at + end);
    (start, &text[start..end])
}

/// The value without quotes in which byte `at` is, if it is short enough for a message.
fn word_at(text: &str, at: usize) -> Option<&str> {
    let (start, line) = line_of(text, at);
    let is_end =
        |c: char| c.is_whitespace() || matches!(c, ',' | '[' | ']' | '{' | '}' | '=' | '#');
    let inside = (at.saturating_sub(start)).min(line.len());
    let begin = line
        .char_indices()
        .rfind(|(i, c)| *i < inside && is_end(*c))
        .map_or(0, |(i, c)| i + c.len_utf8());
    let word = &line[begin..];
    let word = word.split(is_end).next()?;
    (1..=40).contains(&word.len()).then_some(word)
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
    fn slips_of_the_keyboard_are_known() {
        for (text, message, help) in [
            (
                "a = [0.7 -1.1]",
                "no `,` stands between the elements `0.7 -1.1`",
                "write 0.7, -1.1",
            ),
            (
                "a = [0.7; -1.1]",
                "no `,` stands between the elements `0.7; -1.1`",
                "write 0.7, -1.1",
            ),
            (
                "a = \u{2212}1.1",
                "`\u{2212}1.1` begins with a dash that is no minus sign",
                "write `-1.1`",
            ),
            (
                "a = \u{201c}rrbot\u{201d}",
                "`\u{201c}rrbot\u{201d}` has typographic quotes",
                "write straight ones: \"rrbot\"",
            ),
            (
                "a = 6 points",
                "`6 points` is more than a number",
                "write the number alone, in the unit that its key ends with",
            ),
            (
                "a = 250%",
                "`250%` is more than a number",
                "write the number alone, in the unit that its key ends with",
            ),
            (
                "a = ~6",
                "`~6` is more than a number",
                "write the number alone, in the unit that its key ends with",
            ),
            (
                "a = [pi/2, -1.1]",
                "`pi/2` is not in quotes",
                "an expression stands in quotes and begins with =: \"= pi/2\"",
            ),
            (
                "a =\u{a0}6.0",
                "the character U+00A0 stands here, which looks like a space or like nothing",
                "write an ordinary space in its place",
            ),
            (
                "a = 01-kinematics",
                "`01-kinematics` is not in quotes",
                "text stands in quotes: \"01-kinematics\"",
            ),
            (
                "a = { b = 1e-4, c = 2\n\n[[d]]",
                "the table `{ }` of line 1 is neither closed here nor goes on",
                "put a `}` or a `,` before this",
            ),
            (
                "a = { b = 1e-4 c = 5e-3 }",
                "the table `{ }` of line 1 is neither closed here nor goes on",
                "put a `}` or a `,` before this",
            ),
            (
                "a = { b = { c = 0.39, d = 1 }\ne = 2",
                "the table `{ }` of line 1 is neither closed here nor goes on",
                "put a `}` or a `,` before this",
            ),
            (
                "a = { b = { c = 0.39 } } }",
                "a `}` that closes nothing",
                "take it out, or open it before",
            ),
            (
                "x = 1\na = \"\"\"abc\nb = 1\n",
                "the string that begins with `\"\"\"` in line 2 is not closed",
                "end it with `\"\"\"`",
            ),
            ("a = 6;", "`6;` ends with `;`", "write 6"),
            (
                "a = 1e-3 m",
                "`1e-3 m` is more than a number",
                "write the number alone, in the unit that its key ends with",
            ),
            (
                "a = 1 000",
                "`1 000` is more than a number",
                "write the number alone, in the unit that its key ends with",
            ),
            (
                "a = 2 * pi",
                "`2 * pi` is not in quotes",
                "an expression stands in quotes and begins with =: \"= 2 * pi\"",
            ),
            (
                "a = \"rrbot\",\n",
                "a line ends without `,`",
                "take the sign out",
            ),
            (
                "a = \"rrbot\" // the arm\n",
                "`//` begins no comment",
                "a comment begins with #",
            ),
            (
                "a = 27.11.2026",
                "`27.11.2026` is not a date",
                "write the year first, and a time with its zone: 2026-11-27T23:59:00+01:00",
            ),
            (
                "a = 06",
                "`06` is not a number",
                "a number is such as 2, -0.5 or 1e-3",
            ),
            (
                "a = .5",
                "`.5` is not a number",
                "a number is such as 2, -0.5 or 1e-3",
            ),
            (
                "a = [1,,2]",
                "between two commas an element is missing",
                "take one of them out",
            ),
            (
                "a = \"C:\\Users\"",
                "a backslash in a string begins a character such as `\\n`",
                "write `\\\\` for a backslash, or the text in single quotes: '...'",
            ),
            (
                "a = \"in \"radians\" here\"",
                "the string ends before this",
                "a quote inside of a string is written `\\\"`",
            ),
            (
                "<<<<<<< HEAD\n",
                "a mark of two versions that Git could not merge",
                "keep one of the two versions, and take the three marks out",
            ),
            (
                "[[tasks]]\n[tasks.on]\n[[task]]\n[tasks.on]",
                "the key `on` is defined twice",
                "line 3 has [[task]]: write it as in the other tables",
            ),
            (
                "[[task]]\n[tasks.on]\n[[tasks]]\n",
                "the key `tasks` is defined twice",
                "line 1 has [[task]]: write it as in the other tables",
            ),
        ] {
            let error = toml::from_str::<toml::Table>(text).expect_err(text);
            let refusal = TomlRefusal::with_expressions(&error, text);
            assert_eq!(refusal.message, message, "{text}: {error}");
            assert_eq!(refusal.help.as_deref(), Some(help), "{text}: {error}");
        }
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

    #[test]
    fn a_list_of_two_is_no_decimal() {
        assert_eq!(decimal_comma("a = [0,5]", 8), None);
        assert_eq!(decimal_comma("a = 0,5\nb = x", 12), None);
        assert_eq!(decimal_comma("", 0), None);
    }
}
