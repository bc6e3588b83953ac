//! Slips of the keyboard in a TOML file: decimal commas, typographic signs, units and expressions without quotes, brackets and strings that
//! are not closed. Each says what to write in its place.

use super::toml_refusal::Words;

/// Something that stands where a value does, and not in quotes: a text, or a number with more beside it.
pub(super) fn not_quoted(
    message: &str,
    given: &str,
    (expressions, in_list): (bool, bool),
) -> Option<Words> {
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
pub(super) fn is_in_list(text: &str, at: usize) -> bool {
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
pub(super) fn brackets(message: &str, text: &str, at: usize) -> Option<Words> {
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

/// A date such as `27.11.2026` with its year first.
pub(super) fn day_month_year(word: &str) -> Option<String> {
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
pub(super) fn decimal_comma(text: &str, at: usize) -> Option<String> {
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
pub(super) fn line_of(text: &str, at: usize) -> (usize, &str) {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    let start = text[..at].rfind('\n').map_or(0, |end| end + 1);
    let end = text[at..].find('\n').map_or(text.len(), |end| at + end);
    (start, &text[start..end])
}

/// The value without quotes in which byte `at` is, if it is short enough for a message.
pub(super) fn word_at(text: &str, at: usize) -> Option<&str> {
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
    use super::super::toml_refusal::TomlRefusal;
    use super::*;

    #[test]
    fn every_slip_is_named() {
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
    fn a_list_of_two_is_no_decimal() {
        assert_eq!(decimal_comma("a = [0,5]", 8), None);
        assert_eq!(decimal_comma("a = 0,5\nb = x", 12), None);
        assert_eq!(decimal_comma("", 0), None);
    }
}
